//! Tables of rotors: quantities of many rotors that are given one by one, in packs.
//!
//! ```
//! use rotor_core::quantity::Quantity;
//! use rotor_core::input::{NumericInput, RotorParameters};
//! use rotor_core::study::table::{Column, evaluate};
//!
//! let input = |name| NumericInput::find(name).ok_or("no such input");
//! let depths = [0.1, 0.2, 7.0];
//! let columns = [Column { input: input("crack_depth_ratio")?, values: &depths }];
//! let quantities = [Quantity::SirWidth, Quantity::Beta];
//! let results = evaluate(&RotorParameters::PAPER, &columns, &quantities)?;
//! let [widths, ratios] = [0, 1].map(|quantity| results.column(quantity));
//! assert!(widths.get(1) > widths.get(0));
//! // No crack is seven radii deep.
//! assert_eq!((widths.get(2), ratios.get(2)), (None, None));
//! assert_eq!(results.counts().no_rotor, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::batch::kernel::{Kernel, POINTS_PER_BLOCK};
use crate::error::{Error, StudyError};
use crate::input::{NumericInput, RotorParameters};
use crate::quantity::Quantity;

use super::chunk::Counts;
use super::collected::Collected;

/// The values of an input, one for each rotor.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// The input.
    pub input: &'static NumericInput,
    /// Its values in SI units.
    pub values: &'a [f64],
}

/// Evaluates quantities of the rotors whose inputs are `base` but for those that have a column: for each quantity a
/// column of its own, which has none in the rows whose rotor has no such quantity or that are no rotor.
/// [`evaluate`](crate::study::evaluate) says why.
///
/// # Errors
/// Where there is no column, columns differ in their lengths, two are of one input, or a quantity is at a speed.
pub fn evaluate(
    base: &RotorParameters,
    columns: &[Column<'_>],
    quantities: &[Quantity],
) -> Result<Collected, Error> {
    let length = check(columns)?;
    if let Some(quantity) = quantities.iter().find(|quantity| quantity.needs_speed()) {
        let quantity = quantity.name();
        return Err(StudyError::NoSpeedInTable { quantity }.into());
    }
    let mut results = vec![vec![f64::NAN; length]; quantities.len()];
    let mut counts = Counts::none(quantities.len());
    counts.points = length as u64;
    let mut kernel = Kernel::of_table(columns.iter().map(|column| column.input), quantities);
    for from in (0..length).step_by(POINTS_PER_BLOCK) {
        let to = length.min(from + POINTS_PER_BLOCK);
        kernel.enter(from as u64, to - from, |number, values| {
            values.copy_from_slice(&columns[number].values[from..to]);
        });
        let stretch = results.iter_mut().map(|result| &mut result[from..to]);
        let evaluated = kernel.evaluate(base, None, &mut stretch.collect::<Vec<_>>());
        counts.no_rotor += evaluated.no_rotor;
    }
    for (missing, values) in counts.missing.iter_mut().zip(&results) {
        *missing = values.iter().filter(|value| value.is_nan()).count() as u64;
    }
    Ok(Collected {
        quantities: quantities.to_vec(),
        results,
        counts,
    })
}

/// How many rows there are.
fn check(columns: &[Column<'_>]) -> Result<usize, Error> {
    let first = columns.first().ok_or(StudyError::NoColumn)?;
    let expected = first.values.len();
    for (place, column) in columns.iter().enumerate() {
        let (input, length) = (column.input.name, column.values.len());
        if length != expected {
            return Err(StudyError::ColumnLengths {
                input,
                length,
                first: first.input.name,
                expected,
            }
            .into());
        }
        if columns[..place]
            .iter()
            .any(|other| other.input == column.input)
        {
            return Err(StudyError::TwoColumns { input }.into());
        }
    }
    Ok(expected)
}
