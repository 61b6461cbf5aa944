//! `budget(…)`: the most operations that forms may take.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Ident, Lit};

use super::head;
use crate::cost::Measure;
use crate::diagnostics::Diagnostics;

/// One entry of a budget.
#[derive(Clone, Debug)]
pub struct Limit {
    /// What is counted.
    pub measure: Measure,
    /// The most that is allowed.
    pub most: usize,
    /// The entry, for the message.
    pub span: Span,
}

/// Adds the entries of a budget to the limits.
pub(super) fn read(
    limits: &mut Vec<Limit>,
    name: &Ident,
    arguments: &[&Expr],
    diagnostics: &mut Diagnostics,
) {
    const EXAMPLE: &str = "write for example budget(operations = 96, div = 1)";
    if arguments.is_empty() {
        diagnostics.error_with_hint(name.span(), "the budget names no count", EXAMPLE);
    }
    for argument in arguments {
        let entry = match argument {
            Expr::Assign(assign) => (head(&assign.left), assign.right.as_ref()),
            _ => (None, *argument),
        };
        let (
            Some((key, _)),
            Expr::Lit(syn::ExprLit {
                lit: Lit::Int(most),
                ..
            }),
        ) = entry
        else {
            diagnostics.error_with_hint(
                argument.span(),
                "an entry of the budget is a count and a whole number",
                EXAMPLE,
            );
            continue;
        };
        let Some(measure) = Measure::named(&key.to_string()) else {
            diagnostics.error_with_hint(
                key.span(),
                format!("unknown count `{key}`"),
                format!("counts are {}", Measure::NAMES.join(", ")),
            );
            continue;
        };
        if limits.iter().any(|limit| limit.measure == measure) {
            diagnostics.error_with_hint(
                argument.span(),
                format!("`{key}` has a limit already"),
                "leave one of the two",
            );
            continue;
        }
        match most.base10_parse() {
            Ok(most) => limits.push(Limit {
                measure,
                most,
                span: argument.span(),
            }),
            Err(error) => diagnostics.syntax(&error, EXAMPLE),
        }
    }
}
