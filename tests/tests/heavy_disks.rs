//! The simple region of disks of far more inertia than mass, where q = β − 1 − δ is positive: against 60 digits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_tests::{coefficients, number, relative_error, table};

#[test]
fn start_width_and_closing_asymmetry() {
    let rows = table("heavy_disks.csv");
    assert_eq!(rows.len(), 27);
    let mut worst = 0.0_f64;
    for row in &rows {
        let region = Region::of(RegionKind::Simple, &coefficients(row)).unwrap();
        let found = [
            ("sir_start", region.start()),
            ("sir_width", region.width().unwrap()),
            ("sir_zup_asymmetry", region.zup_asymmetry().unwrap()),
        ];
        for (name, value) in found {
            let error = relative_error(value, number(row, name));
            worst = worst.max(error);
            assert!(error <= 1e-13, "{name} of {row:?}: off by {error:.1e}");
        }
    }
    println!("heavy disks: off by {worst:.1e} at most");
}
