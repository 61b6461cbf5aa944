//! Which column of a table is which input, and which are carried through.

use csv::ByteRecord;
use rotor_core::rotor::{INPUTS, NumericInput, RotorParameters};

use super::table::Row;
use crate::failure::Failure;
use crate::rotor_file::{CHOICES, nearest, set_choice};

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
            .find(|(flat, section, key)| {
                *flat == name || name.split_once('.') == Some((section, key))
            })
            .map(|(flat, ..)| Self::Choice(flat))
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
        let mut recomputed = Vec::new();
        for (index, bytes) in header.fields.iter().enumerate() {
            let heading = String::from_utf8_lossy(bytes).trim().to_owned();
            if results.contains(&heading.as_str()) {
                columns.kept[index] = false;
                if heading != ERROR {
                    recomputed.push(format!("`{heading}`"));
                }
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
                columns.remark_on(&heading);
            }
        }
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

    fn remark_on(&mut self, heading: &str) {
        let flat = heading.replace(['.', ' ', '-'], "_");
        let names = INPUTS
            .iter()
            .map(|input| input.name)
            .chain(CHOICES.iter().map(|choice| choice.0));
        if let Some(near) = nearest(&flat, names) {
            self.remarks.push(format!(
                "column `{heading}` is no input and is only carried through; did you mean `{near}`?"
            ));
        }
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

    /// The numeric input that a column gives.
    pub(crate) fn number(&self, index: usize) -> Option<&'static NumericInput> {
        let column = self.inputs.iter().find(|column| column.index == index)?;
        match column.input {
            Input::Number(input) => Some(input),
            Input::Choice(_) => None,
        }
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
            let fields = if found == 1 { "field" } else { "fields" };
            return Err(format!(
                "the row has {found} {fields}, the header has {}",
                self.width
            ));
        }
        let mut parameters = *base;
        for column in &self.inputs {
            let bytes = row.fields.get(column.index).unwrap_or_default();
            let text = std::str::from_utf8(bytes)
                .map_err(|_| {
                    format!(
                        "column `{}`: {:?} is not UTF-8",
                        column.heading,
                        String::from_utf8_lossy(bytes)
                    )
                })?
                .trim();
            match column.input {
                Input::Number(input) => {
                    let value = number(input, text)
                        .map_err(|why| format!("column `{}`: {why}", column.heading))?;
                    (input.set)(&mut parameters, value);
                }
                Input::Choice(name) => set_choice(&mut parameters, name, text)
                    .map_err(|why| format!("column `{}`: {why}", column.heading))?,
            }
        }
        Ok(parameters)
    }
}

/// Reads a number and holds it against what the input allows.
fn number(input: &NumericInput, text: &str) -> Result<f64, String> {
    let wants = match input.allowed.to_string().as_str() {
        "finite" => "a finite number is wanted".to_owned(),
        allowed => format!("a number {allowed} is wanted"),
    };
    if text.is_empty() {
        return Err(format!("the cell is empty, {wants}"));
    }
    // `nan`, `inf` and `infinity` would be read as floats.
    let has_letters = text
        .chars()
        .any(|letter| letter.is_alphabetic() && !matches!(letter, 'e' | 'E'));
    let value: f64 = match text.parse() {
        Ok(value) if !has_letters => value,
        _ if text.contains(',') => {
            return Err(format!(
                "\"{text}\" is no number (write a point, not a comma), {wants}"
            ));
        }
        _ => return Err(format!("\"{text}\" is no number, {wants}")),
    };
    if !value.is_finite() {
        return Err(format!(
            "\"{text}\" is too large for a number in double precision, {wants}"
        ));
    }
    if !input.allowed.contains(value) {
        return Err(format!("\"{text}\" is not allowed, {wants}"));
    }
    Ok(value)
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
