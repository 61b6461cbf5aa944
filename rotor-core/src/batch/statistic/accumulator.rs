//! What is kept of each row of a column while columns pass: the reduction of many rows of a grid to one.

use lanes::{LONGEST, Pack, Simd};

use super::summary::{Gaps, above, numbered, present, without_gaps};
use super::{Bins, Statistic};

/// A statistic of every row of a block of numbers. It takes them in packs, and has room for those beyond the last row, which
/// mean nothing.
#[derive(Clone, Debug)]
pub(crate) struct Accumulator {
    statistic: Statistic,
    rows: usize,
    /// The largest or smallest numbers, or the sums.
    values: Vec<f64>,
    /// The points of these, or how many numbers there were; of a histogram the bins in which the last ones are.
    numbers: Vec<f64>,
    /// What rounding has taken from the sums.
    rests: Vec<f64>,
}

impl Accumulator {
    /// Creates an accumulator that has seen no rows.
    pub(crate) const fn new(statistic: Statistic) -> Self {
        Self {
            statistic,
            rows: 0,
            values: Vec::new(),
            numbers: Vec::new(),
            rests: Vec::new(),
        }
    }

    /// The statistic.
    pub(crate) const fn statistic(&self) -> Statistic {
        self.statistic
    }

    /// Goes on from what was kept of these rows: values, numbers and rests.
    pub(crate) fn resume(&mut self, kept: [&[f64]; 3]) {
        let [values, ..] = kept;
        self.resize(values.len());
        let lists = [&mut self.values, &mut self.numbers, &mut self.rests];
        for (list, kept) in lists.into_iter().zip(kept) {
            list[..kept.len()].copy_from_slice(kept);
        }
    }

    /// Makes room for so many rows, of which nothing is kept from one column to the next, as of a histogram.
    pub(crate) fn resize(&mut self, rows: usize) {
        self.rows = rows;
        for list in [&mut self.values, &mut self.numbers, &mut self.rests] {
            list.resize(rows.next_multiple_of(LONGEST), 0.0);
        }
    }

    /// What is kept of the rows: values, numbers and rests.
    pub(crate) fn kept(&self) -> [&[f64]; 3] {
        [&self.values, &self.numbers, &self.rests].map(|list| &list[..self.rows])
    }

    /// Takes the numbers of a pack of rows from `first` on, of which the first is that of the point `point`. What is NaN
    /// takes no part, if there may be such.
    #[inline(always)]
    pub(super) fn take<S: Simd, G: Gaps>(&mut self, first: usize, point: f64, value: Pack<S>) {
        let simd = value.simd();
        let rows = first..first + Pack::<S>::LENGTH;
        let (values, numbers) = (
            &mut self.values[rows.clone()],
            &mut self.numbers[rows.clone()],
        );
        // Not as an array: its adapters are functions of their own.
        let (kept, number) = (Pack::load(simd, values), Pack::load(simd, numbers));
        match self.statistic {
            Statistic::Maximum => kept.max(value).store(values),
            Statistic::Minimum => kept.min(value).store(values),
            Statistic::ArgMaximum => {
                let value = without_gaps::<S, G>(value, f64::NEG_INFINITY);
                let here = numbered(simd, point);
                value.select_le(kept, number, here).store(numbers);
                kept.max(value).store(values);
            }
            Statistic::ArgMinimum => {
                let value = without_gaps::<S, G>(value, f64::INFINITY);
                let here = numbered(simd, point);
                kept.select_le(value, number, here).store(numbers);
                kept.min(value).store(values);
            }
            Statistic::Mean => {
                let rests = &mut self.rests[rows];
                let term = without_gaps::<S, G>(value, 0.0);
                // What the sum has lost by rounding, whichever is the larger of both (Knuth).
                let sum = kept + term;
                let taken = sum - kept;
                let lost = (kept - (sum - taken)) + (term - taken);
                sum.store(values);
                (Pack::load(simd, rests) + lost).store(rests);
                (number + present(value)).store(numbers);
            }
            Statistic::CountAbove(threshold) => {
                let value = without_gaps::<S, G>(value, f64::NEG_INFINITY);
                (number + above(value, threshold)).store(numbers);
            }
            Statistic::Histogram { low, high, bins } => {
                let count = bins;
                let bins = Bins { low, high, count };
                bins.places_of::<S, G>(value).store(numbers);
            }
        }
    }
}
