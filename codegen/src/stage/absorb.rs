//! Factors that stand still, taken into the root beside them: `k·√r` is `√(k²·r)` where k ≥ 0.
//!
//! In the radicand the square is a factor of its terms, which most often have one that stands still already: the
//! multiplication at each point is gone. The radicand rounds as well as before, as each of its terms has one more factor
//! of its own, and the root halves that.

use std::collections::BTreeSet;

use super::Stage;
use crate::graph::{ExprId, Function, Graph, Node, SymbolId};
use crate::rewrite::rules::parts;

/// Rebuilds the roots with all factors taken into square roots that can be.
pub fn into_roots(
    graph: &Graph,
    roots: &[ExprId],
    inner: &BTreeSet<SymbolId>,
) -> (Graph, Vec<ExprId>) {
    let mut target = Graph::with_symbols_of(graph);
    let mut stages = Stages {
        inner,
        known: Vec::new(),
    };
    let roots = graph.rebuild(&mut target, roots, |target, _, image| {
        stages.learn(target);
        absorbed(target, &mut stages, image).unwrap_or(image)
    });
    (target, roots)
}

/// The stages of a growing graph's expressions.
struct Stages<'i> {
    inner: &'i BTreeSet<SymbolId>,
    known: Vec<Stage>,
}

impl Stages<'_> {
    /// Finds the stages of the expressions that are new.
    fn learn(&mut self, graph: &Graph) {
        while let Some(id) = graph.expression(self.known.len()) {
            let stage = match graph.node(id) {
                Node::Symbol(symbol) if self.inner.contains(symbol) => Stage::Along,
                Node::Symbol(_) => Stage::Fixed,
                _ => graph
                    .operands(id)
                    .into_iter()
                    .fold(Stage::Constant, |stage, operand| {
                        stage.with(self.of(operand))
                    }),
            };
            self.known.push(stage);
        }
    }

    fn of(&self, id: ExprId) -> Stage {
        self.known
            .get(id.index())
            .copied()
            .unwrap_or(Stage::Constant)
    }
}

fn absorbed(graph: &mut Graph, stages: &mut Stages<'_>, id: ExprId) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, id);
    let mut at_points = factors
        .iter()
        .filter(|(factor, _)| stages.of(*factor) == Stage::Point);
    let (Some(&(root, 1)), None) = (at_points.next(), at_points.next()) else {
        return None;
    };
    let radicand = match graph.node(root) {
        Node::Apply(Function::Sqrt, operands) => *operands.first()?,
        _ => return None,
    };
    let (taken, left): (Vec<_>, Vec<_>) = factors
        .iter()
        .filter(|(factor, _)| *factor != root)
        .partition(|(factor, _)| {
            stages.of(*factor) == Stage::Fixed && graph.sign(*factor).is_not_negative()
        });
    if taken.is_empty() && coefficient.is_unit() {
        return None;
    }
    let squares = taken
        .iter()
        .map(|(factor, exponent)| (*factor, 2 * exponent));
    let radicand = graph.product(squares.chain([(radicand, 1)]).collect::<Vec<_>>());
    let radicand = graph.scale(radicand, &coefficient * &coefficient);
    let root = graph.apply(Function::Sqrt, vec![radicand]);
    let id = graph.product(left.into_iter().chain([(root, 1)]).collect::<Vec<_>>());
    stages.learn(graph);
    let sign = if coefficient.is_negative() { -1 } else { 1 };
    Some(graph.scale(id, crate::graph::whole(sign)))
}
