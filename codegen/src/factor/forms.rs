//! The forms of a formula that may turn out to be the cheapest, before any extraction.

use super::passes::{Pass, Passes};
use super::search::HUGE;
use super::{homogeneous, identities, lower};
use crate::circuit::Circuit;
use crate::differentiate;
use crate::graph::{ExprId, Graph, SymbolId};
use crate::outputs::{Held, Outputs};
use crate::parallel::{SEARCHED, on_worthwhile_cores};
use crate::rewrite::{self, Form};

/// The outputs with equal expressions as one, with the partials of the reverse and of the forward mode.
pub(super) struct Merged {
    pub(super) forms: Vec<Form>,
    /// Whether any expressions of the first form were equal.
    pub(super) is_changed: bool,
}

/// The outputs with equal expressions as one.
pub(super) fn merged_forms(graph: &Graph, outputs: &Outputs, passes: Passes) -> Merged {
    let forward = passes
        .has(Pass::Forward)
        .then(|| forward(graph, outputs))
        .flatten();
    let forward = forward.map(|(graph, all)| unified(&graph, &all, passes).0);
    let (reverse, is_changed) = unified(graph, &outputs.all(), passes);
    Merged {
        forms: [reverse].into_iter().chain(forward).collect(),
        is_changed,
    }
}

/// The circuits of held products.
pub(super) fn held_forms(held: &Held, passes: Passes) -> Vec<Circuit> {
    let held = rewrite::rewrite_held(&identities::merge_held(held));
    let symbols: Vec<SymbolId> = held.definitions.iter().map(|(symbol, _)| *symbol).collect();
    let all = held.all();
    let mut forms = lowered_forms(held.graph, all, &held.outputs, passes);
    forms.retain_mut(|form| form.define(&symbols));
    forms
}

/// Equal expressions as one, and whether any were equal.
fn unified(graph: &Graph, all: &[ExprId], passes: Passes) -> (Form, bool) {
    let merged = passes
        .has(Pass::Identities)
        .then(|| identities::merge(graph, all))
        .flatten();
    match merged {
        // What has become equal may cancel now.
        Some((graph, all)) => (rewrite::rewrite(&graph, &all), true),
        None => (rewrite::rewrite(graph, all), false),
    }
}

/// The largest graph of which the forward mode's partials are tried too: it writes each partial on its own, which takes
/// long to sort out, and for large formulas the reverse mode always comes out shorter.
const SMALL: usize = 300;

/// Outputs with their gradients derived by the forward mode instead.
fn forward(graph: &Graph, outputs: &Outputs) -> Option<(Graph, Vec<ExprId>)> {
    let all = outputs.all();
    let wanted = !outputs.gradients.is_empty() && outputs.hessians.is_empty();
    if !wanted || graph.reachable(&all).len() > SMALL {
        return None;
    }
    let mut graph = graph.clone();
    let mut forward = outputs.clone();
    for (value, gradient) in outputs.values.iter().zip(&mut forward.gradients) {
        let partials = differentiate::gradient_forward(&mut graph, *value, &outputs.by);
        for (partial, reverse) in partials.iter().zip(gradient.iter()) {
            if let Some(name) = graph.suggested_name(*reverse).map(ToOwned::to_owned) {
                graph.suggest_name(*partial, &name);
            }
        }
        *gradient = partials;
    }
    let all = forward.all();
    Some((graph, all))
}

/// The values as they are gathered, with partials of their operations one by one, as dual numbers have them: they take more
/// operations than other forms, but what is in between stays in the range of numbers where the author's does.
pub(super) fn derived_one_by_one(graph: &Graph, outputs: &Outputs) -> Option<Circuit> {
    if outputs.gradients.is_empty() || graph.reachable(&outputs.all()).len() > SMALL {
        return None;
    }
    let mut written = Graph::as_written_with_symbols_of(graph);
    let values = graph.rebuild(&mut written, &outputs.values, |_, _, image| image);
    let mut all = Outputs {
        values,
        ..outputs.clone()
    };
    let forward = differentiate::gradient_forward;
    for (value, gradient) in all.values.iter().zip(&mut all.gradients) {
        *gradient = forward(&mut written, *value, &outputs.by);
    }
    for (gradient, triangle) in all.gradients.iter().zip(&mut all.hessians) {
        let rows = differentiate::hessian(&mut written, gradient, &outputs.by, forward);
        let rows = rows.into_iter().enumerate();
        *triangle = rows
            .flat_map(|(row, entries)| entries.into_iter().skip(row))
            .collect();
    }
    for partials in all.gradients.iter_mut().chain(&mut all.hessians) {
        *partials = differentiate::corners::with_sides(&mut written, partials);
    }
    for (number, gathered) in all.all().into_iter().zip(outputs.all()) {
        if let Some(name) = graph.suggested_name(gathered) {
            written.suggest_name(number, name);
        }
    }
    Some(super::written::circuit(&written, &all.all()))
}

/// The most binary digits of a constant in a circuit: twice those of the largest and the smallest `f64`.
const LONGEST_CONSTANT: u64 = 2200;

/// The outputs in every form that may turn out to be cheapest, each once.
pub(super) fn lowered_forms(
    graph: Graph,
    roots: Vec<ExprId>,
    outputs: &Outputs,
    passes: Passes,
) -> Vec<Circuit> {
    let size = graph.reachable(&roots).len();
    let is_huge = size > HUGE;
    let mut forms = vec![(graph, roots)];
    if !is_huge {
        add_rewritten(&mut forms, passes);
    }
    let work = SEARCHED * size * forms.len();
    let lowered = on_worthwhile_cores(&forms, work, |(graph, roots)| {
        let mut graph = graph.clone();
        let rebuilt = (!is_huge && passes.has(Pass::Homogeneous))
            .then(|| homogeneous::rebuild_values(&mut graph, &outputs.with_all(roots)))
            .flatten();
        let rebuilt = rebuilt.map(|mut rebuilt| {
            rebuilt.extend(roots.iter().skip(rebuilt.len()));
            rebuilt
        });
        let ways = [Some(roots.clone()), rebuilt].into_iter().flatten();
        ways.map(|roots| lower::lower(&graph, &roots))
            .collect::<Vec<_>>()
    });
    let mut forms: Vec<Circuit> = Vec::new();
    // A form with constants beyond the range of numbers is of no use, and takes long to look through.
    let useful = |circuit: &Circuit| circuit.longest_constant() <= LONGEST_CONSTANT;
    for form in lowered.into_iter().flatten().filter(useful) {
        if !forms.iter().any(|known| known.is_same(&form)) {
            forms.push(form);
        }
    }
    forms
}

/// Adds the forms that arise from rewritings which do not always pay and so are no rules.
fn add_rewritten(forms: &mut Vec<Form>, passes: Passes) {
    let go_on = |forms: &mut Vec<Form>, pass, way| {
        if passes.has(pass) {
            rewrite::go_on(forms, way);
        }
    };
    go_on(
        forms,
        Pass::RootsOfQuotients,
        rewrite::roots::without_quotients,
    );
    go_on(forms, Pass::CommonFactors, rewrite::common::take_out);
    go_on(forms, Pass::JoinedRoots, rewrite::roots::join);
    let exponentials = forms
        .last()
        .filter(|_| passes.has(Pass::Exponentials))
        .map(|(graph, roots)| rewrite::exponentials::forms(graph, roots));
    go_on(
        forms,
        Pass::RootsOfQuotients,
        rewrite::roots::without_quotients,
    );
    let exponentials = exponentials.into_iter().flatten();
    forms.extend(exponentials.map(|(graph, roots)| rewrite::rewrite(&graph, &roots)));
}
