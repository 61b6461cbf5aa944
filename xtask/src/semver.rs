//! `cargo xtask semver`: what is public in the library crates against the newest release.
//!
//! A release is a tag of git, such as v0.1.0. Packages of a registry are not asked for: some of these crates have names
//! that belong to other projects there.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::Outcome;
use crate::cargo::{cargo, run};

/// The crates whose public items others build on. That of macros is not one of them: cargo-semver-checks reads no macros.
const LIBRARIES: [&str; 4] = ["codegen", "lanes", "rotor-core", "rotor-plot"];

/// Compares each library with what it was in the newest release, if there is one.
pub(crate) fn check(root: &Path) -> Outcome {
    let Some(tag) = baseline(root) else {
        println!("no baseline yet: this clone has no tag of a release, such as v0.1.0");
        return Ok(());
    };
    for library in LIBRARIES {
        if !released(root, &tag, library) {
            println!("{library}: not in {tag}");
            continue;
        }
        let mut command = cargo(root, &["semver-checks", "--baseline-rev", &tag]);
        run(command.args(["--package", library]))?;
    }
    Ok(())
}

/// The tag of the newest release. There is none where git or its data is missing, as in an unpacked archive.
pub(crate) fn baseline(root: &Path) -> Option<String> {
    let output = git(root, &["tag", "--list", "v*"]).output().ok()?;
    newest(&String::from_utf8_lossy(&output.stdout)).map(str::to_owned)
}

/// Whether the release has the library.
fn released(root: &Path, tag: &str, library: &str) -> bool {
    let manifest = format!("{tag}:{library}/Cargo.toml");
    crate::tools::answers(&mut git(root, &["cat-file", "-e", &manifest]))
}

fn git(root: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new("git");
    command
        .args(arguments)
        .current_dir(root)
        .stdin(Stdio::null());
    command
}

/// The newest of these tags, one a line. Others than of three numbers are no releases.
fn newest(tags: &str) -> Option<&str> {
    tags.lines()
        .filter_map(|tag| {
            let numbers = tag.strip_prefix('v')?.split('.').map(str::parse::<u64>);
            let numbers: Vec<u64> = numbers.collect::<Result<_, _>>().ok()?;
            (numbers.len() == 3).then_some((numbers, tag))
        })
        .max()
        .map(|(_, tag)| tag)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_release_is_that_of_the_largest_numbers() {
        assert_eq!(newest("v0.2.0\nv0.10.0\nv0.9.1\n"), Some("v0.10.0"));
        assert_eq!(
            newest("v1.0.0\nv1.1.0-rc.1\nvery-old\nv2\n"),
            Some("v1.0.0")
        );
        assert_eq!(newest(""), None);
        assert_eq!(newest("very-old\n"), None);
    }
}
