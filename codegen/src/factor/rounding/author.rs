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
    pub(super) exact: Vec<DoubleDouble>,
}

impl Group {
    /// The author's numbers at points of which a pack has all.
    pub(super) fn of(author: &Author, points: &[Vec<f64>]) -> Self {
        let symbols = packed(points);
        let bounds = author.bounds.at(&symbols);
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
    pub(super) bounds: Prepared<Pack>,
    exact: Prepared<DoubleDouble>,
}

impl Author {
    /// `None` if there is an integral, of which there is no code.
    pub(super) fn of(written: &Written) -> Option<Self> {
        let Written { graph, roots, .. } = written;
        let reachable = graph.reachable(roots);
        Some(Self {
            bounds: Prepared::of_graph(graph, &reachable, roots)?,
            exact: Prepared::of_graph(graph, &reachable, roots)?,
        })
    }
}
