//! The generated functions against published values, finite differences and the formulas as written.

use std::f64::consts::{FRAC_PI_2, PI};

use mathieu::formulas::{self, even_period_pi, even_period_pi_slope, mean_root, slow_exponent};
use mathieu::{Boundary, residuals};

/// Characteristic values, NIST Digital Library of Mathematical Functions, chapter 28, to the ten decimals given there.
const PUBLISHED: [(f64, Boundary, f64); 10] = [
    (1.0, Boundary::A0, -0.4551386041),
    (1.0, Boundary::B1, -0.1102488170),
    (1.0, Boundary::A1, 1.8591080725),
    (1.0, Boundary::B2, 3.9170247730),
    (1.0, Boundary::A2, 4.3713009827),
    (5.0, Boundary::A0, -5.8000460209),
    (5.0, Boundary::B1, -5.7900805986),
    (5.0, Boundary::A1, 1.8581875415),
    (5.0, Boundary::B2, 2.0994604455),
    (5.0, Boundary::A2, 7.4491097395),
];

#[test]
fn boundaries_are_those_published() {
    for (q, boundary, published) in PUBLISHED {
        let found = boundary.at(q).unwrap();
        assert!(
            (found - published).abs() <= 1e-10,
            "{boundary:?} at q = {q}: {found}, published {published}"
        );
    }
}

#[test]
fn no_boundary_is_none() {
    assert_eq!(Boundary::A0.at(f64::NAN), None);
    assert_eq!(Boundary::A0.at(f64::INFINITY), None);
}

/// Central difference of fourth order.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

#[test]
fn gradients_agree_with_finite_differences() {
    for (a, q) in [(0.3, 0.8), (-2.0, 2.5), (7.0, 5.0)] {
        for boundary in Boundary::ALL {
            let (_, [by_a, by_q]) = boundary.determinant(a, q);
            let numerical_a = difference(|a| boundary.determinant(a, q).0, a);
            let numerical_q = difference(|q| boundary.determinant(a, q).0, q);
            assert!(
                (by_a - numerical_a).abs() <= 1e-8 * by_a.abs(),
                "{boundary:?} by a: {by_a}, {numerical_a}"
            );
            assert!(
                (by_q - numerical_q).abs() <= 1e-8 * by_q.abs(),
                "{boundary:?} by q: {by_q}, {numerical_q}"
            );
        }
    }
}

#[test]
fn generated_values_are_those_of_the_formulas_as_written() {
    for (a, q) in [(0.3, 0.8), (-2.0, 2.5), (7.0, 5.0)] {
        let (written, generated) = (
            formulas::even_period_pi(a, q),
            even_period_pi::gradient(a, q).0,
        );
        assert!(
            (written - generated).abs() <= 1e-12 * written.abs(),
            "{written}, {generated}"
        );
    }
    let (written, generated) = (
        formulas::slow_exponent(40.0, 5.0),
        slow_exponent::value(40.0, 5.0),
    );
    assert!(
        (written - generated).abs() <= 1e-12 * written,
        "{written}, {generated}"
    );
}

#[test]
fn the_slope_is_that_of_the_curve() {
    let a = Boundary::A0.at(2.0).unwrap();
    let numerical = difference(|q| Boundary::A0.at(q).unwrap(), 2.0);
    let slope = even_period_pi_slope::value(a, 2.0);
    assert!((slope - numerical).abs() <= 1e-9, "{slope}, {numerical}");
    let (values, slopes) = residuals(&[a, a], &[2.0, 2.0]).unwrap();
    assert_eq!(slopes[0], slopes[1]);
    assert!(
        (slopes[0] - slope).abs() <= 1e-12 * slope.abs(),
        "{slopes:?}, {slope}"
    );
    assert_eq!(values[0], even_period_pi::gradient(a, 2.0).0);
}

#[test]
fn columns_of_two_lengths_are_refused() {
    let error = residuals(&[1.0, 2.0], &[1.0]).unwrap_err();
    assert_eq!((error.column, error.length, error.expected), ("q", 1, 2));
}

/// Complete elliptic integral of the second kind of the parameter m, by the arithmetic-geometric mean.
fn elliptic_e(m: f64) -> f64 {
    let (mut a, mut g, mut power) = (1.0_f64, (1.0 - m).sqrt(), 0.5);
    let mut sum = power * m;
    while (a - g).abs() > 1e-16 {
        let c = 0.5 * (a - g);
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
        power *= 2.0;
        sum += power * c * c;
        if c.abs() < 1e-16 {
            break;
        }
    }
    FRAC_PI_2 / a * (1.0 - sum)
}

#[test]
fn the_tabulated_integral_is_elliptic() {
    for r in [0.0_f64, 0.1, 0.33, 0.5, 0.77, 0.95] {
        let exact = 2.0 / PI * (1.0 + r).sqrt() * elliptic_e(2.0 * r / (1.0 + r));
        let (value, [slope]) = mean_root::gradient(r);
        assert!((value - exact).abs() <= 2e-13, "r = {r}: {value}, {exact}");
        assert_eq!(value, mean_root::value(r));
        if r > 0.01 && r < 0.9 {
            let numerical = difference(mean_root::value, r);
            assert!(
                (slope - numerical).abs() <= 1e-9,
                "r = {r}: {slope}, {numerical}"
            );
        }
    }
}
