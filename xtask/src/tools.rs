//! What some steps need beside a Rust toolchain.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::cargo::cargo;
use crate::semver;

/// Something that a step needs and that a Rust toolchain does not bring.
#[derive(Debug)]
pub(crate) struct Tool {
    /// As one would call it in a sentence.
    pub(crate) name: &'static str,
    /// How to have it, for whoever has not.
    pub(crate) how: &'static str,
    /// Whether machines of continuous integration have to have it: not what a registry of packages cannot give them.
    pub(crate) is_demanded: bool,
    /// Whether it is there, for the workspace in this folder.
    pub(crate) is_there: fn(&Path) -> bool,
}

/// Makes the environment into which `readers` installs the libraries that read tables.
pub(crate) static PYTHON: Tool = Tool {
    name: "python3 with its module venv",
    how: "install Python 3.11 or later (on Debian and Ubuntu: apt install python3-venv)",
    is_demanded: true,
    // Debian packs what `python3 -m venv` needs apart from Python: ensurepip is what is missing then.
    is_there: |_| answers(Command::new("python3").args(["-c", "import venv, ensurepip"])),
};

/// Counts instructions for `instructions`.
pub(crate) static VALGRIND: Tool = Tool {
    name: "valgrind",
    how: "install valgrind (on Debian and Ubuntu: apt install valgrind)",
    is_demanded: true,
    is_there: |_| answers(Command::new("valgrind").arg("--version")),
};

/// The processor that `portable` builds for, with neither threads nor files.
pub(crate) const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// The standard library for that processor, for `portable`.
pub(crate) static WASM: Tool = Tool {
    name: "Rust's standard library for wasm32-unknown-unknown",
    how: "rustup target add wasm32-unknown-unknown",
    is_demanded: false,
    is_there: |_| {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let mut folder = Command::new(rustc);
        folder.args(["--print", "target-libdir", "--target", WASM_TARGET]);
        let output = folder.stdin(Stdio::null()).output();
        // rustc names the folder whether it is there or not.
        output
            .is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
    },
};

/// Compares public items for `semver`. Without a release to compare with it is not needed.
pub(crate) static SEMVER_CHECKS: Tool = Tool {
    name: "cargo-semver-checks",
    how: "cargo install --locked cargo-semver-checks",
    is_demanded: true,
    is_there: |root| {
        semver::baseline(root).is_none()
            || answers(&mut cargo(root, &["semver-checks", "--version"]))
    },
};

/// Whether the command can be started and ends well; nobody sees what it prints.
pub(crate) fn answers(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_not_there_or_fails_does_not_answer() {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        assert!(answers(Command::new(&rustc).arg("--version")));
        assert!(!answers(Command::new(&rustc).arg("--no-such-option")));
        assert!(!answers(&mut Command::new("no-such-program-anywhere")));
    }
}
