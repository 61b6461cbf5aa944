//! The author's form, evaluated at packs of points and in twice the digits.

use super::Written;
use crate::factor::bounded::{Bounded, Pack};
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
    /// The author's numbers at a point, with partials in the reverse mode.
    pub(super) reverse: Vec<Bounded>,
    pub(super) exact: Vec<DoubleDouble>,
}

impl Group {
    /// The author's numbers at points of which a pack has all.
    pub(super) fn of(author: &Author, points: &[Vec<f64>]) -> Self {
        let symbols = packed(points);
        let [bounds, reverse] = author.bounds(&symbols, &mut Vec::new());
        let measured = points.iter().enumerate().map(|(lane, at)| Measured {
            at: at.clone(),
            bounds: lane_of(&lenient(&bounds, &reverse), lane),
            reverse: lane_of(&reverse, lane),
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

/// The author's form, ready to be evaluated.
pub(super) struct Author {
    /// The numbers with partials as dual numbers have them, then the numbers with partials in the reverse mode.
    pub(super) both: Prepared<Pack>,
    /// Where the numbers with partials as dual numbers have them begin.
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
        let all = [roots.as_slice(), reverse].concat();
        Some(Self {
            both: Prepared::of_graph(graph, &graph.reachable(&all), &all)?,
            exact: Prepared::of_graph(graph, &graph.reachable(roots), roots)?,
            count: roots.len(),
        })
    }

    /// The numbers in both modes.
    pub(super) fn bounds(&self, at: &[Pack], memory: &mut Vec<Pack>) -> [Vec<Pack>; 2] {
        let mut bounds = self.both.at_with(at, memory);
        let reverse = bounds.split_off(self.count);
        [bounds, reverse]
    }
}

/// Numbers with the larger of two errors: one way to derive the author's operations is as good as the other.
pub(super) fn lenient(forward: &[Pack], reverse: &[Pack]) -> Vec<Pack> {
    let larger = |forward: Bounded, reverse: Bounded| {
        let error = if reverse.value.is_finite() {
            forward.error.max(reverse.error)
        } else {
            forward.error
        };
        Bounded {
            value: forward.value,
            error,
        }
    };
    let both = forward.iter().zip(reverse);
    both.map(|(forward, reverse)| Pack::of(|lane| larger(forward.lane(lane), reverse.lane(lane))))
        .collect()
}
