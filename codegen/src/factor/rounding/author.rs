//! The author's form, evaluated at packs of points and in twice the digits.

use super::Written;
use crate::factor::bounded::{Bounded, Pack};
use crate::graph::{ExprId, Sizes};
use crate::interpret::Prepared;
use crate::interpret::double_double::DoubleDouble;

/// Points that differ in their last digits alone.
pub(super) struct Group {
    pub(super) symbols: Vec<Pack>,
    pub(super) points: Vec<Measured>,
}

/// The author's numbers at a point, with their errors.
pub(super) struct Measured {
    pub(super) at: Vec<f64>,
    pub(super) bounds: Vec<Bounded>,
    pub(super) exact: Vec<DoubleDouble>,
}

impl Group {
    /// The author's numbers at points of which a pack has all.
    pub(super) fn of(author: &Author, points: &[Vec<f64>]) -> Self {
        let symbols = packed(points);
        let bounds = author.bounds_at(&symbols, &mut Vec::new());
        let measured = points.iter().enumerate().map(|(lane, at)| Measured {
            at: at.clone(),
            bounds: lane_of(&bounds, lane),
            exact: author.exact.at(&exactly(at)),
        });
        Self {
            points: measured.collect(),
            symbols,
        }
    }
}

/// The numbers of points in packs, symbol by symbol; what is left of a pack repeats the last point.
pub(super) fn packed(points: &[Vec<f64>]) -> Vec<Pack> {
    let last = points.len() - 1;
    let symbols = 0..points[last].len();
    symbols
        .map(|symbol| Pack::of(|lane| Bounded::exact(points[lane.min(last)][symbol])))
        .collect()
}

/// The numbers at one point of a pack.
pub(super) fn lane_of(packs: &[Pack], lane: usize) -> Vec<Bounded> {
    packs.iter().map(|pack| pack.lane(lane)).collect()
}

/// The symbols' values as they are.
pub(super) fn exactly(at: &[f64]) -> Vec<DoubleDouble> {
    at.iter().copied().map(DoubleDouble::exact).collect()
}

/// The author's form, ready to be evaluated, with partials as dual numbers have them.
pub(super) struct Author {
    /// The numbers, then, where the sizes of inputs are stated, the numbers with partials in the reverse mode.
    pub(super) bounds: Prepared<Pack>,
    exact: Prepared<DoubleDouble>,
    /// How many numbers there are.
    count: usize,
}

impl Author {
    /// `None` if there is an integral, of which there is no code.
    pub(super) fn of(written: &Written) -> Option<Self> {
        let Written {
            graph,
            roots,
            reverse,
            ..
        } = written;
        // Who states sizes wants fewer operations: partials may have the errors of either mode then.
        let others: &[ExprId] = match graph.sizes {
            Sizes::All => &[],
            Sizes::Within { .. } => reverse,
        };
        let all = [roots.as_slice(), others].concat();
        Some(Self {
            bounds: Prepared::of_graph(graph, &graph.reachable(&all), &all)?,
            exact: Prepared::of_graph(graph, &graph.reachable(roots), roots)?,
            count: roots.len(),
        })
    }

    /// The numbers at points of which a pack has all.
    pub(super) fn bounds_at(&self, at: &[Pack], memory: &mut Vec<Pack>) -> Vec<Pack> {
        let mut bounds = self.bounds.at_with(at, memory);
        let others = bounds.split_off(self.count);
        for (bound, other) in bounds.iter_mut().zip(others) {
            *bound = Pack::of(|lane| with_larger_error(bound.lane(lane), other.lane(lane)));
        }
        bounds
    }
}

/// A number with the larger of two errors, where the other way to it leads to a number, too.
fn with_larger_error(number: Bounded, other: Bounded) -> Bounded {
    let error = if other.value.is_finite() {
        number.error.max(other.error)
    } else {
        number.error
    };
    Bounded { error, ..number }
}
