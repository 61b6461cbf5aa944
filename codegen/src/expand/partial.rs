//! The partials of formulas that other formulas call.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::fallback::stub_function;
use super::text::as_written;
use super::{Expansion, Formula};
use crate::differentiate::{self, Gradient};
use crate::emit::expression::Writer;
use crate::emit::scalar;
use crate::factor;
use crate::factor::rounding::Written;
use crate::graph::{ExprId, Graph, Role, SymbolId};
use crate::outputs::Outputs;
use crate::parse::attributes::Target;
use crate::parse::body::partials::{Misread, read_partial};
use crate::parse::body::{identifier, partial_symbols};
use crate::parse::module::Function;
use crate::parse::numbers;
use crate::rewrite;

impl Expansion {
    /// A formula with all inputs that are known of its function: the same names as where it is called.
    fn with_known_inputs(&self, function: &Function) -> Option<Formula> {
        let mut formula = self.formula(&function.name())?.clone();
        for number in numbers::known(function) {
            formula.input(&number);
        }
        Some(formula)
    }

    /// Reports a partial that is asked for and that the formula does not have.
    pub(super) fn check_partial(&mut self, function: &Function, asked: &Target) {
        let Some(formula) = self.with_known_inputs(function) else {
            return;
        };
        let name = function.name();
        let symbol = |id: SymbolId| formula.graph.symbol(id).name.clone();
        let misread = match formula.roots.as_slice() {
            [_] => read_partial(&name, &asked.symbol, &own_inputs(&formula.graph), symbol).err(),
            _ => Some(Misread {
                message: format!("`{name}` gives several numbers, a partial needs one"),
                hint: "write a function that gives the one number".to_owned(),
            }),
        };
        if let Some(Misread { message, hint }) = misread {
            self.diagnostics.error_with_hint(asked.span, message, hint);
        }
    }

    /// The function `d_x` or `d_x_y`.
    pub(super) fn partial(&mut self, function: &Function, partial: &str) -> TokenStream {
        let name = format_ident!("{partial}");
        let parameters = scalar::parameters(function);
        let written = format!(
            " Partial `{partial}` of [`{0}`](super::{0}()).",
            function.name()
        );
        let Some(mut formula) = self.with_known_inputs(function) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let names = own_inputs(&formula.graph);
        let ways = partial
            .strip_prefix("d_")
            .map(|suffix| partial_symbols(suffix, &names))
            .unwrap_or_default();
        let ([by], [_]) = (ways.as_slice(), formula.roots.as_slice()) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let Written {
            graph,
            roots,
            reverse,
            ..
        } = &mut formula.written;
        derive_by(graph, roots, by, differentiate::gradient_forward);
        derive_by(graph, reverse, by, differentiate::gradient);
        let (mut graph, mut roots) = (formula.graph, formula.roots);
        derive_by(&mut graph, &mut roots, by, differentiate::gradient);
        let (graph, roots) = rewrite::rewrite(&graph, &roots);
        let outputs = Outputs {
            values: roots,
            ..Outputs::default()
        };
        let found = factor::minimise(&graph, &outputs, &formula.written);
        let circuit = found.circuit;
        let why: Vec<String> = found.as_written.iter().flat_map(as_written).collect();
        self.use_tables(&graph, &circuit);
        let symbol = |symbol: SymbolId| scalar::symbol_tokens(&graph, symbol);
        let taken = scalar::names(function);
        let body = Writer::new(&graph, &circuit, &symbol, taken).body();
        let (statements, outputs) = (body.statements, body.outputs);
        let counts = format!(" Operations: {}.", circuit.cost());
        quote! {
            #[doc = #written]
            #[doc = ""]
            #[doc = #counts]
            #(#[doc = #why])*
            #[inline]
            pub fn #name(#parameters) -> f64 {
                #(#statements)*
                #(#outputs)*
            }
        }
    }
}

/// The inputs of a formula, by the names that they have in partials.
fn own_inputs(graph: &Graph) -> Vec<(String, SymbolId)> {
    let own = graph
        .symbols()
        .filter(|(_, symbol)| symbol.role == Role::Input);
    own.map(|(id, symbol)| (identifier(&symbol.name), id))
        .collect()
}

/// Puts the partials by some symbols, one after the other, in the place of numbers.
fn derive_by(graph: &mut Graph, numbers: &mut [ExprId], by: &[SymbolId], gradient: Gradient) {
    for number in numbers {
        for symbol in by {
            let partials = gradient(graph, *number, &[*symbol]);
            *number = partials.first().copied().unwrap_or(*number);
        }
    }
}
