//! How deep a source may be nested.

use proc_macro2::{Group, Span, TokenStream, TokenTree};

/// How deep groups of tokens may be nested: each is parsed on the stack.
pub(super) const DEEPEST_GROUP: usize = 128;

/// Where groups of tokens are nested deeper than that; found without the stack.
pub(super) fn deeper_than(most: usize, tokens: &TokenStream) -> Option<Span> {
    let mut level: Vec<Group> = groups(tokens.clone()).collect();
    for _ in 0..most {
        level = level
            .into_iter()
            .flat_map(|group| groups(group.stream()))
            .collect();
    }
    level.first().map(Group::span)
}

fn groups(tokens: TokenStream) -> impl Iterator<Item = Group> {
    tokens.into_iter().filter_map(|token| match token {
        TokenTree::Group(group) => Some(group),
        _ => None,
    })
}
