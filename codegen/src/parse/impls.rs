//! `impl` blocks: methods as functions of the module, with `self` as their first parameter.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::{
    Attribute, Expr, FnArg, ImplItem, ImplItemFn, ItemFn, ItemImpl, Pat, PatIdent, PatType,
    ReceiverKind, Type, parse_quote,
};

use super::attributes::OWN;
use crate::diagnostics::Diagnostics;

/// What a formula of a method calls the value that the method is of.
const SELF: &str = "self";

/// What an `impl` block adds to a module.
pub(super) struct Block {
    /// The type that it is of.
    pub of: Ident,
    /// Constants: name and value.
    pub constants: Vec<(Ident, Expr)>,
    /// Methods, and functions of the type.
    pub functions: Vec<ItemFn>,
}

/// Reads a block of methods of a type, and takes the generator's own attributes off. `None` for one of a trait or with
/// generic parameters, in which no formula is.
pub(super) fn read(item: &mut ItemImpl, diagnostics: &mut Diagnostics) -> Option<Block> {
    let of = plain_type(item);
    let mut block = of.clone().map(|of| Block {
        of,
        constants: Vec::new(),
        functions: Vec::new(),
    });
    for item in &mut item.items {
        match (item, &mut block) {
            (ImplItem::Fn(function), Some(block)) => {
                block.functions.extend(function_of(function, &block.of));
                take_off(&mut function.attrs);
            }
            (ImplItem::Const(constant), Some(block)) => {
                let value = with_type(constant.expr.to_token_stream(), &block.of);
                let value = syn::parse2(value).ok();
                block
                    .constants
                    .extend(value.map(|value| (constant.ident.clone(), value)));
            }
            (ImplItem::Fn(function), None) => {
                if let Some(own) = function.attrs.iter().find(|attribute| is_own(attribute)) {
                    diagnostics.error_with_hint(
                        own.span(),
                        "a method of a trait or of a generic type is no formula",
                        "write it in an `impl` block of the type alone: impl Name { … }",
                    );
                }
                take_off(&mut function.attrs);
            }
            _ => {}
        }
    }
    block
}

fn is_own(attribute: &Attribute) -> bool {
    OWN.iter().any(|name| attribute.path().is_ident(name))
}

fn take_off(attributes: &mut Vec<Attribute>) {
    let is_generated = attributes
        .iter()
        .any(|attribute| attribute.path().is_ident("generate"));
    attributes.retain(|attribute| !is_own(attribute));
    if is_generated {
        // Its generated forms may be all that is called.
        attributes.push(syn::parse_quote!(#[allow(dead_code)]));
    }
}

/// The name of the type of a block that is neither generic nor of a trait.
fn plain_type(item: &ItemImpl) -> Option<Ident> {
    match item.self_ty.as_ref() {
        Type::Path(path) if item.trait_.is_none() && item.generics.params.is_empty() => {
            path.path.get_ident().cloned()
        }
        _ => None,
    }
}

/// A method as a function, whose first parameter is called `self`.
fn function_of(method: &ImplItemFn, of: &Ident) -> Option<ItemFn> {
    let ImplItemFn {
        attrs,
        vis,
        sig,
        block,
        ..
    } = method;
    let tokens = with_type(quote!(#(#attrs)* #vis #sig #block), of);
    let mut function: ItemFn = syn::parse2(tokens).ok()?;
    if let Some(first) = function.sig.inputs.first_mut()
        && let FnArg::Receiver(receiver) = first
    {
        let name = Ident::new(SELF, receiver.self_token.span);
        let ty = match &receiver.kind {
            ReceiverKind::Reference(and, lifetime, mutability) => {
                parse_quote!(#and #lifetime #mutability #of)
            }
            ReceiverKind::Typed(_, ty) => ty.as_ref().clone(),
            _ => parse_quote!(#of),
        };
        *first = FnArg::Typed(PatType {
            attrs: Vec::new(),
            pat: Box::new(Pat::Ident(PatIdent {
                attrs: Vec::new(),
                by_ref: None,
                mutability: None,
                ident: name,
                subpat: None,
            })),
            colon_token: Default::default(),
            ty: Box::new(ty),
        });
    }
    Some(function)
}

/// Tokens with the type's name in the place of `Self`.
fn with_type(tokens: TokenStream, of: &Ident) -> TokenStream {
    let replaced = tokens.into_iter().map(|token| match token {
        TokenTree::Ident(name) if name == "Self" => {
            TokenTree::Ident(Ident::new(&of.to_string(), name.span()))
        }
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), with_type(group.stream(), of));
            inner.set_span(group.span());
            TokenTree::Group(inner)
        }
        other => other,
    });
    replaced.collect()
}
