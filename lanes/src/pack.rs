//! A pack of numbers, one of each row, with the operations that kernels need.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Select, Simd, SimdBase, SimdFloat};

use crate::root;

/// Numbers of consecutive rows, as many as the instructions of `S` work on at once, with the arithmetic of `f64`.
#[derive(Clone, Copy)]
pub struct Pack<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

impl<S: Simd> Pack<S> {
    /// How many numbers it holds.
    pub const LENGTH: usize = <S::f64s as SimdBase<S>>::LEN;

    /// Creates a pack that has the number in every row.
    #[inline(always)]
    pub fn splat(simd: S, number: f64) -> Self {
        let numbers = S::f64s::splat(simd, number);
        Self { simd, numbers }
    }

    /// Loads the numbers of a slice of [`LENGTH`](Self::LENGTH).
    ///
    /// # Panics
    /// Where the slice is of another length.
    #[inline(always)]
    pub fn load(simd: S, slice: &[f64]) -> Self {
        let numbers = S::f64s::from_slice(simd, slice);
        Self { simd, numbers }
    }

    /// Writes the numbers to a slice of [`LENGTH`](Self::LENGTH).
    ///
    /// # Panics
    /// Where the slice is of another length.
    #[inline(always)]
    pub fn store(self, slice: &mut [f64]) {
        self.numbers.store_slice(slice);
    }

    /// The numbers, one of each row.
    #[inline(always)]
    pub fn as_slice(&self) -> &[f64] {
        self.numbers.as_slice()
    }

    /// The number of the first row.
    #[inline(always)]
    pub(crate) fn first(self) -> f64 {
        self.numbers[0]
    }

    /// The token of the instructions that it uses.
    #[inline(always)]
    pub fn simd(self) -> S {
        self.simd
    }

    /// Creates a pack of other numbers with the token of this one.
    #[inline(always)]
    fn with(self, numbers: S::f64s) -> Self {
        Self { numbers, ..self }
    }

    /// Applies a function to each number: for functions for which there is no instruction.
    #[inline(always)]
    pub fn map(self, function: impl Fn(f64) -> f64) -> Self {
        self.map_rows(|_, number| function(number))
    }

    /// Applies a function of the row's place and its number to every row.
    #[inline(always)]
    pub fn map_rows(self, function: impl Fn(usize, f64) -> f64) -> Self {
        let given = self.numbers;
        self.with(S::f64s::from_fn(self.simd, |row| function(row, given[row])))
    }

    /// Takes the square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.with(self.numbers.sqrt())
    }

    /// Takes the square root with the bits of [`sqrt`](Self::sqrt), on AVX-512 by multiplications: for code in which the
    /// divider has other roots or divisions to do.
    #[inline(always)]
    pub fn sqrt_by_multiplication(self) -> Self {
        self.with(root::by_multiplication(self.simd, self.numbers))
    }

    /// Takes the absolute value.
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.with(self.numbers.abs())
    }

    /// 1 with the sign of the number, as [`f64::signum`].
    #[inline(always)]
    pub fn signum(self) -> Self {
        let one = S::f64s::splat(self.simd, 1.0).copysign(self.numbers);
        let is_nan = self.numbers.is_nan();
        self.with(is_nan.select(self.numbers, one))
    }

    /// Takes the smaller of two numbers, as [`f64::min`]: where one is NaN, the other.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.with(self.numbers.min_precise(other.numbers))
    }

    /// Takes the larger of two numbers, as [`f64::max`]: where one is NaN, the other.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.with(self.numbers.max_precise(other.numbers))
    }

    /// Takes the number where it is below a bound, else the bound: of a number that is NaN the bound. It is one instruction where
    /// [`Pack::min`], which looks for NaN on both sides, is three.
    #[inline(always)]
    pub fn at_most(self, bound: Self) -> Self {
        let is_below = self.numbers.simd_lt(bound.numbers);
        self.with(is_below.select(self.numbers, bound.numbers))
    }

    /// Takes the number where it is above a bound, else the bound: of a number that is NaN the bound.
    #[inline(always)]
    pub fn at_least(self, bound: Self) -> Self {
        let is_above = self.numbers.simd_gt(bound.numbers);
        self.with(is_above.select(self.numbers, bound.numbers))
    }

    /// −1 where the number is below zero, else 1; a negative zero is not below zero.
    #[inline(always)]
    pub fn side(self) -> Self {
        let shifted = self.numbers + S::f64s::splat(self.simd, 0.0);
        self.with(S::f64s::splat(self.simd, 1.0).copysign(shifted))
    }

    /// Multiplies by `factor` and adds `summand`, rounded once on every level, as [`f64::mul_add`].
    #[inline(always)]
    pub fn mul_add(self, factor: Self, summand: Self) -> Self {
        let (factor, summand) = (factor.numbers, summand.numbers);
        self.map_rows(|row, number| number.mul_add(factor[row], summand[row]))
    }

    /// Divides by the sum of the squares of this number and another, without the squares, which leave the range of numbers
    /// where the quotient does not: the slope of an angle.
    #[inline(always)]
    pub fn over_squares(self, other: Self) -> Self {
        let (ratio, inverse) = (self / other, other / self);
        let steep = ratio / (other + self * ratio);
        let flat = 1.0 / (self + other * inverse);
        self.abs().select_lt(other.abs(), steep, flat)
    }

    /// Selects `x` in the rows where this number is equal to that of `other`, and `y` in the rest.
    #[inline(always)]
    pub fn select_eq(self, other: Self, x: Self, y: Self) -> Self {
        let chosen = self.numbers.simd_eq(other.numbers);
        self.with(chosen.select(x.numbers, y.numbers))
    }

    /// Selects `x` in the rows where this number is at most that of `bound`, and `y` in the rest.
    #[inline(always)]
    pub fn select_le(self, bound: Self, x: Self, y: Self) -> Self {
        let chosen = self.numbers.simd_le(bound.numbers);
        self.with(chosen.select(x.numbers, y.numbers))
    }

    /// Selects `x` in the rows where this number is less than that of `bound`, and `y` in the rest.
    #[inline(always)]
    pub fn select_lt(self, bound: Self, x: Self, y: Self) -> Self {
        let chosen = self.numbers.simd_lt(bound.numbers);
        self.with(chosen.select(x.numbers, y.numbers))
    }

    /// 1 with the sign bit of the number, also of what is no number, as `1.0.copysign(x)`.
    #[inline(always)]
    pub fn sign_bit(self) -> Self {
        self.with(S::f64s::splat(self.simd, 1.0).copysign(self.numbers))
    }

    /// Rounds to the nearest whole number, and to the even one of two that are equally near.
    #[inline(always)]
    pub(crate) fn round_ties_even(self) -> Self {
        self.with(self.numbers.round_ties_even())
    }

    /// Rounds down to a whole number.
    #[inline(always)]
    pub fn floor(self) -> Self {
        self.with(self.numbers.floor())
    }

    /// Rounds up to a whole number.
    #[inline(always)]
    pub fn ceil(self) -> Self {
        self.with(self.numbers.ceil())
    }

    /// Rounds to a whole number towards 0.
    #[inline(always)]
    pub fn trunc(self) -> Self {
        self.with(self.numbers.trunc())
    }

    /// Whether every number is at most `bound`; NaN is not.
    #[inline(always)]
    pub(crate) fn all_at_most(self, bound: f64) -> bool {
        use fearless_simd::SimdMask;
        let within = self.numbers.simd_le(S::f64s::splat(self.simd, bound));
        within.all_true()
    }
}

/// Implements functions for which there is no instruction, number by number as `f64` has them.
macro_rules! functions {
    ($($(#[doc = $doc:literal])* $name:ident($($other:ident)?);)*) => {
        impl<S: Simd> Pack<S> {
            $(
                $(#[doc = $doc])*
                #[inline(always)]
                pub fn $name(self $(, $other: Self)?) -> Self {
                    self.map_rows(|_row, number| number.$name($($other.numbers[_row])?))
                }
            )*
        }
    };
}

functions! {
    /// Takes the tangent of an angle in radians.
    tan();
    /// Takes the exponential.
    exp();
    /// Takes the natural logarithm.
    ln();
    /// Takes the arc sine.
    asin();
    /// Takes the arc cosine.
    acos();
    /// Takes the arc tangent.
    atan();
    /// Takes the hyperbolic sine.
    sinh();
    /// Takes the hyperbolic cosine.
    cosh();
    /// Takes the hyperbolic tangent.
    tanh();
    /// Takes the inverse hyperbolic sine.
    asinh();
    /// Takes the inverse hyperbolic cosine.
    acosh();
    /// Takes the inverse hyperbolic tangent.
    atanh();
    /// Takes the exponential less 1.
    exp_m1();
    /// Takes the natural logarithm of 1 and the number.
    ln_1p();
    /// Takes the cube root.
    cbrt();
    /// Takes the logarithm to the base 10.
    log10();
    /// Takes the logarithm to the base 2.
    log2();
    /// Takes the power of 2.
    exp2();
    /// Rounds to the nearest whole number, of two that are as near to the one farther from 0.
    round();
    /// Takes the angle of the point that has this ordinate and the other number as its abscissa.
    atan2(abscissa);
    /// Takes the length of the vector of this number and another.
    hypot(other);
    /// Takes the power with this exponent.
    powf(exponent);
}

/// What the standard library has not is that of the crate `libm`, number by number.
impl<S: Simd> Pack<S> {
    /// Takes the error function.
    #[inline(always)]
    pub fn erf(self) -> Self {
        self.map_rows(|_, number| libm::erf(number))
    }

    /// Takes 1 less the error function, with all digits where that is small.
    #[inline(always)]
    pub fn erfc(self) -> Self {
        self.map_rows(|_, number| libm::erfc(number))
    }
}

impl<S: Simd> fmt::Debug for Pack<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Pack").field(&self.as_slice()).finish()
    }
}

impl<S: Simd> Neg for Pack<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.numbers)
    }
}

/// Implements an operator between two packs, and between a pack and a number.
macro_rules! operator {
    ($operator:ident, $method:ident, $symbol:tt) => {
        impl<S: Simd> $operator for Pack<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(self.numbers $symbol other.numbers)
            }
        }

        impl<S: Simd> $operator<f64> for Pack<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self $symbol Self::splat(self.simd, other)
            }
        }

        impl<S: Simd> $operator<Pack<S>> for f64 {
            type Output = Pack<S>;

            #[inline(always)]
            fn $method(self, other: Pack<S>) -> Pack<S> {
                Pack::splat(other.simd, self) $symbol other
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);
