//! Rotors at the limits of what the inputs allow, where a quotient of the model is 0/0 or a number leaves its range.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::equations::{self, Coefficients};
use rotor_core::input::{CrackModel, RotorParameters};
use rotor_core::jeffcott::exact;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::Model;
use rotor_core::periodic::hill;

#[test]
fn uncoupled_rotors_have_generated_widths() {
    // At midspan the mean coupling and its variation are both zero, and epsilon_12 by itself is 0/0.
    for (depth, position) in [(0.0, 0.3), (0.2, 0.5), (0.7, 0.5)] {
        let p = RotorParameters {
            disk_position_ratio: 0.5,
            crack_depth_ratio: depth,
            crack_position_ratio: position,
            crack_angle: 0.3,
            crack_model: CrackModel::MidspanArm,
            ..RotorParameters::PAPER
        };
        let c = Rotor::new(p).unwrap().coefficients().unwrap();
        let (simple, combination) = equations::widths_midspan_arm::value(&p, 32.0);
        let expected = Region::of(RegionKind::Simple, &c).unwrap().width().unwrap();
        assert!(
            (simple - expected).abs() <= 1e-13 * expected,
            "{simple} {expected}"
        );
        assert_eq!(combination, 0.0);
    }
}

#[test]
fn an_angle_of_any_size_counts() {
    let paper = Rotor::default().coefficients().unwrap();
    for angle in [1e300, 1.5e308, f64::MAX, -f64::MAX] {
        let huge = Coefficients {
            crack_angle: angle,
            ..paper
        };
        let small = Coefficients {
            crack_angle: angle.sin().atan2(angle.cos()),
            ..paper
        };
        for speed in [0.74, 2.5, 2.6] {
            let both = |f: &dyn Fn(&Coefficients) -> f64| [f(&huge), f(&small)];
            for [found, expected] in [
                both(&|c| equations::phi::value(0.3, speed, c)),
                both(&|c| exact::growth_rate(c, speed).unwrap()),
                both(&|c| exact::simple_region_ends(c).unwrap()[0]),
                both(&|c| {
                    Region::of(RegionKind::Combination, c)
                        .unwrap()
                        .exact_ends()
                        .unwrap()
                        .upper
                }),
                both(&|c| {
                    let system = c.system(speed).unwrap();
                    hill::growth_rate(&system, 1).unwrap()
                }),
            ] {
                assert!(
                    (found - expected).abs() < 1e-11,
                    "{angle}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_crack_never_vanishes_by_underflow() {
    let scaled = |length: f64| {
        let paper = RotorParameters::PAPER;
        Rotor::new(RotorParameters {
            disk_diametral_inertia: paper.disk_diametral_inertia * length * length,
            disk_polar_inertia: paper.disk_polar_inertia * length * length,
            shaft_length: paper.shaft_length * length,
            shaft_radius: paper.shaft_radius * length,
            ..paper
        })
        .unwrap()
        .coefficients()
    };
    let expected = scaled(1.0).unwrap();
    for exponent in -60..=60 {
        let Ok(found) = scaled(10.0_f64.powi(exponent)) else {
            assert!(exponent.abs() > 20, "1e{exponent}");
            continue;
        };
        let error = (found.epsilon_1 / expected.epsilon_1 - 1.0).abs();
        assert!(error < 1e-12, "lengths times 1e{exponent}: {found:?}");
    }
    assert!(scaled(1e-50).is_err());
}
