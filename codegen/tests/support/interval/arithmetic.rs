//! Intervals as a kind of number.

use std::cell::RefCell;
use std::collections::HashMap;

use super::{Interval, Knowledge};
use crate::support::high_precision::is_exact;
use crate::support::tape::{Arithmetic, Binary, Comparison, Unary, constant_value, is_first};

thread_local! {
    /// The nearest `f64` to a literal, and whether it is exact.
    static LITERALS: RefCell<HashMap<String, (f64, bool)>> = RefCell::new(HashMap::new());
}

impl<const ROUGH: bool> Arithmetic for Interval<ROUGH> {
    fn literal(digits: &str) -> Self {
        let (value, exact) = LITERALS.with_borrow_mut(|known| {
            let literal = known.entry(digits.to_owned());
            *literal.or_insert_with(|| (digits.parse().unwrap(), is_exact(digits)))
        });
        if exact {
            Self::exactly(value)
        } else {
            Self::between(value, value.next_down(), value.next_up())
        }
    }

    fn number(value: f64) -> Self {
        Self::exactly(value)
    }

    fn constant(name: &str) -> Self {
        let value = constant_value(name);
        if name == "EPSILON" {
            return Self::exactly(value);
        }
        Self::between(value, value.next_down(), value.next_up())
    }

    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            Unary::Negative => x.negative(),
            Unary::Sqrt => x.sqrt(),
            Unary::Sin => x.wave(x.value.sin()),
            Unary::Cos => x.wave(x.value.cos()),
            Unary::Tan => x.tan(),
            Unary::Exp => x.exp(),
            Unary::Ln => x.ln(),
            Unary::Abs => x.size(),
            Unary::Signum => x.signum(),
            Unary::Recip => Self::exactly(1.0).quotient(*x),
            Unary::Floor => x.stepped(f64::floor),
            Unary::Ceil => x.stepped(f64::ceil),
            Unary::Round => x.stepped(f64::round),
            Unary::Trunc => x.stepped(f64::trunc),
            Unary::Asin => x.monotonic(function, f64::asin),
            Unary::Acos => x.monotonic(function, f64::acos),
            Unary::Atan => x.monotonic(function, f64::atan),
            Unary::Sinh => x.monotonic(function, f64::sinh),
            Unary::Cosh => x.monotonic(function, f64::cosh),
            Unary::Tanh => x.monotonic(function, f64::tanh),
            Unary::Asinh => x.monotonic(function, f64::asinh),
            Unary::Acosh => x.monotonic(function, f64::acosh),
            Unary::Atanh => x.monotonic(function, f64::atanh),
            Unary::ExpM1 => x.monotonic(function, f64::exp_m1),
            Unary::Ln1p => x.monotonic(function, f64::ln_1p),
            Unary::Cbrt => x.monotonic(function, f64::cbrt),
            Unary::Log10 => x.monotonic(function, f64::log10),
            Unary::Log2 => x.monotonic(function, f64::log2),
            Unary::Exp2 => x.monotonic(function, f64::exp2),
        }
    }

    fn binary(operation: Binary, x: &Self, y: &Self) -> Self {
        match operation {
            Binary::Add => x.sum(*y),
            Binary::Subtract => x.sum(y.negative()),
            Binary::Multiply => x.product(*y),
            Binary::Divide => x.quotient(*y),
            Binary::Min => Self::extreme(false, *x, *y),
            Binary::Max => Self::extreme(true, *x, *y),
            _ => Self::of_two(operation, *x, *y),
        }
    }

    fn power(x: &Self, exponent: i32) -> Self {
        x.whole_power(exponent)
    }

    fn mul_add(x: &Self, y: &Self, z: &Self) -> Self {
        let value = x.value.mul_add(y.value, z.value);
        let bounds = x.product(*y).sum(*z);
        if !bounds.is_bounded() {
            return Self { value, ..bounds };
        }
        Self::between(value, bounds.low, bounds.high)
    }

    fn select(comparison: Comparison, of: [&Self; 4]) -> Self {
        Self::selected(comparison, of.map(|one| *one))
    }

    fn beside(comparison: Comparison, [a, b, x, y]: [&Self; 4]) -> Self {
        if a.is_bounded() && b.is_bounded() && a.low <= b.high && b.low <= a.high {
            return x.hull(*y, x.value);
        }
        Self::select(comparison, [a, b, x, y])
    }

    fn chosen(larger: bool, [u, v, x, y]: [&Self; 4]) -> Self {
        let (first, value) = if is_first(larger, u.value, v.value) {
            (x, x.value)
        } else {
            (y, y.value)
        };
        match (u.knowledge, v.knowledge) {
            // Of two that are no numbers the derivative may be that of either.
            (Knowledge::NoNumber, Knowledge::NoNumber) => Self::unknown(value),
            (Knowledge::NoNumber, _) => *y,
            (_, Knowledge::NoNumber) => *x,
            (Knowledge::Bounded, Knowledge::Bounded) if u.high < v.low || v.high < u.low => *first,
            (Knowledge::Bounded, Knowledge::Bounded) => x.hull(*y, value),
            _ => Self::unknown(value),
        }
    }
}
