//! The frequency equation as a polynomial in P = ωϖ and Y = Ω² with exact coefficients.
//!
//! Doubles are whole numbers times powers of two, and so are their sums and products: nothing is rounded here. Of the crack's
//! angle the sine or the cosine is a double, from which cos 2φ follows exactly.

use std::cell::RefCell;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;

use super::whole::Whole;
use crate::equations::Coefficients;
use crate::jeffcott::exact::frequency_equation::phi_from_product;
use crate::jeffcott::exact::number::Number;

/// How many powers of P and of Y there are: Φ has P⁴ and Y² at most, and so has every product on the way to it.
const POWERS: [usize; 2] = [5, 3];

/// Σ terms[i][j] Pⁱ Yʲ · 2^exponent.
#[derive(Clone, Debug, Default)]
struct Surface {
    terms: [[BigInt; POWERS[1]]; POWERS[0]],
    exponent: i64,
}

impl Surface {
    /// One term alone.
    fn term(value: f64, [i, j]: [usize; 2]) -> Self {
        let mut surface = Self::default();
        let (mantissa, exponent) = parts(value);
        surface.terms[i][j] = BigInt::from(mantissa);
        surface.exponent = exponent;
        surface
    }

    /// The same with the exponent of the one of two that has the smaller one.
    fn aligned(&self, exponent: i64) -> Self {
        let places = self.exponent.saturating_sub(exponent);
        let mut surface = self.clone();
        surface.exponent = exponent;
        for term in surface.terms.iter_mut().flatten() {
            *term <<= places;
        }
        surface
    }

    fn plus(&self, other: &Self, sign: i32) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let (mut sum, other) = (self.aligned(exponent), other.aligned(exponent));
        for (own, other) in sum
            .terms
            .iter_mut()
            .flatten()
            .zip(other.terms.into_iter().flatten())
        {
            *own += other * sign;
        }
        sum
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = Self {
            exponent: self.exponent + other.exponent,
            ..Self::default()
        };
        for (i, j, a) in self.nonzero() {
            for (k, l, b) in other.nonzero() {
                product.terms[i + k][j + l] += a * b;
            }
        }
        product
    }

    fn nonzero(&self) -> impl Iterator<Item = (usize, usize, &BigInt)> {
        let rows = self.terms.iter().enumerate();
        let all =
            rows.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, term)| (i, j, term)));
        all.filter(|(_, _, term)| **term != BigInt::ZERO)
    }
}

/// A finite double as a whole number times a power of two.
fn parts(value: f64) -> (i64, i64) {
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, exponent - 1075),
    };
    (if value < 0.0 { -mantissa } else { mantissa }, exponent)
}

/// Where the numbers of one calculation are kept, so that a number is a place that can be copied.
#[derive(Debug, Default)]
struct Store(RefCell<Vec<Surface>>);

impl Store {
    fn keep(&self, surface: Surface) -> Kept<'_> {
        let mut kept = self.0.borrow_mut();
        kept.push(surface);
        Kept {
            store: self,
            place: kept.len() - 1,
        }
    }
}

/// A number that is kept.
#[derive(Clone, Copy, Debug)]
struct Kept<'a> {
    store: &'a Store,
    place: usize,
}

impl Kept<'_> {
    fn with(self, other: Self, combined: impl FnOnce(&Surface, &Surface) -> Surface) -> Self {
        let surface = {
            let kept = self.store.0.borrow();
            combined(&kept[self.place], &kept[other.place])
        };
        self.store.keep(surface)
    }
}

impl Number for Kept<'_> {
    fn constant(self, value: f64) -> Self {
        self.store.keep(Surface::term(value, [0, 0]))
    }
}

impl Add for Kept<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a.plus(b, 1))
    }
}

impl Sub for Kept<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a.plus(b, -1))
    }
}

impl Mul for Kept<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.with(other, Surface::times)
    }
}

impl Add<f64> for Kept<'_> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + self.constant(other)
    }
}

impl Mul<f64> for Kept<'_> {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self * self.constant(other)
    }
}

/// The coefficients of Φ in powers of P, lowest first, each a polynomial in Y, all times one positive number. The last is a
/// positive constant. The coefficients must be finite.
pub(super) fn quartic(c: &Coefficients) -> [Whole; POWERS[0]] {
    let store = Store::default();
    let product = store.keep(Surface::term(1.0, [1, 0]));
    let speed_squared = store.keep(Surface::term(1.0, [0, 1]));
    let place = phi_from_product(c, speed_squared, product).place;
    let phi = store.0.into_inner().swap_remove(place);
    phi.terms.map(|powers| Whole::new(powers.into()))
}
