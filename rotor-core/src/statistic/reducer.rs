//! Reduces the quantities of a block where their numbers arise: there is no column of them.

use std::marker::PhantomData;

use lanes::{Consumer, Kernel, Level, Pack, Simd, fold};

use crate::extremes::Extremes;

use super::accumulator::Accumulator;
use super::summary::{Found, Gaps, Lanes, Pass, Summary, Tally, Wanted};

/// What is to be known of the quantities of a block, and what was found.
#[derive(Debug)]
pub(crate) struct Reducer {
    wanted: Wanted,
    /// The point of the block's first row.
    pub(crate) first: u64,
    /// The block as a whole, for each quantity that was reduced.
    summaries: Vec<Option<Summary>>,
    /// Each of its rows, for each quantity.
    accumulators: Vec<Vec<Accumulator>>,
}

impl Reducer {
    /// For so many quantities, of each of which this is wanted as a whole and these are of its rows.
    pub(crate) fn new(wanted: Wanted, accumulators: &[Accumulator], quantities: usize) -> Self {
        Self {
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
    pub(crate) fn is_of_extremes(&self) -> bool {
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
    pub(crate) fn take<K, G, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        quantities: [Option<usize>; RESULTS],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<[Extremes; RESULTS]>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
        G: Gaps,
    {
        let mut places = quantities.iter().flatten();
        let of_rows = places.any(|place| !self.accumulators[*place].is_empty());
        if of_rows || self.wanted.has_tallies() {
            self.run::<K, G, true, FIXED, ALONG, RESULTS>(quantities, fixed, along)
        } else {
            self.run::<K, G, false, FIXED, ALONG, RESULTS>(quantities, fixed, along)
        }
    }

    fn run<K, G, const SINGLY: bool, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
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
        let mut taking = Taking::<'_, G, SINGLY, RESULTS> {
            gaps: PhantomData,
            pass: Pass::of(&self.wanted),
            wanted: &self.wanted,
            first: self.first as f64,
            has_tallies: self.wanted.has_tallies(),
            tallies: [(); RESULTS].map(|()| Tally::of(&self.wanted)),
            accumulators: quantities.map(|place| {
                place
                    .map(|place| std::mem::take(&mut self.accumulators[place]))
                    .unwrap_or_default()
            }),
        };
        let found = fold::<K, _, FIXED, ALONG, RESULTS>(Level::best(), fixed, along, &mut taking);
        let Taking {
            tallies,
            accumulators,
            ..
        } = taking;
        for (place, accumulators) in quantities.iter().zip(accumulators) {
            if let Some(place) = place {
                self.accumulators[*place] = accumulators;
            }
        }
        let mut extremes = [Extremes::NONE; RESULTS];
        let all = found
            .ok()?
            .into_iter()
            .zip(tallies)
            .zip(quantities)
            .zip(&mut extremes);
        for (((found, tally), place), extremes) in all {
            let summary = found.with(tally, &self.wanted, (!G::HAS_GAPS).then_some(rows));
            *extremes = summary.extremes;
            if let Some(place) = place {
                self.summaries[place] = Some(summary);
            }
        }
        Some(extremes)
    }
}

/// Takes numbers for their columns as a whole and, with `EACH`, for each row.
struct Taking<'a, G, const SINGLY: bool, const RESULTS: usize> {
    gaps: PhantomData<G>,
    pass: Pass,
    wanted: &'a Wanted,
    /// The point of the first row.
    first: f64,
    has_tallies: bool,
    tallies: [Tally; RESULTS],
    accumulators: [Vec<Accumulator>; RESULTS],
}

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl<G: Gaps, const SINGLY: bool, const RESULTS: usize> Consumer<RESULTS>
    for Taking<'_, G, SINGLY, RESULTS>
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
        lanes.take::<G>(self.pass, (first, rows), results);
        if SINGLY {
            for place in 0..RESULTS {
                if self.has_tallies {
                    self.tallies[place].take::<S, G>(self.wanted, rows, results[place]);
                }
                for accumulator in &mut self.accumulators[place] {
                    accumulator.take::<S, G>(first, self.first + first as f64, results[place]);
                }
            }
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, lanes: Lanes<S, RESULTS>) -> [Found; RESULTS] {
        lanes.end()
    }
}
