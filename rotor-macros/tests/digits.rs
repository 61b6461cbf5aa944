//! Generated forms keep the digits of the formulas as written, and are finite where those are.
#![allow(
    unreachable_pub,
    clippy::excessive_precision,
    reason = "formulas are `pub` as in a library; differences that vanish need numbers in full"
)]

#[rotor_macros::symbolic]
mod formulas {
    use std::f64::consts::TAU;
    use std::f64::consts::{PI as HALF_TURN, SQRT_2};

    /// Two forms of one polynomial; the first is 0/0 at x = y.
    #[generate(value)]
    pub fn both_ways(x: f64, y: f64) -> (f64, f64) {
        (
            (x.powi(3) - y.powi(3)) / (x - y),
            x.powi(2) + x * y + y.powi(2),
        )
    }

    /// A difference of squares, and its factors.
    #[generate(value)]
    pub fn squares(x: f64, y: f64) -> (f64, f64) {
        (x * x - y * y, (x - y) * (x + y))
    }

    /// Energy of springs between four points on a line, far from its origin.
    #[generate(value, gradient)]
    pub fn springs(a: f64, b: f64, c: f64, d: f64) -> f64 {
        (a - b).powi(2)
            + (a - c).powi(2)
            + (a - d).powi(2)
            + (b - c).powi(2)
            + (b - d).powi(2)
            + (c - d).powi(2)
    }

    /// A small term beside a difference.
    #[generate(value)]
    pub fn offset(x: f64, y: f64, s: f64) -> f64 {
        (x - y + s) * (x + s).sin()
    }

    /// Capacitors in series.
    #[generate(value, gradient)]
    pub fn in_series(c: [f64; 6]) -> f64 {
        1.0 / (1.0 / c[0] + 1.0 / c[1] + 1.0 / c[2] + 1.0 / c[3] + 1.0 / c[4] + 1.0 / c[5])
    }

    /// A power of a ratio of large numbers.
    #[generate(value, gradient)]
    pub fn ratio(x: f64, y: f64) -> f64 {
        (x / y).powi(30)
    }

    /// Finite at zero with its derivative.
    #[generate(value, gradient)]
    pub fn size_and_root(x: f64) -> f64 {
        x * x.abs().sqrt()
    }

    /// The same of two numbers.
    #[generate(value, gradient)]
    pub fn product_and_root(x: f64, y: f64) -> f64 {
        x * y * (x * y).sqrt()
    }

    /// A cube.
    pub fn cube(x: f64, y: f64) -> f64 {
        x.powi(3) * y.sin()
    }

    /// Its slope, with the arguments exchanged.
    pub fn slope(x: f64, y: f64) -> f64 {
        cube::d_x(y, x)
    }

    /// A partial of a formula that has a partial in it, and one by what a formula does not depend on.
    #[generate(value)]
    pub fn partial_of_partial(x: f64, y: f64) -> f64 {
        slope::d_x(y, x) + unused::d_y(x, y)
    }

    /// Without its second argument.
    pub fn unused(x: f64, y: f64) -> f64 {
        let _ = y;
        x * x
    }

    /// Constants by their imports, by another name, by their path.
    #[generate(value)]
    pub fn constants(x: f64) -> f64 {
        x * TAU + HALF_TURN + SQRT_2 + core::f64::consts::LN_2
    }

    /// Every input has its column, also one that cancels.
    #[generate(columns)]
    pub fn cancels(x: f64, y: f64) -> f64 {
        x + y - y
    }
}

fn close(found: f64, expected: f64, tolerance: f64) {
    let error = ((found - expected) / expected).abs();
    assert!(error <= tolerance, "{found} against {expected}");
}

#[test]
fn equal_forms_are_not_exchanged_for_worse_ones() {
    assert_eq!(formulas::both_ways::value(1.0, 1.0).1, 3.0);
    let (x, y) = (1.1, 1.100_000_000_000_000_3);
    close(formulas::both_ways::value(x, y).1, 3.63, 1e-14);
    let (x, y) = (1.0 + 3.0 * f64::EPSILON, 1.0);
    close(formulas::squares::value(x, y).1, 6.0 * f64::EPSILON, 1e-15);
}

#[test]
fn differences_keep_their_digits() {
    let at = |offset: f64| 3.3e9 + offset;
    let points = [at(0.0), at(0.001), at(0.002), at(0.004)];
    let [a, b, c, d] = points;
    let written = formulas::springs(a, b, c, d);
    close(formulas::springs::value(a, b, c, d), written, 1e-14);
    close(formulas::springs::gradient(a, b, c, d).0, written, 1e-14);
    let (x, y, s) = (1.0, 1.0 - f64::EPSILON / 2.0, 1e-17);
    close(
        formulas::offset::value(x, y, s),
        formulas::offset(x, y, s),
        1e-12,
    );
}

#[test]
fn nothing_overflows_or_underflows_that_does_not_as_written() {
    for size in [1e-60, 1e-11, 1.0, 1e60] {
        let c = [size; 6];
        close(formulas::in_series::value(c), size / 6.0, 1e-14);
        close(formulas::in_series::gradient(c).1[0], 1.0 / 36.0, 1e-14);
    }
    close(
        formulas::ratio::value(1.5e11, 1.4e11),
        (15.0_f64 / 14.0).powi(30),
        1e-13,
    );
    let (_, [by_x, _]) = formulas::ratio::gradient(1.5e11, 1.4e11);
    close(by_x, 30.0 * (15.0_f64 / 14.0).powi(30) / 1.5e11, 1e-13);
}

#[test]
fn derivatives_are_finite_where_the_function_is() {
    assert_eq!(formulas::size_and_root::gradient(0.0), (0.0, [0.0]));
    assert_eq!(formulas::product_and_root::gradient(0.0, 2.0).1[0], 0.0);
    close(formulas::size_and_root::gradient(-4.0).1[0], 3.0, 1e-15);
    close(
        formulas::product_and_root::gradient(2.0, 8.0).1[0],
        48.0,
        1e-15,
    );
}

#[test]
fn partials_of_partials_and_by_unused_arguments() {
    // slope(x, y) = 3y² sin x, so that its partial by x at (y, x) is 3x² cos y.
    let (x, y) = (0.7_f64, 0.4_f64);
    close(
        formulas::partial_of_partial::value(x, y),
        3.0 * x.powi(2) * y.cos(),
        1e-15,
    );
}

#[test]
fn a_constant_is_the_one_that_is_imported() {
    let expected = formulas::constants(2.0);
    close(formulas::constants::value(2.0), expected, 1e-15);
}

#[test]
fn an_input_that_cancels_has_a_column() {
    let inputs = formulas::cancels::Columns {
        x: &[1.0, 2.0],
        y: &[3.0, 4.0],
    };
    let mut sums = [0.0; 2];
    assert_eq!(formulas::cancels::columns(&inputs, [&mut sums]), Ok(()));
    assert_eq!(sums, [1.0, 2.0]);
}
