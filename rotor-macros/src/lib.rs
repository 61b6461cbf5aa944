//! The door to `codegen`.
use proc_macro::TokenStream;
/// Symbolic module.
#[proc_macro_attribute]
pub fn symbolic(_attribute: TokenStream, item: TokenStream) -> TokenStream { item }
