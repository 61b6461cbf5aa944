//! `cargo xtask peers`: this library beside other tools, in a Python environment of its own under the build folder.
//!
//! No part of `cargo xtask test`: it downloads the tools, whose versions are pinned, and takes minutes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::cargo::{cargo, run};

/// Where the other tools' side stands.
const FOLDER: &str = "benches/peers";

/// Times everything, and writes `docs/performance.md` with its chart.
pub(crate) fn compare(root: &Path) -> Outcome {
    timed(root, &[])
}

/// The same in small, to see whether it runs; writes nothing outside the build folder.
pub(crate) fn quick(root: &Path) -> Outcome {
    timed(root, &["--quick"])
}

/// Counts the operations of the other tools' code on the corpus anew.
pub(crate) fn counts(root: &Path) -> Outcome {
    let folder = prepared(root)?;
    python(
        root,
        &folder,
        &[
            "op_counts.py",
            &folder.to_string_lossy(),
            "benches/corpus/op_counts.csv",
        ],
    )
}

fn timed(root: &Path, options: &[&str]) -> Outcome {
    let folder = prepared(root)?;
    let measure = target(root).join("release").join("measure");
    let (place, program) = (folder.to_string_lossy(), measure.to_string_lossy());
    let mut arguments = vec!["compare.py", &place, &program];
    arguments.extend(options);
    python(root, &folder, &arguments)
}

/// The build folder.
pub(crate) fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root.join("target"), |folder| root.join(folder))
}

/// The folder of the comparison, with the Python environment and the formulas as Python.
fn prepared(root: &Path) -> Result<PathBuf, String> {
    let folder = target(root).join("peers");
    fs::create_dir_all(&folder).map_err(|error| format!("a folder cannot be made: {error}"))?;
    environment(root, &folder)?;
    let package = ["build", "--release", "--package", "rotor-benches", "--bins"];
    run(&mut cargo(root, &package))?;
    let export = target(root).join("release").join("export");
    program(Command::new(export).arg(&folder).current_dir(root))?;
    Ok(folder)
}

/// Makes the Python environment, unless it is there with these versions.
fn environment(root: &Path, folder: &Path) -> Outcome {
    let requirements = root.join(FOLDER).join("requirements.txt");
    let wanted = fs::read(&requirements).map_err(|error| format!("{FOLDER}: {error}"))?;
    let installed = folder.join("installed.txt");
    if fs::read(&installed).is_ok_and(|known| known == wanted) {
        return Ok(());
    }
    let place = folder.join("python");
    program(Command::new("python3").args(["-m", "venv"]).arg(&place))?;
    let mut pip = Command::new(place.join("bin/python"));
    pip.args(["-m", "pip", "install", "--quiet", "--requirement"])
        .arg(&requirements);
    program(&mut pip)?;
    fs::write(&installed, wanted).map_err(|error| format!("{}: {error}", installed.display()))
}

fn python(root: &Path, folder: &Path, arguments: &[&str]) -> Outcome {
    let [script, rest @ ..] = arguments else {
        return Ok(());
    };
    let mut command = Command::new(folder.join("python/bin/python"));
    command
        .arg(root.join(FOLDER).join(script))
        .args(rest)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(root);
    program(&mut command)
}

fn program(command: &mut Command) -> Outcome {
    let name = command.get_program().to_string_lossy().into_owned();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{name}` ended with {status}")),
        Err(error) => Err(format!("`{name}` could not be started: {error}")),
    }
}
