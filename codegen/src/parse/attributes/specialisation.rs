//! `#[specialise(…)]`: functions made by fixing parameters of another.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Ident};

use super::head;
use super::request::{self, Request};
use super::target::{Target, target};
use crate::diagnostics::Diagnostics;

/// How a specialisation is written, for hints.
pub(super) const EXAMPLE: &str =
    "write for example specialise(phi_on_sir, omega = speed, generate(gradient(speed)))";

/// A new function, made by fixing parameters of the one it stands at.
#[derive(Clone, Debug)]
pub struct Specialisation {
    /// The new function's name.
    pub name: Ident,
    /// Parameter, or one number of it, and the expression in its place.
    pub replacements: Vec<(Target, Expr)>,
    /// What to generate from it.
    pub request: Request,
}

pub(super) fn read(
    words: &[Expr],
    span: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Specialisation> {
    let mut words = words.iter();
    let Some((name, _)) = words.next().and_then(head) else {
        diagnostics.error_with_hint(
            span,
            "a specialisation begins with the new function's name",
            EXAMPLE,
        );
        return None;
    };
    let mut specialisation = Specialisation {
        name: name.clone(),
        replacements: Vec::new(),
        request: Request {
            value: true,
            ..Request::default()
        },
    };
    let before = diagnostics.len();
    for word in words {
        match word {
            Expr::Assign(assign) => match target(&assign.left, diagnostics) {
                Some(target) if replaces(&specialisation.replacements, &target) => {
                    diagnostics.error_with_hint(
                        target.span,
                        format!("`{}` is replaced already", target.symbol),
                        "leave one of the two",
                    );
                }
                Some(target) => {
                    let expression = assign.right.as_ref().clone();
                    specialisation.replacements.push((target, expression));
                }
                None => {}
            },
            Expr::Call(call) if head(word).is_some_and(|(name, _)| name == "generate") => {
                let forms: Vec<Expr> = call.args.iter().cloned().collect();
                specialisation.request = request::read(&forms, call.span(), diagnostics);
            }
            _ => {
                diagnostics.error_with_hint(word.span(), "not a part of a specialisation", EXAMPLE)
            }
        }
    }
    if specialisation.replacements.is_empty() && diagnostics.len() == before {
        diagnostics.error_with_hint(
            name.span(),
            "the specialisation fixes no parameter",
            EXAMPLE,
        );
    }
    (diagnostics.len() == before).then_some(specialisation)
}

/// Whether the number, or the parameter that it is of, is among those replaced, or a number of it is.
fn replaces(replacements: &[(Target, Expr)], target: &Target) -> bool {
    replacements.iter().any(|(known, _)| {
        let both_whole = known.symbol == target.symbol;
        let one_whole = known.symbol == known.root() || target.symbol == target.root();
        both_whole || (one_whole && known.root() == target.root())
    })
}
