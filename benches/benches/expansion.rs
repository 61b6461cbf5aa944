//! Cost of building: how long the generator takes for a formula of so many graph nodes.
//!
//! `cargo bench -p rotor-benches --bench expansion`; with the name of a shape, such as `-- sines`, for that alone.
#![allow(
    missing_docs,
    clippy::print_stdout,
    reason = "criterion's macros define functions without documentation; a bench prints what it measures"
)]

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

use codegen::emit::scalar::Form;
use codegen::expand::derive;
use codegen::graph::SymbolId;
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

/// A formula that is one long sum, product or chain: what it starts with, a step, and how many steps it has. `{c}` and `{d}`
/// are other numbers in each step, `t` what is there already.
type Shape = (&'static str, &'static str, &'static str, &'static [usize]);

/// Lengths of sums, of products, and of chains, in which every step is needed by the next.
const SUMS: &[usize] = &[1_000, 4_000, 20_000];
const PRODUCTS: &[usize] = &[1_000, 3_000];
const CHAINS: &[usize] = &[100, 300, 1_000];

const SHAPES: [Shape; 11] = [
    ("sum of sines", "y", "t + ({c} * x + {d} * y).sin()", SUMS),
    ("sum of inverses", "y", "t + 1.0 / (x + {c})", SUMS),
    ("sum of squares", "y", "t + (x + {c}).powi(2)", SUMS),
    ("sum of choices", "y", "t + x.min({c})", SUMS),
    ("product of sums", "y", "t * (x + {c})", PRODUCTS),
    ("quotients", "x * y", "t / (x + {c})", CHAINS),
    ("continued fraction", "y", "{c} + x / t", CHAINS),
    ("ladder", "y", "{c} + x * t / (x + t)", CHAINS),
    ("quotients of sums", "y", "(t + {c}) / (x + t)", CHAINS),
    ("nested roots", "y", "(t + x).sqrt()", CHAINS),
    ("nested choices", "y", "t.min({c} * x)", CHAINS),
];

/// A module with the gradient of one such formula.
fn steps(first: &str, step: &str, count: usize) -> TokenStream {
    let mut source = format!(
        "mod synthetic {{ #[generate(gradient(x, y))] pub fn formula(x: f64, y: f64) -> f64 {{ let t = {first};"
    );
    for place in 0..count {
        let c = format!("{}.{}", place + 2, place * 37 % 97 + 1);
        let d = format!("{}.{}", place % 13, place * 53 % 89 + 1);
        let step = step.replace("{c}", &c).replace("{d}", &d);
        let _ = write!(source, "let t = {step};");
    }
    source += "t } }";
    source.parse().unwrap_or_default()
}

/// How many nodes the graph of a formula and its gradient has.
fn nodes(item: &TokenStream) -> Option<usize> {
    let mut expansion = show::module(&format!("#[symbolic] {item}")).ok()?;
    expansion.read_all();
    let formula = expansion.formula("formula")?;
    let by = ["x", "y"].map(|name| formula.graph.find_symbol(name));
    let by: Vec<SymbolId> = by.into_iter().flatten().collect();
    let (graph, outputs) = derive(formula, Form::Gradient, &by);
    Some(graph.reachable(&outputs.all()).len())
}

/// Processor time of this process in milliseconds, where the system tells it: Linux counts it in hundredths of a second.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let after_name = text.rsplit(')').next()?;
    let fields: Vec<&str> = after_name.split_whitespace().collect();
    let ticks = |place: usize| fields.get(place)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) * 10.0)
}

/// Formulas that are one long sum, product or chain, where a search that compares all with all shows: the time that each
/// takes per 1000 nodes. One run of each, as the longest take seconds; the name of a shape as argument runs that alone.
fn shapes(_: &mut Criterion) {
    let wanted = std::env::args().skip(1).find(|arg| !arg.starts_with('-'));
    println!("milliseconds per 1000 nodes of a formula and its gradient");
    println!(
        "{:20} {:>6} {:>7} {:>8} {:>8}",
        "shape", "steps", "nodes", "CPU", "wall"
    );
    for (name, first, step, counts) in SHAPES {
        if wanted.as_ref().is_some_and(|wanted| !name.contains(wanted)) {
            continue;
        }
        for count in counts {
            let item = steps(first, step, *count);
            let thousands = nodes(&item).unwrap_or(0) as f64 / 1e3;
            let (before, start) = (processor_time(), Instant::now());
            black_box(codegen::expand(TokenStream::new(), item));
            let wall = start.elapsed().as_secs_f64() * 1e3;
            let spent = processor_time()
                .zip(before)
                .map(|(after, before)| after - before);
            println!(
                "{name:20} {count:>6} {:>7} {:>8.1} {:>8.1}",
                thousands * 1e3,
                spent.unwrap_or(f64::NAN) / thousands,
                wall / thousands
            );
        }
    }
}

/// All forms of the model, which is what its build waits for.
fn model(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("expansion of the model");
    group.bench_function("equations", |bencher| {
        bencher.iter_batched(
            || show::system(&equations::SOURCES),
            |system| {
                let modules = system.into_iter().flat_map(|system| system.modules);
                modules.for_each(|mut expansion| {
                    expansion.read_all();
                    expansion.generate_all();
                    black_box(expansion.into_tokens());
                });
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
