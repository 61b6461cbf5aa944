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

#[test]
fn a_corner_of_an_if_is_that_of_the_branch_that_is_taken() {
    let value = |source: &str, x: f64| at(source, Form::Gradient, &[x])[1];
    // Both branches of the softplus have the slope 1/2 at 0.
    let softplus =
        "fn f(x: f64) -> f64 { if x > 0.0 { x + (-x).exp().ln_1p() } else { x.exp().ln_1p() } }";
    for x in [0.0, -0.0, 1e-300, -1e-300] {
        assert_eq!(value(softplus, x), 0.5, "{x}");
    }
    let size = "fn f(x: f64) -> f64 { if x <= 0.0 { -x } else { x } }";
    assert_eq!([-1.0, 0.0, 1.0].map(|x| value(size, x)), [-1.0, -1.0, 1.0]);
    // The larger of the two that are compared is seen from the side that all corners are seen from.
    let ramps = "fn f(x: f64) -> f64 { (if x > 0.0 { x } else { 0.0 }) - (-x).max(0.0) }";
    let others = "fn f(x: f64) -> f64 { x.clamp(0.0, 1.0) + (x - 1.0).max(0.0) + x.min(0.0) }";
    let one_sided = "fn f(x: f64) -> f64 { if x < 1.0 { x } else { 1.0 } }";
    for source in [ramps, others] {
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0].map(|x| value(source, x)),
            [1.0; 4],
            "{source}"
        );
    }
    assert_eq!(
        [0.5, 1.0, 2.0].map(|x| value(one_sided, x)),
        [1.0, 0.0, 0.0]
    );
}

#[test]
fn what_is_not_taken_may_be_no_number() {
    let guarded = "fn f(x: f64) -> f64 { if x > 0.0 { x.ln() / x.sqrt() } else if x == 0.0 { 3.0 } else { (-x).powf(0.5) } }";
    assert_eq!(at(guarded, Form::Hessian, &[0.0]), [3.0, 0.0, 0.0]);
    let [value, slope] = at(guarded, Form::Gradient, &[-4.0])[..] else {
        panic!("two numbers")
    };
    assert_eq!((value, slope), (2.0, -0.25));
    let joined = "fn f(x: f64, y: f64) -> f64 { if x > 0.0 && y > 0.0 || x == y { x * y } else { (1.0 / y).acosh() } }";
    assert_eq!(at(joined, Form::Gradient, &[0.0, 0.0]), [0.0, 0.0, 0.0]);
    assert_eq!(at(joined, Form::Gradient, &[2.0, 3.0]), [6.0, 3.0, 2.0]);
    let opposite = "fn f(x: f64, y: f64) -> f64 { if !(x > 0.0 && y > 0.0) { y } else { x } }";
    assert_eq!(at(opposite, Form::Value, &[f64::NAN, 2.0]), [2.0]);
    assert_eq!(at(opposite, Form::Value, &[1.0, 2.0]), [1.0]);
}

#[test]
fn jumps_have_the_slope_zero() {
    let steps = "fn f(x: f64, y: f64) -> f64 { x.floor() * y + x.round() - x.trunc() + x.ceil() + x.fract() }";
    assert_eq!(at(steps, Form::Gradient, &[2.25, 3.0])[1..], [1.0, 2.0]);
}

#[test]
fn an_angle_has_the_sign_of_a_zero() {
    let angle = "fn f(y: f64, x: f64) -> f64 { y.atan2(x) }";
    use std::f64::consts::PI;
    let points = [[0.0, -1.0], [-0.0, -1.0], [0.0, 1.0], [-1.0, 0.0]];
    let angles = points.map(|point| at(angle, Form::Value, &point)[0]);
    assert_eq!(angles, [PI, -PI, 0.0, -0.5 * PI]);
}

#[test]
fn second_derivatives_of_angles_need_no_length() {
    let angle = "fn f(y: f64, x: f64) -> f64 { y.atan2(x) }";
    let text = code(angle, Form::Hessian);
    assert!(!text.contains("hypot"), "{text}");
    let found = at(angle, Form::Hessian, &[1.0, 2.0]);
    let right = [1.0_f64.atan2(2.0), 0.4, -0.2, -0.16, -0.12, -0.12, 0.16];
    for (found, right) in found.iter().zip(right) {
        assert!((found - right).abs() < 1e-15, "{found}, {right}");
    }
}
