//! Where results go: standard output, or files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, SpooledTempFile, TempDir};

use rotor_core::text::escaped;

use crate::failure::Failure;
use crate::interrupt::{self, Unfinished};
use crate::table::wrapped;

/// Writes a text to standard output.
///
/// # Errors
///
/// [`Failure::OutputClosed`] where the reader went away, [`Failure::Stream`] otherwise.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(|source| Failure::stream("write", "standard output", source))
}

/// Writes a remark to standard error, in lines that are not too wide. A closed stderr is no reason to stop.
pub(crate) fn remark(text: &str) {
    drawing(wrapped(&escaped(text), "").trim_end());
}

/// Writes to standard error what has its lines already.
pub(crate) fn drawing(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// The system's error without the temporary file's name, which would tell nobody anything.
fn without_path(error: &io::Error) -> io::Error {
    let text = error.to_string();
    let what = text.split(" at path \"").next().unwrap_or_default();
    io::Error::new(error.kind(), what)
}

/// Bytes that go to a file together.
const WRITTEN_AT_ONCE: usize = 1 << 20;

/// Up to this size, 8 MiB, what goes to a stream waits in memory, beyond it in a temporary file.
const MOST_IN_MEMORY: usize = 8 << 20;

/// Where a result goes that appears whole or not at all, by [`Destination::finish`]: standard output (`-`), a special
/// file, or a file that is written beside its place and moved there.
pub(crate) enum Destination {
    /// Kept back until it is complete.
    Stream {
        kept: SpooledTempFile,
        stream: Box<dyn Write + Send>,
        name: String,
    },
    /// Written beside the target.
    Staged {
        file: BufWriter<NamedTempFile>,
        unfinished: Unfinished,
        target: PathBuf,
        /// As the user calls it.
        named: PathBuf,
    },
}

impl Destination {
    /// Opens the destination `path`, `-` for standard output.
    ///
    /// # Errors
    ///
    /// Where the folder does not exist or cannot be written to, or `path` is a folder.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        if path.as_os_str() == "-" {
            let stdout = Box::new(io::stdout());
            return Ok(Self::to_stream(stdout, "standard output".to_owned()));
        }
        // A link keeps pointing where it pointed: what it points to is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let existing = fs::metadata(&target).ok();
        if existing.as_ref().is_some_and(fs::Metadata::is_dir) {
            return Err(Failure::input(format!(
                "cannot write `{}`: it is a folder",
                path.display()
            )));
        }
        if existing
            .as_ref()
            .is_some_and(|metadata| !metadata.is_file())
        {
            let file = File::options()
                .write(true)
                .open(&target)
                .map_err(|source| Failure::file("write", path, source))?;
            let name = format!("`{}`", path.display());
            return Ok(Self::to_stream(Box::new(file), name));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".rotor-").suffix(".part");
        match existing {
            Some(metadata) => {
                builder.permissions(metadata.permissions());
            }
            None => usual_permissions(&mut builder, 0o666),
        }
        let file = builder
            .tempfile_in(folder_of(&target))
            .map_err(|source| Failure::file("write", path, without_path(&source)))?;
        Ok(Self::Staged {
            unfinished: Unfinished::new(file.path()),
            file: BufWriter::with_capacity(WRITTEN_AT_ONCE, file),
            target,
            named: path.to_owned(),
        })
    }

    fn to_stream(stream: Box<dyn Write + Send>, name: String) -> Self {
        Self::Stream {
            kept: SpooledTempFile::new(MOST_IN_MEMORY),
            stream,
            name,
        }
    }

    /// Makes what was written appear.
    ///
    /// # Errors
    ///
    /// Where the last bytes or the move fail; a file is then as it was.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Stream {
                mut kept,
                mut stream,
                name,
            } => kept
                .rewind()
                .and_then(|()| io::copy(&mut kept, &mut stream))
                .and_then(|_| stream.flush())
                .map_err(|source| Failure::stream("write", name, source)),
            Self::Staged {
                file,
                unfinished,
                target,
                named,
            } => {
                let file = file
                    .into_inner()
                    .map_err(|error| Failure::file("write", &named, error.into_error()))?;
                let _moving = interrupt::while_moving();
                let persisted = file.persist(&target);
                drop(unfinished);
                persisted
                    .map(drop)
                    .map_err(|error| Failure::file("write", &named, error.error))
            }
        }
    }

    /// The stream's name in a message.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Stream { name, .. } => name.clone(),
            Self::Staged { named, .. } => format!("`{}`", named.display()),
        }
    }
}

impl Write for Destination {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Stream { kept, .. } => kept.write(bytes),
            Self::Staged { file, .. } => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Stream { kept, .. } => kept.flush(),
            Self::Staged { file, .. } => file.flush(),
        }
    }
}

/// A set of files of one folder, written beside it and moved in together once all of them are made.
pub(crate) struct StagedFolder {
    staging: TempDir,
    unfinished: Unfinished,
    target: PathBuf,
    names: Vec<String>,
}

impl StagedFolder {
    /// Prepares the folder `target`. Nothing appears there yet.
    ///
    /// # Errors
    ///
    /// Where `target` is a file, or the folder that holds it cannot be written to.
    pub(crate) fn new(target: &Path) -> Result<Self, Failure> {
        if fs::metadata(target).is_ok_and(|metadata| !metadata.is_dir()) {
            return Err(Failure::input(format!(
                "cannot write into `{}`: it is not a folder",
                target.display()
            )));
        }
        let parent = folder_of(target);
        fs::create_dir_all(&parent).map_err(|source| Failure::file("create", &parent, source))?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".rotor-report-");
        usual_permissions(&mut builder, 0o777);
        let staging = builder
            .tempdir_in(&parent)
            .map_err(|source| Failure::file("write", target, without_path(&source)))?;
        Ok(Self {
            unfinished: Unfinished::new(staging.path()),
            staging,
            target: target.to_owned(),
            names: Vec::new(),
        })
    }

    /// Adds a file.
    ///
    /// # Errors
    ///
    /// Where it cannot be written.
    pub(crate) fn add(&mut self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let path = self.staging.path().join(name);
        fs::write(&path, content)
            .map_err(|source| Failure::file("write", &self.target.join(name), source))?;
        self.names.push(name.to_owned());
        Ok(())
    }

    /// Makes the files appear: a new folder all at once; in an existing one all files or none, others left alone.
    ///
    /// # Errors
    ///
    /// Where a file cannot be moved; the folder is then as it was.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let Self {
            staging,
            unfinished,
            target,
            names,
        } = self;
        let moving = interrupt::while_moving();
        if !target.exists() {
            // The folder has another name from here on, so that nothing is left for the guard to remove.
            let staged = staging.keep();
            let renamed = fs::rename(&staged, &target);
            drop(unfinished);
            return renamed.map_err(|source| {
                let _ = fs::remove_dir_all(&staged);
                Failure::file("create", &target, source)
            });
        }
        let swap = Swap {
            new: staging.path().to_owned(),
            old: staging.path().join("replaced"),
            target,
        };
        fs::create_dir(&swap.old).map_err(|source| Failure::file("write", &swap.target, source))?;
        for (index, name) in names.iter().enumerate() {
            if let Err(source) = swap.replace(name) {
                names
                    .iter()
                    .take(index)
                    .rev()
                    .for_each(|name| swap.undo(name));
                return Err(Failure::file("write", &swap.target.join(name), source));
            }
        }
        drop(moving);
        Ok(())
    }
}

/// Files on their way into a folder, and those of the same names on their way out.
struct Swap {
    new: PathBuf,
    old: PathBuf,
    target: PathBuf,
}

impl Swap {
    /// Moves a new file to its place, what stood there aside.
    fn replace(&self, name: &str) -> io::Result<()> {
        let place = self.target.join(name);
        match fs::symlink_metadata(&place) {
            Ok(found) if found.is_dir() => return Err(io::Error::other("it is a folder")),
            Ok(_) => fs::rename(&place, self.old.join(name))?,
            Err(_) => {}
        }
        fs::rename(self.new.join(name), &place).inspect_err(|_| self.put_back(name))
    }

    /// Takes a new file away again.
    fn undo(&self, name: &str) {
        // What stood there before replaces it in one step; without that it is removed.
        if self.old.join(name).symlink_metadata().is_ok() {
            self.put_back(name);
        } else {
            let _ = fs::remove_file(self.target.join(name));
        }
    }

    fn put_back(&self, name: &str) {
        let _ = fs::rename(self.old.join(name), self.target.join(name));
    }
}

/// The folder in which a path lies.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Gives what the builder makes the permissions of any new file or folder, the user's mask applied by the system;
/// a temporary file would be its owner's alone.
#[cfg(unix)]
fn usual_permissions(builder: &mut tempfile::Builder<'_, '_>, mode: u32) {
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
}

/// Elsewhere new files inherit the permissions of their folder.
#[cfg(not(unix))]
fn usual_permissions(_builder: &mut tempfile::Builder<'_, '_>, _mode: u32) {}
