//! Assignments: `x = …`, `a[i] += …` and their like. A graph has no variables; what changes is what a name stands for.

use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprAssign, ExprBinary};

use super::{Reader, Scope};
use crate::graph::whole;
use crate::parse::value::Value;
use crate::parse::whole::operation;

/// Whether the operator assigns, as `+=` does.
pub(super) fn assigns(operator: &BinOp) -> bool {
    matches!(
        operator,
        BinOp::AddAssign(_)
            | BinOp::SubAssign(_)
            | BinOp::MulAssign(_)
            | BinOp::DivAssign(_)
            | BinOp::RemAssign(_)
            | BinOp::BitXorAssign(_)
            | BinOp::BitAndAssign(_)
            | BinOp::BitOrAssign(_)
            | BinOp::ShlAssign(_)
            | BinOp::ShrAssign(_)
    )
}

impl<'m> Reader<'m> {
    /// `x = …`, also of several: `(a, b) = (b, a)`.
    pub(super) fn assignment(&mut self, assign: &ExprAssign, scope: &mut Scope) -> Option<Value> {
        let value = self.expression(&assign.right, scope);
        self.assign(&assign.left, value?, scope)?;
        Some(Value::nothing())
    }

    fn assign(&mut self, target: &Expr, value: Value, scope: &mut Scope) -> Option<()> {
        match (target, value) {
            (Expr::Infer(_), _) => Some(()),
            (Expr::Paren(inner), value) => self.assign(&inner.expr, value, scope),
            (
                Expr::Tuple(syn::ExprTuple { elems, .. })
                | Expr::Array(syn::ExprArray { elems, .. }),
                Value::Tuple(values) | Value::Array(values),
            ) if elems.len() == values.len() => {
                for (target, value) in elems.iter().zip(values) {
                    self.assign(target, value, scope)?;
                }
                Some(())
            }
            (target, value) => {
                let (variable, steps) = self.target(target, scope)?;
                if let Expr::Path(path) = target
                    && let Some(name) = path.path.get_ident()
                {
                    self.name(&value, &name.to_string());
                }
                let current = scope.assign(variable)?;
                if steps.is_empty() {
                    *current = Some(value);
                } else {
                    *self.part_to_change(current.as_mut()?, &steps)? = value;
                }
                Some(())
            }
        }
    }

    /// `x += …` and its like.
    pub(super) fn compound(&mut self, binary: &ExprBinary, scope: &mut Scope) -> Option<Value> {
        let right = self.expression(&binary.right, scope);
        let (variable, steps) = self.target(&binary.left, scope)?;
        let right = right?;
        let current = scope.assign(variable)?.as_mut()?;
        let current = self.part_to_change(current, &steps)?;
        if let (Value::Whole(left), Value::Whole(right)) = (&*current, &right)
            && let Some(result) = operation(&binary.op, *left, *right)
        {
            *current = Value::Whole(result);
            return Some(Value::nothing());
        }
        if !matches!(current, Value::Number(_) | Value::Sum(_)) {
            return self.no_compound(binary, current);
        }
        let right = self.number_of(right, &binary.right)?;
        let sign = match binary.op {
            BinOp::AddAssign(_) => 1,
            BinOp::SubAssign(_) => -1,
            _ => {
                self.close(current);
                let Value::Number(left) = *current else {
                    return None;
                };
                self.check_divisor(&binary.op, &binary.right)?;
                *current = self.multiplied(&binary.op, left, right, binary.span())?;
                if let Expr::Path(path) = binary.left.as_ref()
                    && let Some(name) = path.path.get_ident()
                {
                    self.name(current, &name.to_string());
                }
                return Some(Value::nothing());
            }
        };
        if let Value::Number(before) = *current {
            *current = Value::Sum(vec![(before, whole(1))]);
        }
        if let Value::Sum(terms) = current {
            terms.push((right, whole(sign)));
        }
        Some(Value::nothing())
    }

    /// Reports a compound assignment to what it does not suit.
    fn no_compound(&mut self, binary: &ExprBinary, current: &Value) -> Option<Value> {
        let message = format!(
            "this assignment changes a number, and this is {}",
            current.description()
        );
        let hint = match current {
            Value::Whole(_) => {
                "a whole number changes by another one: count with whole numbers, compute with `2.0` and `i as f64`"
            }
            other => other.way_to_a_number(),
        };
        self.diagnostics
            .error_with_hint(binary.left.span(), message, hint);
        None
    }
}
