//! Fewest operations over a value and all derivatives that are asked for, together.
//!
//! First identities that hold between expressions are found by their fingerprints (their values at random points of a
//! prime field): equal expressions become one ([`identities`]), and a homogeneous function is rebuilt from its partials
//! by Euler's relation ([`homogeneous`]). Then the graph is lowered to a [`Circuit`], in which sums and
//! products are taken apart into shared ones by several orders of extraction ([`extract`]), and the cheapest is kept of
//! those that lose no digits ([`rounding`]).

pub mod bounded;
pub mod coefficients;
mod common_factors;
pub mod constants;
pub mod extract;
pub mod homogeneous;
pub mod identities;
pub mod lower;
pub mod multiples;
pub mod pairs;
pub mod probes;
pub mod quotients;
pub mod repeats;
pub mod rounding;
pub mod written;

use crate::circuit::Circuit;
use crate::factor::extract::{ORDERS, Step};
use crate::factor::rounding::{Fault, Reference, Written};
use crate::graph::{ExprId, Graph, SymbolId};
use crate::outputs::{Held, Outputs};
use crate::parallel::{both, on_all_cores};
use crate::{differentiate, rewrite};

/// How many times larger than the form without held products the one with them may be. A larger one is never the cheapest:
/// it arises where an author named every product, and each is derived by all others.
const MOST_OF_HELD: usize = 2;

/// The circuit that was found, and the reason if it is the author's form.
#[derive(Clone, Debug)]
pub struct Found {
    /// The operations.
    pub circuit: Circuit,
    /// What is wrong with the cheapest other form, if no other form is accurate enough.
    pub as_written: Option<Fault>,
}

/// The circuit with the fewest operations that was found for these outputs, among those that are as right as the formula as
/// its author wrote it; that formula where there is none.
pub fn minimise(graph: &Graph, outputs: &Outputs, written: &Written) -> Found {
    minimise_with(graph, outputs, written, None)
}

/// Finds the circuit as [`minimise`] does, with a form over held products to choose from.
pub fn minimise_with(
    graph: &Graph,
    outputs: &Outputs,
    written: &Written,
    held: Option<&Held>,
) -> Found {
    if written.undoes_rounding {
        return as_written(written, Fault::UndoesRounding);
    }
    if graph.is_exceeded() {
        return as_written(written, Fault::TooLong);
    }
    let (reference, merged) = both(
        || Reference::beside(written, graph, &outputs.all()),
        || merged_forms(graph, outputs),
    );
    let all = outputs.all();
    let plain = written::circuit(&written.graph, &written.reverse);
    let size = graph.reachable(&all).len();
    let held = held.filter(|held| held.graph.reachable(&held.all()).len() <= MOST_OF_HELD * size);
    let mut held = held.map(held_forms).unwrap_or_default();
    // A form without merged expressions is tried only where all merged forms lose digits.
    let gathered = std::iter::once_with(|| vec![rewrite::rewrite(graph, &all)]);
    let mut fault = None;
    for graphs in std::iter::once(merged).chain(gathered) {
        let lowered = graphs
            .into_iter()
            .filter(|(graph, _)| !graph.is_exceeded())
            .flat_map(|(graph, roots)| lowered_forms(graph, roots, outputs))
            .chain(std::mem::take(&mut held));
        for circuits in Search::new(lowered.collect()) {
            match best_of(circuits, &reference, graph) {
                Ok(circuit) => {
                    // The author's own operations may be the fewest.
                    let is_cheaper = plain.cost().weight() < circuit.cost().weight();
                    let is_plain = is_cheaper && reference.fault(graph, &plain).is_none();
                    return Found {
                        circuit: if is_plain { plain } else { circuit },
                        as_written: None,
                    };
                }
                Err(of_cheapest) => fault = fault.or(of_cheapest),
            }
        }
    }
    as_written(written, fault.unwrap_or(Fault::TooLong))
}

/// The author's form, with partials in the reverse mode where that takes fewer operations and is as right as dual numbers are.
fn as_written(written: &Written, fault: Fault) -> Found {
    let forward = written::circuit(&written.graph, &written.roots);
    let reverse = written::circuit(&written.graph, &written.reverse);
    let is_right = || {
        let alone = Written {
            reverse: written.roots.clone(),
            ..written.clone()
        };
        let reference = Reference::of(&alone);
        reference.fault(&written.graph, &reverse).is_none()
    };
    let is_cheaper = reverse.cost().weight() < forward.cost().weight();
    let circuit = if is_cheaper && is_right() {
        reverse
    } else {
        forward
    };
    Found {
        circuit,
        as_written: Some(fault),
    }
}

/// The outputs with equal expressions as one, with the partials of the reverse and of the forward mode.
fn merged_forms(graph: &Graph, outputs: &Outputs) -> Vec<(Graph, Vec<ExprId>)> {
    let forward = forward(graph, outputs).map(|(graph, all)| unified(&graph, &all));
    let reverse = unified(graph, &outputs.all());
    [reverse].into_iter().chain(forward).collect()
}

/// The cheapest circuit of those that are as right as the author's form; what is wrong with the cheapest where there is none.
fn best_of(
    mut circuits: Vec<Circuit>,
    reference: &Reference,
    tables: &Graph,
) -> Result<Circuit, Option<Fault>> {
    circuits.sort_by_cached_key(|circuit| circuit.cost().weight());
    let mut first = None;
    let mut refused: Vec<Circuit> = Vec::new();
    for circuit in circuits {
        // Several orders often come to the same.
        if refused.iter().any(|known| known.is_same(&circuit)) {
            continue;
        }
        match reference.fault(tables, &circuit) {
            None => return Ok(circuit),
            Some(fault) => first = first.or(Some(fault)),
        }
        refused.push(circuit);
    }
    Err(first)
}

/// Works out forms in the orders of extraction: the most promising forms in all orders first, the others only where those
/// lose digits.
///
/// Which form is best shows in one or two orders; trying them all on every form takes three to six times as long and has
/// found nothing cheaper in any formula that was looked at.
struct Search {
    /// The forms with what the first orders made of them, the dearest first.
    forms: Vec<(Circuit, Vec<Circuit>)>,
    /// The orders that are left to be tried.
    rest: Vec<&'static [Step]>,
}

/// Forms that are worked out together.
const FORMS: usize = 2;

/// The places of the orders that show which form is best.
const FIRST_ORDERS: [usize; 2] = [1, 2];

/// The size beyond which a circuit is large, the order that then shows it, and the others that are tried: for large
/// circuits one of these has been the best.
const LARGE: usize = 240;
const FIRST_OF_LARGE: [usize; 1] = [4];
const REST_OF_LARGE: [usize; 3] = [1, 7, 8];

/// The size beyond which one form and that one order have to do: the others would take three times as long as all the rest.
const HUGE: usize = 2_000;

impl Search {
    fn new(forms: Vec<Circuit>) -> Self {
        let size = forms.iter().map(|form| form.nets().count()).max();
        let size = size.unwrap_or(0);
        let all = 0..ORDERS.len();
        let (first, rest): (&[usize], Vec<usize>) = if size > HUGE {
            (&FIRST_OF_LARGE, Vec::new())
        } else if size > LARGE {
            (&FIRST_OF_LARGE, REST_OF_LARGE.to_vec())
        } else {
            let rest = all.filter(|place| !FIRST_ORDERS.contains(place));
            (&FIRST_ORDERS, rest.collect())
        };
        let orders = |places: &[usize]| places.iter().map(|place| ORDERS[*place]).collect();
        let (first, rest): (Vec<_>, Vec<_>) = (orders(first), orders(&rest));
        let mut tried = extracted(&forms, &first).into_iter();
        let mut forms: Vec<_> = forms
            .into_iter()
            .map(|form| (form, tried.by_ref().take(first.len()).collect::<Vec<_>>()))
            .collect();
        let least = |(_, tried): &(Circuit, Vec<Circuit>)| {
            let weights = tried.iter().map(|circuit| circuit.cost().weight());
            weights.min()
        };
        // The first of equals comes first.
        forms.reverse();
        forms.sort_by_key(|form| std::cmp::Reverse(least(form)));
        Self { forms, rest }
    }
}

impl Iterator for Search {
    type Item = Vec<Circuit>;

    fn next(&mut self) -> Option<Vec<Circuit>> {
        let kept = self.forms.len().saturating_sub(FORMS);
        let (forms, mut tried): (Vec<_>, Vec<_>) = self.forms.drain(kept..).rev().unzip();
        if forms.is_empty() {
            return None;
        }
        tried.push(extracted(&forms, &self.rest));
        Some(tried.into_iter().flatten().collect())
    }
}

/// Every circuit in every order of extraction, one after the other.
fn extracted(lowered: &[Circuit], orders: &[&[Step]]) -> Vec<Circuit> {
    let ways = lowered
        .iter()
        .flat_map(|circuit| orders.iter().map(move |order| (circuit, *order)));
    let ways: Vec<_> = ways.collect();
    on_all_cores(&ways, |(circuit, order)| {
        let mut circuit = Circuit::clone(circuit);
        extract::extract(&mut circuit, order);
        circuit
    })
}

/// The circuits of held products.
fn held_forms(held: &Held) -> Vec<Circuit> {
    let held = rewrite::rewrite_held(&identities::merge_held(held));
    let symbols: Vec<SymbolId> = held.definitions.iter().map(|(symbol, _)| *symbol).collect();
    let all = held.all();
    let mut forms = lowered_forms(held.graph, all, &held.outputs);
    for form in &mut forms {
        form.define(&symbols);
    }
    forms
}

/// Equal expressions as one.
fn unified(graph: &Graph, all: &[ExprId]) -> (Graph, Vec<ExprId>) {
    let merged = identities::merge(graph, all);
    // What has become equal may cancel now.
    rewrite::rewrite(&merged.0, &merged.1)
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

/// The most binary digits of a constant in a circuit: twice those of the largest and the smallest `f64`.
const LONGEST_CONSTANT: u64 = 2200;

/// The outputs in every form that may turn out to be cheapest, each once.
fn lowered_forms(graph: Graph, roots: Vec<ExprId>, outputs: &Outputs) -> Vec<Circuit> {
    let is_huge = graph.reachable(&roots).len() > HUGE;
    let mut forms = vec![(graph, roots)];
    if !is_huge {
        add_rewritten(&mut forms);
    }
    let lowered = on_all_cores(&forms, |(graph, roots)| {
        let mut graph = graph.clone();
        let rebuilt = (!is_huge)
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
fn add_rewritten(forms: &mut Vec<rewrite::Form>) {
    rewrite::go_on(forms, rewrite::roots::without_quotients);
    rewrite::go_on(forms, rewrite::common::take_out);
    rewrite::go_on(forms, rewrite::roots::join);
    let exponentials = forms
        .last()
        .map(|(graph, roots)| rewrite::exponentials::forms(graph, roots));
    rewrite::go_on(forms, rewrite::roots::without_quotients);
    let exponentials = exponentials.into_iter().flatten();
    forms.extend(exponentials.map(|(graph, roots)| rewrite::rewrite(&graph, &roots)));
}
