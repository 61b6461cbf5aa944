//! Takes sums and products apart so that common parts are computed once.
//!
//! Each step is greedy; which order of steps is best depends on the formula, so that [`super::minimise`] tries several.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::{One, Signed, Zero};

use super::circuit::{Circuit, Net, Operation};
use super::{coefficients, quotients, repeats};
use crate::graph::{Rational, rational};

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
            Step::Products => share_products(circuit),
            Step::Sums => share_sums(circuit),
            Step::Multiples => gather_multiples(circuit),
            Step::Coefficients => coefficients::open(circuit),
            Step::Distribute => coefficients::distribute(circuit),
        }
        circuit.tidy();
    }
    repeats::merge(circuit);
    divide_by_lone_divisors(circuit);
    share_multiples(circuit);
    circuit.tidy();
    // A multiple of an inverse that has become its only user.
    divide_by_lone_divisors(circuit);
    circuit.tidy();
    quotients::share(circuit);
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
            Operation::Product(factors) => (Rational::one(), factors),
            Operation::Sum(terms) => match terms.as_slice() {
                [(operand, coefficient)] => (coefficient.clone(), vec![(*operand, 1)]),
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
    mut terms: Vec<(Net, Rational)>,
    lone_divisor: &impl Fn(&Circuit, Net) -> Option<Net>,
) {
    let mut changed = false;
    for (operand, coefficient) in &mut terms {
        let multiple = !coefficient.abs().is_one();
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

/// A multiple that several sums have is computed once: `0.5·s − a`, `0.5·s − b`; and so is that of a factor which several
/// multiples of products have: `3·x·r`, `3·y·r`.
fn share_multiples(circuit: &mut Circuit) {
    let mut counts: BTreeMap<(Net, Rational), usize> = BTreeMap::new();
    let multiples = |circuit: &Circuit, net: Net| match circuit.operation(net) {
        Operation::Sum(terms) => terms.clone(),
        _ => Vec::new(),
    };
    let is_multiple = |circuit: &Circuit, operand: Net, coefficient: &Rational| {
        !coefficient.abs().is_one() && circuit.as_number(operand).is_none()
    };
    let uses = circuit.uses();
    for net in circuit.nets() {
        for (operand, coefficient) in multiples(circuit, net) {
            if !is_multiple(circuit, operand, &coefficient) {
                continue;
            }
            let mut count = |net: Net| {
                *counts.entry((net, coefficient.abs())).or_insert(0) += 1;
            };
            count(operand);
            if let Operation::Product(factors) = circuit.operation(operand)
                && uses[operand.index()] == 1
            {
                let simple = factors.iter().filter(|(_, power)| *power == 1);
                simple.for_each(|(factor, _)| count(*factor));
            }
        }
    }
    let shared = |operand: Net, coefficient: &Rational| {
        let key = (operand, coefficient.abs());
        counts
            .get(&key)
            .is_some_and(|count| *count > 1)
            .then_some(key)
    };
    for net in circuit.nets() {
        let mut terms = multiples(circuit, net);
        // A multiple by itself is what the others share; its negative is no multiplication of its own.
        let alone = terms.len() < 2 && terms.iter().all(|(_, q)| q.is_positive());
        for (operand, coefficient) in &mut terms {
            let of_sum = shared(*operand, coefficient).filter(|_| !alone);
            if let Some(key) = of_sum {
                *operand = circuit.push(Operation::Sum(vec![key]));
                *coefficient = coefficient.signum();
                continue;
            }
            // The multiple of a product is the product with that multiple of a factor.
            let Operation::Product(mut factors) = circuit.operation(*operand).clone() else {
                continue;
            };
            let of_factor = factors.iter_mut().find_map(|(factor, power)| {
                let key = shared(*factor, coefficient).filter(|_| *power == 1)?;
                Some((factor, key))
            });
            if let Some((factor, key)) = of_factor.filter(|_| uses[operand.index()] == 1) {
                *factor = circuit.push(Operation::Sum(vec![key]));
                *operand = circuit.product(factors);
                *coefficient = coefficient.signum();
            }
        }
        if !terms.is_empty() {
            circuit.replace(net, Operation::Sum(sorted(terms)));
        }
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
            let terms: Vec<_> = factored
                .into_iter()
                .map(|term| (product_of(circuit, &term), term.coefficient))
                .collect();
            circuit.replace(net, Operation::Sum(sorted(terms)));
        }
    }
}

fn sorted(mut terms: Vec<(Net, Rational)>) -> Vec<(Net, Rational)> {
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
        .map_or_else(Rational::one, |term| term.coefficient.clone());
    let common = terms
        .iter()
        .all(|term| term.coefficient.abs() == first.abs());
    let content = if common { first } else { first.signum() };
    let terms: Vec<_> = terms
        .into_iter()
        .map(|term| {
            (
                product_of(circuit, &term),
                rational::over(&term.coefficient, &content),
            )
        })
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
        let multiplied = term.factors.values().sum::<u32>() > 1 || !term.coefficient.abs().is_one();
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

/// Members of sums or products, and in which of them each pair stands.
struct Pairs<K> {
    counts: BTreeMap<K, usize>,
    places: BTreeMap<K, BTreeSet<Net>>,
}

impl<K: Ord + Clone> Pairs<K> {
    fn new() -> Self {
        Self {
            counts: BTreeMap::new(),
            places: BTreeMap::new(),
        }
    }

    fn add(&mut self, place: Net, pairs: &BTreeMap<K, usize>) {
        for (pair, count) in pairs {
            *self.counts.entry(pair.clone()).or_insert(0) += count;
            self.places.entry(pair.clone()).or_default().insert(place);
        }
    }

    fn remove(&mut self, place: Net, pairs: &BTreeMap<K, usize>) {
        for (pair, count) in pairs {
            if let Some(known) = self.counts.get_mut(pair) {
                *known -= count;
                if *known == 0 {
                    self.counts.remove(pair);
                }
            }
            if let Some(places) = self.places.get_mut(pair) {
                places.remove(&place);
            }
        }
    }

    /// The most frequent pair that occurs at least twice.
    fn best(&self) -> Option<(K, Vec<Net>)> {
        let (pair, _) = self
            .counts
            .iter()
            .filter(|(_, count)| **count >= 2)
            .max_by(|(left, a), (right, b)| a.cmp(b).then_with(|| right.cmp(left)))?;
        Some((
            pair.clone(),
            self.places
                .get(pair)
                .into_iter()
                .flatten()
                .copied()
                .collect(),
        ))
    }
}

fn factor_pairs(factors: &BTreeMap<Net, u32>) -> BTreeMap<(Net, Net), usize> {
    let mut pairs = BTreeMap::new();
    for (a, power_a) in factors {
        if *power_a >= 2 {
            pairs.insert((*a, *a), (*power_a / 2) as usize);
        }
        for (b, power_b) in
            factors.range((std::ops::Bound::Excluded(*a), std::ops::Bound::Unbounded))
        {
            pairs.insert((*a, *b), *power_a.min(power_b) as usize);
        }
    }
    pairs
}

fn share_products(circuit: &mut Circuit) {
    let mut members: BTreeMap<Net, BTreeMap<Net, u32>> = BTreeMap::new();
    let mut pairs = Pairs::new();
    for net in circuit.nets() {
        if let Operation::Product(factors) = circuit.operation(net) {
            let factors: BTreeMap<Net, u32> = factors.iter().copied().collect();
            pairs.add(net, &factor_pairs(&factors));
            members.insert(net, factors);
        }
    }
    while let Some(((a, b), places)) = pairs.best() {
        let shared = circuit.product([(a, 1), (b, 1)]);
        for place in places {
            let Some(factors) = members.get_mut(&place) else {
                continue;
            };
            pairs.remove(place, &factor_pairs(factors));
            if place == shared {
                // The shared product itself is not taken apart any further.
                members.remove(&place);
                continue;
            }
            take_pair(factors, a, b, shared);
            pairs.add(place, &factor_pairs(factors));
            let factors = factors.iter().map(|(net, power)| (*net, *power)).collect();
            circuit.replace(place, Operation::Product(factors));
        }
    }
}

/// Replaces a·b by one factor, as often as it occurs.
fn take_pair(factors: &mut BTreeMap<Net, u32>, a: Net, b: Net, shared: Net) {
    let available =
        |factors: &BTreeMap<Net, u32>, net: Net| factors.get(&net).copied().unwrap_or(0);
    let times = if a == b {
        available(factors, a) / 2
    } else {
        available(factors, a).min(available(factors, b))
    };
    for net in [a, b] {
        if let Some(power) = factors.get_mut(&net) {
            *power -= times;
        }
    }
    factors.retain(|_, power| *power > 0);
    *factors.entry(shared).or_insert(0) += times;
}

/// A pair of terms by their handles and the ratio of their coefficients.
type TermPair = (Net, Net, Rational);

fn term_pairs(terms: &BTreeMap<Net, Rational>) -> BTreeMap<TermPair, usize> {
    let mut pairs = BTreeMap::new();
    for (a, first) in terms {
        for (b, second) in terms.range((std::ops::Bound::Excluded(*a), std::ops::Bound::Unbounded))
        {
            pairs.insert((*a, *b, rational::over(second, first)), 1);
        }
    }
    pairs
}

fn share_sums(circuit: &mut Circuit) {
    let mut members: BTreeMap<Net, BTreeMap<Net, Rational>> = BTreeMap::new();
    let mut pairs = Pairs::new();
    for net in circuit.nets() {
        if let Operation::Sum(terms) = circuit.operation(net) {
            let terms: BTreeMap<Net, Rational> = terms.iter().cloned().collect();
            pairs.add(net, &term_pairs(&terms));
            members.insert(net, terms);
        }
    }
    while let Some(((a, b, ratio), places)) = pairs.best() {
        let shared = circuit.sum([(a, Rational::one()), (b, ratio)]);
        for place in places {
            let Some(terms) = members.get_mut(&place) else {
                continue;
            };
            pairs.remove(place, &term_pairs(terms));
            if place == shared {
                members.remove(&place);
                continue;
            }
            let Some(coefficient) = terms.remove(&a) else {
                continue;
            };
            terms.remove(&b);
            // The shared sum may be a term of this one already.
            let known = terms.remove(&shared).unwrap_or_else(Rational::zero);
            if coefficient != -&known {
                terms.insert(shared, coefficient + known);
            }
            pairs.add(place, &term_pairs(terms));
            circuit.replace(place, Operation::Sum(terms.clone().into_iter().collect()));
        }
    }
}

fn gather_multiples(circuit: &mut Circuit) {
    for net in circuit.nets() {
        let Operation::Sum(terms) = circuit.operation(net).clone() else {
            continue;
        };
        let mut groups: BTreeMap<Rational, Vec<(Net, Rational)>> = BTreeMap::new();
        let mut gathered = Vec::new();
        for (operand, coefficient) in terms {
            if coefficient.abs().is_one() || circuit.as_number(operand).is_some() {
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
                .map_or_else(Rational::one, |(_, coefficient)| coefficient.signum());
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
