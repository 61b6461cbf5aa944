//! What the frequency equation is written over: numbers, numbers with derivatives, and polynomials.

use std::ops::{Add, Mul, Sub};

use nalgebra::Complex;

use super::double_double::DoubleDouble;

/// What a closed form needs of its numbers, so that it stands once for values, for derivatives and for coefficients.
pub(super) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The constant, as a number of the kind of this one.
    fn constant(self, value: f64) -> Self;
}

impl Number for f64 {
    fn constant(self, value: f64) -> Self {
        value
    }
}

impl Number for Complex<f64> {
    fn constant(self, value: f64) -> Self {
        Self::new(value, 0.0)
    }
}

impl Number for DoubleDouble {
    fn constant(self, value: f64) -> Self {
        Self::from(value)
    }
}

/// The sum of the sizes of all terms of a value: what its rounding errors are measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size(pub(super) f64);

impl Number for Size {
    fn constant(self, value: f64) -> Self {
        Self(value.abs())
    }
}

impl Add for Size {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

#[allow(
    clippy::suspicious_arithmetic_impl,
    reason = "sizes of terms add up whatever the terms' signs are"
)]
impl Sub for Size {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other
    }
}

impl Mul for Size {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Add<f64> for Size {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        Self(self.0 + other.abs())
    }
}

impl Mul<f64> for Size {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor.abs())
    }
}

/// A value with its derivatives by two variables x and y: both first ones, ∂²/∂x² and ∂²/∂x∂y. The variables are ϖ and
/// Ω for the minors, ωϖ and Ω² for the frequency equation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Jet {
    pub(super) value: f64,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) xx: f64,
    pub(super) xy: f64,
}

impl Jet {
    /// The variables themselves.
    pub(super) fn variables(x: f64, y: f64) -> [Self; 2] {
        [
            Self {
                value: x,
                x: 1.0,
                ..Self::default()
            },
            Self {
                value: y,
                y: 1.0,
                ..Self::default()
            },
        ]
    }
}

impl Number for Jet {
    fn constant(self, value: f64) -> Self {
        Self {
            value,
            ..Self::default()
        }
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            x: self.x + other.x,
            y: self.y + other.y,
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
        }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            value: a.value * b.value,
            x: a.x * b.value + a.value * b.x,
            y: a.y * b.value + a.value * b.y,
            xx: a.xx * b.value + 2.0 * a.x * b.x + a.value * b.xx,
            xy: a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy,
        }
    }
}

impl Add<f64> for Jet {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            x: self.x * factor,
            y: self.y * factor,
            xx: self.xx * factor,
            xy: self.xy * factor,
        }
    }
}

/// A polynomial of degree 4 at most, lowest power first. Products must not exceed that degree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial(pub(super) [DoubleDouble; 5]);

impl Polynomial {
    /// The constant.
    pub(super) fn of(value: DoubleDouble) -> Self {
        let mut powers = [DoubleDouble::ZERO; 5];
        powers[0] = value;
        Self(powers)
    }

    /// The variable itself.
    pub(super) fn variable() -> Self {
        let mut powers = [DoubleDouble::ZERO; 5];
        powers[1] = DoubleDouble::from(1.0);
        Self(powers)
    }
}

impl Number for Polynomial {
    fn constant(self, value: f64) -> Self {
        Self::of(DoubleDouble::from(value))
    }
}

impl Add for Polynomial {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|power| self.0[power] + other.0[power]))
    }
}

impl Sub for Polynomial {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|power| self.0[power] - other.0[power]))
    }
}

impl Mul for Polynomial {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut product = [DoubleDouble::ZERO; 5];
        // Most factors are of a low degree: their zeros are not worth a multiplication.
        let nonzero = |(_, coefficient): &(usize, &DoubleDouble)| coefficient.high != 0.0;
        for (low, a) in self.0.iter().enumerate().filter(nonzero) {
            for (high, b) in other.0.iter().enumerate().filter(nonzero) {
                if let Some(sum) = product.get_mut(low + high) {
                    *sum = *sum + *a * *b;
                }
            }
        }
        Self(product)
    }
}

impl Add<f64> for Polynomial {
    type Output = Self;
    fn add(mut self, other: f64) -> Self {
        self.0[0] = self.0[0] + other;
        self
    }
}

impl Mul<f64> for Polynomial {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }
}
