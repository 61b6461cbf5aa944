//! The forms over columns give the scalar forms' numbers, bit by bit: both have the same sine and cosine.

use rotor_core::equations::{self, Coefficients};
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_tests::{parameters, table};

const EDGE_FACTOR: f64 = 32.0;

fn rotors() -> Vec<RotorParameters> {
    table("random_rotors.csv").iter().map(parameters).collect()
}

/// A column of each field of the rows.
fn column<T>(rows: &[T], get: impl Fn(&T) -> f64) -> Vec<f64> {
    rows.iter().map(get).collect()
}

/// Compares `columns` of one of the models with its `value`.
macro_rules! widths_of_all_rows {
    ($widths:ident) => {{
        use rotor_core::equations::$widths::{Columns, columns, value};
        let rotors = rotors();
        let of = |get: fn(&RotorParameters) -> f64| column(&rotors, get);
        let rows = rotors.len();
        let (mut sir, mut cir) = (vec![0.0; rows], vec![0.0; rows]);
        let inputs = Columns {
            p_disk_mass: &of(|p| p.disk_mass),
            p_disk_diametral_inertia: &of(|p| p.disk_diametral_inertia),
            p_disk_polar_inertia: &of(|p| p.disk_polar_inertia),
            p_disk_asymmetry: &of(|p| p.disk_asymmetry),
            p_disk_position_ratio: &of(|p| p.disk_position_ratio),
            p_shaft_length: &of(|p| p.shaft_length),
            p_shaft_radius: &of(|p| p.shaft_radius),
            p_shaft_youngs_modulus: &of(|p| p.shaft_youngs_modulus),
            p_shaft_poissons_ratio: &of(|p| p.shaft_poissons_ratio),
            p_crack_depth_ratio: &of(|p| p.crack_depth_ratio),
            p_crack_position_ratio: &of(|p| p.crack_position_ratio),
            p_crack_angle: &of(|p| p.crack_angle),
            edge_factor: &vec![EDGE_FACTOR; rows],
        };
        columns(&inputs, [&mut sir, &mut cir]).unwrap();
        let scalar: Vec<_> = rotors.iter().map(|p| value(p, EDGE_FACTOR)).collect();
        assert_eq!(sir, column(&scalar, |widths| widths.0));
        assert_eq!(cir, column(&scalar, |widths| widths.1));
        assert!(
            sir.iter().chain(&cir).filter(|width| **width > 0.0).count() > rows,
            "few widths"
        );
    }};
}

#[test]
fn widths_in_the_model_support_arm() {
    widths_of_all_rows!(widths_support_arm);
}

#[test]
fn widths_in_the_model_midspan_arm() {
    widths_of_all_rows!(widths_midspan_arm);
}

#[test]
fn widths_in_the_model_simply_supported_left() {
    widths_of_all_rows!(widths_simply_supported_left);
}

#[test]
fn widths_in_the_model_simply_supported_right() {
    widths_of_all_rows!(widths_simply_supported_right);
}

#[test]
fn width_of_the_simple_region_with_its_gradient() {
    use rotor_core::equations::sir_width::{Columns, gradient, gradient_columns};
    let all: Vec<Coefficients> = rotors()
        .into_iter()
        .map(|p| Rotor::new(p).unwrap().coefficients().unwrap())
        .collect();
    let of = |get: fn(&Coefficients) -> f64| column(&all, get);
    let inputs = Columns {
        c_beta: &of(|c| c.beta),
        c_gamma: &of(|c| c.gamma),
        c_delta: &of(|c| c.delta),
        c_epsilon_1: &of(|c| c.epsilon_1),
        c_epsilon_12: &of(|c| c.epsilon_12),
        c_epsilon_2: &of(|c| c.epsilon_2),
        c_disk_asymmetry: &of(|c| c.disk_asymmetry),
        c_crack_angle: &of(|c| c.crack_angle),
    };
    let mut results = vec![vec![0.0; all.len()]; 9];
    let [a, b, c, d, e, f, g, h, i] = &mut results[..] else {
        panic!("nine results")
    };
    gradient_columns(&inputs, [a, b, c, d, e, f, g, h, i]).unwrap();
    for (row, coefficients) in all.iter().enumerate() {
        let (value, partials) = gradient(coefficients);
        // The partials are by every number the function uses, eight here.
        let expected: Vec<f64> = std::iter::once(value).chain(partials).collect();
        let found = column(&results, |result| result[row]);
        assert_eq!(found, expected, "row {row}");
    }
}

#[test]
fn a_column_that_is_too_short_is_refused_by_name() {
    let c = Rotor::default().coefficients().unwrap();
    let (one, two) = ([1.0], [1.0, 2.0]);
    let constants = |number: f64| [number; 2];
    let inputs = equations::phi::Columns {
        omega: &two,
        speed: &one,
        c_beta: &constants(c.beta),
        c_gamma: &constants(c.gamma),
        c_delta: &constants(c.delta),
        c_epsilon_1: &constants(c.epsilon_1),
        c_epsilon_12: &constants(c.epsilon_12),
        c_epsilon_2: &constants(c.epsilon_2),
        c_disk_asymmetry: &constants(c.disk_asymmetry),
        c_crack_angle: &constants(c.crack_angle),
    };
    let error = equations::phi::columns(&inputs, [&mut [0.0; 2]]).unwrap_err();
    assert_eq!(
        (error.column, error.length, error.expected),
        ("speed", 1, 2)
    );
}
