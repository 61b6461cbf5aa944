//! Rotor files: read from the disk or from standard input, with every mistake shown at its line.

mod diagnostic;

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use rotor_core::file;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::text::brief;

use crate::failure::Failure;
use diagnostic::draw;

/// A rotor and what to call it in a report.
#[derive(Clone, Debug)]
pub(crate) struct NamedRotor {
    /// The validated rotor.
    pub(crate) rotor: Rotor,
    /// `the paper's rotor`, or the file's name.
    pub(crate) name: String,
}

/// Reads the rotor of a file, of standard input (`-`), or the paper's rotor where there is no file.
///
/// # Errors
///
/// Where the file cannot be read or describes no rotor; every mistake is shown, each at its line.
pub(crate) fn load(path: Option<&Path>) -> Result<NamedRotor, Failure> {
    let Some(path) = path else {
        return Ok(NamedRotor {
            rotor: Rotor::paper(),
            name: "the paper's rotor".to_owned(),
        });
    };
    let (text, name) = read(path)?;
    match file::parse(&text) {
        Ok(rotor) => Ok(NamedRotor { rotor, name }),
        Err(mistakes) => Err(Failure::rendered(draw(&text, &name, &mistakes))),
    }
}

/// The inputs that stand in for those without a column: of a file, of standard input (`-`), or the paper's. What is
/// said of the `replaced` ones does not matter.
///
/// # Errors
///
/// Where the file cannot be read, or no column can make it a rotor.
pub(crate) fn load_base(
    path: Option<&Path>,
    replaced: &[&'static str],
) -> Result<RotorParameters, Failure> {
    let Some(path) = path else {
        return Ok(RotorParameters::PAPER);
    };
    let (text, name) = read(path)?;
    file::parse_base(&text, replaced)
        .map_err(|mistakes| Failure::rendered(draw(&text, &name, &mistakes)))
}

/// A rotor file has a few hundred bytes; this much is something else.
const LONGEST: u64 = 1 << 20;

/// The text of a file, and what to call it.
fn read(path: &Path) -> Result<(String, String), Failure> {
    let mut bytes = Vec::new();
    let name = if path.as_os_str() == "-" {
        let name = "standard input".to_owned();
        let mut taken = io::stdin().lock().take(LONGEST + 1);
        taken
            .read_to_end(&mut bytes)
            .map_err(|source| Failure::stream("read", &name, source))?;
        name
    } else {
        File::open(path)
            .and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes))
            .map_err(|source| Failure::file("read", path, source))?;
        brief(&path.display().to_string())
    };
    if bytes.len() as u64 > LONGEST {
        return Err(Failure::input(format!(
            "`{name}` is longer than {LONGEST} bytes; this is no rotor file"
        )));
    }
    Ok((decode(bytes, &name)?, name))
}

fn decode(bytes: Vec<u8>, name: &str) -> Result<String, Failure> {
    let mut text = String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
        let hint = match error.as_bytes() {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => " (it is UTF-16)",
            _ => "",
        };
        Failure::input(format!(
            "`{name}` is not UTF-8{hint}: line {line}; save it as UTF-8"
        ))
    })?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}
