//! Tables as files: CSV, Parquet, Arrow and NumPy, written part by part.
//!
//! A [`Part`] is a batch of rows that has been encoded on its own, on any thread. [`Assembler`] joins
//! parts to a file; the file depends on the parts and their order alone.

mod arrow;
mod csv;
mod npy;
mod parquet;

use std::collections::HashMap;
use std::io::{self, Write};
use std::path::Path;

use arrow_array::RecordBatch;
use arrow_schema::{DataType, Field, Schema, SchemaRef};

use crate::failure::Failure;

/// The formats of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Csv,
    Parquet,
    Arrow,
    Npy,
}

impl Format {
    /// All of them with their extensions.
    const ALL: [(Self, &'static str); 4] = [
        (Self::Parquet, "parquet"),
        (Self::Arrow, "arrow"),
        (Self::Csv, "csv"),
        (Self::Npy, "npy"),
    ];

    /// The format that a path's extension names. Standard output and special files without one get
    /// CSV.
    ///
    /// # Errors
    ///
    /// Where the extension is none of them.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let known = Self::ALL
            .iter()
            .find(|(_, known)| extension.eq_ignore_ascii_case(known));
        if let Some((format, _)) = known {
            return Ok(*format);
        }
        if is_stream(path) {
            return Ok(Self::Csv);
        }
        Err(Failure::input(format!(
            "cannot tell the format of `{}`: the name must end with .parquet, .arrow, .csv or .npy",
            path.display()
        )))
    }

    /// Its name in messages.
    pub(crate) fn name(self) -> &'static str {
        let found = Self::ALL.iter().find(|(format, _)| *format == self);
        found.map_or("", |(_, extension)| extension)
    }
}

/// Whether a path is standard output or a special file, which nothing can be moved to.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
        || std::fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

/// A table's columns and format.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) format: Format,
    pub(crate) schema: SchemaRef,
    /// Rows of the whole table.
    pub(crate) rows: u64,
    /// The longest text in characters; NumPy's texts all have one length.
    pub(crate) longest_text: usize,
}

impl Layout {
    /// Encodes a part of the table.
    ///
    /// # Errors
    ///
    /// Where the encoder fails, which it does only for columns of a kind that no table here has.
    pub(crate) fn encode(&self, batch: &RecordBatch) -> io::Result<Part> {
        Ok(match self.format {
            Format::Csv => Part::Bytes(csv::encode(batch)?),
            Format::Parquet => Part::Columns(parquet::encode(batch)?),
            Format::Arrow => Part::Bytes(arrow::encode(batch)?),
            Format::Npy => Part::Bytes(npy::encode(batch, self.longest_text)?),
        })
    }
}

/// A part of a table, encoded.
pub(crate) enum Part {
    /// As it may lie in a file until it is joined.
    Bytes(Vec<u8>),
    /// Parquet's columns, ready to be joined.
    Columns(parquet::Columns),
}

impl Part {
    /// As it may lie in a file until it is joined.
    ///
    /// # Errors
    ///
    /// Where the encoder fails, as in [`Layout::encode`].
    pub(crate) fn into_bytes(self) -> io::Result<Vec<u8>> {
        match self {
            Self::Bytes(bytes) => Ok(bytes),
            Self::Columns(columns) => columns.into_bytes(),
        }
    }
}

/// Joins encoded parts to a file.
pub(crate) enum Assembler<W: Write + Send> {
    /// Parts are joined as they are.
    Plain(W),
    Parquet(Box<parquet::Joined<W>>),
    Arrow(Box<arrow::Joined<W>>),
}

impl<W: Write + Send> Assembler<W> {
    /// Begins a file.
    pub(crate) fn new(layout: &Layout, mut output: W) -> io::Result<Self> {
        let schema = &layout.schema;
        Ok(match layout.format {
            Format::Csv => {
                output.write_all(&csv::header(schema)?)?;
                Self::Plain(output)
            }
            Format::Npy => {
                output.write_all(&npy::header(schema, layout.rows, layout.longest_text)?)?;
                Self::Plain(output)
            }
            Format::Parquet => Self::Parquet(Box::new(parquet::Joined::new(output, schema)?)),
            Format::Arrow => Self::Arrow(Box::new(arrow::Joined::new(output, schema)?)),
        })
    }

    /// Adds the next part.
    pub(crate) fn add(&mut self, part: Part) -> io::Result<()> {
        match (self, part) {
            (Self::Parquet(joined), Part::Columns(part)) => joined.add(part),
            (Self::Parquet(joined), Part::Bytes(part)) => joined.add_file(part),
            (Self::Plain(output), part) => output.write_all(&part.into_bytes()?),
            (Self::Arrow(joined), part) => joined.add(&part.into_bytes()?),
        }
    }

    /// Ends the file.
    pub(crate) fn finish(self) -> io::Result<W> {
        let mut output = match self {
            Self::Plain(output) => output,
            Self::Parquet(joined) => joined.finish()?,
            Self::Arrow(joined) => joined.finish()?,
        };
        output.flush()?;
        Ok(output)
    }
}

/// A column of numbers with its unit and meaning.
pub(crate) fn number_field(
    name: &str,
    nullable: bool,
    (symbol, unit, description): (&str, &str, &str),
) -> Field {
    let unit = if unit.is_empty() { "1" } else { unit };
    let metadata = [
        ("description", description),
        ("symbol", symbol),
        ("unit", unit),
    ];
    let metadata = metadata.map(|(key, value)| (key.to_owned(), value.to_owned()));
    Field::new(name, DataType::Float64, nullable).with_metadata(HashMap::from(metadata))
}

/// A schema with one text about the whole table, under the key `rotor`.
pub(crate) fn schema(fields: Vec<Field>, about: String) -> SchemaRef {
    let metadata = [("rotor".to_owned(), about)];
    SchemaRef::new(Schema::new_with_metadata(fields, HashMap::from(metadata)))
}

/// What the file formats cannot do, which nobody asks them for.
fn unsupported(field: &Field) -> io::Error {
    io::Error::other(format!(
        "column `{}` has the type {}, which this format has not",
        field.name(),
        field.data_type()
    ))
}
