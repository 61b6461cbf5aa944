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
use codegen::expand::{Formula, derive, derive_written};
use codegen::factor::extract::{ORDERS, extract_with};
use codegen::factor::passes::Passes;
use codegen::factor::rounding::Written;
use codegen::factor::{lower, probes};
use codegen::graph::SymbolId;
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

/// What is counted of a function and its gradient by `x` and `y`: looks for the gradient, looks of the searches through its
/// circuit, operands in its graph, in which no product may be written out at every step of a chain, and operations that
/// are done to hold forms against the author's, over all points.
fn counted(body: &str) -> [(&'static str, usize); 4] {
    let source = format!("#[symbolic] mod m {{ pub fn f(x: f64, y: f64) -> f64 {{ {body} }} }}");
    let mut expansion = show::module(&source).expect("a module");
    expansion.read_all();
    let formula = expansion.formula("f").expect("a formula");
    let mut graph = formula.graph.clone();
    let by = ["x", "y"].map(|name| graph.find_symbol(name).expect("an input"));
    let mut of_gradient = Budget::default();
    differentiate::gradient_within(&mut graph, formula.roots[0], &by, &mut of_gradient);
    let (graph, outputs) = derive(formula, Form::Gradient, &by);
    let all = outputs.all();
    let operands = graph.reachable(&all).into_iter();
    let operands = operands.map(|id| graph.operands(id).len()).sum();
    let circuit = lower::lower(&graph, &all);
    let mut of_searches = Budget::default();
    // Orders in which sums and in which products are shared first.
    for order in [ORDERS[1], ORDERS[7]] {
        extract_with(&mut circuit.clone(), order, Passes::ALL, &mut of_searches);
    }
    [
        ("looks for the gradient", of_gradient.spent()),
        ("looks of the searches", of_searches.spent()),
        ("operands", operands),
        ("operations at points", at_points(formula, &by)),
    ]
}

/// The operations of the author's form at all points on which others are held against it.
fn at_points(formula: &Formula, by: &[SymbolId]) -> usize {
    let Written {
        graph,
        roots,
        reverse,
        ..
    } = derive_written(formula, Form::Gradient, by);
    let operations = graph.reachable(&[roots.clone(), reverse].concat()).len();
    let differences = probes::differences(&graph, &roots);
    let share = probes::share(operations);
    let groups = probes::groups(&graph, &differences, share);
    let in_groups: usize = groups.iter().map(Vec::len).sum();
    operations * (probes::points(&graph, &roots, &differences, share).len() + in_groups)
}

/// Twice the terms take little more than twice of all that is counted.
fn assert_growth(first: &str, step: &str) {
    let [short, long] = [TERMS, 2 * TERMS].map(|count| counted(&steps(first, step, count)));
    for ((what, short), (_, long)) in short.into_iter().zip(long) {
        assert!(
            long as f64 <= 2.5 * short as f64 + 1000.0,
            "{step}: {short} {what}, then {long}"
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
    assert_growth("y", "t + (x + {c}).powi(2)");
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
    assert_growth("y", "(t + x).sqrt()");
}

#[test]
fn chains_of_quotients() {
    assert_growth("y", "{c} + x / t");
    assert_growth("y", "{c} + x * t / (x + t)");
    assert_growth("y", "(t + {c}) / (x + t)");
}

/// Whatever a formula's size, what it is looked at with is bounded, and small ones are looked at on all points.
#[test]
fn points_are_as_many_as_a_formula_can_afford() {
    assert_eq!(probes::share(0), 1.0);
    assert_eq!(probes::share(2_000), 1.0);
    assert!(probes::share(8_000) < 0.5);
    assert!(probes::share(1_000_000) > 0.1);
}
