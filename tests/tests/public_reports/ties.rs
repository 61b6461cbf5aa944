//! Smooth functions that are written with `abs`, `max`, `min` or `signum`, where their parts have corners.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// JAX had slope 0 of the stable softplus at 0, by its rules for the two corners that cancel; it is 1/2.
    /// <https://github.com/jax-ml/jax/issues/2107>
    #[generate(value, gradient(x), hessian(x))]
    pub fn softplus(x: f64) -> f64 {
        x.max(0.0) + (1.0 + (-x.abs()).exp()).ln()
    }

    /// NNlib.jl with ForwardDiff had -1/2 at 0, the same function with its terms exchanged; it is 1/2.
    /// <https://github.com/FluxML/NNlib.jl/pull/679>
    #[generate(value, gradient(x), hessian(x))]
    pub fn softplus_exchanged(x: f64) -> f64 {
        (1.0 + (-(x.abs())).exp()).ln() + 0.0_f64.max(x)
    }

    /// JAX had slope 0 of the logarithm of the sigmoid at 0; it is 1/2.
    /// <https://github.com/jax-ml/jax/issues/2140>
    #[generate(value, gradient(x), hessian(x))]
    pub fn log_sigmoid(x: f64) -> f64 {
        x.min(0.0) - (1.0 + (-x.abs()).exp()).ln()
    }

    /// Keras had (1, 0) as the partials of the logarithm of a sum of exponentials at equal inputs; they are 1/2 each.
    /// <https://github.com/keras-team/keras/pull/23616>
    #[generate(value, gradient(a, b), hessian(a, b))]
    pub fn log_add_exp(a: f64, b: f64) -> f64 {
        a.max(b) + (1.0 + (-(a - b).abs()).exp()).ln()
    }

    /// The same by the smaller of the two, as it was proposed there for JAX.
    /// <https://github.com/jax-ml/jax/issues/2107>
    #[generate(value, gradient(a, b))]
    pub fn log_add_exp_by_both(a: f64, b: f64) -> f64 {
        a.max(b) + (1.0 + (a.min(b) - a.max(b)).exp()).ln()
    }

    /// Of JAX it was asked which slopes at a tie keep the cross entropy of a logit right, which is smooth.
    /// <https://github.com/jax-ml/jax/pull/2195>
    #[generate(value, gradient(x, z))]
    pub fn cross_entropy(x: f64, z: f64) -> f64 {
        x.max(0.0) - x * z + (1.0 + (-x.abs()).exp()).ln()
    }

    /// And there: the positive and the negative part of a number add up to it, with slope 1 everywhere.
    /// <https://github.com/jax-ml/jax/pull/2195>
    #[generate(value, gradient(x))]
    pub fn both_parts(x: f64) -> f64 {
        x.max(0.0) + x.min(0.0)
    }

    /// autograd gave both slopes of a maximum at equal inputs to one of them. Larger and smaller add up to the sum.
    /// <https://github.com/HIPS/autograd/issues/212>
    #[generate(value, gradient(a, b))]
    pub fn larger_and_smaller(a: f64, b: f64) -> f64 {
        a.max(b) + a.min(b)
    }

    /// Theano had wrong gradients of `maximum` and `minimum` of equal arguments. Here they are equal everywhere.
    /// <https://github.com/Theano/Theano/issues/6470>
    #[generate(value, gradient(x))]
    pub fn larger_of_the_same(x: f64) -> f64 {
        (x * x).max(x.powi(2)) + x.min(x)
    }

    /// SymEngine as used by SymForce had 1.5 as the slope of this at 0, where three functions touch, all with slope 1.
    /// <https://github.com/symforce-org/symforce/issues/36>
    #[generate(value, gradient(x))]
    pub fn three_that_touch(x: f64) -> f64 {
        x.max(x.exp() - 1.0).max((x + 1.0).powi(2) / 2.0 - 0.5)
    }

    /// tinygrad had slope 0 of asinh at 0, by a sign that is 0 there; it is 1.
    /// <https://github.com/tinygrad/tinygrad/pull/17758>
    #[generate(value, gradient(x))]
    pub fn asinh(x: f64) -> f64 {
        x.signum() * (x.abs() + (x * x + 1.0).sqrt()).ln()
    }

    /// multicalc had no derivative of tanh at 800; a first mending of it, by this form, had 0 at the origin, where it
    /// is 1. <https://github.com/kmolan/multicalc-rust/pull/234>
    #[generate(value, gradient(x))]
    pub fn tanh_by_sign(x: f64) -> f64 {
        let t = (-2.0 * x.abs()).exp();
        x.signum() * (1.0 - t) / (1.0 + t)
    }

    /// JAX lost the derivative of `abs` by a product and a quotient that leave the range; it is the sign, down to the
    /// least numbers. <https://github.com/jax-ml/jax/pull/1374>
    #[generate(value, gradient(x))]
    pub fn size(x: f64) -> f64 {
        x.abs()
    }

    /// SymEngine could not differentiate `abs`: what it left gave crashes later. x |x| is smooth, its slope is 2 |x|.
    /// <https://github.com/symengine/symengine/issues/1696>
    #[generate(value, gradient(x), hessian(x))]
    pub fn signed_square(x: f64) -> f64 {
        x * x.abs()
    }
}

#[test]
fn softplus_at_zero() {
    use formulas::{softplus, softplus_exchanged};
    let ln_2 = std::f64::consts::LN_2;
    check(&[
        ("as written", softplus(0.0), ln_2, CLOSE),
        ("value", softplus::value(0.0), ln_2, CLOSE),
        ("slope", softplus::gradient(0.0).1[0], 0.5, CLOSE),
        ("slope at -0", softplus::gradient(-0.0).1[0], 0.5, CLOSE),
        (
            "slope with the second",
            softplus::hessian(0.0).1[0],
            0.5,
            CLOSE,
        ),
        (
            "exchanged, as written",
            softplus_exchanged(0.0),
            ln_2,
            CLOSE,
        ),
        (
            "exchanged, slope",
            softplus_exchanged::gradient(0.0).1[0],
            0.5,
            CLOSE,
        ),
        (
            "exchanged, slope with the second",
            softplus_exchanged::hessian(0.0).1[0],
            0.5,
            CLOSE,
        ),
    ]);
}

#[test]
fn log_sigmoid_at_zero() {
    use formulas::log_sigmoid as f;
    check(&[
        ("as written", f(0.0), -std::f64::consts::LN_2, CLOSE),
        ("value", f::value(0.0), -std::f64::consts::LN_2, CLOSE),
        ("slope", f::gradient(0.0).1[0], 0.5, CLOSE),
        ("slope with the second", f::hessian(0.0).1[0], 0.5, CLOSE),
    ]);
}

#[test]
fn second_slopes_at_ties() {
    let [[aa, ab], [ba, bb]] = formulas::log_add_exp::hessian(3.0, 3.0).2;
    check(&[
        (
            "softplus",
            formulas::softplus::hessian(0.0).2[0][0],
            0.25,
            CLOSE,
        ),
        (
            "softplus, exchanged",
            formulas::softplus_exchanged::hessian(0.0).2[0][0],
            0.25,
            CLOSE,
        ),
        (
            "log sigmoid",
            formulas::log_sigmoid::hessian(0.0).2[0][0],
            -0.25,
            CLOSE,
        ),
        ("log of a sum, aa", aa, 0.25, CLOSE),
        ("log of a sum, ab", ab, -0.25, CLOSE),
        ("log of a sum, ba", ba, -0.25, CLOSE),
        ("log of a sum, bb", bb, 0.25, CLOSE),
    ]);
}

#[test]
fn logarithm_of_a_sum_of_equal_exponentials() {
    use formulas::{log_add_exp as f, log_add_exp_by_both as g};
    let right = 3.0 + std::f64::consts::LN_2;
    check(&[
        ("as written", f(3.0, 3.0), right, CLOSE),
        ("value", f::value(3.0, 3.0), right, CLOSE),
        ("by a", f::gradient(3.0, 3.0).1[0], 0.5, CLOSE),
        ("by b", f::gradient(3.0, 3.0).1[1], 0.5, CLOSE),
        ("by both, as written", g(3.0, 3.0), right, CLOSE),
        ("by both, by a", g::gradient(3.0, 3.0).1[0], 0.5, CLOSE),
        ("by both, by b", g::gradient(3.0, 3.0).1[1], 0.5, CLOSE),
    ]);
}

#[test]
fn cross_entropy_at_zero() {
    use formulas::cross_entropy as f;
    check(&[
        ("as written", f(0.0, 0.25), std::f64::consts::LN_2, CLOSE),
        ("value", f::value(0.0, 0.25), std::f64::consts::LN_2, CLOSE),
        ("by x", f::gradient(0.0, 0.25).1[0], 0.25, CLOSE),
        ("by z", f::gradient(0.0, 0.25).1[1], 0.0, CLOSE),
    ]);
}

#[test]
fn parts_that_add_up() {
    use formulas::{both_parts, larger_and_smaller, larger_of_the_same};
    check(&[
        ("both parts, value", both_parts::value(0.0), 0.0, CLOSE),
        ("both parts", both_parts::gradient(0.0).1[0], 1.0, CLOSE),
        (
            "both parts, at 2",
            both_parts::gradient(2.0).1[0],
            1.0,
            CLOSE,
        ),
        (
            "larger and smaller, as written",
            larger_and_smaller(1.0, 1.0),
            2.0,
            CLOSE,
        ),
        (
            "larger and smaller, by a",
            larger_and_smaller::gradient(1.0, 1.0).1[0],
            1.0,
            CLOSE,
        ),
        (
            "larger and smaller, by b",
            larger_and_smaller::gradient(1.0, 1.0).1[1],
            1.0,
            CLOSE,
        ),
        ("the same, as written", larger_of_the_same(1.5), 3.75, CLOSE),
        (
            "the same, value",
            larger_of_the_same::value(1.5),
            3.75,
            CLOSE,
        ),
        (
            "the same",
            larger_of_the_same::gradient(1.5).1[0],
            4.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn three_functions_that_touch() {
    use formulas::three_that_touch as f;
    check(&[
        ("as written", f(0.0), 0.0, CLOSE),
        ("value", f::value(0.0), 0.0, CLOSE),
        ("slope", f::gradient(0.0).1[0], 1.0, CLOSE),
    ]);
}

#[test]
fn odd_functions_by_their_sign() {
    use formulas::{asinh, tanh_by_sign};
    check(&[
        ("asinh as written", asinh(0.5), 0.48121182505960347, CLOSE),
        ("asinh", asinh::value(0.5), 0.48121182505960347, CLOSE),
        (
            "slope of asinh",
            asinh::gradient(0.5).1[0],
            0.8944271909999159,
            CLOSE,
        ),
        ("slope of asinh at 0", asinh::gradient(0.0).1[0], 1.0, CLOSE),
        (
            "slope of asinh at -0",
            asinh::gradient(-0.0).1[0],
            1.0,
            CLOSE,
        ),
        (
            "tanh as written",
            tanh_by_sign(0.5),
            0.46211715726000974,
            CLOSE,
        ),
        ("tanh", tanh_by_sign::value(0.5), 0.46211715726000974, CLOSE),
        (
            "slope of tanh",
            tanh_by_sign::gradient(0.5).1[0],
            0.7864477329659274,
            CLOSE,
        ),
        (
            "slope of tanh at 0",
            tanh_by_sign::gradient(0.0).1[0],
            1.0,
            CLOSE,
        ),
        ("tanh far out as written", tanh_by_sign(-800.0), -1.0, CLOSE),
        ("tanh far out", tanh_by_sign::value(-800.0), -1.0, CLOSE),
        (
            "slope of tanh far out",
            tanh_by_sign::gradient(800.0).1[0],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn size_of_the_least_numbers() {
    use formulas::size as f;
    check(&[
        ("as written", f(-5e-324), 5e-324, SAME),
        ("value", f::value(-5e-324), 5e-324, SAME),
        ("slope at -5e-324", f::gradient(-5e-324).1[0], -1.0, CLOSE),
        ("slope at 5e-324", f::gradient(5e-324).1[0], 1.0, CLOSE),
        ("slope at -1.7e308", f::gradient(-1.7e308).1[0], -1.0, CLOSE),
    ]);
}

#[test]
fn signed_square() {
    use formulas::signed_square as f;
    check(&[
        ("as written", f(-3.0), -9.0, CLOSE),
        ("value", f::value(-3.0), -9.0, CLOSE),
        ("slope", f::gradient(-3.0).1[0], 6.0, CLOSE),
        ("slope at 0", f::gradient(0.0).1[0], 0.0, CLOSE),
        ("second slope", f::hessian(-3.0).2[0][0], -2.0, CLOSE),
    ]);
}
