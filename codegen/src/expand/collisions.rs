//! Names of the author's that are also names of what is generated.

use proc_macro2::Ident;
use syn::{Item, UseTree};

use super::Expansion;

/// Where a name is looked up.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Type,
    Value,
    /// Imported: it may be either.
    Any,
}

impl Expansion {
    /// Reports items of the module that have the name of a generated one, and leaves them out: what is generated relies on
    /// its own.
    pub(super) fn report_collisions(&mut self) {
        let mut generated: Vec<(String, Kind, String)> = Vec::new();
        for name in self.forms.keys() {
            let what = format!("the module of the generated forms of `{name}`");
            let module = name.rsplit("::").next().unwrap_or(name);
            generated.push((module.to_owned(), Kind::Type, what));
        }
        if self.uses_columns {
            let what = "the error of all column forms".to_owned();
            generated.push(("ColumnLengthError".to_owned(), Kind::Type, what));
        }
        if self.uses_integral && self.module.function("integral").is_none() {
            let what = "the integral of functions as written".to_owned();
            generated.push(("integral".to_owned(), Kind::Value, what));
        }
        for name in self.used_tables.keys() {
            let what = "the table of an approximated function".to_owned();
            generated.push((name.clone(), Kind::Value, what));
        }
        let (module, diagnostics) = (&mut self.module, &mut self.diagnostics);
        if let Some((_, items)) = &mut module.item.content {
            items.retain(|item| {
                let mut met = false;
                for (ident, kind) in names(item) {
                    let meets = |other: Kind| kind == Kind::Any || kind == other;
                    let found = generated
                        .iter()
                        .find(|(name, other, _)| ident == name && meets(*other));
                    if let Some((name, _, what)) = found {
                        diagnostics.error_with_hint(
                            ident.span(),
                            format!("`{name}` is also the name of {what}"),
                            "give this one another name",
                        );
                        // Others may be imported beside it.
                        met |= kind != Kind::Any;
                    }
                }
                !met
            });
        }
    }
}

/// The names that an item declares.
fn names(item: &Item) -> Vec<(&Ident, Kind)> {
    match item {
        Item::Fn(item) => vec![(&item.sig.ident, Kind::Value)],
        Item::Const(item) => vec![(&item.ident, Kind::Value)],
        Item::Static(item) => vec![(&item.ident, Kind::Value)],
        Item::Struct(item) => vec![(&item.ident, Kind::Type)],
        Item::Enum(item) => vec![(&item.ident, Kind::Type)],
        Item::Union(item) => vec![(&item.ident, Kind::Type)],
        Item::Trait(item) => vec![(&item.ident, Kind::Type)],
        Item::Type(item) => vec![(&item.ident, Kind::Type)],
        Item::Mod(item) => vec![(&item.ident, Kind::Type)],
        Item::Use(item) => {
            let mut names = Vec::new();
            imported(&item.tree, &mut names);
            names
        }
        _ => Vec::new(),
    }
}

fn imported<'i>(tree: &'i UseTree, names: &mut Vec<(&'i Ident, Kind)>) {
    match tree {
        UseTree::Path(path) => imported(&path.tree, names),
        UseTree::Name(name) => names.push((&name.ident, Kind::Any)),
        UseTree::Rename(rename) => names.push((&rename.rename, Kind::Any)),
        UseTree::Group(group) => group.items.iter().for_each(|tree| imported(tree, names)),
        UseTree::Glob(_) => {}
    }
}
