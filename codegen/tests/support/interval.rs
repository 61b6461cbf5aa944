//! An `f64` as Rust computes it, and bounds of the number that it stands for: a running error bound that knows the ends of
//! the range, so that overflow and underflow are in it.

mod arithmetic;
mod exact;
pub mod functions;

use exact::{exact_product, exact_quotient, exact_root, exact_sum, lowered, raised};

/// The largest change of a tangent that is still of first order.
const COARSE: f64 = 1e-2;

/// What is known of the exact number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knowledge {
    /// It lies between the bounds.
    Bounded,
    /// It is NaN, whatever is rounded.
    NoNumber,
    /// Nothing.
    Unknown,
}

/// A result and bounds of the exact number. An operation that is exact leaves them as they are, but where they are
/// `ROUGH`: then they are those of a function whose every operation is rounded, as another order of the same operations is.
#[derive(Clone, Copy, Debug)]
pub struct Interval<const ROUGH: bool> {
    pub value: f64,
    pub low: f64,
    pub high: f64,
    pub knowledge: Knowledge,
    /// Whether it is a zero whose sign is that of a difference of equals.
    signless: bool,
}

impl<const ROUGH: bool> Interval<ROUGH> {
    pub fn exactly(value: f64) -> Self {
        Self {
            value,
            low: value,
            high: value,
            knowledge: if value.is_nan() {
                Knowledge::NoNumber
            } else {
                Knowledge::Bounded
            },
            signless: false,
        }
    }

    fn unknown(value: f64) -> Self {
        Self {
            value,
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            knowledge: Knowledge::Unknown,
            signless: false,
        }
    }

    fn between(value: f64, low: f64, high: f64) -> Self {
        if value.is_nan() || low.is_nan() || high.is_nan() {
            return Self::unknown(value);
        }
        Self {
            value,
            low: low.min(value),
            high: high.max(value),
            knowledge: Knowledge::Bounded,
            signless: false,
        }
    }

    pub fn is_bounded(self) -> bool {
        self.knowledge == Knowledge::Bounded
    }

    fn is_point(self) -> bool {
        self.is_bounded() && self.low == self.high
    }

    fn holds_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// How far the exact number may be from the value.
    pub fn error(self) -> f64 {
        if self.is_point() {
            return 0.0;
        }
        (self.high - self.value).max(self.value - self.low)
    }

    /// What the operands already decide.
    fn inherited(value: f64, operands: &[Self]) -> Option<Self> {
        let any = |knowledge| operands.iter().any(|one| one.knowledge == knowledge);
        if any(Knowledge::Unknown) {
            return Some(Self::unknown(value));
        }
        any(Knowledge::NoNumber).then(|| Self::exactly(f64::NAN))
    }

    fn negative(self) -> Self {
        Self {
            value: -self.value,
            low: -self.high,
            high: -self.low,
            ..self
        }
    }

    fn size(self) -> Self {
        let value = self.value.abs();
        if !self.is_bounded() {
            return Self { value, ..self };
        }
        let (low, high) = (self.low.abs(), self.high.abs());
        let least = if self.holds_zero() {
            0.0
        } else {
            low.min(high)
        };
        Self::between(value, least, low.max(high))
    }

    fn from_ends(
        value: f64,
        ends: &[(f64, f64)],
        operation: impl Fn(f64, f64) -> (f64, bool),
    ) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (a, b) in ends {
            let (end, exact) = operation(*a, *b);
            // What is no number though its operands are, such as 0·∞, may be one in another form.
            if end.is_nan() {
                return Self::unknown(value);
            }
            let exact = exact && (!ROUGH || end == 0.0 || end.is_infinite());
            low = low.min(if exact { end } else { end.next_down() });
            high = high.max(if exact { end } else { end.next_up() });
        }
        Self::between(value, low, high)
    }

    fn sum(self, other: Self) -> Self {
        let value = self.value + other.value;
        Self::inherited(value, &[self, other]).unwrap_or_else(|| {
            let ends = [(self.low, other.low), (self.high, other.high)];
            Self {
                signless: value == 0.0,
                ..Self::from_ends(value, &ends, exact_sum)
            }
        })
    }

    fn product(self, other: Self) -> Self {
        let value = self.value * other.value;
        Self::inherited(value, &[self, other]).unwrap_or_else(|| Self {
            signless: value == 0.0,
            ..Self::from_ends(value, &corners(self, other), exact_product)
        })
    }

    fn quotient(self, other: Self) -> Self {
        let value = self.value / other.value;
        if let Some(result) = Self::inherited(value, &[self, other]) {
            return result;
        }
        if other.holds_zero() {
            return match (other.is_point(), self.is_point()) {
                _ if other.signless => Self::unknown(value),
                (true, true) if !value.is_nan() => Self::exactly(value),
                (true, false) if !self.holds_zero() => Self::exactly(value),
                _ => Self::unknown(value),
            };
        }
        Self {
            signless: value == 0.0,
            ..Self::from_ends(value, &corners(self, other), exact_quotient)
        }
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.high < 0.0 {
                return Self::exactly(f64::NAN);
            }
            if self.low < 0.0 {
                return Self::unknown(value);
            }
            let ends = [(self.low, 0.0), (self.high, 0.0)];
            Self::from_ends(value, &ends, |x, _| exact_root(x))
        })
    }

    /// A sine or cosine.
    fn wave(self, value: f64) -> Self {
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.value == 0.0 && self.is_point() {
                return Self::exactly(value);
            }
            if self.is_point() && self.value.is_infinite() {
                return Self::exactly(f64::NAN);
            }
            let apart = self.error().next_up();
            let (low, high) = (value - apart, value + apart);
            Self::between(value, lowered(low).max(-1.0), raised(high).min(1.0))
        })
    }

    fn tan(self) -> Self {
        let value = self.value.tan();
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.value == 0.0 && self.is_point() {
                return Self::exactly(value);
            }
            if self.is_point() && self.value.is_infinite() {
                return Self::exactly(f64::NAN);
            }
            let change = 1.1 * self.error() * (1.0 + value * value);
            if change.is_nan() || change > COARSE {
                return Self::unknown(value);
            }
            Self::between(value, lowered(value - change), raised(value + change))
        })
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.is_point() && (self.value == 0.0 || self.value.is_infinite()) {
                return Self::exactly(value);
            }
            let (low, high) = (lowered(self.low.exp()), raised(self.high.exp()));
            Self::between(value, low.max(0.0), high)
        })
    }

    fn ln(self) -> Self {
        let value = self.value.ln();
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.high < 0.0 {
                return Self::exactly(f64::NAN);
            }
            if self.is_point() && [0.0, 1.0, f64::INFINITY].contains(&self.value) {
                return Self::exactly(value);
            }
            if self.low <= 0.0 {
                return Self::unknown(value);
            }
            Self::between(value, lowered(self.low.ln()), raised(self.high.ln()))
        })
    }

    fn signum(self) -> Self {
        let value = self.value.signum();
        // Derivatives have a side of zero in its place, also of what is no number.
        if self.knowledge == Knowledge::NoNumber {
            return Self::unknown(value);
        }
        Self::inherited(value, &[self]).unwrap_or_else(|| {
            if self.holds_zero() {
                return Self::between(value, -1.0, 1.0);
            }
            Self::exactly(value)
        })
    }

    fn hull(self, other: Self, value: f64) -> Self {
        if self.is_bounded() && other.is_bounded() {
            return Self::between(value, self.low.min(other.low), self.high.max(other.high));
        }
        Self::unknown(value)
    }

    fn extreme(larger: bool, x: Self, y: Self) -> Self {
        let value = if larger {
            x.value.max(y.value)
        } else {
            x.value.min(y.value)
        };
        match (x.knowledge, y.knowledge) {
            (Knowledge::NoNumber, _) => y,
            (_, Knowledge::NoNumber) => x,
            (Knowledge::Bounded, Knowledge::Bounded) if larger => {
                Self::between(value, x.low.max(y.low), x.high.max(y.high))
            }
            (Knowledge::Bounded, Knowledge::Bounded) => {
                Self::between(value, x.low.min(y.low), x.high.min(y.high))
            }
            _ => Self::unknown(value),
        }
    }

    fn whole_power(self, exponent: i32) -> Self {
        let value = self.value.powi(exponent);
        if exponent == 0 {
            // Also of NaN.
            return Self::exactly(1.0);
        }
        if let Some(result) = Self::inherited(value, &[self]) {
            return result;
        }
        let of_size = |x: f64| raised_power(Self::exactly(x.abs()), exponent.unsigned_abs());
        let power = if exponent % 2 == 0 {
            raised_power(self.size(), exponent.unsigned_abs())
        } else {
            let signed = |x: f64| {
                let power = of_size(x);
                if x < 0.0 { power.negative() } else { power }
            };
            let (low, high) = (signed(self.low), signed(self.high));
            let between = low.value;
            low.hull(high, between)
        };
        let power = if exponent < 0 {
            Self::exactly(1.0).quotient(power)
        } else {
            power
        };
        if !power.is_bounded() {
            return Self { value, ..power };
        }
        Self::between(value, power.low, power.high)
    }
}

fn raised_power<const ROUGH: bool>(mut square: Interval<ROUGH>, mut rest: u32) -> Interval<ROUGH> {
    let mut power = Interval::exactly(1.0);
    while rest > 0 {
        if rest % 2 == 1 {
            power = power.product(square);
        }
        rest /= 2;
        if rest > 0 {
            square = square.product(square);
        }
    }
    power
}

fn corners<const ROUGH: bool>(x: Interval<ROUGH>, y: Interval<ROUGH>) -> [(f64, f64); 4] {
    [
        (x.low, y.low),
        (x.low, y.high),
        (x.high, y.low),
        (x.high, y.high),
    ]
}
