//! Elementary functions of constants, computed when the crate is built: whole numbers as fixed-point numbers of
//! `BITS` bits behind the point, so that far more digits are right than any number type of the output has.
//!
//! What has no finite value, such as the root or logarithm of a negative number, is not folded: the code computes it, and it
//! is NaN there as in the function as written.

mod functions;

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
        (Function::Sign | Function::Side | Function::SignBit, [x]) => Some(if x.is_negative() {
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
        (Function::Less | Function::AtMost, [a, b, x, y]) => {
            functions::chosen(function, [a, b, x, y]).cloned()
        }
        (_, [x]) => functions::of_one(function, x),
        (_, [x, y]) => functions::of_two(function, x, y),
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

/// z + s·z/3 + s²·z/5 + …, the arc tangent for s = −z², its hyperbolic one for s = z².
fn series_of_odd(z: BigInt, square: &BigInt) -> BigInt {
    let (mut sum, mut power, mut odd) = (BigInt::zero(), z, 1_u32);
    while !power.is_zero() && power != -BigInt::one() {
        sum += &power / odd;
        power = product(&power, square);
        odd += 2;
    }
    sum
}

/// 2 artanh(z), that is ln((1+z)/(1−z)), for |z| well below 1.
fn twice_artanh(z: &BigInt) -> BigInt {
    series_of_odd(z.clone(), &product(z, z)) * 2
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
        series_of_odd(z, &square)
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

    use Function as F;

    /// Arguments of a function as fractions.
    type Arguments = &'static [(i64, i64)];

    /// Functions of constants with their digits by other means.
    const WITH_DIGITS: [(F, Arguments, &str); 20] = [
        (
            F::Asin,
            &[(1, 2)],
            "0.5235987755982988730771072305465838140328615665625176368291574320513027",
        ),
        (
            F::Acos,
            &[(-1, 2)],
            "2.0943951023931954923084289221863352561314462662500705473166297282052109",
        ),
        (
            F::Atan,
            &[(3, 1)],
            "1.2490457723982544258299170772810901230778294041298967190546692367971519",
        ),
        (
            F::Atan,
            &[(-1, 10)],
            "-0.0996686524911620273784461198780205902432783225043146480155087768100277",
        ),
        (
            F::Sinh,
            &[(1, 1)],
            "1.1752011936438014568823818505956008151557179813340958702295654130133075",
        ),
        (
            F::Cosh,
            &[(-1, 1)],
            "1.5430806348152437784779056207570616826015291123658637047374022147107690",
        ),
        (
            F::Tanh,
            &[(-1, 1)],
            "-0.761594155955764888119458282604793590412768597257936551596810500121953",
        ),
        (
            F::Asinh,
            &[(2, 1)],
            "1.4436354751788103424932767402731052694055530031569815589830545065204916",
        ),
        (
            F::Acosh,
            &[(3, 1)],
            "1.7627471740390860504652186499595846180563206565232708215065912173067543",
        ),
        (
            F::Atanh,
            &[(1, 2)],
            "0.5493061443340548456976226184612628523237452789113747258673471668187471",
        ),
        (
            F::ExpM1,
            &[(1, 100)],
            "0.0100501670841680575421654569028600338073622015242925151644040312543741",
        ),
        (
            F::Ln1p,
            &[(-1, 2)],
            "-0.693147180559945309417232121458176568075500134360255254120680009493393",
        ),
        (
            F::Cbrt,
            &[(-2, 1)],
            "-1.2599210498948731647672106072782283505702514647015079800819751121552996",
        ),
        (
            F::Log10,
            &[(2, 1)],
            "0.3010299956639811952137388947244930267681898814621085413104274611271081",
        ),
        (
            F::Log2,
            &[(10, 1)],
            "3.3219280948873623478703194294893901758648313930245806120547563958159347",
        ),
        (
            F::Exp2,
            &[(1, 2)],
            "1.4142135623730950488016887242096980785696718753769480731766797379907324",
        ),
        (
            F::Atan2,
            &[(1, 1), (-2, 1)],
            "2.6779450445889871222483871518182884821686323450889855571640115035876185",
        ),
        (
            F::Hypot,
            &[(1, 1), (2, 1)],
            "2.2360679774997896964091736687312762354406183596115257242708972454105209",
        ),
        (
            F::Powf,
            &[(2, 1), (1, 10)],
            "1.0717734625362931642130063250233420229063846049775567834827806681442454",
        ),
        (
            F::Powf,
            &[(1, 2), (-5, 2)],
            "5.6568542494923801952067548968387923142786875015077922927067189519629299",
        ),
    ];

    /// Functions of constants that are rational numbers.
    const EXACT: [(F, Arguments, (i64, i64)); 18] = [
        (F::Acos, &[(1, 1)], (0, 1)),
        (F::Acosh, &[(1, 1)], (0, 1)),
        (F::Exp2, &[(-3, 1)], (1, 8)),
        (F::Powf, &[(-3, 2), (3, 1)], (-27, 8)),
        (F::Powf, &[(0, 1), (1, 2)], (0, 1)),
        (F::Powf, &[(0, 1), (0, 1)], (1, 1)),
        (F::Floor, &[(-7, 2)], (-4, 1)),
        (F::Ceil, &[(-7, 2)], (-3, 1)),
        (F::Trunc, &[(-7, 2)], (-3, 1)),
        (F::Round, &[(-7, 2)], (-4, 1)),
        (F::Round, &[(5, 2)], (3, 1)),
        (F::Round, &[(4, 1)], (4, 1)),
        (F::Floor, &[(4, 1)], (4, 1)),
        (F::SignBit, &[(-7, 2)], (-1, 1)),
        (F::Less, &[(1, 1), (1, 1), (2, 1), (3, 1)], (3, 1)),
        (F::AtMost, &[(1, 1), (1, 1), (2, 1), (3, 1)], (2, 1)),
        (F::Less, &[(1, 2), (1, 1), (2, 1), (3, 1)], (2, 1)),
        (F::Sinh, &[(0, 1)], (0, 1)),
    ];

    /// Whether they agree to 60 digits.
    fn assert_digits(function: Function, argument: Rational, digits: &str) {
        assert_digits_of(function, &[argument], digits);
    }

    fn assert_digits_of(function: Function, arguments: &[Rational], digits: &str) {
        let (found, expected) = (
            value(function, arguments).expect("a value"),
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
    fn other_functions_have_sixty_digits() {
        for (function, arguments, digits) in WITH_DIGITS {
            let arguments: Vec<Rational> = arguments.iter().map(|(n, d)| ratio(*n, *d)).collect();
            assert_digits_of(function, &arguments, digits);
        }
    }

    #[test]
    fn what_is_exact_is_exact() {
        for (function, arguments, (n, d)) in EXACT {
            let arguments: Vec<Rational> = arguments.iter().map(|(n, d)| ratio(*n, *d)).collect();
            assert_eq!(
                value(function, &arguments),
                Some(ratio(n, d)),
                "{function:?}"
            );
        }
    }

    #[test]
    fn what_is_known_to_some_digits_decides_no_jump() {
        // The cube root of 27 by logarithms is 3 but for what was not worked out.
        let third = ratio(1, 3);
        let three = value(Function::Powf, &[ratio(27, 1), third]).expect("a value");
        assert_ne!(three, ratio(3, 1));
        assert_eq!(three.to_f64(), Some(3.0));
        for step in [Function::Floor, Function::Ceil, Function::Trunc] {
            assert_eq!(value(step, std::slice::from_ref(&three)), None, "{step:?}");
        }
        let compared = [three, ratio(3, 1), ratio(1, 1), ratio(2, 1)];
        for comparison in [Function::Less, Function::AtMost] {
            assert_eq!(value(comparison, &compared), None, "{comparison:?}");
        }
    }

    #[test]
    fn functions_of_constants_are_those_of_the_standard_library() {
        let one_number = Function::called().filter(|row| row.arity == 1);
        let functions: Vec<Function> = one_number.map(|row| row.function).collect();
        for step in -80..=80_i64 {
            let x = ratio(step * step * step, 3000);
            let nearest = x.to_f64().expect("a number");
            for &function in &functions {
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
        assert_eq!(value(Function::Asin, &[ratio(3, 2)]), None);
        assert_eq!(value(Function::Acosh, &[ratio(1, 2)]), None);
        assert_eq!(value(Function::Atanh, &[ratio(1, 1)]), None);
        assert_eq!(value(Function::Ln1p, &[ratio(-1, 1)]), None);
        assert_eq!(value(Function::Sinh, &[ratio(800, 1)]), None);
        let nothing = ratio(0, 1);
        assert_eq!(
            value(Function::Atan2, &[nothing.clone(), nothing.clone()]),
            None
        );
        assert_eq!(value(Function::Powf, &[nothing, ratio(-1, 2)]), None);
        assert_eq!(value(Function::Powf, &[ratio(-1, 1), ratio(1, 2)]), None);
        assert_eq!(value(Function::Powf, &[ratio(2, 1), ratio(5000, 1)]), None);
    }
}
