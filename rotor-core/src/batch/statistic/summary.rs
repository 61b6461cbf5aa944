//! What is asked of a column as a whole, and how it is taken from packs of its numbers.

use lanes::{LONGEST, Pack, Simd};

use crate::batch::extremes::{Extremes, Span};

use super::{Bins, Statistic};

/// What is asked of a column besides its extremes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Wanted {
    /// Whether the rows of the extremes are asked for.
    pub(crate) places: bool,
    /// Whether the sum is asked for.
    pub(crate) sum: bool,
    /// Thresholds, of which the numbers above each are counted.
    pub(crate) thresholds: Vec<f64>,
    /// Histograms, of which the numbers in each bin are counted.
    pub(crate) bins: Vec<Bins>,
}

impl Wanted {
    /// Asks for what a statistic needs.
    pub(crate) fn add(&mut self, statistic: Statistic) {
        match statistic {
            Statistic::Maximum | Statistic::Minimum => {}
            Statistic::ArgMaximum | Statistic::ArgMinimum => self.places = true,
            Statistic::Mean => self.sum = true,
            Statistic::CountAbove(threshold) => self.thresholds.push(threshold),
            Statistic::Histogram { low, high, bins } => self.bins.push(Bins {
                low,
                high,
                count: bins,
            }),
        }
    }

    /// Whether anything is asked that is counted number by number, not in packs.
    pub(super) fn has_tallies(&self) -> bool {
        let (_, further) = self.thresholds();
        !(further.is_empty() && self.bins.is_empty())
    }

    /// The thresholds that a pass over a column counts in packs, and the others.
    fn thresholds(&self) -> (&[f64], &[f64]) {
        let in_packs = self.thresholds.len().min(IN_PACKS);
        self.thresholds.split_at(in_packs)
    }
}

/// What was found of a column as a whole.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Summary {
    /// The least and the greatest number.
    pub(crate) extremes: Extremes,
    /// How many numbers there are, without those that are NaN.
    pub(crate) present: u64,
    /// The first row with the least number, where places were asked for.
    pub(crate) first_least: usize,
    /// The first row with the greatest.
    pub(crate) first_greatest: usize,
    /// The sum, where it was asked for.
    pub(crate) sum: f64,
    /// How many numbers are above each threshold.
    pub(crate) above: Vec<u64>,
    /// How many numbers are at each place of the bins.
    pub(crate) counts: Vec<Vec<u64>>,
}

impl Summary {
    /// Creates the summary of a column of which only the extremes are asked for.
    pub(crate) const fn of_extremes(extremes: Extremes, present: u64) -> Self {
        Self {
            extremes,
            present,
            first_least: 0,
            first_greatest: 0,
            sum: 0.0,
            above: Vec::new(),
            counts: Vec::new(),
        }
    }
}

/// Whether numbers of a column may be NaN, which take no part in anything.
pub(crate) trait Gaps {
    /// Whether there may be NaN.
    const HAS_GAPS: bool;
}

/// No number of the column is NaN.
pub(crate) struct WithoutGaps;

impl Gaps for WithoutGaps {
    const HAS_GAPS: bool = false;
}

/// Some numbers of the column may be NaN.
pub(crate) struct WithGaps;

impl Gaps for WithGaps {
    const HAS_GAPS: bool = true;
}

/// Numbers that are summed side by side; as many on every level, so that sums are the same everywhere.
pub(crate) const SUMS: usize = 8;

/// The thresholds whose counts are kept in packs.
const IN_PACKS: usize = 2;

/// The fewest rows of a pack.
const SHORTEST: usize = 2;

/// What a pass over columns looks at in each pack, settled before the pass begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    places: bool,
    sum: bool,
    thresholds: [f64; IN_PACKS],
    in_packs: usize,
}

impl Pass {
    pub(super) fn of(wanted: &Wanted) -> Self {
        let (in_packs, _) = wanted.thresholds();
        let mut thresholds = [f64::INFINITY; IN_PACKS];
        thresholds[..in_packs.len()].copy_from_slice(in_packs);
        Self {
            places: wanted.places,
            sum: wanted.sum,
            thresholds,
            in_packs: in_packs.len(),
        }
    }
}

/// What is kept in packs for each column. Nothing of it has an address, so that it stays in registers.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd, const COLUMNS: usize> {
    extremes: [[Pack<S>; 3]; COLUMNS],
    /// The rows of the least and of the greatest number.
    places: [[Pack<S>; 2]; COLUMNS],
    sums: [[Pack<S>; SUMS / SHORTEST]; COLUMNS],
    above: [[Pack<S>; IN_PACKS]; COLUMNS],
    present: [Pack<S>; COLUMNS],
}

/// What is counted number by number: numbers above thresholds beyond those counted in packs, and numbers in bins.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    above: Vec<[f64; LONGEST]>,
    counts: Vec<Vec<u64>>,
}

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl Tally {
    pub(super) fn of(wanted: &Wanted) -> Self {
        let (_, further) = wanted.thresholds();
        let empty = |bins: &Bins| vec![0; bins.places()];
        Self {
            above: vec![[0.0; LONGEST]; further.len()],
            counts: wanted.bins.iter().map(empty).collect(),
        }
    }

    /// Takes `rows` rows of the column. What is NaN takes no part, if there may be such.
    #[inline(always)]
    pub(super) fn take<S: Simd, G: Gaps>(&mut self, wanted: &Wanted, rows: usize, value: Pack<S>) {
        let counted = only(
            rows,
            without_gaps::<S, G>(value, f64::NEG_INFINITY),
            f64::NEG_INFINITY,
        );
        for number in 0..self.above.len() {
            let count = &mut self.above[number][..Pack::<S>::LENGTH];
            let threshold = wanted.thresholds[IN_PACKS + number];
            (Pack::load(value.simd(), count) + above(counted, threshold)).store(count);
        }
        for number in 0..self.counts.len() {
            let counts = &mut self.counts[number];
            let places = wanted.bins[number].places_of::<S, G>(value);
            for row in 0..rows {
                let place = places.as_slice()[row];
                if !(G::HAS_GAPS && place.is_nan()) {
                    counts[place as usize] += 1;
                }
            }
        }
    }
}

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl<S: Simd, const COLUMNS: usize> Lanes<S, COLUMNS> {
    #[inline(always)]
    pub(super) fn begin(simd: S) -> Self {
        let none = Pack::splat(simd, 0.0);
        Self {
            extremes: Span::empty(simd),
            places: [[none; 2]; COLUMNS],
            sums: [[none; SUMS / SHORTEST]; COLUMNS],
            above: [[none; IN_PACKS]; COLUMNS],
            present: [none; COLUMNS],
        }
    }

    /// Takes `rows` rows of each column, from `first` on. What is NaN takes no part, if there may be such.
    #[inline(always)]
    pub(super) fn take<G: Gaps>(
        &mut self,
        pass: Pass,
        (first, rows): (usize, usize),
        values: &[Pack<S>; COLUMNS],
    ) {
        for place in 0..COLUMNS {
            let value = values[place];
            if pass.places {
                let [least, greatest, _] = self.extremes[place];
                let values = [
                    without_gaps::<S, G>(value, f64::INFINITY),
                    without_gaps::<S, G>(value, f64::NEG_INFINITY),
                ];
                self.places[place] = places(first, values, [least, greatest], self.places[place]);
            }
            if pass.sum {
                let slot = first / Pack::<S>::LENGTH % (SUMS / Pack::<S>::LENGTH);
                self.sums[place][slot] =
                    self.sums[place][slot] + only(rows, without_gaps::<S, G>(value, 0.0), 0.0);
            }
            for number in 0..IN_PACKS {
                if number < pass.in_packs {
                    let counted = without_gaps::<S, G>(value, f64::NEG_INFINITY);
                    let counted = only(rows, counted, f64::NEG_INFINITY);
                    let count = self.above[place][number];
                    self.above[place][number] = count + above(counted, pass.thresholds[number]);
                }
            }
            if G::HAS_GAPS {
                self.present[place] = self.present[place] + only(rows, present(value), 0.0);
            }
        }
        Span::widen(&mut self.extremes, values);
    }

    /// What was found of each column, without what is counted number by number.
    #[inline(always)]
    pub(super) fn end(self) -> [Found; COLUMNS] {
        let found: [Extremes; COLUMNS] = Span::spanned(self.extremes);
        std::array::from_fn(|place| {
            let [least, greatest, _] = self.extremes[place];
            let [of_least, of_greatest] = self.places[place];
            let sums = self.sums[place].iter().flat_map(Pack::as_slice);
            let total = |pack: &Pack<S>| pack.as_slice().iter().sum::<f64>() as u64;
            Found {
                extremes: found[place],
                present: total(&self.present[place]),
                first_least: first_with(least, found[place].least, of_least),
                first_greatest: first_with(greatest, found[place].greatest, of_greatest),
                sum: sums.take(SUMS).sum(),
                above: self.above[place].each_ref().map(total),
            }
        })
    }
}

/// What packs hold of a [`Summary`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    extremes: Extremes,
    present: u64,
    first_least: usize,
    first_greatest: usize,
    sum: f64,
    above: [u64; IN_PACKS],
}

impl Found {
    /// Adds what was counted number by number. `present` is how many numbers there are, where there are no gaps.
    pub(super) fn with(self, tally: Tally, wanted: &Wanted, present: Option<u64>) -> Summary {
        let (in_packs, _) = wanted.thresholds();
        let mut above = self.above[..in_packs.len()].to_vec();
        let total = |counts: &[f64; LONGEST]| counts.iter().sum::<f64>() as u64;
        above.extend(tally.above.iter().map(total));
        Summary {
            extremes: self.extremes,
            present: present.unwrap_or(self.present),
            first_least: self.first_least,
            first_greatest: self.first_greatest,
            sum: self.sum,
            above,
            counts: tally.counts,
        }
    }
}

/// Replaces NaN by another number, where there may be NaN.
#[inline(always)]
pub(super) fn without_gaps<S: Simd, G: Gaps>(value: Pack<S>, other: f64) -> Pack<S> {
    if !G::HAS_GAPS {
        return value;
    }
    let infinity = Pack::splat(value.simd(), f64::INFINITY);
    let other = Pack::splat(value.simd(), other);
    value.select_le(infinity, value, other)
}

/// 1 in the rows that are numbers, 0 in those that are NaN.
#[inline(always)]
pub(super) fn present<S: Simd>(value: Pack<S>) -> Pack<S> {
    let infinity = Pack::splat(value.simd(), f64::INFINITY);
    let (zero, one) = (
        Pack::splat(value.simd(), 0.0),
        Pack::splat(value.simd(), 1.0),
    );
    value.select_le(infinity, one, zero)
}

/// 1 in the rows that are above a threshold, 0 in the others.
#[inline(always)]
pub(super) fn above<S: Simd>(value: Pack<S>, threshold: f64) -> Pack<S> {
    let threshold = Pack::splat(value.simd(), threshold);
    let (zero, one) = (
        Pack::splat(value.simd(), 0.0),
        Pack::splat(value.simd(), 1.0),
    );
    value.select_le(threshold, zero, one)
}

/// The numbers of the rows from `first` on.
#[inline(always)]
pub(super) fn numbered<S: Simd>(simd: S, first: f64) -> Pack<S> {
    Pack::splat(simd, first).map_rows(
        #[inline(always)]
        |row, first| first + row as f64,
    )
}

/// The rows of the least and of the greatest number, with those of one more pack.
#[inline(always)]
fn places<S: Simd>(
    first: usize,
    [for_least, for_greatest]: [Pack<S>; 2],
    [least, greatest]: [Pack<S>; 2],
    [of_least, of_greatest]: [Pack<S>; 2],
) -> [Pack<S>; 2] {
    let row = numbered(for_least.simd(), first as f64);
    [
        least.select_le(for_least, of_least, row),
        for_greatest.select_le(greatest, of_greatest, row),
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

/// The first of the rows of those numbers that are the one wanted.
fn first_with<S: Simd>(numbers: Pack<S>, wanted: f64, rows: Pack<S>) -> usize {
    let rows = numbers.as_slice().iter().zip(rows.as_slice());
    let with = rows.filter(|(number, _)| **number == wanted);
    with.map(|(_, row)| *row as usize).min().unwrap_or(0)
}
