//! Several orders of extraction, of several circuits: what they have in common is done once.
//!
//! Many orders begin with the same steps, and many a step changes nothing in a given circuit, so that different orders come
//! to the same circuit. From there on they are one.

use rustc_hash::{FxHashMap, FxHashSet};

use super::extract::{self, Step};
use super::passes::{Pass, Passes};
use crate::budget::Budget;
use crate::circuit::Circuit;
use crate::parallel::{SEARCHED, on_worthwhile_cores};

/// What is done to a circuit next: a step, or what follows the last one.
type Next = Option<Step>;

/// Circuits on their way through orders of extraction.
pub struct Orders {
    /// Every circuit that was come to, once.
    circuits: Vec<Circuit>,
    /// The place of the circuit that comes of the one at a place.
    after: FxHashMap<(usize, Next), usize>,
    passes: Passes,
}

impl Orders {
    /// No circuits yet; they are extracted by these passes alone.
    pub fn new(passes: Passes) -> Self {
        Self {
            circuits: Vec::new(),
            after: FxHashMap::default(),
            passes,
        }
    }

    /// The circuit at a place.
    pub fn circuit(&self, place: usize) -> &Circuit {
        &self.circuits[place]
    }

    /// The place of a circuit, which is added where no equal one is there.
    pub fn place_of(&mut self, circuit: Circuit) -> usize {
        let mut known = self.circuits.iter();
        let place = known.position(|known| known.is_identical(&circuit));
        place.unwrap_or_else(|| {
            self.circuits.push(circuit);
            self.circuits.len() - 1
        })
    }

    /// The places of what comes of every circuit in every order, one after the other.
    pub fn extracted(&mut self, starts: &[usize], orders: &[&[Step]]) -> Vec<usize> {
        let runs = |step: &&Step| self.passes.has(Pass::Step(**step));
        let orders: Vec<Vec<Next>> = orders
            .iter()
            .map(|order| {
                let steps = order.iter().filter(runs).copied().map(Some);
                steps.chain([None]).collect()
            })
            .collect();
        let ways = starts
            .iter()
            .flat_map(|start| orders.iter().map(|order| (*start, order.as_slice())));
        let mut ways: Vec<(usize, &[Next])> = ways.collect();
        while ways.iter().any(|(_, rest)| !rest.is_empty()) {
            self.go_on(&ways);
            for (place, rest) in &mut ways {
                if let [next, behind @ ..] = *rest {
                    *place = self.after[&(*place, *next)];
                    *rest = behind;
                }
            }
        }
        ways.into_iter().map(|(place, _)| place).collect()
    }

    /// Does what comes next on all ways, unless it was done before.
    fn go_on(&mut self, ways: &[(usize, &[Next])]) {
        let mut seen = FxHashSet::default();
        let next = ways
            .iter()
            .filter_map(|(place, rest)| Some((*place, *rest.first()?)));
        let new: Vec<(usize, Next)> = next
            .filter(|next| !self.after.contains_key(next) && seen.insert(*next))
            .collect();
        let sizes = new
            .iter()
            .map(|(place, _)| self.circuits[*place].nets().count());
        let work = SEARCHED * sizes.sum::<usize>();
        let made = on_worthwhile_cores(&new, work, |(place, next)| {
            let mut circuit = self.circuits[*place].clone();
            let budget = &mut Budget::default();
            match next {
                Some(step) => extract::take(&mut circuit, *step, budget),
                None => extract::finish(&mut circuit, self.passes, budget),
            }
            circuit
        });
        for (next, circuit) in new.into_iter().zip(made) {
            let place = self.place_of(circuit);
            self.after.insert(next, place);
        }
    }
}
