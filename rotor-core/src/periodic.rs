//! Any linear system whose matrices repeat: it knows no rotor.
//!
//! A [`PeriodicSystem`] is made of [`FourierMatrix`]es with any number of harmonics. Two independent ways lead to its growth
//! rate, and from growth rates to the ends of an instability region:
//!
//! | module | what | what it needs |
//! |---|---|---|
//! | [`hill`] | growth rate by Hill's determinant | a system and a number of harmonics |
//! | [`monodromy`] | growth rate by the monodromy matrix | a system and a tolerance |
//! | [`boundary`] | ends of a region | growth rates at any speed, and where to look |

pub mod boundary;
mod fourier;
pub mod hill;
pub mod monodromy;
mod system;

pub use fourier::FourierMatrix;
pub use system::PeriodicSystem;
