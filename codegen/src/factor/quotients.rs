//! Quotients made from other quotients: where `a/b` is computed, `a/(b·c)` is `(a/b)/c`, which saves a multiplication.

use std::collections::BTreeMap;

use num_traits::One;

use super::circuit::{Circuit, Net, Operation};

/// What an operation is a product and quotient of, with exponents.
type Factors = BTreeMap<Net, i64>;

/// Divides what is computed already instead of multiplying divisors first.
pub fn share(circuit: &mut Circuit) {
    let uses = circuit.uses();
    let factors: Vec<Factors> = circuit.nets().map(|net| factors_of(circuit, net)).collect();
    let mut known: BTreeMap<&Factors, Net> = BTreeMap::new();
    for net in circuit.nets() {
        known.entry(&factors[net.index()]).or_insert(net);
    }
    for net in circuit.nets() {
        let Operation::Quotient(numerator, denominator) = *circuit.operation(net) else {
            continue;
        };
        let Operation::Product(divisors) = circuit.operation(denominator).clone() else {
            continue;
        };
        let simple = divisors.iter().all(|(_, power)| *power == 1);
        if uses[denominator.index()] != 1 || circuit.as_number(numerator).is_some() || !simple {
            continue;
        }
        let part = divisors.iter().find_map(|(last, _)| {
            let mut wanted = factors[net.index()].clone();
            add(&mut wanted, &factors[last.index()], 1);
            let part = *known.get(&wanted)?;
            // What is made from this quotient can't make it.
            (!depends(circuit, part, net)).then_some((part, *last))
        });
        if let Some((part, last)) = part.filter(|_| divisors.len() == 2) {
            circuit.replace(net, Operation::Quotient(part, last));
        }
    }
}

fn add(factors: &mut Factors, more: &Factors, times: i64) {
    for (factor, exponent) in more {
        *factors.entry(*factor).or_insert(0) += exponent * times;
    }
    factors.retain(|_, exponent| *exponent != 0);
}

/// The operation's factors, as far down as there are products and quotients.
fn factors_of(circuit: &Circuit, net: Net) -> Factors {
    let mut factors = Factors::new();
    match circuit.operation(net) {
        Operation::Number(value) if value.is_one() => {}
        Operation::Product(parts) => {
            for (part, power) in parts {
                add(&mut factors, &factors_of(circuit, *part), i64::from(*power));
            }
        }
        Operation::Quotient(numerator, denominator) => {
            add(&mut factors, &factors_of(circuit, *numerator), 1);
            add(&mut factors, &factors_of(circuit, *denominator), -1);
        }
        _ => {
            factors.insert(net, 1);
        }
    }
    factors
}

/// Whether an operation needs another one.
fn depends(circuit: &Circuit, net: Net, on: Net) -> bool {
    let mut stack = vec![net];
    let mut seen = std::collections::BTreeSet::new();
    while let Some(next) = stack.pop() {
        if next == on {
            return true;
        }
        if seen.insert(next) {
            stack.extend(circuit.operands(next));
        }
    }
    false
}
