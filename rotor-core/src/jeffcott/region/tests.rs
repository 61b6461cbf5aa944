use super::*;

/// Two moderately coupled motions, every excitation present.
const COUPLED: Coefficients = Coefficients {
    beta: 0.6,
    gamma: -0.5,
    delta: 1.6,
    epsilon_1: 0.04,
    epsilon_12: 0.05,
    epsilon_2: 0.06,
    disk_asymmetry: 0.2,
    crack_angle: 0.3,
};

#[test]
fn a_region_starts_where_its_whirl_frequencies_say() {
    for kind in [RegionKind::Simple, RegionKind::UpperSimple] {
        let speed = Region::of(kind, &COUPLED).unwrap().start();
        assert!(
            equations::f_n(speed, speed, &COUPLED).abs() < 1e-13,
            "{kind}"
        );
    }
    let speed = Region::of(RegionKind::Combination, &COUPLED)
        .unwrap()
        .start();
    let omega = equations::cir_omega::value(&COUPLED);
    for omega in [omega, 2.0 * speed - omega] {
        assert!(equations::f_n(omega, speed, &COUPLED).abs() < 1e-12);
    }
}

#[test]
fn regions_end_at_their_inertia_ratio() {
    for (kind, beta, limit) in [
        (RegionKind::UpperSimple, 1.0, 1.0),
        (RegionKind::Combination, 2.0, 2.0),
    ] {
        let c = Coefficients { beta, ..COUPLED };
        assert_eq!(
            Region::of(kind, &c).and_then(|region| region.width()),
            Err(RegionError::InertiaRatio { kind, beta, limit })
        );
        assert!(Region::of(RegionKind::Simple, &c).unwrap().width().unwrap() > 0.0);
        let below = Coefficients {
            beta: 0.99 * limit,
            ..COUPLED
        };
        assert!(Region::of(kind, &below).unwrap().width().unwrap() > 0.0);
    }
}

#[test]
fn a_shaft_that_gives_way_has_no_region() {
    let c = Coefficients {
        delta: 0.25,
        ..COUPLED
    };
    let reason = Region::of(RegionKind::Simple, &c)
        .map(|region| region.start())
        .unwrap_err();
    assert_eq!(
        reason,
        RegionError::MeanStiffnessNotPositive {
            delta: 0.25,
            gamma: -0.5,
            value: 0.0
        }
    );
    assert!(
        reason
            .to_string()
            .starts_with("delta - gamma² = 0 with delta = 0.25")
    );
}

#[test]
fn no_coefficient_may_be_nan() {
    let c = Coefficients {
        epsilon_2: f64::NAN,
        ..COUPLED
    };
    for kind in RegionKind::ALL {
        let Err(RegionError::NotFinite { quantity, .. }) =
            Region::of(kind, &c).and_then(|region| region.width())
        else {
            panic!("{kind} has a width")
        };
        assert_eq!(quantity, "epsilon_2");
    }
}

#[test]
fn growth_falls_from_its_peak_to_zero_at_half_the_width() {
    for kind in RegionKind::ALL {
        let half = 0.5 * Region::of(kind, &COUPLED).unwrap().width().unwrap();
        let at = |detuning| {
            Region::of(kind, &COUPLED)
                .unwrap()
                .growth_rate(detuning)
                .unwrap()
        };
        let peak = at(0.0);
        assert!(peak > 0.0);
        // Eq. (29) is half an ellipse over the detuning.
        assert!((at(0.6 * half) - 0.8 * peak).abs() < 1e-12 * peak, "{kind}");
        assert!(
            (at(-0.6 * half) - 0.8 * peak).abs() < 1e-12 * peak,
            "{kind}"
        );
        assert!(
            at(half * (1.0 - 1e-9)) > 0.0 && at(half * (1.0 + 1e-9)) == 0.0,
            "{kind}"
        );
    }
}

#[test]
fn uncoupled_motions_have_no_combination_region() {
    let c = Coefficients {
        gamma: 0.0,
        epsilon_12: 0.0,
        ..COUPLED
    };
    assert_eq!(
        Region::of(RegionKind::Combination, &c).and_then(|region| region.width()),
        Ok(0.0)
    );
    assert_eq!(
        Region::of(RegionKind::Combination, &c).and_then(|region| region.growth_rate(0.0)),
        Ok(0.0)
    );
    assert_eq!(
        Region::of(RegionKind::Combination, &c).and_then(|region| region.zup_asymmetry()),
        Err(RegionError::Uncoupled {
            kind: RegionKind::Combination
        })
    );
    for epsilon_1 in [0.0, 0.04] {
        let c = Coefficients { epsilon_1, ..c };
        let kind = RegionKind::Simple;
        let reason = Region::of(kind, &c)
            .and_then(|region| region.zup_asymmetry())
            .unwrap_err();
        assert_eq!(reason, RegionError::Uncoupled { kind });
    }
    // The uncoupled transverse motion is a shaft of two stiffnesses 1 ± epsilon_1.
    let ends = Region::of(RegionKind::Simple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
    assert!((ends.lower - 0.96_f64.sqrt()).abs() < 1e-14, "{ends:?}");
    assert!((ends.upper - 1.04_f64.sqrt()).abs() < 1e-14, "{ends:?}");
}

#[test]
fn the_closing_asymmetry_closes() {
    for kind in RegionKind::ALL {
        let disk_asymmetry = Region::of(kind, &COUPLED).unwrap().zup_asymmetry().unwrap();
        let combination = kind == RegionKind::Combination;
        let crack_angle = if combination {
            0.0
        } else {
            std::f64::consts::FRAC_PI_2
        };
        let closed = Coefficients {
            disk_asymmetry,
            crack_angle,
            ..COUPLED
        };
        let open = Coefficients {
            crack_angle: crack_angle + 0.1,
            ..closed
        };
        let (closed, open) = (
            Region::of(kind, &closed).unwrap().width().unwrap(),
            Region::of(kind, &open).unwrap().width().unwrap(),
        );
        assert!(closed <= 1e-12 * open, "{kind}: {closed} against {open}");
    }
}

#[test]
fn a_small_excitation_meets_the_exact_ends() {
    let small = Coefficients {
        epsilon_1: 0.000_4,
        epsilon_12: 0.000_5,
        epsilon_2: 0.000_6,
        disk_asymmetry: 0.002,
        ..COUPLED
    };
    for kind in RegionKind::ALL {
        let (start, width) = (
            Region::of(kind, &small).unwrap().start(),
            Region::of(kind, &small).unwrap().width().unwrap(),
        );
        let ends = Region::of(kind, &small).unwrap().exact_ends().unwrap();
        assert!((ends.width() - width).abs() < 1e-3 * width, "{kind}");
        assert!(ends.lower < start && start < ends.upper, "{kind}");
    }
}

#[test]
fn a_region_nested_in_an_open_one_keeps_its_ends() {
    // Nearly uncoupled: the transverse region between sqrt(0.8) and sqrt(1.2), and a disk whose
    // asymmetry makes the tilting motion unstable from sqrt(delta/Delta) = 0.5 upwards.
    let c = Coefficients {
        beta: 1.0,
        gamma: 1e-3,
        delta: 0.05,
        epsilon_1: 0.2,
        epsilon_12: 0.0,
        epsilon_2: 0.0,
        disk_asymmetry: 0.2,
        crack_angle: 0.0,
    };
    let ends = Region::of(RegionKind::Simple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
    assert!((ends.lower - 0.8_f64.sqrt()).abs() < 1e-4, "{ends:?}");
    assert!((ends.upper - 1.2_f64.sqrt()).abs() < 1e-4, "{ends:?}");
}

#[test]
fn a_gradient_belongs_to_its_width() {
    // A prolate disk: it has all three regions.
    let prolate = Rotor::default().with(|p| p.disk_polar_inertia *= 0.5);
    for (rotor, kind) in [
        (Rotor::default(), RegionKind::Simple),
        (Rotor::default(), RegionKind::Combination),
        (prolate.unwrap(), RegionKind::UpperSimple),
    ] {
        let c = rotor.coefficients().unwrap();
        let (value, partials) = rotor.width_gradient(kind).unwrap();
        assert!((value / Region::of(kind, &c).unwrap().width().unwrap() - 1.0).abs() < 1e-13);
        for (input, partial) in INPUTS.iter().zip(partials) {
            let at = |factor: f64| {
                let mut parameters = *rotor.parameters();
                (input.set)(&mut parameters, (input.get)(rotor.parameters()) * factor);
                let c = Rotor::new(parameters).unwrap().coefficients().unwrap();
                Region::of(kind, &c).unwrap().width().unwrap()
            };
            let scaled = partial * (input.get)(rotor.parameters());
            // The central difference of the fourth order.
            let apart = |step: f64| at(1.0 + step) - at(1.0 - step);
            let expected = (8.0 * apart(1e-4) - apart(2e-4)) / 12e-4;
            assert!((scaled - expected).abs() < 1e-8, "{kind} by {}", input.name);
        }
    }
    let rotor = Rotor::default();
    let uncracked = rotor.with(|p| p.crack_depth_ratio = 0.0).unwrap();
    let shallow = rotor.with(|p| p.crack_depth_ratio = 1e-7).unwrap();
    for kind in [RegionKind::Simple, RegionKind::Combination] {
        let (value, partials) = uncracked.width_gradient(kind).unwrap();
        let (near, nearby) = shallow.width_gradient(kind).unwrap();
        assert!((value - near).abs() < 1e-12 * value);
        for ((input, partial), nearby) in INPUTS.iter().zip(partials).zip(nearby) {
            let size = value / (input.get)(shallow.parameters()).abs().max(1e-3);
            assert!(
                (partial - nearby).abs() < 1e-8 * size,
                "{kind} by {}: {partial:e} {nearby:e}",
                input.name
            );
        }
        assert_eq!(partials[9], 0.0);
    }
    let round = rotor.with(|p| (p.disk_asymmetry, p.crack_depth_ratio) = (0.0, 0.0));
    let reason = round
        .unwrap()
        .width_gradient(RegionKind::Simple)
        .unwrap_err();
    assert!(
        matches!(reason, Error::Region(RegionError::Corner { .. })),
        "{reason}"
    );
    let reason = rotor.width_gradient(RegionKind::UpperSimple).unwrap_err();
    assert!(
        matches!(reason, Error::Region(RegionError::InertiaRatio { .. })),
        "{reason}"
    );
}

#[test]
fn the_exact_ends_do_not_need_a_width() {
    // Displacement and tilt are uncoupled and have their regions at the same speed.
    let c = Coefficients {
        gamma: 0.0,
        delta: 0.4,
        epsilon_1: 0.05,
        epsilon_12: 0.0,
        epsilon_2: 0.05,
        disk_asymmetry: 0.1,
        ..COUPLED
    };
    assert!(
        Region::of(RegionKind::Simple, &c)
            .and_then(|region| region.width())
            .is_err()
    );
    let simple = Region::of(RegionKind::Simple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
    let upper = Region::of(RegionKind::UpperSimple, &c)
        .unwrap()
        .exact_ends()
        .unwrap();
    let mut all = vec![simple.lower, simple.upper, upper.lower, upper.upper];
    all.sort_by(f64::total_cmp);
    assert_eq!(all, exact::simple_region_ends(&c).unwrap());
    let displacement = [0.95_f64.sqrt(), 1.05_f64.sqrt()];
    for end in displacement {
        assert!(
            all.iter().any(|found| (found - end).abs() < 1e-14),
            "{all:?}"
        );
    }
}

#[test]
fn a_start_keeps_its_digits_where_whirl_frequencies_come_close() {
    let c = Coefficients {
        beta: 0.6,
        gamma: 1e-6,
        delta: 0.4,
        ..COUPLED
    };
    // In 50 digits, from the doubles above.
    let expected = 0.999_999_209_430_272_5;
    let found = Region::of(RegionKind::Simple, &c).unwrap().start();
    assert!((found / expected - 1.0).abs() < 1e-15, "{found}");
}
