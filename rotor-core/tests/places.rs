//! How many places know an input or a quantity by its name: adding one is a row and a formula.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

use std::fs;
use std::path::{Path, PathBuf};

/// The source files of the library but for its tests, with their texts.
fn sources(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if !path.ends_with("tests.rs") {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
            let lines = code
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"));
            found.push((path.clone(), lines.collect::<Vec<_>>().join("\n")));
        }
    }
}

/// The files that have a word, below `src`; those of the equations count as one.
fn files_with(word: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    sources(&root, &mut all);
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let has = |text: &str| {
        text.split(|letter| !is_part(letter))
            .any(|part| part == word)
    };
    let with = all.iter().filter(|(_, text)| has(text));
    let names = with.map(|(path, _)| {
        let inside = path.strip_prefix(&root).unwrap();
        let first = inside.components().next().unwrap().as_os_str();
        match first.to_str().unwrap().trim_end_matches(".rs") {
            "equations" => "equations".to_owned(),
            _ => inside
                .to_str()
                .unwrap()
                .replace(std::path::MAIN_SEPARATOR, "/"),
        }
    });
    let mut names: Vec<String> = names.collect();
    names.sort();
    names.dedup();
    names
}

#[test]
fn an_input_is_known_in_its_table_and_in_formulas() {
    for input in [
        "shaft_poissons_ratio",
        "shaft_youngs_modulus",
        "shaft_length",
    ] {
        assert_eq!(files_with(input), ["equations", "input.rs"], "{input}");
    }
}

#[test]
fn a_quantity_is_known_in_its_table_and_by_its_formula() {
    // The row has the variant and the name; the formula has the name.
    for variant in [
        "SirZupAsymmetry",
        "ReferenceSpeed",
        "Epsilon12",
        "GrowthRate",
    ] {
        let files = files_with(variant);
        let known: Vec<&str> = files
            .iter()
            .map(String::as_str)
            .filter(|file| !file.starts_with("batch/"))
            .collect();
        assert_eq!(known, ["quantity.rs"], "{variant}");
    }
    for formula in ["c33", "epsilon_2"] {
        assert!(
            files_with(formula).contains(&"equations".to_owned()),
            "{formula}"
        );
    }
}
