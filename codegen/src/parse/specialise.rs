//! `#[specialise(…)]`: the new function, written as a call of the one that it is made from.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Expr, Type};

use super::attributes::{Specialisation, Target, root};
use super::module::{Function, Module, Parameter, ParameterKind};
use super::numbers;
use crate::diagnostics::Diagnostics;

/// The function `special(rest) { original(…replacements…) }`.
pub(super) fn function(
    module: &Module,
    function: &Function,
    specialisation: Specialisation,
    diagnostics: &mut Diagnostics,
) -> Option<Function> {
    let before = diagnostics.len();
    for (target, _) in &specialisation.replacements {
        if function.parameter(&target.symbol).is_none() {
            numbers::check(module, function, target, diagnostics);
        }
    }
    if diagnostics.len() > before {
        return None;
    }
    let replaced = |symbol: &str| {
        let mut all = specialisation.replacements.iter();
        all.find(|(target, _)| target.symbol == symbol)
    };
    let rest = function.parameters.iter();
    let rest = rest.filter(|parameter| replaced(&parameter.name.to_string()).is_none());
    let parameters: Vec<Parameter> = rest.cloned().collect();
    let arguments = function.parameters.iter();
    let arguments = arguments.map(|parameter| argument(parameter, &specialisation.replacements));
    let (name, original) = (&specialisation.name, &function.item.sig.ident);
    let (visibility, output) = (&function.item.vis, &function.item.sig.output);
    let conditions = function.conditions();
    let inputs = parameters
        .iter()
        .map(|Parameter { name, ty, .. }| quote!(#name: #ty));
    let fixed: Vec<String> = specialisation
        .replacements
        .iter()
        .map(|(target, expression)| {
            format!("`{} = {}`", target.symbol, expression.to_token_stream())
        })
        .collect();
    let doc = format!(" [`{original}`] with {}.", fixed.join(", "));
    let item = syn::parse2(quote! {
        #(#conditions)*
        #[doc = #doc]
        #[allow(dead_code)]
        #visibility fn #name(#(#inputs),*) #output { #original(#(#arguments),*) }
    });
    let domain = function.domain.iter();
    let domain = domain
        .filter(|(symbol, ..)| replaced(symbol).is_none() && replaced(root(symbol)).is_none());
    match item {
        Ok(item) => Some(Function {
            item,
            parameters,
            request: Some(specialisation.request.clone()),
            domain: domain.cloned().collect(),
            approximation: None,
            readable: function.readable,
            specialises: Some(function.name()),
        }),
        Err(error) => {
            diagnostics.syntax(&error, "a replacement is an expression");
            None
        }
    }
}

/// What the original is called with in a parameter's place.
fn argument(parameter: &Parameter, replacements: &[(Target, Expr)]) -> TokenStream {
    let (name, text) = (&parameter.name, parameter.name.to_string());
    let of_it: Vec<_> = replacements
        .iter()
        .filter(|(target, _)| target.root() == text)
        .collect();
    if let Some((_, whole)) = of_it.iter().find(|(target, _)| target.symbol == text) {
        return whole.to_token_stream();
    }
    if of_it.is_empty() {
        return name.to_token_stream();
    }
    let (reference, ty) = match &parameter.ty {
        Type::Reference(reference) => (Some(reference.and_token), reference.elem.as_ref()),
        ty => (None, ty),
    };
    let replacement = |symbol: String| {
        let found = of_it.iter().find(|(target, _)| target.symbol == symbol);
        found.map(|(_, expression)| expression)
    };
    if let ParameterKind::Array(length) = parameter.kind {
        let elements = (0..length).map(|position| {
            let place = proc_macro2::Literal::usize_unsuffixed(position);
            replacement(format!("{text}[{position}]"))
                .map_or_else(|| quote!(#name[#place]), ToTokens::to_token_stream)
        });
        return quote!(#reference [#(#elements),*]);
    }
    let fields = of_it.iter().filter_map(|(target, expression)| {
        let field: TokenStream = target
            .symbol
            .strip_prefix(&format!("{text}."))?
            .parse()
            .ok()?;
        Some(quote!(#field: #expression))
    });
    let base = match reference {
        Some(_) => quote!(*#name),
        None => quote!(#name),
    };
    quote!(#reference #ty { #(#fields,)* ..#base })
}
