//! What can be wrong with a question about stability.

use thiserror::Error;

/// Why a growth rate, a frequency or a region's end could not be given.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StabilityError {
    /// A number lies outside the range in which the question has a meaning.
    #[error("{quantity} is {value}; allowed: {allowed}")]
    OutOfRange {
        /// The quantity's name.
        quantity: &'static str,
        /// The value given.
        value: f64,
        /// The allowed values, in words.
        allowed: &'static str,
    },
    /// The stiffness matrix in the rotor's frame is not positive definite: the shaft gives way at rest.
    #[error(
        "the stiffness is not positive definite: delta - gamma^2 = {reserve} with epsilon_1 = {epsilon_1}, epsilon_12 = {epsilon_12}, epsilon_2 = {epsilon_2}"
    )]
    StiffnessNotPositive {
        /// δ − γ², which must be positive.
        reserve: f64,
        /// ε₁.
        epsilon_1: f64,
        /// ε₁₂.
        epsilon_12: f64,
        /// ε₂.
        epsilon_2: f64,
    },
    /// No region of this kind exists for these coefficients.
    #[error("no {kind} instability region: {reason}")]
    NoRegion {
        /// `"simple"` or `"combination"`.
        kind: &'static str,
        /// What rules it out.
        reason: &'static str,
    },
    /// The region reaches to infinite speed.
    #[error(
        "the simple instability region from speed {lower} upwards has no upper end (the disk's asymmetry exceeds |beta - 1|)"
    )]
    Unbounded {
        /// Its lower end, in units of the reference speed.
        lower: f64,
    },
    /// An iteration stopped at its cap.
    #[error("{what} did not converge in {iterations} iterations")]
    NoConvergence {
        /// What was being computed.
        what: &'static str,
        /// The cap.
        iterations: usize,
    },
    /// A matrix of a periodic system has the wrong shape.
    #[error(
        "the {matrix} matrix has the shape {rows} x {columns}; {expected} x {expected} is needed"
    )]
    Shape {
        /// Which matrix.
        matrix: &'static str,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
        /// The number of degrees of freedom.
        expected: usize,
    },
    /// The mass matrix cannot be inverted.
    #[error("the mass matrix is singular at time {time}")]
    SingularMass {
        /// The time, in units of the inverse reference speed (0 for the matrix of all harmonics together).
        time: f64,
    },
}

/// Answers `value` where it is finite and `holds`, else an error that names it.
pub(crate) fn require(
    quantity: &'static str,
    value: f64,
    holds: bool,
    allowed: &'static str,
) -> Result<f64, StabilityError> {
    if value.is_finite() && holds {
        Ok(value)
    } else {
        Err(StabilityError::OutOfRange {
            quantity,
            value,
            allowed,
        })
    }
}
