//! Operations that repeat others: taking sums and products apart leaves parts that are equal, or multiples of each other,
//! though they are made of other operations, and differences of such parts that are zero.

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::smallvec;

use crate::circuit::{Circuit, Net, Operation};
use crate::fingerprint::{
    Fingerprint, Residue, drawn, inverse, is_zero, kind_of, kind_of_table, symbol_at,
};
use crate::graph::{Rational, ratio};

/// Makes operations with equal fingerprints one, up to a small rational factor where that takes fewer operations.
pub fn merge(circuit: &mut Circuit) {
    let mut values: Vec<Fingerprint> = Vec::with_capacity(circuit.nets().count());
    for net in circuit.nets() {
        values.push([0, 1].map(|point| value_at(circuit, net, point as u64, &values)));
    }
    let first: Vec<Residue> = values.iter().map(|value| value[0]).collect();
    let inverses = Residue::inverses(&first);
    let mut known: FxHashMap<Residue, Net> = FxHashMap::default();
    let mut as_dear = Vec::new();
    for net in circuit.nets() {
        let value = values[net.index()];
        if circuit.as_number(net).is_some() {
            continue;
        }
        if is_zero(value) {
            circuit.replace(net, Operation::Number(Rational::ZERO));
            continue;
        }
        // Multiples of each other have the same ratio of their values.
        let ratio_of_values = value[1].times(inverses[net.index()]);
        let earlier = *known.entry(ratio_of_values).or_insert(net);
        if earlier == net {
            continue;
        }
        let factor = value[0].times(inverses[earlier.index()]).as_fraction();
        let Some((numerator, denominator)) = factor else {
            continue;
        };
        let cost = circuit.cost_of(net).weight();
        let cost_of_multiple = usize::from(numerator.abs() != denominator);
        let multiple = Operation::Sum(smallvec![(earlier, ratio(numerator, denominator))]);
        if numerator != 0 && cost > cost_of_multiple {
            circuit.replace(net, multiple);
        } else if numerator != 0 && cost == cost_of_multiple {
            as_dear.push((net, earlier, multiple));
        }
    }
    replace_as_dear(circuit, as_dear);
    circuit.tidy();
}

/// Operations that cost as much as multiples of others are replaced where nothing else needs one of their operands: with
/// 2·x, y·(2·x), z·(2·x) and 4·x, y·(4·x), z·(4·x) the last three are 2·(y·(2·x)) and 2·(z·(2·x)).
fn replace_as_dear(circuit: &mut Circuit, mut as_dear: Vec<(Net, Net, Operation)>) {
    let uses = circuit.live_uses();
    // What nothing needs any more is not brought back.
    as_dear.retain(|(net, earlier, _)| uses[net.index()] > 0 && uses[earlier.index()] > 0);
    let kept: FxHashSet<Net> = as_dear.iter().map(|(_, earlier, _)| *earlier).collect();
    let mut replaced: FxHashMap<Net, usize> = FxHashMap::default();
    for (net, ..) in &as_dear {
        circuit.each_operand(*net, |operand| *replaced.entry(operand).or_default() += 1);
    }
    for (net, _, multiple) in as_dear {
        let mut is_freed = false;
        circuit.each_operand(net, |operand| {
            let is_alone =
                replaced.get(&operand) == Some(&uses[operand.index()]) && !kept.contains(&operand);
            is_freed |= is_alone && circuit.cost_of(operand).weight() > 0;
        });
        if is_freed {
            circuit.replace(net, multiple);
        }
    }
}

fn value_at(circuit: &Circuit, net: Net, point: u64, values: &[Fingerprint]) -> Residue {
    let value = |net: &Net| values[net.index()][point as usize];
    match circuit.operation(net) {
        Operation::Number(number) => Residue::rational(number),
        Operation::Symbol(symbol) => symbol_at(*symbol, point),
        Operation::Sum(terms) => terms.iter().fold(Residue::ZERO, |sum, (operand, factor)| {
            let factor = if factor.is_one() {
                Residue::ONE
            } else {
                Residue::rational(factor)
            };
            sum.plus(value(operand).times(factor))
        }),
        Operation::Product(factors) => factors.iter().fold(Residue::ONE, |product, (factor, n)| {
            product.times(value(factor).power(u64::from(*n)))
        }),
        Operation::Quotient(numerator, denominator) => {
            value(numerator).times(inverse(value(denominator), point))
        }
        Operation::Apply(function, operands) => {
            drawn(kind_of(*function), point, operands.iter().map(value))
        }
        Operation::Tabulated {
            table,
            order,
            argument,
        } => drawn(
            kind_of_table(*table, *order),
            point,
            [value(argument)].into_iter(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Graph, whole};

    #[test]
    fn a_multiple_is_found_and_a_difference_of_equals_is_zero() {
        let mut graph = Graph::new();
        let mut circuit = Circuit::default();
        let [a, b] = ["a", "b"].map(|name| {
            let symbol = graph.symbol_named(name);
            circuit.push(Operation::Symbol(symbol))
        });
        let sum = circuit.sum([(a, whole(1)), (b, whole(1))]);
        let squares = circuit.product([(sum, 2)]);
        let crossed = circuit.product([(a, 1), (b, 1)]);
        let parts = [circuit.product([(a, 2)]), circuit.product([(b, 2)])];
        let opened = circuit.sum([
            (parts[0], whole(3)),
            (parts[1], whole(3)),
            (crossed, whole(6)),
        ]);
        let nothing = circuit.sum([(opened, whole(1)), (squares, whole(-3))]);
        circuit.outputs = vec![squares, opened, nothing];
        merge(&mut circuit);
        assert_eq!(circuit.cost().operations(), 3);
        let zero = circuit.as_number(circuit.outputs[2]);
        assert_eq!(zero, Some(&Rational::ZERO));
    }
}
