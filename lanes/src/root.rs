//! Square roots by multiplications, for code in which the divider is busy and the multipliers are not.
//!
//! The divider takes some 17 cycles for the roots of a pack of 8 and does nothing else meanwhile. On AVX-512 there is an
//! estimate $y$ of $1/\sqrt x$ within $2^{-14}$, and two steps of Goldschmidt bring $g = xy$ and $h = y/2$ near
//! $\sqrt x$ and $1/(2\sqrt x)$: with $r = 1/2 - gh$, both $g + gr$ and $h + hr$ have the square of the error. A last
//! step is Markstein's: $g + (x - g^2)h$, rounded once.
//!
//! **Why the bits are those of a correctly rounded root.** A step makes of a relative error $e$ one of $\tfrac32 e^2$,
//! so two leave less than $2^{-54}$ of that of $y$. Rounding adds to it: each number has $2^{-53}$ of its own, and $g$ and
//! $h$ have half of what sets $g/h$ apart from $2x$. Both are within $3 \cdot 2^{-53}$ in the end, $g$ so within 3 units
//! in the last place (ulp). The difference $x - g^2$ has few digits more than fit and is off by $2^{-53}$ of itself at
//! most. What is rounded at last is then off by less than $3 \cdot 2^{-50}$ ulp, below $2^{-48}$ ulp,
//! and is rounded as the root is, unless the root is as near as that to the middle of two numbers.
//!
//! Let that middle be $m/2$ ulp, $m$ odd and below $2^{54}$, and $x = X\,\mathrm{ulp}^2$. The root is
//! $|4X - m^2|/(4m)$ ulp away, so only those $X$ matter of which $|4X - m^2| < 2^8$. As $4X$ is a multiple of $2^{54}$, they
//! are few: $m$ is a root of a small number modulo $2^{54}$. The tests compute all of them, and more.

#[cfg(target_arch = "x86_64")]
use fearless_simd::SimdBase;
use fearless_simd::{Simd, SimdFloat};

/// Takes square roots with the bits of [`SimdFloat::sqrt`], on AVX-512 without the divider.
#[inline(always)]
pub(crate) fn by_multiplication<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx512) = simd.level().as_avx512() {
        let x = fearless_simd::f64x8::from_slice(avx512, x.as_slice());
        let root = avx512::root(avx512, x);
        return S::f64s::from_slice(simd, root.as_slice());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = simd;
    x.sqrt()
}

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use std::arch::x86_64::{
        __m512d, _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_cmplt_epu64_mask,
        _mm512_fmadd_pd, _mm512_fnmadd_pd, _mm512_mul_pd, _mm512_rsqrt14_pd, _mm512_set1_epi64,
        _mm512_set1_pd, _mm512_sqrt_pd, _mm512_sub_epi64,
    };

    use fearless_simd::{Avx512, SimdFrom, f64x8};

    /// The bits of 2⁻⁹⁰⁰. Below, the difference from the square of the root may be too small to be exact.
    const LEAST: i64 = (1023 - 900) << 52;

    /// The bits of infinity, less those.
    const COUNT: i64 = (2047 << 52) - LEAST;

    fearless_simd::kernel!(
        /// Square roots. A pack with a number that is negative, infinite, not a number or too small goes to the divider.
        #[inline]
        pub(super) fn root(avx512: Avx512, x: f64x8<Avx512>) -> f64x8<Avx512> {
            let bits = _mm512_castpd_si512(x.into());
            let above = _mm512_sub_epi64(bits, _mm512_set1_epi64(LEAST));
            if _mm512_cmplt_epu64_mask(above, _mm512_set1_epi64(COUNT)) == u8::MAX {
                let start = f64x8::simd_from(avx512, _mm512_rsqrt14_pd(x.into()));
                refined(avx512, x, start)
            } else {
                std::hint::cold_path();
                f64x8::simd_from(avx512, _mm512_sqrt_pd(x.into()))
            }
        }
    );

    fearless_simd::kernel!(
        /// Square roots from estimates of their inverses within 2⁻¹⁴.
        #[inline]
        pub(super) fn refined(
            avx512: Avx512,
            x: f64x8<Avx512>,
            start: f64x8<Avx512>,
        ) -> f64x8<Avx512> {
            let (x, start): (__m512d, __m512d) = (x.into(), start.into());
            let half = _mm512_set1_pd(0.5);
            let mut g = _mm512_mul_pd(x, start);
            // Half of it without a multiplication: 1 less in the exponent.
            let halved = _mm512_sub_epi64(_mm512_castpd_si512(start), _mm512_set1_epi64(1 << 52));
            let mut h = _mm512_castsi512_pd(halved);
            for _ in 0..2 {
                let r = _mm512_fnmadd_pd(g, h, half);
                (g, h) = (_mm512_fmadd_pd(g, r, g), _mm512_fmadd_pd(h, r, h));
            }
            let difference = _mm512_fnmadd_pd(g, g, x);
            f64x8::simd_from(avx512, _mm512_fmadd_pd(difference, h, g))
        }
    );
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]
mod tests {
    use crate::{ALL, Kernel, Level, Pack, Simd, store};

    struct Root;

    impl Kernel<0, 1, 1> for Root {
        #[inline(always)]
        fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 1] {
            [x.sqrt_by_multiplication()]
        }
    }

    fn same_on_every_level(numbers: &[f64]) {
        for level in Level::available() {
            let mut roots = vec![0.0; numbers.len()];
            store::<Root, ALL, 0, 1, 1>(level, &[], [numbers], [&mut roots]).unwrap();
            for (x, root) in numbers.iter().zip(roots) {
                let same =
                    root.to_bits() == x.sqrt().to_bits() || root.is_nan() && x.sqrt().is_nan();
                assert!(same, "{level}: of {x:e} {root:e}, not {:e}", x.sqrt());
            }
        }
    }

    /// Checks that the root is the same from any estimate that the instruction may give.
    #[cfg(target_arch = "x86_64")]
    fn same_from_every_start(numbers: &[f64]) {
        use fearless_simd::SimdBase;
        let Some(avx512) = fearless_simd::Level::new().as_avx512() else {
            return;
        };
        for x in numbers {
            for eighths in -4..4 {
                let error = |lane: usize| {
                    (f64::from(eighths) + (lane + 1) as f64 / 8.0) / 4.0 / f64::from(1 << 14)
                };
                let starts: [f64; 8] = std::array::from_fn(|lane| (1.0 + error(lane)) / x.sqrt());
                let pack = fearless_simd::f64x8::splat(avx512, *x);
                let start = fearless_simd::f64x8::from_slice(avx512, &starts);
                let roots = super::avx512::refined(avx512, pack, start);
                for (root, start) in roots.as_slice().iter().zip(starts) {
                    assert_eq!(root.to_bits(), x.sqrt().to_bits(), "{x:e} from {start:e}");
                }
            }
        }
    }

    /// The odd m in [2⁵³, 2⁵⁴) with m² ≡ `square` modulo 2 to `digits`; `square` ≡ 1 modulo 8.
    fn roots_modulo(square: u128, digits: u32) -> impl Iterator<Item = u128> {
        let modulus = 1_u128 << digits;
        // A root modulo 2ⁿ⁻¹ or its other half is one modulo 2ⁿ.
        let root = (3..digits).fold(1_u128, |root, digit| {
            let wrong = (root * root).wrapping_sub(square) >> digit & 1;
            root + (wrong << (digit - 1))
        });
        let half = modulus / 2;
        let all = [root, modulus - root, root + half, modulus - root + half];
        let all = all.map(|root| root % modulus);
        all.into_iter().filter(|root| root >> 53 == 1)
    }

    /// All numbers in [1, 4) whose root is within `most`/(4m) ulp of the middle m/2 of two numbers.
    fn near_the_middle(most: i128) -> Vec<f64> {
        let mut found = Vec::new();
        for distance in (-most..most).filter(|distance| distance.rem_euclid(8) == 7) {
            // 4X is a multiple of 2⁵⁴ with X in [2¹⁰⁴, 2¹⁰⁵), of 2⁵⁵ with X in [2¹⁰⁵, 2¹⁰⁶).
            for octave in [0_u32, 1] {
                let square = distance.wrapping_neg().cast_unsigned();
                for m in roots_modulo(square, 54 + octave) {
                    let Some(four_x) = (m * m).checked_add_signed(distance) else {
                        continue;
                    };
                    assert_eq!(four_x % (1 << (54 + octave)), 0);
                    let digits = four_x >> (54 + octave);
                    // Otherwise x is in the other octave.
                    if digits >> 52 == 1 {
                        let scale = if octave == 0 { 52 } else { 51 };
                        found.push(digits as f64 / f64::from(2).powi(scale));
                    }
                }
            }
        }
        found
    }

    #[test]
    fn roots_near_the_middle_of_two_numbers() {
        let most = 1 << 12;
        let found = near_the_middle(most);
        // A square modulo 2⁵⁴ and 2⁵⁵ has four roots each, about two in all of which are in these ranges.
        assert!(found.len() > 1000, "{}", found.len());
        assert!(found.contains(&(1.0 + f64::EPSILON)));
        assert!(found.contains(&4.0_f64.next_down()));
        for exponent in [-900, -300, -2, 0, 2, 300, 1020] {
            let scaled: Vec<f64> = found.iter().map(|x| x * 2_f64.powi(exponent)).collect();
            same_on_every_level(&scaled);
            #[cfg(target_arch = "x86_64")]
            same_from_every_start(&scaled);
        }
    }

    /// Numbers of all magnitudes and signs, among them those that are none, by a linear congruence.
    fn random(count: usize) -> impl Iterator<Item = f64> {
        let mut state = 1_u64;
        std::iter::repeat_with(move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits(state ^ state >> 29)
        })
        .take(count)
    }

    #[test]
    fn random_numbers_of_all_magnitudes() {
        let any: Vec<f64> = random(200_000).collect();
        same_on_every_level(&any);
        // Whole packs of these go by multiplications.
        let normal: Vec<f64> = any.iter().map(|x| x.abs()).collect();
        let normal: Vec<f64> = normal
            .into_iter()
            .filter(|x| *x >= 1e-250 && x.is_finite())
            .collect();
        same_on_every_level(&normal);
        #[cfg(target_arch = "x86_64")]
        same_from_every_start(&normal[..10_000]);
    }

    #[test]
    fn numbers_that_have_no_estimate() {
        let least = 2_f64.powi(-900);
        let special = [
            0.0,
            -0.0,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
            -1.0,
            f64::MIN_POSITIVE,
            f64::from_bits(1),
            f64::from_bits(f64::MIN_POSITIVE.to_bits() - 1),
            least.next_down(),
            least,
            f64::MAX,
            f64::MIN,
        ];
        for number in special {
            same_on_every_level(&[number; 8]);
            for lane in 0..8 {
                let mut pack = [2.0; 8];
                pack[lane] = number;
                same_on_every_level(&pack);
            }
        }
    }
}
