//! Every row of `known_values.csv`: published and closed-form values of other systems, through the public functions.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::DMatrix;
use rotor_core::equations::Coefficients;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::exact::Ends;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::periodic::{FourierMatrix, PeriodicSystem, hill, monodromy};
use rotor_tests::{Record, number, relative_error, table};

/// The tables give ten digits or more; a boundary that is looked for costs a few.
const BOUNDARY: f64 = 3e-10;

/// An undamped motion counts as growing from this rate on: rounding leaves less where two multipliers meet.
const GROWS: f64 = 5e-7;

/// The rows of one case, at least one; a row without parameters of its own has those of the row above.
fn rows(case: &str) -> Vec<Record> {
    let mut rows: Vec<Record> = table("known_values.csv")
        .into_iter()
        .filter(|row| row["case"] == case)
        .collect();
    assert!(!rows.is_empty(), "{case}");
    for index in 1..rows.len() {
        if rows[index]["parameters"] == "the same" {
            let above = rows[index - 1]["parameters"].clone();
            rows[index].insert("parameters".into(), above);
        }
    }
    rows
}

/// The number after `name=` in the row's parameters; 0 without it.
fn parameter(row: &Record, name: &str) -> f64 {
    let text = &row["parameters"];
    text.split([' ', ';', ','])
        .find_map(|word| word.strip_prefix(name)?.strip_prefix('='))
        .map_or(0.0, |value| value.parse().unwrap())
}

fn end(ends: Ends, row: &Record) -> f64 {
    if row["quantity"].ends_with("lower") {
        ends.lower
    } else {
        ends.upper
    }
}

/// The boundary near `value`, by bisection, where `growing` changes.
fn boundary(value: f64, growing: impl Fn(f64) -> bool) -> f64 {
    let (mut lower, mut upper) = (value - 1e-3, value + 1e-3);
    let below = growing(lower);
    assert_ne!(
        below,
        growing(upper),
        "no boundary between {lower} and {upper}"
    );
    for _ in 0..45 {
        let middle = 0.5 * (lower + upper);
        if growing(middle) == below {
            lower = middle;
        } else {
            upper = middle;
        }
    }
    0.5 * (lower + upper)
}

fn by_hill(system: &PeriodicSystem) -> f64 {
    hill::growth_rate(system, 12).unwrap()
}

fn by_monodromy(system: &PeriodicSystem) -> f64 {
    monodromy::growth_rate(system, 1e-13).unwrap()
}

#[test]
fn every_case_is_tested() {
    let tested = [
        "mathieu",
        "asymmetric_shaft",
        "asymmetric_shaft_damped",
        "tilting_disk",
        "four_degree",
        "crack_compliance",
    ];
    for row in table("known_values.csv") {
        assert!(tested.contains(&row["case"].as_str()), "{row:?}");
    }
}

#[test]
fn characteristic_values_of_mathieus_equation() {
    let one = |x: f64| DMatrix::from_element(1, 1, x);
    for row in rows("mathieu") {
        let (q, expected) = (parameter(&row, "q"), number(&row, "value"));
        let system = |a: f64| {
            let stiffness =
                FourierMatrix::constant(one(a)).with_harmonic(1, one(-2.0 * q), one(0.0));
            PeriodicSystem::new(2.0, one(1.0), one(0.0), stiffness).unwrap()
        };
        for (way, growth) in [
            ("Hill", by_hill as fn(&PeriodicSystem) -> f64),
            ("monodromy", by_monodromy),
        ] {
            let found = boundary(expected, |a| growth(&system(a)) > GROWS);
            assert!(
                (found - expected).abs() <= BOUNDARY,
                "{} at q = {q} by {way}: {found}, expected {expected}",
                row["quantity"]
            );
        }
    }
}

/// m = 1, k = 0.9 and 1.1 in axes that turn at `speed`, external damping.
fn asymmetric_shaft(speed: f64, damping: f64) -> PeriodicSystem {
    let two = |rows: [f64; 4]| DMatrix::from_row_slice(2, 2, &rows);
    PeriodicSystem::new(
        2.0 * speed,
        DMatrix::identity(2, 2),
        DMatrix::identity(2, 2) * damping,
        FourierMatrix::constant(DMatrix::identity(2, 2)).with_harmonic(
            1,
            two([-0.1, 0.0, 0.0, 0.1]),
            two([0.0, -0.1, -0.1, 0.0]),
        ),
    )
    .unwrap()
}

#[test]
fn ends_of_the_asymmetric_shaft() {
    // A damped motion decays outside the region, so that the growth rate itself changes its sign.
    for (case, damping, grows) in [
        ("asymmetric_shaft", 0.0, GROWS),
        ("asymmetric_shaft_damped", 0.04, 0.0),
    ] {
        for row in rows(case) {
            let expected = number(&row, "value");
            for (way, growth) in [
                ("Hill", by_hill as fn(&PeriodicSystem) -> f64),
                ("monodromy", by_monodromy),
            ] {
                let found = boundary(expected, |speed| {
                    growth(&asymmetric_shaft(speed, damping)) > grows
                });
                assert!(
                    (found - expected).abs() <= BOUNDARY,
                    "{case} by {way}: {found}, expected {expected}"
                );
            }
        }
    }
}

#[test]
fn ends_of_the_tilting_disk() {
    for row in rows("tilting_disk") {
        let c = Coefficients {
            beta: parameter(&row, "beta"),
            gamma: 0.0,
            delta: parameter(&row, "delta"),
            epsilon_1: 0.0,
            epsilon_12: 0.0,
            epsilon_2: 0.0,
            disk_asymmetry: parameter(&row, "Delta"),
            crack_angle: 0.0,
        };
        // Of the two simple regions the transverse motion's, at the speed 1, is the lower one.
        let ends = Region::of(RegionKind::UpperSimple, &c)
            .unwrap()
            .exact_ends()
            .unwrap();
        assert!(relative_error(end(ends, &row), number(&row, "value")) <= 1e-10);
    }
}

#[test]
fn ends_of_the_dimensionless_rotors() {
    for row in rows("four_degree") {
        let c = Coefficients {
            beta: parameter(&row, "beta"),
            gamma: parameter(&row, "gamma"),
            delta: parameter(&row, "delta"),
            epsilon_1: parameter(&row, "eps1"),
            epsilon_12: parameter(&row, "eps12"),
            epsilon_2: parameter(&row, "eps2"),
            disk_asymmetry: parameter(&row, "Delta"),
            crack_angle: parameter(&row, "phi"),
        };
        let kind = if row["quantity"].starts_with("sir") {
            RegionKind::Simple
        } else {
            RegionKind::Combination
        };
        let ends = Region::of(kind, &c).unwrap().exact_ends().unwrap();
        let error = relative_error(end(ends, &row), number(&row, "value"));
        assert!(
            error <= 1e-11,
            "{} with {}: {error:.1e}",
            row["quantity"],
            row["parameters"]
        );
    }
}

#[test]
fn crack_compliances() {
    for row in rows("crack_compliance") {
        let p = RotorParameters {
            crack_depth_ratio: parameter(&row, "sigma"),
            ..RotorParameters::PAPER
        };
        let c = Rotor::new(p).unwrap().compliance().unwrap();
        let shear =
            p.shaft_youngs_modulus * p.shaft_radius / (1.0 - p.shaft_poissons_ratio.powi(2));
        let bending = shear * p.shaft_radius.powi(2);
        let value = match row["quantity"].as_str() {
            "c11" => c.c11 * shear,
            "c22" => c.c22 * shear,
            "c33" => c.c33 * bending,
            "c44" => c.c44 * bending,
            other => panic!("{other} is no compliance"),
        };
        let error = relative_error(value, number(&row, "value"));
        assert!(
            error <= 1e-9,
            "{} at {}: {value}, relative error {error:.1e}",
            row["quantity"],
            row["parameters"]
        );
    }
}
