//! The range of an axis, where its ticks are and how they are written.

use std::f64::consts::PI;
use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

use super::Ticks;

/// A range with its ticks.
#[derive(Debug, Clone)]
pub(super) struct Scale {
    /// First value shown.
    pub(super) low: f64,
    /// Last value shown.
    pub(super) high: f64,
    /// Multiples of the step within the range.
    pub(super) ticks: Vec<f64>,
    kind: Ticks,
    step: f64,
}

/// Whether a range is shown as it is or reaches to the next tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// As it is.
    Kept,
    /// Rounded outwards to ticks, and down to zero where that is near.
    Rounded,
}

impl Scale {
    /// The scale over `low < high` with at most about `count` steps.
    pub(super) fn new(low: f64, high: f64, kind: Ticks, ends: Ends, count: f64) -> Self {
        let (low, high) = if ends == Ends::Rounded {
            with_room(low, high)
        } else {
            (low, high)
        };
        let step = step(high - low, kind, count);
        // A bound that rounding has moved a little off its tick is on it.
        let (first, last) = match ends {
            Ends::Kept => ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor()),
            Ends::Rounded => ((low / step + 1e-9).floor(), (high / step - 1e-9).ceil()),
        };
        // Ranges as narrow as the spacing of numbers have no ticks worth counting.
        let count = (last - first).clamp(0.0, 100.0) as usize;
        let ticks = (0..=count).map(|k| (first + k as f64) * step).collect();
        match ends {
            Ends::Kept => Self {
                low,
                high,
                ticks,
                kind,
                step,
            },
            Ends::Rounded => Self {
                low: first * step,
                high: last * step,
                ticks,
                kind,
                step,
            },
        }
    }

    /// A tick as text.
    pub(super) fn write(&self, value: f64) -> String {
        let unit = unit(self.kind);
        let thirty_seconds = 32.0 * self.step / unit;
        match self.kind {
            Ticks::Decimal => self.decimal(value, unit),
            Ticks::Degrees => format!("{}°", self.decimal(value, unit)),
            Ticks::FractionsOfPi if (thirty_seconds - thirty_seconds.round()).abs() < 1e-6 => {
                fraction_of_pi(value)
            }
            Ticks::FractionsOfPi => format!("{}π", self.decimal(value, unit)),
        }
    }

    /// With as many decimals as the step needs; very large and very small numbers with a power of
    /// ten.
    fn decimal(&self, value: f64, unit: f64) -> String {
        let (value, step) = (value / unit, self.step / unit);
        let largest = self.low.abs().max(self.high.abs()) / unit;
        // Where the sum of steps should be zero, rounding may leave a little.
        if value.abs() < 1e-9 * step {
            return "0".to_owned();
        }
        let last_digit = (step * 1.000_001).log10().floor();
        if (1e-3..1e5).contains(&largest) {
            let decimals = (-last_digit).clamp(0.0, 9.0) as usize;
            return minus(&format!("{value:.decimals$}"));
        }
        let exponent = (value.abs() * 1.000_001).log10().floor();
        let digits = (exponent - last_digit).clamp(0.0, 9.0) as usize;
        let mantissa = value / 10f64.powf(exponent);
        let power = superscript(&format!("{exponent:.0}"));
        minus(&format!("{mantissa:.digits$}×10{power}"))
    }
}

impl Ranged for Scale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range()).map(value, limit)
    }

    /// The ticks, whatever number of them is asked for; no lines between them.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

/// A range with a little room at both ends, so that no curve runs along the frame; one that begins
/// near zero begins at zero.
fn with_room(low: f64, high: f64) -> (f64, f64) {
    let room = 0.02 * (high - low);
    let near_zero = (0.0..0.3 * high).contains(&low);
    (if near_zero { 0.0 } else { low - room }, high + room)
}

/// What the numbers of the ticks count.
fn unit(kind: Ticks) -> f64 {
    match kind {
        Ticks::Decimal => 1.0,
        Ticks::FractionsOfPi => PI,
        Ticks::Degrees => PI / 180.0,
    }
}

/// The smallest step of the kind that covers the span in at most `count` steps.
fn step(span: f64, kind: Ticks, count: f64) -> f64 {
    let unit = unit(kind);
    // A little less, so that rounding does not double a step that fits exactly.
    let wanted = span / count / unit * (1.0 - 1e-9);
    let usual: &[f64] = match kind {
        Ticks::Decimal => &[],
        Ticks::FractionsOfPi => &[0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 2.0],
        Ticks::Degrees => &[5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0],
    };
    let finest = usual.first().copied().unwrap_or(f64::INFINITY);
    let chosen = usual
        .iter()
        .copied()
        .find(|&step| step >= wanted && wanted >= 0.5 * finest);
    unit * chosen.unwrap_or_else(|| {
        let power = 10f64.powf(wanted.log10().floor());
        power
            * [1.0, 2.0, 5.0]
                .into_iter()
                .find(|step| step * power >= wanted)
                .unwrap_or(10.0)
    })
}

/// `3π/8` and the like, to the nearest 1/32.
fn fraction_of_pi(value: f64) -> String {
    let (mut numerator, mut denominator) = ((value / PI * 32.0).round() as i64, 32);
    while denominator > 1 && numerator % 2 == 0 {
        (numerator, denominator) = (numerator / 2, denominator / 2);
    }
    let factor = match numerator {
        0 => return "0".to_owned(),
        1 => String::new(),
        -1 => "-".to_owned(),
        _ => numerator.to_string(),
    };
    let divisor = if denominator == 1 {
        String::new()
    } else {
        format!("/{denominator}")
    };
    minus(&format!("{factor}π{divisor}"))
}

/// With the minus sign of typography for the hyphen.
fn minus(text: &str) -> String {
    text.replace('-', "−")
}

/// Digits and a sign as superscript letters.
fn superscript(text: &str) -> String {
    text.chars()
        .map(|letter| match letter {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            _ => letter
                .to_digit(10)
                .and_then(|digit| char::from_u32(0x2070 + digit))
                .unwrap_or(letter),
        })
        .collect()
}
