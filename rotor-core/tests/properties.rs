//! What holds for every rotor: symmetries, units, and that a zero unstable point closes its region.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;
use rotor_core::quantity::{Quantity, evaluate};
use rotor_core::region::{self, RegionKind};
use rotor_core::rotor::{CrackEdge, CrackModel, Rotor, RotorParameters};
use rotor_core::zero_unstable_point::{ZeroUnstablePoint, zup_angle, zup_depth, zup_position};

const SIMPLE_AND_COMBINATION: [RegionKind; 2] = [RegionKind::Simple, RegionKind::Combination];

prop_compose! {
    fn disk()(
        mass in 0.5..50.0,
        diametral_inertia in 0.01..3.0,
        beta in 0.2..1.95,
        asymmetry in 0.01..0.4,
        position_ratio in 0.1..0.9,
    ) -> RotorParameters {
        RotorParameters {
            disk_mass: mass,
            disk_diametral_inertia: diametral_inertia,
            disk_polar_inertia: beta * diametral_inertia,
            disk_asymmetry: asymmetry,
            disk_position_ratio: position_ratio,
            ..RotorParameters::PAPER
        }
    }
}

prop_compose! {
    fn rotor()(
        disk in disk(),
        length in 0.3..2.0,
        radius in 0.008..0.05,
        modulus in 5e10..2.5e11,
        depth in 0.02..0.9,
        position in 0.1..0.9,
        angle in -3.0..3.0,
        model in prop::sample::select(CrackModel::ALL.to_vec()),
        edge in prop::sample::select(CrackEdge::ALL.to_vec()),
    ) -> Rotor {
        Rotor::new(RotorParameters {
            shaft_length: length,
            shaft_radius: radius,
            shaft_youngs_modulus: modulus,
            crack_depth_ratio: depth,
            crack_position_ratio: position,
            crack_angle: angle,
            crack_model: model,
            crack_edge: edge,
            ..disk
        }).expect("inside every allowed range")
    }
}

fn width(rotor: &Rotor, kind: RegionKind) -> f64 {
    let c = rotor
        .coefficients()
        .expect("a common rotor has coefficients");
    region::width(kind, &c).expect("both regions exist below beta = 2")
}

fn with_angle(rotor: &Rotor, angle: f64) -> Rotor {
    rotor
        .with(|p| p.crack_angle = angle)
        .expect("every angle is allowed")
}

/// In the units of mass, length and time that are this many kg, m and s.
fn in_units(rotor: &Rotor, mass: f64, length: f64, time: f64) -> Rotor {
    rotor
        .with(|p| {
            p.disk_mass *= mass;
            p.disk_diametral_inertia *= mass * length * length;
            p.disk_polar_inertia *= mass * length * length;
            p.shaft_length *= length;
            p.shaft_radius *= length;
            p.shaft_youngs_modulus *= mass / (length * time * time);
        })
        .expect("every positive number is allowed")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn half_a_turn_of_the_crack_changes_nothing(rotor in rotor()) {
        let angle = rotor.parameters().crack_angle;
        for kind in SIMPLE_AND_COMBINATION {
            let widest = width(&rotor, kind).max(width(&with_angle(&rotor, angle + FRAC_PI_2), kind));
            let turned = width(&with_angle(&rotor, angle + PI), kind);
            prop_assert!((turned - width(&rotor, kind)).abs() <= 1e-13 * widest);
        }
    }

    #[test]
    fn the_other_axis_of_the_disk_is_a_quarter_of_a_turn(rotor in rotor()) {
        let quarter = with_angle(&rotor, rotor.parameters().crack_angle + FRAC_PI_2);
        let other = rotor.with(|p| p.disk_asymmetry = -p.disk_asymmetry).expect("valid");
        for kind in SIMPLE_AND_COMBINATION {
            let widest = width(&rotor, kind).max(width(&quarter, kind));
            prop_assert!((width(&other, kind) - width(&quarter, kind)).abs() <= 1e-13 * widest);
        }
    }

    #[test]
    fn units_do_not_matter(rotor in rotor(), mass in 1e-3..1e3, length in 1e-3..1e3, time in 1e-3..1e3) {
        let quantities: Vec<_> = Quantity::ALL
            .into_iter()
            .filter(|quantity| (Quantity::Beta as usize..=Quantity::CirStart as usize).contains(&(*quantity as usize)))
            .collect();
        let other = in_units(&rotor, mass, length, time);
        for ((quantity, a), b) in
            quantities.iter().zip(evaluate(&quantities, &rotor)).zip(evaluate(&quantities, &other))
        {
            let (a, b) = (a.expect("common"), b.expect("common"));
            prop_assert!((a - b).abs() <= 1e-12 * a.abs(), "{quantity}: {a} {b}");
        }
    }

    #[test]
    fn the_narrowest_angle_is_narrowest(rotor in rotor()) {
        let c = rotor.coefficients().expect("common");
        for kind in SIMPLE_AND_COMBINATION {
            let narrowest = width(&with_angle(&rotor, zup_angle(kind, &c).expect("exists")), kind);
            prop_assert!(narrowest <= width(&rotor, kind) * (1.0 + 1e-12));
        }
    }
}

/// At a zero unstable point the region is closed, and a quarter of a turn away it is not.
fn closes(
    rotor: &Rotor,
    kind: RegionKind,
    point: ZeroUnstablePoint,
    set: impl Fn(&mut RotorParameters, f64),
) -> Result<(), TestCaseError> {
    let at = |angle: f64| {
        let rotor = rotor.with(|p| {
            set(p, point.value);
            p.crack_angle = angle;
        });
        width(&rotor.expect("a root is an allowed value"), kind)
    };
    let (closed, open) = (at(point.crack_angle), at(point.crack_angle + FRAC_PI_2));
    prop_assert!(
        closed <= 1e-9 * open,
        "{kind} at {point:?}: {closed} against {open}"
    );
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn the_region_closes_at_every_depth_found(rotor in rotor()) {
        for kind in SIMPLE_AND_COMBINATION {
            let points = zup_depth(&rotor, kind).expect("both regions exist");
            for &point in &points {
                closes(&rotor, kind, point, |p, depth| p.crack_depth_ratio = depth)?;
            }
            // It grows from 0 without a crack, so where the deepest crack takes more asymmetry than the
            // disk has, there is one in between, unless a pole is.
            let deepest = rotor.with(|p| p.crack_depth_ratio = 1.0).expect("valid");
            let closing = region::zup_asymmetry(kind, &deepest.coefficients().expect("common"));
            if kind == RegionKind::Simple
                && closing.is_ok_and(|closing| closing.abs() > rotor.parameters().disk_asymmetry)
            {
                prop_assert!(!points.is_empty());
            }
        }
    }

    #[test]
    fn the_region_closes_at_every_position_found(rotor in rotor()) {
        for kind in SIMPLE_AND_COMBINATION {
            for point in zup_position(&rotor, kind).expect("both regions exist") {
                closes(&rotor, kind, point, |p, position| p.crack_position_ratio = position)?;
            }
        }
    }
}
