//! Numbers of twice the precision of `f64`, about 32 digits: the unevaluated sum of two.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low` with |low| at most half the last place of high.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct DoubleDouble {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl DoubleDouble {
    pub(super) const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };

    /// The sum of two numbers without error (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self {
            high,
            low: (a - (high - of_b)) + (b - of_b),
        }
    }

    /// The exact sum of two numbers with |a| ≥ |b| (Dekker).
    fn sum_of_ordered(a: f64, b: f64) -> Self {
        let high = a + b;
        Self {
            high,
            low: b - (high - a),
        }
    }

    /// The nearest `f64`.
    pub(super) fn rounded(self) -> f64 {
        self.high
    }

    pub(super) fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The square root of a number that is not negative.
    pub(super) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        // One step of Newton's iteration doubles the digits of the first.
        let root = self.high.sqrt();
        let rest = self - Self::from(root) * Self::from(root);
        Self::sum_of_ordered(root, rest.high / (2.0 * root))
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let carried = Self::sum_of_ordered(high.high, high.low + low.high);
        Self::sum_of_ordered(carried.high, carried.low + low.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        // The fused product gives the rounding error of the plain one exactly.
        let error = self.high.mul_add(other.high, -high);
        Self::sum_of_ordered(
            high,
            error + (self.high * other.low + self.low * other.high),
        )
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        let high = self.high * other;
        let error = self.high.mul_add(other, -high);
        Self::sum_of_ordered(high, error + self.low * other)
    }
}

impl Add<f64> for DoubleDouble {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Self::from(other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let third = (rest - other * second).high / other.high;
        Self::sum_of_ordered(first, second) + third
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> DoubleDouble {
        DoubleDouble::from(value)
    }

    #[test]
    fn a_third_and_the_root_of_two_in_thirty_digits() {
        let third = number(1.0) / number(3.0);
        assert!((third * 3.0 + -1.0).abs().high < 1e-31);
        let root = number(2.0).sqrt();
        assert!((root * root + -2.0).abs().high < 1e-31);
        // The second part of the root of two, from its 40 digits.
        assert!((root.low - -9.667_293_313_452_913e-17).abs() < 1e-31);
        assert_eq!(number(0.0).sqrt(), DoubleDouble::ZERO);
    }

    #[test]
    fn small_parts_survive_large_ones() {
        let sum = number(1.0) + 1e-25 - number(1.0);
        assert!((sum.high - 1e-25).abs() < 1e-31, "{sum:?}");
        let square = (number(1.0) + 1e-20) * (number(1.0) + -1e-20) + -1.0;
        assert!(square.abs().high < 1e-31, "{square:?}");
    }
}
