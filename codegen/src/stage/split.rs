//! A circuit cut into the three that its loops run.

use std::collections::{BTreeMap, BTreeSet};

use super::{Stage, reachable, stages};
use crate::circuit::{Circuit, Factors, Net, Operation, Terms};
use crate::graph::{Graph, SymbolId};

/// Three circuits in the place of one: what stands still, what runs along the inner parameters, and what is left for the
/// points, which takes the results of the other two as its symbols.
#[derive(Clone, Debug)]
pub struct Staged {
    /// The symbols of all three, and their tables.
    pub graph: Graph,
    /// What depends on outer parameters alone.
    pub fixed: Circuit,
    /// Its results, as the points' circuit calls them.
    pub fixed_symbols: Vec<SymbolId>,
    /// What depends on inner parameters alone.
    pub along: Circuit,
    /// Its results, as the points' circuit calls them.
    pub along_symbols: Vec<SymbolId>,
    /// What depends on both, with the outputs of the whole.
    pub points: Circuit,
}

/// Cuts a circuit.
pub fn split(graph: &Graph, circuit: &Circuit, inner: &BTreeSet<SymbolId>) -> Staged {
    let stages = stages(circuit, inner);
    let (mut fixed, mut along) = (BTreeSet::new(), BTreeSet::new());
    let mut cut = |net: Net| match stages[net.index()] {
        Stage::Fixed => fixed.insert(net),
        Stage::Along => along.insert(net),
        Stage::Constant | Stage::Point => false,
    };
    for net in reachable(circuit, &circuit.outputs) {
        if stages[net.index()] == Stage::Point {
            for operand in circuit.operands(net) {
                cut(operand);
            }
        }
    }
    for output in &circuit.outputs {
        cut(*output);
    }
    let mut graph = graph.clone();
    let mut symbols = |nets: &BTreeSet<Net>, kind: &str| -> Vec<SymbolId> {
        let names = nets.iter().enumerate().map(|(position, net)| {
            let given = circuit.suggested_name(*net).map(ToOwned::to_owned);
            given.unwrap_or_else(|| format!("{kind}_{}", position + 1))
        });
        let names: Vec<String> = names.collect();
        names
            .iter()
            .map(|name| new_symbol(&mut graph, name))
            .collect()
    };
    let fixed_symbols = symbols(&fixed, "fixed");
    let along_symbols = symbols(&along, "along");
    let (fixed, along): (Vec<_>, Vec<_>) =
        (fixed.into_iter().collect(), along.into_iter().collect());
    let nets = fixed.iter().chain(&along).copied();
    let names = fixed_symbols.iter().chain(&along_symbols).copied();
    let replaced: BTreeMap<Net, SymbolId> = nets.zip(names).collect();
    Staged {
        fixed: part(circuit, &fixed, &BTreeMap::new()),
        along: part(circuit, &along, &BTreeMap::new()),
        points: part(circuit, &circuit.outputs, &replaced),
        graph,
        fixed_symbols,
        along_symbols,
    }
}

/// A symbol that the graph does not have yet.
fn new_symbol(graph: &mut Graph, wish: &str) -> SymbolId {
    let mut name = wish.to_owned();
    while graph.find_symbol(&name).is_some() {
        name.push('_');
    }
    graph.symbol_named(&name)
}

/// The part of a circuit that gives these outputs, with symbols in the place of some operations.
pub(super) fn part(
    circuit: &Circuit,
    outputs: &[Net],
    replaced: &BTreeMap<Net, SymbolId>,
) -> Circuit {
    let mut part = Circuit::default();
    let mut images: BTreeMap<Net, Net> = BTreeMap::new();
    for net in needed(circuit, outputs, replaced) {
        let operation = match replaced.get(&net) {
            Some(symbol) => Operation::Symbol(*symbol),
            // Operands come before their users, so that each has its image.
            None => on_images(circuit.operation(net), |operand| {
                images.get(&operand).copied().unwrap_or(operand)
            }),
        };
        let image = part.push(operation);
        if let Some(name) = circuit
            .suggested_name(net)
            .filter(|_| !replaced.contains_key(&net))
        {
            part.suggest_name(image, name);
        }
        images.insert(net, image);
    }
    let outputs = outputs.iter().filter_map(|net| images.get(net)).copied();
    part.outputs = outputs.collect();
    part
}

/// What the outputs need, down to what is replaced.
fn needed(circuit: &Circuit, outputs: &[Net], replaced: &BTreeMap<Net, SymbolId>) -> BTreeSet<Net> {
    let mut needed = BTreeSet::new();
    let mut stack = outputs.to_vec();
    while let Some(net) = stack.pop() {
        if needed.insert(net) && !replaced.contains_key(&net) {
            stack.extend(circuit.operands(net));
        }
    }
    needed
}

/// The operation on other operands.
pub(super) fn on_images(operation: &Operation, image: impl Fn(Net) -> Net) -> Operation {
    let image = |net: &Net| image(*net);
    match operation {
        Operation::Sum(terms) => {
            let mut terms: Terms = terms
                .iter()
                .map(|(operand, coefficient)| (image(operand), coefficient.clone()))
                .collect();
            terms.sort_by_key(|(net, _)| *net);
            Operation::Sum(terms)
        }
        Operation::Product(factors) => {
            let mut factors: Factors = factors
                .iter()
                .map(|(operand, power)| (image(operand), *power))
                .collect();
            factors.sort();
            Operation::Product(factors)
        }
        Operation::Quotient(numerator, denominator) => {
            Operation::Quotient(image(numerator), image(denominator))
        }
        Operation::Apply(function, operands) => {
            Operation::Apply(*function, operands.iter().map(image).collect())
        }
        Operation::Tabulated {
            table,
            order,
            argument,
        } => Operation::Tabulated {
            table: *table,
            order: *order,
            argument: image(argument),
        },
        leaf => leaf.clone(),
    }
}
