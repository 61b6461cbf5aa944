//! What a name in a module of formulas stands for: an item of it, or one of a module that it links, found as the compiler
//! finds it.

use std::rc::Rc;

use syn::{Path, Type};

use super::module::{Function, Module};
use super::place::Place;

/// A module that is known to another, by a path at which the other finds it.
#[derive(Clone, Debug)]
pub struct Linked {
    /// Where it is, as seen from the other.
    pub place: Place,
    /// The module as read.
    pub module: Rc<Module>,
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    Function,
    Constant,
    Struct,
}

/// An item that a path stands for.
#[derive(Clone, Debug)]
pub(super) struct Found<'m> {
    /// The module that it is in.
    pub home: &'m Module,
    /// Its name there.
    pub name: String,
    /// What the path says behind it: the form of a function.
    pub rest: Vec<String>,
}

/// Why nothing is found.
#[derive(Clone, Debug)]
pub(super) enum Miss {
    /// No module that is known has it.
    Unknown,
    /// Modules whose items are all imported have each another one of the name.
    Ambiguous(Vec<String>),
}

/// A function that a path calls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Callee<'m> {
    /// The module that it is in.
    pub home: &'m Module,
    /// The function.
    pub function: &'m Rc<Function>,
}

/// Whose eyes a name is seen with.
#[derive(Clone, Copy, PartialEq, Eq)]
enum View {
    /// The module's own.
    Inside,
    /// Those of a module that names the item by its path: what it may not see the compiler says.
    ByPath,
    /// Those of a module that imports all that it sees.
    ByGlob,
}

impl Module {
    /// The function that a call's path stands for, and the form `f::form` of it that is called.
    pub(crate) fn callee(&self, path: &Path) -> Option<(Callee<'_>, Option<String>)> {
        let found = self.find(&names_of(path), Kind::Function).ok()?;
        let (home, function) = (found.home, found.home.function(&found.name)?);
        Some((Callee { home, function }, found.rest.into_iter().next()))
    }

    /// The methods of that name of a type, in this module and in those that it links.
    pub(super) fn methods(&self, of: &str, name: &str) -> Vec<Callee<'_>> {
        let joined = format!("{of}::{name}");
        let linked = self.linked.iter().map(|linked| linked.module.as_ref());
        let mut found: Vec<Callee<'_>> = Vec::new();
        for home in std::iter::once(self).chain(linked) {
            if let Some(function) = home.function(&joined) {
                let callee = Callee { home, function };
                if !found.iter().any(|known| known.is(&callee)) {
                    found.push(callee);
                }
            }
        }
        found
    }

    /// The constant that a path stands for, with the module that it is in.
    pub(super) fn constant(&self, path: &Path) -> Option<(&Module, &str)> {
        let found = self.find(&names_of(path), Kind::Constant).ok()?;
        let mut constants = found.home.constants.iter();
        let (name, _) = constants.find(|(name, _)| *name == found.name)?;
        Some((found.home, name))
    }

    /// The fields of a struct that is known, by its path, with the module that it is in.
    pub fn fields_at(&self, path: &Path) -> Option<(&Module, &[(String, Type)])> {
        let found = self.find(&names_of(path), Kind::Struct).ok()?;
        let mut structs = found.home.structs.iter();
        let (_, fields) = structs.find(|(name, _)| *name == found.name)?;
        Some((found.home, fields))
    }

    /// What a path in the module's own items stands for.
    pub(super) fn find(&self, names: &[String], kind: Kind) -> Result<Found<'_>, Miss> {
        self.look(names, kind, View::Inside)
    }

    fn look(&self, names: &[String], kind: Kind, view: View) -> Result<Found<'_>, Miss> {
        let Some((first, rest)) = names.split_first() else {
            return Err(Miss::Unknown);
        };
        if view == View::Inside && first == "self" {
            return self.own(rest, kind, view).ok_or(Miss::Unknown);
        }
        if view == View::Inside
            && let Some(place) = Place::of_body(names)
        {
            return self.at(&place, kind).ok_or(Miss::Unknown);
        }
        // A module that is imported has the name before a function of its own has it for its forms.
        let own = self.own(names, kind, view);
        if let Some(own) = own.clone().filter(|_| rest.is_empty()) {
            return Ok(own);
        }
        match self.imported(first, rest, kind, view)?.or(own) {
            Some(found) => Ok(found),
            None => self.in_globs(names, kind, view),
        }
    }

    /// What an imported name stands for; `None` if no import of the name is of this kind. An import of what is not known hides
    /// all that is imported whole.
    fn imported(
        &self,
        name: &str,
        rest: &[String],
        kind: Kind,
        view: View,
    ) -> Result<Option<Found<'_>>, Miss> {
        let mut all: Vec<(String, Found<'_>)> = Vec::new();
        for path in self.imports.paths_of(name, view != View::Inside) {
            let place = Place::of_body(path).ok_or(Miss::Unknown)?;
            let within = rest
                .iter()
                .fold(place.clone(), |place, name| place.child(name));
            match self.at(&within, kind) {
                Some(found) if all.iter().any(|(_, known)| known.is(&found)) => {}
                Some(found) => all.push((place.text(), found)),
                // The name is that of a module, and may be that of an item as well.
                None if rest.is_empty() && self.module_at(&place).is_some() => {}
                None => return Err(Miss::Unknown),
            }
        }
        if all.len() > 1 {
            return Err(Miss::Ambiguous(all.into_iter().map(|(at, _)| at).collect()));
        }
        Ok(all.into_iter().next().map(|(_, found)| found))
    }

    fn own(&self, names: &[String], kind: Kind, view: View) -> Option<Found<'_>> {
        let (name, rest) = names.split_first()?;
        // A method, or a constant of a type.
        if let [of, name] = names {
            let joined = format!("{of}::{name}");
            let known = match kind {
                Kind::Function => self.function(&joined).is_some(),
                Kind::Constant => self.constants.iter().any(|(own, _)| *own == joined),
                Kind::Struct => false,
            };
            if known {
                return Some(Found {
                    home: self,
                    name: joined,
                    rest: Vec::new(),
                });
            }
        }
        let known = match kind {
            Kind::Function => rest.len() <= 1 && self.function(name).is_some(),
            Kind::Constant => rest.is_empty() && self.constants.iter().any(|(own, _)| own == name),
            Kind::Struct => rest.is_empty() && self.structs.iter().any(|(own, _)| own == name),
        };
        let seen = view != View::ByGlob || !self.private.contains(&(kind, name.clone()));
        (known && seen).then(|| Found {
            home: self,
            name: name.clone(),
            rest: rest.to_vec(),
        })
    }

    /// What is at a place, in the linked module that is next to it.
    fn at(&self, place: &Place, kind: Kind) -> Option<Found<'_>> {
        let within = self.linked.iter().filter_map(|linked| {
            let rest = linked.place.rest(place)?;
            Some((linked, rest))
        });
        let (linked, rest) = within.min_by_key(|(_, rest)| rest.len())?;
        let found = linked.module.look(rest, kind, View::ByPath);
        found.ok().or_else(|| {
            // By the name of the module itself, where the place is the one around it.
            let (name, rest) = rest.split_first()?;
            let named = linked.module.item.ident == name;
            named.then(|| linked.module.look(rest, kind, View::ByPath).ok())?
        })
    }

    /// The module whose items are imported at a place.
    fn module_at(&self, place: &Place) -> Option<&Linked> {
        self.linked.iter().find(|linked| {
            linked.place.rest(place).is_some_and(|rest| match rest {
                [] => true,
                [name] => linked.module.item.ident == name,
                _ => false,
            })
        })
    }

    fn in_globs(&self, names: &[String], kind: Kind, view: View) -> Result<Found<'_>, Miss> {
        let mut all: Vec<(String, Found<'_>)> = Vec::new();
        for linked in self.imported_whole(view != View::Inside) {
            if let Ok(found) = linked.module.look(names, kind, View::ByGlob)
                && !all.iter().any(|(_, known)| known.is(&found))
            {
                all.push((linked.place.text(), found));
            }
        }
        if all.len() > 1 {
            return Err(Miss::Ambiguous(all.into_iter().map(|(at, _)| at).collect()));
        }
        let found = all.into_iter().next();
        found.map(|(_, found)| found).ok_or(Miss::Unknown)
    }

    /// The linked modules of which all items are imported; only those whose import is seen from outside, if that is asked.
    fn imported_whole(&self, seen: bool) -> impl Iterator<Item = &Linked> {
        let globs = self.imports.globs(seen);
        globs.filter_map(|path| self.module_at(&Place::of_body(path)?))
    }

    /// The linked module of which a path names an item, where the path names one.
    pub(super) fn module_of(&self, names: &[String]) -> Option<&Linked> {
        let (_, module) = names.split_last()?;
        let (first, rest) = module.split_first()?;
        let place = Place::of_body(module).or_else(|| {
            let path = self.imports.paths_of(first, false).next()?;
            let path: Vec<String> = path.iter().chain(rest).cloned().collect();
            Place::of_body(&path)
        });
        self.module_at(&place?)
    }

    /// Whether what a path names may be of a module that is linked and not known, which is reported.
    pub(super) fn is_of_refused(&self, names: &[String]) -> bool {
        let within = |place: &Place| {
            let mut refused = self.refused.iter();
            refused.any(|refused| refused.rest(place).is_some())
        };
        let Some((first, rest)) = names.split_first() else {
            return false;
        };
        let imported = || {
            let path = self.imports.paths_of(first, false).next()?;
            Place::of_body(&path.iter().chain(rest).cloned().collect::<Vec<_>>())
        };
        let place = Place::of_body(names).or_else(imported);
        let mut globs = self.imports.globs(false).filter_map(Place::of_body);
        place.map_or_else(|| globs.any(|place| within(&place)), |place| within(&place))
    }

    /// The names of all functions that may be called by their name alone.
    pub(super) fn functions_in_sight(&self) -> Vec<String> {
        let linked = self.imported_whole(false).flat_map(|linked| {
            let functions = linked.module.functions.iter();
            functions.map(|function| function.name()).filter(|name| {
                !linked
                    .module
                    .private
                    .contains(&(Kind::Function, name.clone()))
            })
        });
        let own = self.functions.iter().map(|function| function.name());
        own.chain(linked).collect()
    }
}

/// The names of a path, whatever stands between them.
pub(super) fn names_of(path: &Path) -> Vec<String> {
    let segments = path.segments.iter();
    segments.map(|segment| segment.ident.to_string()).collect()
}

impl Callee<'_> {
    /// Whether both are the same function.
    pub(crate) fn is(&self, other: &Self) -> bool {
        self.home.key == other.home.key && self.function.name() == other.function.name()
    }
}

impl Found<'_> {
    fn is(&self, other: &Self) -> bool {
        self.home.key == other.home.key && self.name == other.name
    }
}
