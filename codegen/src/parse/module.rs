//! The items of a module of formulas.

use proc_macro2::Span;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{FnArg, Ident, Item, ItemFn, ItemMod, Pat, Type};

use super::attributes::{Approximation, FunctionAttributes, OWN, Request, Specialisation};
use super::imports::Imports;
use crate::diagnostics::Diagnostics;
use crate::graph::Sign;

/// A module of formulas.
#[derive(Debug)]
pub struct Module {
    /// The item as written, without the generator's own attributes.
    pub item: ItemMod,
    /// Its functions in order.
    pub functions: Vec<Function>,
    /// Its constants: name and value.
    pub constants: Vec<(String, syn::Expr)>,
    /// What it imports of the standard library's constants.
    pub imports: Imports,
    /// Its structs: name and fields.
    pub structs: Vec<(String, Vec<String>)>,
}

/// A function of the module.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its item, without the generator's own attributes.
    pub item: ItemFn,
    /// Its parameters in order.
    pub parameters: Vec<Parameter>,
    /// What is asked of it.
    pub request: Option<Request>,
    /// Declared domains: symbol, sign, place.
    pub domain: Vec<(String, Sign, Span)>,
    /// Whether and how it is tabulated.
    pub approximation: Option<Approximation>,
    /// Whether its signature and its approximation can be taken; where not, that is reported, and the body is not followed.
    pub readable: bool,
    /// For a specialisation: the function it stands at and its replacements are in the body.
    pub specialises: Option<String>,
}

/// A parameter of a function.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: Ident,
    /// What it holds.
    pub kind: ParameterKind,
    /// Its type as written.
    pub ty: Type,
}

/// What a parameter holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// One `f64`.
    Number,
    /// `[f64; n]`.
    Array(usize),
    /// A struct with fields of type `f64`.
    Struct,
}

impl Function {
    /// The function's name.
    pub fn name(&self) -> String {
        self.item.sig.ident.to_string()
    }
}

impl Module {
    /// Reads a module. Functions whose signature can't be taken are left as written, and reported.
    pub fn read(mut item: ItemMod, diagnostics: &mut Diagnostics) -> Self {
        let mut module = Self {
            item: item.clone(),
            functions: Vec::new(),
            constants: Vec::new(),
            imports: Imports::default(),
            structs: Vec::new(),
        };
        let Some((_, items)) = &mut item.content else {
            diagnostics.error_with_hint(
                item.ident.span(),
                "the module's formulas are not here",
                "write the module inline: mod name { … }",
            );
            return module;
        };
        for item in items.iter_mut() {
            match item {
                Item::Fn(function) => module.read_function(function, diagnostics),
                Item::Const(constant) => {
                    module
                        .constants
                        .push((constant.ident.to_string(), (*constant.expr).clone()));
                }
                Item::Struct(item) => {
                    let fields = item
                        .fields
                        .iter()
                        .filter_map(|field| field.ident.as_ref().map(ToString::to_string));
                    module
                        .structs
                        .push((item.ident.to_string(), fields.collect()));
                }
                Item::Use(import) => module.imports.read(&mut Vec::new(), &import.tree),
                _ => {}
            }
        }
        module.item = item;
        module
    }

    /// The function of that name.
    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions
            .iter()
            .find(|function| function.item.sig.ident == name)
    }

    fn read_function(&mut self, item: &mut ItemFn, diagnostics: &mut Diagnostics) {
        let attributes = FunctionAttributes::read(&item.attrs, diagnostics);
        let approximated = item
            .attrs
            .iter()
            .any(|attribute| attribute.path().is_ident("approximate"));
        let before = diagnostics.len();
        item.attrs
            .retain(|attribute| !OWN.iter().any(|name| attribute.path().is_ident(name)));
        if attributes.request.is_some() {
            // Its generated forms may be all that is called.
            item.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
        }
        let parameters = parameters(item, diagnostics);
        let mut function = Function {
            item: item.clone(),
            parameters,
            readable: true,
            request: attributes.request,
            domain: attributes
                .domain
                .into_iter()
                .map(|(target, sign)| (target.symbol, sign, target.span))
                .collect(),
            approximation: attributes.approximation,
            specialises: None,
        };
        if let Some(approximation) = &function.approximation {
            check_approximation(&function, approximation, diagnostics);
        }
        function.readable =
            diagnostics.len() == before && approximated == function.approximation.is_some();
        for specialisation in attributes.specialisations {
            if let Some(special) = specialise(&function, specialisation, diagnostics) {
                self.functions.push(special);
            }
        }
        self.functions.push(function);
    }
}

fn parameters(item: &ItemFn, diagnostics: &mut Diagnostics) -> Vec<Parameter> {
    if !item.sig.generics.params.is_empty() {
        diagnostics.error_with_hint(
            item.sig.generics.span(),
            "a formula has no generic parameters",
            "write it for f64; other number types are generated from it",
        );
    }
    item.sig
        .inputs
        .iter()
        .filter_map(|input| parameter(input, diagnostics))
        .collect()
}

fn parameter(input: &FnArg, diagnostics: &mut Diagnostics) -> Option<Parameter> {
    let FnArg::Typed(typed) = input else {
        diagnostics.error_with_hint(
            input.span(),
            "a formula has no `self`",
            "give the struct as a parameter: c: &Name",
        );
        return None;
    };
    let Pat::Ident(name) = typed.pat.as_ref() else {
        diagnostics.error_with_hint(
            typed.pat.span(),
            "a parameter is a plain name",
            "take it apart in the body with `let`",
        );
        return None;
    };
    let kind = parameter_kind(&typed.ty);
    if kind.is_none() {
        diagnostics.error_with_hint(
            typed.ty.span(),
            format!(
                "a parameter can't be of type `{}`",
                typed.ty.to_token_stream()
            ),
            "parameters are f64, [f64; n], or a struct of f64 by reference or value",
        );
    }
    // A parameter of an unusable type is taken as a number, so that its uses are not reported too.
    let kind = kind.unwrap_or(ParameterKind::Number);
    Some(Parameter {
        name: name.ident.clone(),
        kind,
        ty: (*typed.ty).clone(),
    })
}

fn parameter_kind(ty: &Type) -> Option<ParameterKind> {
    const OTHER_NUMBERS: [&str; 16] = [
        "f32", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128",
        "usize", "bool", "char", "String",
    ];
    match ty {
        // Numbers come by value: the generated code computes with them as they are.
        Type::Reference(reference) => {
            parameter_kind(&reference.elem).filter(|kind| *kind != ParameterKind::Number)
        }
        Type::Paren(paren) => parameter_kind(&paren.elem),
        Type::Array(array) => {
            let syn::Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Int(length),
                ..
            }) = &array.len
            else {
                return None;
            };
            let of_numbers = parameter_kind(&array.elem) == Some(ParameterKind::Number);
            length
                .base10_parse()
                .ok()
                .filter(|_| of_numbers)
                .map(ParameterKind::Array)
        }
        Type::Path(path) if path.path.is_ident("f64") => Some(ParameterKind::Number),
        Type::Path(path) => {
            let last = path.path.segments.last()?;
            let other = OTHER_NUMBERS.iter().any(|name| last.ident == name);
            (!other && last.arguments.is_none()).then_some(ParameterKind::Struct)
        }
        _ => None,
    }
}

fn check_approximation(
    function: &Function,
    approximation: &Approximation,
    diagnostics: &mut Diagnostics,
) {
    let fits =
        matches!(function.parameters.as_slice(), [only] if only.kind == ParameterKind::Number);
    if !fits {
        diagnostics.error_with_hint(
            function.item.sig.inputs.span(),
            "an approximated function has one number as its parameter",
            "fix the other parameters in a function of its own, or use them in the function that calls this one",
        );
    } else if function
        .parameters
        .iter()
        .all(|parameter| parameter.name != approximation.variable)
    {
        diagnostics.error_with_hint(
            approximation.variable.span(),
            format!(
                "`{}` is not the function's parameter",
                approximation.variable
            ),
            format!("write `{}`", function.parameters[0].name),
        );
    }
}

/// The parameters that a specialisation does not replace.
fn parameters_left(
    function: &Function,
    specialisation: &Specialisation,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Parameter>> {
    let mut left = function.parameters.clone();
    for (name, _) in &specialisation.replacements {
        let known = |parameter: &Parameter| parameter.name == *name;
        if !function.parameters.iter().any(known) {
            let names = function.parameters.iter();
            let names: Vec<_> = names.map(|known| known.name.to_string()).collect();
            diagnostics.error_with_hint(
                name.span(),
                format!("`{}` has no parameter `{name}`", function.name()),
                format!("its parameters are {}", names.join(", ")),
            );
            return None;
        }
        left.retain(|parameter| parameter.name != *name);
    }
    Some(left)
}

/// The function `special(rest) { original(…replacements…) }`.
fn specialise(
    function: &Function,
    specialisation: Specialisation,
    diagnostics: &mut Diagnostics,
) -> Option<Function> {
    let rest = parameters_left(function, &specialisation, diagnostics)?;
    let arguments = function.parameters.iter().map(|parameter| {
        let replacement = specialisation
            .replacements
            .iter()
            .find(|(name, _)| *name == parameter.name);
        replacement.map_or_else(
            || parameter.name.to_token_stream(),
            |(_, expression)| expression.to_token_stream(),
        )
    });
    let (name, original) = (&specialisation.name, &function.item.sig.ident);
    let (visibility, output) = (&function.item.vis, &function.item.sig.output);
    let inputs = rest
        .iter()
        .map(|Parameter { name, ty, .. }| quote::quote!(#name: #ty));
    let fixed: Vec<String> = specialisation
        .replacements
        .iter()
        .map(|(name, expression)| format!("`{name} = {}`", expression.to_token_stream()))
        .collect();
    let doc = format!(" [`{original}`] with {}.", fixed.join(", "));
    let item = syn::parse2(quote::quote! {
        #[doc = #doc]
        #[allow(dead_code)]
        #visibility fn #name(#(#inputs),*) #output { #original(#(#arguments),*) }
    });
    match item {
        Ok(item) => Some(Function {
            item,
            parameters: rest,
            request: Some(specialisation.request),
            domain: function
                .domain
                .iter()
                .filter(|(symbol, ..)| {
                    let root = symbol.split(['.', '[']).next().unwrap_or_default();
                    !specialisation
                        .replacements
                        .iter()
                        .any(|(name, _)| name == root)
                })
                .cloned()
                .collect(),
            approximation: None,
            readable: function.readable,
            specialises: Some(function.name()),
        }),
        Err(error) => {
            diagnostics.syntax(&error);
            None
        }
    }
}
