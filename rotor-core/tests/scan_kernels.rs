//! Scans along every input against the quantities computed point by point.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::input::Variable;
use rotor_core::input::{CrackModel, INPUTS, NumericInput, RotorParameters};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study;
use rotor_core::study::{Axis, Distribution, Plan, Sampling, Scan};

const WIDTHS: [Quantity; 2] = [Quantity::SirWidth, Quantity::CirWidth];
const ANGLES: [f64; 2] = [0.4, 1.1];

/// The results of a plan, point by point.
fn scanned(plan: &Plan, quantities: usize) -> Vec<Vec<Option<f64>>> {
    let mut all = vec![Vec::new(); quantities];
    for chunk in plan.chunks() {
        for (number, all) in all.iter_mut().enumerate() {
            all.extend(chunk.quantity(number).iter());
        }
    }
    all
}

/// Compares a scan over two crack angles and along an input with the quantities at its points.
fn assert_as_by_points(base: RotorParameters, input: &'static NumericInput, ends: (f64, f64)) {
    const COUNT: u64 = 83;
    let rotor = Rotor::new(base).unwrap();
    let name = format!("{} {}", base.crack_model, input.name);
    for quantities in [
        &WIDTHS[..],
        &WIDTHS[..1],
        &WIDTHS[1..],
        &[Quantity::Gamma, Quantity::CirWidth],
    ] {
        let axis = Axis::linear(input, ends, COUNT).unwrap();
        let angle = NumericInput::find("crack_angle").unwrap();
        let mut scan = Scan::of(&rotor);
        if input.name != "crack_angle" {
            scan = scan.vary(Axis::listed(angle, ANGLES.to_vec()).unwrap());
        }
        let scan = quantities
            .iter()
            .fold(scan.vary(axis.clone()), |scan, q| scan.quantity(*q));
        let found = scanned(&scan.plan().unwrap(), quantities.len());
        for row in 0..found[0].len() / COUNT as usize {
            let mut widest = vec![0.0_f64; quantities.len()];
            let mut errors = vec![0.0_f64; quantities.len()];
            for point in 0..COUNT {
                let mut p = base;
                p.crack_angle = ANGLES[row];
                (input.set)(&mut p, axis.value(0, point));
                let expected = Rotor::new(p).map(|rotor| study::evaluate(quantities, &rotor));
                for number in 0..quantities.len() {
                    let found = found[number][row * COUNT as usize + point as usize];
                    let expected = expected
                        .as_ref()
                        .ok()
                        .and_then(|all| all[number].clone().ok());
                    assert_eq!(
                        found.is_some(),
                        expected.is_some(),
                        "{name} {point} {expected:?}"
                    );
                    if let (Some(found), Some(expected)) = (found, expected) {
                        widest[number] = widest[number].max(expected.abs());
                        errors[number] = errors[number].max((found - expected).abs());
                    }
                }
            }
            for (error, widest) in errors.iter().zip(&widest) {
                assert!(*error <= 1e-12 * widest, "{name}: {error:e} of {widest:e}");
            }
        }
    }
}

#[test]
fn along_every_input_it_is_as_by_points() {
    for crack_model in [
        CrackModel::SupportArm,
        CrackModel::MidspanArm,
        CrackModel::SimplySupported,
    ] {
        // The crack is on one side of the disk, and with the positions varied on both.
        let base = RotorParameters {
            crack_model,
            crack_position_ratio: 0.4,
            ..RotorParameters::PAPER
        };
        for input in &INPUTS {
            let value = (input.get)(&base);
            let ends = match input.name {
                "crack_depth_ratio" => (0.0, 1.0),
                "crack_angle" => (-1.0, 7.0),
                "disk_asymmetry" => (-0.95, 0.95),
                "shaft_poissons_ratio" => (-0.5, 0.5),
                "disk_position_ratio" | "crack_position_ratio" => (0.05, 0.95),
                // Over beta = 1 and 2, where the regions change.
                "disk_polar_inertia" => (0.5 * value, 1.5 * value),
                _ => (0.6 * value, 1.7 * value),
            };
            assert_as_by_points(base, input, ends);
        }
    }
}

#[test]
fn inputs_that_vary_together_are_as_by_points() {
    let input = |name| NumericInput::find(name).unwrap();
    let axes = [
        Axis::linear(input("shaft_length"), (0.3, 0.9), 50).unwrap(),
        Axis::linear(input("disk_mass"), (5.0, 20.0), 50).unwrap(),
        Axis::linear(input("crack_position_ratio"), (0.1, 0.9), 50).unwrap(),
    ];
    let base = RotorParameters {
        crack_model: CrackModel::SimplySupported,
        ..RotorParameters::PAPER
    };
    let scan = Scan::of(&Rotor::new(base).unwrap()).vary(Axis::linked(axes.to_vec()).unwrap());
    let plan = scan
        .quantity(Quantity::SirWidth)
        .quantity(Quantity::CirWidth)
        .plan()
        .unwrap();
    let found = scanned(&plan, 2);
    for point in 0..50 {
        let mut p = base;
        for axis in &axes {
            let Some(Variable::Input(varied)) = axis.variables().next() else {
                panic!("an axis of an input");
            };
            (varied.set)(&mut p, axis.value(0, point));
        }
        let expected = study::evaluate(&WIDTHS, &Rotor::new(p).unwrap());
        for (found, expected) in found.iter().zip(expected) {
            let ratio = found[point as usize].unwrap() / expected.unwrap();
            assert!((ratio - 1.0).abs() < 1e-12, "{point}: {ratio}");
        }
    }
}

#[test]
fn inputs_beyond_any_machine_are_computed_or_refused_as_by_points() {
    let input = |name| NumericInput::find(name).unwrap();
    let extremes = vec![1e-300, 1e-60, 1e-12, 0.01, 1e14, 1e60, 1e300];
    for name in [
        "shaft_radius",
        "shaft_length",
        "disk_mass",
        "shaft_youngs_modulus",
    ] {
        let axis = Axis::listed(input(name), extremes.clone()).unwrap();
        let plan = Scan::of(&Rotor::default())
            .vary(axis)
            .quantity(Quantity::SirWidth);
        let found = scanned(&plan.plan().unwrap(), 1);
        for (value, found) in extremes.iter().zip(&found[0]) {
            let rotor = Rotor::default()
                .with(|p| (input(name).set)(p, *value))
                .unwrap();
            let expected = Quantity::SirWidth.evaluate(&rotor).ok();
            match (found, expected) {
                (Some(found), Some(expected)) => {
                    assert!((found / expected - 1.0).abs() < 1e-12, "{name} {value}");
                }
                (found, expected) => assert_eq!(*found, expected, "{name} {value}"),
            }
        }
    }
}

#[test]
fn what_is_drawn_beyond_what_an_input_allows_is_no_rotor() {
    let asymmetry = NumericInput::find("disk_asymmetry").unwrap();
    let wide = Distribution::Uniform {
        low: -2.0,
        high: 2.0,
    };
    let axis = Axis::sampled(&[(asymmetry, wide)], 1000, Sampling::Sobol { seed: 3 }).unwrap();
    let beyond = (0..1000).filter(|index| axis.value(0, *index).abs() >= 1.0);
    let beyond = beyond.count() as u64;
    assert!(beyond > 400);
    for quantities in [&WIDTHS[..], &[Quantity::SirStart], &[Quantity::C11]] {
        let scan = Scan::of(&Rotor::default()).vary(axis.clone());
        let scan = quantities.iter().fold(scan, |scan, q| scan.quantity(*q));
        let plan = scan.plan().unwrap();
        let chunk = plan.chunks().next().unwrap();
        assert_eq!(chunk.counts().no_rotor, beyond, "{quantities:?}");
        assert_eq!(chunk.quantity(0).missing(), beyond);
    }
}
