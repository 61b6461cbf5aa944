//! Numbers with a bound of their rounding error, carried along to first order: what makes a comparison of two ways to
//! compute one number exact about how far apart they may be.

use codegen::graph::{Function, NamedConstant, Rational, Table};
use codegen::interpret::{Number, constant_value};

/// Half a unit in the last place, relative; doubled for functions that the standard library rounds less well.
const UNIT: f64 = f64::EPSILON;
/// Beyond this size, or below its inverse, an operation may overflow or lose digits where another order of the same
/// operations does not: nothing is said about the result.
const LARGEST: f64 = 1e60;
/// A relative error beyond this is no longer of first order.
const COARSE: f64 = 1e-2;

/// A number and how far it may be from the exact one.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    pub value: f64,
    pub error: f64,
}

impl Bounded {
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A constant that was rounded once.
    pub fn rounded(value: f64) -> Self {
        Self::after(value, 0.0)
    }

    /// The result of an operation with the propagated error of its operands.
    fn after(value: f64, propagated: f64) -> Self {
        let size = value.abs();
        let error = if size > LARGEST || (size > 0.0 && size < 1.0 / LARGEST) {
            f64::INFINITY
        } else {
            propagated + UNIT * size
        };
        Self { value, error }
    }

    fn unknown(value: f64) -> Self {
        Self {
            value,
            error: f64::INFINITY,
        }
    }

    /// Whether the bound is small beside the number, so that first order is enough.
    fn is_fine(self) -> bool {
        self.error <= COARSE * self.value.abs()
    }

    /// Whether value and bound are finite.
    pub fn is_known(self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }

    /// Whether two results can stand for the same exact number.
    pub fn agrees(self, other: Self) -> bool {
        (self.value - other.value).abs() <= self.error + other.error
    }

    pub fn negative(self) -> Self {
        Self {
            value: -self.value,
            error: self.error,
        }
    }

    pub fn plus(self, other: Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }

    pub fn minus(self, other: Self) -> Self {
        self.plus(other.negative())
    }

    pub fn times(self, other: Self) -> Self {
        let propagated = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        // 0·∞ is no number: an unknown operand leaves the product unknown.
        let propagated = if propagated.is_nan() {
            f64::INFINITY
        } else {
            propagated
        };
        Self::after(self.value * other.value, propagated)
    }

    pub fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        if !other.is_fine() || !self.error.is_finite() {
            return Self::unknown(value);
        }
        let divisor = other.value.abs() - other.error;
        Self::after(value, (self.error + value.abs() * other.error) / divisor)
    }

    pub fn power(self, exponent: i32) -> Self {
        let mut product = Self::exact(1.0);
        for _ in 0..exponent.unsigned_abs() {
            product = product.times(self);
        }
        if exponent < 0 {
            Self::exact(1.0).over(product)
        } else {
            product
        }
    }

    /// One where a comparison holds, else the other: generated code compares an extreme with what it may be, so that it is one
    /// of them.
    pub fn choose(holds: bool, first: Self, second: Self) -> Self {
        if holds { first } else { second }
    }

    /// An elementary function by its name as a method of `f64`.
    pub fn method(name: &str, operands: &[Self]) -> Option<Self> {
        Some(match (name, operands) {
            ("sqrt", [x]) if x.value == 0.0 && x.error == 0.0 => Self::exact(0.0),
            ("sqrt", [x]) if !x.is_fine() => Self::unknown(x.value.sqrt()),
            ("sqrt", [x]) => Self::after(x.value.sqrt(), x.error / x.value.sqrt()),
            ("sin", [x]) => Self::after(x.value.sin(), x.error + UNIT),
            ("cos", [x]) => Self::after(x.value.cos(), x.error + UNIT),
            ("tan", [x]) => {
                let slope = 1.0 + x.value.tan().powi(2);
                if x.error * slope > COARSE {
                    Self::unknown(x.value.tan())
                } else {
                    Self::after(x.value.tan(), 1.1 * slope * x.error)
                }
            }
            ("exp", [x]) if x.error > COARSE => Self::unknown(x.value.exp()),
            ("exp", [x]) => Self::after(x.value.exp(), x.value.exp() * (1.1 * x.error + UNIT)),
            ("ln", [x]) if !x.is_fine() => Self::unknown(x.value.ln()),
            ("ln", [x]) => Self::after(x.value.ln(), 1.1 * x.error / x.value.abs() + UNIT),
            ("abs", [x]) => Self {
                value: x.value.abs(),
                error: x.error,
            },
            ("recip", [x]) => Self::exact(1.0).over(*x),
            ("signum", [x]) if x.value.abs() > x.error => Self::exact(x.value.signum()),
            ("signum", [x]) => Self::unknown(x.value.signum()),
            ("mul_add", [x, y, z]) => Self {
                value: x.value.mul_add(y.value, z.value),
                ..x.times(*y).plus(*z)
            },
            ("copysign", [x, y]) => Self::exact(x.value.copysign(y.value)),
            ("min", [x, y]) => Self {
                value: x.value.min(y.value),
                error: x.error.max(y.error),
            },
            ("max", [x, y]) => Self {
                value: x.value.max(y.value),
                error: x.error.max(y.error),
            },
            // Of others the value is known, and no bound.
            _ => {
                let row = Function::called().find(|row| row.method == name)?;
                let values: Vec<f64> = operands.iter().map(|operand| operand.value).collect();
                Self::unknown(f64::apply(row.function, &values))
            }
        })
    }
}

impl Number for Bounded {
    fn rational(value: &Rational) -> Self {
        Self::rounded(f64::rational(value))
    }

    fn constant(constant: NamedConstant) -> Self {
        Self::rounded(constant_value(constant))
    }

    fn add(&self, other: &Self) -> Self {
        self.plus(*other)
    }

    fn multiply(&self, other: &Self) -> Self {
        self.times(*other)
    }

    fn divide(&self, other: &Self) -> Self {
        self.over(*other)
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        let name = match (function, operands) {
            (Function::Select | Function::Less | Function::AtMost, [a, b, x, y]) => {
                return Self::choose(function.holds(&a.value, &b.value), *x, *y);
            }
            (Function::Side | Function::SignBit, [x]) => {
                return Self::exact(f64::apply(function, &[x.value]));
            }
            _ => function.row().method,
        };
        Self::method(name, operands).unwrap_or(Self::unknown(f64::NAN))
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        Self::rounded(f64::tabulated(table, order, &argument.value))
    }
}
