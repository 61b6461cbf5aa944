//! All instability regions of a rotor: against exact rational root isolation, and against a dense scan of growth rates.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::exact::growth_rate;
use rotor_core::jeffcott::exact::regions::{UnstableRange, regions};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_tests::{Record, cases, parameters, relative_error};

/// Ranges as the tables have them: `0.27..0.80; 1.35..inf`.
fn ranges(text: &str) -> Vec<UnstableRange> {
    let each = text.split(';').map(|range| {
        let (lower, upper) = range.trim().split_once("..").unwrap();
        UnstableRange {
            lower: lower.parse().unwrap(),
            upper: upper.parse().unwrap(),
        }
    });
    each.collect()
}

fn check(row: &Record, column: &str) {
    let c = Rotor::new(parameters(row)).unwrap().coefficients().unwrap();
    let (found, expected) = (regions(&c).unwrap(), ranges(&row[column]));
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(&expected) {
        for (found, expected) in [(found.lower, expected.lower), (found.upper, expected.upper)] {
            // The tables have twelve digits behind the point.
            let error = relative_error(found, expected);
            assert!(error < 1e-11, "{found} for {expected}");
        }
    }
}

#[test]
fn rotors_of_which_regions_were_missed() {
    for row in cases("regions_missed_by_cli.csv") {
        check(&row, "all_unstable");
    }
    for row in cases("regions_with_stable_speeds.csv") {
        check(&row, "true_unstable_regions");
    }
}

/// Coefficients at pseudo-random places of the ranges that occur, and beyond.
fn samples() -> impl Iterator<Item = Coefficients> {
    let mut state = 7_u64;
    let mut between = move |low: f64, high: f64| {
        // Knuth's linear congruential generator.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    std::iter::repeat_with(move || {
        let delta = between(0.05, 6.0);
        Coefficients {
            beta: between(0.05, 2.0),
            gamma: between(-0.99, 0.99) * delta.sqrt(),
            delta,
            epsilon_1: between(-0.6, 0.6),
            epsilon_12: between(-0.6, 0.6),
            epsilon_2: between(-0.6, 0.6),
            disk_asymmetry: between(-0.95, 0.95),
            crack_angle: between(-4.0, 4.0),
        }
    })
}

#[test]
fn between_the_ends_the_motion_grows_and_nowhere_else() {
    let (mut unstable, mut stable) = (0, 0);
    for c in samples().take(400) {
        let found = regions(&c).unwrap();
        for index in 1..300 {
            let speed = 0.013 * f64::from(index) * (1.0 + 0.02 * f64::from(index));
            let is_inside = |range: &UnstableRange| range.lower < speed && speed < range.upper;
            let grows = growth_rate(&c, speed).unwrap() > 0.0;
            assert_eq!(
                grows,
                found.iter().any(is_inside),
                "{speed}: {found:?} {c:?}"
            );
            *(if grows { &mut unstable } else { &mut stable }) += 1;
        }
    }
    assert!(unstable > 10_000 && stable > 10_000, "{unstable} {stable}");
}

#[test]
fn beside_each_end_the_motion_is_stable_on_one_side_alone() {
    for c in samples().take(400) {
        for range in regions(&c).unwrap() {
            let aside = 1e-9 * range.lower;
            if range.lower > 0.0 && range.upper - range.lower > 4.0 * aside {
                assert_eq!(
                    growth_rate(&c, range.lower - aside),
                    Ok(0.0),
                    "{range:?} {c:?}"
                );
                assert!(
                    growth_rate(&c, range.lower + aside).unwrap() > 0.0,
                    "{range:?} {c:?}"
                );
            }
        }
    }
}
