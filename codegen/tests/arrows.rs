//! Which room of the generator uses which: arrows point one way.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// For each room those that it may use. A room stands below all that it uses.
const ALLOWED: [(&str, &[&str]); 25] = [
    ("budget", &[]),
    ("cost", &[]),
    ("diagnostics", &[]),
    ("parallel", &[]),
    ("approximate", &["parallel"]),
    ("graph", &["approximate"]),
    ("fingerprint", &["graph"]),
    ("outputs", &["graph"]),
    ("circuit", &["cost", "graph"]),
    ("interpret", &["approximate", "circuit", "graph"]),
    ("gather", &["fingerprint", "graph", "outputs"]),
    ("rewrite", &["fingerprint", "graph", "outputs"]),
    ("differentiate", &["budget", "graph", "rewrite"]),
    ("symbols", &["diagnostics"]),
    (
        "parse",
        &[
            "cost",
            "diagnostics",
            "differentiate",
            "graph",
            "interpret",
            "symbols",
        ],
    ),
    (
        "tables",
        &["approximate", "diagnostics", "graph", "interpret", "parse"],
    ),
    ("latex", &["parse", "symbols"]),
    (
        "factor",
        &[
            "budget",
            "circuit",
            "differentiate",
            "fingerprint",
            "graph",
            "interpret",
            "outputs",
            "parallel",
            "rewrite",
        ],
    ),
    (
        "stage",
        &["circuit", "cost", "factor", "graph", "outputs", "rewrite"],
    ),
    ("chain", &["diagnostics"]),
    (
        "emit",
        &[
            "approximate",
            "chain",
            "circuit",
            "cost",
            "graph",
            "parse",
            "stage",
        ],
    ),
    ("dot", &["circuit", "emit", "graph"]),
    (
        "expand",
        &[
            "chain",
            "circuit",
            "cost",
            "diagnostics",
            "differentiate",
            "emit",
            "factor",
            "gather",
            "graph",
            "outputs",
            "parse",
            "rewrite",
            "stage",
            "symbols",
            "tables",
        ],
    ),
    ("link", &["diagnostics", "expand", "parse"]),
    (
        "show",
        &[
            "cost",
            "diagnostics",
            "dot",
            "emit",
            "expand",
            "latex",
            "parse",
        ],
    ),
];

/// The source files of the generator.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The room of a file: the first folder or file below `src`.
fn room(file: &Path, root: &Path) -> String {
    let inside = file.strip_prefix(root).unwrap();
    let first = inside.components().next().unwrap().as_os_str();
    first.to_str().unwrap().trim_end_matches(".rs").to_owned()
}

/// The rooms named behind `crate::`: one, or those of a list in braces.
fn named(path: &str) -> Vec<String> {
    let name = |text: &str| {
        let text = text.trim_start();
        let end = text.find(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
        text[..end.unwrap_or(text.len())].to_owned()
    };
    match path.strip_prefix('{') {
        Some(list) => list
            .split('}')
            .next()
            .unwrap()
            .split(',')
            .map(name)
            .collect(),
        None => vec![name(path)],
    }
}

/// The rooms that a text uses, but for its comments and tests.
fn used(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let names = lines.flat_map(|line| line.split("crate::").skip(1).flat_map(named));
    names.filter(|name| !name.is_empty()).collect()
}

#[test]
fn arrows_point_one_way() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let allowed: BTreeMap<_, _> = ALLOWED.into_iter().collect();
    let mut all = Vec::new();
    files(&root, &mut all);
    let mut drawn = BTreeSet::new();
    for file in all {
        let room = room(&file, &root);
        if room == "lib" || file.ends_with("tests.rs") {
            continue;
        }
        let may = allowed.get(room.as_str());
        let may = may.unwrap_or_else(|| panic!("the room {room} is not in the drawing"));
        for other in used(&fs::read_to_string(&file).unwrap()) {
            let is_allowed = other == room || may.contains(&other.as_str());
            assert!(is_allowed, "{} uses `{other}`", file.display());
            drawn.insert((room.clone(), other));
        }
    }
    // Nothing is drawn that is not there.
    for (room, others) in ALLOWED {
        for other in others {
            let arrow = (room.to_owned(), (*other).to_owned());
            assert!(drawn.contains(&arrow), "{room} does not use {other}");
        }
    }
}

#[test]
fn a_room_stands_below_what_it_uses() {
    let mut built: BTreeSet<&str> = BTreeSet::new();
    for (room, others) in ALLOWED {
        for other in others {
            assert!(
                built.contains(other),
                "{room} uses {other}, which stands above it"
            );
        }
        built.insert(room);
    }
}
