//! Where the numbers of a block go from the loop that computes them: to columns, or into reductions.

use lanes::{ALL, Kernel, Level, Pack, Simd, store};

use crate::batch::extremes::Extremes;
use crate::batch::statistic::{Gaps, Reducer, WithGaps, WithoutGaps};

use super::list::{FINITE, SIZES, Test, require};

/// What the numbers of a quantity are.
pub(super) trait Kind {
    /// Whether they may be NaN, where the quantity does not exist.
    type Gaps: Gaps;
    /// What they have to be: where one is not, the quantity may not exist.
    const TEST: Option<&'static Test> = None;
    /// Whether a zero may be among them, which has no sign.
    const HAS_ZEROS: bool = true;
}

/// They are positive, with all their digits.
pub(super) struct Positive;

impl Kind for Positive {
    type Gaps = WithoutGaps;
    const TEST: Option<&'static Test> = Some(&SIZES);
    const HAS_ZEROS: bool = false;
}

/// They are finite.
pub(super) struct Finite;

impl Kind for Finite {
    type Gaps = WithoutGaps;
    const TEST: Option<&'static Test> = Some(&FINITE);
}

/// They are finite where the quantity exists, and NaN elsewhere.
pub(super) struct Partial;

impl Kind for Partial {
    type Gaps = WithGaps;
}

/// Takes what kernels give along columns of a block. None where that cannot be done.
pub(super) trait Destination {
    /// One result: the quantity at a place among those asked for.
    fn single<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        place: usize,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 1>,
        T: Kind;

    /// Two results, of which one need not be asked for.
    fn pair<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        places: [Option<usize>; 2],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 2>,
        T: Kind;

    /// A number that all points have; `along` is any column of them.
    fn same<T: Kind>(&mut self, place: usize, number: f64, along: &[f64]) -> Option<()> {
        self.single::<Same, T, 1, 1>(place, &[number], [along])
    }

    /// Two results whose squares another kernel gives, where these are enough; whether they are.
    fn squares<K, const FIXED: usize, const ALONG: usize>(
        &mut self,
        places: [Option<usize>; 2],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<bool>
    where
        K: Kernel<FIXED, ALONG, 2>;
}

/// The fixed number.
struct Same;

impl Kernel<1, 1, 1> for Same {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, fixed: [Pack<S>; 1], _: [Pack<S>; 1]) -> [Pack<S>; 1] {
        fixed
    }
}

/// Columns, one for each quantity.
pub(super) struct Columns<'a, 'b> {
    pub(super) results: &'a mut [&'b mut [f64]],
    /// The points whose numbers are what they are for that rotor alone, and whether that is all of them.
    pub(super) known: &'a mut [bool],
    pub(super) all_are_known: bool,
    /// Whether a quantity may be missing at points that are known.
    pub(super) has_gaps: bool,
}

impl Columns<'_, '_> {
    fn check<T: Kind>(&mut self, place: usize) {
        let values = &mut *self.results[place];
        if let Some(test) = T::TEST {
            self.all_are_known &= require(values, self.known, test);
        }
        self.has_gaps |= T::Gaps::HAS_GAPS;
        if T::HAS_ZEROS {
            // A zero has no sign.
            values.iter_mut().for_each(|value| *value += 0.0);
        }
    }
}

impl Destination for Columns<'_, '_> {
    fn single<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        place: usize,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 1>,
        T: Kind,
    {
        let result = [&mut *self.results[place]];
        store::<K, ALL, FIXED, ALONG, 1>(Level::best(), fixed, along, result).ok()?;
        self.check::<T>(place);
        Some(())
    }

    fn pair<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        places: [Option<usize>; 2],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 2>,
        T: Kind,
    {
        const FIRST: u64 = 0b01;
        const SECOND: u64 = 0b10;
        let mut slices = [&mut [][..], &mut []];
        for (place, result) in self.results.iter_mut().enumerate() {
            if let Some(number) = places.iter().position(|known| *known == Some(place)) {
                slices[number] = &mut **result;
            }
        }
        let level = Level::best();
        let stored = match places {
            [Some(_), None] => store::<K, FIRST, FIXED, ALONG, 2>(level, fixed, along, slices),
            [None, Some(_)] => store::<K, SECOND, FIXED, ALONG, 2>(level, fixed, along, slices),
            _ => store::<K, ALL, FIXED, ALONG, 2>(level, fixed, along, slices),
        };
        stored.ok()?;
        for place in places.into_iter().flatten() {
            self.check::<T>(place);
        }
        Some(())
    }

    fn squares<K, const FIXED: usize, const ALONG: usize>(
        &mut self,
        _: [Option<usize>; 2],
        _: &[f64; FIXED],
        _: [&[f64]; ALONG],
    ) -> Option<bool>
    where
        K: Kernel<FIXED, ALONG, 2>,
    {
        Some(false)
    }
}

/// Numbers that may not be what they are for that rotor alone cannot be reduced.
fn checked<T: Kind, const RESULTS: usize>(
    extremes: [Extremes; RESULTS],
    places: [Option<usize>; RESULTS],
) -> Option<()> {
    let mut wanted = extremes
        .iter()
        .zip(places)
        .filter(|(_, place)| place.is_some());
    let holds = |extremes: &Extremes| T::TEST.is_none_or(|test| (test.of_all)(extremes));
    wanted.all(|(extremes, _)| holds(extremes)).then_some(())
}

impl Destination for Reducer {
    fn single<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        place: usize,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 1>,
        T: Kind,
    {
        let places = [Some(place)];
        checked::<T, 1>(
            self.take::<K, T::Gaps, FIXED, ALONG, 1>(places, fixed, along)?,
            places,
        )
    }

    fn pair<K, T, const FIXED: usize, const ALONG: usize>(
        &mut self,
        places: [Option<usize>; 2],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, 2>,
        T: Kind,
    {
        checked::<T, 2>(
            self.take::<K, T::Gaps, FIXED, ALONG, 2>(places, fixed, along)?,
            places,
        )
    }

    fn squares<K, const FIXED: usize, const ALONG: usize>(
        &mut self,
        places: [Option<usize>; 2],
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<bool>
    where
        K: Kernel<FIXED, ALONG, 2>,
    {
        if !self.is_of_extremes() {
            return Some(false);
        }
        let rows = along.first().map_or(0, |column| column.len());
        let roots = Extremes::along::<K, FIXED, ALONG, 2>(fixed, along).map(Extremes::of_roots);
        checked::<Positive, 2>(roots, places)?;
        for (place, roots) in places.iter().zip(roots) {
            if let Some(place) = place {
                self.take_extremes(*place, roots, rows);
            }
        }
        Some(true)
    }
}
