//! Both widths from physical rotors, in columns: values, and gradients by all inputs.

use rotor_core::equations::widths_support_arm;

use super::{Bench, Outcome, columns_error};
use crate::column::Column;
use crate::inputs::{self, PHYSICAL, ROTOR};

/// The twelve inputs of rotors around the paper's, within 5 % of each, in the order of [`rotor_core::input::INPUTS`]; then
/// the factor of a half-open edge for every row.
pub(super) fn physical_columns() -> Vec<Column> {
    let p = ROTOR;
    let around = [
        p.disk_mass,
        p.disk_diametral_inertia,
        p.disk_polar_inertia,
        p.disk_asymmetry,
        p.disk_position_ratio,
        p.shaft_length,
        p.shaft_radius,
        p.shaft_youngs_modulus,
        p.shaft_poissons_ratio,
        p.crack_depth_ratio,
        p.crack_position_ratio,
        0.8,
    ];
    let column = |(place, value): (usize, f64)| {
        Column::input(
            place,
            &inputs::spread(place, 0.95 * value, 1.05 * value, PHYSICAL),
        )
    };
    let edge_factor = Column::input(around.len(), &[32.0; PHYSICAL]);
    let varied = around.into_iter().enumerate().map(column);
    varied.chain([edge_factor]).collect()
}

/// The physical columns as the generated form takes them.
fn physical_inputs(columns: &[Column]) -> widths_support_arm::Columns<'_> {
    widths_support_arm::Columns {
        p_disk_mass: &columns[0],
        p_disk_diametral_inertia: &columns[1],
        p_disk_polar_inertia: &columns[2],
        p_disk_asymmetry: &columns[3],
        p_disk_position_ratio: &columns[4],
        p_shaft_length: &columns[5],
        p_shaft_radius: &columns[6],
        p_shaft_youngs_modulus: &columns[7],
        p_shaft_poissons_ratio: &columns[8],
        p_crack_depth_ratio: &columns[9],
        p_crack_position_ratio: &columns[10],
        p_crack_angle: &columns[11],
        edge_factor: &columns[12],
    }
}

pub(super) fn physical_values(bench: &mut Bench) -> Outcome {
    bench.shaped(2, PHYSICAL);
    let inputs = physical_inputs(&bench.physical);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    widths_support_arm::columns(&inputs, [sir, cir]).map_err(columns_error)
}

pub(super) fn physical_gradients(bench: &mut Bench) -> Outcome {
    bench.shaped(26, PHYSICAL);
    let inputs = physical_inputs(&bench.physical);
    let results: Vec<&mut [f64]> = bench
        .results
        .iter_mut()
        .map(|result| &mut **result)
        .collect();
    let Ok(results) = results.try_into() else {
        return Ok(());
    };
    widths_support_arm::gradient_columns(&inputs, results).map_err(columns_error)
}
