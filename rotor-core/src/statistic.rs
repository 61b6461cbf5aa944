//! What is kept of many numbers: of a column as a whole, and of each of its rows while others of its kind pass.

mod accumulator;
mod reducer;
mod summary;

use std::fmt;

pub(crate) use accumulator::Accumulator;
pub(crate) use reducer::Reducer;
pub(crate) use summary::{Gaps, Summary, Wanted};

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

    /// Where a value is counted.
    pub(crate) fn place(self, value: f64) -> usize {
        if value < self.low {
            0
        } else if value > self.high {
            self.count as usize + 1
        } else {
            // Rounding may lead past the last bin, whose upper end belongs to it.
            let share = (value - self.low) / (self.high - self.low);
            1 + ((share * f64::from(self.count)) as usize).min(self.count as usize - 1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_have_their_lower_end_and_the_last_one_both() {
        let bins = Bins {
            low: 0.0,
            high: 2.0,
            count: 4,
        };
        let places = [-0.1, 0.0, 0.5, 1.5, 2.0, 2.1].map(|value| bins.place(value));
        assert_eq!(places, [0, 1, 2, 4, 4, 5]);
    }
}
