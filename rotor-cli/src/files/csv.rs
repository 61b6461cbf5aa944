//! CSV: numbers in the fewest digits that read back exactly, nothing where there is none.

use std::io::{self, Write};

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Schema};

use super::unsupported;

/// The line of headings.
pub(super) fn header(schema: &Schema) -> io::Result<Vec<u8>> {
    let names: Vec<_> = schema.fields().iter().map(|field| field.name()).collect();
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(names)?;
    writer
        .into_inner()
        .map_err(|error| io::Error::other(error.to_string()))
}

/// Encodes a batch.
pub(super) fn encode(batch: &RecordBatch) -> io::Result<Vec<u8>> {
    let schema = batch.schema();
    let mut cells = Vec::with_capacity(batch.num_columns());
    for (field, column) in schema.fields().iter().zip(batch.columns()) {
        cells.push(match field.data_type() {
            DataType::Float64 => Cells::Number(column.as_primitive::<Float64Type>()),
            DataType::UInt64 => Cells::Count(column.as_primitive::<UInt64Type>()),
            DataType::Utf8 => Cells::Text(column.as_string::<i32>()),
            _ => return Err(unsupported(field)),
        });
    }
    let mut bytes = Vec::with_capacity(batch.num_rows() * batch.num_columns() * 20);
    for row in 0..batch.num_rows() {
        for (index, cells) in cells.iter().enumerate() {
            if index > 0 {
                bytes.push(b',');
            }
            cells.write(row, &mut bytes)?;
        }
        bytes.push(b'\n');
    }
    Ok(bytes)
}

/// A column.
enum Cells<'a> {
    Number(&'a arrow_array::Float64Array),
    Count(&'a arrow_array::UInt64Array),
    Text(&'a arrow_array::StringArray),
}

impl Cells<'_> {
    fn write(&self, row: usize, bytes: &mut Vec<u8>) -> io::Result<()> {
        match self {
            Self::Number(numbers) if numbers.is_valid(row) => {
                write!(bytes, "{:?}", numbers.value(row))
            }
            Self::Count(counts) if counts.is_valid(row) => write!(bytes, "{}", counts.value(row)),
            Self::Text(texts) if texts.is_valid(row) => {
                let text = texts.value(row);
                if text.contains(['"', ',', '\n', '\r']) {
                    write!(bytes, "\"{}\"", text.replace('"', "\"\""))
                } else {
                    bytes.write_all(text.as_bytes())
                }
            }
            _ => Ok(()),
        }
    }
}
