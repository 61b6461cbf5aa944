//! The elementary functions: what each is called, its value and its slope in `f64`, as one table.
//!
//! A new function of one or two numbers is a variant of [`Function`] and its row here, its derivative in
//! `differentiate/slopes`, its value in twice the digits in `interpret/double_double` and, where it is of constants, in
//! `factor/constants`; a method of its name in `lanes`, and its printed form in `latex`.

use std::f64::consts::{FRAC_2_SQRT_PI, LN_2, LN_10};

/// The elementary functions of the language beyond sums and products.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// Square root.
    Sqrt,
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Tangent of an angle in radians.
    Tan,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Absolute value.
    Abs,
    /// The sign bit as 1 or −1, as `f64::signum` has it.
    Sign,
    /// The side of zero: −1 below it, else 1, the derivative of the absolute value seen from the right.
    Side,
    /// The smaller of two.
    Min,
    /// The larger of two.
    Max,
    /// `Select(a, b, x, y)` is x where a = b, else y.
    Select,
    /// `MulAdd(a, b, c)` is a·b + c, rounded once.
    MulAdd,
    /// Arc sine.
    Asin,
    /// Arc cosine.
    Acos,
    /// Arc tangent.
    Atan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// Inverse hyperbolic sine.
    Asinh,
    /// Inverse hyperbolic cosine.
    Acosh,
    /// Inverse hyperbolic tangent.
    Atanh,
    /// The exponential less 1.
    ExpM1,
    /// The natural logarithm of 1 and the number.
    Ln1p,
    /// Cube root.
    Cbrt,
    /// Logarithm to the base 10.
    Log10,
    /// Logarithm to the base 2.
    Log2,
    /// The power of 2.
    Exp2,
    /// The largest whole number that is not above.
    Floor,
    /// The smallest whole number that is not below.
    Ceil,
    /// The nearest whole number, of two that are as near the one farther from 0.
    Round,
    /// The whole number towards 0.
    Trunc,
    /// The sign bit as 1 or −1, also of what is no number, as `1.0.copysign(x)` has it.
    SignBit,
    /// `Atan2(y, x)` is the angle of the point (x, y).
    Atan2,
    /// The length of a vector of two.
    Hypot,
    /// `Powf(x, y)` is x to the power of y.
    Powf,
    /// `Less(a, b, x, y)` is x where a < b, else y.
    Less,
    /// `AtMost(a, b, x, y)` is x where a ≤ b, else y.
    AtMost,
    /// `OverSquares(x, y)` is x/(x² + y²), the slope of an angle.
    OverSquares,
    /// The error function.
    Erf,
    /// 1 less the error function, with all digits where that is small.
    Erfc,
}

/// How the value of a function comes from its operands in `f64`, with the derivatives, whose signs don't matter, for bounds of
/// errors.
#[derive(Clone, Copy, Debug)]
pub enum Evaluation {
    /// A smooth function of one number.
    One(fn(f64) -> f64, fn(f64) -> f64),
    /// A smooth function of two numbers.
    Two(fn(f64, f64) -> f64, [fn(f64, f64) -> f64; 2]),
    /// A function of one number that jumps.
    Step(fn(f64) -> f64),
    /// What has rules of its own.
    Own,
}

/// What is known of a function.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The function.
    pub function: Function,
    /// The method that computes it: of packs, and but for the side of zero, the sign bit and choices of `f64` too.
    pub method: &'static str,
    /// How many operands it has.
    pub arity: usize,
    /// Whether a formula may call it by the name of its method.
    pub is_called: bool,
    /// The crate that has it, where the standard library has not.
    pub of_crate: Option<&'static str>,
    /// Its value.
    pub evaluation: Evaluation,
}

const fn row(function: Function, method: &'static str, arity: usize, own: Evaluation) -> Row {
    Row {
        function,
        method,
        arity,
        is_called: true,
        of_crate: None,
        evaluation: own,
    }
}

/// A function that no formula calls by its method.
const fn inner(function: Function, method: &'static str, arity: usize) -> Row {
    Row {
        is_called: false,
        ..row(function, method, arity, Evaluation::Own)
    }
}

/// A smooth function of one number and the size of its slope.
const fn one(
    function: Function,
    method: &'static str,
    value: fn(f64) -> f64,
    slope: fn(f64) -> f64,
) -> Row {
    row(function, method, 1, Evaluation::One(value, slope))
}

const fn two(
    function: Function,
    method: &'static str,
    value: fn(f64, f64) -> f64,
    slopes: [fn(f64, f64) -> f64; 2],
) -> Row {
    row(function, method, 2, Evaluation::Two(value, slopes))
}

const fn step(function: Function, method: &'static str, value: fn(f64) -> f64) -> Row {
    row(function, method, 1, Evaluation::Step(value))
}

/// 1/√((1 − x)(1 + x))
fn slope_of_arc(x: f64) -> f64 {
    ((1.0 - x) * (1.0 + x)).sqrt().recip()
}

/// A function that the standard library has not: formulas call it by the path of the crate that has it.
const fn of_crate(row: Row) -> Row {
    Row {
        is_called: false,
        of_crate: Some("libm"),
        ..row
    }
}

/// 2/√π·e^(−x²)
fn slope_of_erf(x: f64) -> f64 {
    FRAC_2_SQRT_PI * (-x * x).exp()
}

/// x/(x² + y²) without the squares, which leave the range of numbers where the quotient does not.
fn over_squares(x: f64, y: f64) -> f64 {
    if x.abs() < y.abs() {
        let ratio = x / y;
        ratio / (y + x * ratio)
    } else {
        let ratio = y / x;
        1.0 / (x + y * ratio)
    }
}

/// All functions, each at its place.
const TABLE: [Row; 41] = [
    row(Function::Sqrt, "sqrt", 1, Evaluation::Own),
    one(Function::Sin, "sin", f64::sin, f64::cos),
    one(Function::Cos, "cos", f64::cos, f64::sin),
    one(Function::Tan, "tan", f64::tan, |x| 1.0 + x.tan().powi(2)),
    one(Function::Exp, "exp", f64::exp, f64::exp),
    one(Function::Ln, "ln", f64::ln, f64::recip),
    row(Function::Abs, "abs", 1, Evaluation::Own),
    row(Function::Sign, "signum", 1, Evaluation::Own),
    inner(Function::Side, "side", 1),
    row(Function::Min, "min", 2, Evaluation::Own),
    row(Function::Max, "max", 2, Evaluation::Own),
    inner(Function::Select, "select_eq", 4),
    row(Function::MulAdd, "mul_add", 3, Evaluation::Own),
    one(Function::Asin, "asin", f64::asin, slope_of_arc),
    one(Function::Acos, "acos", f64::acos, slope_of_arc),
    one(Function::Atan, "atan", f64::atan, |x| (1.0 + x * x).recip()),
    one(Function::Sinh, "sinh", f64::sinh, f64::cosh),
    one(Function::Cosh, "cosh", f64::cosh, f64::sinh),
    one(Function::Tanh, "tanh", f64::tanh, |x| {
        x.cosh().powi(2).recip()
    }),
    one(Function::Asinh, "asinh", f64::asinh, |x| {
        x.hypot(1.0).recip()
    }),
    one(Function::Acosh, "acosh", f64::acosh, |x| {
        ((x - 1.0).sqrt() * (x + 1.0).sqrt()).recip()
    }),
    one(Function::Atanh, "atanh", f64::atanh, |x| {
        ((1.0 - x) * (1.0 + x)).recip()
    }),
    one(Function::ExpM1, "exp_m1", f64::exp_m1, f64::exp),
    one(Function::Ln1p, "ln_1p", f64::ln_1p, |x| (1.0 + x).recip()),
    one(Function::Cbrt, "cbrt", f64::cbrt, |x| {
        (3.0 * x.cbrt().powi(2)).recip()
    }),
    one(Function::Log10, "log10", f64::log10, |x| {
        (x * LN_10).recip()
    }),
    one(Function::Log2, "log2", f64::log2, |x| (x * LN_2).recip()),
    one(Function::Exp2, "exp2", f64::exp2, |x| x.exp2() * LN_2),
    step(Function::Floor, "floor", f64::floor),
    step(Function::Ceil, "ceil", f64::ceil),
    step(Function::Round, "round", f64::round),
    step(Function::Trunc, "trunc", f64::trunc),
    inner(Function::SignBit, "sign_bit", 1),
    two(
        Function::Atan2,
        "atan2",
        f64::atan2,
        [|y, x| over_squares(x, y), over_squares],
    ),
    two(
        Function::Hypot,
        "hypot",
        f64::hypot,
        [|x, y| x / x.hypot(y), |x, y| y / x.hypot(y)],
    ),
    two(
        Function::Powf,
        "powf",
        f64::powf,
        [|x, y| y * x.powf(y - 1.0), |x, y| x.powf(y) * x.abs().ln()],
    ),
    inner(Function::Less, "select_lt", 4),
    inner(Function::AtMost, "select_le", 4),
    Row {
        is_called: false,
        ..two(
            Function::OverSquares,
            "over_squares",
            over_squares,
            [
                |x, y| over_squares(y, x).powi(2) - over_squares(x, y).powi(2),
                |x, y| 2.0 * over_squares(x, y) * over_squares(y, x),
            ],
        )
    },
    of_crate(one(Function::Erf, "erf", libm::erf, slope_of_erf)),
    of_crate(one(Function::Erfc, "erfc", libm::erfc, slope_of_erf)),
];

impl Function {
    /// What is known of it.
    pub fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// Those that a formula may call by the name of a method.
    pub fn called() -> impl Iterator<Item = &'static Row> {
        TABLE.iter().filter(|row| row.is_called)
    }

    /// The function of that name in a crate.
    pub fn of_crate(path: [&str; 2]) -> Option<Self> {
        let mut rows = TABLE.iter();
        let [of, name] = path;
        let row = rows.find(|row| row.of_crate == Some(of) && row.method == name)?;
        Some(row.function)
    }

    /// The names of the functions that are of a crate.
    pub fn of_crate_named(of: &str) -> Vec<&'static str> {
        let rows = TABLE.iter().filter(|row| row.of_crate == Some(of));
        rows.map(|row| row.method).collect()
    }

    /// Whether it is a choice by a comparison of its first two operands.
    pub fn is_selection(self) -> bool {
        matches!(self, Self::Select | Self::Less | Self::AtMost)
    }

    /// Whether it is one of several alternatives.
    pub fn is_choice(self) -> bool {
        self.is_selection() || matches!(self, Self::Min | Self::Max)
    }

    /// Whether it jumps, and is constant in between.
    pub fn is_step(self) -> bool {
        matches!(self, Self::Sign | Self::Side | Self::SignBit)
            || matches!(self.row().evaluation, Evaluation::Step(_))
    }

    /// Whether its comparison holds, of a choice by one.
    pub fn holds<T: PartialOrd>(self, a: &T, b: &T) -> bool {
        match self {
            Self::Less => a < b,
            Self::AtMost => a <= b,
            _ => a == b,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_has_its_row() {
        for (place, row) in TABLE.iter().enumerate() {
            assert_eq!(row.function as usize, place, "{row:?}");
        }
        // No function comes after the last one.
        assert_eq!(Function::Erfc as usize + 1, TABLE.len());
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        let step = 2.0_f64.powi(-20);
        for row in &TABLE {
            match row.evaluation {
                Evaluation::One(value, slope) => {
                    let x = if row.function == Function::Acosh {
                        1.75
                    } else {
                        0.625
                    };
                    let between = (value(x + step) - value(x - step)) / (2.0 * step);
                    assert!(
                        (between.abs() - slope(x).abs()).abs() < 1e-8,
                        "{row:?}: {between}, {}",
                        slope(x)
                    );
                }
                Evaluation::Two(value, [first, second]) => {
                    let (x, y) = (0.75, 1.25);
                    let by_first = (value(x + step, y) - value(x - step, y)) / (2.0 * step);
                    let by_second = (value(x, y + step) - value(x, y - step)) / (2.0 * step);
                    assert!((by_first.abs() - first(x, y).abs()).abs() < 1e-8, "{row:?}");
                    assert!(
                        (by_second.abs() - second(x, y).abs()).abs() < 1e-8,
                        "{row:?}"
                    );
                }
                Evaluation::Step(_) | Evaluation::Own => {}
            }
        }
    }
}
