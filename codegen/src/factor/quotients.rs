//! Quotients made from other quotients: where `a/b` is computed, `a/(b·c)` is `(a/b)/c`, which saves a multiplication.

use rustc_hash::FxHashMap;
use smallvec::{SmallVec, smallvec};

use crate::budget::Budget;
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::rational;

/// What an operation is a product and quotient of, with exponents, by ascending handle.
type Factors = SmallVec<[(Net, i64); 4]>;

/// Divides what is computed already instead of multiplying divisors first. The circuit is tidy.
///
/// In a chain of products each has the factors of all before it: beyond the budget one stands for itself.
pub fn share(circuit: &mut Circuit, budget: &mut Budget) {
    budget.renew(circuit.nets().count());
    let quotients: Vec<(Net, [Net; 2])> = quotients_by_two(circuit);
    if quotients.is_empty() {
        return;
    }
    let mut factors: Vec<Factors> = Vec::new();
    for net in circuit.nets() {
        let of_net = factors_of(circuit, net, &factors);
        let is_affordable = budget.take(of_net.len());
        factors.push(if is_affordable {
            of_net
        } else {
            smallvec![(net, 1)]
        });
    }
    let mut known: FxHashMap<&Factors, Net> = FxHashMap::default();
    for net in circuit.nets() {
        known.entry(&factors[net.index()]).or_insert(net);
    }
    // As long as every operand comes before its users, what comes before an operation does not need it.
    let mut in_order = true;
    for (net, divisors) in quotients {
        let part = divisors.iter().find_map(|last| {
            let wanted = product(&[(&factors[net.index()], 1), (&factors[last.index()], 1)]);
            let part = *known.get(&wanted)?;
            // What is made from this quotient can't make it.
            let depends = !(in_order && part < net) && depends(circuit, part, net);
            (!depends).then_some((part, *last))
        });
        if let Some((part, last)) = part {
            in_order &= part < net;
            circuit.replace(net, Operation::Quotient(part, last));
        }
    }
}

/// The quotients by a product of two that nothing else needs, with the two.
fn quotients_by_two(circuit: &Circuit) -> Vec<(Net, [Net; 2])> {
    let uses = circuit.uses();
    let divisors = |net| {
        let Operation::Quotient(numerator, denominator) = circuit.operation(net) else {
            return None;
        };
        if uses[denominator.index()] != 1 || circuit.as_number(*numerator).is_some() {
            return None;
        }
        match circuit.operation(*denominator) {
            Operation::Product(divisors) => match divisors.as_slice() {
                [(first, 1), (second, 1)] => Some((net, [*first, *second])),
                _ => None,
            },
            _ => None,
        }
    };
    circuit.nets().filter_map(divisors).collect()
}

/// The product of powers.
fn product(powers: &[(&Factors, i64)]) -> Factors {
    let all = powers.iter().flat_map(|(factors, power)| {
        factors
            .iter()
            .map(move |(factor, exponent)| (*factor, exponent * power))
    });
    let mut product: Factors = all.collect();
    rational::collect(&mut product);
    product
}

/// The operation's factors, as far down as there are products and quotients, from those of the operations before it.
fn factors_of(circuit: &Circuit, net: Net, before: &[Factors]) -> Factors {
    let of = |part: &Net| &before[part.index()];
    match circuit.operation(net) {
        Operation::Number(value) if value.is_one() => Factors::new(),
        Operation::Product(parts) => {
            let powers = parts
                .iter()
                .map(|(part, power)| (of(part), i64::from(*power)));
            product(&powers.collect::<Vec<_>>())
        }
        Operation::Quotient(numerator, denominator) => {
            product(&[(of(numerator), 1), (of(denominator), -1)])
        }
        _ => smallvec![(net, 1)],
    }
}

/// Whether an operation needs another one.
fn depends(circuit: &Circuit, net: Net, on: Net) -> bool {
    let mut stack = vec![net];
    let mut seen = vec![false; circuit.nets().count()];
    while let Some(next) = stack.pop() {
        if next == on {
            return true;
        }
        if !std::mem::replace(&mut seen[next.index()], true) {
            circuit.each_operand(next, |operand| stack.push(operand));
        }
    }
    false
}
