//! Numbers of unlimited range, of which only the size is known: they say where in a formula a number leaves the range of
//! `f64`, and how far beyond it.

use std::f64::consts::LN_2;

use crate::graph::{Function, NamedConstant, Rational, Table};
use crate::interpret::double_double::stand_in;
use crate::interpret::{Number, constant_value};

/// A number by its sign and the logarithm of its size.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// 1 or −1; NaN of what is no number.
    sign: f64,
    /// The logarithm to the base 2; −∞ of zero.
    pub(super) log: f64,
}

/// Sizes farther apart than this, in powers of two, add up to the larger one.
const FAR_APART: f64 = 60.0;

impl Size {
    pub(super) fn of(value: f64) -> Self {
        Self {
            sign: 1.0_f64.copysign(value),
            log: value.abs().log2(),
        }
    }

    /// A number times a power of two.
    pub(super) fn moved(value: f64, power: f64) -> Self {
        let size = Self::of(value);
        Self {
            log: size.log + power,
            ..size
        }
    }

    /// The nearest `f64`: infinite or 0 beyond its range.
    fn value(self) -> f64 {
        self.sign * self.log.exp2()
    }

    /// A power that is a number itself.
    fn power(self, exponent: f64) -> Self {
        Self {
            sign: self.sign,
            log: self.log * exponent,
        }
    }

    /// A power of 2, for the exponential functions.
    fn power_of_two(exponent: f64) -> Self {
        Self {
            sign: 1.0,
            log: exponent,
        }
    }

    /// Whether it is below another.
    fn is_below(self, other: Self) -> bool {
        if self.sign != other.sign {
            return self.sign < other.sign;
        }
        (self.log < other.log) == (self.sign > 0.0) && self.log != other.log
    }
}

/// The logarithm of a constant's size, to a whole number where the constant is beyond the range of `f64`.
fn log_of(value: &Rational) -> f64 {
    match value.to_f64() {
        Some(nearest) if nearest.is_normal() => nearest.abs().log2(),
        _ if value.is_zero() => f64::NEG_INFINITY,
        _ => value.numerator().bits() as f64 - value.denominator().bits() as f64,
    }
}

impl Number for Size {
    fn rational(value: &Rational) -> Self {
        Self {
            sign: if value.is_negative() { -1.0 } else { 1.0 },
            log: log_of(value),
        }
    }

    fn constant(constant: NamedConstant) -> Self {
        Self::of(constant_value(constant))
    }

    fn add(&self, other: &Self) -> Self {
        let (larger, smaller) = if self.log < other.log {
            (other, self)
        } else {
            (self, other)
        };
        let apart = larger.log - smaller.log;
        if apart.is_nan() || apart > FAR_APART {
            return *larger;
        }
        let share = (-apart).exp2() * larger.sign * smaller.sign;
        Self {
            sign: larger.sign,
            log: larger.log + (1.0 + share).log2(),
        }
    }

    fn multiply(&self, other: &Self) -> Self {
        Self {
            sign: self.sign * other.sign,
            log: self.log + other.log,
        }
    }

    fn divide(&self, other: &Self) -> Self {
        Self {
            sign: self.sign * other.sign,
            log: self.log - other.log,
        }
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        match (function, operands) {
            (Function::Sqrt, [x]) => x.power(0.5),
            (Function::Cbrt, [x]) => x.power(1.0 / 3.0),
            (Function::Abs, [x]) => Self { sign: 1.0, ..*x },
            (Function::Exp | Function::ExpM1, [x]) if x.value().abs() > FAR_APART => {
                Self::power_of_two(x.value() / LN_2)
            }
            (Function::Sinh | Function::Cosh, [x]) if x.value().abs() > FAR_APART => Self {
                sign: if function == Function::Sinh {
                    x.sign
                } else {
                    1.0
                },
                log: x.value().abs() / LN_2 - 1.0,
            },
            (Function::Exp2, [x]) => Self::power_of_two(x.value()),
            (Function::Ln, [x]) => Self::of(x.log * LN_2),
            (Function::Log2, [x]) => Self::of(x.log),
            (Function::Powf, [x, y]) => Self::power_of_two(x.log * y.value()),
            (Function::Hypot, [x, y]) => x.multiply(x).add(&y.multiply(y)).power(0.5),
            (Function::OverSquares, [x, y]) => x.divide(&x.multiply(x).add(&y.multiply(y))),
            (Function::MulAdd, [a, b, c]) => a.multiply(b).add(c),
            (Function::Min, [x, y]) => *if y.is_below(*x) { y } else { x },
            (Function::Max, [x, y]) => *if x.is_below(*y) { y } else { x },
            (Function::Less, [a, b, x, y]) => *if a.is_below(*b) { x } else { y },
            (Function::AtMost, [a, b, x, y]) => *if b.is_below(*a) { y } else { x },
            (Function::Select, [a, b, x, y]) => {
                let is_equal = a.sign == b.sign && a.log == b.log;
                *if is_equal { x } else { y }
            }
            _ => {
                let operands: Vec<f64> = operands.iter().map(|operand| operand.value()).collect();
                Self::of(f64::apply(function, &operands))
            }
        }
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        stand_in(table, order, argument)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_go_beyond_the_range_of_numbers() {
        let far = Size::of(-1e300);
        let square = far.multiply(&far);
        assert!((square.log - 600.0 * 10.0_f64.log2()).abs() < 1e-9 && square.sign == 1.0);
        assert!((square.divide(&far).value() / -1e300 - 1.0).abs() < 1e-12);
        assert!((Size::apply(Function::Sqrt, &[square]).value() / 1e300 - 1.0).abs() < 1e-12);
        let exponential = Size::apply(Function::Exp, &[Size::of(-1e4)]);
        assert!((exponential.log + 1e4 / LN_2).abs() < 1e-9);
    }

    #[test]
    fn sums_and_choices_are_those_of_the_numbers() {
        let numbers = [-3.0, -0.5, 0.0, 0.25, 2.0, 1e30];
        for a in numbers {
            for b in numbers {
                let (x, y) = (Size::of(a), Size::of(b));
                let near =
                    |found: Size, value: f64| (found.value() - value).abs() <= 1e-12 * value.abs();
                assert!(near(x.add(&y), a + b), "{a} + {b}");
                assert!(
                    near(Size::apply(Function::Min, &[x, y]), a.min(b)),
                    "{a}, {b}"
                );
                let less = Size::apply(Function::Less, &[x, y, Size::of(1.0), Size::of(2.0)]);
                assert!(near(less, if a < b { 1.0 } else { 2.0 }), "{a} < {b}");
            }
        }
    }
}
