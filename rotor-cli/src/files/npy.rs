//! NumPy's format: one structured array, each number's unit in the title of its field. It knows no
//! missing values: beside each column that may lack some stands a column of booleans,
//! `sir_width_exists`; where that is false the number is NaN.

use std::fmt::Write as _;
use std::io;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Schema};

use super::unsupported;

/// The header of version 3.0 of the format, whose text is UTF-8.
pub(super) fn header(schema: &Schema, rows: u64, longest_text: usize) -> io::Result<Vec<u8>> {
    let mut description = String::from("{'descr': [");
    for field in schema.fields() {
        let kind = match field.data_type() {
            DataType::Float64 => "<f8".to_owned(),
            DataType::UInt64 => "<u8".to_owned(),
            DataType::Utf8 => format!("<U{longest_text}"),
            _ => return Err(unsupported(field)),
        };
        // Writing to a String does not fail. Names are letters, digits and underscores.
        let name = field.name();
        let _ = match field.metadata().get("unit") {
            Some(unit) => write!(description, "(('{name} [{unit}]', '{name}'), '{kind}'), "),
            None => write!(description, "('{name}', '{kind}'), "),
        };
        if field.is_nullable() {
            let _ = write!(description, "('{name}_exists', '|b1'), ");
        }
    }
    let _ = write!(
        description,
        "], 'fortran_order': False, 'shape': ({rows},), }}"
    );
    // The data start at a multiple of 64 bytes, after a line's end.
    let before = 12;
    let unpadded = before + description.len() + 1;
    description.extend(std::iter::repeat_n(
        ' ',
        unpadded.next_multiple_of(64) - unpadded,
    ));
    description.push('\n');
    let length = u32::try_from(description.len()).map_err(io::Error::other)?;
    let mut bytes = b"\x93NUMPY\x03\x00".to_vec();
    bytes.extend(length.to_le_bytes());
    bytes.extend(description.as_bytes());
    Ok(bytes)
}

/// Encodes a batch.
pub(super) fn encode(batch: &RecordBatch, longest_text: usize) -> io::Result<Vec<u8>> {
    let schema = batch.schema();
    let mut bytes = Vec::with_capacity(batch.num_rows() * batch.num_columns() * 9);
    for row in 0..batch.num_rows() {
        for (field, column) in schema.fields().iter().zip(batch.columns()) {
            let valid = column.is_valid(row);
            match field.data_type() {
                DataType::Float64 => {
                    let value = column.as_primitive::<Float64Type>().value(row);
                    bytes.extend((if valid { value } else { f64::NAN }).to_le_bytes());
                }
                DataType::UInt64 => {
                    let value = column.as_primitive::<UInt64Type>().value(row);
                    bytes.extend((if valid { value } else { 0 }).to_le_bytes());
                }
                DataType::Utf8 => {
                    let text = column.as_string::<i32>().value(row);
                    let letters = text.chars().map(u32::from).chain(std::iter::repeat(0));
                    bytes.extend(letters.take(longest_text).flat_map(u32::to_le_bytes));
                }
                _ => return Err(unsupported(field)),
            }
            if field.is_nullable() {
                bytes.push(u8::from(valid));
            }
        }
    }
    Ok(bytes)
}
