//! Generated derivatives at the edges of a formula: where a part of it is infinite or 0, and where digits are lost.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::emit::scalar::Form;
use support::evaluator::{Source, Value};

/// All numbers of a form of `f` at a point.
fn at(function: &str, form: Form, point: &[f64]) -> Vec<f64> {
    let mut expansion = support::expansion(&format!("mod m {{ {function} }}"));
    let generated = support::generated(&mut expansion, "f", form);
    let file: syn::File = syn::parse2(generated.tokens).unwrap();
    let arguments: Vec<Value> = point.iter().map(|x| Value::number(*x)).collect();
    let values = Source::of(&file.items).call(form.name(), &arguments);
    values.flatten().iter().map(|number| number.value).collect()
}

/// The tokens of a form of `f`.
fn code(function: &str, form: Form) -> String {
    let mut expansion = support::expansion(&format!("mod m {{ {function} }}"));
    support::generated(&mut expansion, "f", form)
        .tokens
        .to_string()
}

#[test]
fn a_root_of_a_cube_has_its_derivative_at_zero() {
    let cube = "fn f(x: f64) -> f64 { (x * x * x).sqrt() }";
    assert_eq!(at(cube, Form::Gradient, &[0.0]), [0.0, 0.0]);
    assert_eq!(at(cube, Form::Gradient, &[4.0]), [8.0, 3.0]);
    assert!(at(cube, Form::Value, &[-1.0])[0].is_nan());
}

#[test]
fn what_is_not_chosen_does_not_spoil_a_derivative() {
    let clipped = "fn f(x: f64) -> f64 { x.max(0.0).sqrt() }";
    assert_eq!(at(clipped, Form::Gradient, &[-1.0]), [0.0, 0.0]);
    // At a corner the derivative is that of the right side.
    assert_eq!(at(clipped, Form::Gradient, &[0.0]), [0.0, f64::INFINITY]);
    assert_eq!(at(clipped, Form::Gradient, &[4.0]), [2.0, 0.25]);
    let raised = "fn f(x: f64) -> f64 { x.sqrt().max(1.0) }";
    assert_eq!(at(raised, Form::Gradient, &[0.0]), [1.0, 0.0]);
    assert_eq!(at(raised, Form::Gradient, &[4.0]), [2.0, 0.25]);
    assert_eq!(at(raised, Form::Hessian, &[0.0]), [1.0, 0.0, 0.0]);
    let clamped = "fn f(x: f64, y: f64) -> f64 { (1.0 / x).min(y).max(-y) }";
    assert_eq!(at(clamped, Form::Gradient, &[0.0, 2.0]), [2.0, 0.0, 1.0]);
}

#[test]
fn second_derivatives_of_roots_keep_their_digits() {
    let hyperbola = "fn f(x: f64) -> f64 { (x * x + 1.0).sqrt() }";
    let shifted = "fn f(x: f64) -> f64 { (x * x + x + 1.0).sqrt() }";
    for x in [1e3_f64, 1e6, 1e8, 1e20] {
        let cube = |s: f64| s * s.sqrt();
        let found = at(hyperbola, Form::Hessian, &[x])[2];
        let exact = 1.0 / cube(x * x + 1.0);
        assert!((found / exact - 1.0).abs() < 1e-14, "{x}: {found}, {exact}");
        let found = at(shifted, Form::Hessian, &[x])[2];
        let exact = 0.75 / cube(x * x + x + 1.0);
        assert!((found / exact - 1.0).abs() < 1e-14, "{x}: {found}, {exact}");
    }
    let norm = "fn f(x: f64, y: f64) -> f64 { (x * x + y * y).sqrt() }";
    let found = at(norm, Form::Hessian, &[1e8, 1.0])[3];
    assert!((found / 1e-24 - 1.0).abs() < 1e-14, "{found}");
}

#[test]
fn functions_of_constants_are_no_calls() {
    let special =
        "fn f(y: f64) -> f64 { let x = 2.0; y * x.exp() / x.ln() + std::f64::consts::PI.cos() }";
    let text = code(special, Form::Value);
    assert!(!text.contains("exp") && !text.contains("ln") && !text.contains("cos"));
    let expected = 3.0 * 2.0_f64.exp() / 2.0_f64.ln() - 1.0;
    let found = at(special, Form::Value, &[3.0])[0];
    assert!((found / expected - 1.0).abs() <= f64::EPSILON);
    // What is no number stays what it is.
    assert!(
        at(
            "fn f(y: f64) -> f64 { y * (-2.0_f64).sqrt() }",
            Form::Value,
            &[1.0]
        )[0]
        .is_nan()
    );
    assert!(
        at(
            "fn f(y: f64) -> f64 { y * (-2.0_f64).ln() }",
            Form::Value,
            &[1.0]
        )[0]
        .is_nan()
    );
}

#[test]
fn sizes_beside_their_numbers_leave_no_signs() {
    let sizes = "#[domain(y > 0.0)] fn f(x: f64, y: f64) -> f64 { (4.0 * x * y).abs() * x }";
    let text = code(sizes, Form::Gradient);
    assert!(!text.contains("signum"), "{text}");
}

#[test]
fn numbers_far_from_one_stay_in_range() {
    let quotient = "fn f(x: f64, y: f64) -> f64 { (x / y).sqrt() / y }";
    for x in [1e-170, 1e-100, 1.0, 1e100, 1e170] {
        let found = at(quotient, Form::Value, &[x, x])[0];
        assert!((found * x - 1.0).abs() < 1e-14, "{x}: {found}");
        let root = "fn f(x: f64, y: f64) -> f64 { (x / y).sqrt() }";
        let slopes = at(root, Form::Gradient, &[x, x]);
        for (found, expected) in slopes.iter().zip([1.0, 0.5 / x, -0.5 / x]) {
            assert!((found / expected - 1.0).abs() < 1e-14, "{x}: {slopes:?}");
        }
    }
}
