//! Structs: their fields, and the literals that make them.

use quote::ToTokens;
use syn::spanned::Spanned;

use super::{Reader, Scope};
use crate::diagnostics::nearest;
use crate::parse::shape::{Fields, Shape};
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    /// A field of a struct or tuple.
    pub(super) fn field_of(&mut self, base: Value, field: &syn::Member) -> Option<Value> {
        let member = field.to_token_stream().to_string();
        let (description, mut hint) = (base.description(), base.known_fields());
        let found = match base {
            Value::Parameter {
                path,
                role,
                fields,
                replaced,
                ..
            } => {
                let known = |fields: &Fields| {
                    let mut fields = fields.iter();
                    fields.find(|(name, _)| *name == member).cloned()
                };
                let of_type = match &fields {
                    Some(fields) => known(fields).map(|(_, shape)| shape),
                    None => Some(Shape::Number),
                };
                if let Some((_, value)) = replaced.into_iter().find(|(name, _)| *name == member) {
                    Some(value)
                } else if let Some(shape) = of_type {
                    Some(self.symbolic(&shape, format!("{path}.{member}"), &role))
                } else {
                    let known = fields.iter().flat_map(|fields| fields.iter());
                    let known = known.map(|(name, _)| name.as_str());
                    if let Some(known) = nearest(&member, known) {
                        hint = format!("did you mean `{known}`?");
                    }
                    None
                }
            }
            Value::Struct { fields, .. } => fields
                .into_iter()
                .find(|(name, _)| *name == member)
                .map(|(_, value)| value),
            Value::Tuple(mut values) => member
                .parse()
                .ok()
                .filter(|position| *position < values.len())
                .map(|position| values.swap_remove(position)),
            _ => None,
        };
        if found.is_none() {
            self.diagnostics.error_with_hint(
                field.span(),
                format!("{description} has no field `{member}`"),
                hint,
            );
        }
        found.inspect(|value| self.note(value))
    }

    pub(super) fn struct_literal(
        &mut self,
        literal: &syn::ExprStruct,
        scope: &mut Scope,
    ) -> Option<Value> {
        let values = self.all(literal.fields.iter().map(|field| &field.expr), scope);
        let base = match &literal.rest {
            Some(rest) => Some(self.base(rest, scope)?),
            None => None,
        };
        let complete = self.check_fields(literal);
        let mut fields = Vec::new();
        for (field, value) in literal.fields.iter().zip(values?) {
            let syn::Member::Named(name) = &field.member else {
                return self.unsupported(
                    field.member.span(),
                    "a field without a name",
                    "use a tuple",
                );
            };
            if let Value::Number(id) = value {
                self.graph.suggest_name(id, &name.to_string());
            }
            fields.push((name.to_string(), value));
        }
        complete?;
        let name = literal.path.to_token_stream().to_string();
        // What the literal says goes before what is taken over.
        let taken_over = |fields: &mut Vec<(String, Value)>, others: Vec<(String, Value)>| {
            for (name, value) in others {
                if !fields.iter().any(|(known, _)| *known == name) {
                    fields.push((name, value));
                }
            }
        };
        match base {
            Some(Value::Parameter {
                path,
                of,
                role,
                fields: known,
                replaced,
            }) => {
                taken_over(&mut fields, replaced);
                return Some(Value::Parameter {
                    path,
                    of,
                    role,
                    fields: known,
                    replaced: fields,
                });
            }
            Some(Value::Struct { fields: others, .. }) => taken_over(&mut fields, others),
            _ => {}
        }
        Some(Value::Struct { name, fields })
    }

    /// The struct that a literal takes its other fields from.
    fn base(&mut self, rest: &syn::Expr, scope: &mut Scope) -> Option<Value> {
        match self.expression(rest, scope)? {
            value @ (Value::Struct { .. } | Value::Parameter { .. }) => Some(value),
            other => {
                self.diagnostics.error_with_hint(
                    rest.span(),
                    format!("`..` needs a struct, this is {}", other.description()),
                    "name every field",
                );
                None
            }
        }
    }

    /// Reports fields that a struct of the module does not have, or that its literal leaves out.
    fn check_fields(&mut self, literal: &syn::ExprStruct) -> Option<()> {
        let Some((_, known)) = self.module.fields_at(&literal.path) else {
            return Some(());
        };
        let known: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
        let name = literal.path.to_token_stream().to_string();
        let mut complete = Some(());
        let mut given = Vec::new();
        for field in &literal.fields {
            let member = field.member.to_token_stream().to_string();
            if !known.contains(&member.as_str()) {
                let hint = match nearest(&member, known.iter().copied()) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => format!("its fields are {}", known.join(", ")),
                };
                self.diagnostics.error_with_hint(
                    field.member.span(),
                    format!("`{name}` has no field `{member}`"),
                    hint,
                );
                complete = None;
            }
            given.push(member);
        }
        let is_given = |field: &str| given.iter().any(|given| given == field);
        let missing: Vec<&str> = known.into_iter().filter(|field| !is_given(field)).collect();
        // A misspelt field is not also a missing one.
        if complete.is_some() && literal.rest.is_none() && !missing.is_empty() {
            self.diagnostics.error_with_hint(
                literal.path.span(),
                format!("`{name}` is not complete"),
                format!("give it {} too", missing.join(", ")),
            );
            return None;
        }
        complete
    }
}
