//! What links both sides.

pub use formulas::*;

#[rotor_macros::symbolic(with(super::left, super::right))]
mod formulas {
    use super::super::base;
    pub use super::super::base::SCALE;
    use super::super::base::Sides;
    use super::super::left::*;
    use super::super::right::*;

    /// Slope over cost, and both weights.
    #[generate(value, gradient(s.width, s.height), columns)]
    pub fn merit(s: &Sides) -> f64 {
        slope(s) / cost(s) + weight(s) * base::weight(&doubled(s))
    }

    /// The same by paths.
    #[generate(value)]
    pub fn by_paths(s: &super::super::base::Sides) -> f64 {
        super::super::left::slope(s) / super::super::right::cost(s)
            + super::super::right::weight(s) * base::weight(&super::super::left::doubled(s))
    }

    /// A partial of a formula of another file.
    #[generate(value)]
    pub fn rate(s: &Sides) -> f64 {
        SCALE * base::SCALE * base::diagonal::d_s_width(s)
    }

    /// A struct of another file, made here.
    #[generate(value)]
    pub fn stretched(s: &Sides) -> f64 {
        base::diagonal(&Sides {
            width: 3.0 * s.width,
            ..*s
        })
    }

    /// Twice the arc of another file.
    #[generate(value, gradient)]
    pub fn twice_arc(x: f64) -> f64 {
        2.0 * base::arc(x)
    }

    /// Length of an arc of the cosine from 0, by the same name.
    #[approximate(x = 0.0..=2.0, factor = x, tolerance = 1e-9)]
    #[generate(value)]
    pub fn arc(x: f64) -> f64 {
        integral(|t| (1.0 + t.sin().powi(2)).sqrt(), 0.0..x)
    }

    /// Both.
    #[generate(value)]
    pub fn own_and_linked(x: f64) -> f64 {
        arc(x) + base::arc(x)
    }
}
