//! Functions of numbers: a value, a value with its gradient, and with its second partials.

use std::borrow::Cow;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::expression::{Body, Writer};
use crate::circuit::Circuit;
use crate::graph::{Graph, SymbolId};
use crate::parse::module::{Function, Parameter};
use crate::parse::value::Value;

/// What a generated function returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// The value as the formula gives it.
    Value,
    /// The value and its first partials.
    Gradient,
    /// Several numbers and the first partials of each.
    Jacobian,
    /// The value, its first and its second partials.
    Hessian,
}

impl Form {
    /// Name of the generated function.
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Gradient => "gradient",
            Self::Jacobian => "jacobian",
            Self::Hessian => "hessian",
        }
    }
}

/// A symbol as the scalar forms write it: a parameter, its field or its element.
pub fn symbol_tokens(graph: &Graph, symbol: SymbolId) -> TokenStream {
    let name = of_method(&graph.symbol(symbol).name);
    name.parse().unwrap_or_else(|_| {
        let name = format_ident!("{}", crate::parse::body::identifier(&name));
        quote!(#name)
    })
}

/// The parameters as the formula declares them.
pub fn parameters(function: &Function) -> TokenStream {
    let parameters = function.parameters.iter();
    let parameters = parameters.map(|Parameter { name, ty, .. }| {
        let own = (name == "self").then(|| Ident::new(OF_METHOD, name.span()));
        let name = own.as_ref().unwrap_or(name);
        quote!(#name: #ty)
    });
    quote!(#(#parameters),*)
}

/// The names of the parameters in generated functions.
pub fn names(function: &Function) -> impl Iterator<Item = String> {
    let names = function.parameters.iter();
    names.map(|parameter| of_method(&parameter.name.to_string()).into_owned())
}

/// What generated functions call the parameter `self` of a method, which only a method may have.
pub const OF_METHOD: &str = "self_";

/// A parameter, its field or its element by the name that it has in generated functions.
fn of_method(name: &str) -> Cow<'_, str> {
    match name.strip_prefix("self") {
        Some(rest) if rest.is_empty() || rest.starts_with(['.', '[']) => {
            Cow::Owned(format!("{OF_METHOD}{rest}"))
        }
        _ => Cow::Borrowed(name),
    }
}

/// The values in the shape that the formula gives them.
pub fn shaped(value: &Value, numbers: &mut impl Iterator<Item = TokenStream>) -> TokenStream {
    match value {
        Value::Number(_) => numbers.next().unwrap_or_default(),
        // None of these is a result.
        Value::Sum(_)
        | Value::Whole(_)
        | Value::Truth(_)
        | Value::Iterator(_)
        | Value::Parameter { .. } => TokenStream::new(),
        Value::Tuple(values) => {
            let values: Vec<_> = values.iter().map(|value| shaped(value, numbers)).collect();
            quote!((#(#values,)*))
        }
        Value::Array(values) => {
            let values: Vec<_> = values.iter().map(|value| shaped(value, numbers)).collect();
            quote!([#(#values),*])
        }
        Value::Struct { name, fields } => {
            let name: TokenStream = name.parse().unwrap_or_default();
            let fields: Vec<_> = fields
                .iter()
                .map(|(field, value)| {
                    let (name, value) = (format_ident!("{field}"), shaped(value, numbers));
                    if value.to_string() == *field {
                        quote!(#name)
                    } else {
                        quote!(#name: #value)
                    }
                })
                .collect();
            quote!(#name { #(#fields),* })
        }
    }
}

/// A function of numbers around a circuit whose outputs are, in order, the values, the gradient of each value, and the
/// upper triangle of the second partials of each.
pub fn function(
    graph: &Graph,
    circuit: &Circuit,
    function: &Function,
    value: &Value,
    form: Form,
    by: usize,
    documentation: &[String],
) -> TokenStream {
    let symbol = |symbol: SymbolId| symbol_tokens(graph, symbol);
    let taken = names(function);
    let Body {
        statements,
        outputs,
    } = Writer::new(graph, circuit, &symbol, taken)
        .with_sines_of_packs(function.asks_for_columns())
        .body();
    let count = Literal::usize_unsuffixed(value.numbers().len());
    let by_literal = Literal::usize_unsuffixed(by);
    let mut outputs = outputs.into_iter();
    let values = shaped(value, &mut outputs);
    let value_type = match &function.item.sig.output {
        syn::ReturnType::Default => quote!(()),
        syn::ReturnType::Type(_, ty) => quote!(#ty),
    };
    let (mut types, mut results) = (vec![value_type], vec![values]);
    let single = matches!(value, Value::Number(_));
    // One of a kind for a number, an array of them for several.
    let mut push = |ty: TokenStream, each: Vec<TokenStream>| {
        types.push(if single { ty } else { quote!([#ty; #count]) });
        results.push(if single {
            quote!(#(#each)*)
        } else {
            array(each)
        });
    };
    let numbers = 0..value.numbers().len();
    if form >= Form::Gradient {
        let rows = numbers.clone().map(|_| array(outputs.by_ref().take(by)));
        push(quote!([f64; #by_literal]), rows.collect());
    }
    if form == Form::Hessian {
        let matrices = numbers.map(|_| symmetric(&mut outputs, by));
        push(
            quote!([[f64; #by_literal]; #by_literal]),
            matrices.collect(),
        );
    }
    let (result_type, result) = match (types.as_slice(), results.as_slice()) {
        ([ty], [result]) => (quote!(#ty), quote!(#result)),
        _ => (quote!((#(#types),*)), quote!((#(#results),*))),
    };
    let name = format_ident!("{}", form.name());
    let parameters = parameters(function);
    quote! {
        #(#[doc = #documentation])*
        #[inline]
        pub fn #name(#parameters) -> #result_type {
            #(#statements)*
            #result
        }
    }
}

fn array(elements: impl IntoIterator<Item = TokenStream>) -> TokenStream {
    let elements = elements.into_iter();
    quote!([#(#elements),*])
}

/// A symmetric matrix from its upper triangle by rows.
fn symmetric(outputs: &mut impl Iterator<Item = TokenStream>, size: usize) -> TokenStream {
    let triangle: Vec<Vec<TokenStream>> = (0..size)
        .map(|row| outputs.by_ref().take(size - row).collect())
        .collect();
    let entry = |row: usize, column: usize| {
        let (first, second) = (row.min(column), row.max(column));
        triangle
            .get(first)
            .and_then(|entries| entries.get(second - first))
            .cloned()
            .unwrap_or_default()
    };
    array((0..size).map(|row| array((0..size).map(|column| entry(row, column)))))
}
