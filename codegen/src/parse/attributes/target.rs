//! The numbers that attributes name.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Lit};

use crate::diagnostics::Diagnostics;

/// A number named in an attribute: a parameter, `c.field` or `a[0]`, with its place for messages.
#[derive(Clone, Debug)]
pub struct Target {
    /// The symbol's name.
    pub symbol: String,
    /// Where it is named.
    pub span: Span,
}

impl Target {
    /// The parameter that the number is of.
    pub fn root(&self) -> &str {
        root(&self.symbol)
    }
}

/// The parameter that a number is of: `c` of `c.field`, `a` of `a[0]`.
pub fn root(symbol: &str) -> &str {
    symbol.split(['.', '[']).next().unwrap_or(symbol)
}

/// The numbers that all arguments name.
pub(super) fn targets(arguments: &[&Expr], diagnostics: &mut Diagnostics) -> Vec<Target> {
    arguments
        .iter()
        .filter_map(|argument| target(argument, diagnostics))
        .collect()
}

/// `omega`, `c.beta` or `a[0]` as the name of a symbol.
pub(super) fn target(expression: &Expr, diagnostics: &mut Diagnostics) -> Option<Target> {
    let symbol = symbol_path(expression);
    if symbol.is_none() {
        diagnostics.error_with_hint(
            expression.span(),
            "not the name of a number",
            "write a parameter `x`, a field `c.x` or an element `a[0]`",
        );
    }
    Some(Target {
        symbol: symbol?,
        span: expression.span(),
    })
}

fn symbol_path(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        Expr::Field(field) => {
            let base = symbol_path(&field.base)?;
            match &field.member {
                syn::Member::Named(name) => Some(format!("{base}.{name}")),
                syn::Member::Unnamed(index) => Some(format!("{base}.{}", index.index)),
            }
        }
        Expr::Index(index) => match index.index.as_ref() {
            Expr::Lit(syn::ExprLit {
                lit: Lit::Int(position),
                ..
            }) => Some(format!(
                "{}[{}]",
                symbol_path(&index.expr)?,
                position.base10_digits()
            )),
            _ => None,
        },
        _ => None,
    }
}
