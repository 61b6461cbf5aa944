//! Random formulas: as written, as interpreted and as generated they are the same numbers; their derivatives are those
//! of the function as written; no source brings the generator down.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use std::cell::Cell;

use codegen::circuit::{Circuit, Operation};
use codegen::emit::scalar::Form;
use codegen::expand::{Expansion, Generated, derive, derive_held};
use codegen::graph::{Graph, SymbolId};
use codegen::interpret::{evaluate, evaluate_circuit};
use codegen::parse::attributes::{StageRequest, Target};
use codegen::stage::Staged;
use proc_macro2::{Span, TokenStream, TokenTree};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use support::bounded::Bounded;
use support::evaluator::{Source, Value};
use support::formulas::{INPUTS, random_module};
use support::{expansion, generated, parsed};

/// A runner of as many cases, the same at every run; `FORMULA_SEED` in the environment gives others.
fn runner(cases: u32) -> TestRunner {
    let seed = std::env::var("FORMULA_SEED")
        .ok()
        .and_then(|seed| seed.parse().ok())
        .unwrap_or(20);
    TestRunner::new(Config {
        cases,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        ..Config::default()
    })
}

/// The arguments of the formula for its inputs in order.
fn arguments(at: &[f64]) -> Vec<Value> {
    let s = Value::fields(&[("p", at[4]), ("q", at[5])]);
    vec![
        Value::number(at[0]),
        Value::number(at[1]),
        Value::numbers(&at[2..4]),
        s,
    ]
}

fn points() -> impl Strategy<Value = Vec<Vec<f64>>> {
    prop::collection::vec(
        prop::collection::vec(
            (0.2_f64..2.5, any::<bool>()).prop_map(|(x, minus)| if minus { -x } else { x }),
            6,
        ),
        6,
    )
}

/// The emitted code of a form.
fn emitted(form: &Generated) -> Source {
    let file: syn::File = syn::parse2(form.tokens.clone()).unwrap();
    Source::of(&file.items)
}

/// What the interpreter makes of a form's outputs, in the order in which the generated code gives them.
fn interpreted(expansion: &Expansion, form: &Generated, at: &[f64]) -> Vec<Bounded> {
    let (graph, outputs) = derive(expansion.formula("formula").unwrap(), form.form, &form.by);
    let input = |name: &str| {
        INPUTS
            .iter()
            .position(|known| *known == name)
            .map_or(f64::NAN, |position| at[position])
    };
    let symbols: Vec<Bounded> = graph
        .symbols()
        .map(|(_, symbol)| Bounded::exact(input(&symbol.name)))
        .collect();
    let mut numbers = outputs.values.clone();
    numbers.extend(outputs.gradients.iter().flatten());
    let size = form.by.len();
    for triangle in &outputs.hessians {
        let start = |row: usize| row * size - row * row.saturating_sub(1) / 2;
        let entry =
            |row: usize, column: usize| triangle[start(row.min(column)) + row.abs_diff(column)];
        numbers.extend(
            (0..size)
                .flat_map(|row| (0..size).map(move |column| (row, column)))
                .map(|(r, c)| entry(r, c)),
        );
    }
    evaluate(&graph, &numbers, &symbols).unwrap()
}

#[test]
fn as_written_as_interpreted_and_as_generated_are_equal() {
    let (compared, derivatives) = (Cell::new(0), Cell::new(0));
    let outcome = runner(160).run(&(random_module(), points()), |(module, points)| {
        let source = module.source();
        let mut expansion = expansion(&source);
        let written = Source::of(&parsed(&source).content.unwrap().1);
        for form in [Form::Value, Form::Gradient, Form::Hessian] {
            let form = generated(&mut expansion, "formula", form);
            let code = emitted(&form);
            for at in &points {
                let written = written.call("formula", &arguments(at)).flatten();
                if !written.iter().all(|number| number.is_known()) {
                    continue;
                }
                let interpreted = interpreted(&expansion, &form, at);
                let generated = code.call(form.form.name(), &arguments(at)).flatten();
                prop_assert_eq!(generated.len(), interpreted.len());
                for (written, generated) in written.iter().zip(&generated) {
                    prop_assert!(generated.value.is_finite(), "{written:?} became {generated:?} at {at:?}");
                    prop_assert!(written.agrees(*generated), "{written:?} became {generated:?} at {at:?}");
                    compared.set(compared.get() + usize::from(generated.is_known()));
                }
                for (position, (interpreted, generated)) in interpreted.iter().zip(&generated).enumerate() {
                    if interpreted.is_known() && generated.is_known() {
                        prop_assert!(interpreted.agrees(*generated), "output {position} of {}: {interpreted:?} became {generated:?} at {at:?}", form.form.name());
                        derivatives.set(derivatives.get() + usize::from(position >= written.len()));
                    }
                }
            }
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    // Most formulas have a value at one point at least; a test that compares nothing would pass.
    assert!(
        compared.get() > 700 && derivatives.get() > 3000,
        "{compared:?} values, {derivatives:?} derivatives compared"
    );
}

#[test]
fn gradients_over_held_products_are_those_of_the_reverse_mode() {
    let (compared, held_products) = (Cell::new(0), Cell::new(0));
    let outcome = runner(120).run(&(random_module(), points()), |(module, points)| {
        let mut expansion = expansion(&module.source());
        let by = generated(&mut expansion, "formula", Form::Gradient).by;
        let formula = expansion.formula("formula").unwrap();
        let Some(held) = derive_held(formula, &by) else {
            return Ok(());
        };
        let (graph, outputs) = derive(formula, Form::Gradient, &by);
        held_products.set(held_products.get() + held.definitions.len());
        for at in &points {
            let input = |name: &str| {
                let position = INPUTS.iter().position(|known| *known == name);
                Bounded::exact(position.map_or(f64::NAN, |position| at[position]))
            };
            let inputs = |graph: &Graph| -> Vec<Bounded> {
                graph
                    .symbols()
                    .map(|(_, symbol)| input(&symbol.name))
                    .collect()
            };
            let mut symbols = inputs(&held.graph);
            for (symbol, product) in &held.definitions {
                symbols[symbol.index()] = evaluate(&held.graph, &[*product], &symbols).unwrap()[0];
            }
            let known = evaluate(&graph, &outputs.all(), &inputs(&graph)).unwrap();
            let found = evaluate(&held.graph, &held.outputs.all(), &symbols).unwrap();
            for (known, found) in known.iter().zip(&found) {
                if known.is_known() && found.is_known() {
                    prop_assert!(known.agrees(*found), "{known:?} became {found:?} at {at:?}");
                    compared.set(compared.get() + 1);
                }
            }
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(
        compared.get() > 500 && held_products.get() > 50,
        "{compared:?} numbers compared, {held_products:?} products held"
    );
}

/// What a staged form's three circuits give together.
fn in_stages(staged: &Staged, at: &[f64]) -> Vec<Bounded> {
    let graph = &staged.graph;
    let input = |name: &str| INPUTS.iter().position(|known| *known == name);
    let mut numbers: Vec<Bounded> = graph
        .symbols()
        .map(|(_, symbol)| Bounded::exact(input(&symbol.name).map_or(f64::NAN, |place| at[place])))
        .collect();
    let before = [
        (&staged.fixed, &staged.fixed_symbols),
        (&staged.along, &staged.along_symbols),
    ];
    for (circuit, symbols) in before {
        let values = evaluate_circuit(graph, circuit, &numbers);
        for (symbol, value) in symbols.iter().zip(values) {
            numbers[symbol.index()] = value;
        }
    }
    evaluate_circuit(graph, &staged.points, &numbers)
}

#[test]
fn in_stages_they_are_equal_too() {
    let (compared, at_points) = (Cell::new(0), Cell::new(0));
    let outcome = runner(60).run(&(random_module(), points()), |(module, points)| {
        let source = module.source();
        let mut expansion = expansion(&source);
        let written = Source::of(&parsed(&source).content.unwrap().1);
        let function = expansion.module().function("formula").unwrap().clone();
        for inner in [&INPUTS[..1], &INPUTS[1..3], &INPUTS[5..]] {
            let target = |name: &&str| Target {
                symbol: (*name).to_owned(),
                span: Span::call_site(),
            };
            let request = StageRequest {
                inner: inner.iter().map(target).collect(),
                span: Span::call_site(),
            };
            let (staged, symbols, _) = expansion.staged(&function, &request).unwrap();
            let uses = |circuit: &Circuit, symbol: SymbolId| {
                let mut operations = circuit.nets().map(|net| circuit.operation(net));
                operations.any(|operation| *operation == Operation::Symbol(symbol))
            };
            for (symbol, _) in staged.graph.symbols() {
                let is_inner = symbols.contains(&symbol);
                prop_assert!(!(is_inner && uses(&staged.fixed, symbol)));
                prop_assert!(is_inner || !uses(&staged.along, symbol));
            }
            at_points.set(at_points.get() + staged.points.cost().operations());
            for at in &points {
                let written = written.call("formula", &arguments(at)).flatten();
                if !written.iter().all(|number| number.is_known()) {
                    continue;
                }
                for (written, found) in written.iter().zip(in_stages(&staged, at)) {
                    prop_assert!(
                        written.agrees(found),
                        "{written:?} became {found:?} at {at:?} along {inner:?}"
                    );
                    compared.set(compared.get() + 1);
                }
            }
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(
        compared.get() > 500 && at_points.get() > 300,
        "{compared:?} values compared, {at_points:?} operations at points"
    );
}

/// The derivative at x by central differences, extrapolated to no step (Ridders), and a bound of its error.
fn derivative(x: f64, function: impl Fn(f64) -> Bounded) -> Option<(f64, f64)> {
    const STEPS: usize = 9;
    const RATIO: f64 = 1.6;
    let mut previous: Vec<f64> = Vec::new();
    let mut best: Option<(f64, f64)> = None;
    for step in 0..STEPS {
        let h = 0.02 / RATIO.powi(step as i32);
        let (above, below) = (function(x + h), function(x - h));
        if !above.is_known() || !below.is_known() {
            return None;
        }
        let mut row = vec![(above.value - below.value) / (2.0 * h)];
        // Of the values, and of the places where they are taken; extrapolation makes them larger.
        let rounding = 8.0
            * ((above.error + below.error) / h + f64::EPSILON * (1.0 + x.abs() / h) * row[0].abs());
        for order in 0..previous.len() {
            let factor = RATIO.powi(2 * (order as i32 + 1));
            row.push((factor * row[order] - previous[order]) / (factor - 1.0));
            let change = (row[order + 1] - row[order])
                .abs()
                .max((row[order + 1] - previous[order]).abs());
            if best.is_none_or(|(_, error)| change + rounding < error) {
                best = Some((row[order + 1], change + rounding));
            }
        }
        previous = row;
    }
    best
}

/// Compares derivatives with differences where these are good to some digits. How many were.
fn compare_slopes(
    slopes: &[Bounded],
    by: &[usize],
    at: &[f64],
    function: impl Fn(&[f64]) -> Bounded,
) -> Result<usize, TestCaseError> {
    let mut compared = 0;
    for (slope, input) in slopes.iter().zip(by) {
        let moved = |x: f64| {
            let mut at = at.to_vec();
            at[*input] = x;
            function(&at)
        };
        let Some((difference, error)) = derivative(at[*input], moved) else {
            continue;
        };
        if !slope.is_known() || error > 1e-6 * (1.0 + difference.abs()) {
            continue;
        }
        let apart = (slope.value - difference).abs();
        prop_assert!(
            apart <= 4.0 * error + slope.error,
            "by {}: {slope:?}, differences say {difference} ± {error} at {at:?}",
            INPUTS[*input]
        );
        compared += 1;
    }
    Ok(compared)
}

#[test]
fn derivatives_are_those_of_the_function_as_written() {
    let (firsts, seconds) = (Cell::new(0), Cell::new(0));
    let outcome = runner(120).run(&(random_module(), points()), |(module, points)| {
        let source = module.source();
        let mut expansion = expansion(&source);
        let written = Source::of(&parsed(&source).content.unwrap().1);
        let form = generated(&mut expansion, "formula", Form::Hessian);
        let code = emitted(&form);
        let by: Vec<usize> = form
            .by
            .iter()
            .filter_map(|symbol| {
                INPUTS
                    .iter()
                    .position(|name| *name == form.graph.symbol(*symbol).name)
            })
            .collect();
        let (values, size) = (form.circuit.outputs.len(), by.len());
        let values = values / (1 + size + size * (size + 1) / 2);
        for at in points.iter().take(2) {
            let all = code.call("hessian", &arguments(at)).flatten();
            for value in 0..values {
                let first = values + value * size;
                let function =
                    |at: &[f64]| written.call("formula", &arguments(at)).flatten()[value];
                let slopes = &all[first..first + size];
                firsts.set(firsts.get() + compare_slopes(slopes, &by, at, function)?);
                for row in 0..size {
                    let start = values + values * size + (value * size + row) * size;
                    let function =
                        |at: &[f64]| code.call("hessian", &arguments(at)).flatten()[first + row];
                    let slopes = &all[start..start + size];
                    seconds.set(
                        seconds.get() + compare_slopes(&slopes[row..], &by[row..], at, function)?,
                    );
                    for column in 0..row {
                        let mirrored = all[start + column - (row - column) * size + (row - column)];
                        prop_assert_eq!(slopes[column].value.to_bits(), mirrored.value.to_bits());
                    }
                }
            }
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(
        firsts.get() > 300 && seconds.get() > 600,
        "{firsts:?} first, {seconds:?} second derivatives compared"
    );
}

#[test]
fn the_same_module_always_gives_the_same_code() {
    // Each hash map of the standard library has a seed of its own.
    let outcome = runner(40).run(&random_module(), |module| {
        let source = module.source();
        let text = || codegen::expand(TokenStream::new(), source.parse().unwrap()).to_string();
        prop_assert_eq!(text(), text());
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

/// Sources from whose tokens others are made.
const SOURCES: [&str; 3] = [
    "mod m { const K: f64 = 2.0; pub struct S { pub a: f64 }
     #[generate(value, gradient(x, s.a), hessian(x), columns, budget(operations = 9, div = 1))]
     #[domain(x >= 0.0, s.a != 0.0)] #[specialise(special, x = y, generate(value))]
     pub fn f(x: f64, y: f64, s: &S) -> f64 { let (q, r) = (x / s.a, y.powi(-2)); q.max(r) * g([x, y]) - K } 
     fn g(a: [f64; 2]) -> f64 { a[0].abs().sqrt() + g::d_a_0(a) + f::d_x(1.0, 2.0, S { a: a[1] }) } }",
    "mod m { #[generate(value, gradient, columns)] pub fn t(x: f64, c: &C) -> (f64, [f64; 2]) { let C = 1.0; { return (x.sin().mul_add(PI, 0.0), [E, 1f64 / 0.0]); } } }",
    "mod m { #[approximate(x = 0.0..=1.0, factor = x, tolerance = 1e-3)] #[generate(value, gradient)]
     fn i(x: f64) -> f64 { x * (2.0 + x).exp() } fn j(x: f64) -> f64 { i(x) + i::d_x(x) + integral(|t| t * x, 0.0..1.0) } }",
];

/// Tokens that are put in place of others.
const TOKENS: [&str; 38] = [
    "x",
    "y",
    "s",
    "a",
    "f",
    "g",
    "self",
    "0.0",
    "1.0",
    "3",
    "1e400",
    "-",
    "*",
    "/",
    "..",
    ".",
    ",",
    "{ }",
    "( )",
    "[ ]",
    "&",
    "!",
    "'a",
    "\"t\"",
    "d_x",
    "powi",
    "1000",
    "r#type",
    "_",
    "Self",
    "K",
    "powi(1000)",
    "9e-300",
    "f64",
    "row",
    "return",
    "let",
    "#",
];

#[derive(Clone, Debug)]
enum Change {
    Drop(usize),
    Repeat(usize),
    Swap(usize, usize),
    Replace(usize, usize),
}

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let place = 0..400_usize;
    let change = prop_oneof![
        place.clone().prop_map(Change::Drop),
        place.clone().prop_map(Change::Repeat),
        (place.clone(), place.clone()).prop_map(|(a, b)| Change::Swap(a, b)),
        (place, 0..TOKENS.len()).prop_map(|(a, token)| Change::Replace(a, token)),
    ];
    prop::collection::vec(change, 1..5)
}

/// All tokens of a stream and of its groups, as text; what lies between is kept in the order.
fn flat(tokens: TokenStream, into: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let text = group.to_string();
                let (open, close) = (text.chars().next(), text.chars().last());
                into.extend(open.map(String::from));
                flat(group.stream(), into);
                into.extend(close.map(String::from));
            }
            other => into.push(other.to_string()),
        }
    }
}

#[test]
fn no_source_brings_the_generator_down() {
    let expanded = Cell::new(0);
    let outcome = runner(3000).run(&(0..SOURCES.len(), changes()), |(source, changes)| {
        let mut tokens = Vec::new();
        flat(SOURCES[source].parse().unwrap(), &mut tokens);
        for change in changes {
            let count = tokens.len();
            match change {
                Change::Drop(at) => drop(tokens.remove(at % count)),
                Change::Repeat(at) => tokens.insert(at % count, tokens[at % count].clone()),
                Change::Swap(a, b) => tokens.swap(a % count, b % count),
                Change::Replace(at, token) => tokens[at % count] = TOKENS[token].to_owned(),
            }
        }
        // Text whose brackets do not match is no stream of tokens.
        if let Ok(tokens) = tokens.join(" ").replace("' a", "'a").parse::<TokenStream>() {
            let output = codegen::expand(TokenStream::new(), tokens);
            prop_assert!(syn::parse2::<syn::File>(output.clone()).is_ok(), "{output}");
            expanded.set(expanded.get() + 1);
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(expanded.get() > 1000, "{expanded:?} sources expanded");
}
