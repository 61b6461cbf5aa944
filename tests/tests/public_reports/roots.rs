//! Roots, norms and powers at zero, where the whole is smooth and a part of it is not.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// The Euclidean norm.
    pub fn norm(x: f64, y: f64) -> f64 {
        (x * x + y * y).sqrt()
    }

    /// JAX has no number as the gradient of a squared norm at zero; it is 0.
    /// <https://github.com/jax-ml/jax/issues/4177>
    #[generate(value, gradient(x, y), hessian(x, y))]
    pub fn squared_norm(x: f64, y: f64) -> f64 {
        norm(x, y).powi(2)
    }

    /// autograd, the same in one dimension. <https://github.com/HIPS/autograd/issues/586>
    #[generate(value, gradient(x))]
    pub fn squared_norm_of_one(x: f64) -> f64 {
        (x * x).sqrt().powi(2)
    }

    /// autograd had no number as the gradient of a bell curve of the norm at its top; it is 0.
    /// <https://github.com/HIPS/autograd/issues/183>
    #[generate(value, gradient(x, y))]
    pub fn bell(x: f64, y: f64) -> f64 {
        (-norm(x, y).powi(2)).exp()
    }

    /// CasADi had no number as the gradient of half the squared distance of two equal points; it is 0.
    /// <https://github.com/casadi/casadi/issues/3898>
    #[generate(value, gradient(y, target))]
    pub fn tracking_cost(y: f64, target: f64) -> f64 {
        0.5 * (y - target).powi(2).sqrt().powi(2)
    }

    /// CasADi, the same as a product of two norms, which stopped a solver at its start.
    /// <https://github.com/casadi/casadi/issues/2947>
    #[generate(value, gradient(x, y))]
    pub fn norm_times_norm(x: f64, y: f64) -> f64 {
        norm(1.0 - x, 1.0 - y) * norm(1.0 - x, 1.0 - y)
    }

    /// ForwardDiff with static arrays had no numbers as the gradient of a smooth potential at its centre; it is 0.
    /// <https://github.com/JuliaDiff/ForwardDiff.jl/issues/243>
    #[generate(value, gradient(x, y))]
    pub fn soft_potential(x: f64, y: f64) -> f64 {
        1.0 / (1.0 + norm(x, y).powi(2)).sqrt()
    }

    /// JAX had no number as the derivative of the norm of a multiple of a vector by the factor, at the zero vector; the
    /// function is 0 for all factors there.
    /// <https://github.com/jax-ml/jax/issues/26248>
    #[generate(value, gradient(factor))]
    pub fn norm_of_a_multiple(factor: f64, x: f64, y: f64) -> f64 {
        norm(factor * x, factor * y)
    }

    /// Taichi had no number as the gradient of a mass times a squared distance where it is 0.
    /// <https://github.com/taichi-dev/taichi/issues/4332>
    #[generate(value, gradient(mass, x, y))]
    pub fn moment(mass: f64, x: f64, y: f64) -> f64 {
        mass * norm(x - mass * 2.0, y - mass * 3.0).powi(2)
    }

    /// autodiff had wrong second derivatives of a power at 0, where the same as a product was right.
    /// <https://github.com/autodiff/autodiff/issues/351>
    #[generate(value, hessian(x))]
    pub fn scaled_square(x: f64) -> f64 {
        4.3 * x.powi(2)
    }

    /// ForwardDiff had no number as the derivative of x⁰ at 0, and as the second one of x¹.
    /// <https://github.com/JuliaDiff/ForwardDiff.jl/pull/331>
    #[generate(value, gradient(x), hessian(x))]
    pub fn low_powers(x: f64) -> f64 {
        5.0 * x.powi(0) + 7.0 * x.powi(1) + x * (x.powi(0) + x.powi(1))
    }

    /// MetaPhysicL divided a power by its base to get the derivative, which is 0/0 at 0.
    /// <https://github.com/roystgnr/MetaPhysicL/pull/49>
    #[generate(value, gradient(x, y))]
    pub fn monomial(x: f64, y: f64) -> f64 {
        x.powi(3) * y.powi(2) + x * y.powi(5)
    }

    /// OpenModelica took (x²)^(3/2) for x³; it is |x|³.
    /// <https://github.com/OpenModelica/OpenModelica/pull/6714>
    #[generate(value, gradient(x))]
    pub fn cube_of_a_root(x: f64) -> f64 {
        (x * x).sqrt().powi(3)
    }

    /// XNNPACK got no number as the root of infinity, from a product with the root of the reciprocal. The slope there
    /// is 0. <https://github.com/google/XNNPACK/pull/10407>
    #[generate(value, gradient(x))]
    pub fn root(x: f64) -> f64 {
        x.sqrt()
    }

    /// autograd had no number as the slope of 1/(1/x) at 0, which has the value 0 there and is x elsewhere.
    /// <https://github.com/HIPS/autograd/issues/570>
    #[generate(value, gradient(x))]
    pub fn twice_inverted(x: f64) -> f64 {
        1.0 / (1.0 / x)
    }
}

#[test]
fn squares_of_norms() {
    use formulas::{squared_norm, squared_norm_of_one};
    let (value, [by_x, by_y], [[xx, xy], [_, yy]]) = squared_norm::hessian(0.0, 0.0);
    check(&[
        ("squared, as written", squared_norm(0.0, 0.0), 0.0, CLOSE),
        ("squared, value", value, 0.0, CLOSE),
        (
            "squared, by x",
            squared_norm::gradient(0.0, 0.0).1[0],
            0.0,
            CLOSE,
        ),
        ("squared, by x with the second", by_x, 0.0, CLOSE),
        ("squared, by y with the second", by_y, 0.0, CLOSE),
        ("squared, by xx", xx, 2.0, CLOSE),
        ("squared, by xy", xy, 0.0, CLOSE),
        ("squared, by yy", yy, 2.0, CLOSE),
        (
            "of one, value",
            squared_norm_of_one::value(-3.0),
            9.0,
            CLOSE,
        ),
        (
            "of one, slope at 0",
            squared_norm_of_one::gradient(0.0).1[0],
            0.0,
            CLOSE,
        ),
        (
            "of one, slope",
            squared_norm_of_one::gradient(-3.0).1[0],
            -6.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn squares_of_distances() {
    use formulas::{moment, norm_times_norm, tracking_cost};
    let (_, [mass, x, y]) = moment::gradient(1.0, 2.0, 3.0);
    check(&[
        ("cost, as written", tracking_cost(0.7, 0.7), 0.0, CLOSE),
        (
            "cost, by y",
            tracking_cost::gradient(0.7, 0.7).1[0],
            0.0,
            CLOSE,
        ),
        (
            "cost, by target",
            tracking_cost::gradient(0.7, 0.7).1[1],
            0.0,
            CLOSE,
        ),
        ("product, as written", norm_times_norm(1.0, 1.0), 0.0, CLOSE),
        (
            "product, by x",
            norm_times_norm::gradient(1.0, 1.0).1[0],
            0.0,
            CLOSE,
        ),
        (
            "product, by y",
            norm_times_norm::gradient(1.0, 1.0).1[1],
            0.0,
            CLOSE,
        ),
        ("moment, as written", moment(1.0, 2.0, 3.0), 0.0, CLOSE),
        ("moment, by mass", mass, 0.0, CLOSE),
        ("moment, by x", x, 0.0, CLOSE),
        ("moment, by y", y, 0.0, CLOSE),
    ]);
}

#[test]
fn smooth_functions_of_norms() {
    use formulas::{bell, norm_of_a_multiple, soft_potential};
    check(&[
        ("bell, as written", bell(0.0, 0.0), 1.0, SAME),
        ("bell, value", bell::value(0.0, 0.0), 1.0, SAME),
        ("bell, by x", bell::gradient(0.0, 0.0).1[0], 0.0, CLOSE),
        ("bell, by y", bell::gradient(0.0, 0.0).1[1], 0.0, CLOSE),
        ("potential, as written", soft_potential(0.0, 0.0), 1.0, SAME),
        (
            "potential, value",
            soft_potential::value(0.0, 0.0),
            1.0,
            SAME,
        ),
        (
            "potential, by x",
            soft_potential::gradient(0.0, 0.0).1[0],
            0.0,
            CLOSE,
        ),
        (
            "potential, by y",
            soft_potential::gradient(0.0, 0.0).1[1],
            0.0,
            CLOSE,
        ),
        (
            "multiple, as written",
            norm_of_a_multiple(1.3, 0.0, 0.0),
            0.0,
            CLOSE,
        ),
        (
            "multiple, value",
            norm_of_a_multiple::value(1.3, 0.0, 0.0),
            0.0,
            CLOSE,
        ),
        (
            "multiple, slope elsewhere",
            norm_of_a_multiple::gradient(-1.3, 3.0, 4.0).1[0],
            -5.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn powers_at_zero() {
    use formulas::{low_powers, monomial, scaled_square};
    check(&[
        (
            "square, slope",
            scaled_square::hessian(0.0).1[0],
            0.0,
            CLOSE,
        ),
        (
            "square, second slope",
            scaled_square::hessian(0.0).2[0][0],
            8.6,
            CLOSE,
        ),
        ("low, as written", low_powers(0.0), 5.0, SAME),
        ("low, value", low_powers::value(0.0), 5.0, SAME),
        ("low, slope", low_powers::gradient(0.0).1[0], 8.0, CLOSE),
        (
            "low, second slope",
            low_powers::hessian(0.0).2[0][0],
            2.0,
            CLOSE,
        ),
        ("monomial, value", monomial::value(0.0, 0.0), 0.0, CLOSE),
        (
            "monomial, by x",
            monomial::gradient(0.0, 2.0).1[0],
            32.0,
            CLOSE,
        ),
        (
            "monomial, by y",
            monomial::gradient(2.0, 0.0).1[1],
            0.0,
            CLOSE,
        ),
        (
            "monomial, by x at 0",
            monomial::gradient(0.0, 0.0).1[0],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn roots_of_squares() {
    use formulas::cube_of_a_root as f;
    check(&[
        ("as written", f(-2.0), 8.0, CLOSE),
        ("value", f::value(-2.0), 8.0, CLOSE),
        ("slope", f::gradient(-2.0).1[0], -12.0, CLOSE),
        ("slope at 0", f::gradient(0.0).1[0], 0.0, CLOSE),
    ]);
}

#[test]
fn root_of_infinity() {
    use formulas::root as f;
    check(&[
        ("as written", f(f64::INFINITY), f64::INFINITY, SAME),
        ("value", f::value(f64::INFINITY), f64::INFINITY, SAME),
        ("slope", f::gradient(f64::INFINITY).1[0], 0.0, CLOSE),
        ("value at 0", f::value(0.0), 0.0, SAME),
        ("slope at 0", f::gradient(0.0).1[0], f64::INFINITY, SAME),
    ]);
}

#[test]
fn reciprocal_of_a_reciprocal() {
    use formulas::twice_inverted as f;
    check(&[
        ("as written", f(0.0), 0.0, SAME),
        ("value", f::value(0.0), 0.0, SAME),
        ("value at -0", f::value(-0.0), -0.0, SAME),
        ("slope", f::gradient(0.0).1[0], 1.0, CLOSE),
        ("slope at 3", f::gradient(3.0).1[0], 1.0, CLOSE),
    ]);
}
