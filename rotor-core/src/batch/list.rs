//! Numbers of the points of a block.

use crate::batch::extremes::{Extremes, is_size};

/// A number of each point of a block, or one that all of them have.
#[derive(Clone, Debug)]
pub(super) struct List {
    values: Vec<f64>,
    is_same: bool,
}

impl Default for List {
    /// Creates a list that is not a number at all points.
    fn default() -> Self {
        Self {
            values: vec![f64::NAN],
            is_same: true,
        }
    }
}

impl List {
    /// Creates a list of a column's numbers.
    pub(super) const fn of(values: Vec<f64>) -> Self {
        Self {
            values,
            is_same: false,
        }
    }

    /// Sets the number that all points have; answers whether it is another one than before.
    pub(super) fn set(&mut self, number: f64) -> bool {
        let is_known = self.is_same && self.number().to_bits() == number.to_bits();
        if !is_known {
            self.values.clear();
            self.values.push(number);
            self.is_same = true;
        }
        !is_known
    }

    /// Whether all points have the same number.
    pub(super) const fn is_same(&self) -> bool {
        self.is_same
    }

    /// The number of the first point.
    pub(super) fn number(&self) -> f64 {
        self.values.first().copied().unwrap_or(f64::NAN)
    }

    /// The numbers of so many points: those of a column, or as many of the one that all have.
    pub(super) fn spread(&mut self, points: usize) -> &[f64] {
        if self.is_same && self.values.len() < points {
            self.values.resize(points, self.number());
        }
        self.values.get(..points).unwrap_or_default()
    }

    /// The numbers of so many points, of a list that has as many.
    pub(super) fn first(&self, points: usize) -> &[f64] {
        self.values.get(..points).unwrap_or_default()
    }

    /// Gives its memory away, for as many numbers.
    pub(super) fn take(&mut self, points: usize) -> Vec<f64> {
        let mut values = std::mem::take(&mut self.values);
        values.resize(points, f64::NAN);
        values
    }

    /// Marks points false whose numbers do not pass a test; whether all do.
    pub(super) fn require(&self, points: &mut [bool], test: &Test) -> bool {
        if self.is_same {
            let holds = (test.of_one)(self.number());
            points.iter_mut().for_each(|point| *point &= holds);
            return holds;
        }
        require(&self.values, points, test)
    }

    /// Takes the number of another list at the points that are chosen.
    pub(super) fn replace(&mut self, other: &Self, chosen: impl Fn(usize) -> bool) {
        let values = self.values.iter_mut().zip(&other.values).enumerate();
        for (_, (value, other)) in values.filter(|(point, _)| chosen(*point)) {
            *value = *other;
        }
    }
}

/// Marks points false whose numbers do not pass a test; whether all do.
pub(super) fn require(values: &[f64], points: &mut [bool], test: &Test) -> bool {
    if (test.of_all)(&Extremes::of(values)) {
        return true;
    }
    let mut all = true;
    for (point, value) in points.iter_mut().zip(values) {
        let holds = (test.of_one)(*value);
        *point &= holds;
        all &= holds;
    }
    all
}

/// What a number has to be, and what a column spans if that is certain of all of its numbers.
pub(super) struct Test {
    pub(super) of_one: fn(f64) -> bool,
    pub(super) of_all: fn(&Extremes) -> bool,
}

/// Positive, with all its digits.
pub(super) const SIZES: Test = Test {
    of_one: is_size,
    of_all: Extremes::are_sizes,
};

/// Finite.
pub(super) const FINITE: Test = Test {
    of_one: f64::is_finite,
    of_all: |extremes| extremes.sum_is_finite,
};

/// Not zero, with all its digits.
pub(super) const NONZERO: Test = Test {
    of_one: |value| is_size(value.abs()),
    of_all: |extremes| {
        extremes.are_sizes() || extremes.sum_is_finite && is_size(-extremes.greatest)
    },
};
