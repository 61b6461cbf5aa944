//! Arrow's interprocess format: parts are streams, the whole is a file with random access.

use std::io::{self, Write};

use arrow_array::RecordBatch;
use arrow_ipc::reader::StreamReader;
use arrow_ipc::writer::{FileWriter, StreamWriter};
use arrow_schema::{ArrowError, Schema};

/// Encodes a batch.
pub(super) fn encode(batch: &RecordBatch) -> io::Result<Vec<u8>> {
    let mut writer = StreamWriter::try_new(Vec::new(), &batch.schema()).map_err(of_system)?;
    writer.write(batch).map_err(of_system)?;
    writer.into_inner().map_err(of_system)
}

/// A file on its way.
pub(crate) struct Joined<W: Write>(FileWriter<W>);

impl<W: Write> Joined<W> {
    pub(super) fn new(output: W, schema: &Schema) -> io::Result<Self> {
        FileWriter::try_new(output, schema)
            .map(Self)
            .map_err(of_system)
    }

    pub(super) fn add(&mut self, part: &[u8]) -> io::Result<()> {
        for batch in StreamReader::try_new(part, None).map_err(of_system)? {
            self.0
                .write(&batch.map_err(of_system)?)
                .map_err(of_system)?;
        }
        Ok(())
    }

    pub(super) fn finish(self) -> io::Result<W> {
        self.0.into_inner().map_err(of_system)
    }
}

/// The system's error inside of the crate's, as a full disk; the crate's own as a text.
fn of_system(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        other => io::Error::other(other.to_string()),
    }
}
