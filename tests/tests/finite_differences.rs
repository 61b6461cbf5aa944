//! Generated derivatives against finite differences of the generated values.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::equations::{self, Coefficients};
use rotor_core::input::{NumericInput, RotorParameters};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_tests::{parameters, relative_error, table};

/// The frequency equations' partials have to agree to this, as a share of the largest one.
const EQUATIONS: f64 = 1e-10;
/// The widths' partials have to agree to this. What limits it is the differences: the step of 1e-3 magnifies the
/// rounding of the widths by some thousands.
const WIDTHS: f64 = 1e-9;

/// The derivative of `f` at `x` by central differences over the steps h, h/2 and h/4, extrapolated by Richardson: its
/// error is of the sixth order in h.
fn derivative(f: impl Fn(f64) -> f64, x: f64, h: f64) -> f64 {
    let central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    let [coarse, middle, fine] = [central(h), central(0.5 * h), central(0.25 * h)];
    let (coarse, fine) = ((4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0);
    (16.0 * fine - coarse) / 15.0
}

/// Rotors of the reference table, spread over it.
fn rotors(filter: impl Fn(&RotorParameters) -> bool) -> Vec<RotorParameters> {
    let rotors: Vec<_> = table("random_rotors.csv")
        .iter()
        .map(parameters)
        .filter(filter)
        .collect();
    let step = rotors.len() / 20;
    assert!(step > 0, "{} rotors", rotors.len());
    rotors.into_iter().step_by(step).take(20).collect()
}

type Form = fn(f64, f64, &Coefficients) -> f64;
type Gradient = fn(f64, f64, &Coefficients) -> (f64, [f64; 2]);
type Hessian = fn(f64, f64, &Coefficients) -> (f64, [f64; 2], [[f64; 2]; 2]);

#[test]
fn partials_of_the_frequency_equations() {
    let equations: [(&str, Form, Gradient, Hessian); 2] = [
        (
            "f_n",
            equations::f_n::value,
            equations::f_n::gradient,
            equations::f_n::hessian,
        ),
        (
            "phi",
            equations::phi::value,
            equations::phi::gradient,
            equations::phi::hessian,
        ),
    ];
    let mut worst = 0.0_f64;
    for (index, p) in rotors(|_| true).iter().enumerate() {
        let c = Rotor::new(*p).unwrap().coefficients().unwrap();
        let omega = 0.35 + 0.13 * index as f64;
        let speed = 2.9 - 0.11 * index as f64;
        for (name, value, gradient, hessian) in equations {
            let at = |omega: f64, speed: f64| value(omega, speed, &c);
            let by_omega = |omega: f64, speed: f64| derivative(|x| at(x, speed), omega, 0.04);
            let by_speed = |omega: f64, speed: f64| derivative(|x| at(omega, x), speed, 0.04);
            let (_, first, second) = hessian(omega, speed, &c);
            let alone = gradient(omega, speed, &c).1;
            let mixed = derivative(|x| by_speed(x, speed), omega, 0.04);
            let expected = [
                by_omega(omega, speed),
                by_speed(omega, speed),
                derivative(|x| by_omega(x, speed), omega, 0.04),
                mixed,
                mixed,
                derivative(|x| by_speed(omega, x), speed, 0.04),
            ];
            let found = [first.as_slice(), second.as_flattened()].concat();
            let size = found.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            for (found, expected) in found.into_iter().zip(expected) {
                let error = (found - expected).abs() / size;
                worst = worst.max(error);
            }
            for (first, alone) in first.into_iter().zip(alone) {
                assert!((first - alone).abs() <= 1e-12 * size, "{name}");
            }
        }
    }
    println!("phi, f_n: {worst:.1e} of the largest partial");
    assert!(worst <= EQUATIONS, "{worst:e}");
}

/// The inputs in the order of the gradients.
const INPUTS: [&str; 12] = [
    "disk_mass",
    "disk_diametral_inertia",
    "disk_polar_inertia",
    "disk_asymmetry",
    "disk_position_ratio",
    "shaft_length",
    "shaft_radius",
    "shaft_youngs_modulus",
    "shaft_poissons_ratio",
    "crack_depth_ratio",
    "crack_position_ratio",
    "crack_angle",
];

type Widths = fn(&RotorParameters, f64) -> (f64, f64);
type WidthGradients = fn(&RotorParameters, f64) -> ((f64, f64), [[f64; 12]; 2]);

/// The largest difference, as a share of the width for a relative change of the input (of 1 rad for the angle).
fn worst_of_widths(widths: Widths, gradients: WidthGradients, rotors: &[RotorParameters]) -> f64 {
    let mut worst = 0.0_f64;
    for p in rotors {
        let ((sir, cir), found) = gradients(p, 32.0);
        let alone = widths(p, 32.0);
        assert!(relative_error(sir, alone.0) <= 1e-12 && relative_error(cir, alone.1) <= 1e-12);
        for (position, name) in INPUTS.iter().enumerate() {
            let input = NumericInput::find(name).unwrap();
            let x = (input.get)(p);
            let scale = if *name == "crack_angle" { 1.0 } else { x.abs() };
            let at = |x: f64| {
                let mut changed = *p;
                (input.set)(&mut changed, x);
                widths(&changed, 32.0)
            };
            let expected = [
                derivative(|x| at(x).0, x, 1e-3 * scale),
                derivative(|x| at(x).1, x, 1e-3 * scale),
            ];
            for (row, width) in [sir, cir].into_iter().enumerate() {
                let size = found[row][position].abs().max(width / scale);
                let error = (found[row][position] - expected[row]).abs() / size;
                worst = worst.max(error);
            }
        }
    }
    worst
}

#[test]
fn gradients_of_the_widths_by_all_inputs() {
    let left = |p: &RotorParameters| p.crack_position_ratio < p.disk_position_ratio;
    let models: [(&str, Widths, WidthGradients, Vec<RotorParameters>); 4] = [
        (
            "support-arm",
            equations::widths_support_arm::value,
            equations::widths_support_arm::gradient,
            rotors(|_| true),
        ),
        (
            "midspan-arm",
            equations::widths_midspan_arm::value,
            equations::widths_midspan_arm::gradient,
            rotors(|_| true),
        ),
        (
            "simply-supported, crack left of the disk",
            equations::widths_simply_supported_left::value,
            equations::widths_simply_supported_left::gradient,
            rotors(left),
        ),
        (
            "simply-supported, crack right of the disk",
            equations::widths_simply_supported_right::value,
            equations::widths_simply_supported_right::gradient,
            rotors(|p| !left(p)),
        ),
    ];
    for (model, widths, gradients, rotors) in models {
        let worst = worst_of_widths(widths, gradients, &rotors);
        println!("{model}: {worst:.1e}");
        assert!(worst <= WIDTHS, "{model}: {worst:e}");
    }
}
