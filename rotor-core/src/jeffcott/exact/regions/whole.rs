//! Polynomials in one variable with whole coefficients of any size.

use num_bigint::{BigInt, Sign};

/// A polynomial, lowest power first; the last coefficient is not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Whole(Vec<BigInt>);

impl Whole {
    /// The polynomial with these coefficients.
    pub(super) fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients
            .last()
            .is_some_and(|last| *last == BigInt::ZERO)
        {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// Whether it is zero everywhere.
    pub(super) const fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The coefficients.
    pub(super) fn coefficients(&self) -> &[BigInt] {
        &self.0
    }

    /// `factor` times the polynomial.
    pub(super) fn scaled(&self, factor: i32) -> Self {
        Self::new(
            self.0
                .iter()
                .map(|coefficient| coefficient * factor)
                .collect(),
        )
    }

    /// The sum.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let length = self.0.len().max(other.0.len());
        let at = |whole: &Self, power: usize| whole.0.get(power).cloned().unwrap_or_default();
        Self::new(
            (0..length)
                .map(|power| at(self, power) + at(other, power))
                .collect(),
        )
    }

    /// The product.
    pub(super) fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self(Vec::new());
        }
        let mut product = vec![BigInt::ZERO; self.0.len() + other.0.len() - 1];
        for (low, a) in self.0.iter().enumerate() {
            for (high, b) in other.0.iter().enumerate() {
                product[low + high] += a * b;
            }
        }
        Self::new(product)
    }

    /// The polynomial without its roots at zero.
    pub(super) fn without_zero_roots(&self) -> Self {
        let nonzero = self
            .0
            .iter()
            .skip_while(|coefficient| **coefficient == BigInt::ZERO);
        Self(nonzero.cloned().collect())
    }

    /// p(x + 1).
    pub(super) fn shifted(&self) -> Self {
        let mut shifted = self.0.clone();
        let degree = shifted.len().saturating_sub(1);
        for first in 0..degree {
            for power in (first..degree).rev() {
                let (below, above) = shifted.split_at_mut(power + 1);
                below[power] += &above[0];
            }
        }
        Self(shifted)
    }

    /// 2^(places · degree) p(x / 2^places), or for negative places p(x · 2^−places): the variable is so many times as large.
    pub(super) fn stretched(&self, places: i64) -> Self {
        let degree = self.0.len().saturating_sub(1);
        let scaled = self.0.iter().enumerate().map(|(power, coefficient)| {
            let steps = if places < 0 { power } else { degree - power };
            coefficient << (places.unsigned_abs() * steps as u64)
        });
        Self(scaled.collect())
    }

    /// (1 + t)^degree p(1 / (1 + t)): its positive roots are the roots of p between 0 and 1.
    pub(super) fn of_unit_interval(&self) -> Self {
        self.reversed().shifted()
    }

    /// x^degree p(1/x), of a polynomial without a root at zero.
    pub(super) fn reversed(&self) -> Self {
        Self(self.0.iter().rev().cloned().collect())
    }

    /// How often the signs of the coefficients change; there are as many positive roots, or an even number fewer (Descartes).
    pub(super) fn variations(&self) -> usize {
        let signs = self
            .0
            .iter()
            .map(BigInt::sign)
            .filter(|sign| *sign != Sign::NoSign);
        let signs: Vec<Sign> = signs.collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// 2^(places · power) p(point / 2^places), for a power that is no less than the degree.
    pub(super) fn at(&self, point: &Dyadic, power: usize) -> BigInt {
        let mut value = BigInt::ZERO;
        for place in (0..=power).rev() {
            value *= &point.mantissa;
            if let Some(coefficient) = self.0.get(place) {
                value += coefficient << (point.places * (power - place) as u64);
            }
        }
        value
    }

    /// 2^(places · degree) p(x / 2^places) around a point: its value and its derivatives there by their signs, lowest first.
    pub(super) fn around(&self, point: &Dyadic) -> Self {
        let mut coefficients = self.stretched(point.places as i64).0;
        let degree = coefficients.len().saturating_sub(1);
        for first in 0..degree {
            for power in (first..degree).rev() {
                let above = &coefficients[power + 1] * &point.mantissa;
                coefficients[power] += above;
            }
        }
        Self(coefficients)
    }

    /// The polynomial times its variable to a power.
    pub(super) fn raised(&self, power: usize) -> Self {
        let zeros = std::iter::repeat_n(BigInt::ZERO, power);
        Self::new(zeros.chain(self.0.iter().cloned()).collect())
    }
}

/// mantissa / 2^places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Dyadic {
    pub(super) mantissa: BigInt,
    pub(super) places: u64,
}

impl Dyadic {
    /// The mantissa over so many places, no fewer than there are.
    fn over(&self, places: u64) -> BigInt {
        &self.mantissa << (places - self.places)
    }

    /// Whether it is less.
    pub(super) fn is_less(&self, other: &Self) -> bool {
        let places = self.places.max(other.places);
        self.over(places) < other.over(places)
    }

    /// A number between two different ones, well apart from both, that has few digits.
    pub(super) fn between(low: &Self, high: &Self) -> Self {
        // Two more, so that there are eight steps between the two at least.
        let places = low.places.max(high.places) + 3;
        let (low, high) = (low.over(places), high.over(places));
        let spare = (&high - &low).bits() - 3;
        Self {
            mantissa: ((low + high) >> (spare + 1)) << spare,
            places,
        }
        .shortened()
    }

    /// The same with as few places as it needs.
    fn shortened(self) -> Self {
        let spare = self.mantissa.trailing_zeros().unwrap_or(0).min(self.places);
        Self {
            mantissa: self.mantissa >> spare,
            places: self.places - spare,
        }
    }
}
