//! Fewest operations over a value and all derivatives that are asked for, together.
//!
//! First identities that hold between expressions are found by their fingerprints (their values at random points of a
//! prime field): equal expressions become one ([`identities`]), and a homogeneous function is rebuilt from its partials
//! by Euler's relation ([`homogeneous`]). Then the graph is lowered to a [`circuit::Circuit`], in which sums and
//! products are taken apart into shared ones by several orders of extraction ([`extract`]), and the cheapest is kept of
//! those that lose no digits ([`rounding`]).

pub mod circuit;
pub mod coefficients;
pub mod extract;
pub mod fingerprint;
pub mod homogeneous;
pub mod identities;
pub mod lower;
pub mod quotients;
pub mod rounding;

use crate::factor::circuit::Circuit;
use crate::factor::extract::ORDERS;
use crate::factor::rounding::Reference;
use crate::graph::{ExprId, Graph, SymbolId};
use crate::rewrite;

/// The numbers that one generated function gives.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// The values.
    pub values: Vec<ExprId>,
    /// The symbols that the gradient is by.
    pub by: Vec<SymbolId>,
    /// For each value its partials by those symbols.
    pub gradients: Vec<Vec<ExprId>>,
    /// For each value the upper triangle of its second partials, by rows.
    pub hessians: Vec<Vec<ExprId>>,
}

impl Outputs {
    /// All numbers in order.
    pub fn all(&self) -> Vec<ExprId> {
        let gradients = self.gradients.iter().flatten();
        let hessians = self.hessians.iter().flatten();
        self.values
            .iter()
            .chain(gradients)
            .chain(hessians)
            .copied()
            .collect()
    }

    /// The same with other numbers, in order.
    pub fn with_all(&self, all: &[ExprId]) -> Self {
        let mut all = all.iter().copied();
        let mut take =
            |old: &Vec<ExprId>| -> Vec<ExprId> { all.by_ref().take(old.len()).collect() };
        Self {
            values: take(&self.values),
            by: self.by.clone(),
            gradients: self.gradients.iter().map(&mut take).collect(),
            hessians: self.hessians.iter().map(&mut take).collect(),
        }
    }
}

/// The circuit with the fewest operations that was found for these outputs, among those that round no worse than the
/// formula as its author wrote it.
pub fn minimise(graph: &Graph, outputs: &Outputs) -> Circuit {
    let all = outputs.all();
    let tables = graph;
    let reference = Reference::of(graph, &all);
    let merged = identities::merge(graph, &all);
    let as_written = rewrite::rewrite(graph, &all);
    // What has become equal may cancel now.
    let merged = rewrite::rewrite(&merged.0, &merged.1);
    for (graph, roots) in [merged, as_written] {
        let mut circuits = Vec::new();
        for lowered in lowered_forms(graph, roots, outputs) {
            circuits.extend(ORDERS.iter().map(|order| {
                let mut circuit = lowered.clone();
                extract::extract(&mut circuit, order);
                circuit
            }));
        }
        circuits.sort_by_key(|circuit| circuit.cost().weight());
        let mut sound = circuits.into_iter();
        if let Some(circuit) = sound.find(|circuit| reference.admits(tables, circuit)) {
            return circuit;
        }
    }
    lower::lower(graph, &all)
}

/// The outputs in every form that may turn out to be cheapest, each once.
fn lowered_forms(graph: Graph, roots: Vec<ExprId>, outputs: &Outputs) -> Vec<Circuit> {
    let factored = rewrite::common::take_out(&graph, &roots);
    let factored = rewrite::rewrite(&factored.0, &factored.1);
    let joined = rewrite::roots::join(&factored.0, &factored.1);
    let joined = rewrite::rewrite(&joined.0, &joined.1);
    let mut forms: Vec<Circuit> = Vec::new();
    for (mut graph, roots) in [(graph, roots), factored, joined] {
        let rebuilt = homogeneous::rebuild_values(&mut graph, &outputs.with_all(&roots));
        for roots in [Some(roots), rebuilt].into_iter().flatten() {
            let form = lower::lower(&graph, &roots);
            if !forms.iter().any(|known| known.is_same(&form)) {
                forms.push(form);
            }
        }
    }
    forms
}
