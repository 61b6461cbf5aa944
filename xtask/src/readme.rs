//! What README.md promises is there.

use std::fs;
use std::path::Path;

use crate::cargo::{cargo, shown};
use crate::{Outcome, names};

/// How the command `rotor` is run from the workspace.
const RELEASE: &str = "cargo run --release";

/// The documents whose links are followed.
const DOCUMENTS: [&str; 4] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
];

/// The files and pictures that the documents link to and that are not there.
pub(crate) fn missing_files(root: &Path) -> Vec<String> {
    let mut complaints = Vec::new();
    for document in DOCUMENTS {
        match fs::read_to_string(root.join(document)) {
            Ok(text) => complaints.extend(
                links(&text)
                    .into_iter()
                    .filter(|link| !root.join(link).exists())
                    .map(|link| format!("{document}: there is no {link}")),
            ),
            Err(error) => complaints.push(format!("{document}: cannot be read: {error}")),
        }
    }
    complaints
}

/// Targets of the links within the repository: `](target)`.
fn links(text: &str) -> Vec<&str> {
    text.split("](")
        .skip(1)
        .filter_map(|rest| rest.split([')', '#']).next())
        .filter(|link| !link.is_empty() && !link.contains("://"))
        .collect()
}

/// Asks each command for its help, which is an error if there is no such command.
pub(crate) fn commands(root: &Path) -> Outcome {
    let text = fs::read_to_string(root.join("README.md"))
        .map_err(|error| format!("README.md cannot be read: {error}"))?;
    let named = named_commands(&text);
    if named.is_empty() {
        return Err("README.md has no block of commands".to_owned());
    }
    for command in &named {
        println!("{command}");
        match command.split_once(' ') {
            Some(("xtask", task)) if names().any(|name| name == task) => {}
            Some(("rotor", subcommand)) => asks_for_help(root, subcommand)?,
            _ => return Err(format!("README.md names `{command}`, which there is not")),
        }
    }
    Ok(())
}

fn asks_for_help(root: &Path, subcommand: &str) -> Outcome {
    // The same profile as the tests', so that nothing is built again.
    let arguments = [
        "run",
        "--quiet",
        "--package",
        "rotor-cli",
        "--",
        subcommand,
        "--help",
    ];
    let mut command = cargo(root, &arguments);
    let output = command
        .output()
        .map_err(|error| format!("`{}` could not be started: {error}", shown(&command)))?;
    if output.status.success() {
        return Ok(());
    }
    let message = String::from_utf8_lossy(&output.stderr);
    Err(format!(
        "README.md names `rotor {subcommand}`: {}",
        message.trim_end()
    ))
}

/// `xtask NAME` and `rotor NAME` for every line of the blocks marked `sh`, each once.
fn named_commands(text: &str) -> Vec<String> {
    let mut named = Vec::new();
    let mut within = false;
    for line in text.lines() {
        if line.starts_with("```") {
            within = line == "```sh";
            continue;
        }
        for part in line.split(['|', '&']).filter(|_| within) {
            let part = part.split('#').next().unwrap_or_default().trim();
            let command = if let Some(rest) = part.strip_prefix("cargo xtask ") {
                format!("xtask {}", first_word(rest))
            } else if let Some(rest) = part.strip_prefix(RELEASE) {
                // Without a command it is the report.
                let rest = rest.trim_start().strip_prefix("--").unwrap_or("report");
                format!("rotor {}", first_word(rest))
            } else if let Some(rest) = part.strip_prefix("rotor ") {
                format!("rotor {}", first_word(rest))
            } else {
                continue;
            };
            if !named.contains(&command) {
                named.push(command);
            }
        }
    }
    named
}

fn first_word(text: &str) -> &str {
    text.split_whitespace().next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_read_from_blocks_only() {
        let text = "rotor nothing\n```sh\ncargo run --release   # all\ncargo run --release -- zup a.toml\nrotor init -o - | rotor zup -\n\
            cargo xtask test\n```\n```rust\nrotor neither\n```\n";
        assert_eq!(
            named_commands(text),
            ["rotor report", "rotor zup", "rotor init", "xtask test"]
        );
    }

    #[test]
    fn links_are_those_into_the_repository() {
        let text = "![Figure](docs/pictures/figure-4.png) and [this](https://example.org/a) or [that](A.md#part)";
        assert_eq!(links(text), ["docs/pictures/figure-4.png", "A.md"]);
    }
}
