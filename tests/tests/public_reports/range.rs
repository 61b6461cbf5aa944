//! Numbers that an author keeps within the range of an `f64`, and that a rewriting takes out of it.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// Numba's `hypot` squared its arguments and had infinity for 1e303; this form divides by the larger first.
    /// <https://github.com/numba/numba/issues/1877>
    #[generate(value, gradient(x, y))]
    pub fn hypot(x: f64, y: f64) -> f64 {
        let larger = x.abs().max(y.abs());
        let smaller = x.abs().min(y.abs());
        larger * (1.0 + (smaller / larger).powi(2)).sqrt()
    }

    /// libc++ had infinity for three arguments of 1e20 as `float`, and 0 for three of 1e-30; the form proposed there.
    /// <https://github.com/llvm/llvm-project/issues/92782>
    #[generate(value, gradient(a, b, c))]
    pub fn hypot_of_three(a: f64, b: f64, c: f64) -> f64 {
        let m = a.abs().max(b.abs()).max(c.abs());
        m * ((a / m).powi(2) + (b / m).powi(2) + (c / m).powi(2)).sqrt()
    }

    /// MindSpore had infinity for the hypotenuse of 1e200 and 1e200, which is 1.4e200; here the caller gives a scale.
    /// <https://github.com/mindspore-ai/mindspore/issues/399>
    #[generate(value)]
    pub fn hypot_scaled_by_hand(x: f64, y: f64, scale: f64) -> f64 {
        let (a, b) = (x / scale, y / scale);
        (a * a + b * b).sqrt() * scale
    }

    /// In Swift for TensorFlow the partials of the logarithm of a sum of exponentials, of 0 and 0.625, did not add up
    /// to 1. Here they are far from 0, and must not overflow. <https://github.com/tensorflow/swift-apis/pull/587>
    #[generate(value, gradient(a, b, c))]
    pub fn log_sum_exp(a: f64, b: f64, c: f64) -> f64 {
        let m = a.max(b).max(c);
        m + ((a - m).exp() + (b - m).exp() + (c - m).exp()).ln()
    }

    /// PyTorch had no number as the second derivatives where one of two is far above the other; they are 0.
    /// <https://github.com/pytorch/pytorch/pull/196787>
    #[generate(value, gradient(a, b), hessian(a, b))]
    pub fn log_add_exp(a: f64, b: f64) -> f64 {
        a.max(b) + (1.0 + (-(a - b).abs()).exp()).ln()
    }

    /// SymPy's simplification of a decay multiplies by the growing exponential, and has infinity times 0.
    /// <https://github.com/sympy/sympy/issues/23923>
    #[generate(value, gradient(t, a))]
    pub fn approach(t: f64, a: f64) -> f64 {
        1.0 - (-t * (a + 2.0)).exp()
    }

    /// DyNet's sigmoid was no number for large inputs.
    /// <https://github.com/clab/dynet/issues/1525>
    #[generate(value, gradient(x))]
    pub fn sigmoid(x: f64) -> f64 {
        1.0 / (1.0 + (-x).exp())
    }

    /// candle had no number as the slope of the sigmoid of large negative inputs, from the square of what overflows.
    /// <https://github.com/huggingface/candle/pull/1722>
    #[generate(value, gradient(x), hessian(x))]
    pub fn sigmoid_of_slope(x: f64) -> f64 {
        (1.0 + (-x).exp()).recip()
    }

    /// Triton's tanh as a quotient of two exponentials was no number for large inputs; this form is 1.
    /// <https://github.com/triton-lang/triton/pull/8551>
    #[generate(value, gradient(x))]
    pub fn tanh(x: f64) -> f64 {
        1.0 - 2.0 / ((2.0 * x).exp() + 1.0)
    }

    /// Idris had no number as tanh of 999. <https://github.com/idris-lang/Idris2/issues/2320>
    #[generate(value)]
    pub fn tanh_of_decay(x: f64) -> f64 {
        let t = (-2.0 * x).exp();
        (1.0 - t) / (1.0 + t)
    }

    /// num-complex had no number as a quotient of numbers whose squares overflow; this is the real part by Smith's
    /// method. <https://github.com/rust-num/num-complex/issues/84>
    #[generate(value, gradient(a, b))]
    pub fn real_part_of_quotient(a: f64, b: f64, c: f64, d: f64) -> f64 {
        let r = d / c;
        (a + b * r) / (c + d * r)
    }

    /// Epsilon had infinity for 1e155/(1e155 (1 + i)); the imaginary part.
    /// <https://github.com/numworks/epsilon/pull/119>
    #[generate(value)]
    pub fn imaginary_part_of_quotient(a: f64, b: f64, c: f64, d: f64) -> f64 {
        let r = d / c;
        (b - a * r) / (c + d * r)
    }

    /// A kernel multiplied by a scale before it divided, and overflowed; as documented the division comes first.
    /// <https://github.com/tenstorrent/tt-metal/pull/54927>
    #[generate(value, gradient(a, scale))]
    pub fn add_scaled_quotient(a: f64, b: f64, c: f64, scale: f64) -> f64 {
        a + (b / c) * scale
    }

    /// PyTorch's compiled sinh was infinite where the exponential is and the half of it is not.
    /// <https://github.com/pytorch/pytorch/issues/183763>
    #[generate(value, gradient(x))]
    pub fn sinh(x: f64) -> f64 {
        let h = (0.5 * x).exp();
        0.5 * h * h - 0.5 / h / h
    }

    /// And its cosh. <https://github.com/pytorch/pytorch/issues/183765>
    #[generate(value)]
    pub fn cosh(x: f64) -> f64 {
        let h = (0.5 * x).exp();
        0.5 * h * h + 0.5 / h / h
    }

    /// A midpoint that was proposed for Julia halves the sum, and where that overflows the numbers: this is the second
    /// form. <https://github.com/JuliaLang/julia/issues/29945>
    #[generate(value, gradient(a, b))]
    pub fn middle(a: f64, b: f64) -> f64 {
        0.5 * a + 0.5 * b
    }

    /// In IntervalArithmetic.jl a part of an interval overflows as low + share (high - low); this is what it falls
    /// back to. <https://github.com/JuliaIntervals/IntervalArithmetic.jl/pull/147>
    #[generate(value)]
    pub fn part_of_interval(low: f64, high: f64, share: f64) -> f64 {
        (1.0 - share) * low + share * high
    }

    /// universal's double-double had no finite root of its largest number, from a square on the way. Newton's step has
    /// none. <https://github.com/stillwater-sc/universal/issues/1332>
    #[generate(value)]
    pub fn root_step(a: f64, guess: f64) -> f64 {
        0.5 * (guess + a / guess)
    }

    /// Resistors in parallel, conductances added. Octave's harmonic mean of infinite numbers was 0.
    /// <https://github.com/gnu-octave/statistics/pull/423>
    #[generate(value, gradient(a, b))]
    pub fn harmonic_mean(a: f64, b: f64) -> f64 {
        2.0 / (1.0 / a + 1.0 / b)
    }

    /// Julia's fast `exp` had -6e-183 at 1000 and -2e182 at -1000.
    /// <https://github.com/JuliaLang/julia/pull/42747>
    #[generate(value, gradient(x))]
    pub fn exponential(x: f64) -> f64 {
        x.exp()
    }

    /// XLA folded the logarithm of an exponential; where that does not overflow its slope is 1, not a quotient of two.
    /// <https://github.com/openxla/xla/pull/45560>
    #[generate(value, gradient(x))]
    pub fn logarithm_of_exponential(x: f64) -> f64 {
        x.exp().ln()
    }
}

#[test]
fn hypotenuses() {
    use formulas::hypot;
    check(&[
        (
            "as written",
            hypot(1e303, 1e303),
            1.414213562373095e303,
            CLOSE,
        ),
        (
            "value",
            hypot::value(1e303, 1e303),
            1.414213562373095e303,
            CLOSE,
        ),
        (
            "value of small",
            hypot::value(3e-200, 4e-200),
            5e-200,
            CLOSE,
        ),
        ("by x", hypot::gradient(3e200, -4e200).1[0], 0.6, CLOSE),
        ("by y", hypot::gradient(3e200, -4e200).1[1], -0.8, CLOSE),
        (
            "by x of small",
            hypot::gradient(3e-200, -4e-200).1[0],
            0.6,
            CLOSE,
        ),
    ]);
}

#[test]
fn hypotenuses_of_three_and_by_a_scale() {
    use formulas::{hypot_of_three, hypot_scaled_by_hand};
    check(&[
        (
            "three, as written",
            hypot_of_three(1e200, 1e200, 1e200),
            1.7320508075688773e200,
            CLOSE,
        ),
        (
            "three, value",
            hypot_of_three::value(1e200, 1e200, 1e200),
            1.7320508075688773e200,
            CLOSE,
        ),
        (
            "three, small as written",
            hypot_of_three(1e-200, 1e-200, 1e-200),
            1.7320508075688772e-200,
            CLOSE,
        ),
        (
            "three, small",
            hypot_of_three::value(1e-200, 1e-200, 1e-200),
            1.7320508075688772e-200,
            CLOSE,
        ),
        (
            "three, by b",
            hypot_of_three::gradient(2e200, -6e200, 9e200).1[1],
            -6.0 / 11.0,
            CLOSE,
        ),
        (
            "three, by c",
            hypot_of_three::gradient(2e200, -6e200, 9e200).1[2],
            9.0 / 11.0,
            CLOSE,
        ),
        (
            "by hand, as written",
            hypot_scaled_by_hand(1e200, 1e200, 1e190),
            1.414213562373095e200,
            CLOSE,
        ),
        (
            "by hand, value",
            hypot_scaled_by_hand::value(1e200, 1e200, 1e190),
            1.414213562373095e200,
            CLOSE,
        ),
    ]);
}

#[test]
fn logarithms_of_sums_of_exponentials() {
    use formulas::{log_add_exp as two, log_sum_exp as f};
    let (value, [a, b, c]) = f::gradient(1000.0, 1000.625, 0.0);
    let (_, [by_a, by_b], [[aa, ab], [_, bb]]) = two::hessian(0.0, 800.0);
    check(&[
        (
            "as written",
            f(1000.0, 1000.625, 0.0),
            1001.0537006782765,
            CLOSE,
        ),
        (
            "value",
            f::value(1000.0, 1000.625, 0.0),
            1001.0537006782765,
            CLOSE,
        ),
        ("value with gradient", value, 1001.0537006782765, CLOSE),
        ("by a", a, 0.34864513533394575, CLOSE),
        ("by b", b, 0.6513548646660542, CLOSE),
        ("by c", c, 0.0, CLOSE),
        ("two, as written", two(0.0, 800.0), 800.0, CLOSE),
        ("two, value", two::value(0.0, 800.0), 800.0, CLOSE),
        ("two, by a", by_a, 0.0, CLOSE),
        ("two, by b", by_b, 1.0, CLOSE),
        ("two, by aa", aa, 0.0, CLOSE),
        ("two, by ab", ab, 0.0, CLOSE),
        ("two, by bb", bb, 0.0, CLOSE),
    ]);
}

#[test]
fn decay_that_has_ended() {
    use formulas::approach as f;
    check(&[
        ("as written", f(100.0, 20.0), 1.0, SAME),
        ("value", f::value(100.0, 20.0), 1.0, SAME),
        ("by t", f::gradient(100.0, 20.0).1[0], 0.0, CLOSE),
        ("by a", f::gradient(100.0, 20.0).1[1], 0.0, CLOSE),
    ]);
}

#[test]
fn sigmoids_far_out() {
    use formulas::{sigmoid as f, sigmoid_of_slope as g};
    // e^-700: the argument is exact, the exponential is rounded once.
    let tail = 9.85967654375977e-305;
    check(&[
        ("as written at -1000", f(-1000.0), 0.0, CLOSE),
        ("value at -1000", f::value(-1000.0), 0.0, CLOSE),
        ("value at 1000", f::value(1000.0), 1.0, SAME),
        ("slope at 1000", f::gradient(1000.0).1[0], 0.0, CLOSE),
        ("as written at -700", g(-700.0), tail, CLOSE),
        ("value at -700", g::value(-700.0), tail, CLOSE),
        ("slope at -700", g::gradient(-700.0).1[0], tail, CLOSE),
        (
            "second slope at -700",
            g::hessian(-700.0).2[0][0],
            tail,
            CLOSE,
        ),
        (
            "second slope at 1000",
            g::hessian(1000.0).2[0][0],
            0.0,
            CLOSE,
        ),
    ]);
}

#[test]
fn hyperbolic_functions_far_out() {
    use formulas::{cosh, sinh, tanh, tanh_of_decay};
    let large = 1.1169973830808555e308;
    check(&[
        ("tanh, as written", tanh(1000.0), 1.0, SAME),
        ("tanh, value", tanh::value(1000.0), 1.0, SAME),
        ("tanh, value at -1000", tanh::value(-1000.0), -1.0, SAME),
        (
            "tanh, slope at -1000",
            tanh::gradient(-1000.0).1[0],
            0.0,
            CLOSE,
        ),
        ("of decay, as written", tanh_of_decay(999.0), 1.0, SAME),
        ("of decay, value", tanh_of_decay::value(999.0), 1.0, SAME),
        ("sinh, as written", sinh(710.0), large, CLOSE),
        ("sinh, value", sinh::value(710.0), large, CLOSE),
        ("sinh, slope", sinh::gradient(710.0).1[0], large, CLOSE),
        ("cosh, as written", cosh(-710.0), large, CLOSE),
        ("cosh, value", cosh::value(-710.0), large, CLOSE),
    ]);
}

#[test]
fn quotients_of_complex_numbers() {
    use formulas::{imaginary_part_of_quotient as imaginary, real_part_of_quotient as real};
    check(&[
        ("as written", real(1e200, 0.0, 1e200, 1e200), 0.5, CLOSE),
        ("value", real::value(1e200, 0.0, 1e200, 1e200), 0.5, CLOSE),
        (
            "by a",
            real::gradient(1e200, 0.0, 1e200, 1e200).1[0],
            0.5e-200,
            CLOSE,
        ),
        (
            "by b",
            real::gradient(1e200, 0.0, 1e200, 1e200).1[1],
            0.5e-200,
            CLOSE,
        ),
        (
            "imaginary, as written",
            imaginary(1e155, 0.0, 1e155, 1e155),
            -0.5,
            CLOSE,
        ),
        (
            "imaginary, value",
            imaginary::value(1e155, 0.0, 1e155, 1e155),
            -0.5,
            CLOSE,
        ),
        (
            "imaginary, of small",
            imaginary::value(1e-170, 0.0, 1e-170, 1e-170),
            -0.5,
            CLOSE,
        ),
    ]);
}

#[test]
fn order_of_quotient_and_scale() {
    use formulas::add_scaled_quotient as f;
    check(&[
        ("as written", f(0.0, 1e308, 8.0, 4.0), 5e307, CLOSE),
        ("value", f::value(0.0, 1e308, 8.0, 4.0), 5e307, CLOSE),
        (
            "by scale",
            f::gradient(0.0, 1e308, 8.0, 4.0).1[1],
            1.25e307,
            CLOSE,
        ),
    ]);
}

#[test]
fn middles_of_large_numbers() {
    use formulas::{middle, part_of_interval, root_step};
    let root = 1.3407807929942596e154;
    check(&[
        ("as written", middle(1.7e308, 1.5e308), 1.6e308, CLOSE),
        ("value", middle::value(1.7e308, 1.5e308), 1.6e308, CLOSE),
        ("by a", middle::gradient(1.7e308, 1.5e308).1[0], 0.5, CLOSE),
        (
            "part, as written",
            part_of_interval(-1.6e308, 1.6e308, 0.75),
            8e307,
            CLOSE,
        ),
        (
            "part, value",
            part_of_interval::value(-1.6e308, 1.6e308, 0.75),
            8e307,
            CLOSE,
        ),
        ("step, as written", root_step(f64::MAX, root), root, CLOSE),
        ("step, value", root_step::value(f64::MAX, root), root, CLOSE),
    ]);
}

#[test]
fn harmonic_means() {
    use formulas::harmonic_mean as f;
    check(&[
        (
            "as written, one infinite",
            f(f64::INFINITY, 2.0),
            4.0,
            CLOSE,
        ),
        (
            "value, one infinite",
            f::value(f64::INFINITY, 2.0),
            4.0,
            CLOSE,
        ),
        (
            "value, both infinite",
            f::value(f64::INFINITY, f64::INFINITY),
            f64::INFINITY,
            SAME,
        ),
        ("value, large", f::value(1e170, 1e170), 1e170, CLOSE),
        ("value, small", f::value(1e-170, 3e-170), 1.5e-170, CLOSE),
    ]);
}

#[test]
fn exponentials_at_the_ends() {
    use formulas::{exponential as f, logarithm_of_exponential as g};
    check(&[
        ("value at 1000", f::value(1000.0), f64::INFINITY, SAME),
        (
            "slope at 1000",
            f::gradient(1000.0).1[0],
            f64::INFINITY,
            SAME,
        ),
        ("value at -1000", f::value(-1000.0), 0.0, SAME),
        ("slope at -1000", f::gradient(-1000.0).1[0], 0.0, CLOSE),
        ("logarithm, as written", g(700.0), 700.0, CLOSE),
        ("logarithm, value", g::value(700.0), 700.0, CLOSE),
        ("logarithm, slope", g::gradient(700.0).1[0], 1.0, CLOSE),
        (
            "logarithm, slope at -700",
            g::gradient(-700.0).1[0],
            1.0,
            CLOSE,
        ),
    ]);
}
