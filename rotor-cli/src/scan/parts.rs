//! The working folder of a scan, `map.parquet.part` beside `map.parquet`: finished chunks, from
//! which an interrupted scan goes on, and from which the file is joined.
//!
//! A chunk's file has its final name only when it is complete. The request stands in the folder, so
//! that chunks of another scan are never taken for those of this one.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use rotor_core::study::{Chunk, Counts, Sink};

use super::points;
use crate::failure::Failure;
use crate::files::{Assembler, Layout, Part};
use crate::output;

/// The file with the request.
const REQUEST: &str = "request";
/// The file with the state of the reductions.
const STATE: &str = "state";
/// The file that becomes the result.
const JOINED: &str = "joined";

/// A working folder.
pub(super) struct Parts {
    folder: PathBuf,
    target: PathBuf,
}

impl Parts {
    /// Opens the working folder of a file, with what is finished if that is to be used.
    ///
    /// # Errors
    ///
    /// Where the folder cannot be made, is no working folder, or is one of another request.
    pub(super) fn open(path: &Path, request: &str, resume: bool) -> Result<Self, Failure> {
        // A link keeps pointing where it pointed: what it points to is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        if target.is_dir() {
            return Err(Failure::input(format!(
                "cannot write `{}`: it is a folder",
                path.display()
            )));
        }
        let mut folder = OsString::from(&target);
        folder.push(".part");
        let parts = Self {
            folder: PathBuf::from(folder),
            target,
        };
        if parts.folder.exists() {
            parts.enter(request, resume)?;
        }
        if !parts.folder.exists() {
            fs::create_dir(&parts.folder).map_err(|source| Failure::file("write", path, source))?;
        }
        parts.replace(REQUEST, &[request.as_bytes()])?;
        Ok(parts)
    }

    /// Takes over a working folder that is there.
    fn enter(&self, request: &str, resume: bool) -> Result<(), Failure> {
        let shown = self.folder.display();
        let Ok(found) = fs::read_to_string(self.folder.join(REQUEST)) else {
            return Err(Failure::input(format!(
                "`{shown}` is where this scan's unfinished part would go, but it is none; move it away"
            )));
        };
        if !resume {
            let finished = self.count_finished();
            if finished > 0 {
                output::remark(&format!(
                    "`{shown}` has {finished} finished chunks of an interrupted scan; they are dropped, since --resume was not given"
                ));
            }
            return self.remove();
        }
        if found == request {
            return Ok(());
        }
        let differing = found.lines().zip(request.lines()).find(|(a, b)| a != b);
        let (before, now) = differing.unwrap_or((&found, request));
        Err(Failure::input(format!(
            "--resume: `{shown}` is the unfinished part of another scan: it has \"{}\", asked for is \"{}\"; repeat \
             that scan's command, or leave --resume away to start anew",
            shortened(before),
            shortened(now)
        )))
    }

    /// How many chunks are finished.
    pub(super) fn count_finished(&self) -> usize {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let names = entries.map(|entry| entry.file_name());
        names
            .filter(|name| {
                Path::new(name)
                    .extension()
                    .is_some_and(|end| end == "chunk")
                    || name == STATE
            })
            .count()
    }

    fn place(&self, number: u64) -> PathBuf {
        self.folder.join(format!("{number:012}.chunk"))
    }

    /// Writes a file of the folder that is there whole or not at all.
    fn replace(&self, name: &str, content: &[&[u8]]) -> Result<(), Failure> {
        let (place, written) = (
            self.folder.join(name),
            self.folder.join(format!("{name}.new")),
        );
        let write = || -> io::Result<()> {
            let mut file = File::create(&written)?;
            content.iter().try_for_each(|bytes| file.write_all(bytes))?;
            fs::rename(&written, &place)
        };
        write().map_err(|source| {
            let _ = fs::remove_file(&written);
            Failure::file("write", &self.target, source)
        })
    }

    /// The state of the reductions that was kept last.
    pub(super) fn state(&self, quantities: usize) -> Option<(u64, Counts, Vec<u8>)> {
        let bytes = fs::read(self.folder.join(STATE)).ok()?;
        let (chunk, rest) = bytes.split_first_chunk::<8>()?;
        let (counts, state) = counts_from(rest, quantities)?;
        Some((u64::from_le_bytes(*chunk), counts, state.to_vec()))
    }

    /// Keeps the state of the reductions.
    pub(super) fn keep_state(
        &self,
        chunk: u64,
        counts: &Counts,
        state: &[u8],
    ) -> Result<(), Failure> {
        self.replace(
            STATE,
            &[
                &chunk.to_le_bytes(),
                &counts_bytes(counts, state.len()),
                state,
            ],
        )
    }

    /// The chunks' sink.
    pub(super) fn sink<'a>(&'a self, layout: &'a Layout, quantities: usize) -> PartsSink<'a> {
        PartsSink {
            parts: self,
            layout,
            quantities,
        }
    }

    /// Joins parts to the file, moves it to its place and removes the folder.
    ///
    /// # Errors
    ///
    /// Where the system refuses; the folder then stays.
    pub(super) fn join(
        &self,
        layout: &Layout,
        parts: impl Iterator<Item = io::Result<Part>>,
    ) -> Result<(), Failure> {
        let joined = self.folder.join(JOINED);
        let join = || -> io::Result<()> {
            let file = BufWriter::with_capacity(1 << 20, File::create(&joined)?);
            let mut assembler = Assembler::new(layout, file)?;
            for part in parts {
                assembler.add(part?)?;
            }
            assembler.finish()?;
            if let Ok(metadata) = fs::metadata(&self.target) {
                fs::set_permissions(&joined, metadata.permissions())?;
            }
            fs::rename(&joined, &self.target)
        };
        join().map_err(|source| {
            let _ = fs::remove_file(&joined);
            Failure::file("write", &self.target, source)
        })?;
        self.remove()
    }

    /// Joins the chunks.
    pub(super) fn join_chunks(
        &self,
        layout: &Layout,
        chunks: u64,
        quantities: usize,
    ) -> Result<(), Failure> {
        let part = |number| {
            let mut bytes = fs::read(self.place(number))?;
            let header = header_length(quantities);
            bytes.drain(..header.min(bytes.len()));
            Ok(Part::Bytes(bytes))
        };
        self.join(layout, (0..chunks).map(part))
    }

    /// Removes the folder with all in it.
    pub(super) fn remove(&self) -> Result<(), Failure> {
        fs::remove_dir_all(&self.folder)
            .map_err(|source| Failure::file("remove", &self.folder, source))
    }
}

/// Writes each chunk to a file of its own.
pub(super) struct PartsSink<'a> {
    parts: &'a Parts,
    layout: &'a Layout,
    quantities: usize,
}

impl Sink for PartsSink<'_> {
    type Encoded = ();
    type Error = Failure;

    fn finished(&self, number: u64) -> Option<Counts> {
        let place = self.parts.place(number);
        let length = fs::metadata(&place).ok()?.len();
        let mut header = vec![0; header_length(self.quantities)];
        io::Read::read_exact(&mut File::open(&place).ok()?, &mut header).ok()?;
        // A file that a power failure has cut off is no finished chunk.
        let content = u64::from_le_bytes(*header.first_chunk::<8>()?);
        let (counts, _) = counts_from(&header, self.quantities)?;
        (content + header.len() as u64 == length).then_some(counts)
    }

    fn encode(&self, chunk: &Chunk<'_>) -> Result<(), Failure> {
        let encoded = points::batch(chunk, &self.layout.schema, self.quantities)
            .and_then(|batch| self.layout.encode(&batch)?.into_bytes())
            .map_err(|source| Failure::file("write", &self.parts.target, source))?;
        let header = counts_bytes(chunk.counts(), encoded.len());
        let name = format!("{:012}.chunk", chunk.number());
        self.parts.replace(&name, &[&header, &encoded])
    }

    fn take(&self, _number: u64, _encoded: ()) -> Result<(), Failure> {
        Ok(())
    }
}

/// Length of what stands before a chunk's content: the content's length and the counts.
fn header_length(quantities: usize) -> usize {
    8 * (3 + quantities)
}

fn counts_bytes(counts: &Counts, content: usize) -> Vec<u8> {
    let numbers = [content as u64, counts.points, counts.no_rotor];
    let numbers = numbers.into_iter().chain(counts.missing.iter().copied());
    numbers.flat_map(u64::to_le_bytes).collect()
}

/// The counts before a content, and the content.
fn counts_from(bytes: &[u8], quantities: usize) -> Option<(Counts, &[u8])> {
    let (header, content) = bytes.split_at_checked(header_length(quantities))?;
    let mut numbers = header
        .as_chunks::<8>()
        .0
        .iter()
        .map(|bytes| u64::from_le_bytes(*bytes));
    let (_, points, no_rotor) = (numbers.next()?, numbers.next()?, numbers.next()?);
    let counts = Counts {
        points,
        no_rotor,
        missing: numbers.collect(),
    };
    Some((counts, content))
}

/// The start of a line that may list a million values.
fn shortened(line: &str) -> String {
    const MOST: usize = 120;
    match line.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}
