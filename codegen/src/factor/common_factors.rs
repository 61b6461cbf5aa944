//! Factors that several terms of a sum have, taken out: `a·b + a·c` is `a·(b + c)`, and a polynomial comes into Horner's form.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use rustc_hash::FxHashMap;
use smallvec::smallvec;

use super::extract::sorted;
use crate::budget::Budget;
use crate::circuit::{Circuit, Factors, Net, Operation};
use crate::graph::Rational;

/// A term of a sum, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Term {
    coefficient: Rational,
    /// By ascending handle.
    factors: Factors,
}

impl Term {
    /// Whether it takes a multiplication.
    fn is_multiplied(&self) -> bool {
        self.factors.iter().map(|(_, power)| power).sum::<u32>() > 1 || !self.coefficient.is_unit()
    }

    /// The place of a factor, or where it would be.
    fn place_of(&self, factor: Net) -> Result<usize, usize> {
        self.factors.binary_search_by_key(&factor, |(net, _)| *net)
    }

    fn multiply(&mut self, factor: Net, power: u32) {
        match self.place_of(factor) {
            Ok(place) => self.factors[place].1 += power,
            Err(place) => self.factors.insert(place, (factor, power)),
        }
    }

    fn divide(&mut self, factor: Net) {
        if let Ok(place) = self.place_of(factor) {
            if self.factors[place].1 > 1 {
                self.factors[place].1 -= 1;
            } else {
                self.factors.remove(place);
            }
        }
    }
}

/// Takes the factors that terms have in common out of every sum, those of products that others need too where `shared`.
pub(super) fn take_out(circuit: &mut Circuit, shared: bool, budget: &mut Budget) {
    budget.renew(circuit.nets().count());
    let uses = circuit.uses();
    for net in circuit.nets() {
        let Operation::Sum(terms) = circuit.operation(net) else {
            continue;
        };
        let terms = terms.iter().map(|(operand, coefficient)| {
            let factors = match circuit.operation(*operand) {
                Operation::Product(factors) if shared || uses[operand.index()] == 1 => {
                    factors.clone()
                }
                Operation::Number(value) if value.is_one() => Factors::new(),
                _ => smallvec![(*operand, 1)],
            };
            Term {
                coefficient: coefficient.clone(),
                factors,
            }
        });
        let mut level = Level::of(terms.collect(), budget);
        if level.best_factor().is_some() {
            let factored = factored(circuit, level, budget).into_iter();
            let terms = factored.map(|term| (product_of(circuit, &term), term.coefficient));
            let terms = sorted(terms.collect());
            circuit.replace(net, Operation::Sum(terms));
        }
    }
}

fn product_of(circuit: &mut Circuit, term: &Term) -> Net {
    circuit.product(term.factors.iter().copied())
}

/// The terms with common factors taken out, as long as that saves multiplications. A polynomial has as many levels as its
/// degree, so that they are kept on a stack.
fn factored(circuit: &mut Circuit, terms: Level, budget: &mut Budget) -> Vec<Term> {
    let mut outer: Vec<(Level, Net)> = Vec::new();
    let mut level = terms;
    loop {
        if let Some(factor) = level.best_factor() {
            let divided = level.divided(factor);
            if divided
                .iter()
                .all(|term| term.factors.iter().all(|(net, _)| *net == factor))
            {
                let inner = polynomial(circuit, factor, divided);
                level.push(product_with(circuit, factor, inner));
            } else {
                outer.push((level, factor));
                level = Level::of(divided, budget);
            }
            continue;
        }
        let inner = level.into_terms();
        let Some((above, factor)) = outer.pop() else {
            return inner;
        };
        level = above;
        level.push(product_with(circuit, factor, inner));
    }
}

/// What is left of a polynomial in one factor when it is taken out level by level: Horner's form, from within.
fn polynomial(circuit: &mut Circuit, factor: Net, terms: Vec<Term>) -> Vec<Term> {
    let power_of = |term: &Term| {
        term.place_of(factor)
            .map_or(0, |place| term.factors[place].1)
    };
    // A level goes on as long as two of its terms take a multiplication that is saved.
    let mut last_levels: Vec<u32> = terms
        .iter()
        .map(|term| power_of(term).saturating_sub(term.coefficient.is_unit().into()))
        .collect();
    last_levels.sort_unstable_by_key(|level| Reverse(*level));
    let last = last_levels.get(1).copied().unwrap_or(0);
    let mut levels: BTreeMap<u32, Vec<Term>> = BTreeMap::new();
    for mut term in terms {
        let power = power_of(&term);
        let level = power.min(last);
        term.factors.retain(|(net, _)| *net != factor);
        if power > level {
            term.multiply(factor, power - level);
        }
        levels.entry(level).or_default().push(term);
    }
    let mut inner: Vec<Term> = Vec::new();
    let mut above = last;
    for (level, mut terms) in levels.into_iter().rev() {
        if level < above {
            let mut taken_out = product_with(circuit, factor, inner);
            taken_out.multiply(factor, above - level - 1);
            terms.push(taken_out);
        }
        (inner, above) = (terms, level);
    }
    if above > 0 {
        let mut taken_out = product_with(circuit, factor, inner);
        taken_out.multiply(factor, above - 1);
        inner = vec![taken_out];
    }
    inner
        .iter_mut()
        .for_each(|term| term.factors.retain(|(_, power)| *power > 0));
    inner
}

/// A factor times a sum as one term.
fn product_with(circuit: &mut Circuit, factor: Net, mut inner: Vec<Term>) -> Term {
    let mut product = match inner.pop() {
        Some(single) if inner.is_empty() => single,
        last => {
            inner.extend(last);
            sum_of(circuit, inner)
        }
    };
    product.multiply(factor, 1);
    product
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
        factors: smallvec![(circuit.sum(terms), 1)],
        coefficient: content,
    }
}

/// The terms of a sum, with the factors that they have.
struct Level {
    /// In their order; `None` if a term was taken out.
    terms: Vec<Option<Term>>,
    /// For each factor its terms, and in how many that are left it costs a multiplication.
    factors: FxHashMap<Net, (Vec<usize>, usize)>,
    /// Each factor with every such count that it had, the most frequent first and of those the first.
    queue: BinaryHeap<(usize, Reverse<Net>)>,
}

impl Level {
    /// Terms whose factors are looked for, as far as the budget goes.
    fn of(terms: Vec<Term>, budget: &mut Budget) -> Self {
        let mut level = Self {
            terms: Vec::with_capacity(terms.len()),
            factors: FxHashMap::default(),
            queue: BinaryHeap::new(),
        };
        let looks = terms.iter().map(|term| term.factors.len()).sum();
        if budget.take(looks) {
            terms.into_iter().for_each(|term| level.enter(term));
            let counts = level.factors.iter();
            let several = counts.filter(|(_, (_, multiplied))| *multiplied > 1);
            level.queue = several
                .map(|(factor, (_, multiplied))| (*multiplied, Reverse(*factor)))
                .collect();
        } else {
            level.terms = terms.into_iter().map(Some).collect();
        }
        level
    }

    fn enter(&mut self, term: Term) {
        let multiplied = usize::from(term.is_multiplied());
        for (factor, _) in &term.factors {
            let (places, count) = self.factors.entry(*factor).or_default();
            places.push(self.terms.len());
            *count += multiplied;
        }
        self.terms.push(Some(term));
    }

    /// The factor that most terms share, if taking it out saves a multiplication.
    fn best_factor(&mut self) -> Option<Net> {
        while let Some((multiplied, Reverse(factor))) = self.queue.peek() {
            let known = self.factors.get(factor);
            if known.is_some_and(|(_, count)| count == multiplied) {
                return Some(*factor);
            }
            self.queue.pop();
        }
        None
    }

    /// Takes out the terms that have a factor, divided by it.
    fn divided(&mut self, factor: Net) -> Vec<Term> {
        let (places, _) = self.factors.remove(&factor).unwrap_or_default();
        let mut divided = Vec::new();
        for place in places {
            let Some(mut term) = self.terms[place].take() else {
                continue;
            };
            if term.is_multiplied() {
                for (other, _) in &term.factors {
                    self.count(*other, |count| count - 1);
                }
            }
            term.divide(factor);
            divided.push(term);
        }
        divided
    }

    /// Adds a term behind the others.
    fn push(&mut self, term: Term) {
        let factors: Vec<Net> = term.factors.iter().map(|(net, _)| *net).collect();
        self.enter(term);
        for factor in factors {
            self.count(factor, |count| count);
        }
    }

    fn count(&mut self, factor: Net, changed: impl Fn(usize) -> usize) {
        if let Some((_, count)) = self.factors.get_mut(&factor) {
            *count = changed(*count);
            if *count > 1 {
                self.queue.push((*count, Reverse(factor)));
            }
        }
    }

    fn into_terms(self) -> Vec<Term> {
        self.terms.into_iter().flatten().collect()
    }
}
