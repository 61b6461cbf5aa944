//! Formulas that are made of roundings: what is right of them is what IEEE arithmetic gives, operation by operation.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// XLA had 0 as the rounding error of a sum, for all inputs in the short format.
    /// <https://github.com/jax-ml/jax/issues/23007>
    #[generate(value)]
    pub fn error_of_sum(x: f64, y: f64) -> f64 {
        let sum = x + y;
        let y2 = sum - x;
        let x2 = sum - y2;
        (x - x2) + (y - y2)
    }

    /// LLVM folded the rounding error of a product, by a fused operation that may be split, to 0 in
    /// VectorizationBase.jl. <https://github.com/JuliaSIMD/VectorizationBase.jl/pull/129>
    #[generate(value)]
    pub fn error_of_product(x: f64, y: f64) -> f64 {
        let product = x * y;
        x.mul_add(y, -product)
    }

    /// AMReX has to forbid the compiler to reassociate a step of Kahan's summation: what is carried over would be 0.
    /// <https://github.com/AMReX-Codes/amrex/pull/5587>
    #[generate(value)]
    pub fn carried_by_kahan(sum: f64, carried: f64, value: f64) -> (f64, f64) {
        let y = value - carried;
        let t = sum + y;
        (t, (t - sum) - y)
    }

    /// TinyMUX's compiled sum of 1e20, 1 and -1e20 was 0, the interpreter's compensated one 1.
    /// <https://github.com/brazilofmux/tinymux/issues/829>
    #[generate(value)]
    pub fn sum_of_three(a: f64, b: f64, c: f64) -> f64 {
        let s = a + b;
        let t = s + c;
        t + (error_of_sum(a, b) + error_of_sum(s, c))
    }

    /// Kahan's determinant as proposed for StaticArrays.jl keeps its digits where the two products nearly cancel.
    /// <https://github.com/JuliaArrays/StaticArrays.jl/issues/628>
    #[generate(value)]
    pub fn determinant(a: f64, b: f64, c: f64, d: f64) -> f64 {
        let w = b * c;
        let e = (-b).mul_add(c, w);
        let f = a.mul_add(d, -w);
        f + e
    }

    /// A compiler fused one of two products that cancel, so that timemachine got the rounding of the other instead of
    /// 0. <https://github.com/proteneer/timemachine/issues/386>
    #[generate(value)]
    pub fn two_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
        a * b + c * d
    }

    /// JAX had a difference of equal squares below 0; then the root of it is no number.
    /// <https://github.com/jax-ml/jax/issues/26147>
    #[generate(value)]
    pub fn difference_of_squares(x: f64, shift: f64) -> f64 {
        let y = x + shift;
        (y.powi(2) - x.powi(2)).sqrt()
    }

    /// XLA fused a x + b x for a = -b, and had 5e21 instead of 0.
    /// <https://github.com/openxla/xla/issues/41579>
    #[generate(value)]
    pub fn opposite_products(a: f64, b: f64, x: f64) -> f64 {
        a * x + b * x
    }

    /// log(1 + x) has no digits for small x, as in picoc without `log1p`; this device of W. Kahan has them all.
    /// <https://github.com/jpoirier/picoc/issues/35>
    #[generate(value)]
    pub fn ln_1p(x: f64) -> f64 {
        let u = 1.0 + x;
        u.ln() * x / (u - 1.0)
    }

    /// The like for exp(x) - 1, which tensor2tensor computed without `expm1`.
    /// <https://github.com/tensorflow/tensor2tensor/pull/1424>
    #[generate(value)]
    pub fn exp_m1(x: f64) -> f64 {
        let u = x.exp();
        (u - 1.0) * x / u.ln()
    }

    /// VoronoiFVM.jl's Bernoulli function x/(exp(x) - 1) near 0; by the same device.
    /// <https://github.com/WIAS-PDELib/VoronoiFVM.jl/issues/117>
    #[generate(value)]
    pub fn bernoulli(x: f64) -> f64 {
        let u = x.exp();
        u.ln() / (u - 1.0)
    }

    /// d3 interpolates to b only nearly at t = 1 by a + (b - a) t, and exactly by the weighted sum.
    /// <https://github.com/d3/d3-interpolate/issues/73>
    #[generate(value)]
    pub fn weighted_sum(a: f64, b: f64, t: f64) -> f64 {
        a * (1.0 - t) + b * t
    }

    /// PyTorch's second branch, which starts at b, is what a port of it left out.
    /// <https://github.com/tenstorrent/tt-metal/issues/53279>
    #[generate(value)]
    pub fn back_from_the_end(a: f64, b: f64, t: f64) -> f64 {
        b - (b - a) * (1.0 - t)
    }
}

#[test]
fn rounding_errors() {
    use formulas::{error_of_product, error_of_sum};
    check(&[
        ("sum, as written", error_of_sum(1.0, 1e-17), 1e-17, SAME),
        ("sum", error_of_sum::value(1.0, 1e-17), 1e-17, SAME),
        (
            "sum of tenths, as written",
            error_of_sum(0.1, 0.2),
            -2.7755575615628914e-17,
            SAME,
        ),
        (
            "sum of tenths",
            error_of_sum::value(0.1, 0.2),
            -2.7755575615628914e-17,
            SAME,
        ),
        (
            "product, as written",
            error_of_product(0.1, 0.3),
            1.6653345369377347e-18,
            SAME,
        ),
        (
            "product",
            error_of_product::value(0.1, 0.3),
            1.6653345369377347e-18,
            SAME,
        ),
    ]);
}

#[test]
fn compensated_sums() {
    use formulas::{carried_by_kahan as kahan, sum_of_three as three};
    check(&[
        (
            "carried, as written",
            kahan(1.0, 0.0, 1e-17).1,
            -1e-17,
            SAME,
        ),
        ("sum", kahan::value(1.0, 0.0, 1e-17).0, 1.0, SAME),
        ("carried", kahan::value(1.0, 0.0, 1e-17).1, -1e-17, SAME),
        ("three, as written", three(1e20, 1.0, -1e20), 1.0, SAME),
        ("three", three::value(1e20, 1.0, -1e20), 1.0, SAME),
    ]);
}

#[test]
fn products_that_cancel() {
    use formulas::{determinant, difference_of_squares, opposite_products, two_products};
    // (2^27 + 1)² - 2^27 (2^27 + 2) = 1, of which the first product has 55 binary digits.
    let [a, b, c] = [134_217_729.0, 134_217_728.0, 134_217_730.0];
    check(&[
        (
            "determinant, as written",
            determinant(a, b, c, a),
            1.0,
            SAME,
        ),
        ("determinant", determinant::value(a, b, c, a), 1.0, SAME),
        (
            "two products, as written",
            two_products(0.1, 0.2, -0.1, 0.2),
            0.0,
            CLOSE,
        ),
        (
            "two products",
            two_products::value(0.1, 0.2, -0.1, 0.2),
            0.0,
            CLOSE,
        ),
        (
            "squares, as written",
            difference_of_squares(0.1, 0.0),
            0.0,
            CLOSE,
        ),
        (
            "squares",
            difference_of_squares::value(0.1, 0.0),
            0.0,
            CLOSE,
        ),
        (
            "opposite, as written",
            opposite_products(1e20, -1e20, 0.1),
            0.0,
            CLOSE,
        ),
        (
            "opposite",
            opposite_products::value(1e20, -1e20, 0.1),
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn logarithms_and_exponentials_near_one() {
    use formulas::{bernoulli, exp_m1, ln_1p};
    check(&[
        (
            "ln_1p, as written",
            ln_1p(1e-8),
            9.999999950000001e-9,
            CLOSE,
        ),
        ("ln_1p", ln_1p::value(1e-8), 9.999999950000001e-9, CLOSE),
        (
            "exp_m1, as written",
            exp_m1(1e-8),
            1.0000000050000001e-8,
            CLOSE,
        ),
        ("exp_m1", exp_m1::value(1e-8), 1.0000000050000001e-8, CLOSE),
        (
            "bernoulli, as written",
            bernoulli(1e-12),
            0.9999999999995,
            CLOSE,
        ),
        ("bernoulli", bernoulli::value(1e-12), 0.9999999999995, CLOSE),
    ]);
}

#[test]
fn interpolation_that_ends_exactly() {
    use formulas::{back_from_the_end as back, weighted_sum as sum};
    check(&[
        ("sum, as written", sum(1e20, 1.0, 1.0), 1.0, SAME),
        ("sum", sum::value(1e20, 1.0, 1.0), 1.0, SAME),
        ("back, as written", back(1e20, 1.0, 1.0), 1.0, SAME),
        ("back", back::value(1e20, 1.0, 1.0), 1.0, SAME),
    ]);
}
