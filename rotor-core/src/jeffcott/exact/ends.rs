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

use super::check_coefficients;
use super::frequency_equation::sine_and_cosine_of_double;
use crate::equations::{self, Coefficients};
use crate::error::{Error, RegionError, SystemError};

/// The two ends of an instability region, in units of the reference speed; `lower <= upper`, equal at an exact zero
/// unstable point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

/// Every speed at which a simple region ends, ascending: up to four. The first and second are the ends of a region, and so
/// are the third and fourth; a last one without a partner is the lower end of a region that reaches to infinite speed.
/// Where two regions overlap, the motion between the second and the third is unstable too.
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for coefficients that are not finite, [`RegionError::StiffnessNotPositive`] for a
/// shaft that gives way at rest, [`SystemError::NoConvergence`].
pub fn simple_region_ends(c: &Coefficients) -> Result<Vec<f64>, Error> {
    check_coefficients(c)?;
    let inverse_squares = inverse_square_speeds(c)?;
    // Infinite at an inverse square of zero; not a number below.
    let speeds = inverse_squares.iter().map(|value| value.sqrt().recip());
    Ok(speeds.filter(|speed| speed.is_finite()).collect())
}

/// The eigenvalues 1/Ω² of the pencil (J, K), descending.
fn inverse_square_speeds(c: &Coefficients) -> Result<Vector4<f64>, Error> {
    let [sine, cosine] = sine_and_cosine_of_double(c.crack_angle);
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
    let inverse = inverse.ok_or(RegionError::StiffnessNotPositive {
        reserve: equations::coupled_stiffness(c),
        epsilon_1: c.epsilon_1,
        epsilon_12: c.epsilon_12,
        epsilon_2: c.epsilon_2,
    })?;
    let pencil = inverse * inertia * inverse.transpose();
    let eigen = SymmetricEigen::try_new(pencil, f64::EPSILON, SWEEPS).ok_or(
        SystemError::NoConvergence {
            what: "the ends of the simple regions",
            iterations: SWEEPS,
        },
    )?;
    let mut values = eigen.eigenvalues;
    values.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
    Ok(values)
}
