//! Roots that meet without becoming complex, where only the last of 32 digits tell that nothing grows.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::exact::{growth_rate, squared_offsets};
use rotor_core::jeffcott::region::{Region, RegionKind};

/// A rotor without crack and asymmetry.
fn symmetric(beta: f64, gamma: f64, delta: f64) -> Coefficients {
    Coefficients {
        beta,
        gamma,
        delta,
        epsilon_1: 0.0,
        epsilon_12: 0.0,
        epsilon_2: 0.0,
        disk_asymmetry: 0.0,
        crack_angle: 0.3,
    }
}

/// A speed and its neighbours among the doubles.
fn around(speed: f64) -> Vec<f64> {
    let below = std::iter::successors(Some(speed), |speed| Some(speed.next_down()));
    let above = std::iter::successors(Some(speed), |speed| Some(speed.next_up()));
    below.take(4).chain(above.take(4)).collect()
}

/// Ratios of inertia from a disk that is a rod to one that is flat, but for those at which a region is infinitely far.
fn inertia_ratios() -> impl Iterator<Item = f64> {
    (1..40)
        .map(|step| 0.05 * f64::from(step))
        .filter(|beta| (beta - 1.0).abs() > 0.01)
}

#[test]
fn roots_that_cross_in_a_symmetric_rotor_stay_real() {
    for beta in inertia_ratios() {
        for gamma in [0.03, -0.5, -0.9, 1.7] {
            let c = symmetric(beta, gamma, gamma * gamma + 0.8);
            let start = Region::of(RegionKind::Combination, &c).unwrap().start();
            for speed in around(start) {
                let roots = squared_offsets(&c, speed).unwrap();
                assert!(
                    roots.iter().all(|root| root.im == 0.0),
                    "beta {beta}, gamma {gamma}, speed {speed:e}: {roots:?}"
                );
            }
        }
    }
}

#[test]
fn a_whirl_that_turns_with_the_rotor_does_not_grow_where_nothing_excites_it() {
    // Displacement and tilt are not coupled, and only one of them is excited, elsewhere.
    const DELTA: f64 = 3.0;
    const EPSILON: f64 = 0.1;
    for beta in inertia_ratios() {
        let uncoupled = symmetric(beta, 0.0, DELTA);
        let tilting = Coefficients {
            epsilon_2: EPSILON,
            ..uncoupled
        };
        for speed in around(1.0) {
            assert_eq!(growth_rate(&tilting, speed), Ok(0.0), "{beta} {speed:e}");
        }
        let displacing = Coefficients {
            epsilon_1: EPSILON,
            ..uncoupled
        };
        if beta < 1.0 {
            for speed in around((DELTA / (1.0 - beta)).sqrt()) {
                assert_eq!(growth_rate(&displacing, speed), Ok(0.0), "{beta} {speed:e}");
            }
        }
    }
}
