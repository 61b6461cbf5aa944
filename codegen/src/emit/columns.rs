//! Forms over slices: one number of each input per row, one of each result.

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
pub fn inputs_type(graph: &Graph, symbols: &[SymbolId]) -> TokenStream {
    let fields = symbols.iter().map(|symbol| {
        let (field, doc) = (field(graph, *symbol), format!(" `{}` of each row.", graph.symbol(*symbol).name));
        quote! {
            #[doc = #doc]
            pub #field: &'a [f64]
        }
    });
    quote! {
        /// The inputs, a column each, all of the same length.
        #[derive(Clone, Copy, Debug)]
        pub struct Columns<'a> {
            #(#fields),*
        }
    }
}

fn field(graph: &Graph, symbol: SymbolId) -> Ident {
    format_ident!("{}", identifier(&graph.symbol(symbol).name))
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
    let symbol = |symbol: SymbolId| {
        let field = field(graph, symbol);
        quote!(#field)
    };
    let fields: Vec<Ident> = symbols.iter().map(|symbol| field(graph, *symbol)).collect();
    let results: Vec<Ident> = (0..outputs.len()).map(|position| format_ident!("result_{position}")).collect();
    let taken = fields.iter().chain(&results).map(ToString::to_string).chain(["row", "rows"].map(String::from));
    let Body { statements, outputs: values } = Writer::new(graph, circuit, &symbol, taken).body();
    let (name, count) = (format_ident!("{name}"), Literal::usize_unsuffixed(outputs.len()));
    let field_names = fields.iter().map(ToString::to_string);
    quote! {
        #(#[doc = #documentation])*
        pub fn #name(inputs: &Columns<'_>, results: [&mut [f64]; #count]) -> Result<(), ColumnLengthError> {
            let [#(#results),*] = results;
            let rows = result_0.len();
            let lengths = [
                #((#field_names, inputs.#fields.len()),)*
                #((#outputs, #results.len()),)*
            ];
            for (column, length) in lengths {
                if length != rows {
                    return Err(ColumnLengthError { column, length, expected: rows });
                }
            }
            #(let #fields = &inputs.#fields[..rows];)*
            #(let #results = &mut #results[..rows];)*
            for row in 0..rows {
                #(let #fields = #fields[row];)*
                #(#statements)*
                #(#results[row] = #values;)*
            }
            Ok(())
        }
    }
}
