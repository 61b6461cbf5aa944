//! The exact ends of the instability regions.
//!
//! **Simple regions.** In the rotor's frame the static stiffness is $K − Ω^2 J$ with a constant symmetric K and
//! J = diag(1, 1 − β − Δ_d, 1, 1 − β + Δ_d). A SIR ends where it is singular, Φ(Ω, Ω) = 0, so 1/Ω² are the eigenvalues
//! of $L^{-1} J L^{-T}$, $K = L L^T$: a symmetric eigenproblem, in which double roots (zero width) and β = 1 or
//! β = 1 ± Δ_d (1/Ω² = 0, an end at infinity) are nothing special. By Sylvester's law as many ends exist as J has
//! positive entries: two for β > 1 + |Δ_d|, four for β < 1 − |Δ_d|, three between. Sorted, they pair up into regions.
//!
//! **Combination regions** are in the source of `combination`: the ends follow from two equations in two unknowns.

use nalgebra::{Matrix4, SymmetricEigen, Vector4};

use super::error::{StabilityError, check_coefficients, require};
use crate::equations::Coefficients;

/// The two ends of an instability region, in units of the reference speed; `lower <= upper`, equal at an exact zero
/// unstable point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// The speed at which the region starts.
    pub lower: f64,
    /// The speed at which it ends.
    pub upper: f64,
}

impl Ends {
    /// The exact width, upper less lower, in units of the reference speed.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }
}

/// Cap on the QR sweeps of the symmetric eigenproblem.
const SWEEPS: usize = 200;

/// The ends of all simple regions, ascending: (0.. ) pairs (lower, upper) as they come, and the lower end of a region
/// that reaches to infinite speed, if there is one.
///
/// # Errors
///
/// [`StabilityError::OutOfRange`] for coefficients that are not finite, [`StabilityError::StiffnessNotPositive`] for a
/// shaft that gives way at rest, [`StabilityError::NoConvergence`].
pub fn simple_region_ends(
    c: &Coefficients,
) -> Result<([Option<Ends>; 2], Option<f64>), StabilityError> {
    check_coefficients(c)?;
    let inverse_squares = inverse_square_speeds(c)?;
    let speed = |index: usize| inverse_squares[index].sqrt().recip();
    // Infinite at an inverse square of zero; not a number below.
    let [first, second, third, fourth] = [speed(0), speed(1), speed(2), speed(3)];
    let regions = [(first, second), (third, fourth)];
    let closed = regions.map(|(lower, upper)| upper.is_finite().then_some(Ends { lower, upper }));
    let open = regions
        .into_iter()
        .find(|(lower, upper)| lower.is_finite() && !upper.is_finite());
    Ok((closed, open.map(|(lower, _)| lower)))
}

/// The eigenvalues 1/Ω² of the pencil (J, K), descending.
fn inverse_square_speeds(c: &Coefficients) -> Result<Vector4<f64>, StabilityError> {
    let (sine, cosine) = (2.0 * c.crack_angle).sin_cos();
    let k = |sign: f64, epsilon: f64| 1.0 + sign * cosine * epsilon;
    let (e1, e12, e2) = (
        sine * c.epsilon_1,
        sine * c.epsilon_12 * c.gamma,
        sine * c.epsilon_2 * c.delta,
    );
    let coupling = |sign: f64| c.gamma * k(sign, c.epsilon_12);
    let tilting = |sign: f64| c.delta * k(sign, c.epsilon_2);
    #[rustfmt::skip]
    let stiffness = Matrix4::new(
        k(1.0, c.epsilon_1), coupling(1.0), -e1, -e12,
        coupling(1.0), tilting(1.0), -e12, -e2,
        -e1, -e12, k(-1.0, c.epsilon_1), coupling(-1.0),
        -e12, -e2, coupling(-1.0), tilting(-1.0),
    );
    let inertia = Matrix4::from_diagonal(&Vector4::new(
        1.0,
        1.0 - c.beta - c.disk_asymmetry,
        1.0,
        1.0 - c.beta + c.disk_asymmetry,
    ));
    let inverse = stiffness
        .cholesky()
        .and_then(|cholesky| cholesky.l().try_inverse());
    let inverse = inverse.ok_or(StabilityError::StiffnessNotPositive {
        reserve: c.delta - c.gamma * c.gamma,
        epsilon_1: c.epsilon_1,
        epsilon_12: c.epsilon_12,
        epsilon_2: c.epsilon_2,
    })?;
    let pencil = inverse * inertia * inverse.transpose();
    let eigen = SymmetricEigen::try_new(pencil, f64::EPSILON, SWEEPS).ok_or(
        StabilityError::NoConvergence {
            what: "the ends of the simple regions",
            iterations: SWEEPS,
        },
    )?;
    let mut values = eigen.eigenvalues;
    values.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
    Ok(values)
}

/// The exact ends of the simple region (SIR) nearest to `start`, the speed Ω_s of Eq. (15).
///
/// # Errors
///
/// [`StabilityError::OutOfRange`] for a `start` that is not positive and finite or coefficients that are not finite;
/// [`StabilityError::StiffnessNotPositive`]; [`StabilityError::Unbounded`] where the nearest region has no upper end.
pub fn simple_ends(c: &Coefficients, start: f64) -> Result<Ends, StabilityError> {
    require("start", start, start > 0.0, "a positive number")?;
    let (closed, open) = simple_region_ends(c)?;
    let distance = |ends: &Ends| (ends.lower - start).max(start - ends.upper).max(0.0);
    let nearest = closed
        .into_iter()
        .flatten()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest_distance = nearest.as_ref().map_or(f64::INFINITY, distance);
    match (nearest, open) {
        (_, Some(lower)) if lower - start < nearest_distance => {
            Err(StabilityError::Unbounded { lower })
        }
        (Some(ends), _) => Ok(ends),
        (None, _) => Err(StabilityError::NoRegion {
            kind: "simple",
            reason: "no positive speed solves Phi = 0",
        }),
    }
}
