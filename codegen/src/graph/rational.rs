//! Rational constants. Nearly all are 1 and −1, for which the ways here spare the divisions that keep others reduced.

use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// An exact rational constant.
pub type Rational = BigRational;

/// A whole number as a rational constant.
pub fn whole(value: i64) -> Rational {
    Rational::from_integer(BigInt::from(value))
}

/// The quotient of two whole numbers as a rational constant; the denominator is not zero.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(BigInt::from(numerator), BigInt::from(denominator))
}

/// The product.
pub(crate) fn times(a: &Rational, b: &Rational) -> Rational {
    if a.is_one() {
        b.clone()
    } else if b.is_one() {
        a.clone()
    } else {
        a * b
    }
}

/// The quotient; the divisor is not zero.
pub(crate) fn over(a: &Rational, b: &Rational) -> Rational {
    if b.is_one() {
        a.clone()
    } else if a == b {
        Rational::one()
    } else if *a == -b {
        -Rational::one()
    } else {
        a / b
    }
}

/// Adds a coefficient to that of an operand.
pub(crate) fn collect<K: Ord>(
    terms: &mut BTreeMap<K, Rational>,
    operand: K,
    coefficient: Rational,
) {
    terms
        .entry(operand)
        .and_modify(|known| {
            if known.is_zero() {
                known.clone_from(&coefficient);
            } else {
                *known += &coefficient;
            }
        })
        .or_insert(coefficient);
}

/// The hash of a reduced number: of its parts, where the number's own divides its way to them.
pub(crate) fn hash_parts<H: Hasher>(value: &Rational, state: &mut H) {
    value.numer().hash(state);
    value.denom().hash(state);
}

/// The hash of terms.
pub(crate) fn hash_terms<K: Hash, H: Hasher>(terms: &[(K, Rational)], state: &mut H) {
    state.write_usize(terms.len());
    for (operand, coefficient) in terms {
        operand.hash(state);
        hash_parts(coefficient, state);
    }
}
