//! `#[approximate(…)]`: a variable's interval, a tolerance, and a factor that is kept.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, ExprRange, Ident};

use super::{Approximation, head, number};
use crate::diagnostics::Diagnostics;

pub(super) const EXAMPLE: &str =
    "write for example approximate(x = 0.0..=1.0, factor = x.powi(2), tolerance = 1e-13)";

/// What was read so far.
#[derive(Default)]
struct Parts {
    interval: Option<(Ident, f64, f64)>,
    factor: Option<Expr>,
    tolerance: Option<f64>,
    seen: Vec<&'static str>,
}

pub(super) fn read(
    words: &[Expr],
    span: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Approximation> {
    let before = diagnostics.len();
    let mut parts = Parts::default();
    for word in words {
        let assign = match word {
            Expr::Assign(assign) => {
                head(&assign.left).map(|(name, _)| (name, assign.right.as_ref()))
            }
            _ => None,
        };
        match assign {
            Some((name, right)) if name == "tolerance" => {
                if parts.is_first("tolerance", word, diagnostics) {
                    parts.tolerance = tolerance(right, diagnostics);
                }
            }
            Some((name, right)) if name == "factor" => {
                if parts.is_first("factor", word, diagnostics) {
                    parts.factor = Some(right.clone());
                }
            }
            Some((name, Expr::Range(range))) => {
                if parts.is_first("interval", word, diagnostics) {
                    parts.interval = interval(range, diagnostics)
                        .map(|(lower, upper)| (name.clone(), lower, upper));
                }
            }
            _ => {
                diagnostics.error_with_hint(word.span(), "not a part of an approximation", EXAMPLE);
            }
        }
    }
    if !(parts.seen.contains(&"interval") && parts.seen.contains(&"tolerance")) {
        diagnostics.error_with_hint(
            span,
            "an approximation needs its variable's interval and a tolerance",
            EXAMPLE,
        );
    }
    let (variable, lower, upper) = parts.interval?;
    let tolerance = parts.tolerance?;
    (diagnostics.len() == before).then_some(Approximation {
        variable,
        lower,
        upper,
        factor: parts.factor,
        tolerance,
        span,
    })
}

impl Parts {
    /// Notes a part; a second one of the kind is reported.
    fn is_first(&mut self, part: &'static str, word: &Expr, diagnostics: &mut Diagnostics) -> bool {
        if self.seen.contains(&part) {
            diagnostics.error_with_hint(
                word.span(),
                format!("a second {part} of one approximation"),
                "leave one of the two",
            );
            return false;
        }
        self.seen.push(part);
        true
    }
}

fn tolerance(expression: &Expr, diagnostics: &mut Diagnostics) -> Option<f64> {
    let mut report = |message: String| {
        let hint = "it is the greatest relative error: write for example tolerance = 1e-13";
        diagnostics.error_with_hint(expression.span(), message, hint);
        None
    };
    match number(expression) {
        Some(value) if value > 0.0 && value.is_finite() => Some(value),
        Some(value) => report(format!("a tolerance is above zero, not {value}")),
        None => report("the tolerance is no literal number".to_owned()),
    }
}

fn interval(range: &ExprRange, diagnostics: &mut Diagnostics) -> Option<(f64, f64)> {
    let mut bound = |end: &Option<Box<Expr>>, name: &str| {
        let (span, message) = match end {
            None => (range.span(), format!("the interval has no {name} bound")),
            Some(end) => match number(end) {
                Some(value) if value.is_finite() => return Some(value),
                Some(_) => (end.span(), format!("the {name} bound is not finite")),
                None => (end.span(), format!("the {name} bound is no literal number")),
            },
        };
        diagnostics.error_with_hint(
            span,
            message,
            "an interval is of two numbers: x = 0.0..=1.0",
        );
        None
    };
    let (lower, upper) = (bound(&range.start, "lower"), bound(&range.end, "upper"));
    let (lower, upper) = (lower?, upper?);
    if lower < upper && (upper - lower).is_finite() {
        return Some((lower, upper));
    }
    let hint = if lower > upper {
        "write the smaller bound first"
    } else {
        "its bounds are two numbers, and so is their distance"
    };
    diagnostics.error_with_hint(
        range.span(),
        format!("there is no interval from {lower:?} to {upper:?}"),
        hint,
    );
    None
}
