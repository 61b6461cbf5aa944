//! Terms at the points that differ in what stands still only: `a·t + b·t` becomes `(a + b)·t`.

use std::collections::{BTreeMap, BTreeSet};

use super::{Stage, split, stages};
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::{Rational, SymbolId};

/// Sums within sums at the points as one sum, so that a factor of the outer one comes to all terms.
pub fn opened(circuit: &Circuit, inner: &BTreeSet<SymbolId>) -> Circuit {
    let uses = circuit.uses();
    at_points(circuit, inner, |stages, images, terms| {
        let mut opened = Vec::new();
        let mut stack: Vec<_> = terms.iter().rev().cloned().collect();
        while let Some((operand, coefficient)) = stack.pop() {
            let own = uses[operand.index()] == 1 && stages[operand.index()] == Stage::Point;
            match circuit.operation(operand) {
                Operation::Sum(terms) if own && terms.len() > 1 => {
                    let terms = terms.iter().rev();
                    stack.extend(terms.map(|(net, inner)| (*net, inner * &coefficient)));
                }
                _ => opened.push((images[operand.index()], coefficient)),
            }
        }
        (opened, Vec::new())
    })
}

/// The terms that run along with the same values as one.
pub fn collected(circuit: &Circuit, inner: &BTreeSet<SymbolId>) -> Circuit {
    let uses = circuit.uses();
    at_points(circuit, inner, |stages, images, terms| {
        let image = |net: Net| images[net.index()];
        let mut alike: BTreeMap<Net, Vec<(Net, Rational)>> = BTreeMap::new();
        let mut others = Vec::new();
        for (operand, coefficient) in terms {
            let stage = |net: &Net| stages[net.index()];
            let factors = match circuit.operation(*operand) {
                Operation::Product(factors) if uses[operand.index()] == 1 => factors.as_slice(),
                _ => &[],
            };
            let parts = match factors {
                [(a, 1), (b, 1)] if stage(a).stands_still() && stage(b) == Stage::Along => {
                    Some((a, b))
                }
                [(b, 1), (a, 1)] if stage(a).stands_still() && stage(b) == Stage::Along => {
                    Some((a, b))
                }
                _ => None,
            };
            match parts {
                Some((fixed, along)) => alike
                    .entry(image(*along))
                    .or_default()
                    .push((image(*fixed), coefficient.clone())),
                None => others.push((image(*operand), coefficient.clone())),
            }
        }
        (others, alike.into_iter().collect())
    })
}

/// Terms as they are, and terms that have one factor in common.
type Terms = (Vec<(Net, Rational)>, Vec<(Net, Vec<(Net, Rational)>)>);

/// The circuit with the sums at its points rebuilt: from the stages and images of operations, and a sum's terms.
fn at_points(
    circuit: &Circuit,
    inner: &BTreeSet<SymbolId>,
    mut rebuilt: impl FnMut(&[Stage], &[Net], &[(Net, Rational)]) -> Terms,
) -> Circuit {
    let stages = stages(circuit, inner);
    let mut new = Circuit::default();
    let mut images: Vec<Net> = Vec::new();
    for net in circuit.nets() {
        let image = match circuit.operation(net) {
            Operation::Sum(terms) if stages[net.index()] == Stage::Point => {
                let (mut terms, common) = rebuilt(&stages, &images, terms);
                for (factor, parts) in common {
                    let sum = new.sum(parts);
                    terms.push((new.product([(sum, 1), (factor, 1)]), Rational::ONE));
                }
                new.sum(terms)
            }
            operation => {
                let operation = split::on_images(operation, |net| images[net.index()]);
                new.push(operation)
            }
        };
        if let Some(name) = circuit.suggested_name(net) {
            new.suggest_name(image, name);
        }
        images.push(image);
    }
    let outputs = circuit.outputs.iter();
    let outputs: Vec<Net> = outputs.map(|output| images[output.index()]).collect();
    // Without the sums that were opened, so that their terms have one use.
    split::part(&new, &outputs, &BTreeMap::new())
}
