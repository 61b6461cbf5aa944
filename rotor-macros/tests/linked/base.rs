//! What the others build on: a struct, a constant, a table.

pub use formulas::*;

#[rotor_macros::symbolic(with(super::conventions))]
mod formulas {
    /// A rectangle's sides.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Sides {
        /// Width, m.
        pub width: f64,
        /// Height, m.
        pub height: f64,
    }

    /// What all lengths are multiplied by.
    pub const SCALE: f64 = 1.5;

    /// A rectangle's diagonal, m.
    #[generate(value, columns, d_s_width)]
    pub fn diagonal(s: &Sides) -> f64 {
        (s.width.powi(2) + s.height.powi(2)).sqrt()
    }

    /// In the other file there is one of this name, too.
    pub fn weight(s: &Sides) -> f64 {
        s.width + s.height
    }

    /// Length of an arc of the sine from 0.
    #[approximate(x = 0.0..=2.0, factor = x, tolerance = 1e-11)]
    #[generate(value, gradient)]
    pub fn arc(x: f64) -> f64 {
        integral(|t| (1.0 + t.cos().powi(2)).sqrt(), 0.0..x)
    }
}
