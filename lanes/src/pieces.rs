//! Functions that are given piece by piece, such as tabulated polynomials: finds for each row the piece on which its argument
//! lies, and picks a coefficient of that piece.

use fearless_simd::Simd;
#[cfg(target_arch = "x86_64")]
use fearless_simd::SimdBase;

use crate::pack::Pack;

/// The most pieces that a function may have: as many numbers as one permutation of AVX-512 picks from.
pub const MOST_PIECES: usize = 16;

/// The piece on which the number of each row of a pack lies.
///
/// ```
/// use lanes::{ALL, Kernel, Level, LengthError, MOST_PIECES, Pack, Simd, store};
///
/// /// A function with steps: 1 below 0.5, 10 from there to 2, and 100 from there on.
/// struct Steps;
///
/// impl Kernel<0, 1, 1> for Steps {
///     #[inline(always)]
///     fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 1] {
///         let mut heights = [100.0; MOST_PIECES];
///         (heights[0], heights[1]) = (1.0, 10.0);
///         [x.pieces(&[0.5, 2.0]).choose(&heights)]
///     }
/// }
///
/// let mut found = [0.0; 4];
/// store::<Steps, ALL, 0, 1, 1>(Level::best(), &[], [&[0.1, 0.5, 1.9, 2.0]], [&mut found])?;
/// assert_eq!(found, [1.0, 10.0, 10.0, 100.0]);
/// # Ok::<(), LengthError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pieces<S: Simd> {
    /// The piece's number from 0: as a floating-point number, on AVX-512 as the bits of an integer.
    numbers: Pack<S>,
}

impl<S: Simd> Pack<S> {
    /// Finds the piece of each row. The first piece ends where the second begins, at the first of `begins`, and so on.
    /// `begins` must rise, and be fewer than [`MOST_PIECES`].
    #[inline(always)]
    pub fn pieces<const BEGINS: usize>(self, begins: &[f64; BEGINS]) -> Pieces<S> {
        let simd = self.simd();
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = simd.level().as_avx512() {
            let x = fearless_simd::f64x8::from_slice(avx512, self.as_slice());
            let numbers = avx512::pieces(avx512, x, begins);
            let numbers = Self::load(simd, numbers.as_slice());
            return Pieces { numbers };
        }
        let zero = Self::splat(simd, 0.0);
        let mut numbers = zero;
        for begin in begins {
            let begun = Self::splat(simd, *begin).select_le(self, Self::splat(simd, 1.0), zero);
            numbers = numbers + begun;
        }
        Pieces { numbers }
    }
}

impl<S: Simd> Pieces<S> {
    /// Picks for each row the number that `list` has for its piece.
    #[inline(always)]
    pub fn choose(self, list: &[f64; MOST_PIECES]) -> Pack<S> {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = self.numbers.simd().level().as_avx512() {
            let pieces = fearless_simd::f64x8::from_slice(avx512, self.numbers.as_slice());
            let chosen = avx512::choose(avx512, pieces, list);
            return Pack::load(self.numbers.simd(), chosen.as_slice());
        }
        let last = MOST_PIECES - 1;
        self.numbers.map(|piece| list[(piece as usize).min(last)])
    }
}

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use std::arch::x86_64::{
        __m512d, _CMP_LE_OQ, _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_cmp_pd_mask,
        _mm512_mask_add_epi64, _mm512_permutex2var_pd, _mm512_set1_epi64, _mm512_set1_pd,
        _mm512_setzero_si512,
    };

    use fearless_simd::{Avx512, SimdBase, SimdFrom, f64x8};

    use super::MOST_PIECES;

    fearless_simd::kernel!(
        /// Counts for each number the pieces after the first that begin at or below it, as the bits of an integer.
        #[inline]
        pub(super) fn pieces(avx512: Avx512, x: f64x8<Avx512>, begins: &[f64]) -> f64x8<Avx512> {
            let x: __m512d = x.into();
            let one = _mm512_set1_epi64(1);
            let mut begun = _mm512_setzero_si512();
            for begin in begins {
                let has = _mm512_cmp_pd_mask::<_CMP_LE_OQ>(_mm512_set1_pd(*begin), x);
                begun = _mm512_mask_add_epi64(begun, has, begun, one);
            }
            f64x8::simd_from(avx512, _mm512_castsi512_pd(begun))
        }
    );

    fearless_simd::kernel!(
        /// Picks the number of each row's piece, by one permutation of two packs.
        #[inline]
        pub(super) fn choose(
            avx512: Avx512,
            pieces: f64x8<Avx512>,
            list: &[f64; MOST_PIECES],
        ) -> f64x8<Avx512> {
            let (low, high) = list.split_at(MOST_PIECES / 2);
            let low: __m512d = f64x8::from_slice(avx512, low).into();
            let high: __m512d = f64x8::from_slice(avx512, high).into();
            let pieces = _mm512_castpd_si512(pieces.into());
            f64x8::simd_from(avx512, _mm512_permutex2var_pd(low, pieces, high))
        }
    );
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]
mod tests {
    use crate::{ALL, Kernel, Level, Pack, Simd, store};

    const BEGINS: [f64; 3] = [0.25, 0.5, 2.0];
    const LISTS: [[f64; 16]; 2] = [numbers(1.0), numbers(100.0)];

    const fn numbers(first: f64) -> [f64; 16] {
        let mut numbers = [first; 16];
        let mut place = 1;
        while place < 16 {
            numbers[place] = numbers[place - 1] + 1.0;
            place += 1;
        }
        numbers
    }

    struct Numbers;

    impl Kernel<0, 1, 2> for Numbers {
        #[inline(always)]
        fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 2] {
            let pieces = x.pieces(&BEGINS);
            [pieces.choose(&LISTS[0]), pieces.choose(&LISTS[1])]
        }
    }

    #[test]
    fn a_row_takes_the_numbers_of_its_piece_on_every_level() {
        let x = [
            -1.0,
            0.0,
            0.25_f64.next_down(),
            0.25,
            0.4,
            0.5_f64.next_down(),
            0.5,
            1.0,
            2.0_f64.next_down(),
            2.0,
            1e300,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        let pieces = [0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 0, 0];
        for level in Level::available() {
            let mut found = [vec![0.0; x.len()], vec![0.0; x.len()]];
            let slices = found.each_mut().map(Vec::as_mut_slice);
            store::<Numbers, ALL, 0, 1, 2>(level, &[], [&x], slices).unwrap();
            for (row, piece) in pieces.into_iter().enumerate() {
                for (list, found) in LISTS.iter().zip(&found) {
                    assert_eq!(found[row], list[piece], "{level}: {}", x[row]);
                }
            }
        }
    }
}
