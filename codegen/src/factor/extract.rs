//! Takes sums and products apart so that common parts are computed once.
//!
//! Each step is greedy; which order of steps is best depends on the formula, so that [`super::minimise`] tries several.

use std::collections::BTreeMap;

use smallvec::smallvec;

use super::passes::{Pass, Passes};
use super::{coefficients, common_factors, multiples, pairs, quotients, repeats};
use crate::budget::Budget;
use crate::circuit::{Circuit, Net, Operation, Terms};
use crate::graph::Rational;

/// One kind of extraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// `a·b + a·c` becomes `a·(b + c)`; of a polynomial, Horner's form.
    Factors,
    /// Takes common factors also out of products that other operations use, so that a polynomial and its derivative each
    /// come into Horner's form.
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
    extract_with(circuit, steps, Passes::ALL, &mut Budget::default());
}

/// Runs the steps as [`extract`] does, by the given passes alone and with a budget that counts the looks of all searches;
/// each search has its own.
pub fn extract_with(circuit: &mut Circuit, steps: &[Step], passes: Passes, budget: &mut Budget) {
    for step in steps.iter().filter(|step| passes.has(Pass::Step(**step))) {
        take(circuit, *step, budget);
    }
    finish(circuit, passes, budget);
}

/// Takes one step.
pub(super) fn take(circuit: &mut Circuit, step: Step, budget: &mut Budget) {
    match step {
        Step::Factors => common_factors::take_out(circuit, false, budget),
        Step::SharedFactors => common_factors::take_out(circuit, true, budget),
        Step::Products => pairs::share::<u32>(circuit, budget),
        Step::Sums => pairs::share::<Rational>(circuit, budget),
        Step::Multiples => gather_multiples(circuit),
        Step::Coefficients => coefficients::open(circuit),
        Step::Distribute => coefficients::distribute(circuit),
    }
    circuit.tidy();
}

/// What follows the last step of every order.
pub(super) fn finish(circuit: &mut Circuit, passes: Passes, budget: &mut Budget) {
    let mut run = |pass: Pass, change: fn(&mut Circuit, &mut Budget)| {
        if passes.has(pass) {
            change(circuit, budget);
        }
    };
    run(Pass::Repeats, |circuit, _| repeats::merge(circuit));
    run(Pass::SharedMultiples, |circuit, _| {
        multiples::share(circuit)
    });
    // After multiples are shared: one of them may have become an inverse's only user.
    run(Pass::LoneDivisors, |circuit, _| {
        circuit.tidy();
        divide_by_lone_divisors(circuit);
    });
    run(Pass::Quotients, |circuit, budget| {
        circuit.tidy();
        quotients::share(circuit, budget);
    });
    run(Pass::SharedMultiples, |circuit, _| {
        circuit.tidy();
        multiples::share(circuit);
    });
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

pub(super) fn sorted(mut terms: Terms) -> Terms {
    terms.sort_by_key(|(net, _)| *net);
    terms
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
