//! Formulas as LaTeX, from their source: what their author wrote is shown, before any rewriting.
//!
//! `symbols` alone decides how a name looks, `piece` where parentheses stand, `expression` how a construct of the
//! language is typeset, and this file how lines make up a formula.

mod expression;
mod piece;
mod symbols;

use syn::{Expr, Pat, Stmt, Type};

use crate::parse::module::{Function, Module};
use expression::{Names, Writer};
pub use symbols::Symbols;

/// A line of more visible characters than this is broken before a plus or minus of its own.
const LONGEST: usize = 70;

/// The formula of a function, as the inside of a display: `name(arguments) = …`, and below it the bindings that it
/// uses, one per line. A result of several numbers has one line per number.
///
/// A parameter that is a struct is not written: its fields stand by their names, as quantities that are known throughout.
///
/// # Errors
/// The function holds what is not a part of a formula; the error is at its place.
pub fn formula(module: &Module, symbols: &Symbols, function: &Function) -> syn::Result<String> {
    let mut writer = Writer::new(Names::of(module, symbols, function));
    let Some((result, bindings)) = function.item.block.stmts.split_last() else {
        return Err(syn::Error::new(
            function.item.sig.ident.span(),
            "the formula has no value",
        ));
    };
    for binding in bindings {
        writer.binding(binding)?;
    }
    let result = match result {
        Stmt::Expr(Expr::Return(returned), _) => returned.expr.as_deref(),
        Stmt::Expr(result, None) => Some(result),
        _ => None,
    };
    let Some(result) = result else {
        return Err(syn::Error::new(
            function.item.sig.ident.span(),
            "the formula has no value",
        ));
    };
    let mut lines = result_lines(&mut writer, function, result)?;
    lines.extend(writer.lines);
    Ok(match lines.as_slice() {
        [line] if line.rows.len() == 1 => format!("{} = {}\n", line.left, line.rows.concat()),
        _ => format!(
            "\\begin{{aligned}}\n{}\n\\end{{aligned}}\n",
            lines
                .iter()
                .map(Line::text)
                .collect::<Vec<_>>()
                .join("\\\\\n")
        ),
    })
}

/// `left = right`, the right side in rows.
struct Line {
    left: String,
    rows: Vec<String>,
}

impl Line {
    /// A line whose right side is the sum of these terms, each with its sign where it is not the first.
    fn new(left: String, terms: &[String]) -> Self {
        let (mut rows, mut row) = (Vec::new(), String::new());
        for term in terms {
            if !row.is_empty() && visible(&row) + visible(term) > LONGEST {
                rows.push(std::mem::take(&mut row));
            }
            row.push_str(if row.is_empty() { "" } else { " " });
            row.push_str(term);
        }
        rows.push(row);
        Self { left, rows }
    }

    fn text(&self) -> String {
        format!("{} &= {}", self.left, self.rows.join("\\\\\n&\\quad "))
    }
}

/// About how many characters are seen: a command counts as one.
fn visible(latex: &str) -> usize {
    let mut count = 0;
    let mut command = false;
    for character in latex.chars() {
        let starts = character == '\\';
        command = starts || (command && character.is_ascii_alphabetic());
        count +=
            usize::from(starts || !(command || matches!(character, '{' | '}' | ' ' | '_' | '^')));
    }
    count
}

/// One line for each number of the result.
fn result_lines(
    writer: &mut Writer<'_>,
    function: &Function,
    result: &Expr,
) -> syn::Result<Vec<Line>> {
    match result {
        Expr::Struct(literal) => literal
            .fields
            .iter()
            .map(|field| {
                let syn::Member::Named(name) = &field.member else {
                    return Err(syn::Error::new_spanned(
                        &field.member,
                        "a field without a name is not a part of a formula",
                    ));
                };
                Ok(Line::new(
                    writer.symbol(&name.to_string()),
                    &writer.terms(&field.expr)?,
                ))
            })
            .collect(),
        Expr::Tuple(syn::ExprTuple { elems, .. }) | Expr::Array(syn::ExprArray { elems, .. }) => {
            let head = writer.symbol(&function.name());
            let arguments = writer.signature();
            let line = |(position, element)| {
                let left = format!(
                    "{}{arguments}",
                    symbols::with_subscript(&head, &format!("{}", position + 1))
                );
                Ok(Line::new(left, &writer.terms(element)?))
            };
            elems.iter().enumerate().map(line).collect()
        }
        Expr::Paren(inner) => result_lines(writer, function, &inner.expr),
        _ => {
            let left = format!("{}{}", writer.symbol(&function.name()), writer.signature());
            Ok(vec![Line::new(left, &writer.terms(result)?)])
        }
    }
}

/// The name of a parameter's or a result's type without its path, where it has one.
fn type_name(ty: &Type) -> Option<String> {
    match ty {
        Type::Reference(reference) => type_name(&reference.elem),
        Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
        _ => None,
    }
}

/// The names that a pattern binds.
fn bound_names(pattern: &Pat) -> syn::Result<Vec<String>> {
    match pattern {
        Pat::Ident(name) => Ok(vec![name.ident.to_string()]),
        Pat::Type(typed) => bound_names(&typed.pat),
        Pat::Paren(inner) => bound_names(&inner.pat),
        Pat::Wild(_) => Ok(vec!["_".to_owned()]),
        Pat::Tuple(tuple) => {
            let names: syn::Result<Vec<_>> = tuple.elems.iter().map(bound_names).collect();
            Ok(names?.concat())
        }
        other => Err(syn::Error::new_spanned(
            other,
            "this pattern is not a part of a formula",
        )),
    }
}

#[cfg(test)]
mod tests;
