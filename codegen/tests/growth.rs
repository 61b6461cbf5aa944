//! The work of the searches grows as the formula does: looks at candidates are counted, for formulas of n terms and of 2n.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use codegen::budget::Budget;
use codegen::differentiate;
use codegen::emit::scalar::Form;
use codegen::expand::derive;
use codegen::factor::extract::{ORDERS, extract_within};
use codegen::factor::lower;
use codegen::show;

/// Terms in the shorter of two formulas: so many that the square of their number is far beyond every budget.
const TERMS: usize = 1000;

/// `first` and so many steps, each with another number; `{k}` stands for its place, `{c}` for a number, `t` for what is
/// there already.
fn steps(first: &str, step: &str, count: usize) -> String {
    let mut source = format!("let t = {first};");
    for k in 0..count {
        let number = format!("{k}.{}", 1 + k * 37 % 97);
        let step = step.replace("{k}", &k.to_string()).replace("{c}", &number);
        source += &format!("let t = {step};");
    }
    source + "t"
}

/// Looks that a function's gradient by `x` and `y` takes, and those of the searches through its circuit.
fn looks(body: &str) -> [usize; 2] {
    let source = format!("#[symbolic] mod m {{ pub fn f(x: f64, y: f64) -> f64 {{ {body} }} }}");
    let mut expansion = show::module(&source).expect("a module");
    expansion.read_all();
    let formula = expansion.formula("f").expect("a formula");
    let mut graph = formula.graph.clone();
    let by = ["x", "y"].map(|name| graph.find_symbol(name).expect("an input"));
    let mut of_gradient = Budget::default();
    differentiate::gradient_within(&mut graph, formula.roots[0], &by, &mut of_gradient);
    let (graph, outputs) = derive(formula, Form::Gradient, &by);
    let circuit = lower::lower(&graph, &outputs.all());
    let mut of_searches = Budget::default();
    // Orders in which sums and in which products are shared first.
    for order in [ORDERS[1], ORDERS[7]] {
        extract_within(&mut circuit.clone(), order, &mut of_searches);
    }
    [of_gradient.spent(), of_searches.spent()]
}

/// Twice the terms take little more than twice the looks.
fn assert_growth(first: &str, step: &str) {
    let [short, long] = [TERMS, 2 * TERMS].map(|count| looks(&steps(first, step, count)));
    for (short, long) in short.into_iter().zip(long) {
        assert!(
            long as f64 <= 2.5 * short as f64 + 1000.0,
            "{step}: {short} looks, then {long}"
        );
    }
}

#[test]
fn sums_of_many_terms() {
    assert_growth("y", "t + ({c} * x + 0.{k} * y).sin()");
    assert_growth(
        "y",
        "t + {c} * x * y.powi({k} % 7)"
            .replace("{k} % 7", "3")
            .as_str(),
    );
    assert_growth("y", "t + 1.0 / (x + {c})");
    assert_growth("y", "t + x.min({c})");
}

#[test]
fn products_of_many_factors() {
    assert_growth("y", "t * (x + {c})");
    assert_growth("x * y", "t / (x + {c})");
}

#[test]
fn chains() {
    assert_growth("y", "t.min({c} * x)");
    assert_growth("y", "(t + {c}).max({c} * x)");
    assert_growth("y", "{c} + x * t / (x + t)");
}
