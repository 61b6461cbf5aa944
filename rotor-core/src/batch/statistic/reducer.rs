//! Reduces the quantities of a block where their numbers arise: there is no column of them.

#[cfg(test)]
mod tests;

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
