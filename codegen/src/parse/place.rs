//! Where modules are: paths of modules as they are written, brought to one start.

use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;
use syn::{Ident, Path};

/// Where a path starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    /// At the crate.
    Crate,
    /// So many modules outwards from the one around the module of formulas: 0 is that one itself.
    Around(usize),
}

/// The path of a module, or of what is in one, as seen from the module around a module of formulas: that is where an
/// attribute's paths start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    start: Start,
    names: Vec<String>,
}

impl Place {
    /// The module around the module of formulas.
    pub const AROUND: Self = Self {
        start: Start::Around(0),
        names: Vec::new(),
    };

    /// A path from the crate's root.
    pub fn in_crate(names: Vec<String>) -> Self {
        let start = Start::Crate;
        Self { start, names }
    }

    /// A path as the attribute of a module has it. `None` if it is generic, or of another crate.
    pub fn of_attribute(path: &Path) -> Option<Self> {
        Self::of(path.leading_colon.is_none(), &segments(path)?)
    }

    /// A path as a module's own items and bodies have it: from one module further in. `None` if it starts with a name, or
    /// leads to the module itself.
    pub fn of_body(names: &[String]) -> Option<Self> {
        let (first, rest) = names.split_first()?;
        match first.as_str() {
            "crate" => Some(Self::in_crate(rest.to_vec())),
            "super" => Self::of(true, rest),
            _ => None,
        }
    }

    fn of(local: bool, names: &[String]) -> Option<Self> {
        let (first, rest) = match names.split_first() {
            None => return Some(Self::AROUND),
            Some((first, rest)) => (first.as_str(), rest),
        };
        let outwards = names.iter().take_while(|name| *name == "super").count();
        let rest = match first {
            "crate" => return Some(Self::in_crate(rest.to_vec())),
            "super" => &names[outwards..],
            "self" => rest,
            _ => names,
        };
        let start = Start::Around(outwards);
        let names = rest.to_vec();
        local.then_some(Self { start, names })
    }

    /// The module that it is in.
    pub fn parent(&self) -> Self {
        let mut parent = self.clone();
        if parent.names.pop().is_none()
            && let Start::Around(outwards) = &mut parent.start
        {
            *outwards += 1;
        }
        parent
    }

    /// The place within it of a name.
    pub fn child(&self, name: &str) -> Self {
        let mut child = self.clone();
        child.names.push(name.to_owned());
        child
    }

    /// Where a place is that is written at a module around which is this one.
    pub fn join(&self, other: &Self) -> Self {
        let Start::Around(outwards) = other.start else {
            return other.clone();
        };
        let outer = (0..outwards).fold(self.clone(), |place, _| place.parent());
        let names = other.names.iter();
        names.fold(outer, |place, name| place.child(name))
    }

    /// Its last name.
    pub fn last(&self) -> Option<&str> {
        self.names.last().map(String::as_str)
    }

    /// What is left of a path behind this place, where the path leads through it.
    pub fn rest<'p>(&self, path: &'p Self) -> Option<&'p [String]> {
        let same = self.start == path.start;
        path.names
            .strip_prefix(self.names.as_slice())
            .filter(|_| same)
    }

    /// The module of formulas called `name` for which this place stands: itself, or one in it whose items it has as its own.
    /// Around that one is the place which is given.
    pub fn around(&self, name: &Ident) -> Self {
        match self.last() {
            Some(last) if name == last => self.parent(),
            _ => self.clone(),
        }
    }

    /// The path as an attribute of the module of formulas has it, with tokens at a place in the source.
    pub fn tokens(&self, span: Span) -> TokenStream {
        let start = match self.start {
            Start::Crate => quote_spanned!(span=> crate),
            Start::Around(0) => quote_spanned!(span=> self),
            Start::Around(outwards) => {
                let supers = std::iter::repeat_n(quote_spanned!(span=> super), outwards);
                quote_spanned!(span=> #(#supers)::*)
            }
        };
        let names = self.idents(span);
        quote_spanned!(span=> #start #(:: #names)*)
    }

    /// The path as the module's own items have it.
    pub fn tokens_within(&self, span: Span) -> TokenStream {
        match self.start {
            Start::Crate => self.tokens(span),
            Start::Around(outwards) => {
                let supers = std::iter::repeat_n(quote_spanned!(span=> super), outwards + 1);
                let names = self.idents(span);
                quote_spanned!(span=> #(#supers)::* #(:: #names)*)
            }
        }
    }

    fn idents(&self, span: Span) -> impl Iterator<Item = Ident> {
        self.names.iter().map(move |name| ident(name, span))
    }

    /// The path as text, as an attribute has it.
    pub fn text(&self) -> String {
        self.tokens(Span::call_site()).to_string().replace(' ', "")
    }
}

/// The names of a path without generics.
fn segments(path: &Path) -> Option<Vec<String>> {
    let plain = path
        .segments
        .iter()
        .all(|segment| segment.arguments.is_none());
    let names = path
        .segments
        .iter()
        .map(|segment| segment.ident.to_string());
    plain.then(|| names.collect())
}

fn ident(name: &str, span: Span) -> Ident {
    match name.strip_prefix("r#") {
        Some(raw) => Ident::new_raw(raw, span),
        None => Ident::new(name, span),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(path: &str) -> Place {
        Place::of_attribute(&syn::parse_str(path).unwrap()).unwrap()
    }

    #[test]
    fn paths_are_brought_to_one_start() {
        for (path, text) in [
            ("super::stiffness", "super::stiffness"),
            ("stiffness", "self::stiffness"),
            ("self::stiffness", "self::stiffness"),
            ("crate::a::b", "crate::a::b"),
            ("super::super", "super::super"),
        ] {
            assert_eq!(place(path).text(), text);
        }
        let generic: Path = syn::parse_str("a::<b>::c").unwrap();
        assert_eq!(Place::of_attribute(&generic), None);
        let foreign: Path = syn::parse_str("::a::b").unwrap();
        assert_eq!(Place::of_attribute(&foreign), None);
    }

    #[test]
    fn a_link_of_a_linked_module_is_seen_from_the_first() {
        let joined = |of: &str, link: &str| place(of).join(&place(link)).text();
        assert_eq!(joined("super::width", "super::start"), "super::start");
        assert_eq!(joined("crate::a::b", "super::super::c"), "crate::c");
        assert_eq!(joined("super", "super::c"), "super::super::c");
        assert_eq!(joined("super::a", "crate::b"), "crate::b");
        assert_eq!(joined("super::a", "b"), "super::a::b");
    }

    #[test]
    fn bodies_are_one_module_further_in() {
        let names = |path: &str| segments(&syn::parse_str(path).unwrap()).unwrap();
        let place = |path: &str| Place::of_body(&names(path)).map(|place| place.text());
        assert_eq!(place("super::super::a::f").unwrap(), "super::a::f");
        assert_eq!(place("super::a").unwrap(), "self::a");
        assert_eq!(place("crate::a").unwrap(), "crate::a");
        assert_eq!(place("a::f"), None);
        assert_eq!(place("self::f"), None);
    }
}
