//! The module that comes out: as written, with everything generated beside it.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ItemMod;

use super::Expansion;
use super::fallback::{integral_function, one_deeper};
use crate::emit::columns;
use crate::parse::module::Function;

impl Expansion {
    /// The module with everything generated.
    pub fn into_tokens(self) -> TokenStream {
        let (item, errors) = self.into_parts();
        quote!(#item #errors)
    }

    /// The module with everything generated, and what was wrong.
    pub fn into_parts(self) -> (ItemMod, TokenStream) {
        let mut item = self.module.item;
        for function in item.content.iter_mut().flat_map(|(_, items)| items) {
            // It may be called through its partials alone.
            if let syn::Item::Fn(function) = function
                && self.partials.iter().any(|(of, _)| function.sig.ident == of)
            {
                function.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
            }
        }
        let errors = self.diagnostics.to_tokens();
        let mut added = Vec::new();
        for function in self
            .module
            .functions
            .iter()
            .filter(|function| function.specialises.is_some())
        {
            let mut item = function.item.clone();
            if self
                .formulas
                .get(&function.name())
                .is_some_and(Option::is_none)
            {
                // Its replacements are reported; what they say is not compiled as well.
                item.block = syn::parse_quote!({ loop {} });
            }
            added.push(quote!(#item));
        }
        if self.uses_columns {
            added.push(columns::error_type());
        }
        if self.uses_integral
            && !self
                .module
                .functions
                .iter()
                .any(|function| function.name() == "integral")
        {
            added.push(integral_function());
        }
        added.extend(self.used_tables.into_values());
        added.extend(self.chain);
        for function in &self.module.functions {
            if let Some(items) = self.forms.get(&function.name()) {
                added.push(forms_module(function, items));
            }
        }
        if let Some((_, items)) = &mut item.content {
            items.extend(added.into_iter().map(syn::Item::Verbatim));
        }
        (item, errors)
    }
}

/// The module of a function's generated forms.
fn forms_module(function: &Function, items: &[TokenStream]) -> TokenStream {
    let (visibility, name) = (&function.item.vis, &function.item.sig.ident);
    let written = function.name();
    let doc = format!(" Generated forms of [`{written}`]({written}()).");
    let conditions = function.conditions();
    let items = one_deeper(quote!(#(#items)*));
    quote! {
        #(#conditions)*
        #[doc = #doc]
        #[allow(clippy::all, clippy::pedantic, unused)]
        #visibility mod #name {
            use super::*;

            #items
        }
    }
}
