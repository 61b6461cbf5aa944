//! `cargo xtask instructions`: how many instructions the main kernels take, against `benches/instructions.csv`.
//!
//! Counted by callgrind at the level AVX2 (it knows none beyond), in a release build: counts do not jitter as times do. A
//! kernel that takes 3 % more than it did fails; one that takes 3 % fewer does too, so that the gain is kept.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::Outcome;
use crate::cargo::{cargo, run};

/// The cases of `measure` that are counted, and the function of each.
const CASES: [&str; 5] = [
    "widths_block",
    "grid_sigma_phi",
    "max_over_phi",
    "physical_values",
    "physical_gradients",
];

/// The counts that are kept.
const TABLE: &str = "benches/instructions.csv";

/// Sizes of the grid, of the depths and of the angles, small: a kernel takes as many instructions per point anywhere.
const SIZES: [&str; 3] = ["200", "20", "2000"];

/// How far a count may be off, relative.
const ALLOWED: f64 = 0.03;

/// Compares the counts.
pub(crate) fn check(root: &Path) -> Outcome {
    let found = counts(root)?;
    let table =
        fs::read_to_string(root.join(TABLE)).map_err(|error| format!("{TABLE}: {error}"))?;
    let mut wrong = Vec::new();
    for (case, count) in &found {
        let known = table
            .lines()
            .filter_map(|line| line.split_once(','))
            .find(|(name, _)| name == case)
            .and_then(|(_, count)| count.parse::<u64>().ok());
        let Some(known) = known else {
            wrong.push(format!("{case} is not in {TABLE}"));
            continue;
        };
        let ratio = *count as f64 / known as f64;
        println!(
            "{case:<20} {count:>12} instructions, {:+.2} %",
            100.0 * (ratio - 1.0)
        );
        if (ratio - 1.0).abs() > ALLOWED {
            wrong.push(format!(
                "{case} takes {count} instructions, {known} are kept in {TABLE}"
            ));
        }
    }
    if wrong.is_empty() {
        Ok(())
    } else {
        let hint = "where that is meant, `cargo xtask instructions --accept` keeps the new counts";
        Err(format!("{}; {hint}", wrong.join("; ")))
    }
}

/// Keeps the counts as they are now.
pub(crate) fn accept(root: &Path) -> Outcome {
    let mut table = String::from("case,instructions\n");
    for (case, count) in counts(root)? {
        table.push_str(&format!("{case},{count}\n"));
    }
    fs::write(root.join(TABLE), table).map_err(|error| format!("{TABLE}: {error}"))
}

fn counts(root: &Path) -> Result<Vec<(&'static str, u64)>, String> {
    let package = ["build", "--release", "--package", "rotor-benches", "--bins"];
    run(&mut cargo(root, &package))?;
    let program = crate::peers::target(root).join("release").join("measure");
    CASES
        .into_iter()
        .map(|case| Ok((case, count(&program, case)?)))
        .collect()
}

/// The instructions of one run of a case whose memory is there, without what prepares it: those of two runs but for the
/// first's.
fn count(program: &Path, case: &str) -> Result<u64, String> {
    let [one, two] = [1, 2].map(|runs| collected(program, case, runs));
    let (one, two) = (one?, two?);
    let count = two.checked_sub(one).filter(|count| *count > 0);
    count.ok_or_else(|| format!("{case} took {one} instructions once, and {two} twice"))
}

/// The instructions of so many runs.
fn collected(program: &Path, case: &str, runs: usize) -> Result<u64, String> {
    let failed = |error: std::io::Error| {
        format!("valgrind cannot be run: {error}; it is a package of that name on most systems")
    };
    let mut command = Command::new("valgrind");
    command
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(format!("--toggle-collect=*cases*{case}*"))
        .arg(program)
        .args(SIZES)
        .env("LANES_LEVEL", "avx2")
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    if let Some(mut input) = child.stdin.take() {
        // Where the program has ended already, its own message says why.
        let _ = input.write_all(format!("run {case}\n").repeat(runs).as_bytes());
    }
    let output = child.wait_with_output().map_err(failed)?;
    let said = String::from_utf8_lossy(&output.stderr);
    let collected = said
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .and_then(|(_, count)| count.trim().parse::<u64>().ok())
        .filter(|count| *count > 0);
    collected.ok_or_else(|| format!("valgrind counted nothing for {case}: {said}"))
}
