//! The partials of formulas that other formulas call.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::fallback::stub_function;
use super::{Expansion, is_own};
use crate::differentiate;
use crate::emit::expression::Writer;
use crate::emit::scalar;
use crate::factor::{self, Outputs};
use crate::graph::SymbolId;
use crate::parse::body::{identifier, partial_symbols};
use crate::parse::module::Function;
use crate::parse::numbers;
use crate::rewrite;

impl Expansion {
    /// The function `d_x` or `d_x_y`.
    pub(super) fn partial(&mut self, function: &Function, partial: &str) -> TokenStream {
        let name = format_ident!("{partial}");
        let parameters = scalar::parameters(function);
        let written = format!(
            " Partial `{partial}` of [`{0}`](super::{0}()).",
            function.name()
        );
        let Some(formula) = self.formula(&function.name()) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let mut graph = formula.graph.clone();
        // The same names as where it is called.
        for number in numbers::known(&self.module, function) {
            graph.symbol_named(&number);
        }
        let own = graph.symbols().filter(|(_, symbol)| is_own(&symbol.name));
        let names: Vec<(String, SymbolId)> = own
            .map(|(id, symbol)| (identifier(&symbol.name), id))
            .collect();
        let ways = partial
            .strip_prefix("d_")
            .map(|suffix| partial_symbols(suffix, &names))
            .unwrap_or_default();
        let ([by], [root]) = (ways.as_slice(), formula.roots.as_slice()) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let derivative = by.iter().fold(*root, |derivative, symbol| {
            differentiate::gradient(&mut graph, derivative, &[*symbol])
                .first()
                .copied()
                .unwrap_or(derivative)
        });
        let (graph, roots) = rewrite::rewrite(&graph, &[derivative]);
        let circuit = factor::minimise(
            &graph,
            &Outputs {
                values: roots,
                ..Outputs::default()
            },
        );
        self.use_tables(&graph, &circuit);
        let symbol = |symbol: SymbolId| scalar::symbol_tokens(&graph, symbol);
        let taken = function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        let body = Writer::new(&graph, &circuit, &symbol, taken).body();
        let (statements, outputs) = (body.statements, body.outputs);
        let counts = format!(" Operations: {}.", circuit.cost());
        quote! {
            #[doc = #written]
            #[doc = ""]
            #[doc = #counts]
            #[inline]
            pub fn #name(#parameters) -> f64 {
                #(#statements)*
                #(#outputs)*
            }
        }
    }
}
