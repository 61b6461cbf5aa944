//! Many rotors at once, in packs: what studies run on.

pub(crate) mod extremes;
pub(crate) mod kernel;
pub(crate) mod statistic;

mod chain;
mod destination;
mod iteration;
mod list;
mod quantities;
mod sizes;
mod stage;
