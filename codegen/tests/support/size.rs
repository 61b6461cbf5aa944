//! Bounds of sizes far beyond those of an `f64`.

use astro_float::BigFloat;

/// Beyond this exponent of two nothing is said about a number.
pub const LARGEST: f64 = 1e9;

/// An upper bound of a size by its logarithm to base 2, so that it may be far beyond any `f64`; −∞ is 0.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Size(pub f64);

impl Size {
    pub const ZERO: Self = Self(f64::NEG_INFINITY);
    pub const UNKNOWN: Self = Self(f64::INFINITY);

    pub fn of(value: &BigFloat) -> Self {
        match value.exponent() {
            _ if value.is_zero() => Self::ZERO,
            Some(exponent) => Self(f64::from(exponent)),
            None => Self::UNKNOWN,
        }
    }

    /// A lower bound in the place of an upper one.
    pub fn at_least(value: &BigFloat) -> Self {
        Self(Self::of(value).0 - 1.0)
    }

    /// What is lost to logarithms that are rounded.
    pub fn rounded_up(self) -> Self {
        Self(self.0 + self.0.abs() * 1e-14 + 1e-9)
    }

    pub fn plus(self, other: Self) -> Self {
        let (small, large) = if self.0 < other.0 {
            (self.0, other.0)
        } else {
            (other.0, self.0)
        };
        if small == f64::NEG_INFINITY || large == f64::INFINITY {
            return Self(large);
        }
        Self(large + (small - large).exp2().ln_1p() * std::f64::consts::LOG2_E).rounded_up()
    }

    pub fn times(self, other: Self) -> Self {
        if self == Self::ZERO || other == Self::ZERO {
            return Self::ZERO;
        }
        Self(self.0 + other.0).rounded_up()
    }

    pub fn over(self, other: Self) -> Self {
        if self == Self::ZERO {
            return self;
        }
        Self(self.0 - other.0).rounded_up()
    }

    pub fn is_known(self) -> bool {
        self.0 < LARGEST
    }

    pub fn larger(self, other: Self) -> Self {
        if self.0 < other.0 { other } else { self }
    }

    pub fn as_number(self) -> BigFloat {
        let mut number = BigFloat::from_f64(1.0, 64);
        if self == Self::ZERO {
            return BigFloat::from_f64(0.0, 64);
        }
        number.set_exponent(self.0.ceil() as i32 + 1);
        number
    }
}
