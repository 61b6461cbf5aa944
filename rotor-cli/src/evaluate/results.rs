//! Where the rows of `rotor evaluate` go: CSV, Parquet or Arrow, each whole or not at all.

use std::io;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, SchemaRef};
use csv::ByteRecord;
use rotor_core::quantity::Quantity;

use super::columns::{Columns, ERROR};
use super::source::{Piece, Read, text};
use crate::failure::Failure;
use crate::files::{Assembler, Format, Layout, number_field, schema};
use crate::output::Destination;

/// What comes of a row: the results, none where there is none, and the reasons for those.
pub(super) type Outcome = (Vec<Option<f64>>, String);

/// A table that is written.
pub(super) enum Results {
    Csv(Box<csv::Writer<Destination>>),
    Columns {
        layout: Layout,
        assembler: Assembler<Destination>,
        name: String,
    },
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
                let mut writer = csv::Writer::from_writer(Destination::open(path)?);
                let mut titles: ByteRecord = columns.carried(header).collect();
                titles.extend(quantities.iter().map(|quantity| quantity.name()));
                titles.push_field(ERROR.as_bytes());
                write(&mut writer, &titles)?;
                return Ok(Self::Csv(Box::new(writer)));
            }
            Ok(Format::Npy) => {
                return Err(Failure::input(format!(
                    "cannot write `{}`: a table with texts is no NumPy array; wanted is .csv, .parquet or .arrow",
                    path.display()
                )));
            }
            Ok(format) => format,
        };
        let mut fields: Vec<Field> = Vec::new();
        for index in columns.kept() {
            fields.push(match &source {
                Some(schema) => schema.field(index).clone(),
                None => {
                    let name = String::from_utf8_lossy(header.get(index).unwrap_or_default());
                    match columns.number(index) {
                        Some(input) => {
                            let about = (input.symbol, input.unit, input.description);
                            number_field(name.trim(), true, about)
                        }
                        None => Field::new(name.trim(), DataType::Utf8, true),
                    }
                }
            });
        }
        fields.extend(quantities.iter().map(|quantity| {
            let about = (quantity.symbol(), quantity.unit(), quantity.description());
            number_field(quantity.name(), true, about)
        }));
        fields.push(Field::new(ERROR, DataType::Utf8, true));
        let layout = Layout {
            format,
            schema: schema(fields, String::from("{}")),
            rows: 0,
            longest_text: 0,
        };
        let name = format!("`{}`", path.display());
        let assembler = Assembler::new(&layout, Destination::open(path)?)
            .map_err(|source| Failure::stream("write", name.as_str(), source))?;
        Ok(Self::Columns {
            layout,
            assembler,
            name,
        })
    }

    /// Writes rows with what came of them.
    ///
    /// # Errors
    ///
    /// Where the system refuses, or a column is of a kind that the format has not.
    pub(super) fn write(
        &mut self,
        columns: &Columns,
        piece: &Piece,
        outcomes: &[Outcome],
    ) -> Result<(), Failure> {
        match self {
            Self::Csv(writer) => {
                if let Some(batch) = &piece.columns {
                    require_texts(columns, batch)?;
                }
                for (Read { row, .. }, (values, error)) in piece.rows.iter().zip(outcomes) {
                    let mut record: ByteRecord = columns.carried(&row.fields).collect();
                    // The shortest digits that read back as the same number; a zero has no sign.
                    let cell = |value: f64| format!("{:?}", value + 0.0);
                    record.extend(
                        values
                            .iter()
                            .map(|value| value.map(cell).unwrap_or_default()),
                    );
                    record.push_field(error.as_bytes());
                    write(writer, &record)?;
                }
                Ok(())
            }
            Self::Columns {
                layout,
                assembler,
                name,
            } => batch(columns, piece, outcomes, &layout.schema)
                .and_then(|batch| layout.encode(&batch))
                .and_then(|part| assembler.add(part))
                .map_err(|source| Failure::stream("write", name.as_str(), source)),
        }
    }

    /// Makes the table appear.
    ///
    /// # Errors
    ///
    /// Where the last bytes or the move fail.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let destination = match self {
            Self::Csv(writer) => writer.into_inner().map_err(|error| {
                Failure::stream(
                    "write",
                    "the results",
                    io::Error::from(error.error().kind()),
                )
            })?,
            Self::Columns {
                assembler, name, ..
            } => assembler
                .finish()
                .map_err(|source| Failure::stream("write", name, source))?,
        };
        destination.finish()
    }
}

/// The rows as columns: those that are carried, the results, the reasons.
fn batch(
    columns: &Columns,
    piece: &Piece,
    outcomes: &[Outcome],
    schema: &SchemaRef,
) -> io::Result<RecordBatch> {
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for index in columns.kept() {
        arrays.push(match &piece.columns {
            Some(batch) => Arc::clone(batch.column(index)),
            None => {
                let cells = piece.rows.iter().map(|read| {
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
    let quantities = outcomes.first().map_or(0, |(values, _)| values.len());
    for quantity in 0..quantities {
        let values = outcomes
            .iter()
            .map(|(values, _)| values[quantity].map(|value| value + 0.0));
        arrays.push(Arc::new(values.collect::<Float64Array>()));
    }
    let reasons = outcomes
        .iter()
        .map(|(_, error)| Some(error.as_str()).filter(|error| !error.is_empty()));
    arrays.push(Arc::new(reasons.collect::<StringArray>()));
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

fn write(writer: &mut csv::Writer<Destination>, record: &ByteRecord) -> Result<(), Failure> {
    writer
        .write_byte_record(record)
        .map_err(|error| match error.into_kind() {
            csv::ErrorKind::Io(source) => Failure::stream("write", "the results", source),
            other => Failure::input(format!("cannot write the results: {other:?}")),
        })
}
