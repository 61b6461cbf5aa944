use super::*;
use crate::input::CrackModel;

fn paper(change: impl FnOnce(&mut RotorParameters)) -> Rotor {
    Rotor::default().with(change).unwrap()
}

#[test]
fn the_sign_of_the_asymmetry_turns_the_closing_angle() {
    for (asymmetry, simple, combination) in [(0.2, FRAC_PI_2, 0.0), (-0.2, 0.0, FRAC_PI_2)] {
        let rotor = paper(|p| p.disk_asymmetry = asymmetry);
        let c = rotor.coefficients().unwrap();
        for (kind, angle) in [
            (RegionKind::Simple, simple),
            (RegionKind::Combination, combination),
        ] {
            assert_eq!(zup_angle(kind, &c), Ok(angle));
            let [point] = zup_depth(&rotor, kind).unwrap()[..] else {
                panic!("one point")
            };
            assert_eq!(point.crack_angle, angle);
        }
    }
}

#[test]
fn the_depth_does_not_depend_on_the_rotors_own_crack() {
    let kind = RegionKind::Simple;
    let other = paper(|p| (p.crack_depth_ratio, p.crack_angle) = (0.7, 1.0));
    assert_eq!(zup_depth(&other, kind), zup_depth(&Rotor::default(), kind));
}

#[test]
fn none_in_range_is_an_answer() {
    // A crack next to the support bends too little to balance the disk, however deep it is.
    let rotor = paper(|p| {
        p.crack_model = CrackModel::SimplySupported;
        p.crack_position_ratio = 0.01;
    });
    for kind in [RegionKind::Simple, RegionKind::Combination] {
        assert_eq!(zup_depth(&rotor, kind), Ok(vec![]));
    }
}

#[test]
fn the_printed_lever_arm_has_none_of_the_papers_points() {
    let rotor = paper(|p| p.crack_model = CrackModel::MidspanArm);
    for (kind, angle) in [
        (RegionKind::Simple, FRAC_PI_2),
        (RegionKind::Combination, 0.0),
    ] {
        for point in zup_depth(&rotor, kind).unwrap() {
            assert!(
                point.crack_angle != angle || point.value > 0.5,
                "{kind}: {point:?}"
            );
        }
    }
}

#[test]
fn a_region_that_exists_nowhere_is_an_error() {
    let rotor = paper(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia);
    let kind = RegionKind::Combination;
    let reason = RegionError::InertiaRatio {
        kind,
        beta: 2.0,
        limit: 2.0,
    };
    let error = Err(Error::Region(reason));
    assert_eq!(zup_depth(&rotor, kind), error);
    assert_eq!(zup_position(&rotor, kind), error);
}

#[test]
fn a_symmetric_disk_is_not_closed_by_no_crack() {
    let rotor = paper(|p| p.disk_asymmetry = 0.0);
    assert_eq!(zup_depth(&rotor, RegionKind::Simple), Ok(vec![]));
}

#[test]
fn without_crack_and_asymmetry_it_is_closed_everywhere() {
    let rotor = paper(|p| (p.disk_asymmetry, p.crack_depth_ratio) = (0.0, 0.0));
    for kind in [RegionKind::Simple, RegionKind::Combination] {
        let closed = Err(Error::Region(RegionError::ClosedEverywhere { kind }));
        assert_eq!(zup_position(&rotor, kind), closed);
        assert_eq!(zup_crack_angle(&rotor, kind), closed);
    }
    let cracked = paper(|p| p.disk_asymmetry = 0.0);
    assert_eq!(zup_position(&cracked, RegionKind::Simple), Ok(vec![]));
}

#[test]
fn an_angle_closes_only_a_balanced_region() {
    for asymmetry in [0.2, -0.2, 0.03] {
        for kind in [RegionKind::Simple, RegionKind::Combination] {
            let rotor = paper(|p| p.disk_asymmetry = asymmetry);
            assert_eq!(zup_crack_angle(&rotor, kind), Ok(vec![]));
            let [depth] = zup_depth(&rotor, kind).unwrap()[..] else {
                panic!("one depth")
            };
            let at = |depth: f64| rotor.with(|p| p.crack_depth_ratio = depth).unwrap();
            let angle = depth.crack_angle;
            let expected = ZeroUnstablePoint {
                value: angle,
                crack_angle: angle,
            };
            assert_eq!(zup_crack_angle(&at(depth.value), kind), Ok(vec![expected]));
            assert_eq!(
                zup_crack_angle(&at(depth.value * (1.0 + 1e-11)), kind),
                Ok(vec![])
            );
        }
    }
}

#[test]
fn the_quarter_is_right_for_a_weak_coupling() {
    let c = Coefficients {
        beta: 1.998_670_944_384_197_7,
        gamma: 8.941_485_234_378_048e-6,
        delta: 0.084_423_679_518_234_29,
        epsilon_1: 0.140_583_763_107_910_32,
        epsilon_12: 0.141_283_001_539_582_95,
        epsilon_2: -0.315_866_536_880_657_9,
        disk_asymmetry: 0.159_540_986_298_811_42,
        crack_angle: 0.0,
    };
    for kind in [RegionKind::Simple, RegionKind::Combination] {
        let width = |crack_angle: f64| {
            Region::of(kind, &Coefficients { crack_angle, ..c })
                .unwrap()
                .width()
                .unwrap()
        };
        let angle = zup_angle(kind, &c).unwrap();
        assert!(
            width(angle) <= width(FRAC_PI_2 - angle),
            "{kind} at {angle}"
        );
    }
}

#[test]
fn a_pole_of_the_closing_asymmetry_is_no_root() {
    // With the disk near midspan a deep crack turns the coupling's sign as it moves.
    let rotor = paper(|p| {
        p.crack_model = CrackModel::MidspanArm;
        p.disk_position_ratio = 0.49;
        p.crack_depth_ratio = 0.6;
    });
    let gamma = |position: f64| {
        let rotor = rotor.with(|p| p.crack_position_ratio = position).unwrap();
        rotor.coefficients().unwrap().gamma
    };
    let positions: Vec<f64> = (1..100).map(|i| f64::from(i) / 100.0).collect();
    let poles: Vec<f64> = positions
        .windows(2)
        .filter(|pair| gamma(pair[0]) * gamma(pair[1]) < 0.0)
        .map(|pair| pair[0])
        .collect();
    assert!(!poles.is_empty(), "the test needs a rotor with a pole");
    for point in zup_position(&rotor, RegionKind::Combination).unwrap() {
        let rotor = rotor
            .with(|p| p.crack_position_ratio = point.value)
            .unwrap();
        let closing = Region::of(RegionKind::Combination, &rotor.coefficients().unwrap())
            .and_then(|region| region.zup_asymmetry());
        assert!((closing.unwrap().abs() - 0.2).abs() < 1e-9, "{point:?}");
    }
}

#[test]
fn no_root_at_the_jump_where_the_crack_passes_the_disk() {
    // It has all three regions.
    let rotor = paper(|p| {
        p.crack_model = CrackModel::SimplySupported;
        p.disk_polar_inertia = 0.105;
    });
    let disk = rotor.parameters().disk_position_ratio;
    for kind in RegionKind::ALL {
        let closing = |position: f64| {
            let moved = rotor.with(|p| p.crack_position_ratio = position).unwrap();
            moved.region(kind).unwrap().zup_asymmetry().unwrap()
        };
        // Between the closing asymmetries on both sides of the disk: the crack passes it, and nowhere has it.
        let skipped = 0.5 * (closing(disk.next_down()) + closing(disk));
        let rotor = rotor.with(|p| p.disk_asymmetry = skipped).unwrap();
        for point in zup_position(&rotor, kind).unwrap() {
            assert!((point.value - disk).abs() > 1e-9, "{kind}: {point:?}");
        }
    }
}
