//! The inputs of a row: what all points of a block share, and when each of it changed last.

use crate::equations::chain::{Column, Stage};
use crate::input::{INPUTS, NumericInput, RotorParameters, place_of};

use super::stages::{alternatives, own};

/// The place in [`INPUTS`] of what is in each of the chain's first columns; none for what is no number of its own, as the edge's factor.
const PLACES: [Option<usize>; Column::INPUTS] = {
    let mut places = [None; Column::INPUTS];
    let mut column = 0;
    while column < places.len() {
        places[column] = place_of(Column::ALL[column].name());
        column += 1;
    }
    places
};

/// Every input has a column: what [`Row::is_plain`] says holds for all of them.
const _: () = {
    let (mut place, mut inputs) = (0, 0);
    while place < PLACES.len() {
        inputs += PLACES[place].is_some() as usize;
        place += 1;
    }
    assert!(inputs == INPUTS.len());
};

/// The column of an input, if anything depends on it.
pub(super) fn column_of(input: &NumericInput) -> Option<Column> {
    let place = INPUTS.iter().position(|other| other == input);
    let column = PLACES
        .iter()
        .position(|own| own.is_some() && *own == place)?;
    Column::ALL.get(column).copied()
}

/// Inputs as a set, bit 0 for the first column of the chain.
pub(super) fn set<'a>(inputs: impl IntoIterator<Item = &'a NumericInput>) -> u64 {
    let columns = inputs.into_iter().filter_map(column_of);
    columns.fold(0, |set, column| set | column.inputs())
}

/// The inputs of a row.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The inputs that vary along a block: those of the row are not looked at.
    varied: u64,
    parameters: Option<RotorParameters>,
    /// How many rows have had other inputs than the row before.
    updates: u64,
    numbers: [f64; Column::INPUTS],
    /// The update with which each number changed last.
    changed: [u64; Column::INPUTS],
    /// The update with which something changed last on which each stage depends.
    renewed: [u64; Stage::ALL.len()],
    /// The inputs whose values no machine has, a bit each.
    unusual: u64,
}

impl Row {
    /// Creates a row without inputs, of which these vary along a block.
    pub(super) const fn new(varied: u64) -> Self {
        Self {
            varied,
            parameters: None,
            updates: 0,
            numbers: [f64::NAN; Column::INPUTS],
            changed: [0; Column::INPUTS],
            renewed: [0; Stage::ALL.len()],
            unusual: 0,
        }
    }

    /// Takes the inputs of another row.
    pub(super) fn update(&mut self, parameters: &RotorParameters) {
        if self.parameters.as_ref() == Some(parameters) {
            return;
        }
        self.updates += 1;
        let mut inputs = 0;
        for (place, input) in PLACES.iter().enumerate() {
            let edge = || parameters.crack_edge.factor();
            let number = input.map_or_else(edge, |input| (INPUTS[input].get)(parameters));
            let varies = self.varied >> place & 1 == 1;
            if !varies && number.to_bits() != self.numbers[place].to_bits() {
                self.numbers[place] = number;
                self.changed[place] = self.updates;
                inputs |= 1 << place;
                let is_plain = input.is_none_or(|input| INPUTS[input].is_of_a_machine(number));
                self.unusual = self.unusual & !(1 << place) | u64::from(!is_plain) << place;
            }
        }
        // Which of the stages that stand for each other is computed, the crack's model decides.
        let model = self.parameters.map(|last| last.crack_model) != Some(parameters.crack_model);
        for (stage, renewed) in Stage::ALL.into_iter().zip(&mut self.renewed) {
            if own(stage).inputs() & inputs != 0 || model && alternatives(stage).len() > 1 {
                *renewed = self.updates;
            }
        }
        self.parameters = Some(*parameters);
    }

    /// Whether the inputs that do not vary along a block have values as machines have them.
    pub(super) const fn is_plain(&self) -> bool {
        self.unusual == 0
    }

    /// The number of an input.
    pub(super) fn number(&self, input: Column) -> f64 {
        self.numbers
            .get(input as usize)
            .copied()
            .unwrap_or(f64::NAN)
    }

    /// The update with which one of these inputs changed last.
    pub(super) fn changed(&self, inputs: u64) -> u64 {
        let changes = self.changed.iter().enumerate();
        let among = changes.filter(|(place, _)| inputs >> place & 1 == 1);
        among.map(|(_, update)| *update).max().unwrap_or_default()
    }

    /// The update with which something changed last on which a stage depends.
    pub(super) const fn renewed(&self, stage: Stage) -> u64 {
        self.renewed[stage as usize]
    }

    /// How many rows have had other inputs than the row before.
    pub(super) const fn updates(&self) -> u64 {
        self.updates
    }

    /// The inputs, of which those that vary are any.
    pub(super) const fn parameters(&self) -> Option<&RotorParameters> {
        self.parameters.as_ref()
    }
}
