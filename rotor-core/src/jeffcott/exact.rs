//! Stability of the paper's rotor without approximation: the growth rate at a speed and the exact ends of the regions.
//!
//! The coefficients are constant in the frame that turns with the rotor, so the growth rate is that of the roots of a
//! [`quartic`]. [`ends`] uses the same fact: a simple region (SIR) ends where a root of the quartic passes zero, a combination
//! region (CIR) where two roots meet. [`whirl`] has the frequencies of the symmetric, uncracked rotor, from which the regions
//! start.
//!
//! Growth rates are in units of the reference speed (dimensionless time), positive where the motion grows. The two general
//! ways of [`periodic`](crate::periodic) agree with the quartic to about 1e-11 away from the ends at moderate speeds; Hill's
//! method loses up to 5 ε Ω² at high ones, where the combination region lies for β near 2 (3e-8 at Ω = 10 000). At an end the
//! multipliers are defective, and the general ways, which do not know the structure, keep only half of the digits there.
//!
//! ```
//! use rotor_core::jeffcott::exact;
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! let c = Rotor::paper().coefficients()?;
//! let ends = exact::simple_region_ends(&c)?;
//! let middle = 0.5 * (ends[0] + ends[1]);
//! assert!(exact::growth_rate(&c, middle)? > 0.0);
//! // Undamped motion neither grows nor decays where it is stable: the rate is 0.0 exactly.
//! assert_eq!(exact::growth_rate(&c, 0.5 * ends[0])?, 0.0);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

mod combination;
mod double_double;
pub mod ends;
mod frequency_equation;
mod number;
pub mod quartic;
pub mod regions;
pub mod whirl;

pub use combination::combination_ends;
pub use ends::{Ends, simple_region_ends};
pub use quartic::{growth_rate, squared_offsets};
pub use whirl::whirl_frequencies;

pub(crate) use frequency_equation::sine_and_cosine_of_double;

use crate::equations::Coefficients;
use crate::error::{Error, require};

/// Rejects coefficients with which no computation makes sense: a NaN, an infinity, a disk with no inertia about one axis.
pub(crate) fn check_coefficients(c: &Coefficients) -> Result<(), Error> {
    require("beta", c.beta, c.beta >= 0.0, "a finite number, at least 0")?;
    for (name, value) in [
        ("gamma", c.gamma),
        ("delta", c.delta),
        ("epsilon_1", c.epsilon_1),
        ("epsilon_12", c.epsilon_12),
        ("epsilon_2", c.epsilon_2),
        ("crack_angle", c.crack_angle),
    ] {
        require(name, value, true, "a finite number")?;
    }
    require(
        "disk_asymmetry",
        c.disk_asymmetry,
        c.disk_asymmetry.abs() < 1.0,
        "between -1 and 1",
    )?;
    Ok(())
}
