//! Patterns: the names that a `let`, a loop or a closure binds to a value and its parts.

use syn::Pat;
use syn::spanned::Spanned;

use super::{Reader, Scope};
use crate::parse::module::bound_names;
use crate::parse::value::Value;

/// The names of a binding that failed: they count as known, so that its mistake is reported once.
pub(super) fn unread(pattern: &Pat) -> impl Iterator<Item = (String, Option<Value>)> {
    bound_names(pattern).into_iter().map(|name| (name, None))
}

/// The patterns of a list before and behind its `..`.
struct AroundRest<'p> {
    before: Vec<&'p Pat>,
    behind: Vec<&'p Pat>,
    /// Whether there is a `..`.
    is_open: bool,
    /// The name in `name @ ..`.
    name: Option<String>,
}

impl<'p> AroundRest<'p> {
    fn of(patterns: impl IntoIterator<Item = &'p Pat>) -> Self {
        let (mut before, mut behind) = (Vec::new(), Vec::new());
        let (mut is_open, mut name) = (false, None);
        for pattern in patterns {
            let subpattern =
                |ident: &'p syn::PatIdent| ident.subpat.as_ref().map(|(_, it)| it.as_ref());
            match pattern {
                Pat::Rest(_) => is_open = true,
                Pat::Ident(ident) if matches!(subpattern(ident), Some(Pat::Rest(_))) => {
                    is_open = true;
                    name = Some(ident.ident.to_string());
                }
                pattern if is_open => behind.push(pattern),
                pattern => before.push(pattern),
            }
        }
        Self {
            before,
            behind,
            is_open,
            name,
        }
    }
}

impl<'m> Reader<'m> {
    /// Binds the names of a pattern; those of a value that could not be read have none either.
    pub(super) fn bind(
        &mut self,
        pattern: &Pat,
        value: Option<Value>,
        scope: &mut Scope,
    ) -> Option<()> {
        match pattern {
            Pat::Ident(name) if name.by_ref.is_none() && name.subpat.is_none() => {
                let text = name.ident.to_string();
                if let Some(value) = &value {
                    self.name(value, &text);
                }
                scope.bind(text, value);
                Some(())
            }
            Pat::Type(typed) => self.bind(&typed.pat, value, scope),
            Pat::Paren(inner) => self.bind(&inner.pat, value, scope),
            Pat::Reference(inner) if inner.mutability.is_none() => {
                self.bind(&inner.pat, value, scope)
            }
            Pat::Wild(_) => Some(()),
            Pat::Tuple(tuple) => {
                let parts = match value {
                    Some(Value::Tuple(parts)) => Some(parts),
                    Some(other) => return self.not_apart(pattern, tuple.elems.len(), &other),
                    None => None,
                };
                self.bind_parts(pattern, &tuple.elems, parts, scope)
            }
            Pat::Slice(slice) => {
                let parts = match value {
                    Some(Value::Array(parts)) => Some(parts),
                    Some(other) => return self.not_apart(pattern, slice.elems.len(), &other),
                    None => None,
                };
                self.bind_parts(pattern, &slice.elems, parts, scope)
            }
            Pat::Struct(fields) => self.bind_fields(fields, value, scope),
            Pat::Ident(name) => {
                let hint = "bind the name alone: formulas take numbers by value";
                self.diagnostics
                    .error_with_hint(name.span(), "a binding is a plain name", hint);
                None
            }
            other => {
                let hint = "bind a name, a tuple, an array or a struct of names";
                self.unsupported(other.span(), "this pattern", hint)
            }
        }
    }

    /// Binds the patterns of a list to parts in order, of which `..` leaves out those in the middle.
    fn bind_parts<'p>(
        &mut self,
        pattern: &Pat,
        patterns: impl IntoIterator<Item = &'p Pat>,
        parts: Option<Vec<Value>>,
        scope: &mut Scope,
    ) -> Option<()> {
        let around = AroundRest::of(patterns);
        let (first, last) = (around.before.len(), around.behind.len());
        let count = first + last;
        let (before, behind): (Vec<Option<Value>>, Vec<Option<Value>>) = match parts {
            None => (vec![None; first], vec![None; last]),
            Some(parts) if parts.len() == count || (around.is_open && parts.len() > count) => {
                let skipped = parts.len() - last;
                if let Some(name) = around.name {
                    let rest = parts[first..skipped].to_vec();
                    scope.bind(name, Some(Value::Array(rest)));
                }
                let behind = parts[skipped..].iter().cloned().map(Some).collect();
                (parts.into_iter().map(Some).collect(), behind)
            }
            Some(parts) => {
                let (what, length) = match pattern {
                    Pat::Tuple(_) => ("a tuple", parts.len()),
                    _ => ("an array", parts.len()),
                };
                let message = format!("{what} of {length} can't be taken apart into {count} parts");
                let hint = "bind it to one name, or leave parts out by `..`";
                self.diagnostics
                    .error_with_hint(pattern.span(), message, hint);
                return None;
            }
        };
        let mut complete = Some(());
        let patterns = around.before.into_iter().zip(before);
        for (pattern, part) in patterns.chain(around.behind.into_iter().zip(behind)) {
            complete = self.bind(pattern, part, scope).and(complete);
        }
        complete
    }

    fn not_apart(&mut self, pattern: &Pat, count: usize, value: &Value) -> Option<()> {
        let message = format!(
            "{} can't be taken apart into {count} parts",
            value.description()
        );
        let hint = match pattern {
            Pat::Tuple(_) => "bind it to one name, or take apart a tuple of as many parts",
            _ => "bind it to one name, or take apart an array of as many elements",
        };
        self.diagnostics
            .error_with_hint(pattern.span(), message, hint);
        None
    }

    /// `Name { field, other: pattern, .. }`
    fn bind_fields(
        &mut self,
        pattern: &syn::PatStruct,
        value: Option<Value>,
        scope: &mut Scope,
    ) -> Option<()> {
        let is_struct =
            |value: &Value| matches!(value, Value::Struct { .. } | Value::Parameter { .. });
        if let Some(other) = value.as_ref().filter(|value| !is_struct(value)) {
            let message = format!("{} can't be taken apart by fields", other.description());
            let hint = other.way_to_a_number();
            self.diagnostics
                .error_with_hint(pattern.span(), message, hint);
            return None;
        }
        let mut complete = Some(());
        for field in &pattern.fields {
            let part = match &value {
                Some(value) => {
                    let part = self.field_of(value.clone(), &field.member);
                    complete = complete.filter(|()| part.is_some());
                    part
                }
                None => None,
            };
            complete = self.bind(&field.pat, part, scope).and(complete);
        }
        complete
    }

    /// Binds the names of a closure to what it is called with.
    pub(super) fn bind_arguments(
        &mut self,
        closure: &syn::ExprClosure,
        arguments: Vec<Value>,
        scope: &mut Scope,
    ) -> Option<()> {
        if closure.inputs.len() != arguments.len() {
            let message = format!(
                "this closure takes {} arguments, not {}",
                arguments.len(),
                closure.inputs.len()
            );
            let hint = "give each a name, or take a tuple apart by `|(a, b)|`";
            self.diagnostics
                .error_with_hint(closure.span(), message, hint);
            return None;
        }
        for (pattern, argument) in closure.inputs.iter().zip(arguments) {
            self.bind(pattern, Some(argument), scope)?;
        }
        Some(())
    }
}
