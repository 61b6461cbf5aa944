//! Inputs that describe no rotor.

use thiserror::Error;

use crate::input::{NumericInput, UnknownChoice};
use crate::text::brief;

/// Why inputs describe no rotor, or one without coefficients in double precision.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// An input is outside the values it allows, or not a finite number.
    #[error("{name} is {value}{space}{unit}; it must be {allowed}",
        name = .input.name, unit = .input.unit, allowed = .input.allowed,
        space = if .input.unit.is_empty() { "" } else { " " })]
    OutOfRange {
        /// Its row in [`INPUTS`](crate::input::INPUTS).
        input: &'static NumericInput,
        /// What was given.
        value: f64,
    },
    /// More polar inertia than any rigid body has: $I_p \le I_{dx} + I_{dy} = 2I_d$.
    #[error(
        "beta = disk_polar_inertia / disk_diametral_inertia = {disk_polar_inertia} kg m² / \
         {disk_diametral_inertia} kg m² = {beta}; it must be > 0 and <= 2, since no rigid body has more"
    )]
    InertiaRatio {
        /// $\beta = I_p/I_d$.
        beta: f64,
        /// $I_p$, kg m².
        disk_polar_inertia: f64,
        /// $I_d$, kg m².
        disk_diametral_inertia: f64,
    },
    /// The inputs are so extreme that a derived quantity overflows or loses all its digits.
    #[error(
        "{quantity} comes out as {value}: the inputs are each allowed, but together they leave \
         the range of double precision; it must be {allowed}"
    )]
    OutOfNumericRange {
        /// The derived quantity, such as `k_tt`.
        quantity: &'static str,
        /// What came out.
        value: f64,
        /// What it has to be.
        allowed: &'static str,
    },
    /// $\epsilon_{12} = \Delta k_{tm}/k_{tm}$ with $k_{tm} = 0$ and $\Delta k_{tm} \ne 0$.
    #[error(
        "epsilon_12 = delta_k_tm / k_tm is not defined: k_tm is exactly 0 N while delta_k_tm is \
         {delta_k_tm} N (displacement and tilt are uncoupled in the mean, but not over a turn)"
    )]
    CouplingVanishes {
        /// $\Delta k_{tm}$, N.
        delta_k_tm: f64,
    },
    /// A text that is none of the choices of an input.
    #[error(transparent)]
    UnknownChoice(#[from] UnknownChoice),
    /// A name that is no quantity.
    #[error("there is no quantity \"{}\"; the nearest are {}", brief(.found), .nearest.join(", "))]
    UnknownQuantity {
        /// What was given.
        found: String,
        /// The nearest names, the nearest first.
        nearest: Vec<&'static str>,
    },
    /// A quantity that is at a speed, of which none is given.
    #[error("{quantity} is at a speed, and none is given")]
    NoSpeed {
        /// The quantity.
        quantity: &'static str,
    },
}
