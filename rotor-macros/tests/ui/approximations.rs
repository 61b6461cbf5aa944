//! What can't be tabulated.

#[rotor_macros::symbolic]
mod formulas {
    #[approximate(x = 0.0..=1.0, degree = 3, tolerance = 1e-6)]
    pub fn unknown_part(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(tolerance = 1e-6)]
    pub fn no_interval(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = 0.0.., tolerance = 1e-6)]
    pub fn half_an_interval(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = 0.0..=1.0, tolerance = 1e-6)]
    pub fn two_numbers(x: f64, y: f64) -> f64 {
        x.exp() + y
    }

    #[approximate(y = 0.0..=1.0, tolerance = 1e-6)]
    pub fn other_variable(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = 0.0..=1.0, tolerance = 1e-6)]
    pub fn a_tuple(x: f64) -> (f64, f64) {
        (x.exp(), x)
    }

    #[approximate(x = 0.0..=1.0, tolerance = 1e-13)]
    #[generate(value)]
    pub fn a_pole(x: f64) -> f64 {
        1.0 / (x - 0.3)
    }

    #[generate(value)]
    pub fn an_integral(x: f64) -> f64 {
        integral(|t| (t * x).exp(), 0.0..1.0)
    }

    #[approximate(x = 0.0..=1.0, y = 0.0..=1.0, tolerance = abc, tolerance = 1e-3, factor = x, factor = x)]
    pub fn parts_twice(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = 1.0..=0.0, tolerance = 0.0)]
    pub fn reversed(x: f64) -> f64 {
        x.exp() * unheard_of
    }

    #[approximate(x = a..=1e999, tolerance = -1e-6)]
    pub fn no_bounds(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = 1.0..=1.0, tolerance = 1e999)]
    pub fn empty_interval(x: f64) -> f64 {
        x.exp()
    }

    #[approximate(x = -1e308..=1e308, tolerance = 1e-6)]
    pub fn wide_interval(x: f64) -> f64 {
        x
    }

    #[approximate(x = -2.0..=-1.0, tolerance = 1e-6)]
    pub fn not_finite(x: f64) -> f64 {
        x.sqrt()
    }

    #[approximate(x = 1.0..=2.0, tolerance = 1e-6)]
    pub fn infinite_integral(x: f64) -> f64 {
        integral(|t| x * t, 0.0..(x - 10.0).ln())
    }

    #[approximate(x = 1.0..=2.0, tolerance = 1e-323)]
    pub fn integral_to_no_tolerance(x: f64) -> f64 {
        integral(|t| x * t, 0.0..1.0)
    }

    #[approximate(x = 1.0..=2.0, tolerance = 1e-6)]
    pub fn not_finite_integrand(x: f64) -> f64 {
        integral(|t| (t - x - 1.0).ln(), 0.0..1.0)
    }

    #[approximate(x = 1.0..=2.0, tolerance = 1e-6)]
    pub fn failing_integrand(x: f64) -> f64 {
        integral(|t| integral(|u| (u - t - x - 1.0).ln(), 0.0..1.0), 0.0..1.0)
    }

    pub fn wrong_integrals(x: f64) -> f64 {
        let a = integral(x, 0.0..1.0);
        let b = integral(|(t, _)| t * x, 0.0..1.0);
        let c = integral(|t, u| t * u, 0.0..1.0);
        let d = integral(|t| t * x, 0.0..);
        let e = integral(|(t, _): (f64, f64)| t * x, 0.0..1.0);
        a + b + c + d + e
    }

    #[generate(value)]
    pub fn a_caller(x: f64) -> f64 {
        a_pole(x) + an_integral(x)
    }
}

fn main() {
    let _: f64 = formulas::a_pole::value(0.5) + formulas::a_caller::value(0.5);
}
