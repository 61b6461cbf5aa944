//! The ends of an instability region from growth rates by Hill's method.
//!
//! Inside a region the square of the growth rate is a smooth function of the speed, zero at the ends. So the end is
//! extrapolated from a few speeds inside, each nearer to it than the one before. Where the exact ends are known they say
//! where to look, and how wide a gap to a neighbour may be; what is found there does not depend on them.

use rotor_core::equations::Coefficients;
use rotor_core::error::StabilityError;
use rotor_core::jeffcott::exact::{self, Ends};
use rotor_core::model::Model;
use rotor_core::periodic::hill;
use thiserror::Error;

/// Harmonics on each side; this system needs one, with none the instability is missed.
const HARMONICS: usize = 1;
/// Growth rates above this are growth, those below are rounding; and the same over the growth rate in the middle. This
/// and the next two are for speeds up to the reference speed, see [`magnitude`].
const GROWS: (f64, f64) = (1e-7, 1e-5);
/// Regions that grow slower than this in their middle are too narrow to tell their width.
const TELLS: f64 = 1e-5;
/// How far the square of a growth rate may be off: the ends are then off by this over the square of the region's own
/// growth rate, of the width.
const ROUNDING: f64 = 1e-13;
/// Speeds from the middle to an exact end, as parts of the way.
const WAY: [f64; 5] = [0.4, 0.65, 0.8, 0.9, 0.95];
/// Distances beyond an exact end, over the width, at one of which the motion must be stable.
const BEYOND: [f64; 5] = [0.05, 0.01, 2e-3, 4e-4, 1e-4];
/// The first step from the start to an end that is not known, over the approximate width, and how much longer each is
/// than the one before.
const STEP: f64 = 0.05;
const LONGER: f64 = 1.1;
/// An end further than this is none: over the approximate width, and over the start.
const FURTHEST: (f64, f64) = (100.0, 1e3);
/// Speeds looked at on both sides where the start itself lies outside.
const LOOKS: usize = 24;
/// Speeds that an end is extrapolated from, and how many are tried.
const POINTS: usize = 6;
const REFINEMENTS: usize = 60;

/// A speed and the square of the growth rate there.
type Sample = (f64, f64);

/// The growth rates about one region.
struct Rates<'a> {
    c: &'a Coefficients,
    /// What is above this is growth.
    grows: f64,
}

impl<'a> Rates<'a> {
    /// Of the region with this sample inside.
    fn about(c: &'a Coefficients, inside: Sample) -> Self {
        Self {
            c,
            grows: (GROWS.0 * magnitude(inside.0)).max(GROWS.1 * inside.1.sqrt()),
        }
    }

    /// The square of the growth rate, none where nothing grows.
    fn sample(&self, speed: f64) -> Result<Option<Sample>, StabilityError> {
        let growth = growth_rate(self.c, speed)?;
        Ok((growth > self.grows).then_some((speed, growth * growth)))
    }
}

/// The ends of a region by Hill's method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HillEnds {
    /// The ends, in units of the reference speed.
    pub(crate) ends: Ends,
    /// How far rounding may move the width, over the width.
    pub(crate) rounding: f64,
}

/// Why there are no ends by Hill's method.
#[derive(Clone, Debug, Error)]
pub(crate) enum NoHillEnds {
    /// The growth rates do not tell them.
    #[error("{0}")]
    Untold(String),
    /// Hill's growth rates are not those of the exact region.
    #[error("at {speed} × ω_st its growth rate is {hill:.3e} and the exact one {exact:.3e}")]
    Contradiction {
        /// The speed, in units of the reference speed.
        speed: f64,
        /// Hill's growth rate.
        hill: f64,
        /// The exact growth rate.
        exact: f64,
    },
    /// Hill's method itself failed.
    #[error(transparent)]
    Failed(#[from] StabilityError),
}

impl NoHillEnds {
    fn untold(why: impl Into<String>) -> Self {
        Self::Untold(why.into())
    }
}

/// What rounding is in proportion to: the largest numbers of Hill's matrix, over the reference speed.
fn magnitude(speed: f64) -> f64 {
    speed.max(1.0)
}

/// The ends of the region that has the given exact ends.
///
/// # Errors
///
/// Where the region is closed, too narrow to tell its width, or another one adjoins it; and where Hill's growth rates
/// contradict the exact ends.
pub(crate) fn ends_near(c: &Coefficients, exact: Ends) -> Result<HillEnds, NoHillEnds> {
    if exact.width() <= 0.0 {
        return Err(NoHillEnds::untold(
            "the region is closed, its exact width is 0",
        ));
    }
    let middle = 0.5 * (exact.lower + exact.upper);
    let growth = growth_rate(c, middle)?;
    let tells = TELLS * magnitude(middle);
    if growth < tells {
        let exact = exact::growth_rate(c, middle)?;
        if exact > 2.0 * tells {
            return Err(NoHillEnds::Contradiction {
                speed: middle,
                hill: growth,
                exact,
            });
        }
        return Err(NoHillEnds::Untold(format!(
            "the region is too narrow to tell, its growth rate is below {tells:.0e}"
        )));
    }
    let inside = (middle, growth * growth);
    let rates = Rates::about(c, inside);
    Ok(HillEnds {
        ends: Ends {
            lower: end_near(&rates, inside, exact.lower, exact.width())?,
            upper: end_near(&rates, inside, exact.upper, exact.width())?,
        },
        rounding: ROUNDING * magnitude(inside.0).powi(2) / inside.1,
    })
}

/// Where growth ends, near to an exact end of a region of the given width.
fn end_near(rates: &Rates<'_>, inside: Sample, exact: f64, width: f64) -> Result<f64, NoHillEnds> {
    let mut samples = vec![inside];
    for part in WAY {
        let speed = inside.0 + part * (exact - inside.0);
        match rates.sample(speed)? {
            Some(sample) => samples.push(sample),
            None => return Ok(refined(rates, samples, speed)?),
        }
    }
    let outwards = width.copysign(exact - inside.0);
    for part in BEYOND {
        let speed = exact + part * outwards;
        // The lower end of a wide region may be near to rest.
        let stands = speed <= 0.0;
        if stands || rates.sample(speed)?.is_none() {
            return Ok(refined(rates, samples, speed.max(0.0))?);
        }
    }
    // Where the exact growth rate goes on as well, another region does.
    for part in BEYOND {
        let speed = exact + part * outwards;
        let hill = growth_rate(rates.c, speed)?;
        let exact = exact::growth_rate(rates.c, speed)?;
        if (hill - exact).abs() > 0.5 * hill {
            return Err(NoHillEnds::Contradiction { speed, hill, exact });
        }
    }
    Err(NoHillEnds::Untold(format!(
        "another region adjoins at {exact:.6} × ω_st, growth rates do not tell the two apart"
    )))
}

/// The ends of the region about `start`, of about the given width, where the exact ones are not known.
///
/// # Errors
///
/// Where the motion grows nowhere near, or the region has no end near.
pub(crate) fn ends_about(c: &Coefficients, start: f64, width: f64) -> Result<HillEnds, NoHillEnds> {
    if width <= 0.0 {
        return Err(NoHillEnds::untold(
            "the region is closed, its width by Eq. (31) is 0",
        ));
    }
    let inside = near(c, start, width)?;
    let rates = Rates::about(c, inside);
    let reach = (FURTHEST.0 * width).min(FURTHEST.1 * start);
    Ok(HillEnds {
        ends: Ends {
            lower: end_within(&rates, inside, -STEP * width, reach)?,
            upper: end_within(&rates, inside, STEP * width, reach)?,
        },
        rounding: ROUNDING * magnitude(inside.0).powi(2) / inside.1,
    })
}

/// A speed at which the motion grows: the start itself or the nearest to it.
fn near(c: &Coefficients, start: f64, width: f64) -> Result<Sample, NoHillEnds> {
    for look in 0..=LOOKS {
        let offset = width * look as f64 / LOOKS as f64;
        for speed in [start + offset, start - offset] {
            let growth = if speed > 0.0 {
                growth_rate(c, speed)?
            } else {
                0.0
            };
            if growth > TELLS * magnitude(start) {
                return Ok((speed, growth * growth));
            }
        }
    }
    Err(NoHillEnds::Untold(format!(
        "within a width of the region's start no growth rate is above {:.0e}",
        TELLS * magnitude(start)
    )))
}

/// Where growth ends, going from a speed inside in the direction of `step` and no further than `reach`.
fn end_within(rates: &Rates<'_>, inside: Sample, step: f64, reach: f64) -> Result<f64, NoHillEnds> {
    let mut samples = vec![inside];
    let (mut speed, mut step) = (inside.0 + step, step);
    while speed > 0.0 && (speed - inside.0).abs() <= reach {
        match rates.sample(speed)? {
            Some(sample) => samples.push(sample),
            None => return Ok(refined(rates, samples, speed)?),
        }
        step *= LONGER;
        speed += step;
    }
    Err(NoHillEnds::untold(
        "the motion grows at every speed on one side, there is no end",
    ))
}

/// The growth rate by Hill's method.
fn growth_rate(c: &Coefficients, speed: f64) -> Result<f64, StabilityError> {
    hill::growth_rate(&c.system(speed)?, HARMONICS)
}

/// The end between the last of the samples and a speed beyond it.
fn refined(
    rates: &Rates<'_>,
    mut samples: Vec<Sample>,
    mut beyond: f64,
) -> Result<f64, StabilityError> {
    let mut guess = f64::NAN;
    for _ in 0..REFINEMENTS {
        let last = samples.last().map_or(beyond, |sample| sample.0);
        let next = extrapolated(
            samples
                .get(samples.len().saturating_sub(POINTS)..)
                .unwrap_or(&samples),
        );
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
fn extrapolated(samples: &[Sample]) -> f64 {
    let mut speeds: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
    for order in 1..speeds.len() {
        for index in 0..speeds.len() - order {
            let (here, there) = (samples[index].1, samples[index + order].1);
            speeds[index] = (here * speeds[index + 1] - there * speeds[index]) / (here - there);
        }
    }
    speeds.first().copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotor_core::input::RotorParameters;
    use rotor_core::jeffcott::region::{self, RegionKind};
    use rotor_core::jeffcott::rotor::Rotor;

    fn coefficients(change: impl FnOnce(&mut RotorParameters)) -> Coefficients {
        Rotor::default()
            .with(change)
            .unwrap()
            .coefficients()
            .unwrap()
    }

    #[test]
    fn neville_finds_the_zero_of_a_parabola_from_three_of_its_points() {
        // The inverse of y = 4 - x is a line, that of y = √(4 - x) is a parabola.
        let samples = [0.0_f64, 1.0, 3.0].map(|x| (x, (4.0 - x).sqrt()));
        assert!((extrapolated(&samples) - 4.0).abs() < 1e-14);
    }

    #[test]
    fn ends_by_hill_are_the_exact_ones_over_angles_and_depths() {
        for kind in [RegionKind::Simple, RegionKind::Combination] {
            for (depth, angle) in [(0.05, 0.3), (0.2, 0.0), (0.2, 1.5), (0.3, 0.8), (0.4, 1.2)] {
                let c = coefficients(|p| (p.crack_depth_ratio, p.crack_angle) = (depth, angle));
                let exact = region::exact_ends(kind, &c).unwrap();
                let (start, width) = (region::start(kind, &c), region::width(kind, &c));
                for hill in [
                    ends_near(&c, exact).unwrap(),
                    ends_about(&c, start.unwrap(), width.unwrap()).unwrap(),
                ] {
                    let difference = hill.ends.width() / exact.width() - 1.0;
                    assert!(
                        difference.abs() < 1e-8,
                        "{kind} {depth} {angle}: {difference:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn ends_do_not_follow_exact_ones_that_are_wrong() {
        let c = Rotor::default().coefficients().unwrap();
        let exact = region::exact_ends(RegionKind::Simple, &c).unwrap();
        let moved = |part: f64| Ends {
            upper: exact.upper + part * exact.width(),
            ..exact
        };
        for part in [-0.03, -1e-3, 1e-3, 0.1, 0.4] {
            let hill = ends_near(&c, moved(part)).unwrap().ends;
            assert!(
                (hill.upper - exact.upper).abs() < 1e-8 * exact.width(),
                "{part}"
            );
        }
        let far = ends_near(&c, moved(-0.3)).unwrap_err();
        assert!(matches!(far, NoHillEnds::Untold(_)), "{far}");
        let elsewhere = Ends {
            lower: exact.lower + 2.0 * exact.width(),
            upper: exact.upper + 2.0 * exact.width(),
        };
        assert!(ends_near(&c, elsewhere).is_err());
    }

    #[test]
    fn a_closed_region_is_told_apart_from_a_narrow_one() {
        let closed = Ends {
            lower: 0.7,
            upper: 0.7,
        };
        let c = coefficients(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 0.0));
        let why = ends_near(&c, closed).unwrap_err().to_string();
        assert!(why.contains("is closed"), "{why}");
        let c = coefficients(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 1e-5));
        let narrow = region::exact_ends(RegionKind::Simple, &c).unwrap();
        let why = ends_near(&c, narrow).unwrap_err().to_string();
        assert!(why.contains("too narrow"), "{why}");
    }

    #[test]
    fn an_end_that_is_not_near_is_none() {
        // From 2.48 upwards the motion grows at every speed.
        let c = coefficients(|p| p.disk_polar_inertia = 0.95 * p.disk_diametral_inertia);
        let kind = RegionKind::UpperSimple;
        let start = region::start(kind, &c).unwrap();
        let why = ends_about(&c, start, region::width(kind, &c).unwrap()).unwrap_err();
        assert!(why.to_string().contains("there is no end"), "{why}");
    }
}
