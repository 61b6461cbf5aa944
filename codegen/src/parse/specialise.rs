//! `#[specialise(…)]`: the new function, written as a call of the one that it is made from.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Expr, Type};

use super::attributes::{Specialisation, Target};
use super::module::{Function, Parameter};
use super::numbers;
use super::shape::Shape;
use crate::diagnostics::Diagnostics;

/// The function `special(rest) { original(…replacements…) }`.
pub(super) fn function(
    function: &Function,
    specialisation: Specialisation,
    diagnostics: &mut Diagnostics,
) -> Option<Function> {
    check_replaced(function, &specialisation, diagnostics)?;
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
    let is_replaced = |symbol: &str| {
        let mut all = specialisation.replacements.iter();
        all.any(|(target, _)| {
            let rest = symbol.strip_prefix(&target.symbol);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        })
    };
    let domain = domain.filter(|(symbol, ..)| !is_replaced(symbol));
    match item {
        Ok(item) => Some(Function {
            item,
            of: None,
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

/// Reports what is replaced and is no parameter, and no field or element of one.
fn check_replaced(
    function: &Function,
    specialisation: &Specialisation,
    diagnostics: &mut Diagnostics,
) -> Option<()> {
    let before = diagnostics.len();
    let is_known = |target: &Target, part: &str| {
        let parameter = function.parameter(target.root());
        parameter.is_some_and(|parameter| parameter.shape.part(target.root(), part).is_ok())
    };
    for (target, _) in &specialisation.replacements {
        let part = &target.symbol[target.root().len()..];
        if part.matches(['.', '[']).count() > 1 {
            diagnostics.error_with_hint(
                target.span,
                format!(
                    "`{}` is a part of a part, which is not replaced by itself",
                    target.symbol
                ),
                "replace the parameter as a whole, or its field or element",
            );
        } else if !is_known(target, part) {
            numbers::check(function, target, diagnostics);
        }
    }
    (diagnostics.len() == before).then_some(())
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
    if let Shape::Array(_, length) = parameter.shape {
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
