//! Fewest operations over a value and all derivatives that are asked for, together.
//!
//! First identities that hold between expressions are found by their fingerprints (their values at random points of a
//! prime field): equal expressions become one ([`identities`]), and a homogeneous function is rebuilt from its partials
//! by Euler's relation ([`homogeneous`]). Then the graph is lowered to a [`circuit::Circuit`], in which sums and
//! products are taken apart into shared ones by several orders of extraction ([`extract`]), and the cheapest is kept.

pub mod circuit;
pub mod extract;
pub mod fingerprint;
pub mod homogeneous;
pub mod identities;
pub mod lower;

use crate::factor::circuit::Circuit;
use crate::factor::extract::ORDERS;
use crate::graph::{ExprId, Graph, SymbolId};

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
        self.values.iter().chain(gradients).chain(hessians).copied().collect()
    }

    /// The same with other numbers, in order.
    pub fn with_all(&self, all: &[ExprId]) -> Self {
        let mut all = all.iter().copied();
        let mut take = |old: &Vec<ExprId>| -> Vec<ExprId> { all.by_ref().take(old.len()).collect() };
        Self {
            values: take(&self.values),
            by: self.by.clone(),
            gradients: self.gradients.iter().map(&mut take).collect(),
            hessians: self.hessians.iter().map(&mut take).collect(),
        }
    }
}

/// The circuit with the fewest operations that was found for these outputs.
pub fn minimise(graph: &Graph, outputs: &Outputs) -> Circuit {
    let (mut graph, merged) = identities::merge(graph, &outputs.all());
    let outputs = outputs.with_all(&merged);
    let mut variants = vec![outputs.all()];
    if let Some(rebuilt) = homogeneous::rebuild_values(&mut graph, &outputs) {
        variants.push(rebuilt);
    }
    let mut best: Option<Circuit> = None;
    for roots in variants {
        let lowered = lower::lower(&graph, &roots);
        for order in ORDERS {
            let mut circuit = lowered.clone();
            extract::extract(&mut circuit, order);
            if best.as_ref().is_none_or(|best| circuit.cost().weight() < best.cost().weight()) {
                best = Some(circuit);
            }
        }
    }
    best.unwrap_or_default()
}
