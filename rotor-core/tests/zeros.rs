//! No result is the negative zero, which tables would show as "-0".
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::input::{CrackModel, NumericInput, RotorParameters, Variable};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{Axis, Control, Reduction, Scan, Statistic, evaluate_at};

const SPEED: f64 = 0.9;

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

/// Rotors whose coupling or crack is zero, some with inputs that no machine has: these are computed alone in a scan too.
fn rotors() -> Vec<RotorParameters> {
    let mut rotors = Vec::new();
    for crack_model in [CrackModel::SupportArm, CrackModel::SimplySupported] {
        for disk_position_ratio in [0.5, 0.75] {
            for (crack_depth_ratio, crack_position_ratio) in [(0.0, 0.25), (0.0, 0.5), (0.2, 0.5)] {
                for disk_mass in [10.0, 1e-20] {
                    rotors.push(RotorParameters {
                        disk_mass,
                        disk_polar_inertia: 0.105,
                        disk_position_ratio,
                        crack_depth_ratio,
                        crack_position_ratio,
                        crack_model,
                        ..RotorParameters::PAPER
                    });
                }
            }
        }
    }
    rotors
}

fn assert_no_negative_zero(numbers: impl IntoIterator<Item = Option<f64>>, name: &str) -> u64 {
    let mut zeros = 0;
    for number in numbers
        .into_iter()
        .flatten()
        .filter(|number| *number == 0.0)
    {
        assert!(number.is_sign_positive(), "{name}");
        zeros += 1;
    }
    zeros
}

#[test]
fn a_zero_of_one_rotor_has_no_sign() {
    let mut zeros = 0;
    for parameters in rotors() {
        let rotor = Rotor::new(parameters).unwrap();
        let numbers = evaluate_at(&Quantity::ALL, &rotor, Some(SPEED));
        for (quantity, number) in Quantity::ALL.into_iter().zip(numbers) {
            zeros += assert_no_negative_zero([number.ok()], &format!("{quantity} {parameters:?}"));
        }
    }
    assert!(zeros > 0);
}

#[test]
fn a_zero_of_a_scan_and_of_its_reductions_has_no_sign() {
    let extremes = [Statistic::Maximum, Statistic::Minimum];
    let mut zeros = [0; 2];
    for parameters in rotors() {
        for name in ["crack_angle", "disk_mass"] {
            let value = (input(name).get)(&parameters);
            let axis = Axis::linear(input(name), (value, value + 0.1 * value.abs()), 9).unwrap();
            let scan = Scan::of(&Rotor::new(parameters).unwrap())
                .vary(Axis::listed(Variable::Speed, vec![SPEED]).unwrap())
                .vary(axis);
            let scan = Quantity::ALL
                .iter()
                .fold(scan, |scan, quantity| scan.quantity(*quantity));
            let chunks = scan.clone().plan().unwrap();
            let chunk = chunks.chunks().next().unwrap();
            let over = |statistic| Reduction::new(statistic).over(input(name));
            let plan = extremes
                .map(over)
                .into_iter()
                .fold(scan, Scan::reduce)
                .plan()
                .unwrap();
            let report = plan.reduce(&Control::default()).unwrap();
            for (number, quantity) in Quantity::ALL.into_iter().enumerate() {
                let text = format!("{quantity} along {name} of {parameters:?}");
                zeros[0] += assert_no_negative_zero(chunk.quantity(number).iter(), &text);
                let reduced = report
                    .reduced
                    .iter()
                    .map(|reduced| reduced.value(number, 0));
                zeros[1] += assert_no_negative_zero(reduced, &text);
            }
        }
    }
    assert!(zeros.iter().all(|zeros| *zeros > 0), "{zeros:?}");
}
