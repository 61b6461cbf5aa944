//! Cost of building: how long the generator takes for a formula of so many graph nodes.
//!
//! `cargo bench -p rotor-benches --bench expansion`
#![allow(
    missing_docs,
    reason = "criterion's macros define functions without documentation"
)]

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Duration;

use codegen::show;
use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use proc_macro2::TokenStream;
use rotor_core::equations;

/// Nodes of the graphs.
const NODES: [usize; 6] = [250, 1_000, 2_500, 5_000, 10_000, 20_000];

/// How many of the last intermediate results a line takes its operands from.
const REACH: usize = 24;

/// A module with one formula of eight numbers and about so many graph nodes: products, sums, quotients, roots and sines of
/// earlier lines, drawn by a congruential generator, as an engineer's long formula mixes them.
fn formula(nodes: usize) -> TokenStream {
    let mut source =
        String::from("mod synthetic { #[generate(value)] pub fn formula(x: [f64; 8]) -> f64 {");
    for place in 0..8 {
        let _ = write!(source, "let t{place} = x[{place}];");
    }
    let mut state: u64 = 12_345;
    let (mut line, mut made) = (8, 8);
    while made < nodes {
        let mut earlier = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            line - 1 - (state >> 33) as usize % REACH.min(line)
        };
        let (a, b, c) = (earlier(), earlier(), earlier());
        let (text, nodes_of_line) = match line % 6 {
            0 => (format!("(t{a} * t{b} + {}.5 * t{c}).sin()", line % 7), 3),
            1 => (
                format!("(t{a} * t{a} + t{b} * t{c} * t{b} + 1.0).sqrt()"),
                4,
            ),
            2 => (format!("t{a} / (2.0 + t{b} * t{b})"), 3),
            _ => (format!("t{a} * t{b} - t{c}"), 2),
        };
        let _ = write!(source, "let t{line} = {text};");
        line += 1;
        made += nodes_of_line;
    }
    let last: Vec<String> = (line - REACH.min(line)..line)
        .map(|t| format!("t{t}"))
        .collect();
    let _ = write!(source, "{} }} }}", last.join(" + "));
    source.parse().unwrap_or_default()
}

fn synthetic(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("expansion");
    for nodes in NODES {
        let item = formula(nodes);
        let expanded = codegen::expand(TokenStream::new(), item.clone()).to_string();
        assert!(!expanded.contains("compile_error"), "{expanded}");
        group.throughput(Throughput::Elements(nodes as u64));
        group.bench_function(BenchmarkId::from_parameter(nodes), |bencher| {
            bencher.iter_batched(
                || item.clone(),
                |item| black_box(codegen::expand(TokenStream::new(), item)),
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

/// Steps of the formulas of one shape.
const STEPS: [usize; 2] = [1_000, 4_000];

/// Shapes: what the formula starts with, and a step. `{c}` is another number in each step, `t` what is there already.
const SHAPES: [(&str, &str, &str); 8] = [
    ("sum of sines", "y", "t + ({c} * x + y).sin()"),
    ("sum of inverses", "y", "t + 1.0 / (x + {c})"),
    ("sum of squares", "y", "t + (x + {c}).powi(2)"),
    ("sum of choices", "y", "t + x.min({c})"),
    ("product of sums", "y", "t * (x + {c})"),
    ("nested roots", "y", "(t + x).sqrt()"),
    ("nested choices", "y", "t.min({c} * x)"),
    ("continued fraction", "y", "{c} + x / t"),
];

/// A module with the gradient of one such formula.
fn steps(first: &str, step: &str, count: usize) -> TokenStream {
    let mut source = format!(
        "mod synthetic {{ #[generate(gradient(x, y))] pub fn formula(x: f64, y: f64) -> f64 {{ let t = {first};"
    );
    for place in 0..count {
        let number = format!("{}.{}", place + 2, place * 37 % 97 + 1);
        let _ = write!(source, "let t = {};", step.replace("{c}", &number));
    }
    source += "t } }";
    source.parse().unwrap_or_default()
}

/// Formulas that are one long sum, product or chain, where a search that compares all with all shows.
fn shapes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("expansion of a shape");
    for (name, first, step) in SHAPES {
        for count in STEPS {
            let item = steps(first, step, count);
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::new(name, count), |bencher| {
                bencher.iter_batched(
                    || item.clone(),
                    |item| black_box(codegen::expand(TokenStream::new(), item)),
                    BatchSize::PerIteration,
                );
            });
        }
    }
    group.finish();
}

/// All forms of the model, which is what its build waits for.
fn model(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("expansion of the model");
    group.bench_function("equations", |bencher| {
        bencher.iter_batched(
            || show::module(equations::SOURCE),
            |expansion| {
                expansion.map(|mut expansion| {
                    expansion.read_all();
                    expansion.generate_all();
                    black_box(expansion.into_tokens())
                })
            },
            BatchSize::PerIteration,
        );
    });
    group.finish();
}

criterion_group! {
    name = expansion;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(1));
    targets = synthetic, shapes, model
}
criterion_main!(expansion);
