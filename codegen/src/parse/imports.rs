//! Which names of a module are constants of the standard library: those that it imports, and no others.

use syn::{Path, UseTree};

use super::literal::CONSTANTS;

/// Where the constants are.
const HOMES: [[&str; 3]; 2] = [["std", "f64", "consts"], ["core", "f64", "consts"]];

/// The `use` items of a module, as far as they concern constants of the standard library.
#[derive(Clone, Debug, Default)]
pub struct Imports {
    /// A name and the path that it stands for.
    names: Vec<(String, Vec<String>)>,
    /// Paths all of whose names are imported.
    globs: Vec<Vec<String>>,
}

impl Imports {
    /// Reads an import below the path `prefix`.
    pub fn read(&mut self, prefix: &mut Vec<String>, tree: &UseTree) {
        match tree {
            UseTree::Path(path) => {
                prefix.push(path.ident.to_string());
                self.read(prefix, &path.tree);
                prefix.pop();
            }
            UseTree::Name(name) => {
                let name = name.ident.to_string();
                // `use std::f64::{self}` imports the module itself.
                let own = (name != "self").then(|| name.clone());
                let path: Vec<String> = prefix.iter().cloned().chain(own).collect();
                if let Some(last) = path.last().cloned() {
                    self.names.push((last, path));
                }
            }
            UseTree::Rename(rename) => {
                let path = prefix.iter().cloned().chain([rename.ident.to_string()]);
                self.names.push((rename.rename.to_string(), path.collect()));
            }
            UseTree::Glob(_) => self.globs.push(prefix.clone()),
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.read(prefix, tree);
                }
            }
        }
    }

    /// The name in `std::f64::consts` that a path in the module stands for.
    pub fn constant(&self, path: &Path) -> Option<String> {
        let segments: Vec<String> = path
            .segments
            .iter()
            .map(|part| part.ident.to_string())
            .collect();
        let (first, rest) = segments.split_first()?;
        let whole = match self.names.iter().find(|(name, _)| name == first) {
            Some((_, path)) => path.iter().chain(rest).cloned().collect(),
            None if rest.is_empty() && self.imports_all_constants() => {
                return CONSTANTS.contains(&first.as_str()).then(|| first.clone());
            }
            None => segments,
        };
        let (name, home) = whole.split_last()?;
        HOMES
            .iter()
            .any(|known| home == known)
            .then(|| name.clone())
    }

    fn imports_all_constants(&self) -> bool {
        self.globs
            .iter()
            .any(|path| HOMES.iter().any(|known| path == known))
    }
}
