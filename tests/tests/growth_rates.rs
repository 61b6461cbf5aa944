//! The exact growth rate against 50 digits where roots of the quartic nearly meet: flat disks, and the ends of regions.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::exact::growth_rate;
use rotor_tests::{coefficients, number, table};

#[test]
fn growth_rates_in_fifty_digits() {
    let rows = table("growth_rates.csv");
    for (group, least) in [("flat", 70), ("negative", 30), ("positive", 30)] {
        let rows: Vec<_> = rows.iter().filter(|row| row["group"] == group).collect();
        assert!(rows.len() >= least, "{group}: {} rows", rows.len());
        let mut worst = 0.0_f64;
        for row in rows {
            let c = coefficients(row);
            let (speed, expected) = (number(row, "speed"), number(row, "growth_rate"));
            let found = growth_rate(&c, speed).unwrap();
            assert!(
                expected != 0.0 || found == 0.0,
                "{group}: {found:e} where nothing grows, {c:?} at {speed}"
            );
            let error = (found - expected).abs();
            worst = worst.max(error);
            // A part in 1e12 beside an end, the last digit of the angle counts for more.
            let turned = Coefficients {
                crack_angle: c.crack_angle.next_up(),
                ..c
            };
            let by_angle = (growth_rate(&turned, speed).unwrap() - found).abs();
            assert!(
                error <= 1e-13 + by_angle,
                "{group}: {found:e}, not {expected:e}, {c:?} at {speed}"
            );
        }
        println!("{group}: off by {worst:.1e} at most");
    }
}
