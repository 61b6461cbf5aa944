//! `rotor evaluate`: results for each rotor of a table.

mod columns;
mod table;

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use csv::ByteRecord;
use rayon::prelude::*;
use rotor_core::quantity::{self, Quantity, Reason};
use rotor_core::rotor::{Rotor, RotorParameters};

use crate::command_line::EvaluateArguments;
use crate::doubts::doubts;
use crate::failure::{Failure, Outcome};
use crate::output::{self, Destination};
use crate::reasons;
use crate::rotor_file;
use crate::shown::brief;
use columns::{Columns, ERROR};
use table::{OPEN_QUOTE, Row, Rows, TableError};

/// Rows that are read before they are evaluated together, on all cores.
const BATCH: usize = 4096;

/// The names of all results.
pub(crate) fn result_names() -> Vec<&'static str> {
    Quantity::ALL.into_iter().map(Quantity::name).collect()
}

/// Evaluates the table.
///
/// # Errors
///
/// Where the table, a name of a result, the base rotor or, without `--keep-going`, a row cannot be used.
pub(crate) fn run(arguments: &EvaluateArguments) -> Result<Outcome, Failure> {
    let quantities = quantities(&arguments.quantities)?;
    if arguments.table.as_os_str() == "-"
        && arguments
            .base
            .as_ref()
            .is_some_and(|base| base.as_os_str() == "-")
    {
        return Err(Failure::input(
            "the table and the base rotor cannot both be standard input",
        ));
    }
    let name = name_of(&arguments.table);
    let mut rows = Rows::new(open(&arguments.table)?);
    let header = rows
        .next_row()
        .map_err(|error| Failure::input(format!("{name}: {error}")))?
        .ok_or_else(|| Failure::input(format!("{name} is empty: a header row is wanted")))?;
    let headings: Vec<_> = quantities
        .iter()
        .map(|quantity| quantity.name())
        .chain([ERROR])
        .collect();
    let columns = Columns::new(&header, &headings)
        .map_err(|failure| Failure::input(format!("{name}: {failure}")))?;
    for remark in columns.remarks() {
        output::remark(&format!("warning: {name}: {remark}"));
    }
    let base = rotor_file::load_base(arguments.base.as_deref(), &columns.input_names())?;
    let mut evaluation = Evaluation {
        name,
        columns,
        quantities,
        base,
        keep_going: arguments.keep_going,
        failed: 0,
        doubtful: None,
    };
    let mut writer = csv::Writer::from_writer(Destination::open(&arguments.output)?);
    let mut titles: ByteRecord = evaluation.columns.carried(&header.fields).collect();
    titles.extend(headings);
    write(&mut writer, &titles)?;
    let count = evaluation.all(&mut rows, &mut writer)?;
    let name = writer.get_ref().name();
    let destination = writer
        .into_inner()
        .map_err(|error| Failure::stream("write", name, io::Error::from(error.error().kind())))?;
    destination.finish()?;
    evaluation.remark_on_rows(count);
    Ok(if count > 0 && evaluation.failed == count {
        Outcome::CheckFailed
    } else {
        Outcome::Passed
    })
}

/// The results asked for, each once, in the order asked for.
fn quantities(names: &[String]) -> Result<Vec<Quantity>, Failure> {
    let mut quantities = Vec::new();
    for name in names.iter().map(|name| name.trim()) {
        let asked = match name {
            "" => {
                return Err(Failure::input(
                    "--quantities: a name is empty; give names of results with commas between, or `all`",
                ));
            }
            name if name.eq_ignore_ascii_case("all") => Quantity::ALL.to_vec(),
            name => vec![
                name.to_ascii_lowercase()
                    .parse::<Quantity>()
                    .map_err(|error| {
                        Failure::input(format!(
                            "--quantities: {error}; `rotor evaluate --help` lists all"
                        ))
                    })?,
            ],
        };
        for quantity in asked {
            if !quantities.contains(&quantity) {
                quantities.push(quantity);
            }
        }
    }
    Ok(quantities)
}

fn name_of(path: &Path) -> String {
    if path.as_os_str() == "-" {
        "standard input".to_owned()
    } else {
        brief(&path.display().to_string())
    }
}

fn open(path: &Path) -> Result<Box<dyn BufRead>, Failure> {
    if path.as_os_str() == "-" {
        return Ok(Box::new(io::stdin().lock()));
    }
    if fs::metadata(path).is_ok_and(|metadata| metadata.is_dir()) {
        return Err(Failure::input(format!(
            "cannot read `{}`: it is a folder",
            path.display()
        )));
    }
    let file = File::open(path).map_err(|source| Failure::file("read", path, source))?;
    Ok(Box::new(BufReader::new(file)))
}

fn write(writer: &mut csv::Writer<Destination>, record: &ByteRecord) -> Result<(), Failure> {
    let written = writer.write_byte_record(record);
    written.map_err(|error| match error.into_kind() {
        csv::ErrorKind::Io(source) => Failure::stream("write", writer.get_ref().name(), source),
        other => Failure::input(format!("cannot write the results: {other:?}")),
    })
}

/// A result, or why there is none. A zero of a region may be all that is left of a number too small for double precision.
fn checked(rotor: &Rotor, quantity: Quantity, result: Result<f64, Reason>) -> Result<f64, String> {
    let value = result.map_err(|reason| reasons::of_quantity(&reason))?;
    let underflow = reasons::region_of(quantity)
        .filter(|_| value == 0.0)
        .and_then(|kind| Some((kind, rotor.coefficients().ok()?)))
        .and_then(|(kind, c)| reasons::out_of_range(kind, &c));
    underflow.map_or(Ok(value), Err)
}

/// A table on its way.
struct Evaluation {
    name: String,
    columns: Columns,
    quantities: Vec<Quantity>,
    base: RotorParameters,
    keep_going: bool,
    /// Rows that are no rotor.
    failed: u64,
    doubtful: Option<Doubtful>,
}

/// Rows whose rotors are doubtful.
struct Doubtful {
    rows: u64,
    /// The line of the first, and what is said of it.
    first: (u64, String),
}

/// A row as it was read.
struct Read {
    row: Row,
    /// Why its fields are not to be trusted.
    broken: Option<&'static str>,
}

/// What comes of a row that is a rotor.
struct Evaluated {
    /// The results, empty where there is none.
    cells: Vec<String>,
    /// The reasons for empty ones.
    error: String,
    warning: Option<String>,
}

impl Evaluation {
    /// Evaluates and writes row after row; how many there were.
    fn all(
        &mut self,
        rows: &mut Rows<Box<dyn BufRead>>,
        writer: &mut csv::Writer<Destination>,
    ) -> Result<u64, Failure> {
        let mut count = 0;
        loop {
            let batch = self.batch(rows)?;
            if batch.is_empty() {
                return Ok(count);
            }
            let results: Vec<_> = batch.par_iter().map(|row| self.row(row)).collect();
            for (Read { row, .. }, result) in batch.iter().zip(results) {
                count += 1;
                let (cells, error) = match result {
                    Ok(result) => {
                        self.doubt(row.line, result.warning);
                        (result.cells, result.error)
                    }
                    Err(why) if self.keep_going => {
                        self.failed += 1;
                        (vec![String::new(); self.quantities.len()], why)
                    }
                    Err(why) => {
                        let text = format!(
                            "{}: line {}: {why}; no results are written",
                            self.name, row.line
                        );
                        return Err(Failure::input(text));
                    }
                };
                let mut record: ByteRecord = self.columns.carried(&row.fields).collect();
                record.extend(cells);
                record.push_field(error.as_bytes());
                write(writer, &record)?;
            }
        }
    }

    fn batch(&self, rows: &mut Rows<Box<dyn BufRead>>) -> Result<Vec<Read>, Failure> {
        let mut batch = Vec::new();
        while batch.len() < BATCH {
            match rows.next_row() {
                Ok(Some(row)) => batch.push(Read { row, broken: None }),
                Ok(None) => break,
                Err(TableError::OpenQuote { first_line: row }) if self.keep_going => {
                    batch.push(Read {
                        row,
                        broken: Some(OPEN_QUOTE),
                    });
                }
                Err(error) => return Err(Failure::input(format!("{}: {error}", self.name))),
            }
        }
        Ok(batch)
    }

    /// Counts a row with a warning.
    fn doubt(&mut self, line: u64, warning: Option<String>) {
        match (warning, &mut self.doubtful) {
            (Some(_), Some(doubtful)) => doubtful.rows += 1,
            (Some(warning), None) => {
                self.doubtful = Some(Doubtful {
                    rows: 1,
                    first: (line, warning),
                });
            }
            (None, _) => {}
        }
    }

    /// The results of a row, or why it is no rotor.
    fn row(&self, Read { row, broken }: &Read) -> Result<Evaluated, String> {
        if let Some(why) = broken {
            return Err((*why).to_owned());
        }
        let parameters = self.columns.parameters(row, &self.base)?;
        let rotor = Rotor::new(parameters).map_err(|error| error.to_string())?;
        let mut reasons: Vec<String> = Vec::new();
        let results = quantity::evaluate(&self.quantities, &rotor);
        let cells = self
            .quantities
            .iter()
            .zip(results)
            .map(
                |(&quantity, result)| match checked(&rotor, quantity, result) {
                    // The shortest digits that read back as the same number; a zero has no sign.
                    Ok(value) => format!("{:?}", value + 0.0),
                    Err(reason) => {
                        if !reasons.contains(&reason) {
                            reasons.push(reason);
                        }
                        String::new()
                    }
                },
            )
            .collect();
        Ok(Evaluated {
            cells,
            error: reasons.join("; "),
            warning: doubts(&rotor).into_iter().next(),
        })
    }

    /// Says how many rows are doubtful, and how many no rotor; each of those is told why in its column, and keeping
    /// going was asked for.
    fn remark_on_rows(&self, count: u64) {
        if let Some(Doubtful { rows, first }) = &self.doubtful {
            output::remark(&format!(
                "warning: {}: {rows} of {count} rows are doubtful, the first in line {}: {}",
                self.name, first.0, first.1
            ));
        }
        if self.failed > 0 {
            output::remark(&format!(
                "{}: {} of {count} rows are no rotor, their results are empty and `{ERROR}` says why",
                self.name, self.failed
            ));
        }
    }
}
