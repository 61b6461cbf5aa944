//! What is asked of a function: `#[generate]`, `#[domain]`, `#[approximate]`, `#[specialise]`.

mod approximation;
mod budget;
mod domain;
pub mod of_module;
mod request;
mod specialisation;
mod target;

use proc_macro2::Span;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, Expr, Ident, Lit, Token};

use crate::diagnostics::Diagnostics;
use crate::graph::Domain;
pub use budget::Limit;
pub use request::{ChainRequest, Request, StageRequest};
pub use specialisation::Specialisation;
pub use target::{Target, root};

/// A function to be tabulated when the crate is built.
#[derive(Clone, Debug)]
pub struct Approximation {
    /// The function's one parameter.
    pub variable: Ident,
    /// Lower end of the interval.
    pub lower: f64,
    /// Upper end of the interval.
    pub upper: f64,
    /// Factor that is kept as it is, so that only the quotient is approximated.
    pub factor: Option<Expr>,
    /// Greatest relative error.
    pub tolerance: f64,
    /// Where it is asked for.
    pub span: Span,
}

/// Everything that a function's attributes say.
#[derive(Clone, Debug, Default)]
pub struct FunctionAttributes {
    /// `#[generate(…)]`
    pub request: Option<Request>,
    /// `#[domain(…)]`
    pub domain: Vec<(Target, Domain)>,
    /// `#[approximate(…)]`
    pub approximation: Option<Approximation>,
    /// `#[specialise(…)]`, any number of them.
    pub specialisations: Vec<Specialisation>,
}

/// The attributes that belong to the generator; all others stay on the function.
pub const OWN: [&str; 4] = ["generate", "domain", "approximate", "specialise"];

impl FunctionAttributes {
    /// Reads the generator's attributes among `attributes`.
    pub fn read(attributes: &[Attribute], diagnostics: &mut Diagnostics) -> Self {
        let mut read = Self::default();
        for attribute in attributes {
            let Some(name) = OWN.into_iter().find(|name| attribute.path().is_ident(name)) else {
                continue;
            };
            let Some(words) = words(attribute, example(name), diagnostics) else {
                continue;
            };
            let span = attribute.path().span();
            let repeated = match name {
                "generate" => read.request.is_some(),
                "approximate" => read.approximation.is_some(),
                _ => false,
            };
            if repeated {
                diagnostics.error_with_hint(
                    span,
                    format!("a second `{name}` of one function"),
                    "write all of it in one attribute",
                );
                continue;
            }
            match name {
                "generate" => read.request = Some(request::read(&words, span, diagnostics)),
                "domain" => {
                    read.domain.extend(
                        words
                            .iter()
                            .filter_map(|word| domain::read(word, diagnostics)),
                    );
                }
                "approximate" => {
                    read.approximation = approximation::read(&words, span, diagnostics);
                }
                _ => read
                    .specialisations
                    .extend(specialisation::read(&words, span, diagnostics)),
            }
        }
        read
    }
}

/// How an attribute is written, for hints.
fn example(attribute: &str) -> &'static str {
    match attribute {
        "generate" => "write for example generate(value, gradient(x, c.y), columns)",
        "domain" => domain::EXAMPLE,
        "approximate" => approximation::EXAMPLE,
        _ => specialisation::EXAMPLE,
    }
}

fn words(attribute: &Attribute, example: &str, diagnostics: &mut Diagnostics) -> Option<Vec<Expr>> {
    let parser = Punctuated::<Expr, Token![,]>::parse_terminated;
    let tokens = match &attribute.meta {
        syn::Meta::List(list) => list.tokens.clone(),
        _ => proc_macro2::TokenStream::new(),
    };
    match parser.parse2(tokens) {
        Ok(words) => Some(words.into_iter().collect()),
        Err(error) => {
            diagnostics.syntax(&error, example);
            None
        }
    }
}

/// The word of `word` or `word(arguments)`.
fn head(expression: &Expr) -> Option<(&Ident, Vec<&Expr>)> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(|ident| (ident, Vec::new())),
        Expr::Call(call) => match call.func.as_ref() {
            Expr::Path(path) => path
                .path
                .get_ident()
                .map(|ident| (ident, call.args.iter().collect())),
            _ => None,
        },
        _ => None,
    }
}

/// A literal number of an attribute.
fn number(expression: &Expr) -> Option<f64> {
    match expression {
        Expr::Lit(syn::ExprLit {
            lit: Lit::Float(value),
            ..
        }) => value.base10_parse().ok(),
        Expr::Lit(syn::ExprLit {
            lit: Lit::Int(value),
            ..
        }) => value.base10_parse().ok(),
        Expr::Unary(syn::ExprUnary {
            op: syn::UnOp::Neg(_),
            expr,
            ..
        }) => number(expr).map(|value: f64| -value),
        _ => None,
    }
}
