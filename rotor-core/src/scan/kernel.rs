//! The one place where points of a scan are evaluated.
//!
//! A kernel belongs to an inner axis and a list of quantities. [`Kernel::enter`] is called once for
//! each block of the inner axis, for what depends on it alone; [`Kernel::evaluate`] once for each
//! row of that block.
//!
//! The widths of both regions come from generated code in packs ([`widths`]), in stages along the
//! axis. Whatever they leave open is computed point by point as everywhere else: the other
//! quantities, points at which a region may not exist, and inputs far from those of any machine.

mod widths;

use crate::quantity::{self, Quantity};
use crate::rotor::{NumericInput, Rotor, RotorParameters};

use super::axis::Axis;
use widths::Widths;

/// The most points of a block.
pub(super) const POINTS_PER_BLOCK: usize = 4096;

/// Evaluates quantities along blocks of an inner axis.
pub(super) struct Kernel<'a> {
    quantities: &'a [Quantity],
    /// The places of the widths of the simple and of the combination region among the quantities.
    places: [Option<usize>; 2],
    /// Whether there is nothing but widths.
    only_widths: bool,
    widths: Widths,
    inputs: Vec<&'static NumericInput>,
    /// The block's values, one list for each input.
    values: Vec<Vec<f64>>,
    length: usize,
}

impl<'a> Kernel<'a> {
    /// A kernel for the inputs that vary along the inner axis.
    pub(super) fn new(inner: &Axis, quantities: &'a [Quantity]) -> Self {
        let inputs: Vec<_> = inner.inputs().collect();
        let place = |wanted| quantities.iter().position(|quantity| *quantity == wanted);
        let places = [Quantity::SirWidth, Quantity::CirWidth].map(place);
        Self {
            quantities,
            places,
            only_widths: places.iter().flatten().count() == quantities.len(),
            widths: Widths::along(&inputs),
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
        if self.places != [None, None] {
            self.widths.enter(&self.values);
        }
    }

    /// Evaluates the block for the rotors that have the inputs `row` but for those of the inner
    /// axis, which need not be valid. `results` has for each quantity a slice of the block's length.
    ///
    /// Within these slices, and nowhere else, NaN means that the point has no such quantity.
    /// Answers how many points are no rotor.
    pub(super) fn evaluate(&mut self, row: &RotorParameters, results: &mut [&mut [f64]]) -> u64 {
        let in_packs = self.widths_in_packs(row, results);
        if in_packs && self.only_widths && self.all_are_widths(results) {
            return 0;
        }
        let mut no_rotor = 0;
        for point in 0..self.length {
            let known = in_packs && self.is_width(point, results);
            if !(known && self.only_widths) {
                no_rotor += u64::from(!self.point(row, point, known, results));
            }
        }
        no_rotor
    }

    /// Evaluates the widths that are asked for together; whether that could be done.
    fn widths_in_packs(&mut self, row: &RotorParameters, results: &mut [&mut [f64]]) -> bool {
        if self.places == [None, None] {
            return false;
        }
        let mut wanted = [None, None];
        for (place, result) in results.iter_mut().enumerate() {
            for (width, known) in wanted.iter_mut().zip(self.places) {
                if known == Some(place) {
                    *width = Some(&mut **result);
                    break;
                }
            }
        }
        self.widths.evaluate(row, &self.values, wanted)
    }

    /// Whether what stands at a point are widths of regions that exist. A zero may be one of a region that is closed, or
    /// what is left of a smaller number.
    fn is_width(&self, point: usize, results: &[&mut [f64]]) -> bool {
        let mut places = self.places.iter().flatten();
        self.widths.is_open(point) && places.all(|place| is_size(results[*place][point]))
    }

    fn all_are_widths(&self, results: &[&mut [f64]]) -> bool {
        let all = |place: &usize| results[*place].iter().all(|value| is_size(*value));
        self.widths.all_are_open() && self.places.iter().flatten().all(all)
    }

    /// Evaluates one point, but for widths that are known; whether it is a rotor.
    fn point(
        &self,
        row: &RotorParameters,
        point: usize,
        widths_are_known: bool,
        results: &mut [&mut [f64]],
    ) -> bool {
        let mut parameters = *row;
        for (input, values) in self.inputs.iter().zip(&self.values) {
            (input.set)(&mut parameters, values[point]);
        }
        let Ok(rotor) = Rotor::new(parameters) else {
            for result in results.iter_mut() {
                result[point] = f64::NAN;
            }
            return false;
        };
        let values = quantity::evaluate(self.quantities, &rotor);
        for (place, (result, value)) in results.iter_mut().zip(values).enumerate() {
            if !(widths_are_known && self.places.contains(&Some(place))) {
                // A zero has no sign.
                result[point] = value.map_or(f64::NAN, |value| value + 0.0);
            }
        }
        true
    }
}

/// Whether a number is positive, with all its digits.
fn is_size(value: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&value)
}
