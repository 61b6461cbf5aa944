//! What makes a linear periodic system of a rotor: the seam between physics and the methods for any such system.
//!
//! [`periodic`](crate::periodic) knows no rotor. A model gives it the equations of motion at a speed; closed forms and exact
//! algebra, as [`jeffcott`](crate::jeffcott) has them, are what a model may have in addition.

mod jeffcott;

use crate::error::StabilityError;
use crate::periodic::PeriodicSystem;

/// A rotor whose motion at a constant speed is that of a linear system with periodic matrices.
pub trait Model {
    /// The equations of motion at a speed.
    ///
    /// # Errors
    /// Where there are none at this speed: a speed that is not a positive number, a rotor out of its range.
    fn system(&self, speed: f64) -> Result<PeriodicSystem, StabilityError>;
}
