//! Checks of the files themselves, without building anything.

use std::fs;
use std::path::{Path, PathBuf};

use crate::{Outcome, readme};

/// Longer than this no file of source code may be: then it has more than one subject.
const MOST_LINES: usize = 700;

/// Folders that are built or belong to a tool.
const SKIPPED: [&str; 3] = ["target", ".git", "rotor-report"];

/// What is read as text.
const TEXT: [&str; 10] = [
    "rs", "md", "toml", "py", "css", "yml", "csv", "snap", "stderr", "lock",
];

/// First folders of paths that only one machine has.
const MACHINE_FOLDERS: [&str; 7] = ["home", "Users", "tmp", "work", "root", "mnt", "opt"];

pub(crate) fn check(root: &Path) -> Outcome {
    let mut complaints = Vec::new();
    let mut files = Vec::new();
    walk(root, &mut files).map_err(|error| format!("the folder cannot be read: {error}"))?;
    files.sort();
    for file in &files {
        let Ok(text) = fs::read_to_string(file) else {
            complaints.push(format!("{}: not UTF-8 text", relative(root, file)));
            continue;
        };
        complaints.extend(complaints_about(&relative(root, file), &text));
    }
    complaints.extend(readme::missing_files(root));
    println!("{} files read", files.len());
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(complaints.join("\n  "))
    }
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            if !SKIPPED.contains(&name.as_str()) {
                walk(&path, files)?;
            }
        } else if path
            .extension()
            .is_some_and(|extension| TEXT.iter().any(|known| extension == *known))
        {
            files.push(path);
        }
    }
    Ok(())
}

fn relative(root: &Path, file: &Path) -> String {
    file.strip_prefix(root)
        .unwrap_or(file)
        .display()
        .to_string()
}

/// What is wrong with a file.
fn complaints_about(name: &str, text: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    let lines = text.lines().count();
    if name.ends_with(".rs") && lines > MOST_LINES {
        complaints.push(format!("{name}: {lines} lines, more than {MOST_LINES}"));
    }
    for (index, line) in text.lines().enumerate() {
        if let Some(path) = machine_path(line) {
            complaints.push(format!(
                "{name}:{}: {path}… is a path of one machine",
                index + 1
            ));
        }
    }
    complaints
}

/// The start of an absolute path in the line.
fn machine_path(line: &str) -> Option<String> {
    MACHINE_FOLDERS.into_iter().find_map(|folder| {
        let path = format!("/{folder}/");
        let at = line.find(&path)?;
        // Within a relative path or an address it is no absolute path.
        let before = line[..at].chars().next_back();
        let absolute = !before.is_some_and(|c| c.is_alphanumeric() || "._-/*}".contains(c));
        absolute.then_some(path)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_may_have_700_lines() {
        assert!(complaints_about("a.rs", &"\n".repeat(700)).is_empty());
        assert_eq!(
            complaints_about("a.rs", &"\n".repeat(701)),
            ["a.rs: 701 lines, more than 700"]
        );
        assert!(complaints_about("data.csv", &"\n".repeat(701)).is_empty());
    }

    #[test]
    fn a_path_of_one_machine_is_found() {
        let path = ["", "home", "someone", "rotor"].join("/");
        assert_eq!(
            complaints_about("a.md", &format!("see\n`{path}`\n")),
            [format!("a.md:2: /{}/… is a path of one machine", "home")]
        );
        assert!(machine_path("rotor-core/src/work/home/").is_none());
    }
}
