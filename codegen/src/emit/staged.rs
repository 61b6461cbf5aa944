//! The staged form: a function for what stands still, and the bodies of two loops.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::columns;
use super::expression::{Body, Writer};
use super::scalar;
use crate::graph::SymbolId;
use crate::parse::body::identifier;
use crate::parse::module::Function;
use crate::stage::Staged;

/// Names the module of a staged form: `along_x`, `along_x_and_y`, and for more symbols `along_x_to_z` by the first and the
/// last of them.
pub fn module_name(symbols: &[String]) -> String {
    let last = |symbol: &String| identifier(symbol.rsplit('.').next().unwrap_or(symbol));
    let names: Vec<String> = symbols.iter().map(last).collect();
    match names.as_slice() {
        [first, _, .., last] => format!("along_{first}_to_{last}"),
        names => format!("along_{}", names.join("_and_")),
    }
}

/// The module of a staged form; `own` are the symbols of the formula, `inner` those that run along the points, `outputs` the
/// names of the results.
pub fn module(
    staged: &Staged,
    function: &Function,
    own: &[SymbolId],
    inner: &[SymbolId],
    outputs: &[String],
) -> TokenStream {
    let graph = &staged.graph;
    let names = columns::names_of(graph, inner);
    let module = format_ident!("{}", module_name(&names));
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let (formula, inner_names) = (function.name(), quoted.join(" and "));
    let module_doc = format!(
        " [`{formula}`](super::super::{formula}()) along {inner_names}: what the other numbers alone decide is computed \
         once, what these alone decide once for each of their values, and only the rest at every point."
    );
    let points_doc = format!(
        " What is done at every point: {}. Results are {}.",
        staged.points.cost(),
        outputs.join(", ")
    );
    let along_doc = format!(
        " What is done for every value of {inner_names}: {}.",
        staged.along.cost()
    );
    let fixed_doc = format!(
        " What is done once, in order for [`Points`]: {}.",
        staged.fixed.cost()
    );
    let fixed_count = columns::literal(staged.fixed_symbols.len());
    let tables = columns::literal(staged.along_symbols.len());
    let still: Vec<SymbolId> = own
        .iter()
        .copied()
        .filter(|symbol| !inner.contains(symbol))
        .collect();
    let fixed = fixed(staged, function, &still);
    let along = columns::kernel(graph, &staged.along, &format_ident!("Along"), &[], inner);
    let points = columns::kernel(
        graph,
        &staged.points,
        &format_ident!("Points"),
        &staged.fixed_symbols,
        &staged.along_symbols,
    );
    quote! {
        #[doc = #module_doc]
        pub mod #module {
            use super::*;

            /// How many numbers [`fixed()`] gives.
            pub const FIXED: usize = #fixed_count;

            /// How many numbers [`Along`] gives.
            pub const TABLES: usize = #tables;

            #[doc = #fixed_doc]
            #fixed

            #[doc = #along_doc]
            #along

            #[doc = #points_doc]
            #points
        }
    }
}

/// What is computed once, from the parameters and from the numbers of the symbols that stand still.
fn fixed(staged: &Staged, function: &Function, still: &[SymbolId]) -> TokenStream {
    let graph = &staged.graph;
    let parameters = scalar::parameters(function);
    let names = columns::fields(&columns::names_of(graph, still));
    let numbers = still
        .iter()
        .map(|symbol| scalar::symbol_tokens(graph, *symbol));
    let of_symbol: BTreeMap<SymbolId, &Ident> = still.iter().copied().zip(&names).collect();
    let symbol = |symbol: SymbolId| {
        of_symbol
            .get(&symbol)
            .map_or_else(TokenStream::new, |name| quote!(#name))
    };
    let taken = names.iter().map(ToString::to_string);
    let Body {
        statements,
        outputs,
    } = Writer::new(graph, &staged.fixed, &symbol, taken).body();
    let count = columns::literal(still.len());
    let listed = columns::names_of(graph, still).join("`, `");
    let doc = format!(" [`fixed()`] from its numbers: `{listed}`.");
    // Nothing is taken apart where there is nothing.
    let opened = (!names.is_empty()).then(|| quote!(let [#(#names),*] = *numbers;));
    quote! {
        #[inline]
        pub fn fixed(#parameters) -> [f64; FIXED] {
            let numbers = [#(#numbers),*];
            fixed_of(&numbers)
        }

        #[doc = #doc]
        #[inline]
        pub fn fixed_of(numbers: &[f64; #count]) -> [f64; FIXED] {
            #opened
            #(#statements)*
            [#(#outputs),*]
        }
    }
}
