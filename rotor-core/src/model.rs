//! What makes a linear periodic system of a rotor: the seam between physics and the methods for any such system.
//!
//! [`periodic`](crate::periodic) knows no rotor. A model gives it the equations of motion at a speed; closed forms and exact
//! algebra, as [`jeffcott`](crate::jeffcott) has them, are what a model may have in addition.

mod jeffcott;
mod survey;

use crate::error::Error;
use crate::periodic::{PeriodicSystem, hill};

pub use jeffcott::confirm_ends;
pub use survey::{Survey, SurveyedRegion};

/// A rotor whose motion at a constant speed is that of a linear system with periodic matrices.
///
/// ```
/// use rotor_core::jeffcott::rotor::Rotor;
/// use rotor_core::model::Model;
///
/// let coefficients = Rotor::paper().coefficients()?;
/// assert!(coefficients.growth_rate(0.75)? > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Model {
    /// The equations of motion at a speed.
    ///
    /// # Errors
    /// Where there are none at this speed: a speed that is not a positive number, a rotor out of its range.
    fn system(&self, speed: f64) -> Result<PeriodicSystem, Error>;

    /// How many harmonics on each side of zero Hill's method needs for this model.
    fn harmonics(&self) -> usize;

    /// The growth rate at a speed by Hill's method.
    ///
    /// # Errors
    /// As [`Model::system`] and [`hill::growth_rate`].
    fn growth_rate(&self, speed: f64) -> Result<f64, Error> {
        hill::growth_rate(&self.system(speed)?, self.harmonics())
    }
}
