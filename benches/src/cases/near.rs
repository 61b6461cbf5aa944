//! Both widths of rotors that are given, as the two forms compute them that are timed: from columns, and over a grid of
//! rotors and angles. Another program asks for them near zero unstable points, where forms differ in their digits.

use lanes::{ALL, Level, store};
use rotor_core::equations::Coefficients;
use rotor_core::equations::both_widths::along_crack_angle as widths_along_angle;

use super::{CaseError, columns_error, tables, widths};

/// Columns that are no rotors.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NearError {
    /// There is not a column for each coefficient but the angle.
    #[error("rotors have 7 columns, not {0}")]
    Columns(usize),
    /// They could not be computed.
    #[error(transparent)]
    Case(#[from] CaseError),
}

/// Both widths of all rotors at all angles, a rotor after the other, from columns. The rotors are the columns of their
/// coefficients but the angle.
///
/// # Errors
/// The columns are not those of rotors.
pub fn near_columns(rotors: &[Vec<f64>], angles: &[f64]) -> Result<[Vec<f64>; 2], NearError> {
    let repeated = |column: &Vec<f64>| -> Vec<f64> {
        let row = |number: &f64| std::iter::repeat_n(*number, angles.len());
        column.iter().flat_map(row).collect()
    };
    let mut columns: Vec<Vec<f64>> = rotors.iter().map(repeated).collect();
    columns.push(angles.repeat(rotors.first().map_or(0, Vec::len)));
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let Ok(slices) = <[&[f64]; 8]>::try_from(slices) else {
        return Err(NearError::Columns(rotors.len()));
    };
    let points = slices[0].len();
    let [mut sir, mut cir] = [vec![0.0; points], vec![0.0; points]];
    widths(&slices, &mut sir, &mut cir)?;
    Ok([sir, cir])
}

/// Computes these rotors as a grid, with tables of the angles.
///
/// # Errors
/// The columns are not those of rotors.
pub fn near_grid(rotors: &[Vec<f64>], angles: &[f64]) -> Result<[Vec<f64>; 2], NearError> {
    use widths_along_angle::{Along, FIXED, Points, TABLES, fixed};
    let rotors: &[Vec<f64>; 7] = rotors
        .try_into()
        .map_err(|_| NearError::Columns(rotors.len()))?;
    let count = rotors[0].len();
    let coefficients = |row: usize| {
        let [
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            disk_asymmetry,
        ] = rotors.each_ref().map(|column| column[row]);
        fixed(&Coefficients {
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            disk_asymmetry,
            crack_angle: 0.0,
        })
    };
    let along = tables::<Along, TABLES>(angles)?;
    let along = along.each_ref().map(|table| &**table);
    let [mut sir, mut cir] = [0, 1].map(|_| vec![0.0; count * angles.len()]);
    let results = sir
        .chunks_mut(angles.len())
        .zip(cir.chunks_mut(angles.len()))
        .map(|(sir, cir)| [sir, cir]);
    for (fixed, results) in (0..count).map(coefficients).zip(results) {
        store::<Points, ALL, FIXED, TABLES, 2>(Level::best(), &fixed, along, results)
            .map_err(columns_error)?;
    }
    Ok([sir, cir])
}
