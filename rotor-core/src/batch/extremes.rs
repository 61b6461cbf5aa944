//! The least and the greatest of many numbers.

use lanes::{Consumer, Kernel, Level, Pack, Simd, fold};

/// Whether a number is positive, with all its digits.
pub(crate) fn is_size(value: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&value)
}

/// What a column spans. What is NaN is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extremes {
    /// Infinity where there is nothing.
    pub(crate) least: f64,
    /// Negative infinity where there is nothing.
    pub(crate) greatest: f64,
    /// Whether the sum of all numbers is finite: then each of them is.
    pub(crate) sum_is_finite: bool,
}

impl Extremes {
    /// Finds the extremes of a column.
    pub(crate) fn of(values: &[f64]) -> Self {
        let [found] = Self::along::<Itself, 0, 1, 1>(&[], [values]);
        found
    }

    /// Finds the extremes of what a kernel gives along columns of one length, without keeping a column of it.
    pub(crate) fn along<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
        fixed: &[f64; FIXED],
        along: [&[f64]; ALONG],
    ) -> [Self; RESULTS]
    where
        K: Kernel<FIXED, ALONG, RESULTS>,
    {
        let found = fold::<K, Span, FIXED, ALONG, RESULTS>(Level::best(), fixed, along, &mut Span);
        found.unwrap_or([Self::NONE; RESULTS])
    }

    /// The extremes of the square roots of the numbers.
    pub(crate) fn of_roots(self) -> Self {
        Self {
            least: self.least.sqrt(),
            greatest: self.greatest.sqrt(),
            ..self
        }
    }

    /// The extremes of an empty column.
    pub(crate) const NONE: Self = Self {
        least: f64::INFINITY,
        greatest: f64::NEG_INFINITY,
        sum_is_finite: true,
    };

    /// Whether all are positive, with all their digits.
    pub(crate) fn are_sizes(&self) -> bool {
        self.sum_is_finite && is_size(self.least)
    }
}

/// A column as it is.
pub(crate) struct Itself;

impl Kernel<0, 1, 1> for Itself {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], along: [Pack<S>; 1]) -> [Pack<S>; 1] {
        along
    }
}

/// Takes the least, the greatest and the sum.
pub(crate) struct Span;

impl Span {
    /// The packs of nothing.
    #[inline(always)]
    pub(crate) fn empty<S: Simd, const COLUMNS: usize>(simd: S) -> [[Pack<S>; 3]; COLUMNS] {
        let [least, greatest, sum] =
            [f64::INFINITY, f64::NEG_INFINITY, 0.0].map(|number| Pack::splat(simd, number));
        [[least, greatest, sum]; COLUMNS]
    }

    /// Takes a pack of each column. Beyond the last row it repeats rows that are there.
    #[inline(always)]
    #[allow(
        clippy::needless_range_loop,
        reason = "adapters of iterators are not always inlined here"
    )]
    pub(crate) fn widen<S: Simd, const COLUMNS: usize>(
        lanes: &mut [[Pack<S>; 3]; COLUMNS],
        values: &[Pack<S>; COLUMNS],
    ) {
        for place in 0..COLUMNS {
            let value = values[place];
            let [least, greatest, sum] = lanes[place];
            lanes[place] = [value.at_most(least), value.at_least(greatest), sum + value];
        }
    }

    /// What the packs have spanned.
    #[inline(always)]
    pub(crate) fn spanned<S: Simd, const COLUMNS: usize>(
        lanes: [[Pack<S>; 3]; COLUMNS],
    ) -> [Extremes; COLUMNS] {
        lanes.map(|[least, greatest, sums]| Extremes {
            least: least
                .as_slice()
                .iter()
                .copied()
                .fold(f64::INFINITY, f64::min),
            greatest: greatest
                .as_slice()
                .iter()
                .copied()
                .fold(f64::NEG_INFINITY, f64::max),
            sum_is_finite: sums.as_slice().iter().all(|sum| sum.is_finite()),
        })
    }
}

impl<const RESULTS: usize> Consumer<RESULTS> for Span {
    type Lanes<S: Simd> = [[Pack<S>; 3]; RESULTS];
    type Output = [Extremes; RESULTS];

    #[inline(always)]
    fn begin<S: Simd>(&self, simd: S) -> [[Pack<S>; 3]; RESULTS] {
        Self::empty(simd)
    }

    #[inline(always)]
    fn take<S: Simd>(
        &mut self,
        lanes: &mut [[Pack<S>; 3]; RESULTS],
        _: usize,
        _: usize,
        results: &[Pack<S>; RESULTS],
    ) {
        Self::widen(lanes, results);
    }

    #[inline(always)]
    fn end<S: Simd>(&self, lanes: [[Pack<S>; 3]; RESULTS]) -> [Extremes; RESULTS] {
        Self::spanned(lanes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_of_another_kind_is_found_wherever_it_stands() {
        let others = [
            0.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1e-310,
        ];
        for length in [1, 7, 8, 9, 21] {
            let mut values = vec![2.0; length];
            assert!(Extremes::of(&values).are_sizes());
            for place in 0..length {
                for other in others {
                    values[place] = other;
                    let found = Extremes::of(&values);
                    assert!(!found.are_sizes(), "{other} at {place} of {length}");
                    let (least, greatest) = if other.is_nan() && length == 1 {
                        (f64::INFINITY, f64::NEG_INFINITY)
                    } else {
                        let all = || values.iter().copied().filter(|value| !value.is_nan());
                        (
                            all().fold(f64::INFINITY, f64::min),
                            all().fold(f64::NEG_INFINITY, f64::max),
                        )
                    };
                    assert_eq!((found.least, found.greatest), (least, greatest));
                }
                for size in [f64::MIN_POSITIVE, f64::MAX] {
                    values[place] = size;
                    assert!(Extremes::of(&values).are_sizes());
                }
                values[place] = 2.0;
            }
        }
        assert_eq!(Extremes::of(&[]), Extremes::NONE);
    }
}
