//! Quantities at all points at once, in memory.

use crate::quantity::Quantity;

use super::chunk::Counts;

/// Quantities at many points: a column for each, in which a point may have none.
#[derive(Clone, Debug, Default)]
pub struct Collected {
    pub(super) quantities: Vec<Quantity>,
    /// NaN where there is none; this mark does not leave this type.
    pub(super) results: Vec<Vec<f64>>,
    pub(super) counts: Counts,
}

impl Collected {
    /// Creates an empty collection, whose memory [`Plan::collect_into`](super::Plan::collect_into) makes and keeps.
    pub fn new() -> Self {
        Self::default()
    }

    /// The quantities, in the order asked for.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// The column of the quantity number `quantity`, empty where there are not as many.
    pub fn column(&self, quantity: usize) -> Column<'_> {
        Column::of(&self.results, &self.counts, quantity)
    }

    /// How many points there are, and how many have no value.
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }
}

/// A quantity at many points, of which some may have none.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// NaN where there is none; this mark does not leave this type.
    values: &'a [f64],
    missing: u64,
}

impl<'a> Column<'a> {
    /// That of a quantity, among the results of several with what is missing of each.
    pub(super) fn of(results: &'a [Vec<f64>], counts: &Counts, quantity: usize) -> Self {
        Self {
            values: results.get(quantity).map_or(&[], Vec::as_slice),
            missing: counts.missing.get(quantity).copied().unwrap_or(0),
        }
    }

    /// How many points there are.
    pub const fn len(self) -> usize {
        self.values.len()
    }

    /// Whether there is no point.
    pub const fn is_empty(self) -> bool {
        self.values.is_empty()
    }

    /// The value at a point, none where the quantity does not exist or there is no such point.
    pub fn get(self, point: usize) -> Option<f64> {
        self.values
            .get(point)
            .copied()
            .filter(|value| !value.is_nan())
    }

    /// For each point whether the quantity exists there.
    pub fn validity(self) -> impl ExactSizeIterator<Item = bool> + 'a {
        self.values.iter().map(|value| !value.is_nan())
    }

    /// Point by point, none where it does not exist.
    pub fn iter(self) -> impl ExactSizeIterator<Item = Option<f64>> + 'a {
        self.values
            .iter()
            .map(|&value| (!value.is_nan()).then_some(value))
    }

    /// All values, if it exists at every point.
    pub fn complete(self) -> Option<&'a [f64]> {
        (self.missing == 0).then_some(self.values)
    }

    /// How many points have none.
    pub const fn missing(self) -> u64 {
        self.missing
    }
}
