//! The elementary functions beyond sine, exponential and logarithm, by these and by steps of Newton's method.

use super::{DoubleDouble, LN_2};
use crate::graph::{Evaluation, Function, NamedConstant};
use crate::interpret::Number;

/// Beyond this the exponential, or its inverse, leaves the range of numbers, and the nearest `f64` is as good.
const LARGEST_EXPONENT: f64 = 700.0;

/// Beyond this the square of a number leaves the range of numbers.
const LARGEST_SQUARE: f64 = 1e150;

/// Below this a power series of e^x − 1 is as exact as that of the reduced argument.
const SMALL: f64 = 0.5;

const ONE: DoubleDouble = DoubleDouble {
    high: 1.0,
    low: 0.0,
};

impl DoubleDouble {
    /// A function of one number.
    pub(super) fn elementary(self, function: Function) -> Self {
        let nearest = match function.row().evaluation {
            Evaluation::One(value, _) => value(self.high),
            Evaluation::Step(value) => return self.stepped(value),
            _ => f64::apply(function, &[self.high]),
        };
        // What is infinite, no number or 0 is so in more digits too.
        if self.high == 0.0 || !self.high.is_finite() || !nearest.is_finite() {
            return Self::exact(nearest);
        }
        let inverse_of = |log: NamedConstant| self.ln().over(Self::constant(log));
        match function {
            Function::Atan => self.angle(ONE),
            Function::Asin => self.angle(self.other_side()),
            Function::Acos => self.other_side().angle(self),
            Function::ExpM1 => self.exp_m1(),
            Function::Ln1p => self.ln_1p(),
            Function::Cbrt => self.cbrt(),
            Function::Log2 => inverse_of(NamedConstant::Ln2),
            Function::Log10 => inverse_of(NamedConstant::Ln10),
            Function::Erf | Function::Erfc => self.error_function(function, nearest),
            Function::Exp2 => self.times(Self::constant(NamedConstant::Ln2)).exp(),
            _ if self.high < 0.0 && function != Function::Cosh => {
                -(-self).hyperbolic(function, -nearest)
            }
            _ => self.hyperbolic(function, nearest),
        }
    }

    /// A function of two numbers.
    pub(super) fn elementary_of_two(function: Function, x: Self, y: Self) -> Self {
        let nearest = f64::apply(function, &[x.high, y.high]);
        if !(x.high.is_finite() && y.high.is_finite() && nearest.is_finite()) {
            return Self::exact(nearest);
        }
        match function {
            Function::Atan2 => x.angle(y),
            Function::Hypot => x.length(y),
            Function::OverSquares => x.over_squares(y),
            Function::Powf => x.to_power(y, nearest),
            _ => Self::exact(f64::NAN),
        }
    }

    /// The larger of two in size as a power of two, to scale both by: 0 of zeros.
    fn scale(self, other: Self) -> f64 {
        let size = self.high.abs().max(other.high.abs());
        if size == 0.0 {
            return 0.0;
        }
        // From the smallest to the largest number whose inverse is one, too.
        2.0_f64.powi(-(size.log2().floor().clamp(-1000.0, 1000.0) as i32))
    }

    /// The angle of the point of which this is the ordinate, by a step from the nearest `f64`.
    fn angle(self, abscissa: Self) -> Self {
        let guess = self.high.atan2(abscissa.high);
        let scale = self.scale(abscissa);
        if scale == 0.0 {
            return Self::exact(guess);
        }
        let (y, x) = (self.scaled(scale), abscissa.scaled(scale));
        let (sine, cosine) = Self::exact(guess).circular();
        let across = y.times(cosine).minus(x.times(sine));
        let along = x.times(cosine).plus(y.times(sine));
        Self::exact(guess).plus(across.over(along))
    }

    /// √((1 − x)(1 + x))
    fn other_side(self) -> Self {
        ONE.minus(self).times(ONE.plus(self)).sqrt()
    }

    fn length(self, other: Self) -> Self {
        let scale = self.scale(other);
        if scale == 0.0 {
            return Self::exact(0.0);
        }
        let (x, y) = (self.scaled(scale), other.scaled(scale));
        let root = x.times(x).plus(y.times(y)).sqrt();
        root.scaled(scale.recip())
    }

    fn over_squares(self, other: Self) -> Self {
        let scale = self.scale(other);
        let (x, y) = (self.scaled(scale), other.scaled(scale));
        x.over(x.times(x).plus(y.times(y))).scaled(scale)
    }

    fn exp_m1(self) -> Self {
        if self.high.abs() < SMALL {
            self.exponential_less_one()
        } else {
            self.exp().minus(ONE)
        }
    }

    /// By a step of Newton's method on e^y − 1.
    fn ln_1p(self) -> Self {
        let guess = Self::exact(self.high.ln_1p());
        let found = guess.exp_m1();
        guess.plus(self.minus(found).over(ONE.plus(found)))
    }

    fn cbrt(self) -> Self {
        let guess = Self::exact(self.high.cbrt());
        let square = guess.times(guess);
        let rest = self.minus(square.times(guess));
        guess.plus(rest.over(square.scaled(3.0)))
    }

    /// A hyperbolic function or its inverse of a positive number, or the cosine of any.
    fn hyperbolic(self, function: Function, nearest: f64) -> Self {
        let is_inverse = matches!(function, Function::Asinh | Function::Acosh);
        if is_inverse && self.high > LARGEST_SQUARE {
            return self.ln().plus(Self {
                high: LN_2[0],
                low: LN_2[1],
            });
        }
        if !is_inverse && self.high.abs() > LARGEST_EXPONENT {
            return Self::exact(nearest);
        }
        let square = self.times(self);
        match function {
            Function::Cosh => self.exp().plus((-self).exp()).scaled(0.5),
            Function::Sinh => {
                let less_one = self.exp_m1();
                let rest = less_one.over(ONE.plus(less_one));
                less_one.plus(rest).scaled(0.5)
            }
            Function::Tanh if self.high > LARGEST_EXPONENT / 2.0 => ONE,
            Function::Tanh => {
                let less_one = self.scaled(2.0).exp_m1();
                less_one.over(Self::exact(2.0).plus(less_one))
            }
            Function::Asinh => {
                let root = ONE.plus(square).sqrt();
                self.plus(square.over(ONE.plus(root))).ln_1p()
            }
            Function::Acosh => {
                let above = self.minus(ONE);
                above.plus(above.times(ONE.plus(self)).sqrt()).ln_1p()
            }
            Function::Atanh => {
                let quotient = self.scaled(2.0).over(ONE.minus(self));
                quotient.ln_1p().scaled(0.5)
            }
            _ => Self::exact(f64::NAN),
        }
    }

    /// A power; where it has no logarithm the nearest `f64`.
    fn to_power(self, exponent: Self, nearest: f64) -> Self {
        let is_ordinary = self.high != 0.0 && nearest != 0.0 && exponent.high != 0.0;
        if !is_ordinary {
            return Self::exact(nearest);
        }
        let size = if self.high < 0.0 { -self } else { self };
        let power = exponent.times(size.ln()).exp();
        if nearest < 0.0 { -power } else { power }
    }

    /// A function that jumps at whole numbers or between two: there the second part decides.
    fn stepped(self, value: fn(f64) -> f64) -> Self {
        let is_at_jump = (2.0 * self.high).fract() == 0.0;
        let beside = match self.low {
            low if low < 0.0 && is_at_jump => self.high.next_down(),
            low if low > 0.0 && is_at_jump => self.high.next_up(),
            _ => self.high,
        };
        Self::exact(value(beside))
    }
}
