//! Zero unstable points of rotors of which the search once missed some or made one up, against roots in many digits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::jeffcott::zup::{zup_depth, zup_position};
use rotor_tests::{Record, cases, parameters};

/// The depths or positions that the search of a row finds.
fn found(row: &Record) -> Vec<f64> {
    let rotor = Rotor::new(parameters(row)).unwrap();
    let kind = match row["region"].as_str() {
        "sir" => RegionKind::Simple,
        "sir2" => RegionKind::UpperSimple,
        _ => RegionKind::Combination,
    };
    let points = if row["search"].starts_with("depth") {
        zup_depth(&rotor, kind)
    } else {
        zup_position(&rotor, kind)
    };
    points.unwrap().iter().map(|point| point.value).collect()
}

/// Whether one of some roots is this one: they are as steep as single ones or as flat as double ones, of which a double has half
/// of the digits.
fn has(roots: &[f64], root: f64) -> bool {
    roots
        .iter()
        .any(|other| (other - root).abs() <= 1e-8 * root)
}

#[test]
fn roots_that_are_steep_or_near_each_other_are_found() {
    for row in cases("zup.csv") {
        let found = found(&row);
        for root in row["true_roots"].split_whitespace() {
            assert!(has(&found, root.parse().unwrap()), "{root}: {found:?}");
        }
        let expected = row["true_roots"].split_whitespace().count();
        assert!(found.len() >= expected, "{found:?}");
    }
}

#[test]
fn a_jump_is_no_root() {
    let made_up = cases("zup.csv");
    let made_up = made_up
        .iter()
        .filter(|row| row["search"].ends_with("EXTRA"));
    for row in made_up {
        let found = found(row);
        let expected = row["true_roots"].split_whitespace().count();
        assert_eq!(found.len(), expected, "{found:?}");
    }
}
