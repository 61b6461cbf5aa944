//! The exact ends of combination regions of disks so flat that β nearly is 2, against 130 digits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_tests::{coefficients, number, relative_error, table};

#[test]
fn ends_just_below_the_limit() {
    let rows = table("flat_disk_ends.csv");
    assert_eq!(rows.len(), 15);
    let mut worst = 0.0_f64;
    for row in &rows {
        let ends = Region::of(RegionKind::Combination, &coefficients(row))
            .unwrap()
            .exact_ends()
            .unwrap();
        for (found, end) in [(ends.lower, "lower"), (ends.upper, "upper")] {
            let error = relative_error(found, number(row, end));
            worst = worst.max(error);
            assert!(
                error <= 1e-12,
                "{end} of {row:?} is {found:e}: off by {error:.1e}"
            );
        }
    }
    println!("ends of flat disks: off by {worst:.1e} at most");
}
