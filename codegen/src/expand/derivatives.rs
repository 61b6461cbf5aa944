//! A formula's numbers with the partials that a form asks for: gathered, over held products, and as the author wrote them.

use super::Formula;
use crate::differentiate::{self, Gradient};
use crate::emit::scalar::Form;
use crate::factor::rounding::Written;
use crate::graph::{ExprId, Graph, SymbolId};
use crate::outputs::{Held, Outputs};
use crate::parse::body::identifier;
use crate::rewrite;

/// The most held products that are derived by each other: the work grows with their square.
const MOST_HELD: usize = 100;

/// The formula's numbers with their gradients, over its held products.
pub fn derive_held(formula: &Formula, by: &[SymbolId]) -> Option<Held> {
    let held = formula.held.as_ref();
    let mut held = held
        .filter(|held| held.definitions.len() <= MOST_HELD)?
        .clone();
    held.outputs.by = by.to_vec();
    for root in &held.outputs.values {
        let gradient = differentiate::gradient_held(&mut held.graph, *root, by, &held.definitions);
        held.outputs.gradients.push(gradient);
    }
    name_partials(&mut held.graph, &held.outputs);
    Some(rewrite::rewrite_held(&held))
}

/// Suggests names for the first partials.
fn name_partials(graph: &mut Graph, outputs: &Outputs) {
    for gradient in &outputs.gradients {
        for (partial, symbol) in gradient.iter().zip(&outputs.by) {
            let name = format!("d_{}", identifier(&graph.symbol(*symbol).name));
            graph.suggest_name(*partial, &name);
        }
    }
}

/// The formula's numbers with the partials that a form asks for, rewritten.
pub fn derive(formula: &Formula, form: Form, by: &[SymbolId]) -> (Graph, Outputs) {
    let mut graph = formula.graph.clone();
    let reverse = differentiate::gradient;
    let outputs = with_partials(&mut graph, &formula.roots, form, by, reverse);
    let (graph, all) = rewrite::rewrite(&graph, &outputs.all());
    let outputs = outputs.with_all(&all);
    (graph, outputs)
}

/// The most operations that are derived one by one in the forward mode, which takes as many for every partial. Code of more
/// `let`s than twice as many breaks the compiler: each is a scope within the one before.
const MOST_FORWARD: usize = 2_000;

/// Derives the formula as its author wrote it, operation by operation, as dual numbers do: once in the forward mode, and
/// once in the reverse mode, which takes fewer operations.
pub fn derive_written(formula: &Formula, form: Form, by: &[SymbolId]) -> Written {
    let mut written = formula.written.clone();
    let (graph, roots) = (&mut written.graph, &formula.written.roots);
    let size = graph.reachable(roots).len();
    let partials = match form {
        Form::Value => 0,
        Form::Gradient | Form::Jacobian => by.len(),
        Form::Hessian => by.len() * (by.len() + 1) / 2,
    };
    let reverse = with_partials(graph, roots, form, by, differentiate::gradient);
    written.roots = if size * partials <= MOST_FORWARD {
        with_partials(graph, roots, form, by, differentiate::gradient_forward).all()
    } else {
        reverse.all()
    };
    written.reverse = reverse.all();
    written
}

/// The numbers with the partials that a form asks for.
fn with_partials(
    graph: &mut Graph,
    roots: &[ExprId],
    form: Form,
    by: &[SymbolId],
    gradient: Gradient,
) -> Outputs {
    let mut outputs = Outputs {
        values: roots.to_vec(),
        by: by.to_vec(),
        ..Outputs::default()
    };
    if form >= Form::Gradient {
        let gradients = roots.iter().map(|root| gradient(graph, *root, by));
        outputs.gradients = gradients.collect();
    }
    if form == Form::Hessian {
        for partials in &outputs.gradients {
            let rows = differentiate::hessian(graph, partials, by, gradient);
            let triangle = rows
                .iter()
                .enumerate()
                .flat_map(|(row, entries)| entries.iter().skip(row))
                .copied();
            outputs.hessians.push(triangle.collect());
        }
    }
    for partials in outputs.gradients.iter_mut().chain(&mut outputs.hessians) {
        *partials = differentiate::corners::with_sides(graph, partials);
    }
    name_partials(graph, &outputs);
    for triangle in &outputs.hessians {
        let pairs = (0..by.len()).flat_map(|row| (row..by.len()).map(move |column| (row, column)));
        for (second, (row, column)) in triangle.iter().zip(pairs) {
            let [row, column] =
                [row, column].map(|place| identifier(&graph.symbol(by[place]).name));
            graph.suggest_name(*second, &format!("d_{row}_{column}"));
        }
    }
    outputs
}
