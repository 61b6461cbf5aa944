//! The steps that are a child `cargo`. Nothing is installed: rustfmt and clippy come with the toolchain.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::Outcome;

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

pub(crate) fn doc(root: &Path) -> Outcome {
    run(cargo(root, &["doc", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "-D warnings"))
}

pub(crate) fn tests(root: &Path) -> Outcome {
    // --no-fail-fast: a run that takes minutes should say all that is wrong. A snapshot that is missing fails and is
    // not written, as on a machine of continuous integration.
    run(cargo(root, &["test", "--workspace", "--no-fail-fast"]).env("INSTA_UPDATE", "no"))
}
