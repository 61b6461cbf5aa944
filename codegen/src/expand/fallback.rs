//! What stands in for generated code: stubs where an expansion failed, and the integral of functions as written.

use proc_macro2::{Group, Literal, Spacing, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote, quote_spanned};

use crate::emit::columns;
use crate::emit::scalar::{self, Form};
use crate::emit::staged;
use crate::parse::attributes::{Request, StageRequest};
use crate::parse::module::{Function, Module};
use crate::parse::numbers;
use crate::parse::shape::Shape;

/// How many numbers a result holds, as its type says.
enum Numbers {
    /// It is a number itself.
    One,
    Counted(Literal),
    /// A struct from outside the module.
    Unknown,
}

/// A form that could not be generated, with its signature, so that its callers are not reported too. How many numbers it
/// gives, or is derived by, is the caller's choice where neither a type nor a list says it.
pub(super) fn stub(module: &Module, function: &Function, form: Form, by: usize) -> TokenStream {
    let value = match &function.item.sig.output {
        syn::ReturnType::Default => quote!(()),
        syn::ReturnType::Type(_, ty) => quote!(#ty),
    };
    let mut function = function.clone();
    let mut chosen_by_caller = |name: &str| {
        let name = format_ident!("{name}");
        let parameter = syn::parse_quote!(const #name: usize);
        function.item.sig.generics.params.push(parameter);
        quote!(#name)
    };
    let result = if form == Form::Value {
        value
    } else {
        let by = match by {
            0 => chosen_by_caller("BY"),
            count => Literal::usize_unsuffixed(count).to_token_stream(),
        };
        let numbers = match numbers_of(module, &function.item.sig.output) {
            Numbers::One => None,
            Numbers::Counted(count) => Some(count.to_token_stream()),
            Numbers::Unknown => Some(chosen_by_caller("NUMBERS")),
        };
        let each = |one: TokenStream| match &numbers {
            Some(count) => quote!([#one; #count]),
            None => one,
        };
        let (gradient, hessian) = (each(quote!([f64; #by])), each(quote!([[f64; #by]; #by])));
        match form {
            Form::Hessian => quote!((#value, #gradient, #hessian)),
            _ => quote!((#value, #gradient)),
        }
    };
    let name = format_ident!("{}", form.name());
    stub_function(&function, &quote!(#name), &result)
}

fn numbers_of(module: &Module, output: &syn::ReturnType) -> Numbers {
    let syn::ReturnType::Type(_, ty) = output else {
        return Numbers::Unknown;
    };
    let counted = |count: usize| Numbers::Counted(Literal::usize_unsuffixed(count));
    let count = |ty: &syn::Type| Shape::of(module, ty).and_then(|shape| shape.count());
    match ty.as_ref() {
        syn::Type::Tuple(tuple) => {
            let counts: Option<Vec<usize>> = tuple.elems.iter().map(count).collect();
            counts.map_or(Numbers::Unknown, |counts| counted(counts.iter().sum()))
        }
        syn::Type::Path(path) if path.path.is_ident("f64") => Numbers::One,
        ty => count(ty).map_or(Numbers::Unknown, counted),
    }
}

/// The column forms that could not be generated: `Columns` with the fields that the parameters' types tell.
pub(super) fn column_stubs(function: &Function, request: &Request) -> TokenStream {
    let fields = numbers::known(function);
    let inputs = columns::inputs_type(&fields);
    let asked = [
        ("columns", true),
        ("gradient_columns", request.gradient.is_some()),
        ("jacobian_columns", request.jacobian.is_some()),
    ];
    let asked = asked.into_iter().filter(|(_, is_asked)| *is_asked);
    let names = asked.map(|(name, _)| format_ident!("{name}"));
    quote! {
        #inputs
        #(
            /// Not generated: see the errors of the module.
            pub fn #names<const RESULTS: usize>(
                _: &Columns<'_>,
                _: [&mut [f64]; RESULTS],
            ) -> Result<(), ColumnLengthError> {
                loop {}
            }
        )*
    }
}

/// A staged form that could not be generated: its names, so that their users are not reported too.
pub(super) fn staged_stub(function: &Function, request: &StageRequest) -> TokenStream {
    let inner: Vec<String> = request
        .inner
        .iter()
        .map(|target| target.symbol.clone())
        .collect();
    let module = format_ident!("{}", staged::module_name(&inner));
    let fixed = stub_function(function, &quote!(fixed), &quote!([f64; FIXED]));
    let kernels = ["Along", "Points"].map(|name| format_ident!("{name}"));
    quote! {
        /// Not generated: see the errors of the module.
        pub mod #module {
            use super::*;

            pub const FIXED: usize = 0;
            pub const TABLES: usize = 0;
            #fixed
            #(
                pub struct #kernels;

                impl<const FIXED: usize, const ALONG: usize, const RESULTS: usize>
                    ::lanes::Kernel<FIXED, ALONG, RESULTS> for #kernels
                {
                    fn evaluate<S: ::lanes::Simd>(
                        _: S,
                        _: [::lanes::Pack<S>; FIXED],
                        _: [::lanes::Pack<S>; ALONG],
                    ) -> [::lanes::Pack<S>; RESULTS] {
                        loop {}
                    }
                }
            )*
        }
    }
}

/// Items that were written for a module, as a module within it needs them: its `self` is `super` there.
pub(super) fn one_deeper(items: TokenStream) -> TokenStream {
    let mut result = TokenStream::new();
    let mut tokens = items.into_iter().peekable();
    // Of `super::super` only the first starts the path.
    let mut within_path = false;
    while let Some(token) = tokens.next() {
        let before_path = matches!(tokens.peek(), Some(TokenTree::Punct(next)) if next.as_char() == ':'
            && next.spacing() == Spacing::Joint);
        let starts_path = before_path && !within_path;
        // The first colon of `::` is joint, the second may be anything; the one of `x: T` stands alone.
        within_path = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ':'
            && (within_path || punct.spacing() == Spacing::Joint));
        match token {
            TokenTree::Ident(name) if starts_path && name == "self" => {
                result.extend(quote_spanned!(name.span()=> super));
            }
            TokenTree::Ident(name) if starts_path && name == "super" => {
                result.extend(quote_spanned!(name.span()=> super::super));
            }
            TokenTree::Group(group) => {
                let mut deeper = Group::new(group.delimiter(), one_deeper(group.stream()));
                deeper.set_span(group.span());
                result.extend([TokenTree::Group(deeper)]);
            }
            other => result.extend([other]),
        }
    }
    result
}

pub(super) fn stub_function(
    function: &Function,
    name: &TokenStream,
    result: &TokenStream,
) -> TokenStream {
    let signature = &function.item.sig;
    if signature.receiver().is_some() {
        return TokenStream::new();
    }
    let parameters = match &function.of {
        Some(_) => scalar::parameters(function),
        None => signature.inputs.to_token_stream(),
    };
    let (generics, bounds) = (&signature.generics, &signature.generics.where_clause);
    quote! {
        /// Not generated: see the errors of the module.
        pub fn #name #generics(#parameters) -> #result #bounds {
            loop {}
        }
    }
}

/// The integral that formulas call, for the functions as written: the tanh–sinh rule.
pub(super) fn integral_function() -> TokenStream {
    quote! {
        /// Definite integral by the tanh–sinh rule with 113 nodes, as the formulas that are written as integrals use it;
        /// generated code uses tables made by adaptive quadrature instead.
        fn integral(integrand: impl Fn(f64) -> f64, range: ::core::ops::Range<f64>) -> f64 {
            const STEP: f64 = 0.0625;
            let width = range.end - range.start;
            let mut sum = 0.0;
            for node in -56..=56 {
                let t = f64::from(node) * STEP;
                let s = ::core::f64::consts::FRAC_PI_2 * t.sinh();
                // The distance to the nearer end, by which the abscissa keeps its digits there.
                let distance = width / (1.0 + (2.0 * s.abs()).exp());
                let weight = ::core::f64::consts::FRAC_PI_2 * t.cosh() / s.cosh().powi(2);
                let x = if s < 0.0 { range.start + distance } else { range.end - distance };
                if x > range.start && x < range.end {
                    sum += weight * integrand(x);
                }
            }
            0.5 * width * STEP * sum
        }
    }
}
