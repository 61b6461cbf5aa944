//! Formulas that show what one pass of the generator gives.

#[symbolic(sizes = 1e-9..=1e9)]
pub mod passes {
    /// It is 1.
    #[generate(value)]
    pub fn disguised_one(x: f64) -> f64 {
        (x + 1.0).powi(2) - x * x - 2.0 * x
    }

    /// A root of a quotient and that of its inverse.
    #[domain(a >= 0.0, b >= 0.0)]
    #[generate(gradient)]
    pub fn inverse_roots(a: f64, b: f64, x: f64) -> f64 {
        (a / b).sqrt() + x * b.sqrt() / a.sqrt()
    }

    /// Two roots in one product.
    #[generate(value)]
    pub fn geometric_mean(a: f64, b: f64, c: f64) -> f64 {
        a.sqrt() * b.sqrt() * c
    }

    /// Exponentials with arguments that are whole multiples of each other.
    #[generate(value)]
    pub fn powers_of_exponential(x: f64) -> f64 {
        x.exp() + (2.0 * x).exp() + (-x).exp()
    }

    /// Exponentials in one product, of numbers whose sum rounds as well as they do.
    #[domain(x >= -1.0, x <= 1.0, y >= -1.0, y <= 1.0)]
    #[generate(value)]
    pub fn product_of_exponentials(x: f64, y: f64) -> f64 {
        x.exp() * y.exp()
    }

    /// A cube and its size.
    #[generate(value)]
    pub fn size_and_cube(x: f64) -> (f64, f64) {
        (x.powi(3).abs(), x.powi(3))
    }

    /// A polynomial and its derivative.
    #[generate(value)]
    pub fn polynomial_and_slope(x: f64) -> (f64, f64) {
        (
            1.0 + 2.0 * x + 3.0 * x.powi(2) + 5.0 * x.powi(3) + 7.0 * x.powi(4),
            2.0 + 6.0 * x + 15.0 * x.powi(2) + 28.0 * x.powi(3),
        )
    }
}
