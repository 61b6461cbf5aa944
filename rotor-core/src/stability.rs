//! Stability without approximation: three ways to the growth rate, and the exact ends of the regions.
//!
//! | way | module | what it needs | good for |
//! |---|---|---|---|
//! | exact quartic | [`quartic`] | the eight [`Coefficients`](crate::equations::Coefficients) and a speed | the paper's rotor; microseconds |
//! | Hill's determinant | [`hill`] | a [`PeriodicSystem`] and a number of harmonics | any linear system with one harmonic in its matrices |
//! | monodromy matrix | [`monodromy`] | a [`PeriodicSystem`] and a tolerance | the same; independent of the other two |
//!
//! The quartic is exact because the coefficients are constant in the frame that turns with the rotor. [`ends`] uses the
//! same fact: a simple region (SIR) ends where a root of the quartic passes zero, a combination region (CIR) where two
//! roots meet. [`whirl`] has the frequencies of the symmetric, uncracked rotor, from which the regions start.
//!
//! Growth rates are in units of the reference speed (dimensionless time), positive where the motion grows. All three
//! agree to about 1e-11 away from the ends at moderate speeds; Hill's method loses up to 5 ε Ω² at high ones, where the
//! combination region lies for β near 2 (3e-8 at Ω = 10 000). At an end the multipliers are defective, and the two
//! general ways, which do not know the structure, keep only half of the digits there.

mod combination;
mod double_double;
pub mod ends;
mod error;
mod frequency_equation;
pub mod hill;
pub mod monodromy;
mod number;
pub mod periodic;
pub mod quartic;
pub mod whirl;

pub use combination::combination_ends;
pub use ends::{Ends, simple_region_ends};
pub use error::StabilityError;
pub use periodic::{Harmonic, PeriodicSystem};
pub use quartic::{growth_rate, squared_offsets};
pub use whirl::whirl_frequencies;
