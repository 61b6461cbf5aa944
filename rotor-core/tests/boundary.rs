//! Ends of the rotor's regions from growth rates by Hill's method, held to the exact ones.
#![allow(
    clippy::unwrap_used,
    reason = "a helper of a test fails as a test does"
)]

use rotor_core::equations::Coefficients;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::exact::Ends;
use rotor_core::jeffcott::region::{self, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::{Model, confirm_ends};
use rotor_core::periodic::boundary::{self, Boundary, NoBoundary};

fn search(c: &Coefficients, start: f64, width: f64) -> Result<Boundary, NoBoundary> {
    boundary::search(|speed| c.growth_rate(speed), start, width)
}

fn coefficients(change: impl FnOnce(&mut RotorParameters)) -> Coefficients {
    Rotor::default()
        .with(change)
        .unwrap()
        .coefficients()
        .unwrap()
}

#[test]
fn ends_by_hill_are_the_exact_ones_over_angles_and_depths() {
    for kind in [RegionKind::Simple, RegionKind::Combination] {
        for (depth, angle) in [(0.05, 0.3), (0.2, 0.0), (0.2, 1.5), (0.3, 0.8), (0.4, 1.2)] {
            let c = coefficients(|p| (p.crack_depth_ratio, p.crack_angle) = (depth, angle));
            let exact = region::exact_ends(kind, &c).unwrap();
            let (start, width) = (region::start(kind, &c), region::width(kind, &c));
            for hill in [
                confirm_ends(&c, exact).unwrap(),
                search(&c, start.unwrap(), width.unwrap()).unwrap(),
            ] {
                let difference = hill.width() / exact.width() - 1.0;
                assert!(
                    difference.abs() < 1e-8,
                    "{kind} {depth} {angle}: {difference:e}"
                );
            }
        }
    }
}

#[test]
fn ends_do_not_follow_exact_ones_that_are_wrong() {
    let c = Rotor::default().coefficients().unwrap();
    let exact = region::exact_ends(RegionKind::Simple, &c).unwrap();
    let moved = |part: f64| Ends {
        upper: exact.upper + part * exact.width(),
        ..exact
    };
    for part in [-0.03, -1e-3, 1e-3, 0.1, 0.4] {
        let hill = confirm_ends(&c, moved(part)).unwrap();
        assert!(
            (hill.upper - exact.upper).abs() < 1e-8 * exact.width(),
            "{part}"
        );
    }
    let far = confirm_ends(&c, moved(-0.3)).unwrap_err();
    assert!(!far.is_contradiction(), "{far}");
    let elsewhere = Ends {
        lower: exact.lower + 2.0 * exact.width(),
        upper: exact.upper + 2.0 * exact.width(),
    };
    assert!(confirm_ends(&c, elsewhere).is_err());
}

#[test]
fn a_closed_region_is_told_apart_from_a_narrow_one() {
    let closed = Ends {
        lower: 0.7,
        upper: 0.7,
    };
    let c = coefficients(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 0.0));
    assert_eq!(confirm_ends(&c, closed), Err(NoBoundary::Closed));
    let c = coefficients(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 1e-5));
    let narrow = region::exact_ends(RegionKind::Simple, &c).unwrap();
    let why = confirm_ends(&c, narrow).unwrap_err();
    assert!(matches!(why, NoBoundary::TooNarrow { .. }), "{why}");
}

#[test]
fn an_end_that_is_not_near_is_none() {
    // From 2.48 upwards the motion grows at every speed.
    let c = coefficients(|p| p.disk_polar_inertia = 0.95 * p.disk_diametral_inertia);
    let kind = RegionKind::UpperSimple;
    let start = region::start(kind, &c).unwrap();
    let found = search(&c, start, region::width(kind, &c).unwrap());
    assert_eq!(found, Err(NoBoundary::Endless));
}
