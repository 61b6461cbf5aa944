//! Forms over slices: one number of each input per row, one of each result.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::expression::{Body, Writer};
use super::{grouped, parts};
use crate::circuit::Circuit;
use crate::graph::{Graph, SymbolId};
use crate::parse::body::identifier;

/// The error of all column forms, in the module once; it is the same one in all modules.
pub fn error_type() -> TokenStream {
    quote! {
        #[allow(unused_imports)]
        pub use ::lanes::ColumnLengthError;
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
    let (names, count) = (self::fields(symbols), literal(symbols.len()));
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

        impl<'a> Columns<'a> {
            /// The columns in the order in which the bodies of rows take them.
            #[inline]
            pub const fn slices(&self) -> [&'a [f64]; #count] {
                let slices = [#(self.#names),*];
                slices
            }
        }
    }
}

/// What the columns of these symbols are called: `c.beta` is `c_beta`, or `c_beta_` where another one is `c_beta`.
pub fn fields(symbols: &[String]) -> Vec<Ident> {
    identifiers(symbols, &["simd"])
}

/// The words that the code of kernels has for itself.
const OF_KERNELS: [&str; 9] = [
    "simd", "fixed", "along", "columns", "kept", "groups", "group", "pack", "take",
];

/// Makes different identifiers of names, none of which is reserved.
fn identifiers(names: &[String], reserved: &[&str]) -> Vec<Ident> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        let mut name = identifier(name);
        while found.contains(&name) || reserved.contains(&name.as_str()) {
            name.push('_');
        }
        found.push(name);
    }
    found.iter().map(|name| format_ident!("{name}")).collect()
}

/// The symbols as the formula writes them.
pub fn names_of(graph: &Graph, symbols: &[SymbolId]) -> Vec<String> {
    let name = |symbol: &SymbolId| graph.symbol(*symbol).name.clone();
    symbols.iter().map(name).collect()
}

/// A form over columns: the body of a row, and the function that runs it over all rows.
pub struct Form<'a> {
    /// Name of the type that stands for the body.
    pub body: &'a str,
    /// Name of the function.
    pub name: &'a str,
    /// Names of the results.
    pub outputs: &'a [String],
    /// Lines of the function's documentation.
    pub documentation: &'a [String],
}

/// A form over columns of the symbols around a circuit. It is put into the crates that call it, for every level of
/// instructions, and into no other: a form that nobody calls takes no time to build.
pub fn function(
    graph: &Graph,
    circuit: &Circuit,
    symbols: &[SymbolId],
    form: &Form<'_>,
) -> TokenStream {
    let names = names_of(graph, symbols);
    let fields = fields(&names);
    let (count, along) = (literal(form.outputs.len()), literal(fields.len()));
    let [body, name] = [form.body, form.name].map(|name| format_ident!("{name}"));
    let kernel = kernel(graph, circuit, &body, &[], symbols);
    let (documentation, outputs) = (form.documentation, form.outputs);
    let body_doc = format!(" What [`{name}()`] does in each row.");
    let columns = fields.iter().map(ToString::to_string);
    quote! {
        #[doc = #body_doc]
        #kernel

        #(#[doc = #documentation])*
        #[inline]
        pub fn #name(inputs: &Columns<'_>, results: [&mut [f64]; #count]) -> Result<(), ColumnLengthError> {
            let columns = [#(#columns,)* #(#outputs),*];
            let stored = ::lanes::rows::<#body, #along, #count>(inputs.slices(), results);
            stored.map_err(|error| ColumnLengthError::of(error, &columns))
        }
    }
}

/// A type that implements `lanes::Kernel` with the circuit as its body: `fixed` are the symbols that all rows share,
/// `along` those of which each row has its own.
pub fn kernel(
    graph: &Graph,
    circuit: &Circuit,
    name: &Ident,
    fixed: &[SymbolId],
    along: &[SymbolId],
) -> TokenStream {
    let symbols: Vec<SymbolId> = fixed.iter().chain(along).copied().collect();
    let locals = identifiers(&names_of(graph, &symbols), &OF_KERNELS);
    let of_symbol: BTreeMap<SymbolId, &Ident> = symbols.iter().copied().zip(&locals).collect();
    let symbol = |symbol: SymbolId| {
        of_symbol
            .get(&symbol)
            .map_or_else(TokenStream::new, |local| quote!(#local))
    };
    let reserved = OF_KERNELS.iter().map(ToString::to_string);
    let taken = locals.iter().map(ToString::to_string).chain(reserved);
    let body = Writer::new(graph, circuit, &symbol, taken)
        .in_packs()
        .body();
    let counts = [fixed.len(), along.len(), body.outputs.len()].map(literal);
    let [fixed_count, along_count, results] = &counts;
    let (fixed, along) = locals.split_at(fixed.len());
    let one_pack = one_pack(&body, [fixed, along], &counts);
    // One row alone is computed whole.
    let parts = parts::of(&body, along);
    let columns =
        (parts.len() > 1).then(|| grouped::over_columns(&body, &parts, [fixed, along], &counts));
    quote! {
        #[derive(Clone, Copy, Debug)]
        pub struct #name;

        impl ::lanes::Kernel<#fixed_count, #along_count, #results> for #name {
            #one_pack

            #columns
        }
    }
}

/// The body of a kernel for one pack.
fn one_pack(body: &Body, [fixed, along]: [&[Ident]; 2], counts: &[Literal; 3]) -> TokenStream {
    let [fixed_count, along_count, results] = counts;
    let opened = opened([(fixed, "fixed"), (along, "along")]);
    let (statements, outputs) = (&body.statements, &body.outputs);
    quote! {
        #[inline(always)]
        fn evaluate<S: ::lanes::Simd>(
            simd: S,
            fixed: [::lanes::Pack<S>; #fixed_count],
            along: [::lanes::Pack<S>; #along_count],
        ) -> [::lanes::Pack<S>; #results] {
            #opened
            #(#statements)*
            [#(#outputs),*]
        }
    }
}

/// Takes the numbers of arrays apart, except where there are none.
pub(super) fn opened<'a>(arrays: impl IntoIterator<Item = (&'a [Ident], &'a str)>) -> TokenStream {
    let some = arrays.into_iter().filter(|(names, _)| !names.is_empty());
    let opened = some.map(|(names, from)| {
        let from = format_ident!("{from}");
        quote!(let [#(#names),*] = #from;)
    });
    opened.collect()
}

/// A count as it stands in a type.
pub fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}
