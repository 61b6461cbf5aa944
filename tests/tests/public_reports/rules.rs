//! Simplifications that hold for some numbers only, and expressions that are not the same although they look alike.

use crate::{CLOSE, check};

#[rotor_macros::symbolic]
mod formulas {
    /// math.js took √(x²) for x, and had slope 1 at -3.
    /// <https://github.com/josdejong/mathjs/issues/3329>
    #[generate(value, gradient(x), hessian(x))]
    pub fn root_of_square(x: f64) -> f64 {
        x.powi(2).sqrt()
    }

    /// SymPy simplified the root of a square to what is squared, with the wrong sign.
    /// <https://github.com/sympy/sympy/pull/23653>
    #[generate(value, gradient(x, y))]
    pub fn root_of_squared_difference(x: f64, y: f64) -> f64 {
        (x - y).powi(2).sqrt() * x
    }

    /// SymPy's `factor` drew signs out of roots: √(-x) as a multiple of √x.
    /// <https://github.com/sympy/sympy/pull/815>
    #[generate(value, gradient(x))]
    pub fn root_of_negative(x: f64) -> f64 {
        (-x).sqrt() + (-4.0 * x).sqrt()
    }

    /// SymPy's `powsimp` joined roots of negative numbers, or what is the same, split them.
    /// <https://github.com/sympy/sympy/pull/1613>
    #[generate(value, gradient(x, y))]
    pub fn root_of_product(x: f64, y: f64) -> f64 {
        (x * y).sqrt() + (x / y).sqrt()
    }

    /// Maxima plotted this with 2 log x in place of log(|x|²), and had 5.88 at -0.6, where it is -0.378.
    /// <https://github.com/wxMaxima-developers/wxmaxima/issues/1638>
    #[generate(value, gradient(x))]
    pub fn two_sizes(x: f64) -> f64 {
        ((x.abs().powi(2)).ln() + 1.0).abs() - (x + 1.0).abs()
    }

    /// SymPy must not take log(x²)/log(x) for 2: x may be negative. So here: log(x²) has the slope 2/x.
    /// <https://github.com/sympy/sympy/pull/15861>
    #[generate(value, gradient(x))]
    pub fn logarithm_of_square(x: f64) -> f64 {
        (x * x).ln()
    }

    /// Maxima expands logarithms by default where that is wrong for negative numbers.
    /// <https://maxima.sourceforge.io/ext/list_archives/2010/msg01836.html>
    #[generate(value, gradient(x, y))]
    pub fn logarithm_of_quotient(x: f64, y: f64) -> f64 {
        (x / y).ln() + (1.0 / (x * y)).ln()
    }

    /// Symbolics.jl simplified this to 1 because of the small number in it.
    /// <https://github.com/JuliaSymbolics/Symbolics.jl/issues/1849>
    #[generate(value, gradient(u, v))]
    pub fn fractions_and_a_small_number(u: f64, v: f64) -> f64 {
        -u / (-u + v) - 1.0 / (-u + v) - 6.0e-9 * (-u + v)
    }

    /// SymPy's `simplify` made four times as much of this.
    /// <https://github.com/sympy/sympy/issues/12792>
    #[generate(value, gradient(x, y, z))]
    pub fn expansion_about_an_angle(x: f64, y: f64, z: f64) -> f64 {
        let c = x.cos();
        let s = x.sin();
        let fourth = 0.0625 * c.powi(4) - 0.5 * c.powi(3) + 1.5 * c.powi(2) - 2.0 * c + 1.0;
        let second = 0.25 * c.powi(2) - 1.0 * c + 1.0;
        0.25 * y * s / second
            + (z - 0.5)
                * (-0.25 * y * s * c.powi(2) / fourth
                    + 0.5 * y * s * c / fourth
                    + 0.25 * c.powi(3) / fourth
                    - 1.0 * c.powi(2) / fourth
                    + 1.0 * c / fourth
                    - 1.0 / second)
            - 0.25 * c / second
            + 0.5 / second
    }

    /// SymPy's `factor` had 1 for a sixth of a polynomial that is 1.
    /// <https://github.com/sympy/sympy/issues/14550>
    #[generate(value, gradient(p))]
    pub fn sixth_of_one(p: f64) -> f64 {
        ((p - 1.0).powi(4) - 4.0 * p * (p - 1.0).powi(3) + 6.0 * p.powi(2) * (p - 1.0).powi(2)
            - 4.0 * p.powi(3) * (p - 1.0)
            + p.powi(4))
            / 6.0
    }

    /// SymPy's `evalf` had 2 for this polynomial at 0, where it is 0.
    /// <https://github.com/sympy/sympy/issues/14601>
    #[generate(value, gradient(x, y))]
    pub fn difference_of_legendre(x: f64, y: f64) -> f64 {
        5.0 * x * y / 2.0 - y * (35.0 * x.powi(3) / 2.0 - 15.0 * x / 2.0)
    }

    /// Deriv took two temporaries of one name for one.
    /// <https://github.com/sgsokol/Deriv/issues/12>
    #[generate(value, gradient(x, y))]
    pub fn names_used_again(x: f64, y: f64) -> f64 {
        let e = x.exp();
        let q = e / (1.0 + e);
        let e = y.exp();
        let p = e / (1.0 + e);
        q - p
    }

    /// A simplifier of arithmexp takes x - x for 0, which it is not at infinity.
    /// <https://github.com/Muqsit/arithmexp/issues/16>
    #[generate(value)]
    pub fn difference_of_the_same(x: f64) -> f64 {
        x - x
    }

    /// tinygrad folded 0 x to 0, which it is not at infinity, and powers went wrong by it.
    /// <https://github.com/tinygrad/tinygrad/pull/4982>
    #[generate(value)]
    pub fn no_times(x: f64) -> f64 {
        0.0 * x
    }

    /// XLA's √x √x = x holds for numbers that are not negative only.
    /// <https://github.com/openxla/xla/pull/14074>
    #[generate(value)]
    pub fn root_times_root(x: f64) -> f64 {
        x.sqrt() * x.sqrt()
    }
}

#[test]
fn roots_of_squares() {
    use formulas::{root_of_square as f, root_of_squared_difference as g};
    check(&[
        ("as written", f(-3.0), 3.0, CLOSE),
        ("value", f::value(-3.0), 3.0, CLOSE),
        ("slope", f::gradient(-3.0).1[0], -1.0, CLOSE),
        ("second slope", f::hessian(-3.0).2[0][0], 0.0, CLOSE),
        ("difference, as written", g(-1.0, 2.0), -3.0, CLOSE),
        ("difference, value", g::value(-1.0, 2.0), -3.0, CLOSE),
        ("difference, by x", g::gradient(-1.0, 2.0).1[0], 4.0, CLOSE),
        ("difference, by y", g::gradient(-1.0, 2.0).1[1], -1.0, CLOSE),
    ]);
}

#[test]
fn roots_of_two_negative_numbers() {
    use formulas::{root_of_negative as f, root_of_product as g};
    check(&[
        ("as written", f(-4.0), 6.0, CLOSE),
        ("value", f::value(-4.0), 6.0, CLOSE),
        ("slope", f::gradient(-4.0).1[0], -0.75, CLOSE),
        ("product, as written", g(-2.0, -8.0), 4.5, CLOSE),
        ("product, value", g::value(-2.0, -8.0), 4.5, CLOSE),
        ("product, by x", g::gradient(-2.0, -8.0).1[0], -1.125, CLOSE),
        (
            "product, by y",
            g::gradient(-2.0, -8.0).1[1],
            -0.21875,
            CLOSE,
        ),
    ]);
}

#[test]
fn logarithms_of_negative_numbers() {
    use formulas::{logarithm_of_quotient as q, logarithm_of_square as s, two_sizes as t};
    check(&[
        ("two sizes, as written", t(-0.6), -0.3783487524680186, CLOSE),
        (
            "two sizes, value",
            t::value(-0.6),
            -0.3783487524680186,
            CLOSE,
        ),
        (
            "two sizes, slope",
            t::gradient(-0.6).1[0],
            2.3333333333333335,
            CLOSE,
        ),
        ("square, as written", s(-3.0), 2.1972245773362196, CLOSE),
        ("square, value", s::value(-3.0), 2.1972245773362196, CLOSE),
        ("square, slope", s::gradient(-3.0).1[0], -2.0 / 3.0, CLOSE),
        (
            "quotient, as written",
            q(-0.5, -4.0),
            -2.0 * std::f64::consts::LN_2 * 2.0,
            CLOSE,
        ),
        (
            "quotient, value",
            q::value(-0.5, -4.0),
            -2.0 * std::f64::consts::LN_2 * 2.0,
            CLOSE,
        ),
        ("quotient, by x", q::gradient(-0.5, -4.0).1[0], 0.0, CLOSE),
        ("quotient, by y", q::gradient(-0.5, -4.0).1[1], 0.5, CLOSE),
    ]);
}

#[test]
fn simplified_fractions() {
    use formulas::{expansion_about_an_angle as g, fractions_and_a_small_number as f};
    let (value, slopes) = g::gradient(1.0, 2.0, 3.0);
    check(&[
        ("as written", f(2.0, 5.0), -1.000000018, CLOSE),
        ("value", f::value(2.0, 5.0), -1.000000018, CLOSE),
        (
            "by u",
            f::gradient(2.0, 5.0).1[0],
            -0.6666666606666667,
            CLOSE,
        ),
        (
            "by v",
            f::gradient(2.0, 5.0).1[1],
            0.3333333273333333,
            CLOSE,
        ),
        (
            "expansion, as written",
            g(1.0, 2.0, 3.0),
            2.2410373266852384,
            CLOSE,
        ),
        (
            "expansion, value",
            g::value(1.0, 2.0, 3.0),
            2.2410373266852384,
            CLOSE,
        ),
        (
            "expansion, value with gradient",
            value,
            2.2410373266852384,
            CLOSE,
        ),
        ("expansion, by x", slopes[0], -9.99231097117673, CLOSE),
        ("expansion, by y", slopes[1], 1.8567212467199268, CLOSE),
        (
            "expansion, by z",
            slopes[2],
            0.3064465518886413,
            2.0 * CLOSE,
        ),
    ]);
}

#[test]
fn polynomials_that_cancel() {
    use formulas::{difference_of_legendre as g, sixth_of_one as f};
    check(&[
        ("as written", f(0.3), 1.0 / 6.0, CLOSE),
        ("value", f::value(0.3), 1.0 / 6.0, CLOSE),
        // The slope is 0; the form as written has roundings of numbers of the size of 1.
        ("1 + slope", 1.0 + f::gradient(0.3).1[0], 1.0, CLOSE),
        ("difference, as written", g(0.0, 0.0), 0.0, CLOSE),
        ("difference, value", g::value(0.0, 0.0), 0.0, CLOSE),
        ("difference, by x", g::gradient(0.0, 2.0).1[0], 20.0, CLOSE),
        ("difference, by y", g::gradient(1.0, 2.0).1[1], -7.5, CLOSE),
    ]);
}

#[test]
fn names_that_are_used_again() {
    use formulas::names_used_again as f;
    check(&[
        ("as written", f(1.0, 2.0), -0.14973849934787756, CLOSE),
        ("value", f::value(1.0, 2.0), -0.14973849934787756, CLOSE),
        (
            "by x",
            f::gradient(1.0, 2.0).1[0],
            0.19661193324148185,
            CLOSE,
        ),
        (
            "by y",
            f::gradient(1.0, 2.0).1[1],
            -0.10499358540350652,
            CLOSE,
        ),
    ]);
}
