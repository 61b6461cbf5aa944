//! Where the rows of `rotor evaluate` go: CSV, Parquet or Arrow, each whole or not at all.

use std::io;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, SchemaRef};
use csv::ByteRecord;
use rotor_core::quantity::Quantity;

use super::Answers;
use super::columns::{Columns, ERROR};
use super::source::{Piece, text};
use crate::failure::Failure;
use crate::files::{Assembler, Format, Layout, Part, number_field, schema};
use crate::output::Destination;

/// How rows become bytes.
#[derive(Clone)]
pub(super) enum Encoding {
    Csv,
    Columns(Layout),
}

/// A table that is written.
pub(super) struct Results {
    encoding: Encoding,
    assembler: Assembler<Destination>,
    /// As messages call it.
    name: String,
}

impl Results {
    /// Opens the destination and writes the headings.
    ///
    /// # Errors
    ///
    /// Where the file cannot be written, or its extension names no format that tables come in.
    pub(super) fn open(
        path: &Path,
        (header, columns): (&ByteRecord, &Columns),
        source: Option<SchemaRef>,
        quantities: &[Quantity],
    ) -> Result<Self, Failure> {
        let format = match Format::of(path) {
            // As ever, a file of another name is CSV.
            Err(_) | Ok(Format::Csv) => {
                let mut titles: ByteRecord = columns.carried(header).collect();
                titles.extend(quantities.iter().map(|quantity| quantity.name()));
                titles.push_field(ERROR.as_bytes());
                let mut results = Self {
                    encoding: Encoding::Csv,
                    assembler: Assembler::Plain(Destination::open(path)?),
                    name: "the results".to_owned(),
                };
                results.add(Part::Bytes(csv_bytes([titles])?))?;
                return Ok(results);
            }
            Ok(Format::Npy) => {
                return Err(Failure::input(format!(
                    "cannot write `{}`: a table with texts is no NumPy array; wanted is .csv, .parquet or .arrow",
                    path.display()
                )));
            }
            Ok(format) => format,
        };
        let layout = Layout {
            format,
            schema: schema(
                fields(header, columns, source.as_ref(), quantities),
                String::from("{}"),
            ),
            rows: 0,
            longest_text: 0,
        };
        let name = format!("`{}`", path.display());
        let assembler = Assembler::new(&layout, Destination::open(path)?)
            .map_err(|source| Failure::stream("write", name.as_str(), source))?;
        Ok(Self {
            encoding: Encoding::Columns(layout),
            assembler,
            name,
        })
    }

    /// How rows are to be encoded.
    pub(super) const fn encoding(&self) -> &Encoding {
        &self.encoding
    }

    /// Adds rows that are encoded.
    ///
    /// # Errors
    ///
    /// Where the system refuses.
    pub(super) fn add(&mut self, part: Part) -> Result<(), Failure> {
        let added = self.assembler.add(part);
        added.map_err(|source| Failure::stream("write", self.name.as_str(), source))
    }

    /// Makes the table appear.
    ///
    /// # Errors
    ///
    /// Where the last bytes or the move fail.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let finished = self.assembler.finish();
        let destination = finished.map_err(|source| Failure::stream("write", self.name, source))?;
        destination.finish()
    }
}

/// The columns of a table of columns.
fn fields(
    header: &ByteRecord,
    columns: &Columns,
    source: Option<&SchemaRef>,
    quantities: &[Quantity],
) -> Vec<Field> {
    let carried = columns.kept().map(|index| {
        if let Some(schema) = source {
            return schema.field(index).clone();
        }
        let name = String::from_utf8_lossy(header.get(index).unwrap_or_default());
        match columns.number(index) {
            Some(input) => {
                let about = (input.symbol, input.unit, input.description);
                number_field(name.trim(), true, about)
            }
            None => Field::new(name.trim(), DataType::Utf8, true),
        }
    });
    let mut fields: Vec<Field> = carried.collect();
    fields.extend(quantities.iter().map(|quantity| {
        let about = (quantity.symbol(), quantity.unit(), quantity.description());
        number_field(quantity.name(), true, about)
    }));
    fields.push(Field::new(ERROR, DataType::Utf8, true));
    fields
}

impl Encoding {
    /// Rows with what came of them, encoded; the values are taken.
    ///
    /// # Errors
    ///
    /// Where a column is of a kind that the format has not.
    pub(super) fn encode(
        &self,
        columns: &Columns,
        piece: &Piece,
        answers: &mut Answers,
    ) -> Result<Part, Failure> {
        match self {
            Self::Csv => {
                if let Piece::Batch { batch, .. } = piece {
                    require_texts(columns, batch)?;
                }
                csv_bytes(records(columns, piece, answers)).map(Part::Bytes)
            }
            Self::Columns(layout) => batch(columns, piece, answers, &layout.schema)
                .and_then(|batch| layout.encode(&batch))
                .map_err(|source| Failure::stream("write", "the results", source)),
        }
    }
}

/// The rows of a CSV table.
fn records<'a>(
    columns: &'a Columns,
    piece: &'a Piece,
    answers: &'a Answers,
) -> impl Iterator<Item = ByteRecord> {
    // The shortest digits that read back as the same number.
    let cell = |value: f64| match value.is_nan() {
        true => String::new(),
        false => format!("{value:?}"),
    };
    errors(piece, answers).enumerate().map(move |(row, error)| {
        let read = piece.read(row);
        let mut record: ByteRecord = columns.carried(&read.row.fields).collect();
        record.extend(answers.values.iter().map(|column| cell(column[row])));
        record.push_field(error.unwrap_or_default().as_bytes());
        record
    })
}

/// What is said of each row, if anything.
fn errors<'a>(piece: &Piece, answers: &'a Answers) -> impl Iterator<Item = Option<&'a str>> {
    let mut errors = answers.errors.iter().peekable();
    (0..piece.len()).map(move |row| {
        let of_row = errors.next_if(|(of, _)| *of == row);
        of_row
            .map(|(_, error)| error.as_str())
            .filter(|error| !error.is_empty())
    })
}

/// The rows as columns: those that are carried, the results, the reasons.
fn batch(
    columns: &Columns,
    piece: &Piece,
    answers: &mut Answers,
    schema: &SchemaRef,
) -> io::Result<RecordBatch> {
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for index in columns.kept() {
        arrays.push(match piece {
            Piece::Batch { batch, .. } => Arc::clone(batch.column(index)),
            Piece::Rows(rows) => {
                let cells = rows.iter().map(|read| {
                    String::from_utf8_lossy(read.row.fields.get(index).unwrap_or_default())
                });
                if columns.number(index).is_some() {
                    // A cell that is no number is null here and quoted in the column of reasons.
                    Arc::new(
                        cells
                            .map(|cell| {
                                cell.trim()
                                    .parse::<f64>()
                                    .ok()
                                    .filter(|value| value.is_finite())
                            })
                            .collect::<Float64Array>(),
                    )
                } else {
                    Arc::new(cells.map(Some).collect::<StringArray>())
                }
            }
        });
    }
    for column in std::mem::take(&mut answers.values) {
        // The whole column in packs, not only up to the first.
        let any_is_missing = column.iter().fold(false, |any, value| any | value.is_nan());
        let missing = any_is_missing.then(|| column.iter().map(|value| !value.is_nan()).collect());
        arrays.push(Arc::new(Float64Array::new(column.into(), missing)));
    }
    arrays.push(Arc::new(if answers.errors.is_empty() {
        StringArray::new_null(piece.len())
    } else {
        errors(piece, answers).collect()
    }));
    RecordBatch::try_new(Arc::clone(schema), arrays).map_err(io::Error::other)
}

/// CSV has texts and numbers only; a list or a date would be lost without a word.
fn require_texts(columns: &Columns, batch: &RecordBatch) -> Result<(), Failure> {
    for index in columns.kept() {
        if batch.num_rows() > 0 && text(batch.column(index), 0).is_none() {
            let schema = batch.schema();
            let field = schema.field(index);
            return Err(Failure::input(format!(
                "column `{}` has the type {}, which CSV has not; write .parquet or .arrow",
                field.name(),
                field.data_type()
            )));
        }
    }
    Ok(())
}

/// Rows as CSV.
fn csv_bytes(records: impl IntoIterator<Item = ByteRecord>) -> Result<Vec<u8>, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        let written = writer.write_byte_record(&record);
        written.map_err(|error| Failure::input(format!("cannot write the results: {error}")))?;
    }
    let bytes = writer.into_inner();
    bytes.map_err(|error| Failure::input(format!("cannot write the results: {error}")))
}
