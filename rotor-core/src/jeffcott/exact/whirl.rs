//! Whirl frequencies of the symmetric, uncracked rotor, Eq. (13).

use super::check_coefficients;
use crate::equations::{self, Coefficients};
use crate::error::{Error, RegionError, SystemError, require};

/// Cap on steps, each of which at least halves the step before it or the bracket; 10 are common.
const STEPS: usize = 200;
/// A gyroscopic term this much larger than the stiffness leaves each root to its first two terms: the third is 1e-18 of it.
const FAST: f64 = 1e9;

/// The four roots ω₁ > 1 > ω₂ > 0 > ω₃ > −1 > ω₄ of $f_n(ω) = (1 − ω^2)(δ + βΩω − ω^2) − γ^2 = 0$ at the speed Ω
/// (any finite number), in units of the reference speed.
///
/// f_n is −γ² at ±1, δ − γ² at 0 and positive far out, so each root has its own bracket. With γ = 0 the inequalities
/// become ≥, and two of the roots are ±1 exactly.
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for a number that is not finite, [`RegionError::StiffnessNotPositive`] where
/// δ ≤ γ² (two of the brackets are lost).
pub fn whirl_frequencies(c: &Coefficients, speed: f64) -> Result<[f64; 4], Error> {
    check_coefficients(c)?;
    require("speed", speed, true, "a finite number")?;
    let reserve = equations::coupled_stiffness(c);
    if reserve <= 0.0 {
        return Err(RegionError::StiffnessNotPositive {
            reserve,
            epsilon_1: 0.0,
            epsilon_12: 0.0,
            epsilon_2: 0.0,
        }
        .into());
    }
    let gyroscopic = require(
        "beta times the speed",
        c.beta * speed,
        true,
        "a finite number",
    )?;
    if c.gamma * c.gamma == 0.0 {
        return Ok(uncoupled(c.delta, gyroscopic));
    }
    // Outside of this both factors are large: ω² − 1 and ω² − δ exceed |γ| each. On the side on which the gyroscopic
    // term counts against them it has to be left behind, too.
    let stiffness = 1.0 + (1.0 + c.delta + c.gamma.abs()).sqrt();
    if gyroscopic.abs() > FAST * stiffness * stiffness {
        return Ok(fast(c, gyroscopic));
    }
    let outer = |side: f64| side * ((side * gyroscopic).max(0.0) + stiffness);
    Ok([
        root(c, speed, 1.0, outer(1.0))?,
        root(c, speed, 1.0, 0.0)?,
        root(c, speed, -1.0, 0.0)?,
        root(c, speed, -1.0, outer(-1.0))?,
    ])
}

/// The roots at a high speed, in falling order: the disk's gyroscopic whirl βΩ + δ/βΩ, its precession −(δ − γ²)/βΩ, and the
/// shaft with a disk that does not tilt, ±1, where H is γ²/G.
fn fast(c: &Coefficients, gyroscopic: f64) -> [f64; 4] {
    let shaft = |side: f64| {
        let h = c.gamma * c.gamma / (c.delta - 1.0 + side * gyroscopic);
        side * (1.0 - 0.5 * h)
    };
    let mut roots = [
        gyroscopic + c.delta / gyroscopic,
        -equations::coupled_stiffness(c) / gyroscopic,
        shaft(1.0),
        shaft(-1.0),
    ];
    roots.sort_by(|a, b| b.total_cmp(a));
    roots
}

/// The roots at γ = 0, of displacement and of tilt, in falling order.
fn uncoupled(delta: f64, gyroscopic: f64) -> [f64; 4] {
    let half = 0.5 * gyroscopic;
    // The root that is no difference, and the other one from their product −δ.
    let larger = half + half.hypot(delta.sqrt()).copysign(half);
    let mut roots = [1.0, -1.0, larger, -delta / larger];
    roots.sort_by(|a, b| b.total_cmp(a));
    roots
}

/// The root between `negative`, where f_n ≤ 0, and `positive`, where f_n > 0.
fn root(c: &Coefficients, speed: f64, mut negative: f64, mut positive: f64) -> Result<f64, Error> {
    let mut omega = 0.5 * (negative + positive);
    let mut last = (positive - negative).abs();
    for _ in 0..STEPS {
        let (value, [slope, _]) = equations::f_n::gradient(omega, speed, c);
        if value > 0.0 {
            positive = omega;
        } else {
            negative = omega;
        }
        let newton = omega - value / slope;
        let inside = newton > negative.min(positive) && newton < negative.max(positive);
        // A Newton step may creep along a flat part inside the bracket.
        let next = if inside && (newton - omega).abs() <= 0.5 * last {
            newton
        } else {
            0.5 * (negative + positive)
        };
        last = (next - omega).abs();
        if last <= f64::EPSILON * omega.abs() || next == negative || next == positive {
            return Ok(next);
        }
        omega = next;
    }
    Err(SystemError::NoConvergence {
        what: "a whirl frequency",
        iterations: STEPS,
    }
    .into())
}
