//! README.md's pictures, drawn by the command itself.
//!
//! `cargo xtask test` checks that they are there, not that they are the same bytes: the last digit of a sine may differ
//! from one machine's mathematical library to the next, and with it the shade of a pixel.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Outcome;
use crate::cargo::{cargo, run};

/// The pictures of the report on the paper's rotor that README.md shows.
const PICTURES: [&str; 2] = ["figure-4.png", "map-cir.png"];

/// Their folder.
const FOLDER: &str = "docs/pictures";

/// Draws them anew and says which have changed.
pub(crate) fn refresh(root: &Path) -> Outcome {
    let drawn = draw(root)?;
    let folder = root.join(FOLDER);
    fs::create_dir_all(&folder).map_err(|error| format!("{FOLDER} cannot be made: {error}"))?;
    for name in PICTURES {
        let (new, old) = (fs::read(drawn.join(name)), fs::read(folder.join(name)));
        let new = new.map_err(|error| format!("rotor report drew no {name}: {error}"))?;
        let same = old.is_ok_and(|old| old == new);
        if !same {
            fs::write(folder.join(name), new)
                .map_err(|error| format!("{FOLDER}/{name} cannot be written: {error}"))?;
        }
        println!(
            "{FOLDER}/{name}: {}",
            if same { "as it was" } else { "drawn anew" }
        );
    }
    Ok(())
}

/// Says which would change.
pub(crate) fn check(root: &Path) -> Outcome {
    let drawn = draw(root)?;
    let folder = root.join(FOLDER);
    let differing: Vec<_> = PICTURES
        .into_iter()
        .filter(|name| {
            let (new, old) = (fs::read(drawn.join(name)), fs::read(folder.join(name)));
            !matches!((new, old), (Ok(new), Ok(old)) if new == old)
        })
        .collect();
    if differing.is_empty() {
        println!("all as the command draws them");
        Ok(())
    } else {
        Err(format!(
            "not as the command draws them now: {}; `cargo xtask pictures` draws them anew",
            differing.join(", ")
        ))
    }
}

/// Reports on the paper's rotor into the build folder.
fn draw(root: &Path) -> Result<PathBuf, String> {
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root.join("target"), |folder| root.join(folder));
    let folder = target.join("pictures");
    let mut command = cargo(
        root,
        &[
            "run",
            "--release",
            "--package",
            "rotor-cli",
            "--",
            "report",
            "-o",
        ],
    );
    run(command.arg(&folder))?;
    Ok(folder)
}
