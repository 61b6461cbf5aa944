//! Generated forms are as right as the function as written where other forms are equal on paper only, corners cancel, numbers
//! are no numbers, and where a source is long or deep.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use codegen::emit::scalar::Form;
use codegen::expand::{Expansion, Generated};
use codegen::factor::rounding::refuted;
use codegen::interpret::evaluate_circuit;
use proc_macro2::TokenStream;

/// A form of the function `f`, whose numbers may be any.
fn generated(function: &str, form: Form) -> Generated {
    let module = syn::parse_str(&format!("mod m {{ {function} }}")).unwrap();
    let mut expansion = Expansion::of(module);
    assert!(expansion.diagnostics.is_empty(), "{function}");
    let function = expansion.module().function("f").cloned().unwrap();
    expansion.generate(&function, form, &[]).unwrap()
}

/// What a form gives for the function's inputs in their order.
fn at(function: &str, form: Form, inputs: &[f64]) -> Vec<f64> {
    let form = generated(function, form);
    evaluate_circuit(&form.graph, &form.circuit, inputs)
}

fn of_one(body: &str) -> String {
    format!("fn f(x: f64) -> f64 {{ {body} }}")
}

fn of_two(body: &str) -> String {
    format!("fn f(x: f64, y: f64) -> f64 {{ {body} }}")
}

#[test]
fn no_literal_is_special() {
    let cases = [
        (
            "x / 2305843009213693951.0",
            1e18 / 2_305_843_009_213_693_951.0,
        ),
        ("x * 2.0_f64.powi(-61)", 1e18 / 2_305_843_009_213_693_952.0),
        (
            "2.0_f64.powi(61) * x - x",
            2_305_843_009_213_693_951.0 * 1e18,
        ),
        (
            "x + 2305843009213693951.0",
            1e18 + 2_305_843_009_213_693_951.0,
        ),
        // The primes of the fields themselves.
        (
            "x / 2305843009137777661.0 + x / 2305843009117747199.0",
            2e18 / 2_305_843_009_127_762_430.0,
        ),
    ];
    for (body, right) in cases {
        for form in [Form::Value, Form::Gradient] {
            let found = at(&of_one(body), form, &[1e18])[0];
            assert!(
                (found / right - 1.0).abs() < 1e-15,
                "{body}: {found} beside {right}"
            );
        }
    }
    assert_eq!(refuted(), 0);
}

/// Functions that are smooth though they are made of corners, a point where corners meet, and their slope there.
const SMOOTH: [(&str, f64, f64); 20] = [
    ("x.max(0.0) + (1.0 + (-x.abs()).exp()).ln()", 0.0, 0.5),
    ("0.0_f64.max(x) + (1.0 + (-x.abs()).exp()).ln()", 0.0, 0.5),
    ("(-x).max(0.0) + (1.0 + (-x.abs()).exp()).ln()", 0.0, -0.5),
    (
        "0.5 * (x + x.abs()) + (1.0 + (-(-x).abs()).exp()).ln()",
        0.0,
        0.5,
    ),
    ("x.min(0.0) - (1.0 + (-x.abs()).exp()).ln()", 0.0, 0.5),
    ("x.max(0.0) - (-x).max(0.0)", 0.0, 1.0),
    ("x.max(0.0) + x.min(0.0)", 0.0, 1.0),
    ("x.max(0.0).max(0.0) - (-x).max(0.0).max(0.0)", 0.0, 1.0),
    ("(-x).min(0.0) - x.min(0.0)", 0.0, -1.0),
    ("x * x.abs()", 0.0, 0.0),
    ("x.abs().powi(3)", 0.0, 0.0),
    ("x.max(-x) - x.abs() + x", 0.0, 1.0),
    ("x.max(0.0) - (1.0 - x.exp()).max(0.0)", 0.0, 1.0),
    ("x.exp().max(1.0) - (-x).exp().max(1.0)", 0.0, 1.0),
    ("x.exp().max(1.0) + x.exp().min(1.0)", 0.0, 1.0),
    ("(x - 2.0).max(0.0) - (2.0 - x).max(0.0)", 2.0, 1.0),
    ("x.max(3.0) + x.min(3.0)", 3.0, 1.0),
    ("x.max(0.0) + x.min(0.0).exp() - 1.0", 0.0, 1.0),
    (
        "x.abs().min(1.0).powi(2) * 0.5 + (x.abs() - x.abs().min(1.0))",
        1.0,
        1.0,
    ),
    ("x.max(2.0 * x) - x.max(0.0)", 0.0, 1.0),
];

#[test]
fn where_corners_cancel_the_slope_is_the_true_one() {
    for (body, x, right) in SMOOTH {
        for x in [x, if x == 0.0 { -0.0 } else { x }] {
            let slope = at(&of_one(body), Form::Gradient, &[x])[1];
            assert!(
                (slope - right).abs() <= 1e-15,
                "{body} at {x:?}: {slope} beside {right}"
            );
        }
    }
    let second = at(&of_one(SMOOTH[0].0), Form::Hessian, &[0.0])[2];
    assert_eq!(second, 0.25);
    let joined = of_two("x.max(y) + (1.0 + (-(x - y).abs()).exp()).ln()");
    let found = at(&joined, Form::Hessian, &[3.0, 3.0]);
    assert_eq!(found[1..], [0.5, 0.5, 0.25, -0.25, 0.25]);
}

#[test]
fn larger_and_smaller_ignore_what_is_no_number() {
    let clipped = of_one("x.ln().max(0.0)");
    assert_eq!(at(&clipped, Form::Gradient, &[-1.0]), [0.0, 0.0]);
    let smaller = of_two("(x * x).min(y)");
    assert_eq!(
        at(&smaller, Form::Gradient, &[2.0, f64::NAN]),
        [4.0, 4.0, 0.0]
    );
    assert_eq!(
        at(&smaller, Form::Gradient, &[f64::NAN, 2.0]),
        [2.0, 0.0, 1.0]
    );
}

#[test]
fn what_is_finite_as_written_is_finite() {
    let parallel = of_two("1.0 / (1.0 / x + 1.0 / y)");
    assert_eq!(at(&parallel, Form::Value, &[f64::INFINITY, 2.0]), [2.0]);
    assert_eq!(at(&parallel, Form::Value, &[1e170, 1e170]), [5e169]);
    let hypotenuse =
        of_two("let m = x.abs().max(y.abs()); m * ((x / m).powi(2) + (y / m).powi(2)).sqrt()");
    for size in [1e200, 1e-200, 1e300] {
        let found = at(&hypotenuse, Form::Value, &[size, size])[0];
        assert!(
            (found / size - std::f64::consts::SQRT_2).abs() < 1e-15,
            "{found}"
        );
    }
    let root = of_two("(x.powi(2) * y).sqrt()");
    assert_eq!(at(&root, Form::Value, &[0.0, -1.0]), [0.0]);
    let small = of_two("y * 1e-200 * (1e-200 * x).sin()");
    let slope = at(&small, Form::Gradient, &[0.0, 1e300])[1];
    assert!((slope / 1e-100 - 1.0).abs() < 1e-15, "{slope}");
    let middle = of_two("0.5 * x + 0.5 * y");
    assert_eq!(at(&middle, Form::Value, &[1.7e308, 1.5e308]), [1.6e308]);
}

#[test]
fn what_is_written_against_rounding_stays() {
    let same = |found: f64, right: f64| {
        assert!(
            (found / right - 1.0).abs() < 1e-15,
            "{found} beside {right}"
        )
    };
    let error_of_sum = of_two("let s = x + y; let t = s - x; (x - (s - t)) + (y - t)");
    same(at(&error_of_sum, Form::Value, &[1.0, 1e-17])[0], 1e-17);
    let error_of_product = of_two("x.mul_add(y, -(x * y))");
    same(
        at(&error_of_product, Form::Value, &[0.1, 0.3])[0],
        0.1_f64.mul_add(0.3, -(0.1 * 0.3)),
    );
    let split = of_one("let c = 134217729.0 * x; let high = c - (c - x); x - high");
    let c = 134_217_729.0 * 0.1;
    same(at(&split, Form::Value, &[0.1])[0], 0.1 - (c - (c - 0.1)));
    let logarithm = of_one("let u = 1.0 + x; u.ln() * x / (u - 1.0)");
    same(at(&logarithm, Form::Value, &[1e-8])[0], 1e-8_f64.ln_1p());
    let exponential = of_one("let u = x.exp(); (u - 1.0) * x / u.ln()");
    same(at(&exponential, Form::Value, &[1e-8])[0], 1e-8_f64.exp_m1());
}

/// A chain of quotients, each in the next.
fn chain(length: usize) -> String {
    let link = |n: usize| format!("let q{0} = q{n} / (p{n} + q{n}); let p{0} = q{n};", n + 1);
    let links: String = (0..length).map(link).collect();
    format!("fn f(x: f64, y: f64) -> f64 {{ let p0 = x; let q0 = y; {links} q{length} }}")
}

#[test]
fn chains_of_quotients_are_what_they_are() {
    for length in [13, 50, 100] {
        let (mut p, mut q) = ([10.0, 1.0, 0.0], [20.0, 0.0, 1.0]);
        for _ in 0..length {
            let sum: Vec<f64> = p.iter().zip(q).map(|(p, q)| p + q).collect();
            let value = q[0] / sum[0];
            let slope = |by: usize| (q[by] - value * sum[by]) / sum[0];
            (p, q) = (q, [value, slope(1), slope(2)]);
        }
        let found = at(&chain(length), Form::Gradient, &[10.0, 20.0]);
        for (found, right) in found.iter().zip(q) {
            assert!(
                (found - right).abs() <= 1e-12 * right.abs() + 1e-300,
                "{length}: {found} beside {right}"
            );
        }
    }
}

/// What the macro makes of a source, on a stack as a compiler has it.
fn expanded(source: String) -> String {
    let work = move || codegen::expand(TokenStream::new(), source.parse().unwrap()).to_string();
    let thread = std::thread::Builder::new().stack_size(8 << 20);
    thread.spawn(work).unwrap().join().unwrap()
}

/// A module with a function `f` of this body.
fn module_of(body: &str) -> String {
    format!("mod m {{ #[generate(value)] pub fn f(x: f64) -> f64 {{ {body} }} }}")
}

#[test]
fn groups_are_bounded() {
    let nested = format!("{}x{}", "(".repeat(10_000), ")".repeat(10_000));
    let text = expanded(module_of(&nested));
    assert!(text.contains("nested deeper than 128"));
}

#[test]
fn calls_are_bounded() {
    let calls: String = (0..10_000)
        .map(|place| format!("fn f{place}(x: f64) -> f64 {{ f{}(x) }} ", place + 1))
        .collect();
    let text = expanded(format!(
        "mod m {{ {calls} fn f10000(x: f64) -> f64 {{ x }} #[generate(value)] pub fn f(x: f64) -> f64 {{ f0(x) }} }}"
    ));
    assert!(text.contains("deeper than 256"));
}

#[test]
fn sums_are_as_long_as_they_are() {
    let sum: String = (1..=5000)
        .map(|place| format!(" + {place}.5 * x"))
        .collect();
    let text = expanded(module_of(&format!("x{sum}")));
    assert!(!text.contains("compile_error") && text.contains("pub fn value"));
}

#[test]
fn methods_are_as_many_as_they_are() {
    let text = expanded(module_of(&format!("x{}", ".abs().sqrt()".repeat(1000))));
    assert!(!text.contains("compile_error") && text.contains("pub fn value"));
}

#[test]
fn a_maximum_leaves_out_what_is_no_number_of_a_product_with_0() {
    // 0·√x and 0·x are NaN at x = −1 and at infinity, and Rust's `max` and `min` give the other number there.
    let larger = of_two("(0.0 * x.sqrt()).max(y)");
    assert_eq!(at(&larger, Form::Value, &[-1.0, -2.0]), [-2.0]);
    assert_eq!(at(&larger, Form::Value, &[4.0, -2.0]), [0.0]);
    let smaller = of_one("(x * 0.0).min(1.0) + 1.0");
    assert_eq!(at(&smaller, Form::Value, &[f64::INFINITY]), [2.0]);
    // Where nothing chooses, the product is 0: the author's is 0 or NaN.
    assert_eq!(at(&of_two("0.0 * x + y"), Form::Value, &[3.0, 5.0]), [5.0]);
}

/// Formulas of which forms with fewer operations leave the range of numbers, or lose digits at its end, where no list of
/// special numbers has a point; with such a point, the place of a number in the form, and the right one.
#[test]
fn what_a_form_alone_loses_is_found_where_it_loses_it() {
    let smallest = f64::MIN_POSITIVE;
    let cases: [(String, Form, [f64; 2], usize, f64); 6] = [
        // As 2^64·x^64 it has lost digits where x^64 is below the smallest normal number.
        (
            of_two("(x + x).powi(64) + 0.0 * y"),
            Form::Value,
            [1.5 * 2.0_f64.powi(-17), 1.0],
            0,
            1.5_f64.powi(64) * 2.0_f64.powi(-1000) * 2.0_f64.powi(-24),
        ),
        // (x·y)·π and x·(y·π) lose digits where the first product is small and the other number large.
        (
            of_two("std::f64::consts::PI * (x * y)"),
            Form::Value,
            [3e-320, 1e170],
            0,
            std::f64::consts::PI * (3e-320 * 1e170),
        ),
        // The mixed second derivative, −(4/9)·(y/x)^(1/3)/(xy), of which the parts may be infinite.
        (
            of_two("(y / x).cbrt()"),
            Form::Hessian,
            [1.0, smallest],
            4,
            -smallest.cbrt() / smallest / 9.0,
        ),
        // With the fourth power of a cosh there would be nothing left: −2·tanh/cosh².
        (
            of_two("x.tanh() + 0.0 * y"),
            Form::Hessian,
            [266.5, 1.0],
            3,
            -8.0 * (-266.5_f64).exp() * (-266.5_f64).exp(),
        ),
        // A comparison with what is no number fails.
        (
            of_two("if x - x >= y { y } else { y.tanh() }"),
            Form::Value,
            [f64::NAN, -1.0],
            0,
            (-1.0_f64).tanh(),
        ),
        (
            of_two("if 1.0 >= 0.0 / x.acosh() { 1.0 } else { y }"),
            Form::Value,
            [0.5, -1.0],
            0,
            -1.0,
        ),
    ];
    for (function, form, inputs, place, right) in cases {
        let found = at(&function, form, &inputs)[place];
        assert!(
            (found / right - 1.0).abs() < 1e-13,
            "{function} at {inputs:?}: {found:e} beside {right:e}"
        );
    }
}

#[test]
fn what_turns_out_to_be_a_division_by_0_is_code() {
    let body = "((1.0 / ((x + x).powi(2) - x.powi(2) - 2.0 * x * x - x.powi(2)) - 1.0) / y).sqrt()";
    let found = at(&of_two(body), Form::Hessian, &[1.0, 1.0]);
    assert!(!found[0].is_finite(), "{found:?}");
}
