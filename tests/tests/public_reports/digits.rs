//! Digits that the form as written keeps, and that an equal form loses.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    use std::f64::consts::PI;

    /// JAX has slope 0 of exp(x) - 1 at -40, from the value plus 1; it is exp(-40).
    /// <https://github.com/jax-ml/jax/issues/39794>
    #[generate(value, gradient(x), hessian(x))]
    pub fn growth(x: f64) -> f64 {
        x.exp() - 1.0
    }

    /// JAX has second slope 0 of the softplus where its slope rounds to 1; it is 5.6e-17.
    /// <https://github.com/jax-ml/jax/issues/40387>
    #[generate(value, gradient(x), hessian(x))]
    pub fn softplus(x: f64) -> f64 {
        (1.0 + x.exp()).ln()
    }

    /// JAX has partial 0 of a share that rounds to 1, where the other one has 5.6e-17; both do, with opposite signs.
    /// <https://github.com/jax-ml/jax/issues/40386>
    #[generate(value, gradient(x, y))]
    pub fn share(x: f64, y: f64) -> f64 {
        x.exp() / (x.exp() + y.exp())
    }

    /// ROOT is told not to compute tanh from the exponential of twice its argument, which overflows early. This form
    /// reaches twice as far, and its slope is not 1 - tanh² there, which has no digits.
    /// <https://github.com/root-project/root/pull/19740>
    #[generate(value, gradient(x))]
    pub fn tanh(x: f64) -> f64 {
        (x.exp() - (-x).exp()) / (x.exp() + (-x).exp())
    }

    /// The second derivative of sinc by ForwardDiff is wrong near 0; here where the quotients still have digits.
    /// <https://github.com/JuliaDiff/ForwardDiff.jl/issues/466>
    #[generate(value, gradient(x), hessian(x))]
    pub fn sinc(x: f64) -> f64 {
        (PI * x).sin() / (PI * x)
    }

    /// The smaller root of a quadratic equation without cancellation, as SymPy is asked to write it.
    /// <https://github.com/sympy/sympy/issues/11476>
    #[generate(value, gradient(a, b, c))]
    pub fn smaller_root(a: f64, b: f64, c: f64) -> f64 {
        2.0 * c / (-b - (b * b - 4.0 * a * c).sqrt())
    }

    /// Herbie's form of this root had -6 for x² - x - 6, which has the roots -2 and 3.
    /// <https://github.com/herbie-fp/herbie/issues/326>
    #[generate(value, gradient(a, b, c))]
    pub fn negative_root(a: f64, b: f64, c: f64) -> f64 {
        (-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
    }

    /// nalgebra had the variance from the mean of squares, and lost it; from the differences to the mean it is exact
    /// here. <https://github.com/dimforge/nalgebra/pull/1236>
    #[generate(value, gradient)]
    pub fn variance(x: [f64; 3]) -> f64 {
        let mean = (x[0] + x[1] + x[2]) / 3.0;
        ((x[0] - mean).powi(2) + (x[1] - mean).powi(2) + (x[2] - mean).powi(2)) / 3.0
    }

    /// volk had no number as the standard deviation of numbers near 1, from a negative variance.
    /// <https://github.com/gnuradio/volk/issues/290>
    #[generate(value, gradient)]
    pub fn deviation(a: f64, b: f64, c: f64) -> f64 {
        let mean = (a + b + c) / 3.0;
        (((a - mean).powi(2) + (b - mean).powi(2) + (c - mean).powi(2)) / 3.0).sqrt()
    }

    /// decimal.js had wrong digits of asin near 1 from 1 - x x, and has them right from the product.
    /// <https://github.com/MikeMcl/decimal.js/pull/260>
    #[generate(value, gradient(x))]
    pub fn cosine_from_sine(x: f64) -> f64 {
        ((1.0 - x) * (1.0 + x)).sqrt()
    }

    /// mathc loses 1 - cos x for small x; by half the angle it is kept.
    /// <https://github.com/felselva/mathc/pull/44>
    #[generate(value, gradient(x))]
    pub fn one_minus_cosine(x: f64) -> f64 {
        2.0 * (0.5 * x).sin().powi(2)
    }

    /// The area of a needle-like triangle by Kahan's parentheses, which geometry-central wants; a ≥ b ≥ c.
    /// <https://github.com/nmwsharp/geometry-central/issues/63>
    #[generate(value, gradient(a, b, c))]
    pub fn triangle(a: f64, b: f64, c: f64) -> f64 {
        0.25 * ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).sqrt()
    }

    /// The haversine of a small distance, which nco needs instead of a cosine near 1.
    /// <https://github.com/nco/nco/issues/152>
    #[generate(value, gradient(north))]
    pub fn haversine(north: f64, south: f64, east: f64, west: f64) -> f64 {
        (0.5 * (north - south)).sin().powi(2)
            + north.cos() * south.cos() * (0.5 * (east - west)).sin().powi(2)
    }
}

#[test]
fn slopes_of_what_saturates() {
    use formulas::{growth, share, softplus, tanh};
    let x = 37.429_947_750_237_05;
    let tail = 5.551115123125775e-17;
    check(&[
        ("growth, value", growth::value(-40.0), -1.0, SAME),
        (
            "growth, slope",
            growth::gradient(-40.0).1[0],
            4.248354255291589e-18,
            CLOSE,
        ),
        (
            "growth, slope with the second",
            growth::hessian(-40.0).1[0],
            4.248354255291589e-18,
            CLOSE,
        ),
        (
            "growth, second slope",
            growth::hessian(-40.0).2[0][0],
            4.248354255291589e-18,
            CLOSE,
        ),
        ("softplus, as written", softplus(x), x, CLOSE),
        ("softplus, value", softplus::value(x), x, CLOSE),
        ("softplus, slope", softplus::gradient(x).1[0], 1.0, CLOSE),
        (
            "softplus, second slope",
            softplus::hessian(x).2[0][0],
            tail,
            CLOSE,
        ),
        ("share, value", share::value(x, 0.0), 1.0, CLOSE),
        ("share, by y", share::gradient(x, 0.0).1[1], -tail, CLOSE),
        ("tanh, as written", tanh(20.0), 1.0, CLOSE),
        ("tanh, value", tanh::value(20.0), 1.0, CLOSE),
    ]);
}

#[test]
fn derivatives_of_sinc() {
    use formulas::sinc as f;
    // At 0.1 the first derivative is a difference of two numbers 30 times as large, the second one of three that are
    // up to 60 times as large.
    check(&[
        ("as written", f(0.1), 0.983631643083466, CLOSE),
        ("value", f::value(0.1), 0.983631643083466, CLOSE),
        ("slope", f::gradient(0.1).1[0], -0.325751267883124, 1e-13),
        (
            "second slope",
            f::hessian(0.1).2[0][0],
            -3.193029835964854,
            2e-13,
        ),
        ("value at 0.5", f::value(0.5), 0.6366197723675814, CLOSE),
        (
            "slope at 0.5",
            f::gradient(0.5).1[0],
            -1.2732395447351628,
            CLOSE,
        ),
        (
            "second slope at 0.5",
            f::hessian(0.5).2[0][0],
            -1.1902271282389358,
            4.0 * CLOSE,
        ),
    ]);
}

#[test]
fn roots_of_quadratic_equations() {
    use formulas::{negative_root, smaller_root as f};
    let (value, [a, b, c]) = f::gradient(1.0, 1e8, 1.0);
    check(&[
        ("as written", f(1.0, 1e8, 1.0), -1e-8, CLOSE),
        ("value", f::value(1.0, 1e8, 1.0), -1e-8, CLOSE),
        ("value with gradient", value, -1e-8, CLOSE),
        ("by a", a, -1.0000000000000005e-24, CLOSE),
        ("by b", b, 1.0000000000000003e-16, CLOSE),
        ("by c", c, -1.0000000000000002e-8, CLOSE),
        (
            "negative root, as written",
            negative_root(1.0, -1.0, -6.0),
            -2.0,
            SAME,
        ),
        (
            "negative root, value",
            negative_root::value(1.0, -1.0, -6.0),
            -2.0,
            CLOSE,
        ),
        (
            "negative root, by c",
            negative_root::gradient(1.0, -1.0, -6.0).1[2],
            0.2,
            CLOSE,
        ),
    ]);
}

#[test]
fn spread_about_a_large_mean() {
    use formulas::{deviation, variance};
    let x = [1_000_000_004.0, 1_000_000_007.0, 1_000_000_013.0];
    let (_, slopes) = variance::gradient(x);
    let [a, b, c] = [100_000_001.0, 100_000_002.0, 100_000_003.0];
    let right = (2.0_f64 / 3.0).sqrt();
    let (_, [by_a, by_b, by_c]) = deviation::gradient(a, b, c);
    check(&[
        ("variance, as written", variance(x), 14.0, CLOSE),
        ("variance, value", variance::value(x), 14.0, CLOSE),
        ("variance, by the first", slopes[0], -8.0 / 3.0, CLOSE),
        ("variance, by the second", slopes[1], -2.0 / 3.0, CLOSE),
        ("variance, by the third", slopes[2], 10.0 / 3.0, CLOSE),
        ("deviation, as written", deviation(a, b, c), right, CLOSE),
        ("deviation, value", deviation::value(a, b, c), right, CLOSE),
        ("deviation, by a", by_a, -1.0 / (3.0 * right), CLOSE),
        ("deviation, by b", by_b, 0.0, CLOSE),
        ("deviation, by c", by_c, 1.0 / (3.0 * right), CLOSE),
    ]);
}

#[test]
fn differences_from_one() {
    use formulas::{cosine_from_sine as f, one_minus_cosine as g};
    let x = 1.0 - 2.0_f64.powi(-30);
    check(&[
        ("as written", f(x), 4.3158372865106896e-5, CLOSE),
        ("value", f::value(x), 4.3158372865106896e-5, CLOSE),
        ("slope", f::gradient(x).1[0], -23170.474989736398, CLOSE),
        ("cosine, as written", g(1e-5), 4.999999999958334e-11, CLOSE),
        (
            "cosine, value",
            g::value(1e-5),
            4.999999999958334e-11,
            CLOSE,
        ),
        (
            "cosine, slope",
            g::gradient(1e-5).1[0],
            9.999999999833334e-6,
            CLOSE,
        ),
    ]);
}

#[test]
fn needle_like_triangle() {
    use formulas::triangle as f;
    let [a, b, c] = [12_345_679.0, 12_345_678.0, 1.012_339_95];
    let (value, slopes) = f::gradient(a, b, c);
    check(&[
        ("as written", f(a, b, c), 972730.0712585791, CLOSE),
        ("value", f::value(a, b, c), 972730.0712585791, CLOSE),
        ("value with gradient", value, 972730.0712585791, CLOSE),
        ("by a", slopes[0], -39172166.558722675, CLOSE),
        ("by b", slopes[1], 39172166.63751382, CLOSE),
        ("by c", slopes[2], 39655549.1753307, CLOSE),
    ]);
}

#[test]
fn haversine_of_a_small_distance() {
    use formulas::haversine as f;
    let [north, south, east, west] = [0.7, 0.6999990463256835, 1.0, 0.9999995231628418];
    check(&[
        (
            "as written",
            f(north, south, east, west),
            2.6062616833249814e-13,
            CLOSE,
        ),
        (
            "value",
            f::value(north, south, east, west),
            2.6062616833249814e-13,
            CLOSE,
        ),
        (
            "slope",
            f::gradient(north, south, east, west).1[0],
            4.768371301948643e-7,
            CLOSE,
        ),
    ]);
}
