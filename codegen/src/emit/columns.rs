//! Forms over slices: one number of each input per row, one of each result.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::expression::{Body, Writer};
use crate::factor::circuit::Circuit;
use crate::graph::{Graph, SymbolId};
use crate::parse::body::identifier;

/// The error of all column forms of a module, declared once.
pub fn error_type() -> TokenStream {
    quote! {
        /// A column that is not as long as the results.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(dead_code)]
        pub struct ColumnLengthError {
            /// The column.
            pub column: &'static str,
            /// Its length.
            pub length: usize,
            /// The length of the first result.
            pub expected: usize,
        }

        impl ::core::fmt::Display for ColumnLengthError {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                let Self { column, length, expected } = self;
                write!(f, "column {column} has {length} rows; it must have {expected}, as the results have")
            }
        }

        impl ::core::error::Error for ColumnLengthError {}
    }
}

/// The struct `Columns` of the symbols' slices.
pub fn inputs_type(symbols: &[String]) -> TokenStream {
    let fields = fields(symbols)
        .into_iter()
        .zip(symbols)
        .map(|(field, symbol)| {
            let doc = format!(" `{symbol}` of each row.");
            quote! {
                #[doc = #doc]
                pub #field: &'a [f64]
            }
        });
    let none = symbols.is_empty().then(|| {
        quote! {
            /// There are no columns.
            pub none: ::core::marker::PhantomData<&'a f64>
        }
    });
    quote! {
        /// The inputs, a column each, all of the same length.
        #[derive(Clone, Copy, Debug)]
        pub struct Columns<'a> {
            #(#fields,)*
            #none
        }
    }
}

/// What the columns of these symbols are called: `c.beta` is `c_beta`, or `c_beta_` where another one is `c_beta`.
fn fields(symbols: &[String]) -> Vec<Ident> {
    let mut names: Vec<String> = Vec::new();
    for symbol in symbols {
        let mut name = identifier(symbol);
        while names.contains(&name) {
            name.push('_');
        }
        names.push(name);
    }
    names.iter().map(|name| format_ident!("{name}")).collect()
}

/// The symbols as the formula writes them.
pub fn names_of(graph: &Graph, symbols: &[SymbolId]) -> Vec<String> {
    let name = |symbol: &SymbolId| graph.symbol(*symbol).name.clone();
    symbols.iter().map(name).collect()
}

/// A function over columns around a circuit; `name` is its name, `outputs` the names of the results.
pub fn function(
    graph: &Graph,
    circuit: &Circuit,
    symbols: &[SymbolId],
    name: &str,
    outputs: &[String],
    documentation: &[String],
) -> TokenStream {
    let fields = fields(&names_of(graph, symbols));
    let columns: BTreeMap<SymbolId, &Ident> = symbols.iter().copied().zip(&fields).collect();
    let symbol = |symbol: SymbolId| {
        columns
            .get(&symbol)
            .map_or_else(TokenStream::new, |field| quote!(#field))
    };
    // The function's own names give way to those of the columns.
    let free = |wish: &str| {
        let mut name = wish.to_owned();
        while fields.iter().any(|field| *field == name) {
            name.push('_');
        }
        format_ident!("{name}")
    };
    let (inputs, row, rows) = (free("inputs"), free("row"), free("rows"));
    let results: Vec<Ident> = (0..outputs.len())
        .map(|position| free(&format!("result_{position}")))
        .collect();
    let first = results.first();
    let taken = fields
        .iter()
        .chain(&results)
        .chain([&row, &rows])
        .map(ToString::to_string);
    let Body {
        statements,
        outputs: values,
    } = Writer::new(graph, circuit, &symbol, taken).body();
    let (name, count) = (
        format_ident!("{name}"),
        Literal::usize_unsuffixed(outputs.len()),
    );
    let field_names = fields.iter().map(ToString::to_string);
    quote! {
        #(#[doc = #documentation])*
        pub fn #name(#inputs: &Columns<'_>, results: [&mut [f64]; #count]) -> Result<(), ColumnLengthError> {
            let [#(#results),*] = results;
            let #rows = #first.len();
            let lengths = [
                #((#field_names, #inputs.#fields.len()),)*
                #((#outputs, #results.len()),)*
            ];
            for (column, length) in lengths {
                if length != #rows {
                    return Err(ColumnLengthError { column, length, expected: #rows });
                }
            }
            #(let #fields = &#inputs.#fields[..#rows];)*
            #(let #results = &mut #results[..#rows];)*
            for #row in 0..#rows {
                #(let #fields = #fields[#row];)*
                #(#statements)*
                #(#results[#row] = #values;)*
            }
            Ok(())
        }
    }
}
