//! Loops give what their turns written out give, and end where they would be too long.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::diagnostics::Diagnostics;
use codegen::emit::scalar::Form;
use codegen::show;

/// The tokens of the gradient of `f`.
fn code(items: &str) -> String {
    let mut expansion = support::expansion(&format!("mod m {{ {items} }}"));
    let generated = support::generated(&mut expansion, "f", Form::Gradient);
    generated.tokens.to_string()
}

/// The messages of a module.
fn messages(items: &str) -> Vec<String> {
    let source = format!("#[symbolic] mod m {{ {items} }}");
    let mut expansion = show::module(&source).expect("a module");
    expansion.read_all();
    let texts = |diagnostics: &Diagnostics| diagnostics.iter().map(|it| it.text()).collect();
    texts(&expansion.diagnostics)
}

#[test]
fn a_loop_is_its_turns() {
    let pairs = [
        (
            "let mut s = 0.0; for i in 0..4 { s += x.powi(i) * y; } s",
            "let s = x.powi(0) * y + x.powi(1) * y + x.powi(2) * y + x.powi(3) * y; s",
        ),
        (
            "let mut s = x; for i in (1..=3).rev() { s -= y / i as f64; } s",
            "let s = x - y / 3.0 - y / 2.0 - y / 1.0; s",
        ),
        (
            "let mut p = x; for c in [0.5, y, 2.0] { p *= c; p = p.sin() + c; } p",
            "let p = x * 0.5; let p = p.sin() + 0.5; let p = p * y; let p = p.sin() + y; let p = p * 2.0; let p = p.sin() + 2.0; p",
        ),
        (
            "let q = [x, y, x * y]; q.iter().zip([1.5, 2.5, 3.5]).map(|(a, b)| a * b).sum::<f64>()",
            "x * 1.5 + y * 2.5 + (x * y) * 3.5",
        ),
        ("[x, y, 2.0].iter().product()", "x * y * 2.0"),
        (
            "[x, y, 2.0].into_iter().skip(1).fold(x, |a, b| a.max(b))",
            "let a = x.max(y); a.max(2.0)",
        ),
        (
            "let mut a = [0.0; 3]; for i in 0..3 { a[i] = x * i as f64; a[i] += y; } a[2] / a[1]",
            "(x * 2.0 + y) / (x * 1.0 + y)",
        ),
        (
            "let mut a = x; let b = y; if x > y { a = b; } else if x > 0.0 { a *= b; } a",
            "let b = y; let a = if x > y { b } else if x > 0.0 { let a = x * b; a } else { x }; a",
        ),
    ];
    for (looped, written) in pairs {
        let [looped, written] = [looped, written]
            .map(|body| code(&format!("fn f(x: f64, y: f64) -> f64 {{ {body} }}")));
        assert_eq!(looped, written);
    }
}

#[test]
fn long_loops_are_read_and_longer_ones_refused() {
    let sum = |count: usize| {
        format!(
            "fn f(x: f64) -> f64 {{ let mut s = 0.0; for k in 0..{count} {{ s += x; s = s * 0.5; }} s }}"
        )
    };
    assert!(messages(&sum(20_000)).is_empty());
    let refused = messages(&sum(40_000));
    assert_eq!(refused.len(), 1, "{refused:?}");
    assert!(
        refused[0].contains("more than 100000 statements"),
        "{refused:?}"
    );
}

#[test]
fn calls_that_double_end() {
    let mut items = "fn f0(x: f64) -> f64 { x.sin() }".to_owned();
    for level in 1..22 {
        let below = level - 1;
        items += &format!("fn f{level}(x: f64) -> f64 {{ f{below}(x) + f{below}(2.0 * x) }}");
    }
    let refused = messages(&items);
    assert_eq!(refused.len(), 1, "{refused:?}");
    assert!(
        refused[0].contains("more than 100000 statements"),
        "{refused:?}"
    );
}

#[test]
fn a_large_array_is_filled_in_time() {
    let items = "fn f(x: f64) -> f64 {
        let mut a = [0.0; 4096];
        for i in 0..4096 { a[i] += x * i as f64; }
        let mut s = 0.0;
        for i in 1..4096 { s += a[i] * a[i - 1]; }
        s
    }";
    assert!(messages(items).is_empty());
}
