//! What a module has gathered of those that it links, as tokens on their way through macros.

use std::iter::Peekable;

use proc_macro2::token_stream::IntoIter;
use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::{Ident, ItemMod, LitStr, Path};

use super::{ask, finish, group};
use crate::diagnostics::Diagnostics;
use crate::expand::Expansion;
use crate::parse::attributes::of_module::{Link, ModuleAttribute};
use crate::parse::linking::{Source, Sources};
use crate::parse::place::Place;

/// A module that was handed on, with the paths at which it was found.
struct Found {
    handed: Handed,
    places: Vec<Place>,
}

/// A module as it is handed on.
struct Handed {
    key: String,
    name: Ident,
    attribute: TokenStream,
    /// Its items, in braces.
    items: Group,
    /// All of this as it came.
    tokens: Group,
    /// Where the attribute stands, which made the key.
    site: Span,
}

/// What is gathered: see the text of the module around this one.
pub(super) struct Gathered {
    /// First the module that gathers, then those that it links, and those that they link.
    modules: Vec<Found>,
    /// Places that are to be asked, each with the token in the gathering module's attribute that leads to it.
    open: Vec<(Place, Span)>,
}

impl Gathered {
    /// What a module has gathered before it has asked.
    pub(super) fn of(own: Group, links: &[Link]) -> Self {
        let modules = Handed::read(own).map(|handed| Found {
            handed,
            places: vec![Place::AROUND],
        });
        Self {
            modules: modules.into_iter().collect(),
            open: links
                .iter()
                .map(|link| (link.place.clone(), link.span()))
                .collect(),
        }
    }

    /// What was gathered so far with the answer of the module that was asked, and whether there is one. `None` if these
    /// are other tokens.
    pub(super) fn with(tokens: TokenStream) -> Option<(Self, bool)> {
        let mut tokens = tokens.into_iter().peekable();
        let mut gathered = Self::read(next_group(&mut tokens)?.stream())?;
        let answered = tokens.peek().is_some();
        if answered {
            gathered.take(Handed::read(next_group(&mut tokens)?)?)?;
        }
        Some((gathered, answered))
    }

    /// Takes a module that was asked for: the first of the open places.
    fn take(&mut self, handed: Handed) -> Option<()> {
        let (place, span) = (!self.open.is_empty()).then(|| self.open.remove(0))?;
        let mut modules = self.modules.iter_mut();
        if let Some(known) = modules.find(|known| known.handed.key == handed.key) {
            known.places.push(place);
            return Some(());
        }
        let around = place.around(&handed.name);
        let mut unread = Diagnostics::default();
        for link in ModuleAttribute::read(handed.attribute.clone(), &mut unread).links {
            let further = around.join(&link.place);
            if !self.is_known(&further) && further != place {
                self.open.push((further, span));
            }
        }
        let places = vec![place];
        self.modules.push(Found { handed, places });
        Some(())
    }

    fn is_known(&self, place: &Place) -> bool {
        let found = self
            .modules
            .iter()
            .any(|known| known.places.contains(place));
        found || self.open.iter().any(|(open, _)| open == place)
    }

    /// The call of the next module's macro; where none is left to be asked, that by which the module is expanded.
    pub(super) fn next(&self) -> TokenStream {
        match (self.open.first(), self.modules.first()) {
            (Some((place, span)), _) => ask(place, *span, &group(self.tokens())),
            (None, Some(own)) => finish(own.handed.site, self.tokens()),
            (None, None) => TokenStream::new(),
        }
    }

    /// The items of the module that gathered, with all that is generated from it.
    pub(super) fn expand(self) -> TokenStream {
        let mut diagnostics = Diagnostics::default();
        let sources: syn::Result<Vec<Source>> =
            self.modules.into_iter().map(Found::source).collect();
        let module = match sources {
            Ok(sources) => Sources::new(sources).module(0, &mut diagnostics),
            Err(error) => {
                diagnostics.syntax(&error, "a module of formulas holds items");
                None
            }
        };
        let Some(module) = module else {
            return diagnostics.to_tokens();
        };
        let mut expansion = Expansion::of_module(module, diagnostics);
        expansion.read_all();
        expansion.generate_all();
        let (module, errors) = expansion.into_parts();
        let items = module.content.into_iter().flat_map(|(_, items)| items);
        quote!(#(#items)* #errors)
    }

    fn tokens(&self) -> TokenStream {
        let mut modules = self.modules.iter();
        let own = modules.next().map(|own| &own.handed.tokens);
        let found = modules.map(|found| {
            let places = found
                .places
                .iter()
                .map(|place| in_parentheses(place, Span::call_site()));
            let handed = &found.handed.tokens;
            quote!(#(#places)* #handed)
        });
        let open = self
            .open
            .iter()
            .map(|(place, span)| in_parentheses(place, *span));
        let own_places = self.modules.iter().take(1).flat_map(|own| &own.places);
        let own_places = own_places.map(|place| in_parentheses(place, Span::call_site()));
        quote!(#(#own_places)* #own { #(#found)* } { #(#open)* })
    }

    fn read(tokens: TokenStream) -> Option<Self> {
        let mut tokens = tokens.into_iter().peekable();
        let mut modules = vec![Found::read(&mut tokens)?];
        let mut found = next_group(&mut tokens)?.stream().into_iter().peekable();
        while found.peek().is_some() {
            modules.push(Found::read(&mut found)?);
        }
        let mut open = Vec::new();
        let mut asked = next_group(&mut tokens)?.stream().into_iter().peekable();
        while asked.peek().is_some() {
            open.push(next_place(&mut asked)?);
        }
        Some(Self { modules, open })
    }
}

impl Found {
    fn read(tokens: &mut Peekable<IntoIter>) -> Option<Self> {
        let mut places = Vec::new();
        while matches!(tokens.peek(), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis)
        {
            places.push(next_place(tokens)?.0);
        }
        let handed = Handed::read(next_group(tokens)?)?;
        Some(Self { handed, places })
    }

    fn source(self) -> syn::Result<Source> {
        let Handed {
            key,
            name,
            attribute,
            items,
            ..
        } = self.handed;
        let item: ItemMod = syn::parse2(quote!(mod #name #items))?;
        Ok(Source {
            key,
            attribute,
            item,
            places: self.places,
        })
    }
}

impl Handed {
    fn read(tokens: Group) -> Option<Self> {
        let mut parts = tokens.stream().into_iter();
        let key: LitStr = syn::parse2(parts.next()?.to_token_stream()).ok()?;
        let site = key.span();
        let TokenTree::Ident(name) = parts.next()? else {
            return None;
        };
        let attribute = next_group(&mut parts)?.stream();
        let items = next_group(&mut parts)?;
        Some(Self {
            key: key.value(),
            name,
            attribute,
            items,
            tokens,
            site,
        })
    }
}

fn in_parentheses(place: &Place, span: Span) -> Group {
    Group::new(Delimiter::Parenthesis, place.tokens(span))
}

/// The next group; what stood for one token in a macro may have come in a group of its own without a sign.
fn next_group(tokens: &mut impl Iterator<Item = TokenTree>) -> Option<Group> {
    let Some(TokenTree::Group(group)) = tokens.next() else {
        return None;
    };
    match group.delimiter() {
        Delimiter::None => next_group(&mut group.stream().into_iter()),
        _ => Some(group),
    }
}

/// The next place, and where in the source the path to it stands.
fn next_place(tokens: &mut Peekable<IntoIter>) -> Option<(Place, Span)> {
    let path: Path = syn::parse2(next_group(tokens)?.stream()).ok()?;
    let place = Place::of_attribute(&path)?;
    Some((place, span(&path)))
}

/// Where a path begins.
fn span(path: &Path) -> Span {
    let first = path.segments.first();
    first.map_or_else(Span::call_site, |first| first.ident.span())
}
