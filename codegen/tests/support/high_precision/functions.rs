//! The elementary functions beyond roots, waves and exponentials, with how their operands' errors go on.

use astro_float::{BigFloat, Consts};

use super::{CONSTANTS, DIGITS, HighPrecision, ROUNDING, big, to_f64};
use crate::support::size::Size;
use crate::support::tape::{Arithmetic, Binary, Comparison, Unary};

/// Exponents of two up to which a number is a moderate argument of an exponential.
const LARGEST_EXPONENT: f64 = 20.0;

/// Below this a series is taken of what would cancel.
const SMALL: f64 = 0.25;

impl HighPrecision {
    fn evaluated(&self, function: impl FnOnce(&BigFloat, &mut Consts) -> BigFloat) -> BigFloat {
        CONSTANTS.with_borrow_mut(|constants| function(&self.value, constants))
    }

    fn is_exactly(&self, value: f64) -> bool {
        self.error == Size::ZERO && self.value.cmp(&big(value)) == Some(0)
    }

    fn absolute(&self) -> Self {
        Self {
            value: self.value.abs(),
            error: self.error,
        }
    }

    fn less(&self, value: f64) -> Self {
        self.sum(&Self::exactly(-value))
    }

    /// A function of one number.
    pub(super) fn elementary(function: Unary, x: &Self) -> Self {
        match function {
            Unary::Asin | Unary::Acos | Unary::Atanh => x.within_one(function),
            Unary::Acosh => x.acosh(),
            Unary::Atan | Unary::Tanh | Unary::Asinh => {
                // Their slopes are at most 1.
                let value = x.evaluated(|x, constants| match function {
                    Unary::Atan => x.atan(DIGITS, ROUNDING, constants),
                    Unary::Tanh => x.tanh(DIGITS, ROUNDING, constants),
                    _ => x.asinh(DIGITS, ROUNDING, constants),
                });
                if function != Unary::Atan && Size::of(&x.value).0 > LARGEST_EXPONENT {
                    return x.far(function);
                }
                Self::after(value, x.error)
            }
            Unary::Sinh | Unary::Cosh => x.hyperbolic(function),
            Unary::ExpM1 => x.exp_m1(),
            Unary::Ln1p => x.ln_1p(),
            Unary::Cbrt => x.cbrt(),
            Unary::Log10 => x.ln().quotient(&Self::exactly(10.0).ln()),
            Unary::Log2 => x.ln().quotient(&Self::exactly(2.0).ln()),
            Unary::Exp2 => x.product(&Self::constant("LN_2")).exp(),
            _ => x.stepped(function),
        }
    }

    /// A function of two numbers.
    pub(super) fn elementary_of_two(operation: Binary, x: &Self, y: &Self) -> Self {
        if !x.is_known() || !y.is_known() {
            return Self::unknown();
        }
        match operation {
            Binary::Atan2 => x.angle(y),
            Binary::Hypot if x.is_exactly(0.0) => y.absolute(),
            Binary::Hypot if y.is_exactly(0.0) => x.absolute(),
            Binary::Hypot => x.product(x).sum(&y.product(y)).sqrt(),
            Binary::Powf => x.to_power(y),
            Binary::OverSquares => x.quotient(&x.product(x).sum(&y.product(y))),
            _ => x.absolute().product(&y.signum()),
        }
    }

    /// The hyperbolic tangent and the inverse of the sine, far from 0.
    fn far(&self, function: Unary) -> Self {
        let size = self.absolute();
        let far = match function {
            // Off by 2·e^(−2x), below 2^-(2^20).
            Unary::Tanh => Self {
                error: Size(-1e6),
                ..Self::exactly(1.0)
            },
            // Off by 1/(4x²): with the root.
            _ => {
                let root = size.product(&size).sum(&Self::exactly(1.0)).sqrt();
                size.sum(&root).ln()
            }
        };
        if self.value.is_negative() {
            far.negative()
        } else {
            far
        }
    }

    fn within_one(&self, function: Unary) -> Self {
        let one = Self::exactly(1.0);
        let below = one.sum(&self.absolute().negative());
        let is_edge = self.is_exactly(1.0) || self.is_exactly(-1.0);
        if !below.is_beyond_error(2.0) && (!is_edge || function == Unary::Atanh) {
            return Self::unknown();
        }
        if below.value.is_negative() {
            return Self::unknown();
        }
        let least = Size::at_least(&below.value).0 - 1.0;
        let slope = match function {
            _ if is_edge => Size::ZERO,
            Unary::Atanh => Size(-least),
            _ => Size(-0.5 * least),
        };
        let value = self.evaluated(|x, constants| match function {
            Unary::Asin => x.asin(DIGITS, ROUNDING, constants),
            Unary::Acos => x.acos(DIGITS, ROUNDING, constants),
            _ => x.atanh(DIGITS, ROUNDING, constants),
        });
        Self::after(value, self.error.times(slope))
    }

    fn acosh(&self) -> Self {
        if self.is_exactly(1.0) {
            return Self::exactly(0.0);
        }
        let above = self.less(1.0);
        if above.value.is_negative() || !above.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let root = above.product(&self.sum(&Self::exactly(1.0))).sqrt();
        above.sum(&root).ln_1p()
    }

    fn hyperbolic(&self, function: Unary) -> Self {
        if self.error.0 > -1.0 || Size::of(&self.value).0 > LARGEST_EXPONENT {
            return Self::unknown();
        }
        let value = self.evaluated(|x, constants| match function {
            Unary::Sinh => x.sinh(DIGITS, ROUNDING, constants),
            _ => x.cosh(DIGITS, ROUNDING, constants),
        });
        // The slope is below e^|x|, twice as much for the change of it.
        let slope = Size(to_f64(&self.value).abs() * std::f64::consts::LOG2_E + 1.0);
        Self::after(value, self.error.times(slope))
    }

    /// Σ over n of t(n), where t(n + 1) is t(n) times what belongs to n, until terms no longer count.
    fn series(first: &Self, factor: impl Fn(u32) -> Self) -> Self {
        let (mut sum, mut term) = (first.clone(), first.clone());
        for number in 1.. {
            term = term.product(&factor(number));
            let counts = Size::of(&term.value).0 > Size::of(&sum.value).0 - 2.0 * DIGITS as f64;
            if !counts || term.value.is_zero() {
                break;
            }
            sum = sum.sum(&term);
        }
        sum
    }

    fn exp_m1(&self) -> Self {
        if to_f64(&self.value).abs() > SMALL {
            return self.exp().less(1.0);
        }
        Self::series(self, |n| self.quotient(&Self::exactly(f64::from(n + 1))))
    }

    fn ln_1p(&self) -> Self {
        let above = self.sum(&Self::exactly(1.0));
        if to_f64(&self.value).abs() > SMALL {
            return above.ln();
        }
        // 2·artanh(x/(2 + x))
        let z = self.quotient(&self.sum(&Self::exactly(2.0)));
        let square = z.product(&z);
        let sum = Self::series(&z, |n| {
            let odd = f64::from(2 * n);
            let ratio = Self::exactly(odd - 1.0).quotient(&Self::exactly(odd + 1.0));
            square.product(&ratio)
        });
        sum.product(&Self::exactly(2.0))
    }

    fn cbrt(&self) -> Self {
        if self.is_exactly(0.0) {
            return self.clone();
        }
        if !self.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let value = self.value.cbrt(DIGITS, ROUNDING);
        let below = Size(Size::at_least(&self.value).0 - 1.0);
        let propagated = self.error.times(Size::of(&value)).over(below);
        Self::after(value, propagated)
    }

    fn stepped(&self, function: Unary) -> Self {
        let half = big(0.5);
        let twice = self.value.mul(&big(2.0), DIGITS, ROUNDING);
        let nearest = twice.add(&half, DIGITS, ROUNDING).floor();
        let nearest = Self {
            value: nearest.mul(&half, DIGITS, ROUNDING),
            error: Size::ZERO,
        };
        let apart = self.sum(&nearest.negative());
        if self.error != Size::ZERO && !apart.is_beyond_error(1.0) {
            return Self::unknown();
        }
        let towards_zero = |x: &BigFloat| if x.is_negative() { x.ceil() } else { x.floor() };
        let value = match function {
            Unary::Floor => self.value.floor(),
            Unary::Ceil => self.value.ceil(),
            Unary::Trunc => towards_zero(&self.value),
            _ if self.value.is_negative() => towards_zero(&self.value.sub(&half, DIGITS, ROUNDING)),
            _ => towards_zero(&self.value.add(&half, DIGITS, ROUNDING)),
        };
        Self {
            value,
            error: Size::ZERO,
        }
    }

    /// The angle of the point of which this is the ordinate.
    fn angle(&self, abscissa: &Self) -> Self {
        let atan = |quotient: Self| Self::elementary(Unary::Atan, &quotient);
        let is_steep = Size::of(&self.value).0 > Size::of(&abscissa.value).0;
        if is_steep {
            let quarter = Self::constant("FRAC_PI_2").product(&self.signum());
            return quarter.sum(&atan(abscissa.quotient(self)).negative());
        }
        let angle = atan(self.quotient(abscissa));
        if !abscissa.value.is_negative() {
            return angle;
        }
        // On the negative axis the sign of zero decides.
        if !self.is_beyond_error(1.0) {
            return Self::unknown();
        }
        angle.sum(&Self::constant("PI").product(&self.signum()))
    }

    fn to_power(&self, exponent: &Self) -> Self {
        if exponent.is_exactly(0.0) {
            return Self::exactly(1.0);
        }
        if self.is_exactly(0.0) && exponent.is_beyond_error(1.0) && !exponent.value.is_negative() {
            return Self::exactly(0.0);
        }
        if !self.is_beyond_error(2.0) {
            return Self::unknown();
        }
        let power = exponent.product(&self.absolute().ln()).exp();
        if !self.value.is_negative() {
            return power;
        }
        let half = exponent.product(&Self::exactly(0.5));
        match (
            exponent.error == Size::ZERO && exponent.value.is_int(),
            half.value.is_int(),
        ) {
            (true, true) => power,
            (true, false) => power.negative(),
            _ => Self::unknown(),
        }
    }

    /// One of two by a comparison.
    pub(super) fn selected(comparison: Comparison, [a, b, x, y]: [&Self; 4]) -> Self {
        if !a.is_known() || !b.is_known() {
            return Self::unknown();
        }
        let difference = a.sum(&b.negative());
        let ordering = if difference.is_beyond_error(1.0) {
            if difference.value.is_negative() {
                -1.0
            } else {
                1.0
            }
        } else if a.error == Size::ZERO && b.error == Size::ZERO {
            0.0
        } else {
            return Self::unknown();
        };
        let chosen = if comparison.holds(ordering, 0.0) {
            x
        } else {
            y
        };
        chosen.clone()
    }
}
