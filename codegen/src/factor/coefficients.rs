//! Coefficients as factors: `2·(a·b)` as the product of 2, a and b, so that `2·a` is shared as any other product is.

use smallvec::smallvec;

use crate::circuit::{Circuit, Net, Operation};
use crate::graph::Rational;

/// Puts the sizes of coefficients into the products that they multiply. Signs stay: they are free.
///
/// A product that is also used without a coefficient stays as it is, and is one factor of the multiple.
pub fn open(circuit: &mut Circuit) {
    let multiples = multiples_of(circuit);
    let uses = circuit.uses();
    for net in circuit.nets() {
        let Operation::Sum(mut terms) = circuit.operation(net).clone() else {
            continue;
        };
        for (operand, coefficient) in &mut terms {
            if is_multiple(circuit, *operand, coefficient) {
                let only_multiples = multiples[operand.index()] == uses[operand.index()];
                *operand = product(circuit, *operand, coefficient.abs(), only_multiples);
                *coefficient = coefficient.signum();
            }
        }
        let sum = circuit.sum(terms);
        let operation = match circuit.operation(sum) {
            Operation::Sum(terms) => Operation::Sum(terms.clone()),
            // A sum of one positive multiple has become that product.
            _ => Operation::Sum(smallvec![(sum, Rational::ONE)]),
        };
        circuit.replace(net, operation);
    }
}

/// `2·(a + b)` becomes `2·a + 2·b` where the sum is needed for nothing but its multiples. It is the opposite of
/// [`super::extract::Step::Multiples`], and pays where `2·a` is computed anyway.
///
/// Only for powers of two: then it changes no rounding.
pub fn distribute(circuit: &mut Circuit) {
    let multiples = multiples_of(circuit);
    let uses = circuit.uses();
    for net in circuit.nets() {
        let Operation::Sum(terms) = circuit.operation(net).clone() else {
            continue;
        };
        let mut distributed = Vec::new();
        for (operand, coefficient) in terms {
            let whole = multiples[operand.index()] == uses[operand.index()];
            match circuit.operation(operand) {
                Operation::Sum(inner) if whole && is_power_of_two(&coefficient) => {
                    let scaled = inner
                        .iter()
                        .map(|(inner, size)| (*inner, size * &coefficient));
                    distributed.extend(scaled);
                }
                _ => distributed.push((operand, coefficient)),
            }
        }
        let sum = circuit.sum(distributed);
        let operation = match circuit.operation(sum) {
            Operation::Sum(terms) => Operation::Sum(terms.clone()),
            _ => Operation::Sum(smallvec![(sum, Rational::ONE)]),
        };
        circuit.replace(net, operation);
    }
}

fn is_power_of_two(value: &Rational) -> bool {
    let is_power = |number: &num_bigint::BigInt| number.magnitude().count_ones() == 1;
    !value.is_unit() && is_power(&value.numerator()) && is_power(&value.denominator())
}

fn is_multiple(circuit: &Circuit, operand: Net, coefficient: &Rational) -> bool {
    !coefficient.is_unit() && circuit.as_number(operand).is_none()
}

/// For each operation, in how many places it has a coefficient.
fn multiples_of(circuit: &Circuit) -> Vec<usize> {
    let mut counts = vec![0; circuit.nets().count()];
    for net in circuit.nets() {
        if let Operation::Sum(terms) = circuit.operation(net) {
            for (operand, coefficient) in terms {
                counts[operand.index()] += usize::from(is_multiple(circuit, *operand, coefficient));
            }
        }
    }
    counts
}

/// The operand times a size: its factors with the size among them where `open` is set, else itself as one factor.
fn product(circuit: &mut Circuit, operand: Net, size: Rational, open: bool) -> Net {
    let mut factors = match circuit.operation(operand) {
        Operation::Product(factors) if open => factors.clone(),
        _ => smallvec![(operand, 1)],
    };
    let mut size = size;
    // A number among the factors is one with the size.
    factors.retain(|(factor, power)| match circuit.as_number(*factor) {
        Some(value) => {
            size *= &value.pow(power.cast_signed());
            false
        }
        None => true,
    });
    let number = circuit.number(size);
    factors.push((number, 1));
    circuit.product(factors)
}
