//! `cargo xtask test`: everything that has to hold before a change is handed in, and its parts.
//!
//! Each step is a child `cargo` or a check of its own. Their order is: cheap ones first. The first failure ends the run.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command speaks through them"
)]

mod cargo;
mod features;
mod house;
mod instructions;
mod katex;
mod peers;
mod pictures;
mod readers;
mod readme;
mod semver;
mod step;
mod tools;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use step::{Choice, Missing, Step};
use tools::{PYTHON, SEMVER_CHECKS, VALGRIND, WASM};

/// What a step answers: why it failed.
type Outcome = Result<(), String>;

/// All parts, in the order in which `test` runs them.
static STEPS: [Step; 11] = [
    Step {
        name: "fmt",
        description: "cargo fmt --all --check",
        needs: None,
        run: cargo::fmt,
    },
    Step {
        name: "house",
        description: "no file over 700 lines, no path of one machine, no picture or file that a document links to missing",
        needs: None,
        run: house::check,
    },
    Step {
        name: "lint",
        description: "cargo clippy --workspace --all-targets -- -D warnings",
        needs: None,
        run: cargo::lint,
    },
    Step {
        name: "doc",
        description: "cargo doc --no-deps --workspace, with warnings denied and formulas shown by KaTeX",
        needs: None,
        run: cargo::doc,
    },
    Step {
        name: "tests",
        description: "cargo test --workspace: unit, integration and documentation tests",
        needs: None,
        run: cargo::tests,
    },
    Step {
        name: "features",
        description: "tests of rotor-core without features, where scans have one thread, and with all of them",
        needs: None,
        run: features::check,
    },
    Step {
        name: "portable",
        description: "rotor-core without features built for wasm32-unknown-unknown (needs that target)",
        needs: Some(&WASM),
        run: features::wasm,
    },
    Step {
        name: "semver",
        description: "public items of the libraries against the newest release, if any (needs cargo-semver-checks)",
        needs: Some(&SEMVER_CHECKS),
        run: semver::check,
    },
    Step {
        name: "readme",
        description: "every command that README.md names is one that `rotor` and `cargo xtask` have",
        needs: None,
        run: readme::commands,
    },
    Step {
        name: "readers",
        description: "tables of `rotor` read by pandas, polars, pyarrow, DuckDB and NumPy (needs python3)",
        needs: Some(&PYTHON),
        run: readers::check,
    },
    Step {
        name: "instructions",
        description: "counts of the main kernels' instructions as in benches/instructions.csv (needs valgrind)",
        needs: Some(&VALGRIND),
        run: instructions::check,
    },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let root = root();
    let outcome = match words[..] {
        ["test"] => test(&root, false),
        ["test", "--all"] => test(&root, true),
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
        // What is asked for by its name is not left out.
        [name] if step(name).is_some() => run(&root, step(name), Missing::Failure),
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
    let mut text = String::from(
        "cargo xtask test      all of these, in this order, until one fails; what needs a tool that is not there is\n\
        \x20                     left out, which the end says; with --all it fails, and where CI is set if packages have it\n",
    );
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

/// Everything that has to hold before a change is handed in.
fn test(root: &Path, all: bool) -> Outcome {
    let ci = std::env::var("CI").ok();
    run(root, &STEPS, Missing::of(all, ci.as_deref()))
}

fn run(root: &Path, steps: impl IntoIterator<Item = &'static Step>, missing: Missing) -> Outcome {
    let choice = Choice::of(steps, |tool| (tool.is_there)(root), missing)?;
    let mut times = Vec::new();
    for step in &choice.run {
        println!("\n=== {}: {}", step.name, step.description);
        let start = Instant::now();
        (step.run)(root).map_err(|reason| format!("the step `{}` failed: {reason}", step.name))?;
        times.push(format!(
            "{} {:.0} s",
            step.name,
            start.elapsed().as_secs_f64()
        ));
    }
    if choice.left_out.is_empty() {
        println!("\n=== all passed: {}", times.join(", "));
    } else {
        println!("\n=== passed: {}", times.join(", "));
        println!(
            "=== left out, because a tool is missing here:\n{}",
            choice.reasons()
        );
    }
    Ok(())
}
