//! Arcs, hyperbolic functions, powers and steps of constants, by series, logarithms and exponentials.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive};

use super::{
    BITS, LARGEST_EXPONENT, ZERO_BITS, exponential, fixed, logarithm, one, pi, product, rational,
    series_of_odd,
};
use crate::graph::{Function, Rational, ratio, whole};

/// How often the argument of an arc tangent is halved, so that its series takes 40 terms.
const HALVINGS: u32 = 6;

/// Whole powers up to this are multiplied out, as a number that is exact.
const LARGEST_POWER: i64 = 64;

/// A function of one constant, where it has a finite value.
pub(super) fn of_one(function: Function, x: &Rational) -> Option<Rational> {
    let one = Rational::ONE;
    // Of a tiny number the fixed-point number has few digits; two terms of the series of these functions have as many.
    if x.abs() < rational(BigInt::one(), BITS as i64 - ZERO_BITS as i64 / 2)
        && let Some(curved) = second_order(function)
    {
        return Some(x + &(x * x) * &curved);
    }
    match function {
        Function::Atan => Some(rational(arc_tangent(x), 0)),
        Function::Asin | Function::Acos => arc(function, x),
        Function::Sinh | Function::Cosh | Function::Tanh | Function::ExpM1 => {
            let (up, down) = (exponential(x)?, exponential(&-x.clone())?);
            Some(match function {
                Function::Sinh => (&up - &down) * ratio(1, 2),
                Function::Cosh => (&up + &down) * ratio(1, 2),
                Function::Tanh => (&up - &down) / (&up + &down),
                _ => up - one,
            })
        }
        Function::Ln1p => positive(&one + x),
        Function::Asinh => {
            let size = x.abs();
            let log = positive(&size + &root(&(x * x + &one), 2)?)?;
            Some(if x.is_negative() { -log } else { log })
        }
        Function::Acosh if *x >= one => positive(x + &root(&(x * x - &one), 2)?),
        Function::Atanh if x.abs() < one => Some(positive((&one + x) / (&one - x))? * ratio(1, 2)),
        Function::Cbrt => root(x, 3),
        Function::Log10 => Some(positive(x.clone())? / logarithm(&whole(10))),
        Function::Log2 => Some(positive(x.clone())? / logarithm(&whole(2))),
        Function::Exp2 => power(&whole(2), x),
        Function::Floor | Function::Ceil | Function::Round | Function::Trunc => step(function, x),
        _ => None,
    }
}

/// A function of two constants, where it has a finite value.
pub(super) fn of_two(function: Function, x: &Rational, y: &Rational) -> Option<Rational> {
    match function {
        Function::Atan2 => angle(x, y),
        Function::Hypot => root(&(x * x + y * y), 2),
        Function::Powf => power(x, y),
        _ => None,
    }
}

/// What follows x in the power series of a function that begins with x: the coefficient of its square.
fn second_order(function: Function) -> Option<Rational> {
    match function {
        Function::Asin
        | Function::Atan
        | Function::Sinh
        | Function::Tanh
        | Function::Asinh
        | Function::Atanh => Some(Rational::ZERO),
        Function::ExpM1 => Some(ratio(1, 2)),
        Function::Ln1p => Some(ratio(-1, 2)),
        _ => None,
    }
}

/// A logarithm of what is above 0.
fn positive(x: Rational) -> Option<Rational> {
    x.is_positive().then(|| logarithm(&x))
}

/// Whether a number is so near another one that it may be that: what was worked out to a number of digits is not told apart.
fn is_near(x: &Rational, other: &Rational) -> bool {
    let apart = (x - other).abs();
    apart < (other.abs() + Rational::ONE) * rational(BigInt::one(), BITS as i64 - ZERO_BITS as i64)
}

/// A square or cube root to as many digits as all here have.
fn root(x: &Rational, degree: u32) -> Option<Rational> {
    if x.is_negative() && degree == 2 {
        return None;
    }
    // Of a whole number of 3·BITS digits or more.
    let degree_bits = u64::from(degree);
    let bits = x.denominator().bits() + degree_bits * BITS as u64;
    let shift = bits - bits % degree_bits;
    let scaled = (x.numerator() << shift).div_floor(&x.denominator());
    let scale = BigInt::one() << (shift / degree_bits);
    Some(Rational::new(scaled.nth_root(degree), scale))
}

/// The arc tangent as a fixed-point number.
fn arc_tangent(x: &Rational) -> BigInt {
    if x.is_negative() {
        return -arc_tangent(&-x.clone());
    }
    if *x > Rational::ONE {
        return (pi() >> 1_usize) - arc_tangent(&(Rational::ONE / x));
    }
    let mut tangent = fixed(x);
    for _ in 0..HALVINGS {
        // tan(θ/2) = t/(1 + √(1 + t²))
        let square = one() + product(&tangent, &tangent);
        let root = (square << BITS).sqrt();
        tangent = (tangent << BITS) / (one() + root);
    }
    let square = -product(&tangent, &tangent);
    series_of_odd(tangent, &square) << HALVINGS
}

/// The angle of the point (x, y); the origin has one by the signs of its zeros alone.
fn angle(y: &Rational, x: &Rational) -> Option<Rational> {
    let half_turn = || rational(pi(), 0);
    if x.is_zero() {
        let quarter = half_turn() * ratio(1, 2);
        return match y {
            y if y.is_zero() => None,
            y if y.is_negative() => Some(-quarter),
            _ => Some(quarter),
        };
    }
    // Below the smallest angle that a fixed-point number has, the code knows it as well.
    let angle = of_one(Function::Atan, &(y / x))?;
    Some(match (x.is_negative(), y.is_negative()) {
        (false, _) => angle,
        (true, false) => angle + half_turn(),
        (true, true) => angle - half_turn(),
    })
}

fn arc(function: Function, x: &Rational) -> Option<Rational> {
    let one = Rational::ONE;
    if x.abs() > one {
        return None;
    }
    let side = root(&(&one - x * x), 2)?;
    match function {
        _ if *x == one && function == Function::Acos => Some(Rational::ZERO),
        Function::Asin => angle(x, &side),
        _ => angle(&side, x),
    }
}

/// A power of what is above 0, or a whole one of any number.
fn power(x: &Rational, y: &Rational) -> Option<Rational> {
    if y.is_zero() {
        return Some(Rational::ONE);
    }
    if y.is_integer() && y.abs() <= whole(LARGEST_POWER) && !x.is_zero() {
        return Some(x.pow(y.numerator().to_i32()?));
    }
    if x.is_zero() {
        return y.is_positive().then_some(Rational::ZERO);
    }
    let exponent = y * positive(x.clone())?;
    if exponent.abs() > whole(LARGEST_EXPONENT) {
        return None;
    }
    exponential(&exponent)
}

/// A whole number beside a constant; none where the constant may be on either side of a jump.
fn step(function: Function, x: &Rational) -> Option<Rational> {
    let whole_below =
        |x: &Rational| Rational::from_integer(x.numerator().div_floor(&x.denominator()));
    let half = ratio(1, 2);
    let twice = x * whole(2);
    let nearest = whole_below(&(&twice + &half)) * &half;
    if nearest != *x && is_near(x, &nearest) {
        return None;
    }
    let ceil = |x: &Rational| -whole_below(&-x.clone());
    Some(match function {
        Function::Floor => whole_below(x),
        Function::Ceil => ceil(x),
        Function::Trunc if x.is_negative() => ceil(x),
        Function::Trunc => whole_below(x),
        _ if x.is_negative() => ceil(&(x - half)),
        _ => whole_below(&(x + half)),
    })
}

/// One of two by a comparison of constants; none where these are equal to so many digits, but not exactly.
pub(super) fn chosen(function: Function, [a, b, x, y]: [&Rational; 4]) -> Option<&Rational> {
    if a != b && is_near(a, b) {
        return None;
    }
    Some(if function.holds(a, b) { x } else { y })
}
