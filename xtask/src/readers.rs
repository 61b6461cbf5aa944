//! `cargo xtask readers`: tables of `rotor` read by pandas, polars, pyarrow, DuckDB and NumPy.
//!
//! The tools are installed once, in the versions of `requirements.txt`, into an environment of
//! their own under `target`.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::cargo::{cargo, run};

/// Where the list of tools and the program that reads stand.
const FOLDER: &str = "rotor-cli/tests/readers";

/// A grid in which the combination region exists for two of three inertias only.
const GRID: [&str; 6] = [
    "--vary",
    "disk.polar_inertia=0.2:0.2794:3",
    "--vary",
    "crack.angle=0deg:180deg:181",
    "--quantity",
    "sir_width,cir_width",
];

const REDUCTIONS: &str = "max:crack.angle,argmin:crack.angle,mean,histogram(0,1,4)";

const EXTENSIONS: [&str; 4] = ["parquet", "arrow", "csv", "npy"];

pub(crate) fn check(root: &Path) -> Outcome {
    let place = root.join("target").join("readers");
    let tables = place.join("tables");
    fs::create_dir_all(&tables).map_err(|error| format!("{}: {error}", tables.display()))?;
    for extension in EXTENSIONS {
        let grid = tables.join(format!("grid.{extension}"));
        let reduced = tables.join(format!("reduced.{extension}"));
        scan(root, &grid, &[])?;
        scan(root, &reduced, &["--reduce", REDUCTIONS])?;
    }
    let python = environment(root, &place)?;
    run(Command::new(python)
        .arg(root.join(FOLDER).join("read.py"))
        .arg(&tables))
}

fn scan(root: &Path, output: &Path, more: &[&str]) -> Outcome {
    let mut command = cargo(
        root,
        &["run", "--quiet", "--package", "rotor-cli", "--", "scan"],
    );
    command.args(GRID).args(more).arg("-o").arg(output);
    run(&mut command)
}

/// The interpreter of an environment with the tools; it is kept while the list stays the same.
fn environment(root: &Path, place: &Path) -> Result<std::path::PathBuf, String> {
    let wanted = root.join(FOLDER).join("requirements.txt");
    let (environment, installed) = (place.join("environment"), place.join("installed.txt"));
    let binaries = if cfg!(windows) { "Scripts" } else { "bin" };
    let python = environment.join(binaries).join("python");
    let read = |path: &Path| fs::read_to_string(path).unwrap_or_default();
    if python.exists() && read(&wanted) == read(&installed) {
        return Ok(python);
    }
    run(Command::new("python3")
        .args(["-m", "venv", "--clear"])
        .arg(&environment))?;
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "-r",
    ];
    run(Command::new(&python).args(install).arg(&wanted))?;
    fs::copy(&wanted, &installed).map_err(|error| format!("{}: {error}", installed.display()))?;
    Ok(python)
}
