//! What a function's signature says, and what a formula's can't.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{FnArg, ItemFn, Pat, Safety};

use super::attributes::Approximation;
use super::module::{Function, Module, Parameter};
use super::shape::{MOST_NUMBERS, Shape};
use crate::diagnostics::Diagnostics;

/// The parameters that can be taken; whatever else the signature holds is reported.
pub(super) fn read(
    module: &Module,
    item: &ItemFn,
    diagnostics: &mut Diagnostics,
) -> Vec<Parameter> {
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
        .filter_map(|input| parameter(module, input, diagnostics))
        .collect()
}

fn parameter(module: &Module, input: &FnArg, diagnostics: &mut Diagnostics) -> Option<Parameter> {
    let FnArg::Typed(typed) = input else {
        diagnostics.error_with_hint(
            input.span(),
            "a formula has no `self`",
            "give the struct as a parameter, `c: &Name`, or write the formula in an `impl` block of the struct",
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
    if let syn::Type::Reference(reference) = typed.ty.as_ref()
        && let Some(mutability) = &reference.mutability
    {
        diagnostics.error_with_hint(
            mutability.span(),
            "a formula changes nothing that it is given",
            "take it by `&` or by value, and give what is new as the result",
        );
        return None;
    }
    let Some(shape) = Shape::of(module, &typed.ty) else {
        diagnostics.error_with_hint(
            typed.ty.span(),
            format!(
                "a parameter can't be of type `{}`",
                typed.ty.to_token_stream()
            ),
            format!("parameters are f64, arrays [f64; N] of a known length, and structs of these, of up to {MOST_NUMBERS} numbers, by value or reference"),
        );
        return None;
    };
    Some(Parameter {
        name: name.ident.clone(),
        shape,
        ty: (*typed.ty).clone(),
    })
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
    let fits = matches!(function.parameters.as_slice(), [only] if only.shape == Shape::Number);
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
