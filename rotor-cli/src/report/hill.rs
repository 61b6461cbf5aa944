//! The ends of an instability region from growth rates by Hill's method alone: no use is made of the exact ends.
//!
//! Inside a region the square of the growth rate is a smooth function of the speed, zero at the ends. So the end is
//! extrapolated from a few speeds inside, each nearer to it than the one before.

use rotor_core::equations::Coefficients;
use rotor_core::stability::{Ends, PeriodicSystem, hill};

/// Harmonics on each side; this system needs one, with none the instability is missed.
const HARMONICS: usize = 1;
/// Growth rates above this are growth, those below are rounding.
const GROWS: f64 = 1e-6;
/// Regions that grow slower than this at their start are too narrow to tell their width: the square of a growth rate
/// is good to about 1e-14, the ends are then good to about 1e-6 of the width.
const TELLS: f64 = 1e-4;
/// Steps from the start to the end, over the approximate width; and how many are tried.
const STEP: f64 = 0.2;
const STEPS: usize = 200;
/// Speeds looked at on both sides where the start itself lies outside.
const LOOKS: usize = 24;
/// Speeds that an end is extrapolated from, and how many are tried.
const POINTS: usize = 6;
const REFINEMENTS: usize = 60;

/// A speed and the square of the growth rate there.
type Sample = (f64, f64);

/// The ends of the region about `start`, of about the given width, in units of the reference speed.
///
/// # Errors
///
/// Where the motion grows nowhere near (the region is closed or too narrow to tell), or the region has no end near.
pub(crate) fn ends(c: &Coefficients, start: f64, width: f64) -> Result<Ends, String> {
    let inside = inside(c, start, width)?;
    Ok(Ends {
        lower: end(c, inside, -STEP * width)?,
        upper: end(c, inside, STEP * width)?,
    })
}

/// The square of the growth rate, none where nothing grows.
fn growth(c: &Coefficients, speed: f64) -> Result<Option<Sample>, String> {
    let growth =
        PeriodicSystem::rotor(c, speed).and_then(|system| hill::growth_rate(&system, HARMONICS));
    let growth = growth.map_err(|error| error.to_string())?;
    Ok((growth > GROWS).then_some((speed, growth * growth)))
}

/// A speed at which the motion grows: the start itself or the nearest to it.
fn inside(c: &Coefficients, start: f64, width: f64) -> Result<Sample, String> {
    for look in 0..=LOOKS {
        let offset = width * look as f64 / LOOKS as f64;
        for speed in [start + offset, start - offset] {
            if speed > 0.0
                && let Some(sample) = growth(c, speed)?
                && sample.1 > TELLS * TELLS
            {
                return Ok(sample);
            }
        }
    }
    Err(format!(
        "no growth rate near its start is above {TELLS:e}: it is closed, or too narrow to tell"
    ))
}

/// Where growth ends, going from a speed inside in the direction of `step`.
fn end(c: &Coefficients, inside: Sample, step: f64) -> Result<f64, String> {
    let mut samples = vec![inside];
    let mut beyond = None;
    let (mut speed, mut step) = (inside.0, step);
    for _ in 0..STEPS {
        speed += step;
        if speed <= 0.0 {
            break;
        }
        match growth(c, speed)? {
            Some(sample) => samples.push(sample),
            None => {
                beyond = Some(speed);
                break;
            }
        }
        step *= 1.1;
    }
    let beyond = beyond.ok_or("the motion grows at every speed on one side: there is no end")?;
    refined(c, samples, beyond)
}

/// The end between the last of the samples and a speed beyond it.
fn refined(c: &Coefficients, mut samples: Vec<Sample>, mut beyond: f64) -> Result<f64, String> {
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
        match growth(c, trial)? {
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
    use rotor_core::region::{self, RegionKind};
    use rotor_core::rotor::Rotor;

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
                let rotor = Rotor::default()
                    .with(|p| {
                        p.crack_depth_ratio = depth;
                        p.crack_angle = angle;
                    })
                    .unwrap();
                let c = rotor.coefficients().unwrap();
                let exact = region::exact_ends(kind, &c).unwrap();
                let start = region::start(kind, &c).unwrap();
                let hill = ends(&c, start, region::width(kind, &c).unwrap()).unwrap();
                let difference = hill.width() / exact.width() - 1.0;
                assert!(
                    difference.abs() < 1e-8,
                    "{kind} {depth} {angle}: {difference:e}"
                );
            }
        }
    }

    #[test]
    fn a_closed_region_is_told_apart_from_a_narrow_one() {
        let rotor = Rotor::default()
            .with(|p| {
                p.crack_depth_ratio = 0.0;
                p.disk_asymmetry = 0.0;
            })
            .unwrap();
        let c = rotor.coefficients().unwrap();
        assert!(ends(&c, region::start(RegionKind::Simple, &c).unwrap(), 1e-3).is_err());
    }
}
