//! Numbers in formulas: they are the `f64` nearest to what is written, and so is zero with its sign.

use crate::{CLOSE, SAME, check};

#[rotor_macros::symbolic]
mod formulas {
    /// Ghidra printed the reciprocal of 2^32 with eight digits after the point: 0.
    /// <https://github.com/NationalSecurityAgency/ghidra/issues/778>
    #[generate(value, gradient(x))]
    pub fn fraction_of_a_turn(x: f64) -> f64 {
        x / 4294967296.0 + x * 2.3283064365386963e-10
    }

    /// Shift printed whole numbers beyond 2^63 as 2^63 - 1.
    /// <https://github.com/shapesecurity/shift-java/issues/233>
    #[generate(value, gradient(x))]
    pub fn times_two_to_64(x: f64) -> f64 {
        x * 18446744073709551616.0
    }

    /// Cython cut off large whole numbers that stand beside `double`s.
    /// <https://github.com/cython/cython/issues/1098>
    #[generate(value, gradient(x))]
    pub fn beyond_whole_numbers(x: f64) -> f64 {
        (x + 1e22) * 2.0_f64.powi(-61) + x / 100000000000000000000000.0
    }

    /// SymPy's C code had whole numbers as integer constants, too large for their type.
    /// <https://github.com/sympy/sympy/pull/1763>
    #[generate(value, gradient(x))]
    pub fn large_coefficients(x: f64) -> f64 {
        12157665459056928801.0 * x.powi(3) - 6568408355712890625.0 * x.powi(2)
    }

    /// quick-lint-js is asked to warn that 9999999999999999 is 10000000000000000.
    /// <https://github.com/quick-lint/quick-lint-js/issues/44>
    #[generate(value)]
    pub fn sixteen_nines(x: f64) -> f64 {
        9999999999999999.0 * x - 10000000000000000.0 * x
    }

    /// fpy computes constants in decimals: 0.1 + 0.2 is 0.3 there, and 0.30000000000000004 when the program runs.
    /// <https://github.com/fprime-community/fpy/issues/126>
    #[generate(value)]
    pub fn tenths(x: f64) -> f64 {
        (0.1 + 0.2 - 0.3) * x
    }

    /// SymPy's `lambdify` had 9.7e-17 where √2 in many digits is taken from √2.
    /// <https://github.com/sympy/sympy/issues/8818>
    #[generate(value)]
    pub fn from_root_of_two(x: f64) -> f64 {
        x - 1.414213562373095048801688724209698078569671875377
    }

    /// SymEngine's `simplify` rounds numbers to 14 digits.
    /// <https://github.com/symengine/symengine/issues/1898>
    #[generate(value, gradient(x))]
    pub fn sixteen_digits(x: f64) -> f64 {
        4.347249999999999 * x
    }

    /// Go's compiler took x + 0 for x, which it is not for -0.
    /// <https://github.com/golang/go/issues/27718>
    #[generate(value)]
    pub fn plus_zero(x: f64) -> f64 {
        x + 0.0
    }

    /// OCANNL wrote the constant -0.0 as the whole number 0.
    /// <https://github.com/ahrefs/ocannl/issues/623>
    #[generate(value)]
    pub fn minus_zero(x: f64) -> f64 {
        x.max(1.0) * -0.0
    }

    /// LLVM dropped `fabs` of a power of -0, and with it the sign.
    /// <https://github.com/llvm/llvm-project/issues/31050>
    #[generate(value)]
    pub fn size_of_cube(x: f64) -> (f64, f64) {
        (x.powi(3).abs(), x.powi(3))
    }

    /// Rust's `signum` of ±0 is ±1, not 0 as elsewhere.
    /// <https://github.com/rust-lang/rust/issues/57543>
    #[generate(value, gradient(x))]
    pub fn sign(x: f64) -> f64 {
        x.signum()
    }

    /// XLA's guard for √x √x = x let -0 pass, of which the product is +0.
    /// <https://github.com/openxla/xla/pull/14478>
    #[generate(value)]
    pub fn root_times_root(x: f64) -> f64 {
        x.sqrt() * x.sqrt()
    }
}

#[test]
fn large_and_small_numbers() {
    use formulas::{
        beyond_whole_numbers as beyond, fraction_of_a_turn as turn, large_coefficients as large,
        times_two_to_64 as two,
    };
    check(&[
        ("turn, as written", turn(3.0), 1.3969838619232178e-9, CLOSE),
        (
            "turn, value",
            turn::value(3.0),
            1.3969838619232178e-9,
            CLOSE,
        ),
        (
            "turn, slope",
            turn::gradient(3.0).1[0],
            4.656612873077393e-10,
            CLOSE,
        ),
        ("2^64, value", two::value(0.5), 9223372036854775808.0, SAME),
        (
            "2^64, slope",
            two::gradient(0.5).1[0],
            18446744073709551616.0,
            SAME,
        ),
        ("beyond, as written", beyond(1e22), 8673.717379884036, CLOSE),
        (
            "beyond, value",
            beyond::value(1e22),
            8673.717379884036,
            CLOSE,
        ),
        (
            "beyond, slope",
            beyond::gradient(1e22).1[0],
            4.336908689942018e-19,
            CLOSE,
        ),
        (
            "coefficients, as written",
            large(2.0),
            7.098769024960387e19,
            CLOSE,
        ),
        (
            "coefficients, value",
            large::value(2.0),
            7.098769024960387e19,
            CLOSE,
        ),
        (
            "coefficients, slope",
            large::gradient(2.0).1[0],
            1.1961835208583158e20,
            CLOSE,
        ),
    ]);
}
