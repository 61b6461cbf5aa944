//! The one place where many rotors are evaluated: the points of a scan, the rows of a table.
//!
//! [`Kernel::enter`] is called once for each block, for what depends on its values alone; then for each row, which is the block
//! with other values of the remaining inputs, [`Kernel::evaluate`] where its numbers are wanted, or [`Kernel::reduce`] where what
//! reductions keep of them is. Points that the packs leave open are computed one by one: those at which a region may not exist, or
//! with inputs far from those of any machine.

#[cfg(test)]
mod tests;

use crate::batch::extremes::Itself;
use crate::batch::statistic::{Reducer, WithGaps};
use crate::equations::chain::Column;
use crate::input::{NumericInput, RotorParameters, Variable};
use crate::jeffcott::rotor::Rotor;
use crate::quantity::Quantity;

use super::destination::{Columns, Destination, PARTIAL};
use super::evaluation::Evaluation;
use super::list::List;
use super::numbers::{Numbers, Points, Trust};
use super::one_rotor::OneRotor;
use super::plan::{Digits, Plan, Varied};
use super::row::{self, Row};

/// The most points of a block.
pub(crate) const POINTS_PER_BLOCK: usize = 4096;

/// The most blocks whose tables are kept, for an axis of as many: rows go through all of them. Where stages of the chain vary along
/// a block it has more than a megabyte of numbers, and a tenth of that otherwise. The rows of a table are no axis: no block comes
/// again.
const MOST_BLOCKS_WITH_STAGES: usize = 8;
const MOST_BLOCKS: usize = 96;

/// Points that have the same values in every row.
struct Block {
    /// Its first point on the axis.
    first: u64,
    /// When it was entered last.
    entered: u64,
    /// The values of each variable.
    values: Vec<Vec<f64>>,
    /// The points of plain values, and whether that is all of them.
    plain: Vec<bool>,
    all_are_plain: bool,
    numbers: Numbers,
    speed: List,
    /// The points whose polar inertia a rigid body may have, and the update of the row for which that was found.
    inertia: Trust,
    inertia_of: Option<u64>,
}

/// What came of a row of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evaluated {
    /// How many points are no rotor.
    pub(crate) no_rotor: u64,
    /// Whether it is certain that every point has every quantity.
    pub(crate) is_complete: bool,
}

/// Evaluates quantities of blocks of rotors.
pub(crate) struct Kernel<'a> {
    quantities: &'a [Quantity],
    plan: Plan,
    digits: Digits,
    variables: Vec<Variable>,
    /// The inputs of the rotor among the variables.
    inputs: Vec<&'static NumericInput>,
    /// These inputs as a set, a bit for each.
    varied: u64,
    row: Row,
    /// What is the same at all points of a row, whatever the block.
    of_row: Numbers,
    /// The blocks that were entered last, and the place of the current one.
    blocks: Vec<Block>,
    current: usize,
    /// How often a block was entered.
    entered: u64,
    /// For each point of the row, whether its quantities are known.
    known: Vec<bool>,
    /// The quantities of a row that is reduced from its columns.
    columns: Vec<Vec<f64>>,
}

impl<'a> Kernel<'a> {
    /// Creates a kernel for a block of a table. Quantities have the digits that they have for each rotor alone.
    pub(crate) fn of_table(
        inputs: impl IntoIterator<Item = &'static NumericInput>,
        quantities: &'a [Quantity],
    ) -> Self {
        let variables = inputs.into_iter().map(Variable::Input).collect();
        Self::new(variables, u64::MAX, quantities, Digits::OfOneRotor)
    }

    /// Creates a kernel for a block along an axis that has these variables, inside of an axis with those of `next`, if there is
    /// one.
    pub(crate) fn along(
        variables: impl IntoIterator<Item = Variable>,
        next: Option<impl IntoIterator<Item = Variable>>,
        quantities: &'a [Quantity],
    ) -> Self {
        let next = next.map(|next| {
            let next: Vec<_> = next.into_iter().collect();
            row::set(inputs_among(&next))
        });
        let variables = variables.into_iter().collect();
        Self::new(
            variables,
            next.unwrap_or(u64::MAX),
            quantities,
            Digits::OfStages,
        )
    }

    fn new(
        variables: Vec<Variable>,
        next: u64,
        quantities: &'a [Quantity],
        digits: Digits,
    ) -> Self {
        let inputs = inputs_among(&variables);
        let block = row::set(inputs.iter().copied());
        Self {
            quantities,
            plan: Plan::of(quantities, Varied { block, next }, digits),
            digits,
            variables,
            inputs,
            varied: block,
            row: Row::new(block),
            of_row: Numbers::new(1, []),
            blocks: Vec::new(),
            current: 0,
            entered: 0,
            known: Vec::new(),
            columns: Vec::new(),
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
        let mut values = vec![vec![f64::NAN; length]; self.variables.len()];
        for (number, values) in values.iter_mut().enumerate() {
            fill(number, values);
        }
        let block = self.block(first, values);
        let stages_vary = self
            .plan
            .stages
            .iter()
            .any(|stage| stage.inputs() & self.varied != 0);
        let most = match self.digits {
            Digits::OfOneRotor => 1,
            Digits::OfStages if stages_vary => MOST_BLOCKS_WITH_STAGES,
            Digits::OfStages => MOST_BLOCKS,
        };
        if self.blocks.len() < most {
            self.current = self.blocks.len();
            self.blocks.push(block);
            return;
        }
        // The block that was entered longest ago makes room.
        let places = self.blocks.iter_mut().enumerate();
        if let Some((oldest, place)) = places.min_by_key(|(_, block)| block.entered) {
            self.current = oldest;
            *place = block;
        }
    }

    /// A block with these values of the variables, and what depends on them alone.
    fn block(&self, first: u64, values: Vec<Vec<f64>>) -> Block {
        let length = values.first().map_or(0, Vec::len);
        let mut plain = vec![true; length];
        let mut speed = List::default();
        let mut columns = Vec::new();
        for (variable, values) in self.variables.iter().zip(&values) {
            let Variable::Input(input) = variable else {
                speed = List::of(values.clone());
                continue;
            };
            for (plain, value) in plain.iter_mut().zip(values) {
                *plain &= input.is_of_a_machine(*value);
            }
            columns.extend(row::column_of(input).map(|column| (column, values.clone())));
        }
        Block {
            first,
            entered: self.entered,
            all_are_plain: plain.iter().all(|plain| *plain),
            plain,
            numbers: Numbers::new(length, columns),
            speed,
            inertia: Trust::default(),
            inertia_of: None,
            values,
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
        let mut known = std::mem::take(&mut self.known);
        let evaluated = self.evaluate_in_packs(row, speed, &mut known, results);
        let (all_are_known, is_complete) = evaluated.unwrap_or_default();
        if evaluated.is_none() {
            known.clear();
            known.resize(self.length(), false);
        }
        self.known = known;
        if all_are_known && self.all_are_plain() {
            let no_rotor = 0;
            return Evaluated {
                no_rotor,
                is_complete,
            };
        }
        self.rest(row, speed, results)
    }

    /// Whether all points are known, and whether each has every quantity. None where packs cannot evaluate them.
    fn evaluate_in_packs(
        &mut self,
        row: &RotorParameters,
        speed: Option<f64>,
        known: &mut Vec<bool>,
        results: &mut [&mut [f64]],
    ) -> Option<(bool, bool)> {
        let quantities = self.quantities;
        let (mut evaluation, plan, plain) = self.begin(row, speed)?;
        known.clear();
        known.extend_from_slice(plain);
        let all = evaluation.trust(plan, known);
        if plan.iteration && !all {
            return None;
        }
        let mut columns = Columns {
            results,
            known,
            all_are_known: all,
            has_gaps: false,
        };
        evaluation.run(quantities, &plan.ways, &mut columns)?;
        Some((columns.all_are_known, !columns.has_gaps))
    }

    /// Reduces the quantities of the block for the rotors of a row, as [`Kernel::evaluate`] has them; how many points are no
    /// rotor. `begin` gives the reducer what was kept before, again where what was begun had to be given up.
    pub(crate) fn reduce(
        &mut self,
        row: &RotorParameters,
        speed: Option<f64>,
        reducer: &mut Reducer,
        begin: impl Fn(&mut Reducer),
    ) -> u64 {
        if self.reduce_in_packs(row, speed, reducer, &begin).is_some() {
            return 0;
        }
        begin(reducer);
        let mut columns = std::mem::take(&mut self.columns);
        columns.resize_with(self.quantities.len(), Vec::new);
        for column in &mut columns {
            column.resize(self.length(), f64::NAN);
        }
        let mut results: Vec<_> = columns.iter_mut().map(Vec::as_mut_slice).collect();
        let evaluated = self.evaluate(row, speed, &mut results);
        for (place, column) in columns.iter().enumerate() {
            let reduced =
                reducer.take::<Itself, WithGaps, 0, 1, 1>([Some(place)], PARTIAL, &[], [column]);
            debug_assert!(reduced.is_some(), "a column has the length of itself");
        }
        self.columns = columns;
        evaluated.no_rotor
    }

    /// Reduces where the numbers arise. None, perhaps with something begun, where not all points are known.
    fn reduce_in_packs(
        &mut self,
        row: &RotorParameters,
        speed: Option<f64>,
        reducer: &mut Reducer,
        begin: impl Fn(&mut Reducer),
    ) -> Option<()> {
        if !self.all_are_plain() || self.digits == Digits::OfOneRotor {
            return None;
        }
        let quantities = self.quantities;
        let (mut evaluation, plan, _) = self.begin(row, speed)?;
        if !evaluation.trust(plan, &mut []) {
            return None;
        }
        begin(reducer);
        evaluation.run(quantities, &plan.ways, reducer)
    }

    fn length(&self) -> usize {
        self.blocks
            .get(self.current)
            .map_or(0, |block| block.plain.len())
    }

    fn all_are_plain(&self) -> bool {
        self.blocks
            .get(self.current)
            .is_some_and(|block| block.all_are_plain)
    }

    /// The points of the block in a row with their stages computed, and which are plain. None where the row is not.
    fn begin(
        &mut self,
        row: &RotorParameters,
        speed: Option<f64>,
    ) -> Option<(Evaluation<'_>, &Plan, &[bool])> {
        self.row.update(row);
        if !self.row.is_plain() {
            return None;
        }
        let block = self.blocks.get_mut(self.current)?;
        if let Some(speed) = speed.filter(|_| block.speed.is_same()) {
            block.speed.set(speed);
        }
        let mut points = Points {
            row: &self.row,
            of_row: &mut self.of_row,
            of_block: &mut block.numbers,
            varied: self.varied,
        };
        points.compute(&self.plan.stages)?;
        let inertias = Column::DiskPolarInertia.inputs() | Column::DiskDiametralInertia.inputs();
        let changed = points.row.changed(inertias);
        if block.inertia_of.is_none_or(|update| update < changed) {
            points.trust_inertia(self.plan.inertia_ratio_limit, &mut block.inertia);
            block.inertia_of = Some(self.row.updates());
        }
        let evaluation = Evaluation {
            points,
            inertia: &block.inertia,
            speed: &mut block.speed,
            counted: block.values.first()?,
        };
        Some((evaluation, &self.plan, &block.plain))
    }

    /// Evaluates point by point what is not known.
    fn rest(
        &self,
        row: &RotorParameters,
        speed: Option<f64>,
        results: &mut [&mut [f64]],
    ) -> Evaluated {
        let mut no_rotor = 0;
        // Where the speed alone varies, all points are of one rotor.
        let rotor = Rotor::new(*row).ok().filter(|_| self.inputs.is_empty());
        let of_all = rotor.as_ref().map(OneRotor::new);
        for (point, known) in self.known.iter().enumerate() {
            if *known {
                continue;
            }
            let (mut parameters, mut speed) = (*row, speed);
            if let Some(block) = self.blocks.get(self.current) {
                for (variable, values) in self.variables.iter().zip(&block.values) {
                    variable.set(&mut parameters, &mut speed, values[point]);
                }
            }
            let rotor = Rotor::new(parameters);
            no_rotor += u64::from(rotor.is_err());
            let alone = rotor.as_ref().ok().map(OneRotor::new);
            for (quantity, result) in self.quantities.iter().zip(results.iter_mut()) {
                let value = of_all.as_ref().or(alone.as_ref());
                let value = value.and_then(|shared| shared.get(*quantity, speed).ok());
                result[point] = value.unwrap_or(f64::NAN);
            }
        }
        Evaluated {
            no_rotor,
            is_complete: false,
        }
    }
}

/// The inputs of the rotor among the variables.
fn inputs_among(variables: &[Variable]) -> Vec<&'static NumericInput> {
    let inputs = variables.iter().filter_map(|variable| match variable {
        Variable::Input(input) => Some(*input),
        Variable::Speed => None,
    });
    inputs.collect()
}
