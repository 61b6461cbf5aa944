//! Where the rows of `rotor evaluate` come from: CSV, Parquet or Arrow, piece by piece.

use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Seek as _};
use std::path::Path;

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, RecordBatch};
use arrow_ipc::reader::{FileReader, StreamReader};
use arrow_schema::{ArrowError, DataType, SchemaRef};
use csv::ByteRecord;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use super::table::{OPEN_QUOTE, Row, Rows, TableError};
use crate::failure::Failure;
use crate::files::Format;

/// Rows of a piece. Pieces are evaluated side by side, on all cores.
const ROWS_PER_PIECE: usize = 1 << 14;

/// Rows of a piece of a Parquet or Arrow file: a row takes less memory there, and each piece becomes a group of columns.
const ROWS_PER_BATCH: usize = 1 << 16;

/// Batches of a file of columns.
type Batches = Box<dyn Iterator<Item = Result<RecordBatch, ArrowError>> + Send>;

/// A table that is read.
pub(super) enum Source {
    Csv(Rows<Box<dyn BufRead + Send>>),
    Columns {
        schema: SchemaRef,
        batches: Batches,
        /// The number of the row that is read next, from 1.
        next: u64,
    },
}

/// A row as it was read.
#[derive(Clone)]
pub(super) struct Read {
    pub(super) row: Row,
    /// Why its fields are not to be trusted.
    pub(super) broken: Option<&'static str>,
}

impl From<Row> for Read {
    fn from(row: Row) -> Self {
        Self { row, broken: None }
    }
}

/// Some rows, as the file has them.
pub(super) enum Piece {
    /// Rows of text.
    Rows(Vec<Read>),
    /// Columns.
    Batch {
        batch: RecordBatch,
        /// The number of the first row.
        first: u64,
    },
}

impl Piece {
    /// How many rows there are, at least one.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Rows(rows) => rows.len(),
            Self::Batch { batch, .. } => batch.num_rows(),
        }
    }

    /// A row as it would stand in a CSV table.
    pub(super) fn read(&self, row: usize) -> Cow<'_, Read> {
        match self {
            Self::Rows(rows) => Cow::Borrowed(&rows[row]),
            Self::Batch { batch, first } => {
                Cow::Owned(row_of(batch, row, first + row as u64).into())
            }
        }
    }
}

impl Source {
    /// Opens a table, `-` for CSV from standard input.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read, or is not what its extension says.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        if path.as_os_str() == "-" {
            return Ok(Self::Csv(Rows::new(Box::new(BufReader::new(io::stdin())))));
        }
        if fs::metadata(path).is_ok_and(|metadata| metadata.is_dir()) {
            return Err(Failure::input(format!(
                "cannot read `{}`: it is a folder",
                path.display()
            )));
        }
        let file = File::open(path).map_err(|source| Failure::file("read", path, source))?;
        let unreadable =
            |error: String| Failure::input(format!("cannot read `{}`: {error}", path.display()));
        match Format::of(path) {
            Ok(Format::Parquet) => parquet_batches(file).map_err(unreadable),
            Ok(Format::Arrow) => arrow_batches(file).map_err(unreadable),
            Ok(Format::Npy) => Err(unreadable(
                "NumPy's files are written here, not read; wanted is .csv, .parquet or .arrow"
                    .to_owned(),
            )),
            // Whatever else it is called, a table is CSV.
            Ok(Format::Csv) | Err(_) => Ok(Self::Csv(Rows::new(Box::new(BufReader::new(file))))),
        }
    }

    /// What rows are counted in.
    pub(super) fn unit(&self) -> &'static str {
        match self {
            Self::Csv(_) => "line",
            Self::Columns { .. } => "row",
        }
    }

    /// The types of the columns, where the file has them.
    pub(super) fn schema(&self) -> Option<SchemaRef> {
        match self {
            Self::Csv(_) => None,
            Self::Columns { schema, .. } => Some(SchemaRef::clone(schema)),
        }
    }

    /// The names of the columns; none of an empty file.
    pub(super) fn header(&mut self) -> Result<Option<Row>, String> {
        match self {
            Self::Csv(rows) => rows.next_row().map_err(|error| error.to_string()),
            Self::Columns { schema, .. } => Ok(Some(Row {
                line: 0,
                fields: schema
                    .fields()
                    .iter()
                    .map(|field| field.name().as_bytes())
                    .collect(),
            })),
        }
    }

    /// The next rows; none at the end. Keeping going, a row whose quote is not closed is given as far as it could be read.
    pub(super) fn next_piece(&mut self, keep_going: bool) -> Result<Option<Piece>, String> {
        match self {
            Self::Csv(source) => {
                let mut rows = Vec::new();
                while rows.len() < ROWS_PER_PIECE {
                    match source.next_row() {
                        Ok(Some(row)) => rows.push(row.into()),
                        Ok(None) => break,
                        Err(TableError::OpenQuote { first_line: row }) if keep_going => {
                            rows.push(Read {
                                row,
                                broken: Some(OPEN_QUOTE),
                            });
                        }
                        Err(error) => return Err(error.to_string()),
                    }
                }
                Ok((!rows.is_empty()).then_some(Piece::Rows(rows)))
            }
            Self::Columns { batches, next, .. } => {
                // A batch may be empty; only no batch is the end.
                for batch in batches {
                    let batch = batch.map_err(|error| error.to_string())?;
                    if batch.num_rows() > 0 {
                        let first = *next;
                        *next += batch.num_rows() as u64;
                        return Ok(Some(Piece::Batch { batch, first }));
                    }
                }
                Ok(None)
            }
        }
    }
}

fn parquet_batches(file: File) -> Result<Source, String> {
    let builder =
        ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| error.to_string())?;
    let schema = SchemaRef::clone(builder.schema());
    let reader = builder.with_batch_size(ROWS_PER_BATCH).build();
    Ok(Source::Columns {
        schema,
        batches: Box::new(reader.map_err(|error| error.to_string())?),
        next: 1,
    })
}

/// Arrow's file format, or its stream format under the same extension.
fn arrow_batches(file: File) -> Result<Source, String> {
    let again = file.try_clone();
    let (schema, batches): (SchemaRef, Batches) = match FileReader::try_new_buffered(file, None) {
        Ok(reader) => (reader.schema(), Box::new(reader)),
        Err(not_a_file) => {
            let of_file = |_| not_a_file.to_string();
            let mut stream = again.map_err(|error| error.to_string())?;
            stream.rewind().map_err(|error| error.to_string())?;
            let reader = StreamReader::try_new_buffered(stream, None).map_err(of_file)?;
            (reader.schema(), Box::new(reader))
        }
    };
    Ok(Source::Columns {
        schema,
        batches,
        next: 1,
    })
}

/// A row as it would stand in a CSV table.
fn row_of(batch: &RecordBatch, row: usize, number: u64) -> Row {
    let fields: ByteRecord = batch
        .columns()
        .iter()
        .map(|column| text(column, row).unwrap_or_default())
        .collect();
    Row {
        line: number,
        fields,
    }
}

/// A cell as text that reads back as the same value; none of a type that is no text and no number.
pub(super) fn text(column: &dyn Array, row: usize) -> Option<String> {
    if column.is_null(row) {
        return Some(String::new());
    }
    macro_rules! number {
        ($kind:ty) => {
            format!("{:?}", column.as_primitive::<$kind>().value(row))
        };
    }
    Some(match column.data_type() {
        DataType::Float64 => number!(Float64Type),
        DataType::Float32 => number!(Float32Type),
        DataType::Int8 => number!(Int8Type),
        DataType::Int16 => number!(Int16Type),
        DataType::Int32 => number!(Int32Type),
        DataType::Int64 => number!(Int64Type),
        DataType::UInt8 => number!(UInt8Type),
        DataType::UInt16 => number!(UInt16Type),
        DataType::UInt32 => number!(UInt32Type),
        DataType::UInt64 => number!(UInt64Type),
        DataType::Boolean => column.as_boolean().value(row).to_string(),
        DataType::Utf8 => column.as_string::<i32>().value(row).to_owned(),
        DataType::LargeUtf8 => column.as_string::<i64>().value(row).to_owned(),
        DataType::Utf8View => column.as_string_view().value(row).to_owned(),
        DataType::Dictionary(..) => {
            let dictionary = column.as_any_dictionary_opt()?;
            let key = *dictionary.normalized_keys().get(row)?;
            return text(dictionary.values(), key);
        }
        _ => return None,
    })
}
