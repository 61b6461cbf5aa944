//! Whether a formula gives what its signature says.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Expr, ReturnType, Stmt, Type};

use super::Reader;
use crate::parse::module::{Function, Module};
use crate::parse::shape::is_other_type;
use crate::parse::value::Value;
use crate::parse::whole;

impl<'m> Reader<'m> {
    /// Reports a result of another shape than the function's type says, as far as the module knows that type: generated
    /// forms have the same type, so that the compiler would say it of each of them.
    pub(super) fn check_result(&mut self, function: &Function, value: &Value) -> Option<()> {
        let gives = value.description();
        let (message, hint) = match &function.item.sig.output {
            ReturnType::Default => (
                format!("`{}` gives {gives}, but says no type", function.name()),
                format!("write `-> {}`", type_of(value)),
            ),
            ReturnType::Type(_, ty) if fits(self.module, ty, value) => return Some(()),
            ReturnType::Type(_, ty) => (
                format!(
                    "`{}` gives {gives}, its type is `{}`",
                    function.name(),
                    ty.to_token_stream()
                ),
                format!("what it gives is of the type `{}`", type_of(value)),
            ),
        };
        let span = match function.item.block.stmts.last() {
            Some(Stmt::Expr(Expr::Return(end), _)) => end.expr.as_ref().map(Spanned::span),
            Some(end) => Some(end.span()),
            None => None,
        };
        let span = span.unwrap_or_else(|| function.item.sig.ident.span());
        self.diagnostics.error_with_hint(span, message, hint);
        None
    }
}

/// Whether a value may be of the type; of types that the module does not know, every struct and number may be.
fn fits(module: &Module, ty: &Type, value: &Value) -> bool {
    match (ty, value) {
        (Type::Paren(paren), _) => fits(module, &paren.elem, value),
        (Type::Group(group), _) => fits(module, &group.elem, value),
        (Type::Reference(reference), _) => fits(module, &reference.elem, value),
        (Type::Tuple(tuple), Value::Tuple(values)) => {
            let mut parts = tuple.elems.iter().zip(values);
            tuple.elems.len() == values.len() && parts.all(|(ty, value)| fits(module, ty, value))
        }
        (Type::Array(array), Value::Array(values)) => {
            let length = whole::constant(module, &array.len);
            length.is_none_or(|length| usize::try_from(length) == Ok(values.len()))
                && values.iter().all(|value| fits(module, &array.elem, value))
        }
        (Type::Tuple(_) | Type::Array(_) | Type::Slice(_), _) => false,
        (Type::Path(path), value) => match (module.fields_at(&path.path), value) {
            (Some(_), Value::Struct { name, .. }) => {
                let last = |path: &str| path.rsplit("::").next().map(|last| last.trim().to_owned());
                let known = |name: &str| module.structs.iter().any(|(known, _)| known == name);
                let named = last(name).unwrap_or_default();
                last(&path.to_token_stream().to_string()) == Some(named.clone()) || !known(&named)
            }
            (Some(_), value) => matches!(value, Value::Parameter { .. }),
            (None, Value::Number(_)) => !is_other_type(&path.path),
            (None, _) => !path.path.is_ident("f64") && !is_other_type(&path.path),
        },
        _ => true,
    }
}

/// The type of a value as it is written.
fn type_of(value: &Value) -> String {
    match value {
        Value::Number(_) | Value::Sum(_) => "f64".to_owned(),
        Value::Whole(_) => "i32".to_owned(),
        Value::Truth(_) => "bool".to_owned(),
        Value::Tuple(values) => {
            let parts: Vec<String> = values.iter().map(type_of).collect();
            format!("({})", parts.join(", "))
        }
        Value::Array(values) => {
            let element = values.first().map_or_else(|| "f64".to_owned(), type_of);
            format!("[{element}; {}]", values.len())
        }
        Value::Iterator(_) => "impl Iterator".to_owned(),
        Value::Struct { name, .. } => name.replace(' ', ""),
        Value::Parameter { path, .. } => format!("that of `{path}`"),
    }
}
