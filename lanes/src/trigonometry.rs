//! Sine and cosine of packs.
//!
//! An angle is brought to $|r| \le \pi/4$ by subtracting the nearest multiple of $\pi/2$. That multiple is subtracted in three
//! parts, the first two of so few digits that their multiples are exact; what $r$ loses by rounding is kept beside it.
//! Sine and cosine of $r$ are the first terms of their series and a remainder in $z = r^2$, a polynomial that is fitted when
//! this crate is built.

use std::f64::consts::FRAC_2_PI;

use fearless_simd::Simd;

use crate::kernel::Kernel;
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
        self.turned(0.0, f64::sin)
    }

    /// Takes the cosine of an angle in radians, within 2 units in the last place.
    #[inline(always)]
    pub fn cos(self) -> Self {
        // The cosine is a quarter turn ahead of the sine.
        self.turned(1.0, f64::cos)
    }

    /// Takes the sine of an angle that is `ahead` quarter turns larger. For large angles it calls `exact`, the standard
    /// library's function with that value.
    #[inline(always)]
    fn turned(self, ahead: f64, exact: fn(f64) -> f64) -> Self {
        let polynomial = self.near_turned(ahead);
        if self.abs().all_at_most(EXACT_BEYOND) {
            return polynomial;
        }
        let near = |row: usize| self.as_slice()[row].abs() <= EXACT_BEYOND;
        self.map_rows(|row, angle| {
            if near(row) {
                polynomial.as_slice()[row]
            } else {
                exact(angle)
            }
        })
    }

    /// Takes the sine of an angle that is `ahead` quarter turns larger, by polynomials: for angles up to [`EXACT_BEYOND`].
    #[inline(always)]
    fn near_turned(self, ahead: f64) -> Self {
        let quarters = (self * FRAC_2_PI).round_ties_even();
        let [high, middle, low] = QUARTER_TURN;
        let nearly = self - quarters * high;
        let small = quarters * middle;
        let r = nearly - small;
        let lost = ((nearly - r) - small) - quarters * low;

        let z = r * r;
        let [sine_rest] = sine_remainder::Rows::evaluate(self.simd(), [], [z]);
        let [cosine_rest] = cosine_remainder::Rows::evaluate(self.simd(), [], [z]);
        let half = 0.5 * z;
        let sine = r + ((1.0 - half) * lost - r * z * sine_rest);
        let cosine = 1.0 - (half - (z * z * cosine_rest - r * lost));

        // After 0, 1, 2, 3 quarter turns the sine is sin r, cos r, −sin r, −cos r.
        let quarters = quarters + ahead;
        let halves = (0.5 * quarters).floor();
        let is_odd = |number: Self, half: Self| number - 2.0 * half;
        let odd_quarter = is_odd(quarters, halves);
        let odd_half = is_odd(halves, (0.5 * halves).floor());
        let bound = Self::splat(self.simd(), 0.5);
        odd_quarter.select_le(bound, sine, cosine) * (1.0 - 2.0 * odd_half)
    }
}
