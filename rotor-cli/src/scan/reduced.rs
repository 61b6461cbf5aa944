//! The results of reductions: tables for the terminal, and one long table for a file.

use std::collections::HashMap;
use std::io;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field};
use rotor_core::input::Variable;
use rotor_core::study::{Axis, Plan, Reduced, Statistic};

use crate::files::{Format, Layout, number_field, schema};
use crate::table::{Cell, Table};

/// Most rows of a table on the terminal; a file has them all.
const MOST_ROWS: u64 = 40;
/// Digits on the terminal.
const DIGITS: usize = 6;

/// One table for each reduction.
pub(super) fn tables(plan: &Plan, reduced: &[Reduced]) -> Vec<Table> {
    reduced.iter().map(|reduced| table(plan, reduced)).collect()
}

/// A number that an input, a bin or a statistic has.
fn number(value: Option<f64>) -> Cell {
    value.map_or_else(Cell::empty, |value| Cell::number(value, DIGITS))
}

/// A count, which has all its digits.
fn count(value: f64) -> Cell {
    Cell::Number(format!("{value}"))
}

fn table(plan: &Plan, reduced: &Reduced) -> Table {
    let space = plan.space();
    let statistic = reduced.reduction().statistic();
    let mut headings: Vec<&'static str> = Vec::new();
    for axis in reduced.kept() {
        headings.extend(space.axes()[axis].variables().map(Variable::name));
    }
    let histogram = matches!(statistic, Statistic::Histogram { .. });
    if histogram {
        headings.extend(["from", "to"]);
    }
    for quantity in plan.quantities() {
        headings.push(quantity.name());
        if statistic.locates() {
            headings.extend(reduced_inputs(plan, reduced).map(|(_, _, name)| name));
        }
    }
    let mut rows = Vec::new();
    let mut all = 0;
    for group in 0..reduced.groups() {
        let mut of_group: Vec<Vec<Cell>> = Vec::new();
        if histogram {
            of_group.extend(bins(plan, reduced, group));
        } else {
            of_group.push(statistics(plan, reduced, group));
        }
        all += of_group.len() as u64;
        let room = MOST_ROWS.saturating_sub(rows.len() as u64) as usize;
        let kept = kept_cells(plan, reduced, group);
        rows.extend(
            of_group
                .into_iter()
                .take(room)
                .map(|row| [kept.clone(), row].concat()),
        );
    }
    let mut notes = Vec::new();
    if all > MOST_ROWS {
        notes.push(format!(
            "The first {MOST_ROWS} of {all} rows; a file (-o) has them all."
        ));
    }
    Table {
        title: format!("{} of {} points", reduced.reduction(), space.len()),
        headings,
        rows,
        notes,
    }
}

/// The inputs of the axes that are reduced: axis, column, name.
fn reduced_inputs<'a>(
    plan: &'a Plan,
    reduced: &Reduced,
) -> impl Iterator<Item = (usize, usize, &'static str)> + use<'a> {
    let kept = reduced.kept();
    let axes = plan.space().axes().iter().enumerate();
    axes.filter(move |(number, _)| !kept.contains(number))
        .flat_map(|(number, axis)| {
            let inputs = axis.variables().enumerate();
            inputs.map(move |(column, variable)| (number, column, variable.name()))
        })
}

fn kept_cells(plan: &Plan, reduced: &Reduced, group: u64) -> Vec<Cell> {
    let mut cells = Vec::new();
    for number_of_axis in reduced.kept() {
        let axis = &plan.space().axes()[number_of_axis];
        let index = reduced
            .index(plan.space(), number_of_axis, group)
            .unwrap_or(0);
        cells.extend(
            (0..axis.variables().len()).map(|column| number(Some(axis.value(column, index)))),
        );
    }
    cells
}

/// The row of a group: for each quantity its value, and where that lies.
fn statistics(plan: &Plan, reduced: &Reduced, group: u64) -> Vec<Cell> {
    let statistic = reduced.reduction().statistic();
    let mut cells = Vec::new();
    for quantity in 0..plan.quantities().len() {
        let value = reduced.value(quantity, group);
        cells.push(match (statistic, value) {
            (Statistic::CountAbove(_), Some(value)) => count(value),
            _ => number(value),
        });
        if statistic.locates() {
            let point = reduced.point(quantity, group);
            let places = reduced_inputs(plan, reduced).map(|(axis, column, _)| {
                number(point.map(|point| place(plan, axis, column, point)))
            });
            cells.extend(places);
        }
    }
    cells
}

/// The value of an input at a point.
fn place(plan: &Plan, axis: usize, column: usize, point: u64) -> f64 {
    let index = plan.space().index(axis, point);
    plan.space()
        .axes()
        .get(axis)
        .map_or(f64::NAN, |axis| axis.value(column, index))
}

/// The rows of a group's histogram.
fn bins(plan: &Plan, reduced: &Reduced, group: u64) -> Vec<Vec<Cell>> {
    let ends = bin_ends(reduced.reduction().statistic());
    let counts: Vec<_> = (0..plan.quantities().len())
        .map(|quantity| reduced.histogram(quantity, group))
        .collect();
    let row = |(bin, (low, high)): (usize, (Option<f64>, Option<f64>))| {
        let counts = counts.iter().map(|counts| count(counts[bin] as f64));
        [number(low), number(high)]
            .into_iter()
            .chain(counts)
            .collect()
    };
    ends.into_iter().enumerate().map(row).collect()
}

/// Both ends of each cell of a histogram: below all bins, each bin, above all bins.
fn bin_ends(statistic: &Statistic) -> Vec<(Option<f64>, Option<f64>)> {
    let ends = statistic.bin_ends();
    let (Some(low), Some(high)) = (ends.first(), ends.last()) else {
        return Vec::new();
    };
    let within = ends.windows(2).map(|ends| (Some(ends[0]), Some(ends[1])));
    let below = std::iter::once((None, Some(*low)));
    let above = std::iter::once((Some(*high), None));
    below.chain(within).chain(above).collect()
}

/// The long table: one row for each reduction, quantity, group and bin.
#[derive(Default)]
struct Long {
    reductions: Vec<String>,
    quantities: Vec<&'static str>,
    /// The inputs that vary: a group's values, the place of a maximum, null where reduced.
    inputs: Vec<Vec<Option<f64>>>,
    bins: [Vec<Option<f64>>; 2],
    values: Vec<Option<f64>>,
}

impl Long {
    fn push(&mut self, plan: &Plan, reduced: &Reduced, quantity: usize, group: u64) {
        let point = reduced.point(quantity, group);
        let ends = bin_ends(reduced.reduction().statistic());
        let values: Vec<_> = if ends.is_empty() {
            vec![((None, None), reduced.value(quantity, group))]
        } else {
            let counts = reduced.histogram(quantity, group);
            let counts = counts.into_iter().map(|count| Some(count as f64));
            ends.into_iter().zip(counts).collect()
        };
        for ((low, high), value) in values {
            self.reductions.push(reduced.reduction().to_string());
            self.quantities.push(plan.quantities()[quantity].name());
            let columns = plan
                .space()
                .axes()
                .iter()
                .enumerate()
                .flat_map(|(number, axis)| {
                    let index = reduced
                        .index(plan.space(), number, group)
                        .or_else(|| point.map(|point| plan.space().index(number, point)));
                    (0..axis.variables().len())
                        .map(move |column| index.map(|index| axis.value(column, index)))
                });
            for (values, value) in self.inputs.iter_mut().zip(columns) {
                values.push(value);
            }
            self.bins[0].push(low);
            self.bins[1].push(high);
            self.values.push(value);
        }
    }
}

/// The columns of the long table.
fn long_fields(inputs: &[Variable]) -> Vec<Field> {
    let mut fields = vec![
        Field::new("reduction", DataType::Utf8, false),
        Field::new("quantity", DataType::Utf8, false),
    ];
    fields.extend(inputs.iter().map(|input| {
        let about = (input.symbol(), input.unit(), input.description());
        number_field(input.name(), true, about)
    }));
    for (name, description) in [
        ("bin_from", "lower end of a histogram's bin"),
        ("bin_to", "upper end of a histogram's bin"),
        ("value", "in the quantity's unit, or a count"),
    ] {
        let field = Field::new(name, DataType::Float64, true);
        let metadata = HashMap::from([("description".to_owned(), description.to_owned())]);
        fields.push(field.with_metadata(metadata));
    }
    fields
}

/// The long table for a file.
///
/// # Errors
///
/// Where its columns do not fit together, which they do.
pub(super) fn long(
    plan: &Plan,
    reduced: &[Reduced],
    format: Format,
    about: &str,
) -> io::Result<(Layout, RecordBatch)> {
    let inputs: Vec<_> = plan
        .space()
        .axes()
        .iter()
        .flat_map(Axis::variables)
        .collect();
    let mut table = Long {
        inputs: vec![Vec::new(); inputs.len()],
        ..Long::default()
    };
    for reduced in reduced {
        for quantity in 0..plan.quantities().len() {
            for group in 0..reduced.groups() {
                table.push(plan, reduced, quantity, group);
            }
        }
    }
    let fields = long_fields(&inputs);
    let longest_text = table
        .reductions
        .iter()
        .map(|text| text.chars().count())
        .max();
    let longest_quantity = table.quantities.iter().map(|name| name.len()).max();
    let layout = Layout {
        format,
        schema: schema(fields, about.to_owned()),
        rows: table.values.len() as u64,
        longest_text: longest_text.max(longest_quantity).unwrap_or(1),
    };
    let mut columns: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from(table.reductions)),
        Arc::new(StringArray::from(table.quantities)),
    ];
    let [from, to] = table.bins;
    let numbers = table.inputs.into_iter().chain([from, to, table.values]);
    columns.extend(numbers.map(|values| Arc::new(Float64Array::from(values)) as ArrayRef));
    let batch =
        RecordBatch::try_new(Arc::clone(&layout.schema), columns).map_err(io::Error::other)?;
    Ok((layout, batch))
}
