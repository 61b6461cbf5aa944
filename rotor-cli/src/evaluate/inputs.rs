//! The inputs of some rows as columns of numbers, and what is computed from them at once.

use std::borrow::Cow;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, RecordBatch};
use arrow_schema::DataType;
use rotor_core::error::Error;
use rotor_core::input::{NumericInput, RotorParameters};
use rotor_core::quantity::Quantity;
use rotor_core::study;
use rotor_core::study::table::{self, Column};
use rotor_core::warning::{is_doubtful, is_watched};

use super::columns::Columns;
use super::source::{Piece, Read, text};

/// The inputs of some rows.
pub(super) struct Inputs<'a> {
    numbers: Vec<(&'static NumericInput, Cow<'a, [f64]>)>,
    /// The rotors that differ in what is no number.
    bases: Vec<RotorParameters>,
    /// Which of them each row is like; none of a row that cannot be read.
    base_of: Vec<Option<usize>>,
}

impl<'a> Inputs<'a> {
    /// The inputs of a piece; those without a column are the base rotor's.
    pub(super) fn of(piece: &'a Piece, columns: &Columns, base: &RotorParameters) -> Self {
        let mut inputs = match piece {
            Piece::Rows(rows) => Self::of_rows(rows, columns, base),
            Piece::Batch { batch, .. } => Self::of_batch(batch, columns, base),
        };
        if inputs.numbers.is_empty() {
            // A table of rotors has a column: here one with the same number in every row.
            let input = NumericInput::find("crack_angle");
            let column =
                input.map(|input| (input, vec![(input.get)(base); inputs.base_of.len()].into()));
            inputs.numbers.extend(column);
        }
        inputs
    }

    fn of_rows(rows: &[Read], columns: &Columns, base: &RotorParameters) -> Self {
        let numbers = columns.numbers();
        let numbers = numbers.map(|(_, input)| (input, Vec::with_capacity(rows.len())));
        let mut numbers: Vec<_> = numbers.collect();
        let mut inputs = Self::new(base);
        for Read { row, broken } in rows {
            let readable = broken.is_none();
            let parameters = readable.then(|| columns.parameters(row, base).ok());
            let parameters = parameters.flatten();
            for (input, values) in &mut numbers {
                values.push(parameters.map_or(f64::NAN, |p| (input.get)(&p)));
            }
            inputs.add_row(parameters.as_ref());
        }
        let numbers = numbers.into_iter();
        inputs.numbers = numbers
            .map(|(input, values)| (input, values.into()))
            .collect();
        inputs
    }

    fn of_batch(batch: &'a RecordBatch, columns: &Columns, base: &RotorParameters) -> Self {
        let numbers = columns
            .numbers()
            .map(|(index, input)| (input, numbers(batch.column(index))));
        let mut inputs = Self::new(base);
        inputs.numbers = numbers.collect();
        let choices: Vec<_> = columns.choices().collect();
        if choices.is_empty() {
            inputs.base_of = vec![Some(0); batch.num_rows()];
            return inputs;
        }
        for row in 0..batch.num_rows() {
            let mut parameters = *base;
            let readable = choices.iter().all(|&(index, name)| {
                let cell = text(batch.column(index), row).unwrap_or_default();
                parameters.set_choice(name, cell.trim()).is_ok()
            });
            inputs.add_row(Some(&parameters).filter(|_| readable));
        }
        inputs
    }

    fn new(base: &RotorParameters) -> Self {
        Self {
            numbers: Vec::new(),
            bases: vec![*base],
            base_of: Vec::new(),
        }
    }

    fn add_row(&mut self, parameters: Option<&RotorParameters>) {
        let base = parameters.map(|parameters| {
            let like = |base: &RotorParameters| {
                base.crack_model == parameters.crack_model
                    && base.crack_edge == parameters.crack_edge
            };
            let known = self.bases.iter().position(like);
            known.unwrap_or_else(|| {
                self.bases.push(*parameters);
                self.bases.len() - 1
            })
        });
        self.base_of.push(base);
    }

    /// How many rows there are.
    pub(super) const fn len(&self) -> usize {
        self.base_of.len()
    }

    /// The rows about whose rotors there is a doubt, as far as they can be read.
    pub(super) fn doubtful(&self) -> impl Iterator<Item = usize> {
        let columns = self.numbers.iter();
        let columns = columns.filter(|(input, _)| is_watched(input));
        let columns: Vec<_> = columns.collect();
        (0..self.len()).filter(move |&row| {
            let mut parameters = self.bases[self.base_of[row].unwrap_or(0)];
            for (input, values) in &columns {
                (input.set)(&mut parameters, values[row]);
            }
            is_doubtful(&parameters)
        })
    }

    /// Evaluates all rows: for each quantity a column, NaN where a rotor has none or a row is none.
    pub(super) fn evaluate(&self, quantities: &[Quantity]) -> Result<Vec<Vec<f64>>, Error> {
        if self.base_of.iter().all(|base| *base == Some(0)) {
            let columns = self.numbers.iter();
            let columns = columns.map(|(input, values)| Column { input, values });
            let found = table::evaluate(&self.bases[0], &columns.collect::<Vec<_>>(), quantities)?;
            let columns = (0..quantities.len()).map(|quantity| found.column(quantity));
            return Ok(columns.map(|column| marked(column).collect()).collect());
        }
        let mut results = vec![vec![f64::NAN; self.len()]; quantities.len()];
        for (number, base) in self.bases.iter().enumerate() {
            let rows = (0..self.len()).filter(|row| self.base_of[*row] == Some(number));
            let rows: Vec<usize> = rows.collect();
            let gathered = self.numbers.iter().map(|(input, values)| {
                let values: Vec<f64> = rows.iter().map(|row| values[*row]).collect();
                (*input, values)
            });
            let gathered: Vec<_> = gathered.collect();
            let columns = gathered
                .iter()
                .map(|(input, values)| Column { input, values });
            let found = table::evaluate(base, &columns.collect::<Vec<_>>(), quantities)?;
            for (quantity, result) in results.iter_mut().enumerate() {
                for (row, value) in rows.iter().zip(marked(found.column(quantity))) {
                    result[*row] = value;
                }
            }
        }
        Ok(results)
    }
}

/// The values of a column of results, NaN where there is none.
fn marked(column: study::Column<'_>) -> impl Iterator<Item = f64> + '_ {
    column.iter().map(|value| value.unwrap_or(f64::NAN))
}

/// The numbers of a column, NaN where there is none.
fn numbers(column: &dyn Array) -> Cow<'_, [f64]> {
    if column.data_type() == &DataType::Float64 && column.null_count() == 0 {
        return column
            .as_primitive::<Float64Type>()
            .values()
            .as_ref()
            .into();
    }
    let number = |row| text(column, row)?.trim().parse().ok();
    let numbers = (0..column.len()).map(|row| number(row).unwrap_or(f64::NAN));
    numbers.collect()
}
