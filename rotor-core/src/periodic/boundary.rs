//! The ends of an instability region from growth rates.
//!
//! Inside a region the square of the growth rate is a smooth function of the speed, zero at the ends. So the end is
//! extrapolated from a few speeds inside, each nearer to it than the one before. A speed here is whatever number the
//! growth rate depends on; it and the growth rate are in units of a natural frequency of the system, so that both are
//! about 1.
//!
//! Where another way has found the ends, [`confirm`] looks there; what it finds does not depend on them. Where they are
//! not known, [`search`] goes outwards from a speed inside.
//!
//! The solutions of y'' + (a − q²/8 − 2q cos 2t + q²/8 · cos 4t) y = 0 grow for a between 1 − q and 1 + q:
//!
//! ```
//! use nalgebra::DMatrix;
//! use rotor_core::periodic::{FourierMatrix, PeriodicSystem, boundary, hill};
//!
//! let number = |x| DMatrix::from_element(1, 1, x);
//! let q = 0.2;
//! let growth = |a: f64| {
//!     let stiffness = FourierMatrix::constant(number(a - q * q / 8.0))
//!         .with_harmonic(1, number(-2.0 * q), number(0.0))
//!         .with_harmonic(2, number(q * q / 8.0), number(0.0));
//!     hill::growth_rate(&PeriodicSystem::new(2.0, number(1.0), number(0.0), stiffness)?, 8)
//! };
//! let region = boundary::search(growth, 1.0, 0.4)?;
//! assert!((region.lower - (1.0 - q)).abs() < 1e-9 && (region.upper - (1.0 + q)).abs() < 1e-9);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

#[cfg(test)]
mod tests;

use std::ops::RangeInclusive;

use crate::error::{BoundaryError, Error};

/// Growth rates above this are growth, those below are rounding: what an eigenproblem leaves of an undamped stable motion
/// is up to 1e-8, the root of a double number's digits, where two eigenvalues nearly meet. This and the next two are for
/// speeds up to 1, see [`magnitude`].
const GROWS: f64 = 1e-7;
/// What is less than this part of the growth rate in the middle is no growth either: it lies so near to the end that it
/// says nothing about where that is.
const GROWS_OF_MIDDLE: f64 = 1e-5;
/// Regions that grow slower than this in their middle are too narrow to tell their width: a hundred times [`GROWS`].
const TELLS: f64 = 1e-5;
/// How far the square of a growth rate may be off: the ends are then off by this over the square of the region's own
/// growth rate, of the width.
const ROUNDING: f64 = 1e-13;
/// Speeds from the middle to an expected end, as parts of the way: denser towards the end, where the square is straight.
const WAY: [f64; 5] = [0.4, 0.65, 0.8, 0.9, 0.95];
/// Distances beyond an expected end, over the width, at one of which the motion must be stable. The least is what may lie
/// between two regions.
const BEYOND: [f64; 5] = [0.05, 0.01, 2e-3, 4e-4, 1e-4];
/// The first step from a speed inside to an end that is not known, over the approximate width: ten to a half width.
const STEP: f64 = 0.05;
/// How much longer each step is than the one before, so that a far end takes few.
const LONGER: f64 = 1.1;
/// An end further than so many approximate widths is none.
const FURTHEST_WIDTHS: f64 = 100.0;
/// An end further than so many times the start is none.
const FURTHEST_STARTS: f64 = 1e3;
/// Speeds looked at on both sides where the start itself lies outside: a few to each tenth of the width.
const LOOKS: usize = 24;
/// Speeds that an end is extrapolated from. More do not make it better, the oldest lie far off.
const POINTS: usize = 6;
/// How many speeds are tried for an end: a bisection alone would need 52.
const REFINEMENTS: usize = 60;

/// A speed and the square of the growth rate there.
type Sample = (f64, f64);

/// The growth rate at a speed.
type Growth<'a> = &'a dyn Fn(f64) -> Result<f64, Error>;

/// The ends of a region as growth rates show them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Boundary {
    /// The lower end.
    pub lower: f64,
    /// The upper end.
    pub upper: f64,
    /// How far rounding may move the width, over the width.
    pub rounding: f64,
}

impl Boundary {
    /// Upper less lower end.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }
}

/// Whether an error of [`confirm`] speaks against the region that was expected, or against the growth rates. The others only
/// leave open where the ends are.
#[must_use]
pub const fn is_contradiction(error: &Error) -> bool {
    match error {
        Error::Boundary(reason) => matches!(reason, BoundaryError::Contradiction { .. }),
        Error::System(_) => true,
        _ => false,
    }
}

/// The growth rates about one region.
struct Rates<'a> {
    growth: Growth<'a>,
    /// What is above this is growth.
    grows: f64,
}

impl<'a> Rates<'a> {
    /// Looks at the growth rates about a region, with a sample inside it.
    fn about(growth: Growth<'a>, inside: Sample) -> Self {
        let of_middle = GROWS_OF_MIDDLE * inside.1.sqrt();
        Self {
            growth,
            grows: (GROWS * magnitude(inside.0)).max(of_middle),
        }
    }

    /// The square of the growth rate, none where nothing grows.
    fn sample(&self, speed: f64) -> Result<Option<Sample>, Error> {
        let growth = (self.growth)(speed)?;
        Ok((growth > self.grows).then_some((speed, growth * growth)))
    }
}

/// What rounding is in proportion to: the largest numbers of an eigenproblem at this speed.
fn magnitude(speed: f64) -> f64 {
    speed.max(1.0)
}

/// How far rounding may move the width of the region with this sample inside, over the width.
fn rounding(inside: Sample) -> f64 {
    ROUNDING * magnitude(inside.0).powi(2) / inside.1
}

/// The ends of a region by `growth`, where another way says that they are the `expected` ones and that the growth rate
/// is `expected_growth`.
///
/// # Errors
///
/// Where the region is closed, too narrow to tell its width, or another one adjoins it; where the growth rates contradict
/// the expected ones; and those of the growth rates.
pub fn confirm(
    growth: impl Fn(f64) -> Result<f64, Error>,
    expected: RangeInclusive<f64>,
    expected_growth: impl Fn(f64) -> Result<f64, Error>,
) -> Result<Boundary, Error> {
    let (lower, upper) = expected.into_inner();
    let width = upper - lower;
    if width <= 0.0 {
        return Err(BoundaryError::Closed.into());
    }
    let middle = 0.5 * (lower + upper);
    let rate = growth(middle)?;
    let limit = TELLS * magnitude(middle);
    if rate < limit {
        let expected = expected_growth(middle)?;
        return Err(if expected > 2.0 * limit {
            BoundaryError::Contradiction {
                speed: middle,
                growth: rate,
                expected,
            }
        } else {
            BoundaryError::TooNarrow { limit }
        }
        .into());
    }
    let inside = (middle, rate * rate);
    let rates = Rates::about(&growth, inside);
    let end = |expected| end_near(&rates, inside, expected, width, &expected_growth);
    Ok(Boundary {
        lower: end(lower)?,
        upper: end(upper)?,
        rounding: rounding(inside),
    })
}

/// Where growth ends, near to an expected end of a region of the given width.
fn end_near(
    rates: &Rates<'_>,
    inside: Sample,
    expected: f64,
    width: f64,
    expected_growth: Growth<'_>,
) -> Result<f64, Error> {
    let mut samples = vec![inside];
    for part in WAY {
        let speed = inside.0 + part * (expected - inside.0);
        match rates.sample(speed)? {
            Some(sample) => samples.push(sample),
            None => return refine(rates, samples, speed),
        }
    }
    let outwards = width.copysign(expected - inside.0);
    for part in BEYOND {
        let speed = expected + part * outwards;
        // The lower end of a wide region may be near to rest.
        let stands = speed <= 0.0;
        if stands || rates.sample(speed)?.is_none() {
            return refine(rates, samples, speed.max(0.0));
        }
    }
    // Where the expected growth rate goes on as well, another region does.
    for part in BEYOND {
        let speed = expected + part * outwards;
        let growth = (rates.growth)(speed)?;
        let expected = expected_growth(speed)?;
        if (growth - expected).abs() > 0.5 * growth {
            return Err(BoundaryError::Contradiction {
                speed,
                growth,
                expected,
            }
            .into());
        }
    }
    Err(BoundaryError::Adjoined { speed: expected }.into())
}

/// The ends of the region about `start`, of about the given width, where neither is known.
///
/// # Errors
///
/// Where the motion grows nowhere near, or the region has no end near; and those of the growth rates.
pub fn search(
    growth: impl Fn(f64) -> Result<f64, Error>,
    start: f64,
    width: f64,
) -> Result<Boundary, Error> {
    if width <= 0.0 {
        return Err(BoundaryError::NoWidth { width }.into());
    }
    let inside = find_growth(&growth, start, width)?;
    let rates = Rates::about(&growth, inside);
    let reach = (FURTHEST_WIDTHS * width).min(FURTHEST_STARTS * start);
    Ok(Boundary {
        lower: end_within(&rates, inside, -STEP * width, reach)?,
        upper: end_within(&rates, inside, STEP * width, reach)?,
        rounding: rounding(inside),
    })
}

/// A speed at which the motion grows: the start itself or the nearest to it.
fn find_growth(growth: Growth<'_>, start: f64, width: f64) -> Result<Sample, Error> {
    let limit = TELLS * magnitude(start);
    for look in 0..=LOOKS {
        let offset = width * look as f64 / LOOKS as f64;
        for speed in [start + offset, start - offset] {
            let rate = if speed > 0.0 { growth(speed)? } else { 0.0 };
            if rate > limit {
                return Ok((speed, rate * rate));
            }
        }
    }
    Err(BoundaryError::NoGrowth { limit }.into())
}

/// Where growth ends, going from a speed inside in the direction of `step` and no further than `reach`.
fn end_within(rates: &Rates<'_>, inside: Sample, step: f64, reach: f64) -> Result<f64, Error> {
    let mut samples = vec![inside];
    let (mut speed, mut step) = (inside.0 + step, step);
    while speed > 0.0 && (speed - inside.0).abs() <= reach {
        match rates.sample(speed)? {
            Some(sample) => samples.push(sample),
            None => return refine(rates, samples, speed),
        }
        step *= LONGER;
        speed += step;
    }
    Err(BoundaryError::Endless.into())
}

/// The end between the last of the samples and a speed beyond it.
fn refine(rates: &Rates<'_>, mut samples: Vec<Sample>, mut beyond: f64) -> Result<f64, Error> {
    let mut guess = f64::NAN;
    for _ in 0..REFINEMENTS {
        let last = samples.last().map_or(beyond, |sample| sample.0);
        let latest = samples.get(samples.len().saturating_sub(POINTS)..);
        let next = extrapolate(latest.unwrap_or(&samples));
        let between = (next - last) * (next - beyond) <= 0.0;
        if between
            && samples.len() >= POINTS
            && (next - guess).abs() <= 4.0 * f64::EPSILON * next.abs().max(1.0)
        {
            return Ok(next);
        }
        // Near to the guess but inside, or half way where there is no good guess.
        let trial = if between && samples.len() > 2 {
            last + 0.8 * (next - last)
        } else {
            0.5 * (last + beyond)
        };
        if trial == last || trial == beyond {
            break;
        }
        guess = next;
        match rates.sample(trial)? {
            Some(sample) => samples.push(sample),
            None => beyond = trial,
        }
    }
    Ok(samples
        .last()
        .map_or(beyond, |sample| 0.5 * (sample.0 + beyond)))
}

/// The speed at which the square of the growth rate is zero, by Neville's inverse interpolation.
fn extrapolate(samples: &[Sample]) -> f64 {
    let mut speeds: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
    for order in 1..speeds.len() {
        for index in 0..speeds.len() - order {
            let (here, there) = (samples[index].1, samples[index + order].1);
            speeds[index] = (here * speeds[index + 1] - there * speeds[index]) / (here - there);
        }
    }
    speeds.first().copied().unwrap_or(f64::NAN)
}
