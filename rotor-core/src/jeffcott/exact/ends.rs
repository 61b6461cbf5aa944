//! The exact ends of the instability regions.
//!
//! **Simple regions.** In the rotor's frame the static stiffness is $K − Ω^2 J$ with a constant symmetric K and
//! J = diag(1, 1 − β − Δ_d, 1, 1 − β + Δ_d). A SIR ends where it is singular, Φ(Ω, Ω) = 0, so 1/Ω² are the eigenvalues
//! of $L^{-1} J L^{-T}$, $K = L L^T$: a symmetric eigenproblem, in which double roots (zero width) and β = 1 or
//! β = 1 ± Δ_d (1/Ω² = 0, an end at infinity) are nothing special. By Sylvester's law as many ends exist as J has
//! positive entries: two for β > 1 + |Δ_d|, four for β < 1 − |Δ_d|, three between. Sorted, they pair up into regions.
//! Eigenvalues far below the greatest have few digits: each end is improved on Φ(Ω, Ω) in 32 digits, and where these leave
//! something open, as for ends that nearly or quite coincide, whole numbers decide.
//!
//! **Combination regions** are in the source of `combination`: the ends follow from two equations in two unknowns.

use nalgebra::{Matrix4, SymmetricEigen, Vector4};

use super::check_coefficients;
use super::double_double::DoubleDouble;
use super::frequency_equation::{simple_coefficients, simple_size, sine_and_cosine_of_double};
use super::regions::simple_boundaries;
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

/// Steps that improve one end; two or three are common.
const STEPS: usize = 8;
/// A bound on the rounding of a sum in 32 digits, in parts of the sizes of its terms: some tens of roundings of 2⁻¹⁰⁴ each.
const ROUNDING: f64 = 1.0 / (1_u128 << 98) as f64;
/// What rounding may do to the square of an end, in parts of it: less than a double shows.
const KNOWN: f64 = 0.125 * f64::EPSILON;
/// Ends that are nearer to each other, in parts of their squares, are left to whole numbers.
const APART: f64 = 1e-9;

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
    let powers = simple_coefficients(c);
    let nearest = inverse_squares.iter().take(number_of_ends(c));
    let improved: Option<Vec<f64>> = nearest
        .map(|value| improved(c, &powers, value.recip()))
        .collect();
    let are_apart = |squares: &Vec<f64>| {
        let mut neighbours = squares.windows(2);
        neighbours.all(|pair| pair[1] - pair[0] > APART * pair[1])
    };
    match improved.filter(are_apart) {
        Some(squares) => Ok(squares.into_iter().map(f64::sqrt).collect()),
        None => Ok(simple_boundaries(c)),
    }
}

/// How many entries of J are positive, without rounding.
fn number_of_ends(c: &Coefficients) -> usize {
    let rest = DoubleDouble::from(1.0) + -c.beta;
    let tilting = [c.disk_asymmetry, -c.disk_asymmetry];
    let positive = tilting
        .iter()
        .filter(|&asymmetry| (rest + *asymmetry).rounded() > 0.0);
    2 + positive.count()
}

/// The square of an end, by Newton's iteration in 32 digits from one that is nearly right; none where even these may not tell
/// it to the last digit of a double.
fn improved(c: &Coefficients, powers: &[DoubleDouble; 5], start: f64) -> Option<f64> {
    let mut square = DoubleDouble::from(start);
    for _ in 0..STEPS {
        let (mut value, mut slope) = (DoubleDouble::ZERO, DoubleDouble::ZERO);
        for power in powers.iter().rev() {
            slope = slope * square + value;
            value = value * square + *power;
        }
        let step = value.rounded() / slope.rounded();
        square = square + -step;
        let size = square.rounded();
        // Not a number where the start is none.
        if step.abs() <= KNOWN * size {
            let unknown = ROUNDING * simple_size(c, size);
            return (unknown <= KNOWN * size * slope.rounded().abs()).then_some(size);
        }
    }
    None
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
