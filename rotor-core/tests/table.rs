//! Tables of rotors against the quantities of each rotor alone.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use proptest::prelude::*;
use rotor_core::error::StudyError;
use rotor_core::input::{CrackEdge, CrackModel, INPUTS, NumericInput, RotorParameters};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study;
use rotor_core::study::table::{Column, evaluate};

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

/// Holds a table against its rotors one by one: the same numbers, bit by bit, and nothing where they have nothing.
fn assert_as_alone(base: RotorParameters, columns: &[Column<'_>]) {
    let of_rotor = Quantity::ALL
        .into_iter()
        .filter(|quantity| !quantity.needs_speed());
    let quantities: Vec<_> = of_rotor.collect();
    let found = evaluate(&base, columns, &quantities).unwrap();
    for row in 0..columns[0].values.len() {
        let mut parameters = base;
        for column in columns {
            (column.input.set)(&mut parameters, column.values[row]);
        }
        let rotor = Rotor::new(parameters);
        for (place, quantity) in quantities.iter().enumerate() {
            let expected = rotor.as_ref().ok();
            let expected = expected.and_then(|rotor| quantity.evaluate(rotor).ok());
            assert_eq!(
                found.column(place).get(row),
                expected,
                "{quantity} of {parameters:?}"
            );
        }
    }
}

/// Rows of all inputs around a rotor's, with those among them at and beyond the ends of what is allowed.
fn tables() -> impl Strategy<Value = (RotorParameters, Vec<Vec<f64>>)> {
    let models = prop::sample::select(CrackModel::ALL.to_vec());
    let edges = prop::sample::select(CrackEdge::ALL.to_vec());
    let factor = prop_oneof![8 => 0.3..1.8f64, 1 => Just(0.0), 1 => -2.0..8.0f64];
    let rows = prop::collection::vec(prop::collection::vec(factor, INPUTS.len()), 1..40);
    (models, edges, rows).prop_map(|(crack_model, crack_edge, rows)| {
        let base = RotorParameters {
            crack_model,
            crack_edge,
            disk_position_ratio: 0.45,
            crack_angle: 0.9,
            disk_asymmetry: 0.15,
            crack_depth_ratio: 0.3,
            ..RotorParameters::PAPER
        };
        let column = |(place, input): (usize, &NumericInput)| {
            let value = (input.get)(&base);
            rows.iter().map(|row| value * row[place]).collect()
        };
        (base, INPUTS.iter().enumerate().map(column).collect())
    })
}

proptest! {
    #[test]
    fn any_table_is_as_its_rotors_alone((base, values) in tables()) {
        let columns = INPUTS.iter().zip(&values);
        let columns: Vec<_> = columns.map(|(input, values)| Column { input, values }).collect();
        assert_as_alone(base, &columns);
    }

    #[test]
    fn one_column_varies_alone((base, values) in tables(), place in 0..INPUTS.len()) {
        assert_as_alone(base, &[Column { input: &INPUTS[place], values: &values[place] }]);
    }
}

#[test]
fn a_disk_at_midspan_without_and_with_a_crack_is_as_alone() {
    let depths = [0.0, 1e-9, 0.2, 1.0];
    for crack_model in CrackModel::ALL {
        let base = RotorParameters {
            disk_position_ratio: 0.5,
            crack_model,
            ..RotorParameters::PAPER
        };
        let values = &depths;
        assert_as_alone(
            base,
            &[Column {
                input: input("crack_depth_ratio"),
                values,
            }],
        );
    }
}

#[test]
fn a_table_longer_than_a_block_is_whole() {
    let angles: Vec<f64> = (0..10_001).map(|row| f64::from(row) * 1e-3).collect();
    let columns = [Column {
        input: input("crack_angle"),
        values: &angles,
    }];
    let quantities = [Quantity::CirWidth, Quantity::SirStart];
    let found = evaluate(&RotorParameters::PAPER, &columns, &quantities).unwrap();
    for row in [0, 1023, 1024, 4095, 4096, 8191, 8192, 10_000] {
        let rotor = Rotor::default()
            .with(|p| p.crack_angle = angles[row])
            .unwrap();
        let expected = study::evaluate(&quantities, &rotor);
        for (place, expected) in expected.into_iter().enumerate() {
            assert_eq!(found.column(place).get(row), expected.ok());
        }
    }
}

#[test]
fn columns_that_are_no_table_are_refused() {
    let (mass, length) = (input("disk_mass"), input("shaft_length"));
    let (two, three) = ([1.0, 2.0], [0.1, 0.2, 0.3]);
    let column = |input, values| Column { input, values };
    let refused = |columns: &[Column<'_>]| {
        let refused = evaluate(&RotorParameters::PAPER, columns, &[Quantity::Beta]);
        refused.unwrap_err().to_string()
    };
    assert_eq!(refused(&[]), StudyError::NoColumn.to_string());
    assert_eq!(
        refused(&[column(mass, &two), column(length, &three)]),
        "the column of shaft_length has 3 rows; it must have 2, as that of disk_mass has"
    );
    assert_eq!(
        refused(&[column(mass, &two), column(mass, &two)]),
        "disk_mass has two columns; an input has one at most"
    );
}
