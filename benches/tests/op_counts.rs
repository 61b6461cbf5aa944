//! The generator's operation counts beside those of SymPy, SymForce and wrenfold, on every formula of the corpus.
//!
//! `corpus/op_counts.csv` holds the others' counts and versions; `cargo xtask peers --counts` writes it anew.
#![allow(clippy::expect_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::path::Path;

use codegen::cost::Cost;
use rotor_benches::corpus::FIELDS;
use rotor_benches::corpus::geometry::heron;
use rotor_benches::export::{descriptions, python_text};

/// A tool's counts, by formula and form.
type Counts = BTreeMap<(String, String), Vec<(String, Cost)>>;

fn peers() -> Counts {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/op_counts.csv");
    let mut reader = csv::Reader::from_path(path).expect("the table of counts is there");
    let mut counts = Counts::new();
    for row in reader.deserialize() {
        let row: BTreeMap<String, String> = row.expect("the table is well formed");
        let count = |name: &str| row[name].parse().expect("a count");
        let cost = Cost {
            add: count("add"),
            mul: count("mul"),
            div: count("div"),
            sqrt: count("sqrt"),
            call: count("call"),
            // No formula of the corpus chooses.
            choice: 0,
        };
        let key = (row["formula"].clone(), row["form"].clone());
        counts
            .entry(key)
            .or_default()
            .push((row["tool"].clone(), cost));
    }
    counts
}

/// All operations, each counted once.
fn total(cost: &Cost) -> usize {
    cost.operations() + cost.div + cost.sqrt + cost.call
}

#[test]
fn no_formula_of_the_corpus_takes_more_than_by_other_tools() {
    let peers = peers();
    let mut short = Vec::new();
    let mut formulas = 0;
    for field in &FIELDS {
        let mut system = field.system().unwrap();
        for name in field.formulas {
            formulas += 1;
            let counted = field.counted(&mut system, name).unwrap();
            for (form, cost) in ["value", "gradient"].into_iter().zip(counted.costs()) {
                let (weight, all) = (cost.weight(), total(&cost));
                println!("{name} {form}: {weight} by weight, {all} in total ({cost})");
                let key = ((*name).to_owned(), form.to_owned());
                assert_eq!(peers[&key].len(), 3, "{name} {form}: a tool is missing");
                for (tool, other) in &peers[&key] {
                    let (weighs, has) = (other.weight(), total(other));
                    println!("    {tool}: {weighs} by weight, {has} in total ({other})");
                    if weight > weighs || all > has {
                        short.push(format!(
                            "{name} {form}: {weight}, {all}; {tool} {weighs}, {has}"
                        ));
                    }
                }
            }
        }
    }
    assert_eq!(formulas, 30);
    assert!(short.is_empty(), "fewer elsewhere: {short:#?}");
}

/// The generated forms are those of the functions as written, at the point where the other tools' are compared.
#[test]
fn the_corpus_is_exported_with_its_numbers() {
    let descriptions = descriptions().unwrap();
    let formulas = descriptions.as_array().unwrap();
    assert_eq!(formulas.len(), 30);
    assert!(
        python_text()
            .unwrap()
            .contains("def lennard_jones(op, r, depth, size):")
    );
    let found = formulas
        .iter()
        .find(|formula| formula["name"] == "heron")
        .unwrap();
    let at = |place: usize| found["symbols"][place]["value"].as_f64().unwrap();
    let (value, slopes) = heron::gradient(at(0), at(1), at(2));
    for (place, number) in std::iter::once(value).chain(slopes).enumerate() {
        let expected = found["expected"][place].as_f64().unwrap();
        assert!((number - expected).abs() <= 1e-14 * expected.abs().max(1.0));
    }
}
