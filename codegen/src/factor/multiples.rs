//! Multiples that several operations have.

use rustc_hash::FxHashMap;
use smallvec::smallvec;

use super::extract::sorted;
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::Rational;

/// What a multiple is of, and by what magnitude.
type Key = (Net, Rational);

/// A multiple that several sums have is computed once: `0.5·s − a`, `0.5·s − b`; and so is that of a factor, or of a
/// numerator, which several multiples have: `3·x·r`, `3·y·r`, `3·(r/z)`.
pub fn share(circuit: &mut Circuit) {
    let multiples = Multiples::of(circuit);
    for net in circuit.nets() {
        let Operation::Sum(mut terms) = circuit.operation(net).clone() else {
            continue;
        };
        // A multiple by itself is what the others share; its negative is no multiplication of its own.
        let alone = terms.len() < 2 && terms.iter().all(|(_, q)| q.is_positive());
        for (operand, coefficient) in &mut terms {
            let whole = multiples.shared(*operand, coefficient);
            let shared = match whole.filter(|_| !alone) {
                Some(key) => Some(circuit.push(Operation::Sum(smallvec![key]))),
                None => multiples.of_a_part(circuit, *operand, coefficient),
            };
            if let Some(shared) = shared {
                *operand = shared;
                *coefficient = coefficient.signum();
            }
        }
        circuit.replace(net, Operation::Sum(sorted(terms)));
    }
}

/// How often there are which multiples in a circuit.
struct Multiples {
    counts: FxHashMap<Key, usize>,
    /// How often what the results need uses each operation.
    uses: Vec<usize>,
}

impl Multiples {
    fn of(circuit: &Circuit) -> Self {
        let uses = circuit.live_uses();
        let mut counts: FxHashMap<Key, usize> = FxHashMap::default();
        for net in circuit.nets() {
            let Operation::Sum(terms) = circuit.operation(net) else {
                continue;
            };
            let is_multiple =
                |(operand, q): &&Key| !q.is_unit() && circuit.as_number(*operand).is_none();
            for (operand, coefficient) in terms.iter().filter(is_multiple) {
                let mut count = |net: Net| {
                    *counts.entry((net, coefficient.abs())).or_insert(0) += 1;
                };
                count(*operand);
                match circuit.operation(*operand) {
                    Operation::Product(factors) if uses[operand.index()] == 1 => {
                        let simple = factors.iter().filter(|(_, power)| *power == 1);
                        simple.for_each(|(factor, _)| count(*factor));
                    }
                    Operation::Quotient(numerator, _) if uses[operand.index()] == 1 => {
                        count(*numerator);
                    }
                    _ => {}
                }
            }
        }
        Self { counts, uses }
    }

    /// A multiple, if several operations have it.
    fn shared(&self, operand: Net, coefficient: &Rational) -> Option<Key> {
        let key = (operand, coefficient.abs());
        let count = self.counts.get(&key);
        count.is_some_and(|count| *count > 1).then_some(key)
    }

    /// The multiple of an operation that nothing else uses, made with that of a part which others have too: of a product
    /// with that of a factor, of a quotient with that of its numerator.
    fn of_a_part(
        &self,
        circuit: &mut Circuit,
        operand: Net,
        coefficient: &Rational,
    ) -> Option<Net> {
        if self.uses[operand.index()] != 1 {
            return None;
        }
        match circuit.operation(operand).clone() {
            Operation::Product(mut factors) => {
                let mut simple = factors.iter_mut().filter(|(_, power)| *power == 1);
                let (factor, key) = simple.find_map(|(factor, _)| {
                    let key = self.shared(*factor, coefficient)?;
                    Some((factor, key))
                })?;
                *factor = circuit.push(Operation::Sum(smallvec![key]));
                Some(circuit.product(factors))
            }
            Operation::Quotient(numerator, denominator) => {
                let key = self.shared(numerator, coefficient)?;
                let numerator = circuit.push(Operation::Sum(smallvec![key]));
                Some(circuit.push(Operation::Quotient(numerator, denominator)))
            }
            _ => None,
        }
    }
}
