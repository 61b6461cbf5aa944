//! The range of an axis, where its ticks are and how they are written.

use std::f64::consts::PI;

use crate::figure::Ticks;

/// A range with its ticks.
#[derive(Debug, Clone)]
pub(crate) struct Scale {
    /// First value shown.
    pub(crate) low: f64,
    /// Last value shown.
    pub(crate) high: f64,
    /// Values within the range that have a tick.
    pub(crate) ticks: Vec<f64>,
    kind: Ticks,
    step: f64,
}

/// Whether a range is shown as it is or reaches to the next tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ends {
    /// The range is shown as it is.
    Kept,
    /// The range is rounded outwards to ticks, and down to zero where that is near.
    Rounded,
}

impl Scale {
    /// Creates the scale over `low < high` with at most about `count` steps. A logarithmic one needs `low > 0`.
    pub(crate) fn new(low: f64, high: f64, kind: Ticks, ends: Ends, count: f64) -> Self {
        if kind == Ticks::Logarithmic {
            return Self::logarithmic(low, high, ends, count);
        }
        let (low, high) = match ends {
            Ends::Kept => (low, high),
            Ends::Rounded => with_room(low, high),
        };
        let step = step(high - low, kind, count);
        // Rounding may have moved a bound off its tick by a little; it counts as on the tick.
        let (first, last) = match ends {
            Ends::Kept => ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor()),
            Ends::Rounded => ((low / step + 1e-9).floor(), (high / step - 1e-9).ceil()),
        };
        // Ranges as narrow as the spacing of numbers have no ticks worth counting.
        let count = (last - first).clamp(0.0, 100.0) as usize;
        let ticks = (0..=count).map(|k| (first + k as f64) * step).collect();
        let (low, high) = match ends {
            Ends::Kept => (low, high),
            Ends::Rounded => (first * step, last * step),
        };
        Self {
            low,
            high,
            ticks,
            kind,
            step,
        }
    }

    /// Creates a logarithmic scale with ticks at 1, 2 and 5 in each decade, or at every decade or every few of them
    /// where those are too many; within less than a decade evenly spaced ones where those are too few.
    fn logarithmic(low: f64, high: f64, ends: Ends, count: f64) -> Self {
        let [first, last] = [low, high].map(|value| value.log10().floor() as i32);
        // Parsed from text, because that rounds correctly, which multiplication by a power of ten does not.
        let value = |digit: i32, exponent: i32| format!("{digit}e{exponent}").parse::<f64>().ok();
        let exponents = first - 1..=last + 1;
        let round: Vec<f64> = exponents
            .clone()
            .flat_map(|exponent| [1, 2, 5].map(|digit| value(digit, exponent)))
            .flatten()
            .filter(|value| *value > 0.0 && value.is_finite())
            .collect();
        let (low, high) = match ends {
            Ends::Kept => (low, high),
            Ends::Rounded => (
                round
                    .iter()
                    .rev()
                    .copied()
                    .find(|&tick| tick <= low)
                    .unwrap_or(low),
                round
                    .iter()
                    .copied()
                    .find(|&tick| tick >= high)
                    .unwrap_or(high),
            ),
        };
        // Rounding may have moved a bound off its tick by a little; it counts as on the tick.
        let shown = low * (1.0 - 1e-9)..=high * (1.0 + 1e-9);
        let mut ticks = round;
        ticks.retain(|tick| shown.contains(tick));
        let mut step = 0.0;
        if ticks.len() < 3 && high < 10.0 * low {
            let even = Self::new(low, high, Ticks::Decimal, Ends::Kept, count);
            (ticks, step) = (even.ticks, even.step);
        }
        for every in 1_i32.. {
            if ticks.len() as f64 <= count + 1.0 {
                break;
            }
            let decades = exponents
                .clone()
                .filter(|exponent| exponent.rem_euclid(every) == 0);
            ticks = decades.filter_map(|exponent| value(1, exponent)).collect();
            ticks.retain(|tick| shown.contains(tick));
        }
        Self {
            low,
            high,
            ticks,
            kind: Ticks::Logarithmic,
            step,
        }
    }

    /// Where a value lies between the ends: 0 at the first, 1 at the last. A value more than a million ranges away is moved to
    /// that distance, so that coordinates on the page stay finite.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let logarithmic = self.kind == Ticks::Logarithmic && self.high > (1.0 + 1e-9) * self.low;
        // On a logarithmic axis values that are not positive lie far below all that is shown.
        let position = |value: f64| {
            if logarithmic {
                value.max(f64::MIN_POSITIVE).ln()
            } else {
                value
            }
        };
        let [low, high] = [self.low, self.high].map(position);
        ((position(value) - low) / (high - low)).clamp(-1e6, 1e6)
    }

    /// Writes a tick.
    pub(crate) fn write(&self, value: f64) -> String {
        let unit = unit(self.kind);
        let thirty_seconds = 32.0 * self.step / unit;
        match self.kind {
            Ticks::Decimal => self.decimal(value, unit),
            Ticks::Logarithmic if self.step > 0.0 => self.decimal(value, unit),
            Ticks::Logarithmic => self.decade(value),
            Ticks::Degrees => format!("{}°", self.decimal(value, unit)),
            Ticks::FractionsOfPi if (thirty_seconds - thirty_seconds.round()).abs() < 1e-6 => {
                fraction_of_pi(value)
            }
            Ticks::FractionsOfPi => format!("{}π", self.decimal(value, unit)),
        }
    }

    /// Writes a number with as many decimals as the step needs; very large and very small numbers with a power of ten.
    fn decimal(&self, value: f64, unit: f64) -> String {
        let (value, step) = (value / unit, self.step / unit);
        let largest = self.low.abs().max(self.high.abs()) / unit;
        // Where a sum of steps should be zero, rounding may leave a little of it.
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

    /// Writes a tick of a logarithmic axis: all of them with a power of ten, or none.
    fn decade(&self, value: f64) -> String {
        if self.low >= 0.999e-3 && self.high < 1e5 {
            return format!("{value}");
        }
        let scientific = format!("{value:e}");
        let (digit, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        let power = superscript(exponent);
        if digit == "1" {
            format!("10{power}")
        } else {
            format!("{digit}×10{power}")
        }
    }
}

/// The smallest power of ten, or 2 or 5 times one, that divides a span into `count` steps or fewer.
pub(crate) fn round_step(span: f64, count: f64) -> f64 {
    // A little less, so that rounding does not double a step that fits exactly.
    let wanted = span / count * (1.0 - 1e-9);
    let power = 10f64.powf(wanted.log10().floor());
    let fits = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|digit| digit * power >= wanted);
    power * fits.unwrap_or(10.0)
}

/// A range with a little room at both ends, so that no curve runs along the frame; one that begins near zero begins at
/// zero.
fn with_room(low: f64, high: f64) -> (f64, f64) {
    let room = 0.02 * (high - low);
    let near_zero = (0.0..0.3 * high).contains(&low);
    (if near_zero { 0.0 } else { low - room }, high + room)
}

/// The unit in which the numbers at the ticks are written.
fn unit(kind: Ticks) -> f64 {
    match kind {
        Ticks::Decimal | Ticks::Logarithmic => 1.0,
        Ticks::FractionsOfPi => PI,
        Ticks::Degrees => PI / 180.0,
    }
}

/// The smallest step of the kind that covers the span in at most `count` steps.
fn step(span: f64, kind: Ticks, count: f64) -> f64 {
    let unit = unit(kind);
    let wanted = span / count / unit * (1.0 - 1e-9);
    let usual: &[f64] = match kind {
        Ticks::Decimal | Ticks::Logarithmic => &[],
        Ticks::FractionsOfPi => &[0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 2.0],
        Ticks::Degrees => &[5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0],
    };
    let finest = usual.first().copied().unwrap_or(f64::INFINITY);
    let fits = |step: &f64| *step >= wanted && wanted >= 0.5 * finest;
    let chosen = usual.iter().copied().find(fits);
    unit * chosen.unwrap_or_else(|| round_step(span / unit, count))
}

/// Writes `3π/8` and the like, to the nearest 1/32.
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

/// Replaces hyphens by the minus sign of typography.
fn minus(text: &str) -> String {
    text.replace('-', "−")
}

/// Writes digits and a sign as superscript letters.
fn superscript(text: &str) -> String {
    let letter = |letter: char| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => letter
            .to_digit(10)
            .and_then(|digit| char::from_u32(0x2070 + digit))
            .unwrap_or(letter),
    };
    text.chars().map(letter).collect()
}
