//! 300 random rotors of all three crack models against an independent high-precision program.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test fails by panicking and shows what it measured"
)]

use std::collections::BTreeMap;
use std::path::Path;

use rotor_core::input::{INPUTS, RotorParameters};
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::evaluate;

/// Every quantity of every rotor has to be within this.
const EVERY: f64 = 1e-10;
/// Of every quantity, [`SHARE`] of the rotors have to be within this.
const MOST: f64 = 1e-12;
const SHARE: f64 = 0.95;

/// The exact ends nearest to the start mean the region only where the approximation holds.
const EXACT_WITHIN: f64 = 0.25;

struct Row {
    rotor: Rotor,
    expected: BTreeMap<&'static str, f64>,
}

fn rows() -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference/random_rotors.csv");
    let mut reader = csv::Reader::from_path(path).expect("the reference table is there");
    let records = reader.deserialize::<BTreeMap<String, String>>();
    records
        .map(|record| row(&record.expect("the reference table is well formed")))
        .collect()
}

fn row(record: &BTreeMap<String, String>) -> Row {
    let number = |name: &str| record[name].parse::<f64>().expect("a number");
    let mut parameters = RotorParameters::PAPER;
    for input in &INPUTS {
        (input.set)(&mut parameters, number(input.name));
    }
    parameters.crack_model = record["crack_model"].parse().expect("a crack model");
    let expected = Quantity::ALL
        .into_iter()
        .map(Quantity::name)
        // No number: the other program found no pair of exact ends near the start.
        .filter(|name| record.get(*name).is_some_and(|cell| !cell.is_empty()))
        .map(|name| (name, number(name)))
        .collect();
    Row {
        rotor: Rotor::new(parameters).expect("a valid rotor"),
        expected,
    }
}

/// Whether the row's exact ends of `region` (`sir` or `cir`) can be compared.
fn exact_ends_comparable(row: &Row, region: &str) -> bool {
    let of = |suffix: &str| row.expected.get(format!("{region}_{suffix}").as_str());
    match (of("width"), of("exact_lower"), of("exact_upper")) {
        (Some(width), Some(lower), Some(upper)) => {
            (upper - lower - width).abs() <= EXACT_WITHIN * width
        }
        _ => false,
    }
}

#[test]
fn every_quantity_of_every_rotor() {
    let rows = rows();
    assert_eq!(rows.len(), 300);
    let mut errors: BTreeMap<&str, Vec<(f64, usize)>> = BTreeMap::new();
    let mut missing = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        for (quantity, value) in Quantity::ALL
            .into_iter()
            .zip(evaluate(&Quantity::ALL, &row.rotor))
        {
            let name = quantity.name();
            let Some(&expected) = row.expected.get(name) else {
                continue;
            };
            if let Some((region, _)) = name.split_once("_exact_")
                && !exact_ends_comparable(row, region)
            {
                continue;
            }
            let value = match value {
                Ok(value) => value,
                Err(reason) => {
                    missing.push(format!("row {index}, {name}: {reason}"));
                    continue;
                }
            };
            let error = if value == expected {
                0.0
            } else {
                ((value - expected) / expected).abs()
            };
            errors.entry(name).or_default().push((error, index));
        }
    }
    // All that a rotor alone has but beta, which the table gives as two inputs, and the upper simple region, which it lacks.
    let of_rotor = Quantity::ALL.into_iter().filter(|quantity| {
        !quantity.needs_speed() && quantity.region() != Some(RegionKind::UpperSimple)
    });
    assert_eq!(errors.len(), of_rotor.count() - 1);
    report(&errors);
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    for (name, errors) in &errors {
        assert!(
            errors.len() >= 150,
            "{name} was compared for {} rotors only",
            errors.len()
        );
        let (worst, row) = worst(errors);
        assert!(worst <= EVERY, "{name} of row {row} is off by {worst:.2e}");
        assert!(
            share(errors) >= SHARE,
            "{name} is right to {MOST} for {}",
            share(errors)
        );
    }
}

fn report(errors: &BTreeMap<&str, Vec<(f64, usize)>>) {
    for (name, errors) in errors {
        let (worst, row) = worst(errors);
        println!(
            "{name:20} {:3} rotors, worst {worst:.2e} (row {row}), {:.1}% within {MOST}",
            errors.len(),
            100.0 * share(errors)
        );
    }
    let all: Vec<_> = errors.values().flatten().copied().collect();
    println!("{:20} {:.2}% within {MOST}", "overall", 100.0 * share(&all));
}

fn worst(errors: &[(f64, usize)]) -> (f64, usize) {
    errors
        .iter()
        .copied()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .expect("compared at least once")
}

fn share(errors: &[(f64, usize)]) -> f64 {
    errors.iter().filter(|(error, _)| *error <= MOST).count() as f64 / errors.len() as f64
}
