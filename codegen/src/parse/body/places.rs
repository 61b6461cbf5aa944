//! Places: fields and elements of what variables hold, to be read and to be assigned to.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Expr, UnOp};

use super::scalars::Use;
use super::scope::Variable;
use super::{Reader, Scope};
use crate::parse::value::Value;

/// The way from a value to a part of it.
pub(super) enum Step<'e> {
    /// `.field`
    Field(&'e syn::ExprField),
    /// `[i]`, with i as far as it is one.
    Element(&'e syn::ExprIndex, usize),
}

/// What an expression is a part of, and the parts in the order from there.
fn parts(expression: &Expr) -> (&Expr, Vec<&Expr>) {
    let (mut root, mut parts) = (expression, Vec::new());
    loop {
        let inner = match root {
            Expr::Field(field) => &field.base,
            Expr::Index(index) => &index.expr,
            Expr::Paren(inner) => &inner.expr,
            Expr::Group(inner) => &inner.expr,
            Expr::Reference(inner) => &inner.expr,
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => &unary.expr,
            _ => break,
        };
        if matches!(root, Expr::Field(_) | Expr::Index(_)) {
            parts.push(root);
        }
        root = inner;
    }
    parts.reverse();
    (root, parts)
}

/// The place of a part among those of a value.
fn position(value: &Value, step: &Step<'_>) -> Option<usize> {
    match (value, step) {
        (Value::Array(values), Step::Element(_, place)) => {
            (*place < values.len()).then_some(*place)
        }
        (Value::Tuple(values), Step::Field(field)) => {
            let place = field.member.to_token_stream().to_string().parse().ok();
            place.filter(|place| *place < values.len())
        }
        (
            Value::Struct { fields, .. }
            | Value::Parameter {
                replaced: fields, ..
            },
            Step::Field(field),
        ) => {
            let member = field.member.to_token_stream().to_string();
            fields.iter().position(|(name, _)| *name == member)
        }
        _ => None,
    }
}

/// The part of a value at a place.
fn part(value: &mut Value, position: usize) -> Option<&mut Value> {
    match value {
        Value::Array(values) | Value::Tuple(values) => values.get_mut(position),
        Value::Struct { fields, .. }
        | Value::Parameter {
            replaced: fields, ..
        } => fields.get_mut(position).map(|(_, value)| value),
        _ => None,
    }
}

impl<'m> Reader<'m> {
    /// `c.field`, `a[i]`, and parts of these.
    pub(super) fn access(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        let (root, parts) = parts(expression);
        let variable = match root {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        let variable = variable.and_then(|name| scope.find(&name.to_string()));
        let value = match variable {
            Some(_) => None,
            None => Some(self.expression(root, scope)),
        };
        let steps = self.steps(&parts, scope);
        match (variable, value) {
            (Some(variable), _) => self.read_part(variable, &steps?, scope),
            (None, value) => {
                let mut value = value??;
                for step in &steps? {
                    value = self.part_of(value, step)?;
                }
                Some(value)
            }
        }
    }

    /// The steps to a part; indices are computed.
    fn steps<'e>(&mut self, parts: &[&'e Expr], scope: &mut Scope) -> Option<Vec<Step<'e>>> {
        let mut steps = Vec::new();
        for part in parts {
            steps.push(match part {
                Expr::Field(field) => Some(Step::Field(field)),
                Expr::Index(index) => {
                    let place = self.whole(&index.index, Use::Index, scope);
                    place.map(|place| {
                        Step::Element(index, usize::try_from(place).unwrap_or(usize::MAX))
                    })
                }
                _ => None,
            });
        }
        steps.into_iter().collect()
    }

    /// The value of a variable, under whose name a sum is known from here on.
    pub(super) fn variable(&mut self, variable: Variable, scope: &mut Scope) -> Option<Value> {
        let value = scope.value(variable)?;
        let is_sum = matches!(value, Value::Sum(_));
        self.close(value);
        let value = value.clone();
        if is_sum {
            self.name(&value, scope.label(variable));
        }
        Some(value)
    }

    fn read_part(
        &mut self,
        variable: Variable,
        steps: &[Step<'_>],
        scope: &mut Scope,
    ) -> Option<Value> {
        let mut value = scope.value(variable)?;
        let mut rest = steps;
        // As far as the value has the parts nothing needs to be copied.
        while let Some((step, others)) = rest.split_first()
            && let Some(place) = position(value, step)
        {
            value = part(value, place)?;
            rest = others;
        }
        self.close(value);
        let mut value = value.clone();
        for step in rest {
            value = self.part_of(value, step)?;
        }
        self.note(&value);
        Some(value)
    }

    fn part_of(&mut self, value: Value, step: &Step<'_>) -> Option<Value> {
        match step {
            Step::Field(field) => self.field_of(value, &field.member),
            Step::Element(index, place) => self.element_of(value, *place, index),
        }
    }

    fn element_of(&mut self, base: Value, place: usize, index: &syn::ExprIndex) -> Option<Value> {
        match base {
            Value::Array(values) => {
                let length = values.len();
                let element = values.into_iter().nth(place);
                if element.is_none() {
                    let hint = match length.checked_sub(1) {
                        Some(last) => format!("its last one is `[{last}]`"),
                        None => "it is empty".to_owned(),
                    };
                    self.diagnostics.error_with_hint(
                        index.index.span(),
                        format!("the array has {length} elements"),
                        hint,
                    );
                }
                element.inspect(|element| self.note(element))
            }
            other => {
                let message = format!("{} has no elements", other.description());
                self.diagnostics.error_with_hint(
                    index.expr.span(),
                    message,
                    other.way_to_a_number(),
                );
                None
            }
        }
    }

    /// The variable that an assignment is to, and the way to the part of it.
    pub(super) fn target<'e>(
        &mut self,
        expression: &'e Expr,
        scope: &mut Scope,
    ) -> Option<(Variable, Vec<Step<'e>>)> {
        let (root, parts) = parts(expression);
        let name = match root {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        let Some(variable) = name.and_then(|name| scope.find(&name.to_string())) else {
            let hint = "assign to a variable, `let mut x = …;`, or to a field or element of one";
            return self.unsupported(expression.span(), "an assignment to this", hint);
        };
        Some((variable, self.steps(&parts, scope)?))
    }

    /// A part of a value, to be assigned to.
    pub(super) fn part_to_change<'v>(
        &mut self,
        mut value: &'v mut Value,
        steps: &[Step<'_>],
    ) -> Option<&'v mut Value> {
        for step in steps {
            if position(value, step).is_none() {
                let before = self.part_of(value.clone(), step)?;
                if let (Value::Parameter { replaced, .. }, Step::Field(field)) = (&mut *value, step)
                {
                    replaced.push((field.member.to_token_stream().to_string(), before));
                }
            }
            let place = position(value, step)?;
            value = part(value, place)?;
        }
        Some(value)
    }

    /// Makes numbers of the sums in a value.
    pub(super) fn close(&mut self, value: &mut Value) {
        match value {
            Value::Sum(terms) => {
                let sum = self.graph.sum(std::mem::take(terms));
                self.graph.note_author(sum);
                *value = Value::Number(sum);
            }
            Value::Tuple(values) | Value::Array(values) | Value::Iterator(values) => {
                for value in values {
                    self.close(value);
                }
            }
            Value::Struct { fields, .. }
            | Value::Parameter {
                replaced: fields, ..
            } => {
                for (_, value) in fields {
                    self.close(value);
                }
            }
            Value::Number(_) | Value::Whole(_) | Value::Truth(_) => {}
        }
    }

    /// Suggests a name for a number.
    pub(super) fn name(&mut self, value: &Value, name: &str) {
        if let Value::Number(id) = value {
            self.graph.suggest_name(*id, name);
        }
    }
}
