//! What is kept of many numbers: of a column as a whole, and of each of its rows while others of its kind pass.

mod accumulator;
mod reducer;
mod summary;

use std::fmt;

use lanes::{Pack, Simd};

pub(crate) use accumulator::Accumulator;
pub(crate) use reducer::Reducer;
pub(crate) use summary::{Gaps, Summary, Wanted, WithGaps, WithoutGaps};

/// What is kept of the values of a quantity. Points where it does not exist take no part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Statistic {
    /// The largest value.
    Maximum,
    /// The smallest value.
    Minimum,
    /// The largest value and the first point that has it.
    ArgMaximum,
    /// The smallest value and the first point that has it.
    ArgMinimum,
    /// The mean.
    Mean,
    /// How many values are above a threshold.
    CountAbove(f64),
    /// How many values fall into each of some equally wide bins. A bin has its lower end; the last
    /// one has both. Values below and above all bins are counted too.
    Histogram {
        /// Lower end of the first bin.
        low: f64,
        /// Upper end of the last bin.
        high: f64,
        /// How many bins.
        bins: u32,
    },
}

impl Statistic {
    /// The name, as on the command line: `max`, `argmin`, `count`.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Maximum => "max",
            Self::Minimum => "min",
            Self::ArgMaximum => "argmax",
            Self::ArgMinimum => "argmin",
            Self::Mean => "mean",
            Self::CountAbove(_) => "count",
            Self::Histogram { .. } => "histogram",
        }
    }

    /// The ends of a histogram's bins, one more than there are bins; empty for other statistics.
    pub fn bin_ends(&self) -> Vec<f64> {
        let &Self::Histogram { low, high, bins } = self else {
            return Vec::new();
        };
        let share = |end| f64::from(end) / f64::from(bins);
        let mut ends: Vec<_> = (0..bins)
            .map(|end| low + (high - low) * share(end))
            .collect();
        ends.push(high);
        ends
    }

    /// Whether the point at which the value lies is a part of the answer.
    pub const fn locates(&self) -> bool {
        matches!(self, Self::ArgMaximum | Self::ArgMinimum)
    }
}

/// `max`, `count(0.05)`, `histogram(0,1,20)`.
impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CountAbove(threshold) => write!(f, "count({threshold:?})"),
            Self::Histogram { low, high, bins } => write!(f, "histogram({low:?},{high:?},{bins})"),
            other => f.pad(other.name()),
        }
    }
}

/// The bins of a histogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bins {
    /// Lower end of the first one.
    pub(crate) low: f64,
    /// Upper end of the last one.
    pub(crate) high: f64,
    /// How many there are.
    pub(crate) count: u32,
}

impl Bins {
    /// How many counts there are: one of each bin, the first of what is below all of them, the last of what is above.
    pub(crate) const fn places(self) -> usize {
        self.count as usize + 2
    }

    /// Where each of some numbers is counted; NaN for one that is NaN, if there may be such.
    #[inline(always)]
    fn places_of<S: Simd, G: Gaps>(self, value: Pack<S>) -> Pack<S> {
        let simd = value.simd();
        let (count, width) = (f64::from(self.count), self.high - self.low);
        let (low, high) = (Pack::splat(simd, self.low), Pack::splat(simd, self.high));
        let last = Pack::splat(simd, count - 1.0);
        let bin = ((value - low) / width * count).floor().min(last);
        // Rounding may lead past the ends of a bin, as `Statistic::bin_ends` has them.
        let (lower, upper) = (low + bin / count * width, low + (bin + 1.0) / count * width);
        let settled = lower.select_le(value, bin, bin - 1.0);
        let bin = upper.select_le(value, bin + 1.0, settled).min(last) + 1.0;
        let bin = low.select_le(value, bin, Pack::splat(simd, 0.0));
        let bin = value.select_le(high, bin, Pack::splat(simd, count + 1.0));
        if !G::HAS_GAPS {
            return bin;
        }
        let infinity = Pack::splat(simd, f64::INFINITY);
        value.select_le(infinity, bin, value)
    }
}

#[cfg(test)]
mod tests {
    use lanes::{Consumer, Level, fold};

    use super::*;
    use crate::batch::extremes::Itself;

    /// The bins of a column.
    struct Places(Bins);

    impl Consumer<1> for Places {
        type Lanes<S: Simd> = Vec<f64>;
        type Output = Vec<f64>;

        fn begin<S: Simd>(&self, _: S) -> Vec<f64> {
            Vec::new()
        }

        fn take<S: Simd>(
            &mut self,
            places: &mut Vec<f64>,
            _: usize,
            rows: usize,
            [value]: &[Pack<S>; 1],
        ) {
            let found = self.0.places_of::<S, WithGaps>(*value);
            places.extend(&found.as_slice()[..rows]);
        }

        fn end<S: Simd>(&self, places: Vec<f64>) -> Vec<f64> {
            places
        }
    }

    #[test]
    fn every_end_is_in_the_bin_that_begins_there() {
        for (low, high, bins) in [(0.0, 1.0, 100), (-0.3, 0.7, 77), (1e-3, 0.1, 1000)] {
            let ends = Statistic::Histogram { low, high, bins }.bin_ends();
            let count = bins;
            let mut places = Places(Bins { low, high, count });
            let level = Level::best();
            let found = fold::<Itself, _, 0, 1, 1>(level, &[], [&ends], &mut places).unwrap();
            let expected = (1..=bins).chain([bins]).map(f64::from);
            assert_eq!(found, expected.collect::<Vec<_>>());
            let below: Vec<_> = ends.iter().map(|end| end.next_down()).collect();
            let found = fold::<Itself, _, 0, 1, 1>(level, &[], [&below], &mut places).unwrap();
            assert_eq!(found, (0..=bins).map(f64::from).collect::<Vec<_>>());
        }
    }

    #[test]
    fn bins_have_their_lower_end_and_the_last_one_both() {
        let bins = Bins {
            low: 0.0,
            high: 2.0,
            count: 4,
        };
        let values = [-0.1, 0.0, 0.5, f64::NAN, 1.5, 2.0, 2.1, 1e300, -1e300];
        for level in Level::available() {
            let places = &mut Places(bins);
            let found = fold::<Itself, _, 0, 1, 1>(level, &[], [&values], places).unwrap();
            assert!(found[3].is_nan());
            let numbers = found.into_iter().filter(|place| !place.is_nan());
            let numbers: Vec<_> = numbers.collect();
            assert_eq!(numbers, [0.0, 1.0, 2.0, 4.0, 4.0, 5.0, 5.0, 0.0], "{level}");
        }
    }
}
