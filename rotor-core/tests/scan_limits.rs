//! Scans through rotors at and beyond the limits of the packs' formulas: each point has what that rotor has alone.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::input::{CrackModel, INPUTS, NumericInput, RotorParameters, Variable};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::{Measure, Quantity, Subject};
use rotor_core::study::{Axis, Control, Reduction, Scan, Statistic, evaluate_at};

const SPEED: f64 = 0.9;

/// More than formulas for an axis differ from those for one rotor.
const RELATIVE: f64 = 1e-9;

/// Factors that take every input out of what machines have, and products of inputs out of what a double has.
const FACTORS: [f64; 10] = [
    1e-300, 1e-200, 1e-120, 1e-60, 1e-30, 1e30, 1e60, 1e120, 1e200, 1e300,
];

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

/// Compares a quantity along an axis through these rotors with that of each of them alone, point by point and reduced.
fn assert_as_alone(
    base: &Rotor,
    varied: &'static NumericInput,
    values: &[f64],
    quantity: Quantity,
) {
    let alone = values.iter().map(|value| {
        let rotor = base.with(|p| (varied.set)(p, *value)).ok()?;
        evaluate_at(&[quantity], &rotor, Some(SPEED)).remove(0).ok()
    });
    let alone: Vec<Option<f64>> = alone.collect();
    let scan = Scan::of(base)
        .vary(Axis::listed(Variable::Speed, vec![SPEED]).unwrap())
        .vary(Axis::listed(varied, values.to_vec()).unwrap())
        .quantity(quantity);
    let chunks = scan.clone().plan().unwrap();
    let found: Vec<_> = chunks
        .chunks()
        .flat_map(|chunk| chunk.quantity(0).iter().collect::<Vec<_>>())
        .collect();
    let name = || {
        format!(
            "{quantity} along {} from {:?}",
            varied.name,
            base.parameters()
        )
    };
    for (found, alone) in found.iter().zip(&alone) {
        assert_near(*found, *alone, quantity, &name);
    }
    let over = |statistic| Reduction::new(statistic).over(varied);
    let plan = scan
        .reduce(over(Statistic::Maximum))
        .reduce(over(Statistic::Minimum))
        .plan();
    let report = plan.unwrap().reduce(&Control::default()).unwrap();
    let missing = alone.iter().filter(|value| value.is_none()).count() as u64;
    assert_eq!(report.counts.missing, [missing], "{}", name());
    for (reduced, better) in report.reduced.iter().zip([f64::max, f64::min]) {
        let extreme = alone.iter().copied().flatten().reduce(better);
        assert_near(reduced.value(0, 0), extreme, quantity, &name);
    }
}

fn assert_near(
    found: Option<f64>,
    alone: Option<f64>,
    quantity: Quantity,
    name: &dyn Fn() -> String,
) {
    assert_eq!(
        found.is_some(),
        alone.is_some(),
        "{}: {found:?} {alone:?}",
        name()
    );
    // The closing asymmetry of a rotor that the crack hardly excites is rounding.
    let is_rounded = matches!(
        quantity.subject(),
        Subject::Region(_, Measure::ZupAsymmetry)
    );
    if let (Some(found), Some(alone), false) = (found, alone, is_rounded) {
        let near = (found - alone).abs() <= RELATIVE * alone.abs();
        assert!(near, "{}: {found:e} {alone:e}", name());
    }
}

/// A rotor with all three regions.
fn base(crack_model: CrackModel) -> Rotor {
    let parameters = RotorParameters {
        crack_model,
        disk_polar_inertia: 0.105,
        crack_position_ratio: 0.4,
        crack_angle: 0.3,
        ..RotorParameters::PAPER
    };
    Rotor::new(parameters).unwrap()
}

/// Distances from 1 at which a place is nearer to the right support than any machine has it.
const DISTANCES: [f64; 3] = [1e-6, 1e-11, f64::EPSILON];

/// The values of an input that it allows, of an ordinary one times the factors and close to 1.
fn extremes(rotor: &Rotor, input: &NumericInput) -> Vec<f64> {
    let value = (input.get)(rotor.parameters());
    let values = FACTORS.map(|factor| value * factor);
    let close = DISTANCES.map(|distance| 1.0 - distance);
    let close = close.into_iter().filter(|_| input.unit.is_empty());
    let allowed = values
        .into_iter()
        .chain(close)
        .filter(|value| input.allowed.contains(*value));
    allowed.collect()
}

#[test]
fn along_an_input_beyond_any_machine() {
    for crack_model in [CrackModel::SupportArm, CrackModel::SimplySupported] {
        let rotor = base(crack_model);
        for varied in &INPUTS {
            let mut values = extremes(&rotor, varied);
            values.push((varied.get)(rotor.parameters()));
            for quantity in Quantity::ALL {
                assert_as_alone(&rotor, varied, &values, quantity);
            }
        }
    }
}

#[test]
fn in_rows_with_an_input_beyond_any_machine() {
    let depths = [0.0, 1e-6, 0.2, 0.7];
    let rotor = base(CrackModel::SimplySupported);
    for extreme in &INPUTS {
        for value in extremes(&rotor, extreme) {
            let change = |p: &mut RotorParameters| {
                let beta = p.inertia_ratio();
                (extreme.set)(p, value);
                // Of both inertias: their ratio has its own limit.
                if extreme.name == "disk_diametral_inertia" {
                    p.disk_polar_inertia = beta * value;
                }
            };
            let Ok(rotor) = rotor.with(change) else {
                continue;
            };
            for quantity in Quantity::ALL {
                assert_as_alone(&rotor, input("crack_depth_ratio"), &depths, quantity);
            }
        }
    }
}

#[test]
fn where_nothing_couples_displacement_and_tilt() {
    // At midspan without a crack: the variation of the coupling is relative to nothing.
    for crack_model in [CrackModel::SupportArm, CrackModel::SimplySupported] {
        let midspan =
            base(crack_model).with(|p| (p.disk_position_ratio, p.crack_depth_ratio) = (0.5, 0.0));
        let midspan = midspan.unwrap();
        for (name, values) in [
            ("disk_position_ratio", [0.4, 0.5, 0.6]),
            ("crack_depth_ratio", [0.2, 0.0, 0.1]),
            ("disk_mass", [9.0, 10.0, 11.0]),
        ] {
            for quantity in Quantity::ALL {
                assert_as_alone(&midspan, input(name), &values, quantity);
            }
        }
    }
}

#[test]
fn where_a_place_close_to_a_support_meets_a_stiff_short_shaft() {
    // Each is nearly what machines have; together the shaft's flexibility is too small to be computed with.
    let stiff = base(CrackModel::SupportArm).with(|p| {
        p.shaft_length = 1.1e-4;
        (p.shaft_radius, p.shaft_youngs_modulus) = (0.9e12, 0.9e12);
        // A crack would be more flexible than all of such a shaft.
        p.crack_depth_ratio = 0.0;
    });
    let stiff = stiff.unwrap();
    for name in ["disk_position_ratio", "crack_position_ratio"] {
        let values = [1e-12, 1e-9, 0.2, 0.5, 1.0 - 1e-9, 1.0 - 1e-12];
        for quantity in Quantity::ALL {
            assert_as_alone(&stiff, input(name), &values, quantity);
        }
    }
}
