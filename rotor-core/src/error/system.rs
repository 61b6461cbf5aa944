//! Periodic systems and characteristic equations that could not be solved.

use thiserror::Error;

/// Why a periodic system has no growth rate, or a characteristic equation no roots.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SystemError {
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
    /// An iteration stopped at its cap.
    #[error("{what} did not converge in {iterations} iterations")]
    NoConvergence {
        /// What was being computed.
        what: &'static str,
        /// The cap.
        iterations: usize,
    },
    /// Two roots of the quartic are one at every speed, so that where roots meet says nothing.
    #[error("two roots of the quartic are equal at every speed: it has no discriminant")]
    Degenerate,
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
) -> Result<f64, SystemError> {
    if value.is_finite() && holds {
        Ok(value)
    } else {
        Err(SystemError::OutOfRange {
            quantity,
            value,
            allowed,
        })
    }
}
