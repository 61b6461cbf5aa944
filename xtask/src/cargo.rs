//! The steps that are a child `cargo`. Nothing is installed: rustfmt and clippy come with the toolchain.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::{Outcome, katex};

/// The `cargo` that runs this program, in the workspace's folder, with nothing to read.
pub(crate) fn cargo(root: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .args(arguments)
        .current_dir(root)
        .stdin(Stdio::null());
    command
}

/// Runs it with its output shown as it comes.
pub(crate) fn run(command: &mut Command) -> Outcome {
    let shown = shown(command);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{shown}` ended with {status}")),
        Err(error) => Err(format!("`{shown}` could not be started: {error}")),
    }
}

/// The command as one would type it.
pub(crate) fn shown(command: &Command) -> String {
    let arguments = command
        .get_args()
        .map(|argument| argument.to_string_lossy());
    let program = Path::new(command.get_program()).file_name();
    std::iter::once(program.unwrap_or_default().to_string_lossy())
        .chain(arguments)
        .collect::<Vec<_>>()
        .join(" ")
}

pub(crate) fn fmt(root: &Path) -> Outcome {
    run(&mut cargo(root, &["fmt", "--all", "--check"]))
        .map_err(|reason| format!("{reason}; `cargo fmt --all` formats"))
}

pub(crate) fn lint(root: &Path) -> Outcome {
    run(&mut cargo(
        root,
        &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
    ))
}

/// Builds the documentation with KaTeX in it; its formulas can be read without the network.
pub(crate) fn doc(root: &Path) -> Outcome {
    let header = katex::header(root);
    // Separated as cargo has it, so that the path may have spaces.
    let flags = [
        "-D",
        "warnings",
        "--html-in-header",
        &header.to_string_lossy(),
    ]
    .join("\x1f");
    run(cargo(root, &["doc", "--no-deps", "--workspace"]).env("CARGO_ENCODED_RUSTDOCFLAGS", flags))?;
    katex::copy(root)
}

pub(crate) fn tests(root: &Path) -> Outcome {
    // --no-fail-fast: a run that takes minutes should say all that is wrong. A snapshot that is missing fails and is
    // not written, as on a machine of continuous integration.
    run(cargo(root, &["test", "--workspace", "--no-fail-fast"]).env("INSTA_UPDATE", "no"))
}
