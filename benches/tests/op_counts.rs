//! The generator's operation counts beside those of SymPy, SymForce and wrenfold, on every formula of the corpus.
//!
//! `corpus/op_counts.csv` holds the others' counts and versions; `cargo xtask peers --counts` writes it anew.

use std::collections::BTreeMap;
use std::path::Path;

use codegen::cost::Cost;
use rotor_benches::corpus::FIELDS;

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
    for field in &FIELDS {
        let mut expansion = field.expansion().unwrap();
        for name in field.formulas {
            let counted = field.counted(&mut expansion, name).unwrap();
            for (form, cost) in ["value", "gradient"].into_iter().zip(counted.costs()) {
                let key = ((*name).to_owned(), form.to_owned());
                println!(
                    "{name} {form}: {} weight, {} total ({cost})",
                    cost.weight(),
                    total(&cost)
                );
                for (tool, other) in &peers[&key] {
                    let loses = cost.weight() > other.weight() || total(&cost) > total(other);
                    let mark = if loses { "  <-- fewer" } else { "" };
                    println!(
                        "    {tool}: {} weight, {} total ({other}){mark}",
                        other.weight(),
                        total(other)
                    );
                    if loses {
                        short.push(format!("{name} {form} by {tool}"));
                    }
                }
            }
        }
    }
    assert_eq!(short, Vec::<String>::new());
}
