//! The other side of the diamond.

pub use formulas::*;

#[rotor_macros::symbolic(with(super::base))]
mod formulas {
    use super::super::base::{Sides, diagonal, weight as linear};

    /// A cost.
    #[generate(value)]
    pub fn cost(s: &Sides) -> f64 {
        linear(s) + diagonal(s)
    }

    /// In the other file there is one of this name, too.
    pub fn weight(s: &Sides) -> f64 {
        s.width * s.height
    }
}
