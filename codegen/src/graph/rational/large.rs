//! Sums and products of fractions that are not small.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;

use super::Rational;

/// The sum of two fractions.
pub(super) fn sum(left: &BigRational, right: &BigRational) -> Rational {
    if left.denom() == right.denom() {
        return Rational::new(left.numer() + right.numer(), left.denom().clone());
    }
    let numerator = left.numer() * right.denom() + right.numer() * left.denom();
    Rational::new(numerator, left.denom() * right.denom())
}

/// The product of two fractions in lowest terms.
pub(super) fn product(left: &BigRational, right: &BigRational) -> Rational {
    let [first, second] = [
        common_divisor(left.numer(), right.denom()),
        common_divisor(right.numer(), left.denom()),
    ];
    let numerator = (left.numer() / &first) * (right.numer() / &second);
    let denominator = (left.denom() / &second) * (right.denom() / &first);
    Rational::of_big(BigRational::new_raw(numerator, denominator))
}

/// The greatest common divisor. The library's takes a bit at a time, which is long where one number is far shorter than the
/// other or is a power of two, as the parts of decimals and of numbers of double precision are.
pub(super) fn common_divisor(left: &BigInt, right: &BigInt) -> BigInt {
    let [left, right] = [left.magnitude(), right.magnitude()];
    let (Some(twos_of_left), Some(twos_of_right)) = (left.trailing_zeros(), right.trailing_zeros())
    else {
        return (left + right).into();
    };
    let odd = [left >> twos_of_left, right >> twos_of_right];
    let (shorter, longer) = (odd.iter().min(), odd.iter().max());
    let divisor = match (shorter, longer) {
        (Some(shorter), Some(longer)) if !shorter.is_one() => shorter.gcd(&(longer % shorter)),
        _ => BigUint::one(),
    };
    BigInt::from(divisor << twos_of_left.min(twos_of_right))
}
