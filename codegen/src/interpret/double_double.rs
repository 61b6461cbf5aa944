//! Numbers of twice the digits of `f64`, each the sum of two: what the rounding errors of a formula are measured with.
//!
//! Sums and products are exact to 2⁻¹⁰⁴ (Dekker 1971, Knuth), elementary functions to some units of 2⁻¹⁰⁰. The range is that of
//! `f64`, so that this is for numbers of everyday sizes.

mod error_function;
mod functions;

use super::{Number, constant_value};
use crate::graph::{Function, NamedConstant, Rational, Table, whole};

/// A number as the sum of two, of which the second is at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    /// The nearest `f64`.
    pub high: f64,
    /// What is left.
    pub low: f64,
}

/// π/2 and ln 2 in three parts, so that whole multiples of them are subtracted without loss.
const HALF_PI: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];
const LN_2: [f64; 3] = [
    std::f64::consts::LN_2,
    2.319_046_813_846_299_6e-17,
    5.707_708_438_416_212e-34,
];

/// Angles beyond this lose digits when whole turns are taken from them.
const LARGEST_ANGLE: f64 = 1e8;

/// Arguments are divided by this power of two before a series is taken of them, which then needs [`TERMS`] terms.
const HALVINGS: i32 = 8;
const TERMS: u32 = 12;

impl DoubleDouble {
    /// The number that an `f64` is.
    pub fn exact(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }

    /// The exact sum of two numbers.
    fn of_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        let low = (a - (high - of_b)) + (b - of_b);
        Self { high, low }.or_infinite()
    }

    /// The exact product of two numbers.
    fn of_product(a: f64, b: f64) -> Self {
        let high = a * b;
        let low = a.mul_add(b, -high);
        Self { high, low }.or_infinite()
    }

    /// What is infinite has no rest.
    fn or_infinite(self) -> Self {
        if self.high.is_finite() {
            self
        } else {
            Self::exact(self.high)
        }
    }

    fn plus(self, other: Self) -> Self {
        let high = Self::of_sum(self.high, other.high);
        let low = Self::of_sum(self.low, other.low);
        let sum = Self::of_sum(high.high, high.low + low.high);
        Self::of_sum(sum.high, sum.low + low.low)
    }

    fn minus(self, other: Self) -> Self {
        self.plus(-other)
    }

    fn times(self, other: Self) -> Self {
        let product = Self::of_product(self.high, other.high);
        let low = self.high * other.low + self.low * other.high;
        if product.high.is_finite() {
            Self::of_sum(product.high, product.low + low)
        } else {
            product
        }
    }

    fn over(self, other: Self) -> Self {
        let first = self.high / other.high;
        if !first.is_finite() || other.high.is_infinite() {
            return Self::exact(first);
        }
        let rest = self.minus(other.times(Self::exact(first)));
        let second = rest.high / other.high;
        let rest = rest.minus(other.times(Self::exact(second)));
        let third = rest.high / other.high;
        Self::of_sum(first, second).plus(Self::exact(third))
    }

    fn scaled(self, factor: f64) -> Self {
        Self {
            high: self.high * factor,
            low: self.low * factor,
        }
        .or_infinite()
    }

    fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return Self::exact(root);
        }
        // One step of Newton's method doubles the digits.
        let rest = self.minus(Self::of_product(root, root));
        Self::of_sum(root, rest.high / (2.0 * root))
    }

    /// The rest after whole multiples of a constant in three parts, and how many there are.
    fn without_multiples(self, constant: &[f64; 3]) -> (Self, f64) {
        let count = (self.high / constant[0]).round_ties_even();
        let rest = constant.iter().fold(self, |rest, part| {
            rest.minus(Self::of_product(count, *part))
        });
        (rest, count)
    }

    fn exp(self) -> Self {
        // The nearest f64 is as good where the result is none of everyday.
        if self.high.is_nan() || self.high.abs() > 700.0 {
            return Self::exact(self.high.exp());
        }
        let (rest, count) = self.without_multiples(&LN_2);
        let exponential = Self::exact(1.0).plus(rest.exponential_less_one());
        exponential.scaled(2.0_f64.powi(count as i32))
    }

    /// eˣ − 1 of a small number by its series, so that the squarings lose nothing.
    fn exponential_less_one(self) -> Self {
        let small = self.scaled(0.5_f64.powi(HALVINGS));
        let mut less_one = Self::exact(0.0);
        for term in (1..=TERMS).rev() {
            let inner = Self::exact(1.0).plus(less_one);
            less_one = inner.times(small).over(Self::exact(f64::from(term)));
        }
        for _ in 0..HALVINGS {
            less_one = less_one.scaled(2.0).plus(less_one.times(less_one));
        }
        less_one
    }

    fn ln(self) -> Self {
        let nearest = self.high.ln();
        if !nearest.is_finite() {
            return Self::exact(nearest);
        }
        // One step of Newton's method on the exponential: y + x·e^(−y) − 1.
        let guess = Self::exact(nearest);
        let quotient = self.times((-guess).exp());
        guess.plus(quotient.minus(Self::exact(1.0)))
    }

    /// Sine and cosine.
    fn circular(self) -> (Self, Self) {
        if self.high.is_nan() || self.high.abs() > LARGEST_ANGLE {
            let nothing = Self::exact(f64::NAN);
            return (nothing, nothing);
        }
        let (rest, quarters) = self.without_multiples(&HALF_PI);
        let small = rest.scaled(0.5_f64.powi(HALVINGS));
        let square = small.times(small);
        // By their series; the cosine as what it is below 1, so that doubling the angle loses nothing.
        let (mut sine, mut below_one) = (Self::exact(1.0), Self::exact(1.0));
        for term in (1..=TERMS / 2).rev() {
            let of = |below: f64| Self::exact(-below).times(Self::exact(below + 1.0));
            let [even, odd] = [2.0 * f64::from(term), 2.0 * f64::from(term) + 1.0];
            sine = Self::exact(1.0).plus(square.times(sine).over(of(even)));
            below_one = Self::exact(1.0).plus(square.times(below_one).over(of(odd)));
        }
        sine = sine.times(small);
        below_one = square.times(below_one).scaled(0.5);
        for _ in 0..HALVINGS {
            let cosine = Self::exact(1.0).minus(below_one);
            below_one = sine.times(sine).scaled(2.0);
            sine = sine.times(cosine).scaled(2.0);
        }
        let cosine = Self::exact(1.0).minus(below_one);
        match quarters.rem_euclid(4.0) as u8 {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// Whether it is below another number.
    fn is_below(self, other: Self) -> bool {
        (self.high, self.low) < (other.high, other.low)
    }
}

impl std::ops::Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Number for DoubleDouble {
    fn rational(value: &Rational) -> Self {
        let high = f64::rational(value);
        let rest = Rational::of_f64(high).map(|high| value - &high);
        Self {
            high,
            low: rest.map_or(0.0, |rest| f64::rational(&rest)),
        }
    }

    fn constant(constant: NamedConstant) -> Self {
        let low = match constant {
            NamedConstant::Pi => 2.0 * HALF_PI[1],
            NamedConstant::E => 1.445_646_891_729_250_2e-16,
            NamedConstant::Ln2 => LN_2[1],
            NamedConstant::Ln10 => -2.170_756_223_382_249_4e-16,
            NamedConstant::EulerGamma => -4.942_915_152_430_645e-18,
        };
        Self {
            high: constant_value(constant),
            low,
        }
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
        let one = Self::exact(1.0);
        match (function, operands) {
            (Function::Sqrt, [x]) => x.sqrt(),
            (Function::Sin, [x]) => x.circular().0,
            (Function::Cos, [x]) => x.circular().1,
            (Function::Tan, [x]) => {
                let (sine, cosine) = x.circular();
                sine.over(cosine)
            }
            (Function::Exp, [x]) => x.exp(),
            (Function::Ln, [x]) => x.ln(),
            (Function::Abs, [x]) if x.high < 0.0 => -*x,
            (Function::Abs, [x]) => *x,
            (Function::Sign, [x]) => Self::exact(x.high.signum()),
            (Function::Side, [x]) if x.high < 0.0 => -one,
            (Function::Side, [_]) => one,
            (Function::Min, [x, y]) if y.is_below(*x) || x.high.is_nan() => *y,
            (Function::Max, [x, y]) if x.is_below(*y) || x.high.is_nan() => *y,
            (Function::Min | Function::Max, [x, _]) => *x,
            (Function::Select, [a, b, x, y]) => *if a == b { x } else { y },
            (Function::MulAdd, [a, b, c]) => a.times(*b).plus(*c),
            (function, [x]) => x.elementary(function),
            (function, [x, y]) => Self::elementary_of_two(function, *x, *y),
            (Function::Less, [a, b, x, y]) => *if a.is_below(*b) { x } else { y },
            (Function::AtMost, [a, b, x, y]) => *if a.is_below(*b) || a == b { x } else { y },
            _ => Self::exact(f64::NAN),
        }
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        stand_in(table, order, argument)
    }
}

/// A function of the sign of a tabulated one, smooth everywhere, in its place: how right a form is does not depend on the
/// numbers of a table, which may be only sketched, and which say nothing beyond its interval.
pub(crate) fn stand_in<N: Number>(table: &Table, order: usize, argument: &N) -> N {
    let number = |value: i64| N::rational(&whole(value));
    // The derivatives of 2 + cos x, or of its negative.
    let (function, sign) = [
        (Function::Cos, 1),
        (Function::Sin, -1),
        (Function::Cos, -1),
        (Function::Sin, 1),
    ][order % 4];
    let wave = N::apply(function, std::slice::from_ref(argument)).multiply(&number(sign));
    let value = if order == 0 {
        number(2).add(&wave)
    } else {
        wave
    };
    if table.sign.is_not_positive() {
        value.multiply(&number(-1))
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::factor::constants;
    use crate::graph::{Evaluation, ratio};

    /// How far a number is from a rational one, in parts of it.
    fn error(found: DoubleDouble, exact: &Rational) -> f64 {
        let parts = [found.high, found.low].map(|part| Rational::of_f64(part).expect("finite"));
        let found = &parts[0] + &parts[1];
        f64::rational(&((&found - exact) / exact)).abs()
    }

    #[test]
    fn functions_have_thirty_digits() {
        let smooth = Function::called().filter(|row| matches!(row.evaluation, Evaluation::One(..)));
        let functions: Vec<Function> = smooth.map(|row| row.function).collect();
        assert!(functions.len() >= 20);
        // Each of them has few enough digits to be a number of this kind.
        let arguments = [
            (1, 4),
            (22, 1 << 23),
            (-201, 64),
            (1, 1024),
            (81, 1),
            (1025, 1024),
            (-3, 4),
            (-1023, 1024),
            (3, 1 << 20),
            (350, 1),
        ];
        for function in functions {
            for (n, d) in arguments {
                let argument = ratio(n, d);
                let Some(exact) = constants::value(function, std::slice::from_ref(&argument))
                else {
                    continue;
                };
                let found = DoubleDouble::apply(function, &[DoubleDouble::rational(&argument)]);
                let error = error(found, &exact);
                assert!(error < 1e-29, "{function:?} of {n}/{d}: {error:e}");
            }
        }
    }

    #[test]
    fn functions_of_two_numbers_have_thirty_digits() {
        let functions = [Function::Atan2, Function::Hypot, Function::Powf];
        let numbers = [(1, 4), (-3, 8), (5, 2), (-7, 1), (1, 1 << 30), (81, 1)];
        for function in functions {
            let pairs = numbers
                .iter()
                .flat_map(|x| numbers.iter().map(move |y| [*x, *y]));
            for pair in pairs {
                let arguments = pair.map(|(n, d)| ratio(n, d));
                let Some(exact) = constants::value(function, &arguments) else {
                    continue;
                };
                let found = arguments.each_ref().map(DoubleDouble::rational);
                let error = error(DoubleDouble::apply(function, &found), &exact);
                assert!(error < 1e-28, "{function:?} of {pair:?}: {error:e}");
            }
        }
    }

    #[test]
    fn functions_that_jump_look_at_all_digits() {
        let number = |high: f64, low: f64| DoubleDouble { high, low };
        let cases = [
            (Function::Floor, number(2.0, -1e-20), 1.0),
            (Function::Floor, number(2.0, 1e-20), 2.0),
            (Function::Ceil, number(2.0, 1e-20), 3.0),
            (Function::Round, number(2.5, -1e-20), 2.0),
            (Function::Round, number(-2.5, 0.0), -3.0),
            (Function::Trunc, number(-2.0, 1e-20), -1.0),
            (Function::Ceil, number(2.0_f64.next_up(), -1e-17), 3.0),
        ];
        for (function, argument, expected) in cases {
            let found = DoubleDouble::apply(function, &[argument]);
            assert_eq!(
                found,
                DoubleDouble::exact(expected),
                "{function:?} {argument:?}"
            );
        }
    }

    #[test]
    fn roots_and_quotients_have_thirty_digits() {
        let [a, b] = [ratio(2, 1), ratio(1, 3)].map(|value| DoubleDouble::rational(&value));
        let root = a.sqrt();
        assert!(error(root.times(root), &ratio(2, 1)) < 1e-30);
        assert!(error(a.over(b), &ratio(6, 1)) < 1e-30);
    }
}
