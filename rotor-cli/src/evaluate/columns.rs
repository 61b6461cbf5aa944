//! Which column of a table is which input, and which are carried through.

use csv::ByteRecord;
use rotor_core::input::name::{CHOICES, meant};
use rotor_core::input::{NumericInput, RotorParameters};
use rotor_core::text::brief;

use super::table::Row;
use crate::failure::Failure;

/// The column that says why a result is missing.
pub(crate) const ERROR: &str = "error";

/// What a column gives.
#[derive(Clone, Copy, Debug)]
enum Input {
    Number(&'static NumericInput),
    Choice(&'static str),
}

impl Input {
    fn find(name: &str) -> Option<Self> {
        if let Some(input) = NumericInput::find(name) {
            return Some(Self::Number(input));
        }
        CHOICES
            .iter()
            .find(|choice| {
                choice.name == name || name.split_once('.') == Some((choice.section, choice.key))
            })
            .map(|choice| Self::Choice(choice.name))
    }

    fn name(self) -> &'static str {
        match self {
            Self::Number(input) => input.name,
            Self::Choice(name) => name,
        }
    }
}

/// One column that is read.
#[derive(Clone, Debug)]
struct Column {
    index: usize,
    heading: String,
    input: Input,
}

/// The columns of a table.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    width: usize,
    inputs: Vec<Column>,
    /// Whether the column of each index is written out again.
    kept: Vec<bool>,
    /// What is odd but no mistake.
    remarks: Vec<String>,
}

impl Columns {
    /// Sorts the header's columns. `results` are the headings that are going to be added; they take the place of columns
    /// that have one of these already.
    ///
    /// # Errors
    ///
    /// Where an input has two columns, or the header is separated by something else than commas.
    pub(crate) fn new(header: &Row, results: &[&str]) -> Result<Self, Failure> {
        let width = header.fields.len();
        let mut columns = Self {
            width,
            inputs: Vec::new(),
            kept: vec![true; width],
            remarks: Vec::new(),
        };
        let (mut recomputed, mut carried) = (Vec::new(), Vec::new());
        for (index, bytes) in header.fields.iter().enumerate() {
            let heading = String::from_utf8_lossy(bytes).trim().to_owned();
            if results.contains(&heading.as_str()) {
                columns.kept[index] = false;
                recomputed.push(format!("`{heading}`"));
            } else if let Some(input) = Input::find(&heading) {
                columns.add(
                    header.line,
                    Column {
                        index,
                        heading,
                        input,
                    },
                )?;
            } else {
                carried.push(heading);
            }
        }
        columns.remarks.extend(remark_on(&carried));
        if !recomputed.is_empty() {
            let names = recomputed.join(", ");
            columns.remarks.push(format!(
                "results are computed anew, the table's own are dropped: {names}"
            ));
        }
        if columns.inputs.is_empty() {
            if let Some(separator) = other_separator(header) {
                return Err(Failure::input(format!(
                    "line {}: the header is separated by {separator}; use commas",
                    header.line
                )));
            }
            columns
                .remarks
                .push("no column of the table is an input, every row is the base rotor".to_owned());
        }
        Ok(columns)
    }

    fn add(&mut self, line: u64, column: Column) -> Result<(), Failure> {
        let name = column.input.name();
        if let Some(first) = self.inputs.iter().find(|other| other.input.name() == name) {
            return Err(Failure::input(format!(
                "line {line}: `{name}` has two columns, {} (`{}`) and {} (`{}`)",
                first.index + 1,
                first.heading,
                column.index + 1,
                column.heading,
            )));
        }
        self.inputs.push(column);
        Ok(())
    }

    /// The names of the inputs that have a column.
    pub(crate) fn input_names(&self) -> Vec<&'static str> {
        self.inputs
            .iter()
            .map(|column| column.input.name())
            .collect()
    }

    /// What to tell the user about the header.
    pub(crate) fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// The fields that are carried through, in their order.
    pub(crate) fn carried<'a>(&'a self, fields: &'a ByteRecord) -> impl Iterator<Item = &'a [u8]> {
        // A row that is too short is filled up, one that is too long keeps what the header names.
        (0..self.width)
            .filter(|&index| self.kept[index])
            .map(|index| fields.get(index).unwrap_or_default())
    }

    /// The columns that are carried through.
    pub(crate) fn kept(&self) -> impl Iterator<Item = usize> {
        (0..self.width).filter(|&index| self.kept[index])
    }

    /// The columns that give numbers, with the inputs that these are.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = (usize, &'static NumericInput)> {
        self.inputs.iter().filter_map(|column| match column.input {
            Input::Number(input) => Some((column.index, input)),
            Input::Choice(_) => None,
        })
    }

    /// The columns that give choices, with the names of the inputs.
    pub(crate) fn choices(&self) -> impl Iterator<Item = (usize, &'static str)> {
        self.inputs.iter().filter_map(|column| match column.input {
            Input::Number(_) => None,
            Input::Choice(name) => Some((column.index, name)),
        })
    }

    /// The numeric input that a column gives.
    pub(crate) fn number(&self, index: usize) -> Option<&'static NumericInput> {
        let mut numbers = self.numbers();
        numbers.find(|(of, _)| *of == index).map(|(_, input)| input)
    }

    /// The rotor that a row describes; inputs without a column are the base rotor's.
    ///
    /// # Errors
    ///
    /// Which column's value is wrong, and what is allowed.
    pub(crate) fn parameters(
        &self,
        row: &Row,
        base: &RotorParameters,
    ) -> Result<RotorParameters, String> {
        let found = row.fields.len();
        if found != self.width {
            return Err(self.wrong_count(row));
        }
        let mut parameters = *base;
        for column in &self.inputs {
            let bytes = row.fields.get(column.index).unwrap_or_default();
            let text = std::str::from_utf8(bytes)
                .map_err(|_| {
                    format!(
                        "column `{}`: \"{}\" is not UTF-8",
                        column.heading,
                        brief(&String::from_utf8_lossy(bytes))
                    )
                })?
                .trim();
            match column.input {
                Input::Number(input) => {
                    let value = number(input, text)
                        .map_err(|why| format!("column `{}`: {why}", column.heading))?;
                    (input.set)(&mut parameters, value);
                }
                Input::Choice(name) => parameters
                    .set_choice(name, text)
                    .map_err(|why| format!("column `{}`: {why}", column.heading))?,
            }
        }
        Ok(parameters)
    }

    /// What is wrong with a row of more or fewer fields than the header. Those beyond it have no column, so that they
    /// are told here.
    fn wrong_count(&self, row: &Row) -> String {
        let found = row.fields.len();
        let fields = if found == 1 { "field" } else { "fields" };
        let mut why = format!(
            "the row has {found} {fields}, the header has {}",
            self.width
        );
        let beyond: Vec<_> = row
            .fields
            .iter()
            .skip(self.width)
            .map(|field| format!("\"{}\"", String::from_utf8_lossy(field)))
            .collect();
        if !beyond.is_empty() {
            why.push_str(&format!("; beyond it: {}", beyond.join(", ")));
        }
        why
    }
}

/// Of the columns that are no inputs, at most so many are named; those that look like inputs always are.
const NAMED: usize = 12;

/// Which columns are carried through as they are, and which inputs some of them may have been meant to be.
fn remark_on(carried: &[String]) -> Option<String> {
    let hint = |heading: &String| -> Option<String> {
        let inputs = meant(heading, None);
        let names: Vec<_> = inputs
            .iter()
            .map(|input| format!("`{}`", input.name))
            .collect();
        (!names.is_empty()).then(|| format!("is it {}?", names.join(" or ")))
    };
    let (mut doubtful, mut plain) = (Vec::new(), Vec::new());
    for heading in carried {
        let name = format!("`{}`", brief(heading));
        match hint(heading) {
            Some(hint) => doubtful.push(format!("{name} ({hint})")),
            None => plain.push(name),
        }
    }
    let more = plain.len().saturating_sub(NAMED);
    plain.truncate(NAMED);
    let mut names = [doubtful, plain].concat();
    if more > 0 {
        names.push(format!("and {more} more"));
    }
    (!names.is_empty()).then(|| {
        format!(
            "columns that are no inputs are only carried through: {}",
            names.join(", ")
        )
    })
}

/// Reads a number and holds it against what the input allows.
fn number(input: &NumericInput, cell: &str) -> Result<f64, String> {
    // `nan`, `inf` and `infinity` would be read as floats.
    let has_letters = cell
        .chars()
        .any(|letter| letter.is_alphabetic() && !matches!(letter, 'e' | 'E'));
    let read = cell.parse::<f64>().ok().filter(|_| !has_letters);
    if let Some(value) = read.filter(|value| input.allowed.contains(*value)) {
        return Ok(value);
    }
    let text = brief(cell);
    let wants = match input.allowed.to_string().as_str() {
        "finite" => "a finite number is wanted".to_owned(),
        allowed => format!("a number {allowed} is wanted"),
    };
    if text.is_empty() {
        return Err(format!("the cell is empty, {wants}"));
    }
    Err(match read {
        Some(value) if value.is_finite() => format!("\"{text}\" is not allowed, {wants}"),
        Some(_) => {
            format!("\"{text}\" is too large for a number in double precision, {wants}")
        }
        None if cell.contains(',') => {
            format!("\"{text}\" is no number (write a point, not a comma), {wants}")
        }
        None => format!("\"{text}\" is no number, {wants}"),
    })
}

/// What separates a header that is one field, if its parts are inputs.
fn other_separator(header: &Row) -> Option<&'static str> {
    let line = String::from_utf8_lossy(header.fields.get(0).filter(|_| header.fields.len() == 1)?);
    [(';', "semicolons"), ('\t', "tabs")]
        .into_iter()
        .find(|(separator, _)| {
            let mut parts = line.split(*separator);
            line.contains(*separator) && parts.any(|part| Input::find(part.trim()).is_some())
        })
        .map(|(_, name)| name)
}
