//! Whirl frequencies of the symmetric, uncracked rotor, Eq. (13).

use super::error::{StabilityError, check_coefficients, require};
use crate::equations::{self, Coefficients};

/// Newton steps, each replaced by a bisection where it leaves the bracket: 64 bisections alone reach the last digit.
const STEPS: usize = 100;

/// The four roots ω₁ > 1 > ω₂ > 0 > ω₃ > −1 > ω₄ of $f_n(ω) = (1 − ω^2)(δ + βΩω − ω^2) − γ^2 = 0$ at the speed Ω
/// (any finite number), in units of the reference speed.
///
/// f_n is −γ² at ±1, δ − γ² at 0 and positive far out, so each root has its own bracket. With γ = 0 the inequalities
/// become ≥.
///
/// # Errors
///
/// [`StabilityError::OutOfRange`] for a number that is not finite, [`StabilityError::StiffnessNotPositive`] where
/// δ ≤ γ² (two of the brackets are lost).
pub fn whirl_frequencies(c: &Coefficients, speed: f64) -> Result<[f64; 4], StabilityError> {
    check_coefficients(c)?;
    require("speed", speed, true, "a finite number")?;
    let reserve = equations::coupled_stiffness(c);
    if reserve <= 0.0 {
        return Err(StabilityError::StiffnessNotPositive {
            reserve,
            epsilon_1: 0.0,
            epsilon_12: 0.0,
            epsilon_2: 0.0,
        });
    }
    // Outside of this both factors are large: ω² − 1 and ω² − δ − βΩω exceed |γ| each.
    let gyroscopic = (c.beta * speed).abs();
    let bound = 1.0 + gyroscopic + (1.0 + c.delta + c.gamma.abs()).sqrt();
    Ok([
        root(c, speed, 1.0, bound)?,
        root(c, speed, 1.0, 0.0)?,
        root(c, speed, -1.0, 0.0)?,
        root(c, speed, -1.0, -bound)?,
    ])
}

/// The root between `negative`, where f_n ≤ 0, and `positive`, where f_n > 0.
fn root(
    c: &Coefficients,
    speed: f64,
    mut negative: f64,
    mut positive: f64,
) -> Result<f64, StabilityError> {
    let mut omega = 0.5 * (negative + positive);
    for _ in 0..STEPS {
        let (value, [slope, _]) = equations::f_n::gradient(omega, speed, c);
        if value > 0.0 {
            positive = omega;
        } else {
            negative = omega;
        }
        let newton = omega - value / slope;
        let inside = newton > negative.min(positive) && newton < negative.max(positive);
        let next = if inside {
            newton
        } else {
            0.5 * (negative + positive)
        };
        if (next - omega).abs() <= f64::EPSILON * omega.abs() {
            return Ok(next);
        }
        omega = next;
    }
    Err(StabilityError::NoConvergence {
        what: "a whirl frequency",
        iterations: STEPS,
    })
}
