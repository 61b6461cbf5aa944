//! Ends of the rotor's regions from growth rates by Hill's method, held to the exact ones.
#![allow(
    clippy::unwrap_used,
    reason = "a helper of a test fails as a test does"
)]

use rotor_core::equations::Coefficients;
use rotor_core::error::{BoundaryError, Error};
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::exact::Ends;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::{Model, confirm_ends};
use rotor_core::periodic::boundary::{self, Boundary};

fn search(c: &Coefficients, start: f64, width: f64) -> Result<Boundary, Error> {
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
            let exact = Region::of(kind, &c).unwrap().exact_ends().unwrap();
            let (start, width) = (
                Region::of(kind, &c).map(|region| region.start()),
                Region::of(kind, &c).and_then(|region| region.width()),
            );
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
    let exact = Region::of(RegionKind::Simple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
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
    assert!(!boundary::is_contradiction(&far), "{far}");
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
    assert_eq!(confirm_ends(&c, closed), Err(BoundaryError::Closed.into()));
    let c = coefficients(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 1e-5));
    let narrow = Region::of(RegionKind::Simple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
    let why = confirm_ends(&c, narrow).unwrap_err();
    assert!(
        matches!(why, Error::Boundary(BoundaryError::TooNarrow { .. })),
        "{why}"
    );
}

#[test]
fn an_end_that_is_not_near_is_none() {
    // From 2.48 upwards the motion grows at every speed.
    let c = coefficients(|p| p.disk_polar_inertia = 0.95 * p.disk_diametral_inertia);
    let kind = RegionKind::UpperSimple;
    let start = Region::of(kind, &c).unwrap().start();
    let found = search(&c, start, Region::of(kind, &c).unwrap().width().unwrap());
    assert_eq!(found, Err(BoundaryError::Endless.into()));
}
