//! Exact ends of rotors with which the library was wrong once, against exact rational root isolation and 80 digits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::equations::Coefficients;
use rotor_core::error::Error;
use rotor_core::jeffcott::exact::regions::regions;
use rotor_core::jeffcott::exact::{Ends, simple_region_ends};
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_tests::{Record, cases, number, parameters, relative_error};

fn rotor(row: &Record) -> Rotor {
    Rotor::new(parameters(row)).unwrap()
}

fn ends(rotor: &Rotor, kind: RegionKind) -> Result<Ends, Error> {
    rotor.region(kind)?.exact_ends()
}

/// Whether an interval without stable speeds holds these ends, to the last digits.
fn is_unstable_between(c: &Coefficients, ends: Ends) -> bool {
    let aside = 1e-12 * ends.upper;
    let mut all = regions(c).unwrap().into_iter();
    all.any(|range| range.lower <= ends.lower + aside && ends.upper - aside <= range.upper)
}

#[test]
fn a_simple_region_holds_no_stable_speeds() {
    for file in [
        "regions_with_stable_speeds.csv",
        "regions_missed_by_cli.csv",
    ] {
        for row in cases(file) {
            let rotor = rotor(&row);
            let c = rotor.coefficients().unwrap();
            let found = ends(&rotor, RegionKind::Simple).unwrap();
            assert!(is_unstable_between(&c, found), "{found:?} of {c:?}");
        }
    }
}

#[test]
fn an_end_at_infinity_is_none() {
    for row in cases("end_at_infinity.csv") {
        let c = rotor(&row).coefficients().unwrap();
        let found = simple_region_ends(&c).unwrap();
        let expected = number(&row, "expected_number_of_simple_ends");
        assert_eq!(found.len() as f64, expected, "{found:?}");
    }
}

#[test]
fn ends_at_high_speeds_have_their_digits() {
    for row in cases("end_digits_ordinary.csv") {
        let c = rotor(&row).coefficients().unwrap();
        let expected = number(&row, "expected");
        // How far one rounding of β moves the end: its square is the inverse of what is nearly zero.
        let nearest = (1.0 - c.beta).abs() - c.disk_asymmetry.abs();
        let allowed = 1e-12 + f64::EPSILON / nearest.abs();
        let found = simple_region_ends(&c).unwrap();
        let errors = found.iter().map(|end| relative_error(*end, expected));
        let error = errors.fold(f64::INFINITY, f64::min);
        assert!(
            error <= allowed,
            "{error:.1e} allowed {allowed:.1e}: {found:?} {expected}"
        );
    }
}

#[test]
fn combination_regions_are_at_positive_speeds() {
    for file in ["cir_negative_speed.csv", "cir_negative.csv"] {
        for row in cases(file) {
            let rotor = rotor(&row);
            let c = rotor.coefficients().unwrap();
            match ends(&rotor, RegionKind::Combination) {
                Ok(found) => {
                    assert!(0.0 < found.lower && found.lower <= found.upper, "{found:?}");
                    assert!(is_unstable_between(&c, found), "{found:?} of {c:?}");
                }
                Err(why) => println!("{why}"),
            }
            if let Some(expected) = row.get("expected") {
                assert_ends(
                    ends(&rotor, RegionKind::Combination).unwrap(),
                    expected,
                    1e-12,
                );
            }
        }
    }
}

/// Holds ends against those of a table: `1.35..1.36`.
fn assert_ends(found: Ends, expected: &str, allowed: f64) {
    let (lower, upper) = expected.split_once("..").unwrap();
    for (found, expected) in [(found.lower, lower), (found.upper, upper)] {
        let error = relative_error(found, expected.parse().unwrap());
        assert!(error < allowed, "{found} for {expected}: {error:.1e}");
    }
}

#[test]
fn combination_regions_near_their_start_are_found() {
    for row in cases("cir_refused_though_near.csv") {
        let rotor = rotor(&row);
        // A region near β = 2 is at about 1/(2 − β), which takes the rounding of β with it.
        let allowed = 1e-12 + f64::EPSILON / (2.0 - rotor.coefficients().unwrap().beta);
        let found = ends(&rotor, RegionKind::Combination).unwrap();
        assert_ends(found, &row["expected_region"], allowed);
    }
}

#[test]
fn coinciding_ends_are_a_pair() {
    // Displacement and tilt are uncoupled; a round shaft has its region closed at 1, a tilting disk from 1 to √(5/3).
    let c = Coefficients {
        beta: 0.2,
        gamma: 0.0,
        delta: 1.0,
        epsilon_1: 0.0,
        epsilon_12: 0.0,
        epsilon_2: 0.0,
        disk_asymmetry: 0.2,
        crack_angle: 0.0,
    };
    let found = [RegionKind::Simple, RegionKind::UpperSimple].map(|kind| {
        let region = Region::of(kind, &c).unwrap();
        region.exact_ends().unwrap()
    });
    let [simple, upper] = found;
    assert_eq!([simple.lower, simple.upper, upper.lower], [1.0; 3]);
    assert!(
        relative_error(upper.upper, (5.0_f64 / 3.0).sqrt()) < 1e-15,
        "{upper:?}"
    );
}
