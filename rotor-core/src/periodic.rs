//! Any linear system whose matrices repeat: it knows no rotor.
//!
//! | way to the growth rate | module | what it needs |
//! |---|---|---|
//! | Hill's determinant | [`hill`] | a [`PeriodicSystem`] and a number of harmonics |
//! | monodromy matrix | [`monodromy`] | a [`PeriodicSystem`] and a tolerance; independent of the other |

pub mod hill;
pub mod monodromy;
mod system;

pub use system::{Harmonic, PeriodicSystem};
