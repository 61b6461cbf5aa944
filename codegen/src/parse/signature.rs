//! What a function's signature says, and what a formula's can't.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{FnArg, ItemFn, Pat, Safety, Type};

use super::attributes::Approximation;
use super::module::{Function, Parameter, ParameterKind};
use crate::diagnostics::Diagnostics;

/// The parameters that can be taken; whatever else the signature holds is reported.
pub(super) fn read(item: &ItemFn, diagnostics: &mut Diagnostics) -> Vec<Parameter> {
    let safety = match &item.sig.safety {
        Safety::Safe(word) => Some(("safe", word.span())),
        Safety::Unsafe(word) => Some(("unsafe", word.span())),
        Safety::Default => None,
    };
    let asyncness = item.sig.asyncness.as_ref();
    let words = [safety, asyncness.map(|word| ("async", word.span()))];
    for (word, span) in words.into_iter().flatten() {
        diagnostics.error_with_hint(
            span,
            format!("a formula is not `{word}`"),
            "leave the word out: a formula only computes",
        );
    }
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
    let Some(kind) = kind else {
        diagnostics.error_with_hint(
            typed.ty.span(),
            format!(
                "a parameter can't be of type `{}`",
                typed.ty.to_token_stream()
            ),
            "parameters are f64, [f64; n], or a struct of f64 by reference or value",
        );
        return None;
    };
    Some(Parameter {
        name: name.ident.clone(),
        kind,
        ty: (*typed.ty).clone(),
    })
}

/// The most elements of an array: each is a symbol of its own.
const MOST_ELEMENTS: usize = 4096;

/// Whether the path is a type of the language that no formula computes with.
pub(super) fn is_other_type(path: &syn::Path) -> bool {
    const OTHER: [&str; 16] = [
        "f32", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128",
        "usize", "bool", "char", "String",
    ];
    path.segments
        .last()
        .is_some_and(|last| OTHER.iter().any(|name| last.ident == name))
}

fn parameter_kind(ty: &Type) -> Option<ParameterKind> {
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
                .filter(|length| of_numbers && *length <= MOST_ELEMENTS)
                .map(ParameterKind::Array)
        }
        Type::Path(path) if path.path.is_ident("f64") => Some(ParameterKind::Number),
        Type::Path(path) => {
            let last = path.path.segments.last()?;
            let plain = !is_other_type(&path.path) && last.arguments.is_none();
            plain.then_some(ParameterKind::Struct)
        }
        _ => None,
    }
}

/// Reports what an approximation asks for that the function does not have.
pub(super) fn check_approximation(
    function: &Function,
    approximation: &Approximation,
    diagnostics: &mut Diagnostics,
) {
    let inputs = function.item.sig.inputs.len();
    if inputs == 1 && function.parameters.is_empty() {
        // The parameter is reported itself.
        return;
    }
    let fits =
        matches!(function.parameters.as_slice(), [only] if only.kind == ParameterKind::Number);
    if !(fits && inputs == 1) {
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
