//! The inertia ratio β is one quotient wherever it comes from, so that disks at its limits 1 and 2 are at them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::error::{Error, RegionError};
use rotor_core::input::{NumericInput, RotorParameters};
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::table::{Column, evaluate};

/// Diametral inertias in steps of a thousandth, of which one in seven has an inverse that does not give 1 back.
fn diametral_inertias() -> Vec<f64> {
    (1..1000).map(|part| f64::from(part) / 1000.0).collect()
}

fn column<'a>(name: &str, values: &'a [f64]) -> Column<'a> {
    Column {
        input: NumericInput::find(name).unwrap(),
        values,
    }
}

fn rotor(diametral: f64, ratio: f64) -> Rotor {
    let polar = ratio * diametral;
    Rotor::new(RotorParameters {
        disk_diametral_inertia: diametral,
        disk_polar_inertia: polar,
        ..RotorParameters::PAPER
    })
    .unwrap()
}

#[test]
fn disks_at_the_limits_have_no_region_beyond() {
    for diametral in diametral_inertias() {
        for (ratio, kind) in [
            (1.0, RegionKind::UpperSimple),
            (2.0, RegionKind::Combination),
        ] {
            let rotor = rotor(diametral, ratio);
            assert_eq!(rotor.coefficients().unwrap().beta, ratio, "{diametral}");
            let found = rotor.region(kind);
            assert!(
                matches!(found, Err(Error::Region(RegionError::InertiaRatio { .. }))),
                "{diametral}: {found:?}"
            );
        }
    }
}

#[test]
fn tables_have_the_quotient_in_every_row() {
    let diametral = diametral_inertias();
    for ratio in [0.5, 1.0, 1.7, 2.0] {
        let polar: Vec<f64> = diametral.iter().map(|inertia| ratio * inertia).collect();
        let columns = [
            column("disk_diametral_inertia", &diametral),
            column("disk_polar_inertia", &polar),
        ];
        let quantities = [Quantity::Beta, Quantity::Gamma];
        let found = evaluate(&RotorParameters::PAPER, &columns, &quantities).unwrap();
        for (row, (polar, diametral)) in polar.iter().zip(&diametral).enumerate() {
            assert_eq!(found.column(0).get(row), Some(polar / diametral));
        }
    }
}
