//! Sound rewriting: each rule is a row of [`rules::RULES`], applied to every node until none applies.
//!
//! A rule holds wherever its left side is defined, on the declared domain of the symbols: `sqrt(x²)` is `|x|`, and `x`
//! only where x ≥ 0 is known. At the end [`roots`] makes one root of those that differ by a square.

pub mod common;
pub mod exponentials;
mod fractions;
pub mod roots;
pub mod rules;
mod signs;

use crate::graph::{ExprId, Function, Graph};
use crate::outputs::Held;

/// A rewriting rule.
pub struct Rule {
    /// A name for tests and messages.
    pub name: &'static str,
    /// An example of the left side, as Rust.
    pub pattern: &'static str,
    /// What the example becomes.
    pub result: &'static str,
    /// What must be known of the example's symbols, as in `#[domain(…)]`.
    pub given: &'static str,
    /// The rule: the node that stands for this one, if the rule applies.
    pub apply: fn(&mut Graph, ExprId) -> Option<ExprId>,
}

/// How often the rules may apply to one node in a row: more than any chain of them, so that no mistake in a rule hangs
/// a build.
const MOST_STEPS: usize = 64;

/// Expressions of a graph.
pub type Form = (Graph, Vec<ExprId>);

/// Rewrites the last form in one way and then by the rules, and adds the result if that way changed anything.
pub fn go_on(forms: &mut Vec<Form>, way: fn(&Graph, &[ExprId]) -> Option<Form>) {
    let changed = forms.last().and_then(|(graph, roots)| way(graph, roots));
    forms.extend(changed.map(|(graph, roots)| rewrite(&graph, &roots)));
}

/// Rewrites the roots into a new graph.
pub fn rewrite(graph: &Graph, roots: &[ExprId]) -> Form {
    let mut target = Graph::with_symbols_of(graph);
    let roots = graph.rebuild(&mut target, roots, |target, _, image| {
        simplify(target, image)
    });
    roots::share(target, roots)
}

/// Rewrites numbers over held products, and these products.
pub fn rewrite_held(held: &Held) -> Held {
    let (graph, all) = rewrite(&held.graph, &held.all());
    let (outputs, products) = all.split_at(all.len() - held.definitions.len());
    let symbols = held.definitions.iter().map(|(symbol, _)| *symbol);
    Held {
        graph,
        outputs: held.outputs.with_all(outputs),
        definitions: symbols.zip(products.iter().copied()).collect(),
    }
}

/// Rebuilds the roots, each node rewritten by the rules and then replaced by what `change` gives for it; `None` if `change`
/// gives nothing new for any node.
fn changed(
    graph: &Graph,
    roots: &[ExprId],
    change: fn(&mut Graph, ExprId) -> Option<ExprId>,
) -> Option<Form> {
    let mut target = Graph::with_symbols_of(graph);
    let mut is_changed = false;
    let roots = graph.rebuild(&mut target, roots, |target, _, image| {
        let image = simplify(target, image);
        let changed = change(target, image);
        is_changed |= changed.is_some_and(|changed| changed != image);
        changed.unwrap_or(image)
    });
    is_changed.then_some((target, roots))
}

/// Applies the rules to one node, whose operands are rewritten already, until none applies.
pub fn simplify(graph: &mut Graph, id: ExprId) -> ExprId {
    let mut current = id;
    for _ in 0..MOST_STEPS {
        if graph.is_settled(current) {
            break;
        }
        match rules::RULES
            .iter()
            .find_map(|rule| (rule.apply)(graph, current).filter(|next| *next != current))
        {
            Some(next) => current = next,
            None => graph.settle(current),
        }
    }
    current
}

/// An elementary function of one operand, simplified.
pub fn applied(graph: &mut Graph, function: Function, operand: ExprId) -> ExprId {
    let id = graph.apply(function, [operand].as_slice());
    simplify(graph, id)
}

/// A product, simplified.
pub fn product(graph: &mut Graph, factors: impl IntoIterator<Item = (ExprId, i32)>) -> ExprId {
    let id = graph.product(factors);
    simplify(graph, id)
}
