//! Intervals of the elementary functions beyond roots, waves and exponentials.

use super::Interval;
use super::exact::{lowered, raised};
use crate::support::tape::{Binary, Comparison, Unary};

/// The sizes of numbers of which some function has a value.
const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// By how many units in the last place the standard library's function may be off, and by how much beside that: those that
/// it composes of logarithms lose digits where these vanish, which `the_standard_library_is_as_right_as_is_said` measures.
pub fn slack(function: Unary, x: f64) -> (u32, f64) {
    match function {
        Unary::Acosh => (4, 4.0 * f64::EPSILON),
        // That of a number near −1 is the logarithm of a difference.
        Unary::Atanh => (6, 2.0 * f64::EPSILON * (1.0 - x) / (1.0 + x)),
        Unary::Asinh => (6, 0.0),
        Unary::Sinh | Unary::Cosh | Unary::Tanh => (4, 0.0),
        _ => (2, 0.0),
    }
}

/// Where a function has a value.
fn domain(function: Unary) -> [f64; 2] {
    match function {
        Unary::Asin | Unary::Acos | Unary::Atanh => [-1.0, 1.0],
        Unary::Acosh => [1.0, f64::INFINITY],
        Unary::Log10 | Unary::Log2 => [0.0, f64::INFINITY],
        Unary::Ln1p => [-1.0, f64::INFINITY],
        _ => EVERYWHERE,
    }
}

impl<const ROUGH: bool> Interval<ROUGH> {
    /// A function that is monotonic, or even and rising from 0 on.
    pub(super) fn monotonic(self, function: Unary, value: fn(f64) -> f64) -> Self {
        let result = value(self.value);
        if let Some(inherited) = Self::inherited(result, &[self]) {
            return inherited;
        }
        let [least, most] = domain(function);
        if self.high < least || self.low > most {
            return Self::exactly(f64::NAN);
        }
        if self.low < least || self.high > most {
            return Self::unknown(result);
        }
        // At a pole the number may be of any size, but for the pole itself.
        if self.is_point() && (self.value == 0.0 || result.is_infinite() || result == 0.0) {
            let is_exact = result == 0.0 || result == 1.0 || result.is_infinite();
            if is_exact {
                return Self {
                    signless: self.signless && result == 0.0,
                    ..Self::exactly(result)
                };
            }
        }
        let argument = if function == Unary::Cosh {
            self.size()
        } else {
            self
        };
        let ends = [argument.low, argument.high].map(value);
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        // Each step moves a bound by two places.
        let (places, beside) = slack(function, argument.low);
        let low = (0..places / 2).fold(low - beside, |end, _| lowered(end));
        let high = (0..places / 2).fold(high + beside, |end, _| raised(end));
        let least = if matches!(
            function,
            Unary::Cosh | Unary::Acosh | Unary::Acos | Unary::Exp2
        ) {
            0.0
        } else {
            f64::NEG_INFINITY
        };
        Self {
            signless: result == 0.0 && self.signless,
            ..Self::between(result, low.max(least), high)
        }
    }

    /// A function that jumps: what it gives is exact.
    pub(super) fn stepped(self, value: fn(f64) -> f64) -> Self {
        let result = value(self.value);
        Self::inherited(result, &[self]).unwrap_or_else(|| Self {
            signless: result == 0.0 && self.signless,
            ..Self::between(result, value(self.low), value(self.high))
        })
    }

    /// A function of two numbers.
    pub(super) fn of_two(operation: Binary, x: Self, y: Self) -> Self {
        match operation {
            Binary::Atan2 => x.angle(y),
            Binary::Hypot => x.length(y),
            Binary::Powf => x.to_power(y),
            Binary::OverSquares => {
                let length = x.length(y);
                x.quotient(length).quotient(length)
            }
            _ => x.with_sign_of(y),
        }
    }

    /// The hull of a function's values at the corners of two intervals.
    fn hull_of_corners(self, other: Self, function: fn(f64, f64) -> f64) -> Self {
        let value = function(self.value, other.value);
        let corners = super::corners(self, other).map(|(a, b)| function(a, b));
        if corners.iter().any(|corner| corner.is_nan()) {
            return Self::unknown(value);
        }
        let low = corners.into_iter().fold(f64::INFINITY, f64::min);
        let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::between(value, lowered(low), raised(high))
    }

    /// The angle of the point of which this is the ordinate.
    fn angle(self, abscissa: Self) -> Self {
        let value = self.value.atan2(abscissa.value);
        if let Some(inherited) = Self::inherited(value, &[self, abscissa]) {
            return inherited;
        }
        // The angle jumps across the negative axis, where the sign of a zero decides, and all of them meet in the origin.
        if self.holds_zero() && abscissa.low <= 0.0 {
            return Self::unknown(value);
        }
        let hull = self.hull_of_corners(abscissa, f64::atan2);
        if value == 0.0 && self.is_point() {
            return Self {
                signless: self.signless,
                ..Self::exactly(value)
            };
        }
        hull
    }

    fn length(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        let is_infinite = |one: &Self| one.is_point() && one.value.is_infinite();
        if [self, other].iter().any(is_infinite) {
            return Self::exactly(f64::INFINITY);
        }
        Self::inherited(value, &[self, other]).unwrap_or_else(|| {
            let (x, y) = (self.size(), other.size());
            if x.is_point() && y.is_point() && value == 0.0 {
                return Self::exactly(0.0);
            }
            let hull = x.hull_of_corners(y, f64::hypot);
            Self::between(value, hull.low.max(0.0), hull.high)
        })
    }

    fn to_power(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        if !(self.is_bounded() && exponent.is_bounded()) {
            return Self::unknown(value);
        }
        if exponent.is_point() && exponent.value == 0.0 {
            return Self::exactly(1.0);
        }
        if self.is_point() && self.value == 0.0 && !self.signless && !exponent.holds_zero() {
            return Self::exactly(value);
        }
        let rises_from_zero = self.low >= 0.0 && exponent.low > 0.0;
        if self.low > 0.0 || rises_from_zero {
            let hull = self.hull_of_corners(exponent, f64::powf);
            return Self {
                low: hull.low.max(0.0),
                ..hull
            };
        }
        if self.high < 0.0 && exponent.is_point() && exponent.value.fract() == 0.0 {
            let power = self.size().to_power(exponent);
            return if value < 0.0 { power.negative() } else { power };
        }
        Self::unknown(value)
    }

    fn with_sign_of(self, other: Self) -> Self {
        let value = self.value.copysign(other.value);
        if !(self.is_bounded() && other.is_bounded()) {
            return Self::unknown(value);
        }
        let size = self.size();
        if other.low > 0.0 {
            size
        } else if other.high < 0.0 {
            size.negative()
        } else {
            Self::between(value, -size.high, size.high)
        }
    }

    /// One of two by a comparison.
    pub(super) fn selected(comparison: Comparison, [a, b, x, y]: [Self; 4]) -> Self {
        let (a, b, comparison) = match comparison {
            Comparison::Greater => (b, a, Comparison::Less),
            Comparison::AtLeast => (b, a, Comparison::AtMost),
            other => (a, b, other),
        };
        let chosen = if comparison.holds(a.value, b.value) {
            x
        } else {
            y
        };
        if [a, b]
            .iter()
            .any(|one| one.knowledge == super::Knowledge::Unknown)
        {
            return Self::unknown(chosen.value);
        }
        if !(a.is_bounded() && b.is_bounded()) {
            return y;
        }
        let (is_certain, fails) = match comparison {
            Comparison::Less => (a.high < b.low, a.low >= b.high),
            Comparison::AtMost => (a.high <= b.low, a.low > b.high),
            _ => (
                a.is_point() && b.is_point() && a.value == b.value,
                a.high < b.low || b.high < a.low,
            ),
        };
        match (is_certain, fails) {
            (true, _) => x,
            (_, true) => y,
            _ => x.hull(y, chosen.value),
        }
    }
}
