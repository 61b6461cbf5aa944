//! Means of numbers of very different sizes, of which a plain sum would lose the small ones.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::input::NumericInput;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{Axis, Control, Plan, Reduction, Scan, Statistic};

/// The disk's diametral inertia is 1 in one row of so many, and this in the others.
const ROWS_PER_LARGE_BETA: u64 = 50;
const INERTIA: f64 = (1_u64 << 39) as f64;

/// Rows, and points of a row: several chunks, so that sums of chunks are added too.
const ROWS: u64 = 3000;
const COLUMNS: u64 = 150;

/// More than the roundings of a mean whose sum has none, far less than what a plain sum of so many numbers loses.
const RELATIVE: f64 = 8.0 * f64::EPSILON;

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

/// The polar inertia of a column, from 1 to 2. It has 30 binary digits, so that those of its quotients by the two diametral
/// inertias, which are powers of two, do not overlap: a sum of both kinds needs more digits than a number has.
fn polar(column: u64) -> f64 {
    // Odd, so that the last digit is not zero, and such that the numbers lie between 1 and 2.
    const STEP: u64 = 1_600_001;
    1.0 + ((2 * column + 1) * STEP) as f64 / f64::from(1 << 29)
}

/// The plan of the mean of beta over axes of a grid of diametral by polar inertias.
fn mean_over(axes: &[&str]) -> Plan {
    let diametral = |row| {
        if row % ROWS_PER_LARGE_BETA == 0 {
            1.0
        } else {
            INERTIA
        }
    };
    let diametral = (0..ROWS).map(diametral).collect();
    let polar = (0..COLUMNS).map(polar).collect();
    let reduction = Reduction::new(Statistic::Mean);
    let reduction = axes
        .iter()
        .fold(reduction, |reduction, axis| reduction.over(input(axis)));
    let scan = Scan::of(&Rotor::default())
        .vary(Axis::listed(input("disk_diametral_inertia"), diametral).unwrap())
        .vary(Axis::listed(input("disk_polar_inertia"), polar).unwrap());
    scan.quantity(Quantity::Beta)
        .reduce(reduction)
        .plan()
        .unwrap()
}

/// The mean of the reciprocal diametral inertias, of which both sums are exact.
fn mean_reciprocal() -> f64 {
    let large = ROWS / ROWS_PER_LARGE_BETA;
    let small = (ROWS - large) as f64 / INERTIA;
    (large as f64 + small) / ROWS as f64
}

fn assert_near(found: f64, expected: f64) {
    let error = found / expected - 1.0;
    assert!(error.abs() <= RELATIVE, "{found:e} is off by {error:e}");
}

#[test]
fn a_mean_over_rows_keeps_the_digits_of_small_numbers() {
    let plan = mean_over(&["disk_diametral_inertia"]);
    let reduced = plan.reduce(&Control::default()).unwrap().reduced;
    assert_eq!(reduced[0].groups(), COLUMNS);
    for column in 0..COLUMNS {
        let mean = reduced[0].value(0, column).unwrap();
        assert_near(mean, polar(column) * mean_reciprocal());
    }
}

#[test]
fn a_mean_over_the_whole_grid_keeps_the_digits_of_small_numbers() {
    let plan = mean_over(&["disk_diametral_inertia", "disk_polar_inertia"]);
    let reduced = plan.reduce(&Control::default()).unwrap().reduced;
    // The sums of the polar inertias are exact: a few hundred numbers of 30 digits.
    let polars: f64 = (0..COLUMNS).map(polar).sum();
    let mean = reduced[0].value(0, 0).unwrap();
    assert_near(mean, polars / COLUMNS as f64 * mean_reciprocal());
}
