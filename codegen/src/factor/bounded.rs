//! Numbers with a running bound of their rounding error, in units of 2¹⁰ last places of 1.
//!
//! Sums, products and quotients choose between results and never branch, and are inlined where they are called, so that the
//! compiler computes those of a [`Pack`] together.

mod pack;

use crate::graph::{Evaluation, Function, NamedConstant, Rational, Table};
use crate::interpret::double_double::stand_in;
use crate::interpret::{Number, constant_value};
pub use pack::Pack;

/// A value with a bound of its error in [`UNIT`]s. An infinite value without an error is infinity itself,
/// and NaN without one is surely no number; an infinite value with an infinite error is larger than any number. Where the error
/// is NaN, nothing is known of the number.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    /// The value, as `f64` arithmetic gives it.
    pub value: f64,
    /// The bound.
    pub error: f64,
}

/// The unit of errors, 2¹⁰ last places of 1: so errors of the largest numbers and of the smallest are numbers, too.
pub const UNIT: f64 = 1024.0 * f64::EPSILON;

/// The last place of 1 in that unit.
pub const LAST_PLACE: f64 = f64::EPSILON / UNIT;

/// What a number smaller than any normal one is off by, in that unit: one of its own last places.
const UNDERFLOW: f64 = f64::MIN_POSITIVE * LAST_PLACE;

impl Bounded {
    /// A number without an error.
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A result that is rounded to the nearest number.
    fn rounded(value: f64, inherited: f64) -> Self {
        Self {
            value,
            error: inherited + LAST_PLACE * value.abs(),
        }
    }

    /// The result of an operation on numbers, of which some may be infinity or NaN themselves.
    #[inline(always)]
    fn after(value: f64, inherited: f64, operands: &[Self]) -> Self {
        let any = |is: fn(&Self) -> bool| operands.iter().fold(false, |any, one| any | is(one));
        let is_unknown = any(|operand| operand.error.is_nan());
        let is_itself = any(|operand| !operand.value.is_finite() & (operand.error == 0.0));
        let beyond = pick(is_itself, 0.0, f64::INFINITY);
        let error = pick(
            value.is_finite(),
            inherited + LAST_PLACE * value.abs(),
            pick(is_unknown, f64::NAN, beyond),
        );
        Self { value, error }
    }

    /// A result of which nothing is known but what `f64` arithmetic makes of it.
    fn unknown(value: f64) -> Self {
        Self {
            value,
            error: f64::NAN,
        }
    }

    /// A product or quotient of numbers other than 0, which loses digits or all of them below the smallest normal number.
    #[inline(always)]
    fn scaled(value: f64, inherited: f64, operands: &[Self]) -> Self {
        let after = Self::after(value, inherited, operands);
        let lost = pick(value.abs() < f64::MIN_POSITIVE, UNDERFLOW, 0.0);
        Self {
            value,
            error: after.error + lost,
        }
    }

    /// Whether its error is so large that it may be 0, or of the other sign.
    #[inline(always)]
    fn is_lost(self) -> bool {
        self.value.is_finite() & (self.error * UNIT >= 0.5 * self.value.abs()) & (self.error > 0.0)
    }

    #[inline(always)]
    fn is_unit(self) -> bool {
        (self.error == 0.0) & (self.value.abs() == 1.0)
    }

    /// Whether it has digits to lose.
    pub fn has_digits(self) -> bool {
        if self.value == 0.0 {
            return self.error == 0.0;
        }
        self.value.is_finite() && self.error * UNIT <= 1e-3 * self.value.abs()
    }
}

/// One of two numbers that are both known.
#[inline(always)]
fn pick(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

/// A share of an error that is none where there is no error, also of an infinite factor.
#[inline(always)]
fn share(factor: f64, error: f64) -> f64 {
    let share = factor * error;
    // A share that is too small for a number is some all the same.
    let some = pick(share == 0.0, UNDERFLOW, share);
    pick((error == 0.0) | (factor == 0.0), 0.0, some)
}

/// What a product inherits, the product of both errors included: where digits cancelled it is the larger part.
#[inline(always)]
fn of_product(x: Bounded, y: Bounded) -> f64 {
    let second_order = share(x.error, y.error) * UNIT;
    share(x.value.abs(), y.error) + share(y.value.abs(), x.error) + second_order
}

/// What a smooth function inherits of an operand's error, from its slope. Beyond the first order: where the argument may be
/// anything, so may the value.
fn of_slope(function: Function, slope: f64, operand: Bounded) -> f64 {
    // Waves and exponentials bend as fast everywhere, the others slower the larger the argument is.
    let scale = match function {
        Function::Sin | Function::Cos | Function::Tan => 1.0,
        Function::Exp | Function::Exp2 | Function::ExpM1 => 1.0,
        Function::Sinh | Function::Cosh | Function::Tanh | Function::Powf => 1.0,
        _ => operand.value.abs().max(1.0),
    };
    let curved = 1.0 + operand.error / scale * UNIT;
    share(slope.abs() * curved, operand.error)
}

/// A function that jumps, at a number that is known well enough to say between which steps it is.
fn of_step(value: fn(f64) -> f64, x: Bounded) -> Bounded {
    let apart = x.error * UNIT;
    let [low, high] = [x.value - apart, x.value + apart].map(value);
    if low == high || x.error == 0.0 {
        Bounded::exact(value(x.value))
    } else {
        Bounded::unknown(value(x.value))
    }
}

/// The one of two that a comparison chooses; where rounding decides that, the number may be the other.
fn of_comparison(function: Function, [a, b, x, y]: [Bounded; 4]) -> Bounded {
    let (chosen, other) = if function.holds(&a.value, &b.value) {
        (x, y)
    } else {
        (y, x)
    };
    let error = a.error + b.error;
    if error.is_nan() {
        return Bounded::unknown(chosen.value);
    }
    // What is larger than any number is larger than those that are known.
    let is_beyond =
        |x: Bounded, y: Bounded| x.value.is_infinite() && y.error.is_finite() && x.value != y.value;
    if is_beyond(a, b) || is_beyond(b, a) {
        return chosen;
    }
    let is_open = error > 0.0 && (a.value - b.value).abs() <= error * UNIT;
    if !is_open {
        return chosen;
    }
    let apart = (chosen.value - other.value).abs() / UNIT;
    Bounded {
        value: chosen.value,
        error: chosen.error.max(other.error) + apart,
    }
}

/// Whether a function's value is exact: at 0, 1 and infinity, where it is 0 or 1 itself.
fn is_exact(x: Bounded, value: f64) -> bool {
    let is_one_of = |number: f64, known: [f64; 3]| known.contains(&number);
    x.error == 0.0
        && is_one_of(x.value.abs(), [0.0, 1.0, f64::INFINITY])
        && is_one_of(value, [0.0, 1.0, -1.0])
}

/// A function that has a row with its slope.
fn elementary(function: Function, operands: &[Bounded]) -> Bounded {
    match (function.row().evaluation, operands) {
        (Evaluation::One(value, _), [x]) if is_exact(*x, value(x.value)) => {
            Bounded::exact(value(x.value))
        }
        (Evaluation::One(value, slope), [x]) => {
            let inherited = of_slope(function, slope(x.value), *x);
            Bounded::after(value(x.value), inherited, operands)
        }
        (Evaluation::Two(value, slopes), [x, y]) => {
            let [first, second] = slopes.map(|slope| slope(x.value, y.value));
            let inherited = of_slope(function, first, *x) + of_slope(function, second, *y);
            Bounded::after(value(x.value, y.value), inherited, operands)
        }
        (Evaluation::Step(value), [x]) => of_step(value, *x),
        _ => Bounded::exact(f64::NAN),
    }
}

impl Number for Bounded {
    fn rational(value: &Rational) -> Self {
        let nearest = value.to_f64().unwrap_or(f64::NAN);
        if value.is_f64() {
            return Self::exact(nearest);
        }
        let mut rounded = Self::after(nearest, 0.0, &[]);
        if nearest.abs() < f64::MIN_POSITIVE {
            rounded.error += UNDERFLOW;
        }
        rounded
    }

    fn constant(constant: NamedConstant) -> Self {
        Self::rounded(constant_value(constant), 0.0)
    }

    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        let inherited = self.error + other.error;
        Self::after(self.value + other.value, inherited, &[*self, *other])
    }

    #[inline(always)]
    fn multiply(&self, other: &Self) -> Self {
        let operands = [*self, *other];
        let inherited = of_product(*self, *other);
        let value = self.value * other.value;
        let is_exact = value.is_finite() & (self.is_unit() | other.is_unit());
        let is_zero = (self.value == 0.0) | (other.value == 0.0);
        let of_zero = Self::after(value, inherited, &operands).error;
        let scaled = Self::scaled(value, inherited, &operands).error;
        Self {
            value,
            error: pick(is_exact, inherited, pick(is_zero, of_zero, scaled)),
        }
    }

    #[inline(always)]
    fn divide(&self, other: &Self) -> Self {
        let operands = [*self, *other];
        let value = self.value / other.value;
        let inherited = (self.error + share(value.abs(), other.error)) / other.value.abs();
        let is_exact = value.is_finite() & other.is_unit();
        let of_zero = Self::after(value, inherited, &operands).error;
        let scaled = Self::scaled(value, inherited, &operands).error;
        let rounded = pick(self.value == 0.0, of_zero, scaled);
        // By infinity itself it is 0; by what is larger than any number, at most a share of the largest.
        let size = self.value.abs() / f64::MAX / UNIT + UNDERFLOW;
        let by_infinity = pick(other.error == 0.0, 0.0, size);
        let is_by_infinity = other.value.is_infinite() & (value == 0.0);
        let known = pick(
            is_by_infinity,
            by_infinity,
            pick(is_exact, inherited, rounded),
        );
        let is_unknown = other.is_lost() | other.error.is_nan();
        Self {
            value,
            error: pick(is_unknown, f64::NAN, known),
        }
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        match (function, operands) {
            (Function::Abs, [x]) => Self {
                value: x.value.abs(),
                error: x.error,
            },
            (Function::Sqrt, [x]) if x.error == 0.0 => Self::after(x.value.sqrt(), 0.0, operands),
            (Function::Sqrt, [x]) => {
                let root = x.value.sqrt();
                // The root of the error itself is the most that it may be off by, near 0.
                let most = (x.error / UNIT).sqrt();
                Self::after(root, (x.error / root).min(most), operands)
            }
            (Function::Sign | Function::Side, [x]) => Self::exact(f64::apply(function, &[x.value])),
            (Function::Min | Function::Max, [x, y]) => {
                let value = f64::apply(function, &[x.value, y.value]);
                *if value == x.value || value.is_nan() {
                    x
                } else {
                    y
                }
            }
            (Function::Select, [a, b, x, y]) => *if a.value == b.value { x } else { y },
            (Function::Less | Function::AtMost, [a, b, x, y]) => {
                of_comparison(function, [*a, *b, *x, *y])
            }
            (Function::SignBit, [x]) => Self::exact(f64::apply(function, &[x.value])),
            (Function::MulAdd, [a, b, c]) => {
                let inherited = of_product(*a, *b);
                let value = a.value.mul_add(b.value, c.value);
                Self::scaled(value, inherited + c.error, operands)
            }
            (Function::Ln | Function::Log10 | Function::Log2, [x]) if x.is_lost() => {
                Self::unknown(f64::apply(function, &[x.value]))
            }
            _ => elementary(function, operands),
        }
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        stand_in(table, order, argument)
    }
}
