//! What crosses crates: the paper, the reference tables, accuracy.
//!
//! The tests stand in `tests/`; here is what they share: the tables of `reference/` and `cases/`, and rotors from their rows.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "only tests use it, and they fail by panicking"
)]

use std::collections::BTreeMap;
use std::path::Path;

use rotor_core::equations::Coefficients;
use rotor_core::input::{INPUTS, RotorParameters};

/// A row of a table: cells by the names of their columns.
pub type Record = BTreeMap<String, String>;

/// The rows of a table in `reference/`, by its file's name.
///
/// # Panics
/// Where there is no such table, or it is not well formed.
pub fn table(file: &str) -> Vec<Record> {
    rows(&Path::new("reference").join(file))
}

/// The rows of a table in `cases/`: inputs with which the library was wrong once, and what is right.
///
/// # Panics
/// Where there is no such table, or it is not well formed.
pub fn cases(file: &str) -> Vec<Record> {
    rows(&Path::new("cases").join(file))
}

fn rows(file: &Path) -> Vec<Record> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let mut reader = csv::Reader::from_path(path).expect("the reference table is there");
    reader
        .deserialize()
        .map(|record| record.expect("the reference table is well formed"))
        .collect()
}

/// The number in a column.
///
/// # Panics
/// Where there is no such column, or no number in it.
pub fn number(record: &Record, column: &str) -> f64 {
    let cell = record
        .get(column)
        .unwrap_or_else(|| panic!("there is no column {column}"));
    cell.parse()
        .unwrap_or_else(|_| panic!("{column} is \"{cell}\", which is no number"))
}

/// The paper's rotor with every input that has a column taken from it.
///
/// # Panics
/// Where a cell is not what its input needs.
pub fn parameters(record: &Record) -> RotorParameters {
    let mut parameters = RotorParameters::PAPER;
    for input in INPUTS
        .iter()
        .filter(|input| record.contains_key(input.name))
    {
        (input.set)(&mut parameters, number(record, input.name));
    }
    if let Some(model) = record.get("crack_model") {
        parameters.crack_model = model.parse().expect("a crack model");
    }
    parameters
}

/// The dimensionless numbers in the columns of their names.
///
/// # Panics
/// Where one of them has no column, or no number in it.
pub fn coefficients(row: &Record) -> Coefficients {
    Coefficients {
        beta: number(row, "beta"),
        gamma: number(row, "gamma"),
        delta: number(row, "delta"),
        epsilon_1: number(row, "epsilon_1"),
        epsilon_12: number(row, "epsilon_12"),
        epsilon_2: number(row, "epsilon_2"),
        disk_asymmetry: number(row, "disk_asymmetry"),
        crack_angle: number(row, "crack_angle"),
    }
}

/// How far `value` is from `expected`, in units of `expected`; 0 where both are 0.
pub fn relative_error(value: f64, expected: f64) -> f64 {
    if value == expected {
        0.0
    } else {
        ((value - expected) / expected).abs()
    }
}
