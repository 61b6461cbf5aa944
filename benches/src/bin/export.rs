//! Writes what the Python side of `peers/` reads into the folder named as the argument: `formulas.py`, `formulas.json`.
#![allow(clippy::print_stderr, reason = "a command speaks through it")]

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use rotor_benches::export::{descriptions, python_text};

fn main() -> ExitCode {
    let Some(folder) = std::env::args().nth(1) else {
        eprintln!("export: name the folder to write into");
        return ExitCode::from(2);
    };
    match write(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("export: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("formulas.py"), python_text()?)?;
    fs::write(
        folder.join("formulas.json"),
        format!("{:#}", descriptions()?),
    )?;
    Ok(())
}
