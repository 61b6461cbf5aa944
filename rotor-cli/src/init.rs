//! `rotor init`: a rotor file to start from.

use std::io::Write as _;

use rotor_core::file;

use crate::command_line::InitArguments;
use crate::failure::{Failure, Outcome};
use crate::output::{self, Destination};

/// Writes the file.
///
/// # Errors
///
/// Where the file exists and `--force` is not given, or it cannot be written.
pub(crate) fn run(arguments: &InitArguments) -> Result<Outcome, Failure> {
    let path = &arguments.output;
    let to_stdout = path.as_os_str() == "-";
    if !to_stdout && !arguments.force && path.symlink_metadata().is_ok() {
        return Err(Failure::input(format!(
            "`{}` exists already: give another name with -o, or write over it with --force",
            path.display()
        )));
    }
    let mut destination = Destination::open(path)?;
    let name = destination.name();
    destination
        .write_all(file::template().as_bytes())
        .map_err(|source| Failure::stream("write", name, source))?;
    destination.finish()?;
    if !to_stdout {
        output::print(&format!("wrote {}\n", path.display()))?;
    }
    Ok(Outcome::Passed)
}
