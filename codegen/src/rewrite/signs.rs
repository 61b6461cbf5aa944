//! Rules of sizes and signs.
//!
//! There are two signs: that of `f64::signum`, 1 at `0.0` and −1 at `-0.0`, so that the sign of a product is the product of
//! the signs even there; and the side of zero, the derivative of a size, which is 1 at both. Of neither anything is known at
//! 0 but that it is 1 or −1, and where a number is known not to be negative its sign is 1, as if it were above 0.

use num_traits::Signed;

use super::rules::{factors_with, operand_of, parts, scaled};
use super::{applied, product};
use crate::graph::{ExprId, Factors, Function, Graph};

/// What an expression is the sign of, of either kind.
fn signed(graph: &Graph, id: ExprId) -> Option<ExprId> {
    let kinds = [Function::Sign, Function::Side];
    kinds
        .into_iter()
        .find_map(|kind| operand_of(graph, id, kind))
}

/// The square of a sign is 1.
pub(super) fn power_of_sign(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sign, Function::Side])?;
    let mut changed = factors.clone();
    for (factor, exponent) in &mut changed {
        if signed(graph, *factor).is_some() {
            *exponent = exponent.rem_euclid(2);
        }
    }
    (changed != factors).then(|| product(graph, changed))
}

/// A number times its sign is its size, which keeps a derivative finite where the number is zero.
pub(super) fn number_by_sign(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sign, Function::Side])?;
    for (sign, exponent) in &factors {
        let Some(number) = signed(graph, *sign).filter(|_| *exponent == 1) else {
            continue;
        };
        let power = factors.iter().find(|(factor, _)| *factor == number);
        if let Some((_, power)) = power {
            let size = (applied(graph, Function::Abs, number), power.signum());
            let mut changed = factors.clone();
            changed.extend([(*sign, -1), (number, -power.signum()), size]);
            return Some(product(graph, changed));
        }
    }
    None
}

pub(super) fn even_power_of_absolute(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Abs])?;
    let mut changed = factors.clone();
    for (factor, exponent) in &mut changed {
        // A divisor stays the size that it is elsewhere, so that one inverse serves both.
        if *exponent > 0
            && *exponent % 2 == 0
            && let Some(inner) = operand_of(graph, *factor, Function::Abs)
        {
            *factor = inner;
        }
    }
    (changed != factors).then(|| product(graph, changed))
}

pub(super) fn absolute_of_known_sign(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let operand = operand_of(graph, id, Function::Abs)?;
    let sign = graph.sign(operand);
    if sign.is_not_negative() {
        Some(operand)
    } else if sign.is_not_positive() {
        Some(graph.negate(operand))
    } else {
        None
    }
}

/// |xy| = |x||y|, with each factor's sign where it is known.
pub(super) fn absolute_of_product(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let operand = operand_of(graph, id, Function::Abs)?;
    let (coefficient, factors) = parts(graph, operand);
    if coefficient.is_one()
        && factors
            .iter()
            .all(|(factor, exponent)| (*factor, *exponent) == (operand, 1))
    {
        return None;
    }
    let mut changed = Vec::new();
    for (factor, exponent) in factors {
        let size = if exponent % 2 == 0 {
            factor
        } else {
            applied(graph, Function::Abs, factor)
        };
        changed.push((size, exponent));
    }
    Some(scaled(graph, coefficient.abs(), changed))
}

/// A size and its number or its sign in one product: |x| sign x is x, |x|/x is sign x. A divisor |x| stays beside the
/// sign of x, so that its inverse is that of other quotients by |x|.
pub(super) fn sign_by_size(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Abs])?;
    let power = |wanted: ExprId| {
        let found = factors.iter().find(|(factor, _)| *factor == wanted);
        found.map_or(0, |(_, exponent)| *exponent)
    };
    for (size, exponent) in &factors {
        let Some(number) = operand_of(graph, *size, Function::Abs) else {
            continue;
        };
        let step = exponent.signum();
        let beside = factors.iter().map(|(factor, _)| *factor);
        let known = beside
            .filter(|factor| signed(graph, *factor) == Some(number))
            .min();
        let sign = match known {
            Some(known) => known,
            // At 0 the quotient is no number, so that any sign will do.
            None => graph.apply(Function::Sign, [number].as_slice()),
        };
        let mut changed = factors.clone();
        if power(sign) % 2 != 0 && step > 0 {
            changed.extend([(*size, -step), (sign, -power(sign)), (number, step)]);
        } else if power(number) * step < 0 {
            changed.extend([(*size, -step), (number, step), (sign, 1)]);
        } else {
            continue;
        }
        return Some(product(graph, changed));
    }
    None
}

/// The sign of a product without the factors whose sign is known.
pub(super) fn sign_of_product(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    if let Some(operand) = operand_of(graph, id, Function::Side) {
        return side_of_multiple(graph, operand);
    }
    let operand = operand_of(graph, id, Function::Sign)?;
    let (coefficient, factors) = parts(graph, operand);
    let mut negative = coefficient.is_negative();
    let mut unknown = Vec::new();
    for (factor, exponent) in &factors {
        let sign = graph.sign(*factor);
        if exponent % 2 == 0 || sign.is_not_negative() {
            continue;
        }
        if sign.is_negative() {
            negative = !negative;
        } else {
            unknown.push((*factor, exponent.signum()));
        }
    }
    if coefficient.is_one() && *unknown == *factors || unknown.is_empty() {
        return None;
    }
    let left = product(graph, unknown);
    let sign = applied(graph, Function::Sign, left);
    Some(if negative { graph.negate(sign) } else { sign })
}

/// The side of a multiple without positive factors; a negative one changes what the side of 0 is.
fn side_of_multiple(graph: &mut Graph, operand: ExprId) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, operand);
    let unknown: Factors = factors
        .iter()
        .filter(|(factor, _)| !graph.sign(*factor).is_positive())
        .copied()
        .collect();
    if coefficient.is_unit() && unknown == factors || unknown.is_empty() {
        return None;
    }
    let left = scaled(graph, coefficient.signum(), unknown);
    Some(applied(graph, Function::Side, left))
}

pub(super) fn sign_of_known_sign(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let sign = graph.sign(signed(graph, id)?);
    if sign.is_not_negative() {
        Some(graph.one())
    } else if sign.is_negative() {
        Some(graph.integer(-1))
    } else {
        None
    }
}

/// What stands under a root is not negative wherever the product with that root is defined: beside √x, |x| is x, and the
/// sign of x is 1.
pub(super) fn root_bounds_operand(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sqrt])?;
    let roots = factors
        .iter()
        .filter_map(|(factor, _)| operand_of(graph, *factor, Function::Sqrt));
    let bounded: Vec<ExprId> = roots
        .filter_map(|radicand| not_negative_under_root(graph, radicand))
        .collect();
    let mut changed = Factors::new();
    for (factor, exponent) in &factors {
        let is_bounded = |inner: &ExprId| bounded.contains(inner);
        let size = operand_of(graph, *factor, Function::Abs).filter(is_bounded);
        match (size, signed(graph, *factor).filter(is_bounded)) {
            (Some(inner), _) => changed.push((inner, *exponent)),
            (None, Some(_)) => {}
            (None, None) => changed.push((*factor, *exponent)),
        }
    }
    (changed != factors).then(|| product(graph, changed))
}

/// The one factor of a radicand whose sign decides that of the radicand.
fn not_negative_under_root(graph: &Graph, radicand: ExprId) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, radicand);
    let mut deciding = factors.into_iter().filter(|(factor, exponent)| {
        // A factor that may be 0 would hide the sign of the others.
        !(graph.sign(*factor).is_positive() || exponent % 2 == 0 && !graph.sign(*factor).zero)
    });
    let (factor, exponent) = deciding.next()?;
    let alone = deciding.next().is_none() && exponent % 2 != 0;
    (alone && coefficient.is_positive()).then_some(factor)
}
