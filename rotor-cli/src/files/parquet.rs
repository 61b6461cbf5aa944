//! Parquet: each part is a row group, or a small file of one, whose columns are moved into the whole
//! without being decoded.

use std::hash::BuildHasher as _;
use std::io::{self, Write};
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{Field, Schema, SchemaRef};
use bytes::Bytes;
use parquet::arrow::arrow_writer::{ArrowColumnChunk, ArrowRowGroupWriterFactory, compute_leaves};
use parquet::arrow::{ArrowSchemaConverter, add_encoded_arrow_schema_to_metadata};
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::ParquetError;
use parquet::file::metadata::{KeyValue, ParquetMetaDataReader};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesBuilder};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, TypePtr};
use rustc_hash::FxBuildHasher;

/// What is said of every file and part.
fn properties() -> WriterPropertiesBuilder {
    WriterProperties::builder()
        .set_created_by(concat!("rotor ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_max_row_group_row_count(None)
}

/// A column that has each number this often on average is written as a dictionary.
const REPEATS: usize = 4;

/// Whether a dictionary of its numbers is worth it, as it is for axes, but neither for samples nor for results. Numbers are
/// told apart by a hash that fits into the processor's cache; a few pass for the same.
fn has_few_numbers(field: &Field, column: &ArrayRef) -> bool {
    const HASHES: usize = 1 << 16;
    if field.is_nullable() {
        return false;
    }
    let Some(numbers) = column.as_any().downcast_ref::<Float64Array>() else {
        return true;
    };
    let most = (numbers.len() / REPEATS).min(HASHES / REPEATS);
    let mut seen = vec![false; HASHES];
    let mut different = 0;
    numbers.values().iter().all(|number| {
        let hash = FxBuildHasher.hash_one(number.to_bits()) as usize % HASHES;
        different += usize::from(!std::mem::replace(&mut seen[hash], true));
        different <= most
    })
}

/// A batch, encoded.
pub(crate) struct Columns {
    schema: TypePtr,
    columns: Vec<ArrowColumnChunk>,
}

/// Encodes a batch.
pub(super) fn encode(batch: &RecordBatch) -> io::Result<Columns> {
    let schema = batch.schema();
    let mut properties = properties();
    for (field, column) in schema.fields().iter().zip(batch.columns()) {
        let path = ColumnPath::from(field.name().as_str());
        let has_few = has_few_numbers(field, column);
        properties = properties.set_column_dictionary_enabled(path, has_few);
    }
    encode_with(batch, properties.build()).map_err(of_system)
}

fn encode_with(batch: &RecordBatch, properties: WriterProperties) -> Result<Columns, ParquetError> {
    let arrow_schema = batch.schema();
    let schema = ArrowSchemaConverter::new().convert(&arrow_schema)?;
    let schema = schema.root_schema_ptr();
    // Columns are encoded for a file that is to be, not for this one.
    let file = SerializedFileWriter::new(io::sink(), TypePtr::clone(&schema), properties.into())?;
    let factory = ArrowRowGroupWriterFactory::new(&file, SchemaRef::clone(&arrow_schema));
    let mut writers = factory.create_column_writers(0)?.into_iter();
    let mut columns = Vec::new();
    for (field, column) in arrow_schema.fields().iter().zip(batch.columns()) {
        for (leaf, mut writer) in compute_leaves(field, column)?.iter().zip(&mut writers) {
            writer.write(leaf)?;
            columns.push(writer.close()?);
        }
    }
    Ok(Columns { schema, columns })
}

impl Columns {
    /// A small file of its own.
    pub(super) fn into_bytes(self) -> io::Result<Vec<u8>> {
        let write = || {
            let properties = properties().build();
            let mut file = SerializedFileWriter::new(Vec::new(), self.schema, properties.into())?;
            append(&mut file, self.columns)?;
            file.into_inner()
        };
        write().map_err(of_system)
    }
}

/// Adds columns as a row group.
fn append(
    file: &mut SerializedFileWriter<impl Write + Send>,
    columns: Vec<ArrowColumnChunk>,
) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    for column in columns {
        column.append_to_row_group(&mut group)?;
    }
    group.close()?;
    Ok(())
}

/// A file on its way.
pub(crate) struct Joined<W: Write + Send>(SerializedFileWriter<W>);

impl<W: Write + Send> Joined<W> {
    pub(super) fn new(output: W, schema: &Schema) -> io::Result<Self> {
        let mut properties = properties().build();
        add_encoded_arrow_schema_to_metadata(schema, &mut properties);
        let columns = ArrowSchemaConverter::new()
            .convert(schema)
            .map_err(of_system)?;
        let mut writer =
            SerializedFileWriter::new(output, columns.root_schema_ptr(), Arc::new(properties))
                .map_err(of_system)?;
        let mut about: Vec<_> = schema.metadata().iter().collect();
        about.sort();
        for (key, value) in about {
            writer.append_key_value_metadata(KeyValue::new(key.clone(), value.clone()));
        }
        Ok(Self(writer))
    }

    pub(super) fn add(&mut self, part: Columns) -> io::Result<()> {
        append(&mut self.0, part.columns).map_err(of_system)
    }

    /// Adds a small file, as [`Columns::into_bytes`] makes it.
    pub(super) fn add_file(&mut self, part: Vec<u8>) -> io::Result<()> {
        let part = Bytes::from(part);
        let metadata = ParquetMetaDataReader::new()
            .parse_and_finish(&part)
            .map_err(of_system)?;
        for group in metadata.row_groups() {
            let mut joined = self.0.next_row_group().map_err(of_system)?;
            for column in group.columns() {
                let moved = ColumnCloseResult {
                    bytes_written: column.compressed_size().cast_unsigned(),
                    rows_written: group.num_rows().cast_unsigned(),
                    metadata: column.clone(),
                    bloom_filter: None,
                    column_index: None,
                    offset_index: None,
                };
                joined.append_column(&part, moved).map_err(of_system)?;
            }
            joined.close().map_err(of_system)?;
        }
        Ok(())
    }

    pub(super) fn finish(self) -> io::Result<W> {
        self.0.into_inner().map_err(of_system)
    }
}

/// The system's error inside of the crate's, as a full disk; the crate's own as a text.
fn of_system(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_repeats_has_a_dictionary() {
        let column = |number: fn(usize) -> f64| -> ArrayRef {
            Arc::new(Float64Array::from_iter_values((0..4096).map(number)))
        };
        let axis = column(|row| (row % 64) as f64);
        let sample = column(|row| (row as f64).sqrt());
        let batch = RecordBatch::try_from_iter_with_nullable([
            ("axis", Arc::clone(&axis), false),
            ("sample", sample, false),
            ("result", axis, true),
        ])
        .unwrap();
        let part = Bytes::from(encode(&batch).unwrap().into_bytes().unwrap());
        let metadata = ParquetMetaDataReader::new()
            .parse_and_finish(&part)
            .unwrap();
        let columns = metadata.row_group(0).columns().iter();
        let with: Vec<bool> = columns
            .map(|column| column.dictionary_page_offset().is_some())
            .collect();
        assert_eq!(with, [true, false, false]);
    }
}
