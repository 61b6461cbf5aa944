//! Many rotors at once, in packs: what studies run on.
//!
//! A [`kernel`] belongs to what varies within a block and a list of quantities. It chooses once how each quantity is computed
//! ([`plan`]), computes what the next row has changed of the chain of equations ([`numbers`], for the inputs of a [`row`]), and
//! runs the last loop ([`evaluation`]), whose numbers go where they are wanted ([`destination`]); what has no closed form is
//! iterated there, point by point ([`iteration`]). Which numbers reductions keep is in [`statistic`].

pub(crate) mod extremes;
pub(crate) mod kernel;
pub(crate) mod one_rotor;
pub(crate) mod statistic;

mod destination;
mod evaluation;
mod iteration;
mod list;
mod numbers;
mod plan;
mod row;
mod stages;
