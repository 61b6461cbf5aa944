//! Takes sums and products apart so that common parts are computed once.
//!
//! Each step is greedy; which order of steps is best depends on the formula, so that [`super::minimise`] tries several.

use std::collections::BTreeMap;

use smallvec::smallvec;

use super::circuit::{Circuit, Net, Operation, Terms};
use super::{coefficients, multiples, pairs, quotients, repeats};
use crate::graph::Rational;

/// One kind of extraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// `a·b + a·c` becomes `a·(b + c)`; of a polynomial, Horner's form.
    Factors,
    /// The same with products that are needed elsewhere too: a polynomial and its derivative each in Horner's form.
    SharedFactors,
    /// A product of two that several products share is computed once.
    Products,
    /// A sum of two that several sums share, up to a common factor, is computed once.
    Sums,
    /// `2a + 2b + c` becomes `2(a + b) + c`.
    Multiples,
    /// `2·(a·b)` becomes the product of 2, a and b, so that `2·a` can be shared.
    Coefficients,
    /// `2·(a + b)` becomes `2·a + 2·b`, so that `2·a` can be shared.
    Distribute,
}

/// The orders that are tried.
pub const ORDERS: [&[Step]; 12] = {
    use Step::{Coefficients, Distribute, Factors, Multiples, Products, SharedFactors, Sums};
    [
        &[Factors, Sums, Products, Multiples],
        &[Sums, Factors, Products, Sums, Multiples],
        &[Products, Factors, Sums, Products, Multiples],
        &[Products, Sums, Factors, Sums, Multiples],
        &[Sums, Products, Factors, Products, Multiples],
        &[Factors, Products, Sums, Multiples],
        &[SharedFactors, Sums, Products, Multiples],
        &[Factors, Sums, Coefficients, Products, Multiples],
        &[Sums, Factors, Coefficients, Products, Sums, Multiples],
        &[Coefficients, Products, Sums],
        &[Distribute, Coefficients, Products, Sums],
        &[Distribute, Sums, Coefficients, Products],
    ]
};

/// Runs the steps in order, then divides where an inverse turned out to be multiplied by once.
pub fn extract(circuit: &mut Circuit, steps: &[Step]) {
    for step in steps {
        match step {
            Step::Factors => factor_sums(circuit, false),
            Step::SharedFactors => factor_sums(circuit, true),
            Step::Products => pairs::share::<u32>(circuit),
            Step::Sums => pairs::share::<Rational>(circuit),
            Step::Multiples => gather_multiples(circuit),
            Step::Coefficients => coefficients::open(circuit),
            Step::Distribute => coefficients::distribute(circuit),
        }
        circuit.tidy();
    }
    repeats::merge(circuit);
    divide_by_lone_divisors(circuit);
    multiples::share(circuit);
    circuit.tidy();
    // A multiple of an inverse that has become its only user.
    divide_by_lone_divisors(circuit);
    circuit.tidy();
    quotients::share(circuit);
    circuit.tidy();
    multiples::share(circuit);
    circuit.tidy_by_inputs();
}

/// `a·(1/b)` where nothing else uses `1/b` becomes `a/b`, and `a·(1/b)·(1/c)` becomes `a/(b·c)`.
fn divide_by_lone_divisors(circuit: &mut Circuit) {
    let uses = circuit.uses();
    let lone_divisor = |circuit: &Circuit, net: Net| match circuit.operation(net) {
        Operation::Quotient(one, divisor) if uses[net.index()] == 1 => {
            circuit.as_number(*one)?.is_one().then_some(*divisor)
        }
        _ => None,
    };
    for net in circuit.nets() {
        let (coefficient, factors) = match circuit.operation(net).clone() {
            Operation::Product(factors) => (Rational::ONE, factors),
            Operation::Sum(terms) => match terms.as_slice() {
                [(operand, coefficient)] => (coefficient.clone(), smallvec![(*operand, 1)]),
                _ => {
                    divide_in_terms(circuit, net, terms, &lone_divisor);
                    continue;
                }
            },
            _ => continue,
        };
        let (mut numerator, mut denominator) = (Vec::new(), Vec::new());
        for (factor, power) in factors {
            match lone_divisor(circuit, factor) {
                Some(divisor) => denominator.push((divisor, power)),
                None => numerator.push((factor, power)),
            }
        }
        if denominator.is_empty() {
            continue;
        }
        let numerator = if coefficient.is_one() {
            circuit.product(numerator)
        } else {
            circuit.number(coefficient)
        };
        let denominator = circuit.product(denominator);
        circuit.replace(net, Operation::Quotient(numerator, denominator));
    }
}

/// `2·(1/a) + b` becomes `2/a + b`.
fn divide_in_terms(
    circuit: &mut Circuit,
    net: Net,
    mut terms: Terms,
    lone_divisor: &impl Fn(&Circuit, Net) -> Option<Net>,
) {
    let mut changed = false;
    for (operand, coefficient) in &mut terms {
        let multiple = !coefficient.is_unit();
        if let Some(divisor) = lone_divisor(circuit, *operand).filter(|_| multiple) {
            let numerator = circuit.number(coefficient.abs());
            *operand = circuit.push(Operation::Quotient(numerator, divisor));
            *coefficient = coefficient.signum();
            changed = true;
        }
    }
    if changed {
        circuit.replace(net, Operation::Sum(sorted(terms)));
    }
}

/// A term of a sum, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Term {
    coefficient: Rational,
    factors: BTreeMap<Net, u32>,
}

fn factor_sums(circuit: &mut Circuit, shared: bool) {
    let uses = circuit.uses();
    for net in circuit.nets() {
        let Operation::Sum(terms) = circuit.operation(net).clone() else {
            continue;
        };
        let terms: Vec<Term> = terms
            .into_iter()
            .map(|(operand, coefficient)| {
                let factors = match circuit.operation(operand) {
                    Operation::Product(factors) if shared || uses[operand.index()] == 1 => {
                        factors.iter().copied().collect()
                    }
                    Operation::Number(value) if value.is_one() => BTreeMap::new(),
                    _ => BTreeMap::from([(operand, 1)]),
                };
                Term {
                    coefficient,
                    factors,
                }
            })
            .collect();
        let factored = factored(circuit, terms.clone());
        if factored != terms {
            let terms = factored
                .into_iter()
                .map(|term| (product_of(circuit, &term), term.coefficient))
                .collect();
            circuit.replace(net, Operation::Sum(sorted(terms)));
        }
    }
}

pub(super) fn sorted(mut terms: Terms) -> Terms {
    terms.sort_by_key(|(net, _)| *net);
    terms
}

fn product_of(circuit: &mut Circuit, term: &Term) -> Net {
    circuit.product(term.factors.iter().map(|(net, power)| (*net, *power)))
}

/// The terms with common factors taken out, as long as that saves multiplications.
fn factored(circuit: &mut Circuit, mut terms: Vec<Term>) -> Vec<Term> {
    while let Some(factor) = best_factor(&terms) {
        let (with, mut rest): (Vec<Term>, Vec<Term>) = terms
            .into_iter()
            .partition(|term| term.factors.contains_key(&factor));
        let divided = with.into_iter().map(|mut term| {
            match term.factors.get_mut(&factor) {
                Some(power) if *power > 1 => *power -= 1,
                _ => {
                    term.factors.remove(&factor);
                }
            }
            term
        });
        let inner = factored(circuit, divided.collect());
        let mut taken_out = match inner.as_slice() {
            [single] => single.clone(),
            _ => sum_of(circuit, inner),
        };
        *taken_out.factors.entry(factor).or_insert(0) += 1;
        rest.push(taken_out);
        terms = rest;
    }
    terms
}

/// A sum as one term: its common rational factor in front.
fn sum_of(circuit: &mut Circuit, terms: Vec<Term>) -> Term {
    let first = terms
        .first()
        .map_or(Rational::ONE, |term| term.coefficient.clone());
    let common = terms
        .iter()
        .all(|term| term.coefficient.abs() == first.abs());
    let content = if common { first } else { first.signum() };
    let terms: Vec<_> = terms
        .into_iter()
        .map(|term| (product_of(circuit, &term), &term.coefficient / &content))
        .collect();
    Term {
        factors: BTreeMap::from([(circuit.sum(terms), 1)]),
        coefficient: content,
    }
}

/// The factor that most terms share, if taking it out saves a multiplication.
fn best_factor(terms: &[Term]) -> Option<Net> {
    // For each factor: in how many terms it is, and in how many of these it costs a multiplication.
    let mut counts: BTreeMap<Net, (usize, usize)> = BTreeMap::new();
    for term in terms {
        let multiplied = term.factors.values().sum::<u32>() > 1 || !term.coefficient.is_unit();
        for factor in term.factors.keys() {
            let count = counts.entry(*factor).or_insert((0, 0));
            count.0 += 1;
            count.1 += usize::from(multiplied);
        }
    }
    counts
        .into_iter()
        .filter(|(_, (count, multiplied))| *count >= 2 && *multiplied >= 2)
        .max_by_key(|(net, (_, multiplied))| (*multiplied, std::cmp::Reverse(*net)))
        .map(|(net, _)| net)
}

fn gather_multiples(circuit: &mut Circuit) {
    for net in circuit.nets() {
        let Operation::Sum(terms) = circuit.operation(net).clone() else {
            continue;
        };
        let mut groups: BTreeMap<Rational, Terms> = BTreeMap::new();
        let mut gathered = Terms::new();
        for (operand, coefficient) in terms {
            if coefficient.is_unit() || circuit.as_number(operand).is_some() {
                gathered.push((operand, coefficient));
            } else {
                groups
                    .entry(coefficient.abs())
                    .or_default()
                    .push((operand, coefficient));
            }
        }
        if groups.values().all(|group| group.len() < 2) {
            continue;
        }
        for (size, group) in groups {
            if group.len() < 2 {
                gathered.extend(group);
                continue;
            }
            let sign = group
                .first()
                .map_or(Rational::ONE, |(_, coefficient)| coefficient.signum());
            let scale = &size * &sign;
            let inner = circuit.sum(
                group
                    .into_iter()
                    .map(|(operand, coefficient)| (operand, coefficient / &scale)),
            );
            gathered.push((inner, scale));
        }
        circuit.replace(net, Operation::Sum(sorted(gathered)));
    }
}
