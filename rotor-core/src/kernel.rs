//! The one place where many rotors are evaluated: the points of a scan, the rows of a table.
//!
//! A kernel belongs to what varies within a block and a list of quantities. [`Kernel::enter`] is called once for
//! each block, for what depends on its values alone; [`Kernel::evaluate`] once for each row, which is the block with
//! other values of the remaining inputs.
//!
//! Both come from generated code in packs: where only widths are asked for, in stages along what varies ([`widths`]); all
//! quantities of closed form by their columns ([`closed_forms`]). Whatever they leave open is computed point by point: exact
//! ends, points at which a region may not exist, and inputs far from those of any machine.

mod closed_forms;
mod widths;

use std::ops::RangeInclusive;

use crate::extremes::{Extremes, is_size};
use crate::quantity::{self, Quantity, Reason, Shared};
use crate::rotor::{INPUTS, NumericInput, Rotor, RotorParameters};
use crate::summary::{Summary, Wanted};
use crate::variable::Variable;

use closed_forms::{ClosedForms, Points, is_closed};
use widths::{Tables, Widths};

/// The most points of a block.
pub(crate) const POINTS_PER_BLOCK: usize = 4096;

/// The most blocks whose tables are kept, for an axis of as many: rows go through all of them.
const MOST_BLOCKS: usize = 16;

/// Points that have the same values in every row.
struct Block {
    /// Its first point on the axis.
    first: u64,
    /// When it was entered last.
    entered: u64,
    /// The values of the inputs, one list for each.
    values: Vec<Vec<f64>>,
    /// The speeds, where the speed varies.
    speeds: Option<Vec<f64>>,
    /// The points of plain values, and whether that is all of them.
    plain: Vec<bool>,
    all_are_plain: bool,
    /// What depends on the values alone.
    tables: Tables,
}

impl Block {
    fn points<'a>(
        &'a self,
        row: &'a RotorParameters,
        varied: &'a [&'static NumericInput],
    ) -> Points<'a> {
        Points {
            row,
            varied,
            values: &self.values,
        }
    }
}

/// What came of a row of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evaluated {
    /// How many points are no rotor.
    pub(crate) no_rotor: u64,
    /// Whether it is certain that every point has every quantity.
    pub(crate) is_complete: bool,
}

impl Evaluated {
    const COMPLETE: Self = Self {
        no_rotor: 0,
        is_complete: true,
    };
}

/// Evaluates quantities of blocks of rotors.
pub(crate) struct Kernel<'a> {
    quantities: &'a [Quantity],
    /// Those that are found by iteration.
    open: Vec<Quantity>,
    /// Where only widths are asked for: those of the simple and of the combination region by their places among the
    /// quantities, and how they are computed.
    staged: Option<([Option<usize>; 2], Widths)>,
    closed_forms: ClosedForms,
    variables: Vec<Variable>,
    /// Those that are inputs of the rotor.
    inputs: Vec<&'static NumericInput>,
    /// The blocks that were entered last, and the one that it is about.
    blocks: Vec<Block>,
    current: usize,
    /// How often one was entered.
    entered: u64,
    /// The last row, and whether its inputs are plain.
    last: Option<(RotorParameters, bool)>,
    /// Of a row's points those whose closed forms are known.
    known: Vec<bool>,
}

impl<'a> Kernel<'a> {
    /// A kernel for what varies within a block.
    pub(crate) fn new(
        variables: impl IntoIterator<Item = Variable>,
        quantities: &'a [Quantity],
    ) -> Self {
        let variables: Vec<_> = variables.into_iter().collect();
        let inputs = variables.iter().filter_map(|variable| match variable {
            Variable::Input(input) => Some(*input),
            Variable::Speed => None,
        });
        let inputs: Vec<_> = inputs.collect();
        let place = |wanted| quantities.iter().position(|quantity| *quantity == wanted);
        let places = [Quantity::SirWidth, Quantity::CirWidth].map(place);
        let only_widths = places.iter().flatten().count() == quantities.len();
        let staged = Widths::along(&inputs).filter(|_| only_widths);
        let open = quantities.iter().filter(|quantity| !is_closed(**quantity));
        Self {
            quantities,
            open: open.copied().collect(),
            staged: staged.map(|widths| (places, widths)),
            closed_forms: ClosedForms::of(quantities),
            variables,
            inputs,
            blocks: Vec::new(),
            current: 0,
            entered: 0,
            last: None,
            known: Vec::new(),
        }
    }

    /// Takes the block of `length` points from the point `first` of the axis on, at most [`POINTS_PER_BLOCK`]; `fill` writes
    /// the values of the variable of each number.
    pub(crate) fn enter(&mut self, first: u64, length: usize, fill: impl Fn(usize, &mut [f64])) {
        self.entered += 1;
        let same = |block: &Block| block.first == first && block.plain.len() == length;
        if let Some(known) = self.blocks.iter().position(same) {
            self.current = known;
            self.blocks[known].entered = self.entered;
            return;
        }
        let (mut values, mut speeds) = (Vec::new(), None);
        for (number, variable) in self.variables.iter().enumerate() {
            let mut filled = vec![f64::NAN; length];
            fill(number, &mut filled);
            match variable {
                Variable::Input(_) => values.push(filled),
                Variable::Speed => speeds = Some(filled),
            }
        }
        let mut block = Block {
            first,
            entered: self.entered,
            values,
            speeds,
            plain: vec![true; length],
            all_are_plain: false,
            tables: Tables::new(),
        };
        for (input, values) in self.inputs.iter().zip(&block.values) {
            let sizes = Sizes::of(input);
            for (plain, value) in block.plain.iter_mut().zip(values) {
                *plain &= sizes.contain(*value);
            }
        }
        block.all_are_plain = block.plain.iter().all(|plain| *plain);
        if let Some((_, widths)) = &self.staged {
            widths.tabulate(&block.values, &mut block.tables);
        }
        if self.blocks.len() < MOST_BLOCKS {
            self.current = self.blocks.len();
            self.blocks.push(block);
            return;
        }
        // Blocks at the ends of chunks come once, and are not to drive out those that every row has.
        let places = self.blocks.iter_mut().enumerate();
        if let Some((oldest, place)) = places.min_by_key(|(_, block)| block.entered) {
            self.current = oldest;
            *place = block;
        }
    }

    /// Evaluates the block for the rotors that have the inputs `row` but for those that vary, which need not be valid, at
    /// the speed of the row but where that varies. `results` has for each quantity a slice of the block's length.
    ///
    /// Within these slices, and nowhere else, NaN means that the point has no such quantity.
    pub(crate) fn evaluate(
        &mut self,
        row: &RotorParameters,
        speed: Option<f64>,
        results: &mut [&mut [f64]],
    ) -> Evaluated {
        if self.inputs.is_empty() {
            return self.along_speeds(row, results);
        }
        let row_is_plain = self.is_plain(row);
        let Some(block) = self.blocks.get(self.current) else {
            return Evaluated::COMPLETE;
        };
        let points = block.points(row, &self.inputs);
        if !row_is_plain {
            self.known.clear();
            self.known.resize(block.plain.len(), false);
        } else if let Some((places, widths)) = &mut self.staged {
            let wanted = widths_of(*places, results);
            let evaluated = widths.evaluate(points, &block.tables, wanted);
            let mut of_places = places.iter().flatten();
            if evaluated
                && block.all_are_plain
                && widths::all_have_regions(points)
                && of_places.all(|place| Extremes::of(&*results[*place]).are_sizes())
            {
                return Evaluated::COMPLETE;
            }
            self.known.clone_from(&block.plain);
            widths::keep_regions(points, &mut self.known);
            for place in places.iter().flatten() {
                for (known, width) in self.known.iter_mut().zip(&*results[*place]) {
                    // A zero may be the width of a closed region, or what is left of a smaller number.
                    *known &= evaluated && is_size(*width);
                }
            }
        } else {
            self.known.clone_from(&block.plain);
            let (quantities, known) = (self.quantities, &mut self.known);
            self.closed_forms
                .evaluate(points, quantities, results, known);
        }
        self.rest(row, speed, results)
    }

    /// What is wanted of the quantities in the block for these rotors without the quantities themselves, at points that all
    /// have all of them. None where it cannot be had so.
    pub(crate) fn summaries(
        &mut self,
        row: &RotorParameters,
        wanted: &Wanted,
    ) -> Option<Vec<Summary>> {
        let row_is_plain = self.is_plain(row);
        let block = self.blocks.get(self.current)?;
        let points = block.points(row, &self.inputs);
        if !(row_is_plain && block.all_are_plain && widths::all_have_regions(points)) {
            return None;
        }
        let (places, widths) = self.staged.as_mut()?;
        let mut found = widths.summaries(points, &block.tables, wanted)?.map(Some);
        let of_quantity = |place| {
            let width = places.iter().position(|known| *known == Some(place))?;
            found[width]
                .take()
                .filter(|width| width.extremes.are_sizes())
        };
        (0..self.quantities.len()).map(of_quantity).collect()
    }

    /// Whether the inputs of a row are plain, but for those that vary.
    fn is_plain(&mut self, row: &RotorParameters) -> bool {
        if let Some((last, is_plain)) = &self.last
            && last == row
        {
            return *is_plain;
        }
        let mut fixed = INPUTS.iter().filter(|input| !self.inputs.contains(input));
        let is_plain = fixed.all(|input| Sizes::of(input).contain((input.get)(row)));
        self.last = Some((*row, is_plain));
        is_plain
    }

    /// Evaluates point by point what is not known.
    fn rest(
        &self,
        row: &RotorParameters,
        speed: Option<f64>,
        results: &mut [&mut [f64]],
    ) -> Evaluated {
        let mut evaluated = Evaluated::COMPLETE;
        for (point, known) in self.known.iter().enumerate() {
            if !(*known && self.open.is_empty()) {
                evaluated.is_complete = false;
                evaluated.no_rotor += u64::from(!self.point(row, speed, point, results));
            }
        }
        evaluated
    }

    /// Evaluates what is not known at one point; whether it is a rotor.
    fn point(
        &self,
        row: &RotorParameters,
        mut speed: Option<f64>,
        point: usize,
        results: &mut [&mut [f64]],
    ) -> bool {
        let mut parameters = *row;
        if let Some(block) = self.blocks.get(self.current) {
            for (input, values) in self.inputs.iter().zip(&block.values) {
                (input.set)(&mut parameters, values[point]);
            }
            speed = block
                .speeds
                .as_ref()
                .map_or(speed, |speeds| Some(speeds[point]));
        }
        let Ok(rotor) = Rotor::new(parameters) else {
            for result in results.iter_mut() {
                result[point] = f64::NAN;
            }
            return false;
        };
        let unknown = if self.known[point] {
            self.open.as_slice()
        } else {
            self.quantities
        };
        let values = quantity::evaluate_at(unknown, &rotor, speed);
        for (quantity, value) in unknown.iter().zip(values) {
            let places = self.quantities.iter().zip(results.iter_mut());
            for (_, result) in places.filter(|(asked, _)| *asked == quantity) {
                result[point] = number_of(&value);
            }
        }
        true
    }

    /// Evaluates a block in which the speed alone varies: what the rotor has at all speeds is computed once.
    fn along_speeds(&self, row: &RotorParameters, results: &mut [&mut [f64]]) -> Evaluated {
        let block = self.blocks.get(self.current);
        let speeds = block
            .and_then(|block| block.speeds.as_deref())
            .unwrap_or_default();
        let rotor = Rotor::new(*row);
        let shared = rotor.as_ref().map(Shared::new);
        for (quantity, result) in self.quantities.iter().zip(results) {
            if !quantity.needs_speed() {
                let value = shared.as_ref().map(|shared| shared.get(*quantity, None));
                result.fill(value.map_or(f64::NAN, |value| number_of(&value)));
                continue;
            }
            for (result, speed) in result.iter_mut().zip(speeds) {
                let value = shared
                    .as_ref()
                    .map(|shared| shared.get(*quantity, Some(*speed)));
                *result = value.map_or(f64::NAN, |value| number_of(&value));
            }
        }
        Evaluated {
            no_rotor: if rotor.is_ok() {
                0
            } else {
                speeds.len() as u64
            },
            is_complete: false,
        }
    }
}

/// A quantity among others of its kind; a zero has no sign.
fn number_of(value: &Result<f64, Reason>) -> f64 {
    value.as_ref().map_or(f64::NAN, |value| value + 0.0)
}

/// The slices of the widths of the simple and of the combination region, where they are asked for.
fn widths_of<'a>(
    places: [Option<usize>; 2],
    results: &'a mut [&mut [f64]],
) -> [Option<&'a mut [f64]>; 2] {
    let mut wanted = [None, None];
    for (place, result) in results.iter_mut().enumerate() {
        if let Some(width) = places.iter().position(|known| *known == Some(place)) {
            wanted[width] = Some(&mut **result);
        }
    }
    wanted
}

/// The values of an input that are allowed, and of a size with which nothing leaves the range of numbers on the way to a
/// quantity: from a tenth of a millimetre, or a gramme in a billion, to a thousand times what there is.
struct Sizes {
    allowed: RangeInclusive<f64>,
    above: f64,
    below: f64,
    /// Whether zero is a size too.
    with_zero: bool,
}

impl Sizes {
    fn of(input: &NumericInput) -> Self {
        const LARGEST: f64 = 1e12;
        let (above, below, with_zero) = match input.name {
            "crack_angle" | "shaft_poissons_ratio" => (0.0, f64::INFINITY, true),
            "crack_depth_ratio" | "disk_asymmetry" => (1e-9, f64::INFINITY, true),
            "disk_position_ratio" | "crack_position_ratio" => (1e-4, 1.0 - 1e-4, false),
            name if widths::INERTIA.contains(&name) => (1e-12, LARGEST, false),
            _ => (1e-4, LARGEST, false),
        };
        Self {
            allowed: input.allowed.range(),
            above,
            below,
            with_zero,
        }
    }

    /// Without branches, so that a list is looked through in packs.
    #[inline]
    fn contain(&self, value: f64) -> bool {
        let size = value.abs();
        let is_between = (size > self.above) & (size < self.below);
        let is_allowed = self.allowed.contains(&value);
        (is_between | ((size == 0.0) & self.with_zero)) & is_allowed
    }
}
