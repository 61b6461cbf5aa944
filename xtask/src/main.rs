//! `cargo xtask test`: everything that has to hold before a change is handed in, and its parts.
//!
//! Each step is a child `cargo` or a check of its own. Their order is: cheap ones first. The first failure ends the run.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command speaks through them"
)]

mod cargo;
mod house;
mod instructions;
mod peers;
mod pictures;
mod readers;
mod readme;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// What a step answers: why it failed.
type Outcome = Result<(), String>;

/// A part of `cargo xtask test`.
struct Step {
    name: &'static str,
    /// For the help.
    description: &'static str,
    run: fn(&Path) -> Outcome,
}

/// All parts, in the order in which `test` runs them.
const STEPS: [Step; 8] = [
    Step {
        name: "fmt",
        description: "cargo fmt --all --check",
        run: cargo::fmt,
    },
    Step {
        name: "house",
        description: "no file over 700 lines, no path of one machine, no picture or file that a document links to missing",
        run: house::check,
    },
    Step {
        name: "lint",
        description: "cargo clippy --workspace --all-targets -- -D warnings",
        run: cargo::lint,
    },
    Step {
        name: "doc",
        description: "cargo doc --no-deps --workspace, with warnings denied",
        run: cargo::doc,
    },
    Step {
        name: "tests",
        description: "cargo test --workspace: unit, integration and documentation tests",
        run: cargo::tests,
    },
    Step {
        name: "readme",
        description: "every command that README.md names is one that `rotor` and `cargo xtask` have",
        run: readme::commands,
    },
    Step {
        name: "readers",
        description: "tables of `rotor` read by pandas, polars, pyarrow, DuckDB and NumPy (needs python3)",
        run: readers::check,
    },
    Step {
        name: "instructions",
        description: "counts of the main kernels' instructions as in benches/instructions.csv (needs valgrind)",
        run: instructions::check,
    },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let root = root();
    let outcome = match words[..] {
        ["test"] => run(&root, &STEPS.iter().collect::<Vec<_>>()),
        ["pictures"] => pictures::refresh(&root),
        ["pictures", "--check"] => pictures::check(&root),
        ["instructions", "--accept"] => instructions::accept(&root),
        ["peers"] => peers::compare(&root),
        ["peers", "--quick"] => peers::quick(&root),
        ["peers", "--counts"] => peers::counts(&root),
        [] | ["help" | "--help" | "-h"] => {
            print!("{}", help());
            Ok(())
        }
        [name] if step(name).is_some() => run(&root, &step(name).into_iter().collect::<Vec<_>>()),
        _ => {
            eprint!(
                "xtask: there is no task `{}`\n\n{}",
                words.join(" "),
                help()
            );
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// The folder of the workspace, in which every child runs.
fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_owned()
}

fn step(name: &str) -> Option<&'static Step> {
    STEPS.iter().find(|step| step.name == name)
}

/// The names that `cargo xtask` takes.
fn names() -> impl Iterator<Item = &'static str> {
    STEPS
        .iter()
        .map(|step| step.name)
        .chain(["test", "pictures", "peers", "help"])
}

fn help() -> String {
    let mut text =
        String::from("cargo xtask test      all of these, in this order, until one fails\n");
    for step in &STEPS {
        text.push_str(&format!(
            "cargo xtask {:<12} {}\n",
            step.name, step.description
        ));
    }
    text.push_str(
        "\ncargo xtask pictures  draws README.md's pictures anew with `rotor report`; with --check it only compares\n",
    );
    text.push_str(
        "cargo xtask peers     times this library beside other tools and writes docs/performance.md; needs Python 3.11, gcc,\n\
         \x20                     g++, clang-19, libomp-19-dev, the network and half an hour; --quick does it in small,\n\
         \x20                     --counts counts the tools' operations anew\n",
    );
    text
}

fn run(root: &Path, steps: &[&Step]) -> Outcome {
    let mut times = Vec::new();
    for step in steps {
        println!("\n=== {}: {}", step.name, step.description);
        let start = Instant::now();
        (step.run)(root).map_err(|reason| format!("the step `{}` failed: {reason}", step.name))?;
        times.push(format!(
            "{} {:.0} s",
            step.name,
            start.elapsed().as_secs_f64()
        ));
    }
    println!("\n=== all passed: {}", times.join(", "));
    Ok(())
}
