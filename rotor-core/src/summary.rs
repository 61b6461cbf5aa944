//! What statistics ask of a column, taken where its numbers arise: there is no column.

use std::cell::Cell;

use lanes::{Consumer, Kernel, Level, Pack, Simd, fold};

use crate::extremes::{Extremes, Span};

/// Bins of equal width. A bin has its lower end; the last one has both.
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

/// What is asked besides the extremes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Wanted {
    /// Where the extremes are.
    pub(crate) places: bool,
    /// The sum.
    pub(crate) sum: bool,
    /// How many numbers are above each of these, at most [`MOST_THRESHOLDS`].
    pub(crate) thresholds: Vec<f64>,
    /// How many numbers are in each of these.
    pub(crate) bins: Vec<Bins>,
}

/// What was found of a column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Summary {
    /// What it spans.
    pub(crate) extremes: Extremes,
    /// The first row with the least number, where places were asked for.
    pub(crate) first_least: usize,
    /// The first row with the greatest.
    pub(crate) first_greatest: usize,
    /// The sum, where it was asked for.
    pub(crate) sum: f64,
    /// How many numbers are above each threshold.
    pub(crate) above: [u64; MOST_THRESHOLDS],
    /// How many numbers are at each place of the bins.
    pub(crate) counts: Vec<Vec<u64>>,
}

impl From<Extremes> for Summary {
    fn from(extremes: Extremes) -> Self {
        Self {
            extremes,
            first_least: 0,
            first_greatest: 0,
            sum: 0.0,
            above: [0; MOST_THRESHOLDS],
            counts: Vec::new(),
        }
    }
}

impl Summary {
    /// Those of what a kernel gives along columns of one length; none where their lengths differ.
    pub(crate) fn along<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        level: Level,
        wanted: &Wanted,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<[Self; RESULTS]>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
    {
        let places = wanted.bins.iter().map(|bins| bins.places());
        let counts: Vec<_> = places.map(|places| vec![Cell::new(0); places]).collect();
        let summing = Summing {
            wanted,
            counts: [(); RESULTS].map(|()| counts.clone()),
        };
        let found = fold::<K, _, FIXED, ALONG, RESULTS>(level, fixed, along, &summing);
        let mut found = found.ok()?;
        for (summary, counts) in found.iter_mut().zip(summing.counts) {
            let counts = counts.iter().map(|of| of.iter().map(Cell::get).collect());
            summary.counts = counts.collect();
        }
        Some(found)
    }
}

/// Numbers that are summed side by side; as many on every level, so that sums are the same everywhere.
pub(crate) const SUMS: usize = 8;

/// The most thresholds of which numbers are counted at once.
pub(crate) const MOST_THRESHOLDS: usize = 2;

/// The fewest rows of a pack.
const SHORTEST: usize = 2;

/// Takes what is wanted of numbers that are finite.
struct Summing<'a, const RESULTS: usize> {
    wanted: &'a Wanted,
    /// The counts at the places of the bins, for each result.
    counts: [Vec<Vec<Cell<u64>>>; RESULTS],
}

/// What it keeps in packs for each result: nothing that has an address, so that it stays in registers.
#[derive(Clone, Copy)]
struct Kept<S: Simd, const RESULTS: usize> {
    extremes: [[Pack<S>; 3]; RESULTS],
    /// The rows of the least and of the greatest number.
    places: [[Pack<S>; 2]; RESULTS],
    sums: [[Pack<S>; SUMS / SHORTEST]; RESULTS],
    above: [[Pack<S>; MOST_THRESHOLDS]; RESULTS],
}

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl<const RESULTS: usize> Consumer<RESULTS> for Summing<'_, RESULTS> {
    type Lanes<S: Simd> = Kept<S, RESULTS>;
    type Output = [Summary; RESULTS];

    #[inline(always)]
    fn begin<S: Simd>(&self, simd: S) -> Kept<S, RESULTS> {
        let none = Pack::splat(simd, 0.0);
        Kept {
            extremes: Span.begin(simd),
            places: [[none; 2]; RESULTS],
            sums: [[none; SUMS / SHORTEST]; RESULTS],
            above: [[none; MOST_THRESHOLDS]; RESULTS],
        }
    }

    #[inline(always)]
    fn take<S: Simd>(
        &self,
        kept: &mut Kept<S, RESULTS>,
        first: usize,
        rows: usize,
        results: &[Pack<S>; RESULTS],
    ) {
        for place in 0..RESULTS {
            let value = results[place];
            if self.wanted.places {
                let [least, greatest, _] = kept.extremes[place];
                kept.places[place] = places(first, value, [least, greatest], kept.places[place]);
            }
            if self.wanted.sum {
                let slot = first / Pack::<S>::LENGTH % (SUMS / Pack::<S>::LENGTH);
                kept.sums[place][slot] = kept.sums[place][slot] + only(rows, value, 0.0);
            }
            for number in 0..MOST_THRESHOLDS {
                if number < self.wanted.thresholds.len() {
                    let counted = only(rows, value, f64::NEG_INFINITY);
                    let count = kept.above[place][number];
                    kept.above[place][number] =
                        count + above(counted, self.wanted.thresholds[number]);
                }
            }
            if !self.wanted.bins.is_empty() {
                // Elsewhere, so that the loop without has room for its numbers in registers.
                std::hint::cold_path();
                self.count(place, &value.as_slice()[..rows]);
            }
        }
        Span.take(&mut kept.extremes, first, rows, results);
    }

    #[inline(always)]
    fn end<S: Simd>(&self, kept: Kept<S, RESULTS>) -> [Summary; RESULTS] {
        let found: [Extremes; RESULTS] = Span.end(kept.extremes);
        std::array::from_fn(|place| {
            let [least, greatest, _] = kept.extremes[place];
            let [of_least, of_greatest] = kept.places[place];
            let extremes = found[place];
            let sums = kept.sums[place].iter().flat_map(Pack::as_slice);
            let total = |pack: &Pack<S>| pack.as_slice().iter().sum::<f64>() as u64;
            Summary {
                extremes,
                first_least: first_with(least, extremes.least, of_least),
                first_greatest: first_with(greatest, extremes.greatest, of_greatest),
                sum: sums.take(SUMS).sum(),
                above: kept.above[place].each_ref().map(total),
                counts: Vec::new(),
            }
        })
    }
}

impl<const RESULTS: usize> Summing<'_, RESULTS> {
    #[inline(never)]
    fn count(&self, place: usize, values: &[f64]) {
        for (bins, counts) in self.wanted.bins.iter().zip(&self.counts[place]) {
            for value in values {
                let count = &counts[bins.place(*value)];
                count.set(count.get() + 1);
            }
        }
    }
}

/// The rows of the least and of the greatest number, with those of one more pack.
#[inline(always)]
fn places<S: Simd>(
    first: usize,
    value: Pack<S>,
    [least, greatest]: [Pack<S>; 2],
    [of_least, of_greatest]: [Pack<S>; 2],
) -> [Pack<S>; 2] {
    let row = Pack::splat(value.simd(), first as f64).map_rows(
        #[inline(always)]
        |row, first| first + row as f64,
    );
    [
        least.select_le(value, of_least, row),
        value.select_le(greatest, of_greatest, row),
    ]
}

/// The pack with another number in the rows beyond the last, where there it repeats rows that are there.
#[inline(always)]
fn only<S: Simd>(rows: usize, value: Pack<S>, other: f64) -> Pack<S> {
    if rows == Pack::<S>::LENGTH {
        return value;
    }
    value.map_rows(
        #[inline(always)]
        |row, value| if row < rows { value } else { other },
    )
}

/// 1 in the rows that are above a threshold, 0 in the others.
#[inline(always)]
fn above<S: Simd>(value: Pack<S>, threshold: f64) -> Pack<S> {
    let [threshold, zero, one] = [
        Pack::splat(value.simd(), threshold),
        Pack::splat(value.simd(), 0.0),
        Pack::splat(value.simd(), 1.0),
    ];
    value.select_le(threshold, zero, one)
}

/// The first of the rows of those numbers that are the one wanted.
fn first_with<S: Simd>(numbers: Pack<S>, wanted: f64, rows: Pack<S>) -> usize {
    let rows = numbers.as_slice().iter().zip(rows.as_slice());
    let with = rows.filter(|(number, _)| **number == wanted);
    with.map(|(_, row)| *row as usize).min().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A column as it is, and its squares.
    struct Squares;

    impl Kernel<0, 1, 2> for Squares {
        #[inline(always)]
        fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 2] {
            [x, x * x]
        }
    }

    #[test]
    fn all_that_is_wanted_is_what_the_numbers_say() {
        let bins = Bins {
            low: -0.5,
            high: 1.5,
            count: 4,
        };
        let wanted = Wanted {
            places: true,
            sum: true,
            thresholds: vec![-1.0, 0.25],
            bins: vec![bins],
        };
        for length in [1, 2, 7, 8, 9, 16, 35] {
            // Halves from -2 to 2: each comes more than once in the longer columns, and sums are exact.
            let values: Vec<f64> = (0..length)
                .map(|row| f64::from(row * 5 % 9) / 2.0 - 2.0)
                .collect();
            for level in Level::available() {
                let found = Summary::along::<Squares, 0, 1, 2>(level, &wanted, &[], [&values]);
                let found = found.unwrap();
                let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
                for (column, found) in [&values, &squares].into_iter().zip(found) {
                    let place = |wanted: f64| column.iter().position(|value| *value == wanted);
                    let mut counts = vec![0; bins.places()];
                    column
                        .iter()
                        .for_each(|value| counts[bins.place(*value)] += 1);
                    let above = |threshold: f64| {
                        column.iter().filter(|value| **value > threshold).count() as u64
                    };
                    assert_eq!(found.extremes, Extremes::of(column));
                    assert_eq!(
                        Some(found.first_least),
                        place(found.extremes.least),
                        "{level}"
                    );
                    assert_eq!(
                        Some(found.first_greatest),
                        place(found.extremes.greatest),
                        "{level}"
                    );
                    assert_eq!(found.sum, column.iter().sum::<f64>());
                    assert_eq!(found.above, [above(-1.0), above(0.25)]);
                    assert_eq!(found.counts, [counts]);
                }
            }
        }
    }

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
