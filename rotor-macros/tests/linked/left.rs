//! One side of the diamond.

pub use formulas::*;

#[rotor_macros::symbolic(with(super::base))]
mod formulas {
    use super::super::base::*;

    /// The diagonal's slope.
    #[generate(value)]
    pub fn slope(s: &Sides) -> f64 {
        SCALE * s.height / diagonal(s)
    }

    /// Twice the sides.
    pub fn doubled(s: &Sides) -> Sides {
        Sides {
            width: 2.0 * s.width,
            height: 2.0 * s.height,
        }
    }
}
