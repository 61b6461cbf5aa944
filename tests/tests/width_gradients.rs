//! The widths of the regions and their partials by every input of the rotor against 60 digits, for every crack model.
//!
//! The reference computes the partials from the definitions by central differences, so that nothing of the generator's
//! (its derivatives, its fits of the crack's integrals, its rewriting of the formulas) is on both sides.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rotor_core::input::{CrackEdge, CrackModel, INPUTS};
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_tests::{Record, number, parameters, relative_error, table};

/// The partials have to agree to this, relative to the larger of the partial and the width over the input.
const PARTIALS: f64 = 1e-11;
/// The widths themselves have to agree to this.
const WIDTHS: f64 = 1e-12;

fn rotor(row: &Record) -> Rotor {
    let mut p = parameters(row);
    p.crack_edge = row["crack_edge"].parse().unwrap();
    Rotor::new(p).unwrap()
}

/// The crack's model, its edge, and whether it is left of the disk where the model asks.
fn load_case(rotor: &Rotor) -> (CrackModel, CrackEdge, bool) {
    let p = rotor.parameters();
    let left = p.crack_model == CrackModel::SimplySupported
        && p.crack_position_ratio < p.disk_position_ratio;
    (p.crack_model, p.crack_edge, left)
}

#[test]
fn the_widths_and_their_partials_by_every_input() {
    let rows = table("width_gradients.csv");
    assert_eq!(rows.len(), 12);
    let mut cases = Vec::new();
    let (mut worst_width, mut worst_partial) = (0.0_f64, 0.0_f64);
    for (index, row) in rows.iter().enumerate() {
        let rotor = rotor(row);
        let case = load_case(&rotor);
        if !cases.contains(&case) {
            cases.push(case);
        }
        for (kind, name) in [
            (RegionKind::Simple, "sir_width"),
            (RegionKind::Combination, "cir_width"),
        ] {
            let (width, partials) = rotor.width_gradient(kind).unwrap();
            let error = relative_error(width, number(row, name));
            worst_width = worst_width.max(error);
            assert!(
                error <= WIDTHS,
                "{name} of row {index} ({case:?}) is off by {error:.1e}"
            );
            for (input, partial) in INPUTS.iter().zip(partials) {
                let by = format!("{name}_by_{}", input.name);
                let expected = number(row, &by);
                let size = expected
                    .abs()
                    .max((width / (input.get)(rotor.parameters())).abs());
                let error = (partial - expected).abs() / size;
                worst_partial = worst_partial.max(error);
                assert!(
                    error <= PARTIALS,
                    "{by} of row {index} ({case:?}) is {partial:e}, not {expected:e}: off by {error:.1e}"
                );
            }
        }
    }
    println!(
        "{} partials: widths off by {worst_width:.1e} at most, partials by {worst_partial:.1e}",
        rows.len() * 2 * INPUTS.len()
    );
    // Both edges of all four load cases.
    assert_eq!(cases.len(), 8, "{cases:?}");
}
