//! `cargo xtask peers`: this library beside other tools, in Python environments of its own under the build folder.
//!
//! No part of `cargo xtask test`: it downloads the tools, whose versions are pinned, and takes minutes. The compilers of C are
//! the system's; a build whose compiler is not there is left out, and the page says so.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::cargo::{cargo, run};

/// Where the other tools' side stands.
const FOLDER: &str = "benches/peers";

/// The Python environments by their folders, with their lists of packages: the newest Numba has no vector mathematics in its
/// wheels, so the last one that has it needs an older NumPy beside it.
const ENVIRONMENTS: [(&str, &str); 2] = [
    ("python", "requirements.txt"),
    ("python-svml", "requirements-svml.txt"),
];

/// Times everything, and writes `docs/performance.md` with its chart.
pub(crate) fn compare(root: &Path) -> Outcome {
    timed(root, &[])
}

/// Times small inputs, to see whether everything runs; writes nothing outside the build folder.
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
    run(&mut cargo(
        root,
        &["build", "--release", "--package", "rotor-cli"],
    ))?;
    let programs = target(root).join("release");
    let (place, programs) = (folder.to_string_lossy(), programs.to_string_lossy());
    let mut arguments = vec!["compare.py", &place, &programs];
    arguments.extend(options);
    python(root, &folder, &arguments)
}

/// The build folder.
pub(crate) fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root.join("target"), |folder| root.join(folder))
}

/// The folder of the comparison, with the Python environments and the formulas as Python.
fn prepared(root: &Path) -> Result<PathBuf, String> {
    let folder = target(root).join("peers");
    fs::create_dir_all(&folder).map_err(|error| format!("a folder cannot be made: {error}"))?;
    for (name, packages) in ENVIRONMENTS {
        environment(root, &folder, name, packages)?;
    }
    let package = ["build", "--release", "--package", "rotor-benches", "--bins"];
    run(&mut cargo(root, &package))?;
    let export = target(root).join("release").join("export");
    program(Command::new(export).arg(&folder).current_dir(root))?;
    Ok(folder)
}

/// Makes a Python environment, unless it is there with these versions.
fn environment(root: &Path, folder: &Path, name: &str, packages: &str) -> Outcome {
    let requirements = root.join(FOLDER).join(packages);
    let wanted = fs::read(&requirements).map_err(|error| format!("{FOLDER}: {error}"))?;
    let installed = folder.join(format!("installed-{name}.txt"));
    if fs::read(&installed).is_ok_and(|known| known == wanted) {
        return Ok(());
    }
    let place = folder.join(name);
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
