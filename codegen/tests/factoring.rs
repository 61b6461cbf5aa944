//! The steps between a formula and its operations, each on the smallest thing that it changes.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::circuit::{Circuit, Net, Operation};
use codegen::cost::Cost;
use codegen::differentiate;
use codegen::emit::scalar::Form;
use codegen::factor::coefficients;
use codegen::factor::extract::{Step, extract};
use codegen::gather::gather;
use codegen::graph::decimal;
use codegen::graph::{Function, Graph, Node, Rational, ratio, whole};
use codegen::parse::literal::constant;

/// A circuit with symbols x0, x1, …
fn circuit(symbols: usize) -> (Circuit, Vec<Net>) {
    let (mut graph, mut circuit) = (Graph::new(), Circuit::default());
    let symbols = (0..symbols).map(|position| graph.symbol_named(&format!("x{position}")));
    let nets = symbols
        .map(|symbol| circuit.push(Operation::Symbol(symbol)))
        .collect();
    (circuit, nets)
}

fn product(circuit: &mut Circuit, factors: &[Net]) -> Net {
    circuit.product(factors.iter().map(|factor| (*factor, 1)))
}

fn sum(circuit: &mut Circuit, terms: &[(Net, i64)]) -> Net {
    circuit.sum(
        terms
            .iter()
            .map(|(term, coefficient)| (*term, whole(*coefficient))),
    )
}

/// The counts of additions and multiplications after a step.
fn counts_after(mut circuit: Circuit, outputs: Vec<Net>, step: Step) -> (usize, usize) {
    circuit.outputs = outputs;
    extract(&mut circuit, &[step]);
    (circuit.cost().add, circuit.cost().mul)
}

#[test]
fn a_common_factor_is_taken_out() {
    let (mut circuit, x) = circuit(3);
    let terms = [
        product(&mut circuit, &[x[0], x[1]]),
        product(&mut circuit, &[x[0], x[2]]),
    ];
    let root = sum(&mut circuit, &[(terms[0], 1), (terms[1], 1)]);
    assert_eq!(counts_after(circuit, vec![root], Step::Factors), (1, 1));
}

#[test]
fn a_polynomial_takes_the_form_of_horner() {
    let (mut circuit, x) = circuit(1);
    let powers: Vec<Net> = (1..=4)
        .map(|power| product(&mut circuit, &vec![x[0]; power]))
        .collect();
    let root = sum(
        &mut circuit,
        &[
            (powers[0], 2),
            (powers[1], 3),
            (powers[2], 5),
            (powers[3], 7),
        ],
    );
    assert_eq!(counts_after(circuit, vec![root], Step::Factors), (3, 4));
}

#[test]
fn a_shared_product_is_computed_once() {
    let (mut circuit, x) = circuit(4);
    let roots = vec![
        product(&mut circuit, &[x[0], x[1], x[2]]),
        product(&mut circuit, &[x[0], x[1], x[3]]),
    ];
    assert_eq!(counts_after(circuit, roots, Step::Products), (0, 3));
}

#[test]
fn a_power_is_made_by_squaring() {
    let (mut circuit, x) = circuit(1);
    let root = product(&mut circuit, &[x[0]; 8]);
    assert_eq!(counts_after(circuit, vec![root], Step::Products), (0, 3));
}

#[test]
fn a_shared_sum_is_computed_once_up_to_a_factor() {
    let (mut circuit, x) = circuit(4);
    let roots = vec![
        sum(&mut circuit, &[(x[0], 1), (x[1], -1), (x[2], 1)]),
        sum(&mut circuit, &[(x[0], -1), (x[1], 1), (x[3], 1)]),
    ];
    assert_eq!(counts_after(circuit, roots, Step::Sums), (3, 0));
}

#[test]
fn a_shared_sum_adds_to_what_there_was_of_it() {
    // (x0 + x1), and x0 + x1 + 2(x0 + x1) with the sum as a term: three times the sum.
    let (mut circuit, x) = circuit(2);
    let inner = sum(&mut circuit, &[(x[0], 1), (x[1], 1)]);
    let outer = sum(&mut circuit, &[(x[0], 1), (x[1], 1), (inner, 2)]);
    circuit.outputs = vec![inner, outer];
    extract(&mut circuit, &[Step::Sums]);
    assert_eq!(
        *circuit.operation(circuit.outputs[1]),
        Operation::Sum([(circuit.outputs[0], whole(3))].into_iter().collect())
    );
}

#[test]
fn equal_multiples_are_gathered() {
    let (mut circuit, x) = circuit(3);
    let root = sum(&mut circuit, &[(x[0], 3), (x[1], -3), (x[2], 1)]);
    assert_eq!(counts_after(circuit, vec![root], Step::Multiples), (2, 1));
}

#[test]
fn a_coefficient_is_shared_like_a_factor() {
    // 2·x0·x1, −2·x0·x1 and 2·x0·x2: 2·x0 once, a sign for nothing.
    let (mut circuit, x) = circuit(3);
    let products = [
        product(&mut circuit, &[x[0], x[1]]),
        product(&mut circuit, &[x[0], x[2]]),
    ];
    circuit.outputs = vec![
        sum(&mut circuit, &[(products[0], 2)]),
        sum(&mut circuit, &[(products[0], -2)]),
        sum(&mut circuit, &[(products[1], 2)]),
    ];
    extract(&mut circuit, &[Step::Coefficients, Step::Products]);
    assert_eq!((circuit.cost().add, circuit.cost().mul), (0, 3));
}

#[test]
fn a_coefficient_of_a_quotient_is_one_of_its_numerator() {
    // 3·x0 and 3·(x0/x1): 3·x0 once.
    let (mut circuit, x) = circuit(2);
    let quotient = circuit.push(Operation::Quotient(x[0], x[1]));
    let multiples = [
        sum(&mut circuit, &[(x[0], 3)]),
        sum(&mut circuit, &[(quotient, 3)]),
    ];
    circuit.outputs = multiples.to_vec();
    extract(&mut circuit, &[]);
    assert_eq!((circuit.cost().mul, circuit.cost().div), (1, 1));
}

#[test]
fn products_are_multiples_of_others_where_that_spares_a_factor() {
    // With 2·x0·x1 and 2·x0·x2, 4·x0·x1 and 4·x0·x2 are twice these, and 4·x0 is not needed.
    let (mut circuit, x) = circuit(3);
    let [twice, four_times] = [2, 4].map(|factor| sum(&mut circuit, &[(x[0], factor)]));
    let of = |circuit: &mut Circuit, multiple| {
        [x[1], x[2]].map(|other| product(circuit, &[multiple, other]))
    };
    let (twice, mut four_times) = (
        of(&mut circuit, twice),
        of(&mut circuit, four_times).to_vec(),
    );
    circuit.outputs = [&twice[..], &four_times].concat();
    let mut spared = circuit.clone();
    extract(&mut spared, &[]);
    assert_eq!(spared.cost().mul, 5);
    // A multiple of a sum is no multiple of a third of itself: 3·s, x2·(3·s), x2·s.
    let (mut of_sum, y) = self::circuit(3);
    let s = sum(&mut of_sum, &[(y[0], 1), (y[1], 1)]);
    let thrice = sum(&mut of_sum, &[(s, 3)]);
    of_sum.outputs = vec![
        product(&mut of_sum, &[y[2], thrice]),
        product(&mut of_sum, &[y[2], s]),
    ];
    let before = of_sum.cost().operations();
    extract(&mut of_sum, &[]);
    assert!(of_sum.cost().operations() <= before);
    let third = of_sum.nets().any(|net| {
        matches!(of_sum.operation(net), Operation::Sum(terms) if terms.iter().any(|(_, q)| !q.is_integer()))
    });
    assert!(!third, "{of_sum:?}");
    // Where 4·x0 is needed all the same, nothing is spared.
    let needed = sum(&mut circuit, &[(x[0], 4)]);
    four_times.push(needed);
    circuit.outputs = [&twice[..], &four_times].concat();
    extract(&mut circuit, &[]);
    assert_eq!(circuit.cost().mul, 6);
}

#[test]
fn a_product_that_is_needed_alone_is_one_factor_of_its_multiple() {
    let (mut circuit, x) = circuit(2);
    let both = product(&mut circuit, &[x[0], x[1]]);
    let multiple = sum(&mut circuit, &[(both, 2)]);
    assert_eq!(
        counts_after(circuit, vec![both, multiple], Step::Coefficients),
        (0, 2)
    );
}

#[test]
fn a_power_of_two_is_given_to_the_terms_of_a_sum() {
    // 2(x0 + x1) and 2·x0·x2: with 2·x0 once.
    let (mut circuit, x) = circuit(3);
    let inner = sum(&mut circuit, &[(x[0], 1), (x[1], 1)]);
    let both = product(&mut circuit, &[x[0], x[2]]);
    circuit.outputs = vec![
        sum(&mut circuit, &[(inner, 2)]),
        sum(&mut circuit, &[(both, 2)]),
    ];
    let mut thirds = circuit.clone();
    coefficients::distribute(&mut circuit);
    let Operation::Sum(terms) = circuit.operation(circuit.outputs[0]) else {
        panic!("no sum")
    };
    assert!(
        terms.len() == 2
            && terms
                .iter()
                .all(|(_, coefficient)| *coefficient == whole(2))
    );
    // Three times a sum rounds otherwise than the sum of its terms' triples.
    let inner = sum(&mut thirds, &[(x[0], 1), (x[1], 1)]);
    thirds.outputs = vec![sum(&mut thirds, &[(inner, 3)])];
    coefficients::distribute(&mut thirds);
    assert_eq!(thirds.cost().mul, 1);
}

#[test]
fn partials_by_the_forward_mode_share_what_the_values_are_made_of() {
    // A point turned, moved and turned again: the derivatives of what is turned first are what is turned, without the move.
    let module = support::module(
        "mod m { fn f(a: f64, b: f64, x: f64, y: f64, z: [f64; 2]) -> [f64; 2] {
            let u = a.cos() * x + a.sin() * y - z[0];
            let v = a.cos() * y - a.sin() * x - z[1];
            [b.cos() * u + b.sin() * v, b.cos() * v - b.sin() * u]
        } }",
    );
    let cost = support::circuit(&support::formula(&module, "f"), Form::Gradient, &[]).cost();
    // The reverse mode writes them over products of the cosines and sines, which nothing else needs.
    assert_eq!((cost.add, cost.mul, cost.call), (10, 16, 4));
}

/// The operations of a formula's value.
fn cost(formula: &str) -> Cost {
    let source = format!("mod m {{ fn f(x: f64, y: f64, a: f64, b: f64) -> {formula} }}");
    let module = support::module(&source);
    support::circuit(&support::formula(&module, "f"), Form::Value, &[]).cost()
}

#[test]
fn divisions_are_shared() {
    let one = |cost: Cost| (cost.div, cost.mul);
    assert_eq!(one(cost("f64 { x / a }")), (1, 0));
    assert_eq!(one(cost("f64 { x / a / b }")), (1, 1));
    assert_eq!(one(cost("(f64, f64) { (x / a, y / a) }")), (1, 2));
    // Two denominators of two factors: each factor once.
    assert_eq!(
        cost("(f64, f64, f64) { (x / a, y / b, x / (a * b)) }").div,
        2
    );
    // Three factors, but one denominator.
    assert_eq!(
        cost("(f64, f64) { (x / (a * b * (a + b)), y / (a * b * (a + b))) }").div,
        1
    );
}

#[test]
fn the_inverse_of_a_size_is_the_size_of_the_inverse() {
    assert_eq!(
        cost("(f64, f64, f64) { (x / a, y / a, x / a.abs()) }").div,
        1
    );
}

#[test]
fn a_quotient_is_made_from_another_one() {
    let one = |cost: Cost| (cost.div, cost.mul);
    assert_eq!(one(cost("(f64, f64) { (x / a, x / (a * b)) }")), (2, 0));
    let chain = "(f64, f64) { let q = x.sqrt() / a.sin(); (q, q / b.sin()) }";
    assert_eq!(one(cost(chain)), (2, 0));
}

#[test]
fn an_inverse_that_is_multiplied_by_once_is_a_division() {
    // Of the shared divisors a and b only a is needed twice.
    let cost = cost("(f64, f64) { (x / (a * b), y / a) }");
    assert_eq!((cost.div, cost.mul), (2, 1));
}

#[test]
fn roots_that_differ_by_a_square_are_one_root() {
    let pairs = [
        ("(x * y).sqrt()", "(x.powi(3) * y).sqrt()"),
        ("(x * y).sqrt()", "(x / y).sqrt()"),
        ("(8.0 * x).sqrt()", "(2.0 * x).sqrt()"),
        ("(a / b).sqrt()", "(b / a).sqrt()"),
    ];
    for (first, second) in pairs {
        let cost = cost(&format!("(f64, f64) {{ ({first}, {second}) }}"));
        assert_eq!(cost.sqrt, 1, "{first}, {second}");
    }
}

#[test]
fn roots_of_one_product_are_one_root() {
    let both = |formula: &str| {
        let cost = cost(formula);
        (cost.sqrt, cost.div)
    };
    assert_eq!(both("f64 { a.sqrt() / b.sqrt() }"), (1, 1));
    assert_eq!(both("f64 { (a / b).sqrt() * (b / x).sqrt() }"), (1, 1));
    assert_eq!(both("f64 { (a / b).sqrt() * (x / y).sqrt() }"), (1, 1));
    // √(ab)/(bx) has products that √(a/b)/x has not: with numbers of everyday they stay in the range.
    assert_eq!(both("f64 { a.sqrt() / (b.sqrt() * x) }"), (1, 1));
    // One of them is needed alone.
    assert_eq!(both("(f64, f64) { (a.sqrt(), a.sqrt() * b.sqrt()) }").0, 2);
}

#[test]
fn quotients_and_multiples_are_computed_once() {
    let counts = |formula: &str| {
        let cost = cost(formula);
        (cost.add, cost.mul, cost.div)
    };
    assert_eq!(counts("f64 { (x / y).powi(30) }"), (0, 7, 1));
    assert_eq!(
        counts("f64 { (x / a).powi(2) + (y / b).powi(2) }"),
        (1, 2, 2)
    );
    // Heron's formula under its root.
    let heron = "f64 { let s = (a + b + x) / 2.0; s * (s - a) * (s - b) * (s - x) }";
    assert_eq!(counts(heron), (5, 4, 0));
}

#[test]
fn common_factors_cancel() {
    let cost = cost("f64 { (x * y - 2.0 * x.powi(2) * a) / x }");
    assert_eq!((cost.add, cost.mul, cost.div), (1, 2, 0));
}

#[test]
fn a_division_by_zero_is_left_to_the_code() {
    let module = support::module("mod m { fn f(x: f64) -> f64 { x / (2.0 - 2.0) } }");
    let circuit = support::circuit(&support::formula(&module, "f"), Form::Value, &[]);
    let Operation::Quotient(_, divisor) = circuit.operation(circuit.outputs[0]) else {
        panic!("no division")
    };
    assert_eq!(circuit.as_number(*divisor), Some(&whole(0)));
}

#[test]
fn sums_and_products_have_one_form() {
    let mut graph = Graph::new();
    let [x, y, z] = ["x", "y", "z"].map(|name| {
        let symbol = graph.symbol_named(name);
        graph.symbol_expression(symbol)
    });
    let (one, zero) = (graph.one(), graph.integer(0));
    let (a, b) = (graph.subtract(x, y), graph.subtract(y, x));
    // Squares of (x − y) and (y − x) are one node, products of them differ in the sign in front.
    assert_eq!(graph.power(a, 2), graph.power(b, 2));
    let (left, right) = (graph.multiply(a, z), graph.multiply(b, z));
    assert_eq!(graph.negate(right), left);
    // A sum is opened where that leaves no more terms.
    let sum = graph.add(x, y);
    assert_eq!(graph.subtract(sum, y), x);
    let closed = graph.add(sum, z);
    assert!(matches!(graph.node(closed), Node::Sum(terms) if terms.len() == 2));
    // Rational factors stand in front of a product.
    let doubled = graph.scale(x, whole(2));
    let product = graph.multiply(doubled, y);
    assert!(
        matches!(graph.node(product), Node::Sum(terms) if terms.len() == 1 && terms[0].1 == whole(2))
    );
    assert_eq!(graph.divide(x, x), one);
    assert_eq!(graph.subtract(x, x), zero);
    assert_eq!(graph.multiply(x, zero), zero);
    // 1/0 is no number.
    let infinite = graph.power(zero, -1);
    assert!(matches!(graph.node(infinite), Node::Product(_)));
}

/// The derivative of a formula of x and y by x, as the graph of a second formula.
fn assert_derivative(formula: &str, expected: &str) {
    let module = support::module(&format!(
        "mod m {{ fn f(x: f64, y: f64) -> f64 {{ {formula} }} fn g(x: f64, y: f64) -> f64 {{ {expected} }} }}"
    ));
    let mut tables = codegen::tables::Tables::default();
    let mut reader = codegen::parse::body::Reader::new(&module, &mut tables);
    let numbers: Vec<_> = ["f", "g"]
        .map(|name| {
            reader
                .read(module.function(name).unwrap())
                .unwrap()
                .numbers()[0]
                .1
        })
        .into();
    let gathered = gather(&reader.graph, &numbers);
    let mut graph = gathered.graph;
    let x = graph.find_symbol("x").unwrap();
    let slope = differentiate::gradient(&mut graph, gathered.roots[0], &[x])[0];
    assert_eq!(
        graph.node(slope),
        graph.node(gathered.roots[1]),
        "{formula}"
    );
}

#[test]
fn derivatives_are_written_over_the_function_itself() {
    assert_derivative("y", "0.0");
    assert_derivative("3.0 * x + y", "3.0");
    assert_derivative("x.powi(-3) * y", "-3.0 * x.powi(-4) * y");
    assert_derivative("x.sqrt()", "0.5 / x.sqrt()");
    assert_derivative("(2.0 * x).sin()", "2.0 * (2.0 * x).cos()");
    assert_derivative("(x * y).cos()", "-(y * (x * y).sin())");
    assert_derivative("x.tan()", "1.0 + x.tan().powi(2)");
    assert_derivative("(x * y).exp()", "y * (x * y).exp()");
    assert_derivative("(y * x).ln()", "y / (y * x)");
}

#[test]
fn derivatives_at_corners_choose_a_side() {
    let mut graph = Graph::new();
    let [x, y] = ["x", "y"].map(|name| graph.symbol_named(name));
    let (a, b) = (graph.symbol_expression(x), graph.symbol_expression(y));
    let (one, zero) = (graph.one(), graph.integer(0));
    // A little to the right of x = y in x, the larger is the first and the smaller the second.
    for (function, taken, others) in [
        (Function::Max, a, [[one, zero], [zero, one]]),
        (Function::Min, b, [[zero, one], [one, zero]]),
    ] {
        let root = graph.apply(function, vec![a, b]);
        let slopes = differentiate::gradient(&mut graph, root, &[x, y]);
        let expected = others.map(|[at_taken, other]| {
            graph.apply(Function::Select, vec![root, taken, at_taken, other])
        });
        assert_eq!(slopes, expected);
    }
    let root = graph.apply(Function::Abs, vec![a]);
    assert_eq!(
        differentiate::gradient(&mut graph, root, &[x]),
        vec![graph.apply(Function::Side, vec![a])]
    );
}

#[test]
fn literals_are_exact() {
    let expected: [(&str, Option<Rational>); 8] = [
        ("0.1", Some(ratio(1, 10))),
        ("12.50", Some(ratio(25, 2))),
        ("1E3", Some(whole(1000))),
        ("2.5e-3", Some(ratio(1, 400))),
        ("7.", Some(whole(7))),
        ("1e2001", None),
        ("1e99999999999999999999", None),
        ("1.0e-2000", None),
    ];
    for (digits, value) in expected {
        assert_eq!(decimal(digits), value, "{digits}");
    }
}

#[test]
fn constants_have_the_values_of_the_standard_library() {
    use std::f64::consts::{
        E, FRAC_2_SQRT_PI, FRAC_PI_8, GOLDEN_RATIO, LN_10, LOG2_E, LOG10_E, SQRT_2, TAU,
    };
    let known = [
        ("E", E),
        ("FRAC_2_SQRT_PI", FRAC_2_SQRT_PI),
        ("FRAC_PI_8", FRAC_PI_8),
        ("GOLDEN_RATIO", GOLDEN_RATIO),
        ("LN_10", LN_10),
        ("LOG2_E", LOG2_E),
        ("LOG10_E", LOG10_E),
        ("SQRT_2", SQRT_2),
        ("TAU", TAU),
    ];
    for (name, value) in known {
        let mut graph = Graph::new();
        let id = constant(&mut graph, name).unwrap();
        let found = codegen::interpret::evaluate::<f64>(&graph, &[id], &[]).unwrap()[0];
        assert!(
            (found - value).abs() <= f64::EPSILON * value,
            "{name}: {found} beside {value}"
        );
    }
}
