//! Quantities of extreme rotors, disks close to a support, of much inertia and with β near 2 among them, of which answers lost
//! more digits than their condition explains or were refused: against 20 digits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::evaluate;
use rotor_tests::{Record, cases, number, parameters, relative_error};

/// The quantities of which every case of the table is held to its digits.
const HELD: [&str; 6] = [
    "epsilon_1",
    "epsilon_12",
    "epsilon_2",
    "sir_start",
    "sir_width",
    "cir_zup_asymmetry",
];

/// The condition number of a case, 1 where it says none.
fn condition(row: &Record) -> f64 {
    let after = row["note"].split_once("cond ");
    after.map_or(1.0, |(_, condition)| condition.parse().unwrap())
}

#[test]
fn answers_have_the_digits_that_their_condition_leaves() {
    let mut held = 0;
    for row in cases("extreme_digits.csv") {
        let name = row["quantity"].as_str();
        // Where there should be no answer the table has none; an answer of zero belongs to rotors without coupling, which have no
        // such quantity.
        let has_answer = row["kind"] != "answered" && row["expected"] != "0.0";
        if !has_answer || !HELD.contains(&name) {
            continue;
        }
        let expected = number(&row, "expected");
        let quantity = Quantity::ALL
            .into_iter()
            .find(|quantity| quantity.name() == name);
        let rotor = Rotor::new(parameters(&row)).unwrap();
        let found = evaluate(&[quantity.unwrap()], &rotor).remove(0).unwrap();
        let error = relative_error(found, expected);
        let allowed = 1e-12 * condition(&row).max(1.0);
        assert!(
            error <= allowed,
            "{name} is off by {error:.1e}, allowed {allowed:.1e}: {row:?}"
        );
        held += 1;
    }
    assert!(held >= 60, "{held}");
}

#[test]
fn disks_at_the_limit_have_no_combination_region() {
    for row in cases("extreme_digits.csv") {
        if row["quantity"] == "cir_start" && row["kind"] == "answered" {
            let rotor = Rotor::new(parameters(&row)).unwrap();
            let found = evaluate(&[Quantity::CirStart], &rotor).remove(0);
            assert!(found.is_err(), "{found:?}");
        }
    }
}
