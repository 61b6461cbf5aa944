//! Which operation belongs to which loop.
//!
//! Along an inner parameter most of a formula stands still. An operation that depends on the other parameters alone is
//! done once for all points, one that depends on the inner ones alone is done once for a table of their values, and only
//! those that depend on both are left for the loop over the points. How many are left is a matter of form: `k·√(a + b·t)`
//! has two operations more in its loop than `√(k²a + k²b·t)`. So factors that stand still are taken into roots
//! ([`absorb`]), sums and products are gathered by what they depend on ([`regroup`], [`terms`]), and the circuit with the fewest
//! operations at each point is chosen, among those that round no worse than the formula as its author wrote it.

pub mod absorb;
pub mod regroup;
pub mod split;
pub mod terms;

use std::collections::{BTreeMap, BTreeSet};

use crate::circuit::{Circuit, Net, Operation};
use crate::cost::Cost;
use crate::factor::extract::ORDERS;
use crate::factor::orders::Orders;
use crate::factor::passes::Passes;
use crate::factor::rounding::{Decisive, Reference, Written};
use crate::factor::{self, lower};
use crate::graph::{ExprId, Graph, SymbolId};
use crate::outputs::Outputs;
use crate::rewrite::{self, Form};
pub use split::{Staged, split};

/// What an operation depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// On nothing.
    Constant,
    /// On outer parameters alone: done once for all points.
    Fixed,
    /// On inner parameters alone: done once for each value of theirs.
    Along,
    /// On both: done at each point.
    Point,
}

impl Stage {
    /// The stage of an operation on operands of these stages.
    pub fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Constant, stage) | (stage, Self::Constant) => stage,
            (Self::Fixed, Self::Fixed) => Self::Fixed,
            (Self::Along, Self::Along) => Self::Along,
            _ => Self::Point,
        }
    }

    /// Whether it is done outside the loop over the points.
    pub fn stands_still(self) -> bool {
        matches!(self, Self::Constant | Self::Fixed)
    }
}

/// The stage of each operation of a circuit whose inner parameters are given.
pub fn stages(circuit: &Circuit, inner: &BTreeSet<SymbolId>) -> Vec<Stage> {
    let mut stages: Vec<Stage> = Vec::new();
    for net in circuit.nets() {
        let stage = match circuit.operation(net) {
            Operation::Symbol(symbol) if inner.contains(symbol) => Stage::Along,
            Operation::Symbol(_) => Stage::Fixed,
            _ => circuit
                .operands(net)
                .into_iter()
                .fold(Stage::Constant, |stage, operand| {
                    stage.with(stages[operand.index()])
                }),
        };
        stages.push(stage);
    }
    stages
}

/// Adds up the cost of the operations of one stage.
fn cost_of(circuit: &Circuit, inner: &BTreeSet<SymbolId>, stage: Stage) -> Cost {
    let stages = stages(circuit, inner);
    let of_stage = circuit.nets().filter(|net| stages[net.index()] == stage);
    of_stage.fold(Cost::default(), |cost, net| cost + circuit.cost_of(net))
}

/// The circuit of the outputs that has the fewest operations at each point, then the fewest of all, among those that round
/// no worse than the formula as its author wrote it.
pub fn minimise(
    graph: &Graph,
    outputs: &Outputs,
    written: &Written,
    inner: &BTreeSet<SymbolId>,
) -> Circuit {
    let all = outputs.all();
    if written.undoes_rounding || graph.is_exceeded() {
        return factor::minimise(graph, outputs, written).circuit;
    }
    let reference = Reference::beside(written, graph, &all);
    let forms = forms(graph, &all, inner).into_iter();
    let lowered = forms
        .filter(|(graph, _)| !graph.is_exceeded())
        .map(|(graph, roots)| lower::lower(&graph, &roots));
    let mut circuits = by_stages(lowered, inner);
    circuits.sort_by_cached_key(|circuit| {
        let points = cost_of(circuit, inner, Stage::Point).weight();
        (points, circuit.cost().weight())
    });
    let mut decisive = Decisive::default();
    let mut is_sound =
        |circuit: &Circuit| reference.fault_by(graph, circuit, &mut decisive).is_none();
    let sound = circuits.into_iter().find(|circuit| is_sound(circuit));
    sound.unwrap_or_else(|| factor::minimise(graph, outputs, written).circuit)
}

/// The forms in all orders of extraction, each gathered and collected by what its operations depend on.
fn by_stages(lowered: impl Iterator<Item = Circuit>, inner: &BTreeSet<SymbolId>) -> Vec<Circuit> {
    let mut orders = Orders::new(Passes::ALL);
    let mut forms: Vec<usize> = Vec::new();
    for form in lowered {
        // Many of the forms come to the same.
        let is_known = |known: &usize| orders.circuit(*known).is_same(&form);
        if !forms.iter().any(is_known) {
            forms.push(orders.place_of(form));
        }
    }
    let all: Vec<_> = ORDERS.into_iter().chain([&[][..]]).collect();
    let mut seen = BTreeSet::new();
    let mut circuits: Vec<Circuit> = Vec::new();
    for place in orders.extracted(&forms, &all) {
        if !seen.insert(place) {
            continue;
        }
        let circuit = orders.circuit(place);
        // What was gathered into another operation is not needed any more.
        let gathered = regroup::by_stage(circuit, inner);
        let opened = regroup::by_stage(&terms::opened(circuit, inner), inner);
        for circuit in [gathered, terms::collected(&opened, inner)] {
            let circuit = split::part(&circuit, &circuit.outputs, &BTreeMap::new());
            if !circuits.iter().any(|known| known.is_same(&circuit)) {
                circuits.push(circuit);
            }
        }
    }
    circuits
}

/// The outputs in every form that may turn out to leave the fewest operations at the points.
fn forms(graph: &Graph, roots: &[ExprId], inner: &BTreeSet<SymbolId>) -> Vec<Form> {
    let written = rewrite::rewrite(graph, roots);
    let mut forms = vec![written];
    rewrite::go_on(&mut forms, rewrite::common::take_out);
    rewrite::go_on(&mut forms, rewrite::roots::join);
    let absorbed = forms
        .iter()
        .map(|(graph, roots)| absorb::into_roots(graph, roots, inner));
    let absorbed: Vec<_> = absorbed.collect();
    forms.into_iter().chain(absorbed).collect()
}

/// The operations that the outputs of a circuit need, operands before their users.
fn reachable(circuit: &Circuit, outputs: &[Net]) -> Vec<Net> {
    let mut seen = BTreeSet::new();
    let mut stack = outputs.to_vec();
    while let Some(net) = stack.pop() {
        if seen.insert(net) {
            stack.extend(circuit.operands(net));
        }
    }
    seen.into_iter().collect()
}
