//! Rules of fractions: one division in place of several, and differences of fractions that lose no digits.

use std::collections::{BTreeMap, BTreeSet};

use super::rules::{factors_with, operand_of, parts, scaled};
use super::{applied, product, simplify};
use crate::fingerprint::{Residue, near};
use crate::graph::{ExprId, Factors, Function, Graph, Node, Rational, ratio};

/// √(a/b) is √(ab)/|b|: one division for it and for what else divides by b.
pub(super) fn root_of_quotient(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let radicand = operand_of(graph, id, Function::Sqrt)?;
    let (coefficient, factors) = parts(graph, radicand);
    if factors.iter().all(|(_, exponent)| *exponent > 0) {
        return None;
    }
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for (factor, exponent) in factors {
        if exponent < 0 {
            outside.push((applied(graph, Function::Abs, factor), exponent));
        }
        inside.push((factor, exponent.abs()));
    }
    let radicand = scaled(graph, coefficient, inside);
    outside.push((applied(graph, Function::Sqrt, radicand), 1));
    Some(product(graph, outside))
}

pub(super) fn inverse_root(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sqrt])?;
    let (position, radicand) =
        factors
            .iter()
            .enumerate()
            .find_map(|(position, (factor, exponent))| {
                let radicand =
                    operand_of(graph, *factor, Function::Sqrt).filter(|_| *exponent == -1)?;
                let fraction = parts(graph, radicand)
                    .1
                    .iter()
                    .any(|(_, exponent)| *exponent < 0);
                fraction.then_some((position, radicand))
            })?;
    let flipped = graph.power(radicand, -1);
    let mut changed = factors;
    changed[position] = (applied(graph, Function::Sqrt, flipped), 1);
    Some(product(graph, changed))
}

/// More denominators than this are not multiplied with each other: their product might leave the range of numbers.
const MOST_DENOMINATORS: i32 = 3;

/// The least common denominator of a sum's terms, and the sum times it; `None` if no term is a fraction.
fn common_denominator(graph: &mut Graph, sum: ExprId) -> Option<(Factors, ExprId)> {
    let Node::Sum(terms) = graph.node(sum).clone() else {
        return None;
    };
    let mut denominator: BTreeMap<ExprId, i32> = BTreeMap::new();
    for (term, _) in &terms {
        for (factor, exponent) in parts(graph, *term).1 {
            if exponent < 0 {
                let power = denominator.entry(factor).or_insert(0);
                *power = (*power).max(-exponent);
            }
        }
    }
    let degree: i32 = denominator.values().sum();
    if denominator.is_empty() || terms.len() < 2 || degree > MOST_DENOMINATORS {
        return None;
    }
    let denominator: Factors = denominator.into_iter().collect();
    let mut numerators = Vec::new();
    for (term, coefficient) in terms {
        let mut factors = denominator.clone();
        factors.push((term, 1));
        numerators.push((product(graph, factors), coefficient));
    }
    let numerator = graph.sum(numerators);
    Some((denominator, simplify(graph, numerator)))
}

/// Whether an expression, or what it is a multiple of, is a product with a divisor.
fn is_fraction(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Sum(terms) if terms.len() == 1 => is_fraction(graph, terms[0].0),
        Node::Product(factors) => factors.iter().any(|(_, exponent)| *exponent < 0),
        _ => false,
    }
}

pub(super) fn nested_fraction(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Product(factors) = graph.node(id) else {
        return None;
    };
    let is_nested = |(factor, exponent): &(ExprId, i32)| {
        *exponent < 0
            && match graph.node(*factor) {
                Node::Sum(terms) => terms.iter().any(|(term, _)| is_fraction(graph, *term)),
                _ => false,
            }
    };
    if !factors.iter().any(is_nested) {
        return None;
    }
    let factors = factors.clone();
    for (position, (factor, exponent)) in factors.iter().enumerate() {
        if *exponent < 0
            && let Some((denominator, numerator)) = common_denominator(graph, *factor)
        {
            let mut changed = factors.clone();
            changed[position] = (numerator, *exponent);
            changed.extend(
                denominator
                    .into_iter()
                    .map(|(factor, power)| (factor, -power * exponent)),
            );
            return joined(graph, changed);
        }
    }
    None
}

pub(super) fn nested_absolute_fraction(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Abs])?;
    for (position, (factor, exponent)) in factors.iter().enumerate() {
        let inner = operand_of(graph, *factor, Function::Abs).filter(|_| *exponent < 0);
        if let Some(inner) = inner
            && let Some((denominator, numerator)) = common_denominator(graph, inner)
        {
            let mut changed = factors.clone();
            changed[position] = (applied(graph, Function::Abs, numerator), *exponent);
            for (factor, power) in denominator {
                changed.push((applied(graph, Function::Abs, factor), -power * exponent));
            }
            return joined(graph, changed);
        }
    }
    None
}

/// Fractions of fractions are joined up to so many factors, powers counted as often: in a chain of quotients each of which stands
/// in the next they would double with every one.
const MOST_FACTORS: u32 = 16;

/// A product of fractions that were joined, where it is no longer than that.
fn joined(graph: &mut Graph, factors: Factors) -> Option<ExprId> {
    let id = product(graph, factors);
    let length =
        |factors: &[(ExprId, i32)]| factors.iter().map(|(_, n)| n.unsigned_abs()).sum::<u32>();
    (length(&parts(graph, id).1) <= MOST_FACTORS).then_some(id)
}

/// A product by its factors.
type Powers = BTreeMap<ExprId, i32>;

/// More terms than this are not tried together, and no sum of more as what they may cancel.
const MOST_TERMS: usize = 6;

/// How often two terms of one sum are looked at, and what a look at their quotients counts for: of a sum of many fractions
/// all pairs would take the square of their number. Thirty fractions are tried with each other.
const LOOKS: usize = 1 << 13;
const LOOKS_OF_QUOTIENTS: usize = 8;

/// Terms of more factors than so many each, beside some, are not looked at: they are not what an author wrote, but the
/// derivatives along a chain, whose products would grow with every step.
const FACTORS_PER_TERM: usize = 8;
const MORE_FACTORS: usize = 32;

/// Terms of a sum whose common denominator makes them cancel: 1/r − x²/(s·r) with s = x² + y is y/(s·r). As it stands it
/// is the difference of two nearly equal fractions where y is small beside x².
pub(super) fn cancelling_fractions(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Sum(terms) = graph.node(id).clone() else {
        return None;
    };
    let powers = powers_of_fractions(graph, &terms)?;
    let by_divisor = by_divisor(&powers);
    let mut looks = LOOKS;
    for (first, above) in powers.iter().enumerate() {
        let of_first = |factor: &ExprId| above.get(factor).copied().unwrap_or(0);
        for ((divisor, exponent), divided) in &by_divisor {
            let divisor = *divisor;
            looks = looks.checked_sub(1)?;
            // What some of the terms divide by once more than the first.
            if of_first(&divisor) != exponent + 1 {
                continue;
            }
            let Node::Sum(inner) = graph.node(divisor).clone() else {
                continue;
            };
            looks = looks.checked_sub(LOOKS_OF_QUOTIENTS + divided.len())?;
            // The first term is common · divisor, the others that divide by it are common · quotient.
            let mut common = above.clone();
            *common.entry(divisor).or_insert(0) -= 1;
            let quotients: Vec<(ExprId, Rational)> = divided
                .iter()
                .map(|position| {
                    (
                        over(graph, &powers[*position], &common),
                        terms[*position].1.clone(),
                    )
                })
                .collect();
            let Some((taken, numerator, scale)) =
                remainder(graph, &inner, &terms[first].1, &quotients)
            else {
                continue;
            };
            let taken: Vec<usize> = taken.into_iter().map(|place| divided[place]).collect();
            let rest = terms.iter().enumerate();
            let mut changed: Vec<_> = rest
                .filter(|(position, _)| *position != first && !taken.contains(position))
                .map(|(_, term)| term.clone())
                .collect();
            let mut factors: Vec<_> = common.into_iter().collect();
            factors.push((numerator, 1));
            changed.push((product(graph, factors), scale));
            return Some(graph.sum(changed));
        }
    }
    None
}

/// The terms by their factors; `None` if no term is a fraction, or where they are longer than what is looked at.
fn powers_of_fractions(graph: &Graph, terms: &[(ExprId, Rational)]) -> Option<Vec<Powers>> {
    let is_fraction = |(term, _): &(ExprId, Rational)| match graph.node(*term) {
        Node::Product(factors) => factors.iter().any(|(_, exponent)| *exponent < 0),
        _ => false,
    };
    if !terms.iter().any(is_fraction) {
        return None;
    }
    let powers = terms.iter().map(|(term, _)| parts(graph, *term).1);
    let powers: Vec<Powers> = powers
        .map(|factors| factors.into_iter().collect())
        .collect();
    let factors: usize = powers.iter().map(BTreeMap::len).sum();
    (factors <= MORE_FACTORS + FACTORS_PER_TERM * terms.len()).then_some(powers)
}

/// The divisors of the terms with their exponents, each with the positions of the terms.
fn by_divisor(powers: &[Powers]) -> BTreeMap<(ExprId, i32), Vec<usize>> {
    let mut by_divisor: BTreeMap<(ExprId, i32), Vec<usize>> = BTreeMap::new();
    for (position, powers) in powers.iter().enumerate() {
        for (factor, exponent) in powers.iter().filter(|(_, exponent)| **exponent < 0) {
            let positions = by_divisor.entry((*factor, *exponent)).or_default();
            positions.push(position);
        }
    }
    by_divisor
}

/// The quotient of two products.
fn over(graph: &mut Graph, powers: &Powers, divisor: &Powers) -> ExprId {
    let inverse = divisor
        .iter()
        .map(|(factor, exponent)| (*factor, -exponent));
    let powers = powers.iter().map(|(factor, exponent)| (*factor, *exponent));
    graph.product(powers.chain(inverse))
}

/// a·Σ inner plus some or all of the quotients where that is a shorter sum than the inner one, or a rational multiple of
/// one of its terms or of 1: which of the quotients, the sum, and a factor.
fn remainder(
    graph: &mut Graph,
    inner: &[(ExprId, Rational)],
    a: &Rational,
    quotients: &[(ExprId, Rational)],
) -> Option<(Vec<usize>, ExprId, Rational)> {
    for (place, (quotient, b)) in quotients.iter().enumerate() {
        let opposite = |(operand, q): &(ExprId, Rational)| operand == quotient && a * q == -b;
        if let Some(position) = inner.iter().position(opposite) {
            let mut left = inner.to_vec();
            left.remove(position);
            return Some((vec![place], graph.sum(left), a.clone()));
        }
    }
    if quotients.len() > MOST_TERMS
        || inner.len() > MOST_TERMS
        || !are_alike(graph, inner, quotients)
    {
        return None;
    }
    let multiplied = inner.iter().map(|(operand, q)| (*operand, a * q));
    let difference = graph.sum(multiplied.chain(quotients.iter().cloned()));
    let candidates: Vec<ExprId> = inner.iter().map(|(operand, _)| *operand).collect();
    let one = graph.one();
    let (candidate, scale) =
        rational_multiple(graph, difference, &[candidates, vec![one]].concat())?;
    Some(((0..quotients.len()).collect(), candidate, scale))
}

/// Whether the quotients are polynomials in what the terms of a sum are made of, so that they may cancel; a look that is
/// cheap beside that at the values.
fn are_alike(
    graph: &Graph,
    inner: &[(ExprId, Rational)],
    quotients: &[(ExprId, Rational)],
) -> bool {
    let atoms: BTreeSet<ExprId> = inner
        .iter()
        .flat_map(|(operand, _)| parts(graph, *operand).1)
        .map(|(factor, _)| factor)
        .chain([graph.one()])
        .collect();
    let is_made_of_them = |id: ExprId| {
        let factors = parts(graph, id).1;
        factors.iter().all(|(factor, _)| atoms.contains(factor))
    };
    quotients.iter().all(|(quotient, _)| {
        let factors = parts(graph, *quotient).1;
        factors.into_iter().all(|(factor, exponent)| {
            let terms = match graph.node(factor) {
                Node::Sum(terms) => terms.iter().all(|(term, _)| is_made_of_them(*term)),
                _ => false,
            };
            exponent > 0 && (terms || atoms.contains(&factor))
        })
    })
}

/// How deep the terms of a difference are looked into.
const DEPTH: usize = 6;

/// The first candidate that an expression is a rational multiple of, as told by their values in a prime field.
fn rational_multiple(
    graph: &Graph,
    of: ExprId,
    candidates: &[ExprId],
) -> Option<(ExprId, Rational)> {
    let roots: Vec<ExprId> = [&[of], candidates].concat();
    let ratios = |point: u64| -> Vec<Residue> {
        let at = near(graph, &roots, DEPTH, point);
        let inverses = Residue::inverses(&at[1..]).into_iter();
        inverses.map(|inverse| at[0].times(inverse)).collect()
    };
    let first = ratios(0);
    // Most expressions are no multiple at one point already.
    let mut second = None;
    candidates
        .iter()
        .zip(&first)
        .enumerate()
        .find_map(|(place, (candidate, found))| {
            let (n, d) = found.as_fraction().filter(|_| *found != Residue::ZERO)?;
            let again = second.get_or_insert_with(|| ratios(1))[place];
            (again == *found).then(|| (*candidate, ratio(n, d)))
        })
}
