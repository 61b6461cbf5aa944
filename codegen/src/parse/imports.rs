//! What a module imports: constants of the standard library, and items of modules that it links.

use syn::{ItemUse, Path, UseTree, Visibility};

use super::literal::CONSTANTS;
use crate::graph::Function;

/// Where the constants are.
const HOMES: [[&str; 3]; 2] = [["std", "f64", "consts"], ["core", "f64", "consts"]];

/// The `use` items of a module.
#[derive(Clone, Debug, Default)]
pub struct Imports {
    /// A name and the path that it stands for.
    names: Vec<Import<(String, Vec<String>)>>,
    /// Paths all of whose names are imported.
    globs: Vec<Import<Vec<String>>>,
}

#[derive(Clone, Debug)]
struct Import<T> {
    what: T,
    /// Whether other modules see it.
    seen: bool,
}

impl Imports {
    /// Reads an item.
    pub fn read(&mut self, item: &ItemUse) {
        let seen = !matches!(item.vis, Visibility::Inherited);
        self.read_tree(&mut Vec::new(), &item.tree, seen);
    }

    /// Reads an import below the path `prefix`.
    fn read_tree(&mut self, prefix: &mut Vec<String>, tree: &UseTree, seen: bool) {
        match tree {
            UseTree::Path(path) => {
                prefix.push(path.ident.to_string());
                self.read_tree(prefix, &path.tree, seen);
                prefix.pop();
            }
            UseTree::Name(name) => {
                let name = name.ident.to_string();
                // `use std::f64::{self}` imports the module itself.
                let own = (name != "self").then(|| name.clone());
                let path: Vec<String> = prefix.iter().cloned().chain(own).collect();
                if let Some(last) = path.last().cloned() {
                    let what = (last, path);
                    self.names.push(Import { what, seen });
                }
            }
            UseTree::Rename(rename) => {
                let path = prefix.iter().cloned().chain([rename.ident.to_string()]);
                let what = (rename.rename.to_string(), path.collect());
                self.names.push(Import { what, seen });
            }
            UseTree::Glob(_) => {
                let what = prefix.clone();
                self.globs.push(Import { what, seen });
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.read_tree(prefix, tree, seen);
                }
            }
        }
    }

    /// The paths that an imported name stands for, of which several may be under conditions; only those that other modules
    /// see, if that is asked.
    pub(super) fn paths_of(&self, name: &str, seen: bool) -> impl Iterator<Item = &[String]> {
        let names = self.names.iter();
        let names = names.filter(move |import| import.what.0 == name && (import.seen || !seen));
        names.map(|import| import.what.1.as_slice())
    }

    /// The paths all of whose names are imported; only those that other modules see, if that is asked.
    pub(super) fn globs(&self, seen: bool) -> impl Iterator<Item = &[String]> {
        let globs = self.globs.iter().filter(move |glob| glob.seen || !seen);
        globs.map(|glob| glob.what.as_slice())
    }

    /// The name in `std::f64::consts` that a path in the module stands for.
    pub fn constant(&self, path: &Path) -> Option<String> {
        let segments: Vec<String> = path
            .segments
            .iter()
            .map(|part| part.ident.to_string())
            .collect();
        let (first, rest) = segments.split_first()?;
        let imported = self.paths_of(first, false).next().map(<[_]>::to_vec);
        let whole = match imported {
            Some(path) => path.into_iter().chain(rest.iter().cloned()).collect(),
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

    /// The function of another crate that a path in the module stands for.
    pub(crate) fn of_crate(&self, path: &Path) -> Option<Function> {
        let segments = path.segments.iter();
        let segments: Vec<String> = segments.map(|part| part.ident.to_string()).collect();
        let imported = match segments.as_slice() {
            [name] => self.paths_of(name, false).next()?.to_vec(),
            _ => segments,
        };
        match imported.as_slice() {
            [of, name] => Function::of_crate([of, name]),
            _ => None,
        }
    }

    fn imports_all_constants(&self) -> bool {
        self.globs(false)
            .any(|path| HOMES.iter().any(|known| path == known))
    }
}
