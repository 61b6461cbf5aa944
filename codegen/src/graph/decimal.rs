//! Decimal literals as exact rationals.

use num_bigint::BigInt;
use num_traits::{One, Pow};

use super::Rational;

/// The exact value of decimal digits as `syn` gives them: `0.752`, `1e-3`, `2.0e11`; below 2.2e-308
/// that of the nearest `f64`. `None` if the exponent is beyond that of any `f64`.
pub fn decimal(digits: &str) -> Option<Rational> {
    let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (digits, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let exponent = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    if exponent.abs() > 2000 {
        return None;
    }
    let value: BigInt = format!("{whole}{fraction}").parse().ok()?;
    let power = Pow::pow(BigInt::from(10), exponent.unsigned_abs());
    let value = if exponent < 0 {
        Rational::new(value, power)
    } else {
        Rational::new(value * power, BigInt::one())
    };
    // Below the smallest normal number an `f64` has few digits, so that the one that Rust reads is another number.
    let nearest = value.to_f64().filter(|nearest| nearest.is_subnormal());
    Some(nearest.and_then(Rational::of_f64).unwrap_or(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::ratio;

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal("0.752"), Some(ratio(94, 125)));
        assert_eq!(decimal("2.5e3"), Some(ratio(2500, 1)));
        assert_eq!(decimal("1e-3"), Some(ratio(1, 1000)));
        assert_eq!(decimal("1e99999"), None);
    }
}
