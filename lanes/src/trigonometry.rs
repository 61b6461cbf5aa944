//! Sine and cosine of packs.
//!
//! An angle is brought to $|r| \le \pi/4$ by subtracting the nearest multiple of $\pi/2$. That multiple is subtracted in three
//! parts, the first two of so few digits that their multiples are exact; what $r$ loses by rounding is kept beside it.
//! Sine and cosine of $r$ are the first terms of their series and a remainder in $z = r^2$, a polynomial that is fitted when
//! this crate is built.

use std::f64::consts::FRAC_2_PI;

use fearless_simd::Simd;

use crate::kernel::{Kernel, LONGEST};
use crate::level::{self, Body, Level};
use crate::pack::Pack;
use series::{cosine_remainder, sine_remainder};

/// Up to this size of an angle, in radians, [`Pack::sin`] and [`Pack::cos`] are polynomials; beyond it they call the standard
/// library. Its 637 quarter turns are far fewer than the 2²⁰ up to which the reduction of the angle is exact.
pub const EXACT_BEYOND: f64 = 1e3;

/// π/2 in three parts: 33 bits, 33 bits, and the rest. A multiple below 2²⁰ of the first two is exact.
const QUARTER_TURN: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e03_7073),
];

#[rotor_macros::symbolic]
mod series {
    /// $S(z)$ in $\sin r = r - r^3 S(r^2)$: Taylor's remainder as an integral, in which nothing cancels.
    #[approximate(z = 0.0..=0.62, tolerance = 1e-15)]
    #[generate(columns)]
    pub(super) fn sine_remainder(z: f64) -> f64 {
        integral(|t| (1.0 - t).powi(2) / 2.0 * (z.sqrt() * t).cos(), 0.0..1.0)
    }

    /// $C(z)$ in $\cos r = 1 - r^2/2 + r^4 C(r^2)$: Taylor's remainder as an integral, in which nothing cancels.
    #[approximate(z = 0.0..=0.62, tolerance = 1e-15)]
    #[generate(columns)]
    pub(super) fn cosine_remainder(z: f64) -> f64 {
        integral(|t| (1.0 - t).powi(3) / 6.0 * (z.sqrt() * t).cos(), 0.0..1.0)
    }
}

/// Takes the sine of an angle in radians, with the bits of [`Pack::sin`].
///
/// ```
/// assert!((lanes::sin(std::f64::consts::FRAC_PI_6) - 0.5).abs() < 1e-15);
/// ```
pub fn sin(angle: f64) -> f64 {
    level::run(Level::Baseline, Sine(angle))
}

/// Takes the cosine of an angle in radians, with the bits of [`Pack::cos`].
pub fn cos(angle: f64) -> f64 {
    level::run(Level::Baseline, Cosine(angle))
}

/// The sine of an angle.
struct Sine(f64);

impl Body for Sine {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        Pack::splat(simd, self.0).sin().first()
    }
}

/// The cosine of an angle.
struct Cosine(f64);

impl Body for Cosine {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        Pack::splat(simd, self.0).cos().first()
    }
}

impl<S: Simd> Pack<S> {
    /// Takes the sine of an angle in radians, within 2 units in the last place.
    #[inline(always)]
    pub fn sin(self) -> Self {
        let near = Reduced::of(self).sin();
        if self.abs().all_at_most(EXACT_BEYOND) {
            return near;
        }
        self.corrected(near, f64::sin)
    }

    /// Takes the cosine of an angle in radians, within 2 units in the last place.
    #[inline(always)]
    pub fn cos(self) -> Self {
        let near = Reduced::of(self).cos();
        if self.abs().all_at_most(EXACT_BEYOND) {
            return near;
        }
        self.corrected(near, f64::cos)
    }

    /// Takes the sine and the cosine of an angle in radians, with the bits of [`Pack::sin`] and [`Pack::cos`]; most of the work is
    /// the same for both.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let reduced = Reduced::of(self);
        let (sine, cosine) = (reduced.sin(), reduced.cos());
        if self.abs().all_at_most(EXACT_BEYOND) {
            return (sine, cosine);
        }
        let sine = self.corrected(sine, f64::sin);
        (sine, self.corrected(cosine, f64::cos))
    }

    /// Replaces results at angles beyond [`EXACT_BEYOND`] by those of the standard library's function.
    #[inline(always)]
    fn corrected(self, near: Self, exact: fn(f64) -> f64) -> Self {
        std::hint::cold_path();
        // Copies, so that angle and result themselves can stay in registers.
        let (mut angles, mut results) = ([0.0; LONGEST], [0.0; LONGEST]);
        let (angles, results) = (&mut angles[..Self::LENGTH], &mut results[..Self::LENGTH]);
        self.store(angles);
        near.store(results);
        correct(angles, exact, results);
        Self::load(self.simd(), results)
    }
}

/// Replaces the results at angles beyond [`EXACT_BEYOND`]. It is apart from the loops, whose registers a call to the standard
/// library would empty.
#[cold]
#[inline(never)]
fn correct(angles: &[f64], exact: fn(f64) -> f64, results: &mut [f64]) {
    let far = angles.iter().zip(results);
    for (angle, result) in far.filter(|(angle, _)| angle.abs() > EXACT_BEYOND) {
        *result = exact(*angle);
    }
}

/// An angle brought to $|r| \le \pi/4$ by quarter turns.
struct Reduced<S: Simd> {
    /// The sine and the cosine of what is left.
    sine: Pack<S>,
    cosine: Pack<S>,
    /// Whether the number of quarter turns is odd, 1 or 0.
    is_odd: Pack<S>,
    /// The sign of the angle's sine beside that of $\sin r$ or $\cos r$.
    sign: Pack<S>,
}

impl<S: Simd> Reduced<S> {
    /// Reduces an angle up to [`EXACT_BEYOND`].
    #[inline(always)]
    fn of(angle: Pack<S>) -> Self {
        let quarters = (angle * FRAC_2_PI).round_ties_even();
        let [high, middle, low] = QUARTER_TURN;
        let nearly = angle - quarters * high;
        let small = quarters * middle;
        let r = nearly - small;
        let lost = ((nearly - r) - small) - quarters * low;

        let z = r * r;
        let [sine_rest] = sine_remainder::Rows::evaluate(angle.simd(), [], [z]);
        let [cosine_rest] = cosine_remainder::Rows::evaluate(angle.simd(), [], [z]);
        let half = 0.5 * z;
        let halves = (0.5 * quarters).floor();
        let odd_half = halves - 2.0 * (0.5 * halves).floor();
        Self {
            sine: r + ((1.0 - half) * lost - r * z * sine_rest),
            cosine: 1.0 - (half - (z * z * cosine_rest - r * lost)),
            is_odd: quarters - 2.0 * halves,
            sign: 1.0 - 2.0 * odd_half,
        }
    }

    /// After 0, 1, 2, 3 quarter turns $\sin r$, $\cos r$, $-\sin r$, $-\cos r$.
    #[inline(always)]
    fn sin(&self) -> Pack<S> {
        let bound = Pack::splat(self.sine.simd(), 0.5);
        self.is_odd.select_le(bound, self.sine, self.cosine) * self.sign
    }

    /// After 0, 1, 2, 3 quarter turns $\cos r$, $-\sin r$, $-\cos r$, $\sin r$.
    #[inline(always)]
    fn cos(&self) -> Pack<S> {
        let bound = Pack::splat(self.sine.simd(), 0.5);
        let turned = self.is_odd.select_le(bound, self.cosine, self.sine);
        turned * (self.sign * (1.0 - 2.0 * self.is_odd))
    }
}
