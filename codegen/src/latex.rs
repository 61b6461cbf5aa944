//! Formulas as LaTeX, from their source: what their author wrote is shown, before any rewriting.
//!
//! [`Symbols`] alone decide how a name looks, `piece` where parentheses stand, `expression` how a construct of the
//! language is typeset, and this file how lines make up a formula.

mod choices;
mod expression;
mod methods;
mod piece;

use syn::visit::Visit;
use syn::{Expr, Pat, Stmt, Type};

use crate::parse::module::{Function, Module};
use crate::parse::names::Callee;
use crate::symbols::{Symbols, with_subscript};
use expression::{Names, Writer};

/// A line of more visible characters than this is broken before a plus or minus of its own.
const LONGEST: usize = 70;

/// The formula of a function, as the inside of a display: `name(arguments) = …`, and below it the bindings that it
/// uses, one per line. A result of several numbers has one line per number.
///
/// A parameter that is a struct is not written: its fields stand by their names, as quantities that are known throughout.
///
/// # Errors
/// The function holds what is no part of a formula, or what is not typeset, such as loops and assignments; the error is at
/// its place.
pub fn formula(module: &Module, symbols: &Symbols, function: &Function) -> syn::Result<String> {
    Ok(match lines(module, symbols, function)?.as_slice() {
        [line] if line.rows.len() == 1 => format!("{} = {}\n", line.left, line.rows.concat()),
        lines => aligned(lines.iter().map(Line::text)),
    })
}

/// The formula of a function as [`formula`] writes it, and below it the definitions of all formulas that it calls, and
/// that those call, each once, in the order in which they are met.
///
/// # Errors
/// As [`formula`], for each of them.
pub fn in_full(module: &Module, symbols: &Symbols, function: &Function) -> syn::Result<String> {
    let mut needed = called(module, function);
    if needed.is_empty() {
        return formula(module, symbols, function);
    }
    let mut rows: Vec<String> = lines(module, symbols, function)?
        .iter()
        .map(Line::text)
        .collect();
    rows.push("&\\text{where}".to_owned());
    let mut next = 0;
    while let Some(definition) = needed.get(next).copied() {
        let Callee {
            home,
            function: other,
        } = definition;
        rows.extend(lines(home, symbols, other)?.iter().map(Line::text));
        for further in called(home, other) {
            let first =
                further.home.key == module.key && further.function.name() == function.name();
            if !first && !needed.iter().any(|known| known.is(&further)) {
                needed.push(further);
            }
        }
        next += 1;
    }
    Ok(aligned(rows.into_iter()))
}

/// The formulas that a formula calls, each once, in the order of their first calls.
fn called<'m>(module: &'m Module, function: &Function) -> Vec<Callee<'m>> {
    let mut calls = Calls {
        module,
        found: Vec::new(),
    };
    calls.visit_block(&function.item.block);
    calls.found
}

struct Calls<'m> {
    module: &'m Module,
    found: Vec<Callee<'m>>,
}

impl<'ast> Visit<'ast> for Calls<'_> {
    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        if let Expr::Path(path) = call.func.as_ref()
            && let Some((callee, _)) = self.module.callee(&path.path)
            && !self.found.iter().any(|known| known.is(&callee))
        {
            self.found.push(callee);
        }
        syn::visit::visit_expr_call(self, call);
    }
}

fn aligned(rows: impl Iterator<Item = String>) -> String {
    format!(
        "\\begin{{aligned}}\n{}\n\\end{{aligned}}\n",
        rows.collect::<Vec<_>>().join("\\\\\n")
    )
}

/// The lines of a formula: its numbers, then its bindings. One that says nothing, `x = x`, is left out.
fn lines(module: &Module, symbols: &Symbols, function: &Function) -> syn::Result<Vec<Line>> {
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
    lines.retain(|line| line.rows.concat() != line.left);
    Ok(lines)
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
                    with_subscript(&head, &format!("{}", position + 1))
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
            "this pattern is not typeset",
        )),
    }
}

#[cfg(test)]
mod tests;
