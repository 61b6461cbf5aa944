//! Reduces the quantities of a block where their numbers arise: there is no column of them.

use std::marker::PhantomData;

use lanes::{Consumer, Kernel, Level, Pack, Simd, fold};

use crate::batch::extremes::Extremes;

use super::accumulator::Accumulator;
use super::summary::{Found, Gaps, Lanes, Pass, Summary, Tally, Wanted};

/// What is to be known of the quantities of a block, and what was found.
#[derive(Debug)]
pub(crate) struct Reducer {
    level: Level,
    wanted: Wanted,
    /// The point of the block's first row.
    pub(crate) first: u64,
    /// What was found of the block as a whole, for each quantity that was reduced.
    summaries: Vec<Option<Summary>>,
    /// What is kept of each row of the block, for each quantity.
    accumulators: Vec<Vec<Accumulator>>,
}

impl Reducer {
    /// Creates a reducer of so many quantities: `wanted` of each block as a whole, `accumulators` for each of its rows.
    pub(crate) fn new(wanted: Wanted, accumulators: &[Accumulator], quantities: usize) -> Self {
        Self {
            level: Level::best(),
            wanted,
            first: 0,
            summaries: vec![None; quantities],
            accumulators: vec![accumulators.to_vec(); quantities],
        }
    }

    /// What is wanted of a block as a whole.
    pub(crate) const fn wanted(&self) -> &Wanted {
        &self.wanted
    }

    /// What was found of a quantity's block as a whole.
    pub(crate) fn summary(&self, quantity: usize) -> Option<&Summary> {
        self.summaries.get(quantity)?.as_ref()
    }

    /// What is kept of the rows of a quantity.
    pub(crate) fn accumulators(&mut self, quantity: usize) -> &mut [Accumulator] {
        self.accumulators
            .get_mut(quantity)
            .map_or(&mut [], Vec::as_mut_slice)
    }

    /// Whether only the extremes of a block are wanted.
    pub(crate) fn wants_extremes_alone(&self) -> bool {
        let of_rows = self.accumulators.iter().any(|of| !of.is_empty());
        self.wanted == Wanted::default() && !of_rows
    }

    /// Takes the extremes of a block of so many rows for a quantity of which nothing else is wanted.
    pub(crate) fn take_extremes(&mut self, quantity: usize, extremes: Extremes, rows: usize) {
        if let Some(summary) = self.summaries.get_mut(quantity) {
            *summary = Some(Summary::of_extremes(extremes, rows as u64));
        }
    }

    /// Takes what a kernel gives along columns of one length; result number i is of the quantity number `quantities[i]`. With
    /// [`Gaps`] some may be NaN, and take no part. None where lengths differ.
    pub(crate) fn reduce<K, G, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        quantities: [Option<usize>; RESULTS],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<[Extremes; RESULTS]>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
        G: Gaps,
    {
        let rows = along.first().map_or(0, |column| column.len()) as u64;
        let (tallies, accumulators) = self.begin(&quantities);
        let singly = self.wanted.has_tallies() || accumulators.iter().any(|of| !of.is_empty());
        let mut kept = Kept {
            pass: Pass::of(&self.wanted),
            wanted: &self.wanted,
            first: self.first as f64,
            tallies,
            accumulators,
        };
        let level = self.level;
        let found = if singly {
            let mut taking = Taking::<G, true, RESULTS>(&mut kept, PhantomData);
            fold::<K, _, FIXED, ALONG, RESULTS>(level, fixed, along, &mut taking)
        } else {
            let mut taking = Taking::<G, false, RESULTS>(&mut kept, PhantomData);
            fold::<K, _, FIXED, ALONG, RESULTS>(level, fixed, along, &mut taking)
        };
        let kept = (kept.tallies, kept.accumulators);
        let present = (!G::HAS_GAPS).then_some(rows);
        self.end(&quantities, kept, found.ok(), present)
    }

    /// Takes out what is kept of the quantities, for the time in which their numbers are taken.
    #[inline(never)]
    fn begin<const RESULTS: usize>(
        &mut self,
        quantities: &[Option<usize>; RESULTS],
    ) -> ([Tally; RESULTS], [Vec<Accumulator>; RESULTS]) {
        let accumulators = quantities.map(|place| {
            let of = place.and_then(|place| self.accumulators.get_mut(place));
            of.map(std::mem::take).unwrap_or_default()
        });
        (
            [(); RESULTS].map(|()| Tally::of(&self.wanted)),
            accumulators,
        )
    }

    /// Keeps what was found of the quantities; `present` is how many numbers each has, if there are no gaps.
    #[inline(never)]
    fn end<const RESULTS: usize>(
        &mut self,
        quantities: &[Option<usize>; RESULTS],
        (tallies, accumulators): ([Tally; RESULTS], [Vec<Accumulator>; RESULTS]),
        found: Option<[Found; RESULTS]>,
        present: Option<u64>,
    ) -> Option<[Extremes; RESULTS]> {
        for (place, accumulators) in quantities.iter().zip(accumulators) {
            if let Some(place) = place {
                self.accumulators[*place] = accumulators;
            }
        }
        let mut extremes = [Extremes::NONE; RESULTS];
        let all = found?.into_iter().zip(tallies);
        for ((place, extremes), (found, tally)) in quantities.iter().zip(&mut extremes).zip(all) {
            let summary = found.with(tally, &self.wanted, present);
            *extremes = summary.extremes;
            if let Some(place) = place {
                self.summaries[*place] = Some(summary);
            }
        }
        Some(extremes)
    }
}

/// What is kept of columns while their numbers are taken, beside what is in packs.
struct Kept<'a, const RESULTS: usize> {
    pass: Pass,
    wanted: &'a Wanted,
    /// The point of the first row.
    first: f64,
    tallies: [Tally; RESULTS],
    accumulators: [Vec<Accumulator>; RESULTS],
}

/// Takes numbers for their columns as a whole, in packs, and with `SINGLY` what takes them one by one or row by row too: the
/// loop without keeps its numbers in registers.
struct Taking<'a, 'b, G, const SINGLY: bool, const RESULTS: usize>(
    &'a mut Kept<'b, RESULTS>,
    PhantomData<G>,
);

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl<G: Gaps, const SINGLY: bool, const RESULTS: usize> Consumer<RESULTS>
    for Taking<'_, '_, G, SINGLY, RESULTS>
{
    type Lanes<S: Simd> = Lanes<S, RESULTS>;
    type Output = [Found; RESULTS];

    #[inline(always)]
    fn begin<S: Simd>(&self, simd: S) -> Lanes<S, RESULTS> {
        Lanes::begin(simd)
    }

    #[inline(always)]
    fn take<S: Simd>(
        &mut self,
        lanes: &mut Lanes<S, RESULTS>,
        first: usize,
        rows: usize,
        results: &[Pack<S>; RESULTS],
    ) {
        let kept = &mut *self.0;
        lanes.take::<G>(kept.pass, (first, rows), results);
        if SINGLY {
            for place in 0..RESULTS {
                kept.tallies[place].take::<S, G>(kept.wanted, rows, results[place]);
                for accumulator in &mut kept.accumulators[place] {
                    accumulator.take::<S, G>(first, kept.first + first as f64, results[place]);
                }
            }
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, lanes: Lanes<S, RESULTS>) -> [Found; RESULTS] {
        lanes.end()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Statistic, WithGaps, WithoutGaps};
    use super::*;

    /// A column as it is, and its squares.
    struct Squares;

    impl Kernel<0, 1, 2> for Squares {
        #[inline(always)]
        fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 2] {
            [x, x * x]
        }
    }

    const STATISTICS: [Statistic; 9] = [
        Statistic::Maximum,
        Statistic::Minimum,
        Statistic::ArgMaximum,
        Statistic::ArgMinimum,
        Statistic::Mean,
        Statistic::CountAbove(-1.0),
        Statistic::CountAbove(0.25),
        Statistic::CountAbove(1.0),
        Statistic::Histogram {
            low: -0.5,
            high: 1.5,
            bins: 4,
        },
    ];

    /// Halves from -2 to 2, each more than once in a longer column, so that sums are exact; with gaps every fourth is NaN.
    fn column(length: usize, from: usize, gaps: bool) -> Vec<f64> {
        let value = |row: usize| match (row + from) % 4 {
            1 if gaps => f64::NAN,
            _ => ((row + from) * 5 % 9) as f64 / 2.0 - 2.0,
        };
        (0..length).map(value).collect()
    }

    fn reducer(level: Level, accumulators: &[Accumulator]) -> Reducer {
        let mut wanted = Wanted::default();
        STATISTICS
            .into_iter()
            .for_each(|statistic| wanted.add(statistic));
        let reducer = Reducer::new(wanted, accumulators, 2);
        Reducer { level, ..reducer }
    }

    fn take(reducer: &mut Reducer, values: &[f64], gaps: bool) {
        let places = [Some(0), Some(1)];
        let taken = if gaps {
            reducer.reduce::<Squares, WithGaps, 0, 1, 2>(places, &[], [values])
        } else {
            reducer.reduce::<Squares, WithoutGaps, 0, 1, 2>(places, &[], [values])
        };
        assert!(taken.is_some());
    }

    /// Numbers above a threshold of those that are no NaN.
    fn above(values: &[f64], threshold: f64) -> u64 {
        values.iter().filter(|value| **value > threshold).count() as u64
    }

    /// How many numbers are in each bin of the histogram, and below and above all of them.
    fn counts(values: &[f64]) -> Vec<u64> {
        let ends = [f64::NEG_INFINITY, -0.5, 0.0, 0.5, 1.0];
        let within = ends.windows(2).map(|ends| {
            let in_bin = |value: &&f64| **value >= ends[0] && **value < ends[1];
            values.iter().filter(in_bin).count() as u64
        });
        let last = values.iter().filter(|value| (1.0..=1.5).contains(*value));
        let last = last.count() as u64;
        within.chain([last, above(values, 1.5)]).collect()
    }

    #[test]
    fn a_column_as_a_whole_is_what_its_numbers_say() {
        for (length, gaps) in [1, 2, 7, 8, 9, 16, 35]
            .into_iter()
            .flat_map(|n| [(n, false), (n, true)])
        {
            let values = column(length, 0, gaps);
            let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
            for level in Level::available() {
                let mut reducer = reducer(level, &[]);
                take(&mut reducer, &values, gaps);
                for (place, column) in [&values, &squares].into_iter().enumerate() {
                    let found = reducer.summary(place).unwrap();
                    let numbers: Vec<f64> = column
                        .iter()
                        .copied()
                        .filter(|value| !value.is_nan())
                        .collect();
                    let row = |wanted: f64| column.iter().position(|value| *value == wanted);
                    let extremes = Extremes::of(column);
                    assert_eq!(found.extremes, extremes, "{level}");
                    assert_eq!(Some(found.first_least), row(extremes.least), "{level}");
                    assert_eq!(
                        Some(found.first_greatest),
                        row(extremes.greatest),
                        "{level}"
                    );
                    assert_eq!(found.present, numbers.len() as u64);
                    assert_eq!(found.sum, numbers.iter().sum::<f64>());
                    let expected = [-1.0, 0.25, 1.0].map(|threshold| above(column, threshold));
                    assert_eq!(found.above, expected, "{level} {length}");
                    assert_eq!(found.counts, [counts(column)], "{level} {length}");
                }
            }
        }
    }

    #[test]
    fn each_row_is_what_its_numbers_of_all_columns_say() {
        const COLUMNS: usize = 5;
        for (length, gaps) in [1, 2, 7, 9, 35]
            .into_iter()
            .flat_map(|n| [(n, false), (n, true)])
        {
            for level in Level::available() {
                let mut reducer = reducer(level, &STATISTICS.map(Accumulator::new));
                let columns: Vec<_> = (0..COLUMNS)
                    .map(|from| column(length, from, gaps))
                    .collect();
                let empty = |statistic: &Statistic| match statistic {
                    Statistic::Maximum | Statistic::ArgMaximum => f64::NEG_INFINITY,
                    Statistic::Minimum | Statistic::ArgMinimum => f64::INFINITY,
                    _ => 0.0,
                };
                for place in 0..2 {
                    for accumulator in reducer.accumulators(place) {
                        let value = empty(&accumulator.statistic());
                        let zeros = vec![0.0; length];
                        accumulator.resume([&vec![value; length], &zeros, &zeros]);
                    }
                }
                for (number, values) in columns.iter().enumerate() {
                    reducer.first = (100 * number) as u64;
                    take(&mut reducer, values, gaps);
                }
                for row in 0..length {
                    let values: Vec<f64> = columns.iter().map(|column| column[row]).collect();
                    let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
                    assert_row(reducer.accumulators(0), row, &values);
                    assert_row(reducer.accumulators(1), row, &squares);
                }
            }
        }
    }

    /// Holds what was kept of a row to its numbers in each column.
    fn assert_row(accumulators: &[Accumulator], row: usize, values: &[f64]) {
        let numbers: Vec<f64> = values
            .iter()
            .copied()
            .filter(|value| !value.is_nan())
            .collect();
        let extremes = Extremes::of(values);
        let point = |wanted: f64| {
            let column = values.iter().position(|value| *value == wanted);
            column.map_or(0, |column| 100 * column + row) as f64
        };
        for accumulator in accumulators {
            let [kept, number, rest] = accumulator.kept().map(|kept| kept[row]);
            assert_eq!(rest, 0.0, "these sums are exact");
            match accumulator.statistic() {
                Statistic::Maximum => assert_eq!(kept, extremes.greatest),
                Statistic::Minimum => assert_eq!(kept, extremes.least),
                Statistic::ArgMaximum => {
                    assert_eq!(
                        (kept, number),
                        (extremes.greatest, point(extremes.greatest))
                    );
                }
                Statistic::ArgMinimum => {
                    assert_eq!((kept, number), (extremes.least, point(extremes.least)));
                }
                Statistic::Mean => {
                    assert_eq!((kept, number), (numbers.iter().sum(), numbers.len() as f64));
                }
                Statistic::CountAbove(threshold) => {
                    assert_eq!(number, above(values, threshold) as f64);
                }
                // That of the last column, to be counted by whoever has the counts.
                Statistic::Histogram { .. } => {
                    let last = &values[values.len() - 1..];
                    let place = counts(last).iter().position(|count| *count == 1);
                    assert_eq!(
                        place.map(|place| place as f64),
                        (!number.is_nan()).then_some(number)
                    );
                }
            }
        }
    }
}
