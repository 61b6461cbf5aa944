//! Circuits to Rust.
//!
//! [`literal`] and [`namer`] alone decide how numbers and temporaries are written; [`expression`] puts an operation into
//! tokens, [`scalar`] and [`columns`] put a function around them; `roots` shares roots between divider and multipliers,
//! `parts` cuts long bodies, `grouped` writes the loops of their parts.

pub mod chain;
pub mod columns;
pub mod expression;
mod grouped;
pub mod literal;
pub mod namer;
mod parts;
mod polynomial;
mod roots;
pub mod scalar;
pub mod staged;

use proc_macro2::TokenStream;

/// Items as text, a statement to a line. `None` if the tokens are no Rust items.
pub fn format(items: TokenStream) -> Option<String> {
    syn::parse2(items)
        .ok()
        .map(|file| prettyplease::unparse(&file))
}
