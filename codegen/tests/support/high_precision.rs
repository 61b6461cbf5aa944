//! Numbers of 77 digits with a bound of their error, for what a function is in truth.

mod functions;

use std::cell::RefCell;
use std::collections::HashMap;

use astro_float::{BigFloat, Consts, Radix, RoundingMode, Sign};

use super::size::{LARGEST, Size};
use super::tape::{Arithmetic, Binary, Comparison, Unary};

/// Binary digits.
const DIGITS: usize = 256;
const ROUNDING: RoundingMode = RoundingMode::ToEven;
/// Beyond this exponent of two no sine is taken of a number.
const LARGEST_ANGLE: f64 = 2000.0;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("the cache of constants"));
    static LITERALS: RefCell<HashMap<String, HighPrecision>> = RefCell::new(HashMap::new());
}

/// A number and how far it may be from the exact one.
#[derive(Clone, Debug)]
pub struct HighPrecision {
    value: BigFloat,
    error: Size,
}

impl HighPrecision {
    pub fn exactly(value: f64) -> Self {
        let error = if value.is_finite() {
            Size::ZERO
        } else {
            Size::UNKNOWN
        };
        let value = if value.is_finite() { value } else { 0.0 };
        Self {
            value: big(value),
            error,
        }
    }

    fn unknown() -> Self {
        Self::exactly(f64::NAN)
    }

    /// The result of an operation, rounded once, with the propagated error of its operands.
    fn after(value: BigFloat, propagated: Size) -> Self {
        let size = Size::of(&value);
        let tiny = size != Size::ZERO && size.0 < -LARGEST;
        if value.is_nan() || value.is_inf() || tiny || !size.is_known() || !propagated.is_known() {
            return Self::unknown();
        }
        let rounding = Size(size.0 - DIGITS as f64);
        let error = propagated.plus(rounding);
        Self { value, error }
    }

    fn correctly_rounded(value: impl FnOnce(&mut Consts) -> BigFloat, propagated: Size) -> Self {
        Self::after(CONSTANTS.with_borrow_mut(value), propagated)
    }

    /// Whether the error is bounded.
    pub fn is_known(&self) -> bool {
        self.error.is_known()
    }

    /// Whether the number is certain to be at least this many times its error.
    fn is_beyond_error(&self, times: f64) -> bool {
        Size::at_least(&self.value).0 - times.log2() > self.error.0
    }

    /// Whether the error is at most that.
    pub fn is_within(&self, allowed: f64) -> bool {
        let allowed = if allowed > 0.0 {
            allowed.log2()
        } else {
            f64::NEG_INFINITY
        };
        self.error.0 <= allowed
    }

    /// How far another number is away, to the nearest `f64`.
    pub fn distance(&self, other: f64) -> f64 {
        let other = big(other);
        to_f64(&other.sub(&self.value, DIGITS, ROUNDING).abs())
    }

    fn sum(&self, other: &Self) -> Self {
        let value = self.value.add(&other.value, DIGITS, ROUNDING);
        Self::after(value, self.error.plus(other.error))
    }

    fn negative(&self) -> Self {
        Self {
            value: self.value.neg(),
            error: self.error,
        }
    }

    fn product(&self, other: &Self) -> Self {
        if !self.is_known() || !other.is_known() {
            return Self::unknown();
        }
        let propagated = Size::of(&self.value)
            .times(other.error)
            .plus(Size::of(&other.value).times(self.error))
            .plus(self.error.times(other.error));
        Self::after(self.value.mul(&other.value, DIGITS, ROUNDING), propagated)
    }

    fn quotient(&self, other: &Self) -> Self {
        if !self.is_known() || !other.is_known() || !other.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let value = self.value.div(&other.value, DIGITS, ROUNDING);
        let above = self.error.plus(Size::of(&value).times(other.error));
        let divisor = Size(Size::at_least(&other.value).0 - 1.0);
        Self::after(value, above.over(divisor))
    }

    fn sqrt(&self) -> Self {
        if self.value.is_zero() && self.error == Size::ZERO {
            return self.clone();
        }
        if self.value.is_negative() || !self.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let value = self.value.sqrt(DIGITS, ROUNDING);
        let propagated = self.error.over(Size::at_least(&value));
        Self::after(value, propagated)
    }

    /// A sine, cosine or tangent.
    fn of_angle(&self, function: Unary) -> Self {
        let angle = Size::of(&self.value);
        if !self.is_known() || angle.0 > LARGEST_ANGLE {
            return Self::unknown();
        }
        let x = &self.value;
        let value = CONSTANTS.with_borrow_mut(|constants| match function {
            Unary::Sin => x.sin(DIGITS, ROUNDING, constants),
            Unary::Cos => x.cos(DIGITS, ROUNDING, constants),
            _ => x.tan(DIGITS, ROUNDING, constants),
        });
        let propagated = if function == Unary::Tan {
            let size = Size::of(&value).0.max(0.0);
            if self.error.0 + size > -20.0 {
                return Self::unknown();
            }
            self.error.times(Size(2.0 * size + 2.0))
        } else {
            self.error
        };
        Self::after(value, propagated)
    }

    fn exp(&self) -> Self {
        if !self.is_known() || self.error.0 > -1.0 || Size::of(&self.value).0 > 29.0 {
            return Self::unknown();
        }
        let value =
            CONSTANTS.with_borrow_mut(|constants| self.value.exp(DIGITS, ROUNDING, constants));
        let propagated = self.error.times(Size(Size::of(&value).0 + 1.0));
        Self::after(value, propagated)
    }

    fn ln(&self) -> Self {
        if self.value.is_negative() || self.value.is_zero() || !self.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let propagated = self.error.over(Size(Size::at_least(&self.value).0 - 1.0));
        Self::correctly_rounded(
            |constants| self.value.ln(DIGITS, ROUNDING, constants),
            propagated,
        )
    }

    fn signum(&self) -> Self {
        if self.is_beyond_error(1.0) {
            let sign = if self.value.is_negative() { -1.0 } else { 1.0 };
            return Self::exactly(sign);
        }
        Self {
            value: big(0.0),
            error: Size(0.0),
        }
    }

    /// One of two, as their difference's sign says: the first where it is negative; both where it is not certain.
    fn by_difference(u: &Self, v: &Self, first: &Self, second: &Self) -> Self {
        let difference = u.sum(&v.negative());
        if !difference.is_known() {
            return Self::unknown();
        }
        if difference.is_beyond_error(1.0) {
            let chosen = if difference.value.is_negative() {
                first
            } else {
                second
            };
            return chosen.clone();
        }
        let apart = first.sum(&second.negative());
        let apart = Size::of(&apart.value).plus(apart.error);
        Self {
            value: first.value.clone(),
            error: apart.plus(first.error).larger(second.error),
        }
    }
}

/// An `f64` in 77 digits. The library takes subnormal ones for others.
fn big(value: f64) -> BigFloat {
    const SHIFT: i32 = 200;
    if value == 0.0 || value.is_normal() {
        return BigFloat::from_f64(value, DIGITS);
    }
    let mut number = BigFloat::from_f64(value * 2.0_f64.powi(SHIFT), DIGITS);
    if let Some(exponent) = number.exponent() {
        number.set_exponent(exponent - SHIFT);
    }
    number
}

/// The nearest `f64`, or one beside it.
fn to_f64(value: &BigFloat) -> f64 {
    let Some((words, _, sign, exponent, _)) = value.as_raw_parts() else {
        return if value.is_inf_pos() {
            f64::INFINITY
        } else if value.is_inf_neg() {
            f64::NEG_INFINITY
        } else {
            f64::NAN
        };
    };
    let Some(word) = words.last().filter(|word| **word != 0) else {
        return 0.0;
    };
    let fraction = *word as f64 * 2.0_f64.powi(-64);
    let exponent = exponent.clamp(-3000, 3000);
    let half = exponent / 2;
    let size = fraction * 2.0_f64.powi(half) * 2.0_f64.powi(exponent - half);
    if sign == Sign::Neg { -size } else { size }
}

/// The exact value of decimal digits, to all digits here.
fn decimal(digits: &str) -> HighPrecision {
    let value = CONSTANTS.with_borrow_mut(|constants| {
        BigFloat::parse(digits, Radix::Dec, DIGITS, ROUNDING, constants)
    });
    let nearest: f64 = digits.parse().unwrap();
    let exact = big(nearest);
    if value.cmp(&exact) == Some(0) {
        return HighPrecision::exactly(nearest);
    }
    HighPrecision::after(value, Size::ZERO)
}

/// Whether decimal digits are exactly an `f64`.
pub fn is_exact(digits: &str) -> bool {
    HighPrecision::literal(digits).error == Size::ZERO
}

impl Arithmetic for HighPrecision {
    fn literal(digits: &str) -> Self {
        LITERALS.with_borrow_mut(|known| {
            let literal = known.entry(digits.to_owned());
            literal.or_insert_with(|| decimal(digits)).clone()
        })
    }

    fn number(value: f64) -> Self {
        Self::exactly(value)
    }

    fn constant(name: &str) -> Self {
        if name == "EPSILON" {
            return Self::exactly(f64::EPSILON);
        }
        let constant = |constants: &mut Consts| match name {
            "PI" | "FRAC_PI_2" => constants.pi(DIGITS, ROUNDING),
            "E" => constants.e(DIGITS, ROUNDING),
            "LN_2" => constants.ln_2(DIGITS, ROUNDING),
            "SQRT_2" => big(2.0).sqrt(DIGITS, ROUNDING),
            "LN_10" => constants.ln_10(DIGITS, ROUNDING),
            other => panic!("unknown constant {other}"),
        };
        let value = Self::correctly_rounded(constant, Size::ZERO);
        if name == "FRAC_PI_2" {
            return value.product(&Self::exactly(0.5));
        }
        value
    }

    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            _ if !x.is_known() => Self::unknown(),
            Unary::Negative => x.negative(),
            Unary::Sqrt => x.sqrt(),
            Unary::Sin | Unary::Cos | Unary::Tan => x.of_angle(function),
            Unary::Exp => x.exp(),
            Unary::Ln => x.ln(),
            Unary::Abs => Self {
                value: x.value.abs(),
                error: x.error,
            },
            Unary::Signum => x.signum(),
            Unary::Recip => Self::exactly(1.0).quotient(x),
            _ => Self::elementary(function, x),
        }
    }

    fn binary(operation: Binary, x: &Self, y: &Self) -> Self {
        match operation {
            Binary::Add => x.sum(y),
            Binary::Subtract => x.sum(&y.negative()),
            Binary::Multiply => x.product(y),
            Binary::Divide => x.quotient(y),
            Binary::Min => Self::by_difference(x, y, x, y),
            Binary::Max => Self::by_difference(x, y, y, x),
            _ => Self::elementary_of_two(operation, x, y),
        }
    }

    fn power(x: &Self, exponent: i32) -> Self {
        let mut square = x.clone();
        let mut power = Self::exactly(1.0);
        let mut rest = exponent.unsigned_abs();
        while rest > 0 {
            if rest % 2 == 1 {
                power = power.product(&square);
            }
            rest /= 2;
            if rest > 0 {
                square = square.product(&square);
            }
        }
        if exponent < 0 {
            Self::exactly(1.0).quotient(&power)
        } else {
            power
        }
    }

    fn mul_add(x: &Self, y: &Self, z: &Self) -> Self {
        x.product(y).sum(z)
    }

    fn select(comparison: Comparison, of: [&Self; 4]) -> Self {
        Self::selected(comparison, of)
    }

    fn beside(comparison: Comparison, of: [&Self; 4]) -> Self {
        let [a, b, ..] = of;
        if !a.sum(&b.negative()).is_beyond_error(1.0) {
            return Self::unknown();
        }
        Self::selected(comparison, of)
    }

    fn chosen(larger: bool, [u, v, x, y]: [&Self; 4]) -> Self {
        if larger {
            Self::by_difference(u, v, y, x)
        } else {
            Self::by_difference(u, v, x, y)
        }
    }
}

impl std::fmt::Display for HighPrecision {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if !self.is_known() {
            return f.write_str("unknown");
        }
        let error = self.error.as_number();
        let text = CONSTANTS.with_borrow_mut(|constants| {
            let value = self.value.format(Radix::Dec, ROUNDING, constants);
            let error = error.format(Radix::Dec, ROUNDING, constants);
            (value.unwrap_or_default(), error.unwrap_or_default())
        });
        let exponent = |text: &str| text.find('e').map_or("", |at| &text[at..]).to_owned();
        let digits = |text: &str, most: usize| -> String {
            let digits = text.chars().take_while(|digit| *digit != 'e');
            digits.take(most).collect()
        };
        write!(
            f,
            "{}{} ± {}{}",
            digits(&text.0, 24),
            exponent(&text.0),
            digits(&text.1, 4),
            exponent(&text.1)
        )
    }
}
