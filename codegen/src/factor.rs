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
mod forms;
pub mod homogeneous;
pub mod identities;
pub mod lower;
pub mod multiples;
pub mod orders;
pub mod pairs;
pub mod passes;
pub mod probes;
pub mod quotients;
pub mod repeats;
pub mod rounding;
mod search;
pub mod written;

use crate::circuit::Circuit;
use crate::graph::Graph;
use crate::outputs::{Held, Outputs};
use crate::parallel::{SEARCHED, both};
use crate::rewrite;
use forms::{derived_one_by_one, held_forms, lowered_forms, merged_forms};
use passes::{Pass, Passes};
use rounding::{Decisive, Fault, Reference, Written};
use search::Search;

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
    minimise_with(graph, outputs, written, None, Passes::ALL)
}

/// Finds the circuit as [`minimise`] does, with a form over held products to choose from, and by the given passes alone.
pub fn minimise_with(
    graph: &Graph,
    outputs: &Outputs,
    written: &Written,
    held: Option<&Held>,
    passes: Passes,
) -> Found {
    if written.undoes_rounding {
        return as_written(written, Fault::UndoesRounding);
    }
    if graph.is_exceeded() {
        return as_written(written, Fault::TooLong);
    }
    let all = outputs.all();
    let size = graph.reachable(&all).len();
    let (reference, merged) = both(
        SEARCHED * size,
        || Reference::beside(written, graph, &all),
        || merged_forms(graph, outputs, passes),
    );
    let plain = written::circuit(&written.graph, &written.reverse);
    let held = held.filter(|_| passes.has(Pass::Held));
    let held = held.filter(|held| held.graph.reachable(&held.all()).len() <= MOST_OF_HELD * size);
    let mut held = held
        .map(|held| held_forms(held, passes))
        .unwrap_or_default();
    // A form without merged expressions is tried only where all merged forms lose digits. Where no expressions were merged and
    // no other form decided how it was searched, it was tried already.
    let is_another = merged.is_changed || merged.forms.len() + held.len() > 1;
    let gathered = is_another.then_some(()).into_iter();
    let gathered = gathered.map(|()| vec![rewrite::rewrite(graph, &all)]);
    let (mut fault, mut decisive) = (None, Decisive::default());
    let mut search = Search::new(passes);
    for graphs in std::iter::once(merged.forms).chain(gathered) {
        let lowered = graphs
            .into_iter()
            .filter(|(graph, _)| !graph.is_exceeded())
            .flat_map(|(graph, roots)| lowered_forms(graph, roots, outputs, passes))
            .chain(std::mem::take(&mut held));
        search.enter(lowered.collect());
        for circuits in &mut search {
            match best_of(circuits, &reference, graph, &mut decisive) {
                Ok(circuit) => {
                    // The author's own operations may be the fewest.
                    let is_cheaper = passes.has(Pass::Written)
                        && plain.cost().weight() < circuit.cost().weight();
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
    let found = as_written(written, fault.unwrap_or(Fault::TooLong));
    let gathered = derived_one_by_one(graph, outputs)
        .filter(|circuit| circuit.cost().weight() < found.circuit.cost().weight())
        .filter(|circuit| reference.fault(graph, circuit).is_none());
    gathered.map_or(found, |circuit| Found {
        circuit,
        as_written: None,
    })
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

/// The cheapest circuit of those that are as right as the author's form; what is wrong with the cheapest where there is none.
fn best_of(
    mut circuits: Vec<Circuit>,
    reference: &Reference,
    tables: &Graph,
    decisive: &mut Decisive,
) -> Result<Circuit, Option<Fault>> {
    circuits.sort_by_cached_key(|circuit| circuit.cost().weight());
    let mut first = None;
    let mut refused: Vec<Circuit> = Vec::new();
    for circuit in circuits {
        // Several orders often come to the same.
        if refused.iter().any(|known| known.is_same(&circuit)) {
            continue;
        }
        match reference.fault_by(tables, &circuit, decisive) {
            None => return Ok(circuit),
            Some(fault) => first = first.or(Some(fault)),
        }
        refused.push(circuit);
    }
    Err(first)
}
