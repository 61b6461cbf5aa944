//! Where the numbers of a block go from the loop that computes them: to columns, or into reductions.

use lanes::{ALL, Consumer, Kernel, LONGEST, Level, Pack, Simd, fold};

use crate::batch::extremes::{Extremes, Span};
use crate::batch::statistic::{Gaps, Reducer};

use super::list::{FINITE, SIZES, Test, require};

/// What the numbers of a quantity have to be: where one does not pass the test, the quantity may not exist.
#[derive(Clone, Copy)]
pub(super) struct Requirement(Option<&'static Test>);

/// They are positive, with all their digits.
pub(super) const POSITIVE_NUMBER: Requirement = Requirement(Some(&SIZES));

/// They are finite.
pub(super) const FINITE_NUMBER: Requirement = Requirement(Some(&FINITE));

/// They are finite where the quantity exists, and NaN elsewhere.
pub(super) const PARTIAL: Requirement = Requirement(None);

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

/// Writes results to columns, and finds what each spans on the way.
struct Writing<'a, const WANTED: u64, const RESULTS: usize> {
    columns: [&'a mut [f64]; RESULTS],
    /// The last pack, where fewer rows are left than it has: copied when the loop is over, in which a call would take the
    /// registers from what the columns span.
    last: [[f64; LONGEST]; RESULTS],
    /// How many rows that pack has; none where all packs are full.
    left: usize,
}

#[allow(
    clippy::needless_range_loop,
    reason = "adapters of iterators are not always inlined into these loops"
)]
impl<const WANTED: u64, const RESULTS: usize> Consumer<RESULTS> for Writing<'_, WANTED, RESULTS> {
    type Lanes<S: Simd> = [[Pack<S>; 3]; RESULTS];
    type Output = [Extremes; RESULTS];

    #[inline(always)]
    fn begin<S: Simd>(&self, simd: S) -> [[Pack<S>; 3]; RESULTS] {
        Span::empty(simd)
    }

    #[inline(always)]
    fn take<S: Simd>(
        &mut self,
        lanes: &mut [[Pack<S>; 3]; RESULTS],
        first: usize,
        rows: usize,
        results: &[Pack<S>; RESULTS],
    ) {
        let length = Pack::<S>::LENGTH;
        if rows < length {
            self.left = rows;
        }
        for place in 0..RESULTS {
            if WANTED >> place & 1 == 0 {
                continue;
            }
            // A zero has no sign.
            let values = results[place] + Pack::splat(results[place].simd(), 0.0);
            let mut lane = [lanes[place]];
            Span::widen(&mut lane, &[values]);
            [lanes[place]] = lane;
            values.store(if rows == length {
                &mut self.columns[place][first..first + length]
            } else {
                &mut self.last[place][..length]
            });
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, lanes: [[Pack<S>; 3]; RESULTS]) -> [Extremes; RESULTS] {
        Span::spanned(lanes)
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
        let wanted = places
            .iter()
            .enumerate()
            .filter(|(_, place)| place.is_some());
        let extremes = match wanted.fold(0, |wanted, (result, _)| wanted | 1 << result) {
            FIRST => written::<K, FIRST, FIXED, ALONG, RESULTS>(fixed, along, slices),
            SECOND => written::<K, SECOND, FIXED, ALONG, RESULTS>(fixed, along, slices),
            _ => written::<K, ALL, FIXED, ALONG, RESULTS>(fixed, along, slices),
        };
        for (place, extremes) in places.into_iter().zip(extremes?) {
            let Some((place, test)) = place.zip(requirement.0) else {
                continue;
            };
            if !(test.of_all)(&extremes) {
                self.all_are_known &= require(self.results[place], self.known, test);
            }
        }
        self.has_gaps |= G::HAS_GAPS;
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

/// Writes what a kernel gives to columns, and finds what each spans. None where lengths differ.
fn written<K, const WANTED: u64, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
    fixed: &[f64; FIXED],
    along: [&[f64]; ALONG],
    columns: [&mut [f64]; RESULTS],
) -> Option<[Extremes; RESULTS]>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    let rows = along.first().map_or(0, |column| column.len());
    let wanted = columns
        .iter()
        .enumerate()
        .filter(|(place, _)| WANTED >> place & 1 == 1);
    if wanted.into_iter().any(|(_, column)| column.len() != rows) {
        return None;
    }
    let mut writing = Writing::<WANTED, RESULTS> {
        columns,
        last: [[f64::NAN; LONGEST]; RESULTS],
        left: 0,
    };
    let level = Level::best();
    let extremes = fold::<K, _, FIXED, ALONG, RESULTS>(level, fixed, along, &mut writing).ok()?;
    let Writing {
        columns,
        last,
        left,
    } = writing;
    for (place, (column, last)) in columns.into_iter().zip(&last).enumerate() {
        if WANTED >> place & 1 == 1 {
            column[rows - left..].copy_from_slice(&last[..left]);
        }
    }
    Some(extremes)
}

/// Numbers that may not be what they are for that rotor alone cannot be reduced.
fn checked<const RESULTS: usize>(
    extremes: [Extremes; RESULTS],
    places: [Option<usize>; RESULTS],
    requirement: Requirement,
) -> Option<()> {
    let all = extremes.iter().zip(places);
    let mut wanted = all.filter(|(_, place)| place.is_some());
    let holds = |extremes: &Extremes| requirement.0.is_none_or(|test| (test.of_all)(extremes));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::extremes::Itself;
    use crate::batch::statistic::{Statistic, Wanted, WithoutGaps};

    /// Numbers, what they have to be, and which of them are that.
    const CASES: [([f64; 3], Requirement, [bool; 3]); 5] = [
        ([1.0, -2.0, 0.0], FINITE_NUMBER, [true, true, true]),
        (
            [1.0, f64::NEG_INFINITY, 3.0],
            FINITE_NUMBER,
            [true, false, true],
        ),
        ([1.0, f64::NAN, 3.0], FINITE_NUMBER, [true, false, true]),
        ([1.0, 0.0, -3.0], POSITIVE_NUMBER, [true, false, false]),
        (
            [1.0, 2.0, f64::INFINITY],
            POSITIVE_NUMBER,
            [true, true, false],
        ),
    ];

    #[test]
    fn numbers_that_are_not_what_they_have_to_be_are_left_to_one_rotor() {
        for (values, requirement, expected) in CASES {
            let (mut column, mut known) = ([0.0; 3], [true; 3]);
            let mut columns = Columns {
                results: &mut [&mut column],
                known: &mut known,
                all_are_known: true,
                has_gaps: false,
            };
            columns
                .take::<Itself, WithoutGaps, 0, 1, 1>([Some(0)], requirement, &[], [&values])
                .unwrap();
            let all = columns.all_are_known;
            assert_eq!(known, expected, "{values:?}");
            assert_eq!(all, expected == [true; 3], "{values:?}");
        }
    }

    #[test]
    fn numbers_that_are_not_what_they_have_to_be_are_not_reduced() {
        for (values, requirement, expected) in CASES {
            let mut wanted = Wanted::default();
            wanted.add(Statistic::Maximum);
            let mut reducer = Reducer::new(wanted, &[], 1);
            let taken = reducer.take::<Itself, WithoutGaps, 0, 1, 1>(
                [Some(0)],
                requirement,
                &[],
                [&values],
            );
            assert_eq!(taken.is_some(), expected == [true; 3], "{values:?}");
        }
    }
}
