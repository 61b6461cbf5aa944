//! Elementary functions of constants, computed when the crate is built: whole numbers as fixed-point numbers of
//! `BITS` bits behind the point, so that far more digits are right than any number type of the output has.
//!
//! What has no finite value, such as the root or logarithm of a negative number, is not folded: the code computes it, and it
//! is NaN there as in the function as written.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::graph::{Function, Rational};

/// Bits behind the point: 77 digits, and as many again for what reduction and squaring lose.
const BITS: usize = 512;

/// Exponents beyond this give no finite `f64`.
const LARGEST_EXPONENT: i64 = 700;

/// Angles beyond this have lost their turns.
const LARGEST_ANGLE: i64 = 1 << 40;

/// A sine, cosine or tangent of an ordinary angle that is smaller than 2^-130 stands for 0: the angle is a multiple of π/2
/// to as many digits as π is known in this crate.
const ZERO_BITS: usize = 130;

/// A function of constants, where it has a finite value that is not a rational number's by a rule.
pub fn value(function: Function, operands: &[Rational]) -> Option<Rational> {
    match (function, operands) {
        (Function::Sign | Function::Side, [x]) => Some(if x.is_negative() {
            -Rational::ONE
        } else {
            Rational::ONE
        }),
        (Function::Min, [x, y]) => Some(x.min(y).clone()),
        (Function::Max, [x, y]) => Some(x.max(y).clone()),
        (Function::Select, [a, b, x, y]) => Some(if a == b { x } else { y }.clone()),
        (Function::Exp, [x]) => exponential(x),
        (Function::Ln, [x]) if x.is_positive() => Some(logarithm(x)),
        (Function::Sin | Function::Cos | Function::Tan, [x]) => circular(function, x),
        _ => None,
    }
}

fn one() -> BigInt {
    BigInt::one() << BITS
}

fn fixed(value: &Rational) -> BigInt {
    (value.numerator() << BITS).div_floor(&value.denominator())
}

fn product(left: &BigInt, right: &BigInt) -> BigInt {
    (left * right) >> BITS
}

/// The fixed-point number times a power of two, as a rational number.
fn rational(value: BigInt, power: i64) -> Rational {
    let shift = power - BITS as i64;
    let scale = BigInt::one() << shift.unsigned_abs();
    if shift < 0 {
        Rational::new(value, scale)
    } else {
        Rational::from_integer(value * scale)
    }
}

/// Σ over n of t(n), where t(n+1) is t(n)·`square` divided by the whole numbers that belong to n.
fn series(first: BigInt, square: &BigInt, divisor: impl Fn(u32) -> u32) -> BigInt {
    let (mut sum, mut term, mut count) = (BigInt::zero(), first, 0);
    while !term.is_zero() && term != -BigInt::one() {
        sum += &term;
        term = product(&term, square) / divisor(count);
        count += 1;
    }
    sum
}

/// 2 artanh(z), that is ln((1+z)/(1−z)), for |z| well below 1.
fn twice_artanh(z: &BigInt) -> BigInt {
    let square = product(z, z);
    let (mut sum, mut power, mut odd) = (BigInt::zero(), z.clone(), 1_u32);
    while !power.is_zero() && power != -BigInt::one() {
        sum += &power / odd;
        power = product(&power, &square);
        odd += 2;
    }
    sum * 2
}

fn ln_2() -> BigInt {
    twice_artanh(&(one() / 3))
}

fn exponential(x: &Rational) -> Option<Rational> {
    if x.abs() > Rational::from_integer(LARGEST_EXPONENT.into()) {
        return None;
    }
    let (x, ln_2) = (fixed(x), ln_2());
    let shifted: BigInt = x + (&ln_2 >> 1_usize);
    let (halvings, rest) = shifted.div_mod_floor(&ln_2);
    let rest = rest - (ln_2 >> 1_usize);
    let sum = series(one(), &rest, |n| n + 1);
    Some(rational(sum, halvings.to_i64()?))
}

fn logarithm(x: &Rational) -> Rational {
    // x = m·2^k with m between 1/2 and 2.
    let power = x.numerator().bits() as i64 - x.denominator().bits() as i64;
    let scale = Rational::from_integer(BigInt::one() << power.unsigned_abs());
    let mantissa = if power < 0 { x * scale } else { x / scale };
    let (above, below) = (&mantissa - Rational::ONE, &mantissa + Rational::ONE);
    rational(twice_artanh(&fixed(&(above / below))) + ln_2() * power, 0)
}

/// π by Machin's formula.
fn pi() -> BigInt {
    let arctan_of_inverse = |n: u32| {
        let z = one() / n;
        let square = -product(&z, &z);
        let (mut sum, mut power, mut odd) = (BigInt::zero(), z, 1_u32);
        while !power.is_zero() && power != -BigInt::one() {
            sum += &power / odd;
            power = product(&power, &square);
            odd += 2;
        }
        sum
    };
    arctan_of_inverse(5) * 16 - arctan_of_inverse(239) * 4
}

fn circular(function: Function, x: &Rational) -> Option<Rational> {
    if x.abs() > Rational::from_integer(LARGEST_ANGLE.into()) {
        return None;
    }
    let small = x.abs() < rational(BigInt::one(), BITS as i64 - ZERO_BITS as i64 / 2);
    let quarter: BigInt = pi() >> 1_usize;
    let shifted: BigInt = fixed(x) + (&quarter >> 1_usize);
    let (turns, rest) = shifted.div_mod_floor(&quarter);
    let rest = rest - (quarter >> 1_usize);
    let square = -product(&rest, &rest);
    let sine = series(rest, &square, |n| (2 * n + 2) * (2 * n + 3));
    let cosine = series(one(), &square, |n| (2 * n + 1) * (2 * n + 2));
    let (sine, cosine) = match turns.mod_floor(&BigInt::from(4)).to_u32()? {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    };
    let clean = |value: BigInt| {
        let vanishes = !small && value.abs() < one() >> ZERO_BITS;
        if vanishes { BigInt::zero() } else { value }
    };
    let (sine, cosine) = (clean(sine), clean(cosine));
    match function {
        // Of a tiny angle the fixed-point number has few digits, and the angle itself is its sine to as many.
        Function::Sin | Function::Tan if small => Some(x.clone()),
        Function::Sin => Some(rational(sine, 0)),
        Function::Cos => Some(rational(cosine, 0)),
        _ if cosine.is_zero() => None,
        _ => Some(Rational::new(sine, cosine)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::decimal;
    use crate::graph::ratio;

    /// Whether they agree to 60 digits.
    fn assert_digits(function: Function, argument: Rational, digits: &str) {
        let (found, expected) = (
            value(function, &[argument]).expect("a value"),
            decimal(digits).expect("digits"),
        );
        let apart = ((&found - &expected) / &expected).abs();
        assert!(
            apart < ratio(1, 1_000_000_000).pow(6),
            "{function:?}: {digits}"
        );
    }

    #[test]
    fn constants_have_sixty_digits() {
        assert_digits(
            Function::Exp,
            ratio(1, 1),
            "2.7182818284590452353602874713526624977572470936999595749669676277",
        );
        assert_digits(
            Function::Exp,
            ratio(-20, 1),
            "2.0611536224385578279659403801558209763758072755991036929647126e-9",
        );
        assert_digits(
            Function::Ln,
            ratio(2, 1),
            "0.69314718055994530941723212145817656807550013436025525412068000949",
        );
        assert_digits(
            Function::Ln,
            ratio(1, 10),
            "-2.3025850929940456840179914546843642076011014886287729760333279009",
        );
        assert_digits(
            Function::Sin,
            ratio(1, 1),
            "0.84147098480789650665250232163029899962256306079837106567275170999",
        );
        assert_digits(
            Function::Cos,
            ratio(10, 1),
            "-0.83907152907645245225886394782406483451993016513316854683595373104",
        );
        assert_digits(
            Function::Tan,
            ratio(-1, 1),
            "-1.5574077246549022305069748074583601730872507723815200383839466056",
        );
    }

    #[test]
    fn functions_of_constants_are_those_of_the_standard_library() {
        let functions = [
            Function::Exp,
            Function::Ln,
            Function::Sin,
            Function::Cos,
            Function::Tan,
        ];
        for step in -80..=80_i64 {
            let x = ratio(step * step * step, 3000);
            let nearest = x.to_f64().expect("a number");
            for function in functions {
                let Some(found) = value(function, std::slice::from_ref(&x)) else {
                    continue;
                };
                let known = <f64 as crate::interpret::Number>::apply(function, &[nearest]);
                let slack = 4.0
                    * f64::EPSILON
                    * (1.0 + nearest.abs())
                    * (known.abs() + known * known + 1.0);
                let found = found.to_f64().expect("a number");
                assert!(
                    (found - known).abs() <= slack,
                    "{function:?}({nearest}): {found}, {known}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_finite_value_is_left_to_the_code() {
        assert_eq!(value(Function::Ln, &[ratio(-1, 2)]), None);
        assert_eq!(value(Function::Ln, &[ratio(0, 1)]), None);
        assert_eq!(value(Function::Sqrt, &[ratio(-1, 2)]), None);
        assert_eq!(value(Function::Exp, &[ratio(1000, 1)]), None);
    }
}
