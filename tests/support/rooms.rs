//! Holds a list of which room of a crate uses which to the crate's sources; part of the tests of the crates that have such a list.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// For each room those that it may use; a room stands below all that it uses.
pub(crate) type Arrows<'a> = &'a [(&'a str, &'a [&'a str])];

/// Finds the source files below a folder.
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

/// Fails where the sources below `root` use a room that the list does not allow, or do not use one that it draws.
pub(crate) fn check_uses(root: &Path, arrows: Arrows<'_>) {
    let allowed: BTreeMap<_, _> = arrows.iter().copied().collect();
    let mut all = Vec::new();
    files(root, &mut all);
    let mut drawn = BTreeSet::new();
    for file in all {
        let room = room(&file, root);
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
    for (room, others) in arrows {
        for other in *others {
            let arrow = ((*room).to_owned(), (*other).to_owned());
            assert!(drawn.contains(&arrow), "{room} does not use {other}");
        }
    }
}

/// Fails where the list has a room above one that it uses, so that arrows could run in a circle.
pub(crate) fn check_order(arrows: Arrows<'_>) {
    let mut built: BTreeSet<&str> = BTreeSet::new();
    for (room, others) in arrows {
        for other in *others {
            assert!(
                built.contains(other),
                "{room} uses {other}, which stands above it"
            );
        }
        built.insert(room);
    }
}
