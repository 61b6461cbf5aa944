//! A scan's table to standard output or a special file: as it comes, nothing kept.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::Mutex;

use arrow_array::RecordBatch;
use rotor_core::study::{Chunk, Sink};

use super::points;
use crate::failure::Failure;
use crate::files::{Assembler, Layout, Part};

type Stream = Box<dyn Write + Send>;

fn open(path: &Path) -> Result<(Stream, String), Failure> {
    if path.as_os_str() == "-" {
        return Ok((Box::new(io::stdout()), "standard output".to_owned()));
    }
    let file = File::options()
        .write(true)
        .open(path)
        .map_err(|source| Failure::file("write", path, source))?;
    Ok((Box::new(file), format!("`{}`", path.display())))
}

/// Writes the chunks as they come.
pub(super) struct StreamSink<'a> {
    layout: &'a Layout,
    quantities: usize,
    name: String,
    assembler: Mutex<Assembler<BufWriter<Stream>>>,
}

impl<'a> StreamSink<'a> {
    pub(super) fn open(
        path: &Path,
        layout: &'a Layout,
        quantities: usize,
    ) -> Result<Self, Failure> {
        let (stream, name) = open(path)?;
        let assembler = Assembler::new(layout, BufWriter::new(stream))
            .map_err(|source| Failure::stream("write", name.as_str(), source))?;
        Ok(Self {
            layout,
            quantities,
            name,
            assembler: Mutex::new(assembler),
        })
    }

    fn failed(&self, source: io::Error) -> Failure {
        Failure::stream("write", self.name.as_str(), source)
    }

    pub(super) fn finish(self) -> Result<(), Failure> {
        let Self {
            name, assembler, ..
        } = self;
        let assembler = assembler
            .into_inner()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        let finished = assembler.finish().map(drop);
        finished.map_err(|source| Failure::stream("write", name, source))
    }
}

impl Sink for StreamSink<'_> {
    type Encoded = Part;
    type Error = Failure;

    fn encode(&self, chunk: &Chunk<'_>) -> Result<Part, Failure> {
        points::batch(chunk, &self.layout.schema, self.quantities)
            .and_then(|batch| self.layout.encode(&batch))
            .map_err(|source| self.failed(source))
    }

    fn take(&self, _number: u64, encoded: Part) -> Result<(), Failure> {
        let mut assembler = self
            .assembler
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        assembler.add(encoded).map_err(|source| self.failed(source))
    }
}

/// Writes a table of one part.
pub(super) fn write_whole(
    path: &Path,
    layout: &Layout,
    batch: &RecordBatch,
) -> Result<(), Failure> {
    let (stream, name) = open(path)?;
    let write = || -> io::Result<()> {
        let mut assembler = Assembler::new(layout, BufWriter::new(stream))?;
        assembler.add(layout.encode(batch)?)?;
        assembler.finish().map(drop)
    };
    write().map_err(|source| Failure::stream("write", name, source))
}
