//! What each step of staging saves at the points of the inner loop.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

mod support;

use codegen::cost::Cost;

/// The operations at each point of a function `f` staged along `t`.
fn at_points(function: &str) -> Cost {
    let source = format!("mod m {{ #[generate(stage(t))] {function} }}");
    let mut expansion = support::expansion(&source);
    let function = expansion.module().function("f").cloned().unwrap();
    let stage = function.request.clone().unwrap().stages[0].clone();
    let (staged, ..) = expansion.staged(&function, &stage).unwrap();
    staged.points.cost()
}

#[test]
fn two_roots_in_one_product_are_one_root() {
    let cost = at_points("fn f(a: f64, b: f64, t: f64) -> f64 { (a + t).sqrt() * (b + t).sqrt() }");
    assert_eq!(cost.sqrt, 1, "{cost}");
}

#[test]
fn what_cancels_is_not_computed() {
    let cost = at_points(
        "fn f(a: f64, t: f64) -> f64 { (a + t) * ((t + a + 1.0).powi(2) - (t + a).powi(2) - 2.0 * (t + a)) }",
    );
    assert_eq!((cost.add, cost.mul), (1, 0), "{cost}");
}

#[test]
fn a_factor_that_stands_still_is_taken_into_the_root() {
    let cost = at_points(
        "#[domain(k >= 0.0, a >= 0.0, b >= 0.0, t >= 0.0)] fn f(k: f64, a: f64, b: f64, t: f64) -> f64 { k * (a + b * t).sqrt() }",
    );
    assert_eq!((cost.add, cost.mul, cost.sqrt), (1, 1, 1));
}

#[test]
fn factors_that_stand_still_are_gathered() {
    let cost =
        at_points("fn f(a: f64, b: f64, c: f64, t: f64) -> f64 { a * t.sin() * b * (c + t) }");
    assert_eq!((cost.add, cost.mul), (1, 2), "{cost}");
}

#[test]
fn a_common_factor_is_taken_out() {
    let cost =
        at_points("fn f(a: f64, b: f64, c: f64, t: f64) -> f64 { a / (c + t) + b * t / (c + t) }");
    assert_eq!((cost.div, cost.mul), (1, 1), "{cost}");
}
