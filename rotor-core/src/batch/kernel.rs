//! The one place where many rotors are evaluated: the points of a scan, the rows of a table.
//!
//! A kernel belongs to what varies within a block and a list of quantities. [`Kernel::enter`] is called once for
//! each block, for what depends on its values alone; then for each row, which is the block with other values of the remaining
//! inputs, [`Kernel::evaluate`] where its numbers are wanted, or [`Kernel::reduce`] where what reductions keep of them is.
//!
//! Both run generated code in packs, equation by equation ([`chain`]) up to the last loop ([`quantities`]), whose numbers go
//! where they are wanted ([`destination`]); what has no closed form is iterated there, point by point ([`iteration`]). Points that
//! this leaves open are computed one by one: those at which a region may not exist, or with inputs far from those of any
//! machine.

#[cfg(test)]
mod tests;

use crate::batch::extremes::Itself;
use crate::batch::statistic::Reducer;
use crate::input::Variable;
use crate::input::{INPUTS, NumericInput, RotorParameters};
use crate::jeffcott::rotor::Rotor;
use crate::quantity::{Quantity, Shared};

use super::chain::{Chain, Needs};
use super::destination::{Columns, Destination, Partial};
use super::list::List;
use super::quantities::{self, AxisTables, Row, Widths};
use super::sizes::Sizes;
use super::stage;

/// The most points of a block.
pub(crate) const POINTS_PER_BLOCK: usize = 4096;

/// The most blocks whose tables are kept, for an axis of as many: rows go through all of them. With a chain each block has
/// more than a megabyte of them, without a tenth of that. The rows of a table are no axis: no block comes again.
const MOST_BLOCKS_WITH_CHAIN: usize = 8;
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
    /// What depends on the values alone, and what on the row too; none where the coefficients are the same at all points.
    tables: AxisTables,
    chain: Option<Chain>,
    asymmetry: List,
    angle: List,
    speed: List,
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
    needs: Needs,
    /// How widths are computed in stages; without, they have the digits that a rotor has alone.
    widths: Option<Widths>,
    variables: Vec<Variable>,
    /// Those that are inputs of the rotor.
    inputs: Vec<&'static NumericInput>,
    /// All others, with what is plain of them.
    fixed: Vec<(&'static NumericInput, Sizes)>,
    /// Where the coefficients are the same at all points: how they come about in a row, whatever the block.
    chain: Option<Chain>,
    /// The blocks that were entered last, and the one that it is about.
    blocks: Vec<Block>,
    current: usize,
    /// How often one was entered.
    entered: u64,
    /// The last row, and whether its inputs are plain.
    last: Option<(RotorParameters, bool)>,
    /// Of a row's points those that are known.
    known: Vec<bool>,
    /// The quantities of a row that is reduced from its columns.
    columns: Vec<Vec<f64>>,
}

impl<'a> Kernel<'a> {
    /// A kernel for a block of a table. Quantities have the digits that they have for each rotor alone.
    pub(crate) fn of_table(
        inputs: impl IntoIterator<Item = &'static NumericInput>,
        quantities: &'a [Quantity],
    ) -> Self {
        let variables = inputs.into_iter().map(Variable::Input).collect();
        Self::new(variables, quantities, None)
    }

    /// A kernel for a block along an axis that has these variables, inside of an axis with those of `next`, if there is one.
    pub(crate) fn along(
        variables: impl IntoIterator<Item = Variable>,
        next: Option<impl IntoIterator<Item = Variable>>,
        quantities: &'a [Quantity],
    ) -> Self {
        let variables: Vec<_> = variables.into_iter().collect();
        let set = |inputs: Vec<&NumericInput>| {
            let names: Vec<_> = inputs.iter().map(|input| input.name).collect();
            stage::inputs(&names)
        };
        let varied = set(inputs_among(&variables));
        let next = next.map(|next| set(inputs_among(&next.into_iter().collect::<Vec<_>>())));
        let widths = quantities::widths_along(quantities, varied, next);
        Self::new(variables, quantities, Some(widths))
    }

    fn new(variables: Vec<Variable>, quantities: &'a [Quantity], widths: Option<Widths>) -> Self {
        let inputs = inputs_among(&variables);
        let names: Vec<_> = inputs.iter().map(|input| input.name).collect();
        let varies = stage::inputs(&names) & stage::inputs_of_coefficients() != 0;
        let fixed = INPUTS.iter().filter(|input| !inputs.contains(input));
        Self {
            quantities,
            needs: quantities::needs(quantities, widths),
            widths,
            variables,
            chain: (!varies).then(|| Chain::new(1, &inputs, None)),
            fixed: fixed.map(|input| (input, Sizes::of(input))).collect(),
            inputs,
            blocks: Vec::new(),
            current: 0,
            entered: 0,
            last: None,
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
        let most = match (&self.chain, self.widths) {
            (_, None) => 1,
            (Some(_), _) => MOST_BLOCKS,
            (None, _) => MOST_BLOCKS_WITH_CHAIN,
        };
        if self.blocks.len() < most {
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

    /// A block with these values of the variables, and what depends on them alone.
    fn block(&self, first: u64, values: Vec<Vec<f64>>) -> Block {
        let length = values.first().map_or(0, Vec::len);
        let mut plain = vec![true; length];
        let (mut asymmetry, mut angle, mut speed) = Default::default();
        let mut of_inputs = Vec::new();
        for (variable, values) in self.variables.iter().zip(&values) {
            let Variable::Input(input) = variable else {
                speed = List::of(values.clone());
                continue;
            };
            match input.name {
                "disk_asymmetry" => asymmetry = List::of(values.clone()),
                "crack_angle" => angle = List::of(values.clone()),
                _ => {}
            }
            let sizes = Sizes::of(input);
            for (plain, value) in plain.iter_mut().zip(values) {
                *plain &= sizes.contain(*value);
            }
            of_inputs.push(values.as_slice());
        }
        let names: Vec<_> = self.inputs.iter().map(|input| input.name).collect();
        let chain = self.chain.is_none();
        let chain = chain.then(|| Chain::new(length, &self.inputs, Some(&of_inputs)));
        Block {
            first,
            entered: self.entered,
            all_are_plain: plain.iter().all(|plain| *plain),
            plain,
            tables: match self.widths {
                Some(_) => AxisTables::along(&names, &of_inputs),
                None => AxisTables::None,
            },
            chain,
            asymmetry,
            angle,
            speed,
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
        let (quantities, needs, widths) = (self.quantities, self.needs, self.widths);
        let mut known = std::mem::take(&mut self.known);
        known.clear();
        let evaluated = self.row(row, speed).and_then(|(mut points, plain)| {
            known.extend_from_slice(plain);
            let all = points.chain.trust(needs, &mut known)?;
            if needs.iteration && !all {
                return None;
            }
            let mut columns = Columns {
                results,
                known: &mut known,
                all_are_known: all,
                has_gaps: false,
            };
            match widths {
                Some(widths) => points.evaluate(quantities, widths, &mut columns)?,
                None => points.evaluate_alone(quantities, &mut columns)?,
            }
            Some((columns.all_are_known, !columns.has_gaps))
        });
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
            let reduced = reducer.single::<Itself, Partial, 0, 1>(place, &[], [column]);
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
        if !self.all_are_plain() {
            return None;
        }
        let (quantities, needs, widths) = (self.quantities, self.needs, self.widths?);
        let (mut points, _) = self.row(row, speed)?;
        if !points.chain.trust(needs, &mut [])? {
            return None;
        }
        begin(reducer);
        points.evaluate(quantities, widths, reducer)
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

    /// The points of the block in a row, and which are plain. None where the row is not.
    fn row(&mut self, row: &RotorParameters, speed: Option<f64>) -> Option<(Row<'_>, &[bool])> {
        if !self.is_plain(row) {
            return None;
        }
        let block = self.blocks.get_mut(self.current)?;
        let chain = block.chain.as_mut().or(self.chain.as_mut())?;
        chain.update(row);
        for (list, number) in [
            (&mut block.asymmetry, row.disk_asymmetry),
            (&mut block.angle, row.crack_angle),
        ] {
            if list.is_same() {
                list.set(number);
            }
        }
        if let Some(speed) = speed.filter(|_| block.speed.is_same()) {
            block.speed.set(speed);
        }
        let points = Row {
            chain,
            tables: &block.tables,
            asymmetry: &mut block.asymmetry,
            angle: &mut block.angle,
            speed: &mut block.speed,
            any: block.values.first()?,
        };
        Some((points, &block.plain))
    }

    /// Whether the inputs of a row are plain, but for those that vary.
    fn is_plain(&mut self, row: &RotorParameters) -> bool {
        if let Some((last, is_plain)) = &self.last
            && last == row
        {
            return *is_plain;
        }
        let mut fixed = self.fixed.iter();
        let is_plain = fixed.all(|(input, sizes)| sizes.contain((input.get)(row)));
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
        let mut no_rotor = 0;
        // Where the speed alone varies, all points are of one rotor.
        let rotor = Rotor::new(*row).ok().filter(|_| self.inputs.is_empty());
        let of_all = rotor.as_ref().map(Shared::new);
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
            let alone = rotor.as_ref().ok().map(Shared::new);
            for (quantity, result) in self.quantities.iter().zip(results.iter_mut()) {
                let value = of_all.as_ref().or(alone.as_ref());
                let value = value.and_then(|shared| shared.get(*quantity, speed).ok());
                // A zero has no sign.
                result[point] = value.map_or(f64::NAN, |value| value + 0.0);
            }
        }
        Evaluated {
            no_rotor,
            is_complete: false,
        }
    }
}

/// Those of the variables that are inputs of the rotor.
fn inputs_among(variables: &[Variable]) -> Vec<&'static NumericInput> {
    let inputs = variables.iter().filter_map(|variable| match variable {
        Variable::Input(input) => Some(*input),
        Variable::Speed => None,
    });
    inputs.collect()
}
