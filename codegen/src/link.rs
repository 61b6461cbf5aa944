//! Modules of formulas in several files: how each comes to know the tokens of those that it links.
//!
//! A macro sees the tokens that it is given and no others, and knows no path of the crate that it works for; only the compiler
//! does. So each module of formulas holds a hidden macro of its own, [`HANDING`], which hands the module's tokens on. A
//! module that links others is at first only this macro and a call of the macro of the first that it links, by the path
//! that its attribute says. That one calls the hidden macro `__linked!` with what was gathered so far and with its own
//! tokens, `__linked!` calls the macro of the next module, one that a linked module links among them, and when all are
//! there it calls itself to expand the module with them: what is generated has the place and the hygiene of the tokens of
//! that call, which are those of the attribute; in a call that stands in a macro the names of what is generated and those
//! of the function as written would not meet. Tokens keep their places in the source on this way, so that messages do.
//!
//! What is on its way is one group of tokens, which no macro takes apart:
//!
//! ```text
//! { (self) module { (path) module … } { (path) … } }
//! ```
//!
//! the module itself, those that were handed on so far, each with all paths at which it was found, and the paths that are
//! to be asked yet. A module is `{ "key" name (attribute) { items } }`.

mod gathered;

use std::hash::{DefaultHasher, Hash, Hasher};

use proc_macro2::{Delimiter, Group, Literal, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};
use syn::{Attribute, ImplItem, Item, ItemMod};

use crate::diagnostics::Diagnostics;
use crate::expand::{Expansion, expand, nested_too_deep};
use crate::parse::attributes::OWN;
use crate::parse::attributes::of_module::ModuleAttribute;
use crate::parse::place::Place;
use gathered::Gathered;

/// The macro by which a module hands its tokens on. A module that has all items of this one as its own has the macro, too.
pub const HANDING: &str = "__formulas";

/// Expands a module of formulas as [`expand`] does, and adds what makes it known to modules that link it. Where it links
/// others, what comes out asks for their tokens first.
pub fn attribute(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let mut module = match syn::parse2::<Item>(item.clone()) {
        Ok(Item::Mod(module)) if module.content.is_some() && nested_too_deep(&item).is_none() => {
            module
        }
        _ => return expand(attribute, item),
    };
    let key = key(&attribute, &module);
    let handing = handing(&key, &attribute, &module);
    let mut unread = Diagnostics::default();
    let links = ModuleAttribute::read(attribute.clone(), &mut unread).links;
    let (mut errors, mut added) = (TokenStream::new(), TokenStream::new());
    if links.is_empty() {
        let mut expansion = Expansion::unread(attribute, module);
        expansion.read_all();
        expansion.generate_all();
        (module, errors) = expansion.into_parts();
    } else {
        let items = module.content.take();
        let items = items.map(|(_, items)| quote!(#(#items)*));
        let own = handed(&key, &attribute, &module, items.unwrap_or_default());
        module.content = Some(Default::default());
        added = Gathered::of(own, &links).next();
    }
    if let Some((_, items)) = &mut module.content {
        items.extend([handing, added].map(Item::Verbatim));
    }
    quote!(#module #errors)
}

/// Goes on after a module has handed its tokens on: asks for the next, or where all are there expands the module that asked.
pub fn linked(tokens: TokenStream) -> TokenStream {
    match Gathered::with(tokens) {
        Some((gathered, true)) => gathered.next(),
        Some((gathered, false)) => gathered.expand(),
        None => {
            let mut diagnostics = Diagnostics::default();
            diagnostics.error_with_hint(
                Span::call_site(),
                "this macro is called by what `symbolic` makes, and by nothing else",
                "link modules by #[symbolic(with(super::name))]",
            );
            diagnostics.to_tokens()
        }
    }
}

/// What tells a module from all others of a crate, as good as certainly: its own tokens. Two that say the same by them all
/// have the same formulas.
fn key(attribute: &TokenStream, module: &ItemMod) -> String {
    let mut hasher = DefaultHasher::new();
    let text = [attribute.to_string(), module.to_token_stream().to_string()];
    text.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// A module as it is handed on.
fn handed(key: &str, attribute: &TokenStream, module: &ItemMod, items: TokenStream) -> Group {
    let (key, name) = (Literal::string(key), &module.ident);
    group(quote!(#key #name (#attribute) { #items }))
}

fn group(tokens: TokenStream) -> Group {
    Group::new(Delimiter::Brace, tokens)
}

/// The hidden macro of a module: its items that others may need, without what only the compiler and readers look at.
fn handing(key: &str, attribute: &TokenStream, module: &ItemMod) -> TokenStream {
    let items = module.content.iter().flat_map(|(_, items)| items);
    let items = items.filter_map(needed);
    let items = items.filter(|item| !holds_dollar(item)).collect();
    let module = handed(key, attribute, module, items);
    let name = quote::format_ident!("{HANDING}");
    quote! {
        #[doc(hidden)]
        #[allow(unused_macros)]
        macro_rules! __this_module {
            ($gathered:tt) => { ::rotor_macros::__linked! { $gathered #module } };
        }
        #[doc(hidden)]
        #[allow(unused_imports)]
        pub(crate) use __this_module as #name;
    }
}

/// An item as far as formulas of another module may need it.
fn needed(item: &Item) -> Option<TokenStream> {
    let kept = |attributes: &mut Vec<Attribute>| {
        attributes.retain(|attribute| {
            let path = attribute.path();
            path.is_ident("cfg") || OWN.iter().any(|own| path.is_ident(own))
        });
    };
    let mut item = item.clone();
    match &mut item {
        Item::Fn(function) => kept(&mut function.attrs),
        Item::Const(constant) => kept(&mut constant.attrs),
        Item::Use(import) => kept(&mut import.attrs),
        Item::Struct(structure) => {
            kept(&mut structure.attrs);
            let fields = structure.fields.iter_mut();
            fields.for_each(|field| kept(&mut field.attrs));
        }
        Item::Impl(block) if block.trait_.is_none() => {
            for item in &mut block.items {
                match item {
                    ImplItem::Fn(method) => kept(&mut method.attrs),
                    ImplItem::Const(constant) => kept(&mut constant.attrs),
                    _ => {}
                }
            }
        }
        _ => return None,
    }
    Some(item.to_token_stream())
}

/// Whether tokens would be a variable in a macro. No formula has them.
fn holds_dollar(tokens: &TokenStream) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Group(group) => holds_dollar(&group.stream()),
        TokenTree::Punct(punct) => punct.as_char() == '$',
        _ => false,
    })
}

/// The call by which all that was gathered is expanded, as if it stood where `span` is.
fn finish(span: Span, gathered: TokenStream) -> TokenStream {
    let mut gathered = group(gathered);
    gathered.set_span(span);
    let mut arguments = group(gathered.to_token_stream());
    arguments.set_span(span);
    quote_spanned!(span=> ::rotor_macros::__linked! #arguments)
}

/// The call of the macro of the module at a place.
fn ask(place: &Place, span: Span, gathered: &Group) -> TokenStream {
    let path = place.tokens_within(span);
    let name = syn::Ident::new(HANDING, span);
    quote!(#path::#name! { #gathered })
}

#[cfg(test)]
mod tests;
