//! What `max` and `min` leave out must not show: neither its derivative nor that it is no number.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// Enzyme had slope 0 everywhere of a function that is x above 0 and 0 below.
    /// <https://github.com/EnzymeAD/Enzyme/issues/101>
    #[generate(value, gradient(x))]
    pub fn ramp(x: f64) -> f64 {
        x.max(0.0)
    }

    /// SymForce had 0/0 where x² < z²: the function is 0 all around there, and so are its partials.
    /// <https://github.com/symforce-org/symforce/issues/445>
    #[generate(value, gradient(x, z))]
    pub fn root_of_what_is_left(x: f64, z: f64) -> f64 {
        (x.powi(2) - z.powi(2)).max(0.0).sqrt()
    }

    /// redner got no number from the root of 1 - y² for a y that roundings had taken beyond 1, and clamped it.
    /// <https://github.com/BachiLi/redner/issues/21>
    #[generate(value, gradient(y))]
    pub fn sine_from_cosine(y: f64) -> f64 {
        (1.0 - y * y).max(0.0).sqrt()
    }

    /// CasADi had no number as the slope of the left part of a root that is cut off at 0; all slopes there are 0.
    /// <https://github.com/casadi/casadi/issues/1878>
    #[generate(value, gradient(x), hessian(x))]
    pub fn root_or_nothing(x: f64) -> f64 {
        x.max(0.0).sqrt()
    }

    /// MLX had no number as the gradient at the origin of a distance that is held above a small constant.
    /// <https://github.com/ml-explore/mlx/issues/3668>
    #[generate(value, gradient(x, y))]
    pub fn held_distance(x: f64, y: f64) -> f64 {
        (x * x + y * y).sqrt().max(1e-10)
    }

    /// TensorFlow's gradient of what is selected was spoilt by an exponential that is not selected and overflows.
    /// <https://github.com/tensorflow/tensorflow/issues/2540>
    #[generate(value, gradient(x))]
    pub fn capped_growth(x: f64) -> f64 {
        x.exp().min(1.0)
    }

    /// The same of TensorFlow with an exponential of an exponential.
    /// <https://github.com/tensorflow/tensorflow/issues/38349>
    #[generate(value, gradient(x))]
    pub fn capped_tower(x: f64) -> f64 {
        (x.exp().exp()).min(x)
    }

    /// Fidget had no numbers as the gradient inside a box, of the exact distance to it.
    /// <https://github.com/mkeeter/fidget/issues/127>
    #[generate(value, gradient(x, y))]
    pub fn distance_to_a_box(x: f64, y: f64) -> f64 {
        let outside_x = x.abs() - 1.0;
        let outside_y = y.abs() - 1.0;
        let corner_x = outside_x.max(0.0);
        let corner_y = outside_y.max(0.0);
        (corner_x * corner_x + corner_y * corner_y).sqrt() + outside_x.max(outside_y).min(0.0)
    }

    /// Nx applied the gradient that comes from above twice in `clip`, so that signs and sizes were lost.
    /// <https://github.com/elixir-nx/nx/pull/1779>
    #[generate(value, gradient(x))]
    pub fn scaled_clip(x: f64) -> f64 {
        -3.0 * x.max(-1.0).min(1.0)
    }

    /// JAX gives slope 1/2 of a ramp to numbers below the normal ones, which it takes for 0: a tie that is none.
    /// <https://github.com/jax-ml/jax/issues/37821>
    #[generate(value, gradient(x))]
    pub fn ramp_of_the_least(x: f64) -> f64 {
        x.max(0.0)
    }

    /// PyTorch's `fmax` and `fmin` leave out what is no number in their values, and did not in their gradients.
    /// <https://github.com/pytorch/pytorch/pull/193035>
    #[generate(value, gradient(x))]
    pub fn logarithm_above_zero(x: f64) -> f64 {
        x.ln().max(0.0)
    }

    /// The same of two inputs.
    /// <https://github.com/pytorch/pytorch/pull/193035>
    #[generate(value, gradient(x, y))]
    pub fn smaller(x: f64, y: f64) -> f64 {
        x.min(y) + x.max(y).min(x)
    }

    /// ForwardDiff had no number as the partial by an input that is multiplied by 0, beside an infinite one.
    /// <https://github.com/JuliaDiff/ForwardDiff.jl/issues/774>
    #[generate(value, gradient(x, y))]
    pub fn logarithm_of_one_of_two(x: f64, y: f64) -> f64 {
        (0.0 * x + y).ln()
    }

    /// Stan had no number as the derivative of a root of what is 0 for all x.
    /// <https://github.com/stan-dev/math/issues/21>
    #[generate(value, gradient(x))]
    pub fn root_of_nothing(x: f64) -> f64 {
        (x - x).powi(2).sqrt() + 2.0 * x
    }
}

#[test]
fn ramps() {
    use formulas::{ramp, ramp_of_the_least, scaled_clip};
    check(&[
        ("ramp, value", ramp::value(3.0), 3.0, SAME),
        ("ramp, slope above", ramp::gradient(3.0).1[0], 1.0, CLOSE),
        ("ramp, slope below", ramp::gradient(-3.0).1[0], 0.0, CLOSE),
        ("least, as written", ramp_of_the_least(5e-324), 5e-324, SAME),
        (
            "least, value",
            ramp_of_the_least::value(5e-324),
            5e-324,
            SAME,
        ),
        (
            "least, slope above",
            ramp_of_the_least::gradient(5e-324).1[0],
            1.0,
            CLOSE,
        ),
        (
            "least, slope below",
            ramp_of_the_least::gradient(-5e-324).1[0],
            0.0,
            CLOSE,
        ),
        ("clip, value", scaled_clip::value(0.5), -1.5, CLOSE),
        (
            "clip, slope within",
            scaled_clip::gradient(0.5).1[0],
            -3.0,
            CLOSE,
        ),
        (
            "clip, slope beyond",
            scaled_clip::gradient(2.0).1[0],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn roots_of_what_is_cut_off() {
    use formulas::root_of_what_is_left as left;
    check(&[
        (
            "left, as written",
            left(2.0, 1.0),
            1.7320508075688772,
            CLOSE,
        ),
        (
            "left, value",
            left::value(2.0, 1.0),
            1.7320508075688772,
            CLOSE,
        ),
        (
            "left, by x",
            left::gradient(2.0, 1.0).1[0],
            1.1547005383792515,
            CLOSE,
        ),
        (
            "left, by z",
            left::gradient(2.0, 1.0).1[1],
            -0.5773502691896257,
            CLOSE,
        ),
        (
            "left, value where it is 0",
            left::value(1.0, 2.0),
            0.0,
            CLOSE,
        ),
        (
            "left, by x where it is 0",
            left::gradient(1.0, 2.0).1[0],
            0.0,
            CLOSE,
        ),
        (
            "left, by z where it is 0",
            left::gradient(1.0, 2.0).1[1],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn roots_that_are_cut_off_at_zero() {
    use formulas::{root_or_nothing as root, sine_from_cosine as sine};
    check(&[
        ("sine, as written", sine(1.5), 0.0, CLOSE),
        ("sine, value", sine::value(1.5), 0.0, CLOSE),
        ("sine, slope", sine::gradient(1.5).1[0], 0.0, CLOSE),
        ("sine, slope within", sine::gradient(0.6).1[0], -0.75, CLOSE),
        ("root, as written", root(-3.0), 0.0, CLOSE),
        ("root, value", root::value(-3.0), 0.0, CLOSE),
        ("root, slope", root::gradient(-3.0).1[0], 0.0, CLOSE),
        (
            "root, second slope",
            root::hessian(-3.0).2[0][0],
            0.0,
            CLOSE,
        ),
        ("root, slope at 4", root::gradient(4.0).1[0], 0.25, CLOSE),
    ]);
}

#[test]
fn distances_that_are_cut_off() {
    use formulas::{distance_to_a_box as boxed, held_distance as held};
    check(&[
        ("held, as written", held(0.0, 0.0), 1e-10, CLOSE),
        ("held, value", held::value(0.0, 0.0), 1e-10, CLOSE),
        ("held, by x", held::gradient(0.0, 0.0).1[0], 0.0, CLOSE),
        ("held, by y", held::gradient(0.0, 0.0).1[1], 0.0, CLOSE),
        ("box, as written", boxed(0.2, 0.5), -0.5, CLOSE),
        ("box, value", boxed::value(0.2, 0.5), -0.5, CLOSE),
        (
            "box, by x within",
            boxed::gradient(0.2, 0.5).1[0],
            0.0,
            CLOSE,
        ),
        (
            "box, by y within",
            boxed::gradient(0.2, 0.5).1[1],
            1.0,
            CLOSE,
        ),
        (
            "box, by x at a corner",
            boxed::gradient(-4.0, 5.0).1[0],
            -0.6,
            CLOSE,
        ),
        (
            "box, by y at a corner",
            boxed::gradient(-4.0, 5.0).1[1],
            0.8,
            CLOSE,
        ),
        (
            "box, by x at a side",
            boxed::gradient(-4.0, 0.5).1[0],
            -1.0,
            CLOSE,
        ),
        (
            "box, by y at a side",
            boxed::gradient(-4.0, 0.5).1[1],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn overflow_that_is_left_out() {
    use formulas::{capped_growth as growth, capped_tower as tower};
    check(&[
        ("growth, as written", growth(1000.0), 1.0, SAME),
        ("growth, value", growth::value(1000.0), 1.0, SAME),
        ("growth, slope", growth::gradient(1000.0).1[0], 0.0, CLOSE),
        ("tower, as written", tower(10.0), 10.0, SAME),
        ("tower, value", tower::value(10.0), 10.0, SAME),
        ("tower, slope", tower::gradient(10.0).1[0], 1.0, CLOSE),
    ]);
}

#[test]
fn what_is_no_number_is_left_out() {
    use formulas::{logarithm_above_zero as f, smaller as g};
    check(&[
        ("as written", f(-1.0), 0.0, SAME),
        ("value", f::value(-1.0), 0.0, SAME),
        ("value with slope", f::gradient(-1.0).0, 0.0, SAME),
        ("slope", f::gradient(-1.0).1[0], 0.0, CLOSE),
        ("smaller, as written", g(2.0, f64::NAN), 4.0, SAME),
        ("smaller, value", g::value(2.0, f64::NAN), 4.0, SAME),
        ("smaller, by x", g::gradient(2.0, f64::NAN).1[0], 2.0, CLOSE),
        ("smaller, by y", g::gradient(2.0, f64::NAN).1[1], 0.0, CLOSE),
    ]);
}

#[test]
fn inputs_that_have_no_effect() {
    use formulas::{logarithm_of_one_of_two as f, root_of_nothing as g};
    check(&[
        (
            "logarithm, as written",
            f(1.0, 0.0),
            f64::NEG_INFINITY,
            SAME,
        ),
        (
            "logarithm, value",
            f::value(1.0, 0.0),
            f64::NEG_INFINITY,
            SAME,
        ),
        ("logarithm, by x", f::gradient(1.0, 0.0).1[0], 0.0, CLOSE),
        (
            "logarithm, by y",
            f::gradient(1.0, 0.0).1[1],
            f64::INFINITY,
            SAME,
        ),
        ("root, as written", g(-0.25), -0.5, SAME),
        ("root, value", g::value(-0.25), -0.5, SAME),
        ("root, slope", g::gradient(-0.25).1[0], 2.0, CLOSE),
    ]);
}
