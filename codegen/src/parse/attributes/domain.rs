//! `#[domain(…)]`: where numbers lie.

use syn::spanned::Spanned;
use syn::{BinOp, Expr};

use super::number;
use super::target::{Target, target};
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sign};

/// How a domain is written, for hints.
pub(super) const EXAMPLE: &str = "write comparisons with a number: x > 0.0, x <= 2.0 or x != 0.0";

/// One comparison of a number with a bound.
pub(super) fn read(condition: &Expr, diagnostics: &mut Diagnostics) -> Option<(Target, Domain)> {
    if let Expr::Binary(binary) = condition
        && let Some(bound) = number(&binary.right)
    {
        let domain = match binary.op {
            BinOp::Gt(_) if bound == 0.0 => Some(Domain::of_sign(Sign::POSITIVE)),
            BinOp::Ge(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_NEGATIVE)),
            BinOp::Lt(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NEGATIVE)),
            BinOp::Le(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_POSITIVE)),
            BinOp::Ne(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_ZERO)),
            // Whether the bound itself is in it is no matter to a form.
            BinOp::Gt(_) | BinOp::Ge(_) => Some(Domain::at_least(bound)),
            BinOp::Lt(_) | BinOp::Le(_) => Some(Domain::at_most(bound)),
            _ => None,
        };
        if let Some(domain) = domain {
            return target(&binary.left, diagnostics).map(|target| (target, domain));
        }
    }
    diagnostics.error_with_hint(condition.span(), "not a domain", EXAMPLE);
    None
}
