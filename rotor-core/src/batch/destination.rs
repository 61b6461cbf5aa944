//! Where the numbers of a block go from the loop that computes them: to columns, or into reductions.

use lanes::{ALL, Kernel, Level, Pack, Simd, store};

use crate::batch::extremes::Extremes;
use crate::batch::statistic::{Gaps, Reducer};

use super::list::{FINITE, SIZES, Test, require};

/// What the numbers of a quantity have to be.
#[derive(Clone, Copy)]
pub(super) struct Requirement {
    /// Where one does not pass, the quantity may not exist.
    test: Option<&'static Test>,
    /// Whether a zero may be among them, which has no sign.
    has_zeros: bool,
}

/// They are positive, with all their digits.
pub(super) const POSITIVE_NUMBER: Requirement = Requirement {
    test: Some(&SIZES),
    has_zeros: false,
};

/// They are finite.
pub(super) const FINITE_NUMBER: Requirement = Requirement {
    test: Some(&FINITE),
    has_zeros: true,
};

/// They are finite where the quantity exists, and NaN elsewhere.
pub(super) const PARTIAL: Requirement = Requirement {
    test: None,
    has_zeros: true,
};

/// Takes what kernels give along columns of a block. None where that cannot be done.
pub(super) trait Destination {
    /// Takes results, each for a place among the quantities asked for, or for none.
    fn take<K, G, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
        G: Gaps;

    /// Takes a number that all points have; `along` is any column of them.
    fn same<G: Gaps>(
        &mut self,
        place: Option<usize>,
        requirement: Requirement,
        number: f64,
        along: &[f64],
    ) -> Option<()> {
        self.take::<Same, G, 1, 1, 1>([place], requirement, &[number], [along])
    }

    /// Whether only the extremes are wanted, for which the squares of positive results are enough.
    fn is_of_extremes(&self) -> bool;

    /// Takes the squares of results, where only extremes are wanted.
    fn take_squares<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>;
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
    fn check<G: Gaps>(&mut self, place: usize, requirement: Requirement) {
        let values = &mut *self.results[place];
        if let Some(test) = requirement.test {
            self.all_are_known &= require(values, self.known, test);
        }
        self.has_gaps |= G::HAS_GAPS;
        if requirement.has_zeros {
            // A zero has no sign.
            values.iter_mut().for_each(|value| *value += 0.0);
        }
    }
}

impl Destination for Columns<'_, '_> {
    fn take<K, G, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
        G: Gaps,
    {
        const FIRST: u64 = 0b01;
        const SECOND: u64 = 0b10;
        let mut slices = [(); RESULTS].map(|()| &mut [][..]);
        for (place, result) in self.results.iter_mut().enumerate() {
            if let Some(number) = places.iter().position(|known| *known == Some(place)) {
                slices[number] = &mut **result;
            }
        }
        let level = Level::best();
        let wanted = places
            .iter()
            .enumerate()
            .filter(|(_, place)| place.is_some());
        let stored = match wanted.fold(0, |wanted, (result, _)| wanted | 1 << result) {
            FIRST => store::<K, FIRST, FIXED, ALONG, RESULTS>(level, fixed, along, slices),
            SECOND => store::<K, SECOND, FIXED, ALONG, RESULTS>(level, fixed, along, slices),
            _ => store::<K, ALL, FIXED, ALONG, RESULTS>(level, fixed, along, slices),
        };
        stored.ok()?;
        for place in places.into_iter().flatten() {
            self.check::<G>(place, requirement);
        }
        Some(())
    }

    fn is_of_extremes(&self) -> bool {
        false
    }

    fn take_squares<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        _: [Option<usize>; RESULTS],
        _: Requirement,
        _: &[f64; FIXED],
        _: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
    {
        None
    }
}

/// Numbers that may not be what they are for that rotor alone cannot be reduced.
fn checked<const RESULTS: usize>(
    extremes: [Extremes; RESULTS],
    places: [Option<usize>; RESULTS],
    requirement: Requirement,
) -> Option<()> {
    let all = extremes.iter().zip(places);
    let mut wanted = all.filter(|(_, place)| place.is_some());
    let holds = |extremes: &Extremes| requirement.test.is_none_or(|test| (test.of_all)(extremes));
    wanted.all(|(extremes, _)| holds(extremes)).then_some(())
}

impl Destination for Reducer {
    fn take<K, G, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
        G: Gaps,
    {
        let extremes = self.reduce::<K, G, FIXED, ALONG, RESULTS>(places, fixed, along)?;
        checked(extremes, places, requirement)
    }

    fn is_of_extremes(&self) -> bool {
        self.wants_extremes_alone()
    }

    fn take_squares<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        &mut self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> Option<()>
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
    {
        let rows = along.first().map_or(0, |column| column.len());
        let roots =
            Extremes::along::<K, FIXED, ALONG, RESULTS>(fixed, along).map(Extremes::of_roots);
        checked(roots, places, requirement)?;
        for (place, roots) in places.iter().zip(roots) {
            if let Some(place) = place {
                self.take_extremes(*place, roots, rows);
            }
        }
        Some(())
    }
}
