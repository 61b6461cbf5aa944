//! The counts of operations that are stated are those of the code that comes out.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::cost::Cost;
use codegen::emit::scalar::Form;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use proptest::test_runner::{Config, RngSeed, TestRunner};
use support::formulas::random_module;

/// The operations in the body of an emitted function, by its tokens.
fn operations_in(tokens: TokenStream) -> Cost {
    let body = tokens.into_iter().last().unwrap();
    let TokenTree::Group(body) = body else {
        panic!("{body} is no body")
    };
    let mut cost = Cost::default();
    count(body.stream(), &mut cost);
    cost
}

fn count(tokens: TokenStream, cost: &mut Cost) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (position, token) in tokens.iter().enumerate() {
        let before = position.checked_sub(1).map(|before| &tokens[before]);
        match token {
            TokenTree::Group(group) => count(group.stream(), cost),
            TokenTree::Punct(mark) => match mark.as_char() {
                '+' => cost.add += 1,
                '-' if before.is_some_and(is_operand) => cost.add += 1,
                '*' => cost.mul += 1,
                '/' => cost.div += 1,
                _ => {}
            },
            TokenTree::Ident(word) => match word.to_string().as_str() {
                "sqrt" => cost.sqrt += 1,
                "sin" | "cos" | "tan" | "exp" | "ln" => cost.call += 1,
                "min" | "max" | "if" => cost.choice += 1,
                "mul_add" => {
                    cost.add += 1;
                    cost.mul += 1;
                }
                name if name.contains("_table") => {
                    let called = tokens.get(position + 1);
                    cost.call += usize::from(matches!(called, Some(TokenTree::Group(_))));
                }
                _ => {}
            },
            TokenTree::Literal(_) => {}
        }
    }
}

/// Whether a minus behind the token is a subtraction.
fn is_operand(token: &TokenTree) -> bool {
    match token {
        TokenTree::Group(group) => group.delimiter() != Delimiter::Brace,
        TokenTree::Ident(word) => !["if", "else", "return", "in"].iter().any(|key| word == key),
        TokenTree::Literal(_) => true,
        TokenTree::Punct(_) => false,
    }
}

fn assert_stated(source: &str, name: &str) {
    let mut expansion = support::expansion(source);
    for form in [Form::Value, Form::Gradient, Form::Hessian] {
        let form = support::generated(&mut expansion, name, form);
        let (stated, found) = (form.circuit.cost(), operations_in(form.tokens.clone()));
        assert_eq!(stated, found, "{}", form.tokens);
        let stated = format!(" Operations: {stated}.");
        assert!(form.tokens.to_string().contains(&stated), "{stated}");
    }
}

#[test]
fn random_formulas_take_as_many_operations_as_they_say() {
    let mut runner = TestRunner::new(Config {
        cases: 160,
        rng_seed: RngSeed::Fixed(4),
        failure_persistence: None,
        ..Config::default()
    });
    let outcome = runner.run(&random_module(), |module| {
        assert_stated(&module.source(), "formula");
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn formulas_of_this_crate_take_as_many_operations_as_they_say() {
    let small = include_str!("formulas/small.rs");
    for name in [
        "turned",
        "clamped",
        "quotient",
        "fractions",
        "circle",
        "tabulated",
    ] {
        assert_stated(small, name);
    }
}

/// The operations of one form of a function of x and y.
fn cost(function: &str, form: Form) -> Cost {
    let mut expansion = support::expansion(&format!("mod m {{ {function} }}"));
    support::generated(&mut expansion, "f", form).circuit.cost()
}

#[test]
fn a_multiple_and_its_negative_are_one_multiplication() {
    let cost = cost(
        "fn f(x: f64, y: f64) -> (f64, f64) { (y + 0.25 * x, -0.25 * x) }",
        Form::Value,
    );
    assert_eq!((cost.add, cost.mul), (1, 1));
}

#[test]
fn a_derivative_of_an_extreme_is_one_choice() {
    let cost = cost(
        "fn f(x: f64, y: f64) -> f64 { (3.0 * x).max(y * x) }",
        Form::Gradient,
    );
    assert_eq!((cost.choice, cost.call, cost.add), (3, 0, 0));
    assert!(cost.mul <= 2, "{cost}");
}

#[test]
fn small_formulas_take_as_few_operations_as_by_hand() {
    let counts = |function: &str, form| {
        let cost = cost(function, form);
        (cost.add, cost.mul, cost.div, cost.sqrt, cost.call)
    };
    let polynomial = "fn f(x: f64) -> f64 { 1.0 + 2.0 * x + 3.0 * x.powi(2) + 5.0 * x.powi(3) + 7.0 * x.powi(4) }";
    assert_eq!(counts(polynomial, Form::Gradient), (7, 7, 0, 0, 0));
    let cubed = "fn f(x: f64, y: f64) -> f64 { (x * x + y * y).powi(3).sqrt() }";
    assert_eq!(counts(cubed, Form::Gradient), (1, 6, 0, 1, 0));
    let quartic = "fn f(x: f64, y: f64) -> f64 { (x.powi(4) + y.powi(4)).sqrt() }";
    assert_eq!(counts(quartic, Form::Gradient), (1, 8, 1, 1, 0));
    let exponentials =
        "fn f(x: f64, y: f64) -> f64 { x.exp() * y.exp() + (-x).exp() + (2.0 * x).exp() }";
    assert_eq!(counts(exponentials, Form::Value).4, 2);
    let product = "fn f(x: f64, y: f64) -> f64 { x.exp() * y.exp() }";
    // The exponential of a sum in the hundreds loses two digits, so that both stay.
    assert_eq!(counts(product, Form::Value), (0, 1, 0, 0, 2));
}
