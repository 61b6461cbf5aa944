//! The one place where points of a scan are evaluated.
//!
//! A kernel belongs to an inner axis and a list of quantities. [`Kernel::enter`] is called once for
//! each block of the inner axis, for what depends on it alone; [`Kernel::evaluate`] once for each
//! row of that block.

use crate::quantity::{self, Quantity};
use crate::rotor::{NumericInput, Rotor, RotorParameters};

use super::axis::Axis;

/// The most points of a block.
pub(super) const POINTS_PER_BLOCK: usize = 4096;

/// Evaluates quantities along blocks of an inner axis.
pub(super) struct Kernel<'a> {
    quantities: &'a [Quantity],
    inputs: Vec<&'static NumericInput>,
    /// The block's values, one list for each input.
    values: Vec<Vec<f64>>,
    length: usize,
}

impl<'a> Kernel<'a> {
    /// A kernel for the inputs that vary along the inner axis.
    pub(super) fn new(inner: &Axis, quantities: &'a [Quantity]) -> Self {
        let inputs: Vec<_> = inner.inputs().collect();
        Self {
            quantities,
            values: vec![Vec::new(); inputs.len()],
            inputs,
            length: 0,
        }
    }

    /// Takes the block of `length` values of the inner axis from the index `first` on, at most
    /// [`POINTS_PER_BLOCK`].
    pub(super) fn enter(&mut self, inner: &Axis, first: u64, length: usize) {
        self.length = length;
        for (column, values) in self.values.iter_mut().enumerate() {
            values.resize(length, f64::NAN);
            inner.fill(column, first, values);
        }
    }

    /// Evaluates the block for the rotors that have the inputs `row` but for those of the inner
    /// axis, which need not be valid. `results` has for each quantity a slice of the block's length.
    ///
    /// Within these slices, and nowhere else, NaN means that the point has no such quantity.
    /// Answers how many points are no rotor.
    pub(super) fn evaluate(&mut self, row: &RotorParameters, results: &mut [&mut [f64]]) -> u64 {
        let mut parameters = *row;
        let mut no_rotor = 0;
        for point in 0..self.length {
            for (input, values) in self.inputs.iter().zip(&self.values) {
                (input.set)(&mut parameters, values[point]);
            }
            let Ok(rotor) = Rotor::new(parameters) else {
                no_rotor += 1;
                for result in results.iter_mut() {
                    result[point] = f64::NAN;
                }
                continue;
            };
            let values = quantity::evaluate(self.quantities, &rotor);
            for (result, value) in results.iter_mut().zip(values) {
                // A zero has no sign.
                result[point] = value.map_or(f64::NAN, |value| value + 0.0);
            }
        }
        no_rotor
    }
}
