//! Choices: conditions, `if` and `match`, of which both values are followed and one is selected.

use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, ExprIf, ExprMatch, Lit, Pat};

use super::branches::{Branch, Clause};
use super::patterns::unread;
use super::{Reader, Scope};
use crate::graph::{ExprId, Function};
use crate::parse::condition::Condition;
use crate::parse::value::Value;
use crate::parse::whole;

/// What a condition must not hold.
const CHANGED: &str = "an assignment in a condition";

/// Whether the operator makes a condition of what is beside it.
pub(super) fn is_logical(operator: &BinOp) -> bool {
    matches!(operator, BinOp::And(_) | BinOp::Or(_)) || is_comparison(operator)
}

fn is_comparison(operator: &BinOp) -> bool {
    matches!(
        operator,
        BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Eq(_) | BinOp::Ne(_)
    )
}

/// The comparison of an operator, as Rust has it where a number is NaN.
fn comparison(operator: &BinOp, [a, b]: [ExprId; 2]) -> Condition {
    match operator {
        BinOp::Lt(_) => Condition::Comparison(Function::Less, [a, b]),
        BinOp::Le(_) => Condition::Comparison(Function::AtMost, [a, b]),
        BinOp::Gt(_) => Condition::Comparison(Function::Less, [b, a]),
        BinOp::Ge(_) => Condition::Comparison(Function::AtMost, [b, a]),
        BinOp::Ne(_) => Condition::Comparison(Function::Select, [a, b]).negated(),
        _ => Condition::Comparison(Function::Select, [a, b]),
    }
}

impl<'m> Reader<'m> {
    /// A comparison of two numbers, or two conditions joined, from the value of the first.
    pub(super) fn logical(
        &mut self,
        binary: &ExprBinary,
        left: Option<Value>,
        scope: &mut Scope,
    ) -> Option<Value> {
        if is_comparison(&binary.op) {
            if let Some(Value::Whole(left)) = left {
                return self.whole_comparison(binary, left, scope);
            }
            let left = left.and_then(|value| self.number_of(value, &binary.left));
            let right = self.number(&binary.right, scope);
            return Some(Value::Truth(comparison(&binary.op, [left?, right?])));
        }
        let left = left.and_then(|value| self.condition_of(value, &binary.left));
        let is_all = matches!(binary.op, BinOp::And(_));
        if left == Some(Condition::Known(!is_all)) {
            return left.map(Value::Truth);
        }
        let right = self.unchanging(&binary.right, CHANGED, scope, |reader, scope| {
            reader.condition(&binary.right, scope)
        });
        let (left, right) = (left?, right?);
        Some(Value::Truth(if is_all {
            left.and(right)
        } else {
            left.or(right)
        }))
    }

    /// A comparison of whole numbers, which is known.
    fn whole_comparison(
        &mut self,
        binary: &ExprBinary,
        left: i64,
        scope: &mut Scope,
    ) -> Option<Value> {
        let right = match self.expression(&binary.right, scope)? {
            Value::Whole(right) => right,
            Value::Number(_) => {
                // That the left one has to be a number is said at it.
                return self
                    .number_of(Value::Whole(left), &binary.left)
                    .map(Value::Number);
            }
            other => {
                let message = format!(
                    "a whole number is needed here, this is {}",
                    other.description()
                );
                let hint = other.way_to_a_number();
                self.diagnostics
                    .error_with_hint(binary.right.span(), message, hint);
                return None;
            }
        };
        let holds = match binary.op {
            BinOp::Lt(_) => left < right,
            BinOp::Le(_) => left <= right,
            BinOp::Gt(_) => left > right,
            BinOp::Ge(_) => left >= right,
            BinOp::Ne(_) => left != right,
            _ => left == right,
        };
        Some(Value::Truth(Condition::Known(holds)))
    }

    /// `!a`
    pub(super) fn negation(&mut self, value: Value, operand: &Expr) -> Option<Value> {
        let condition = self.condition_of(value, operand)?;
        Some(Value::Truth(condition.negated()))
    }

    /// Evaluates an expression that must be a condition.
    fn condition(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Condition> {
        let value = self.expression(expression, scope)?;
        self.condition_of(value, expression)
    }

    /// The condition that the value of an expression must be.
    fn condition_of(&mut self, value: Value, expression: &Expr) -> Option<Condition> {
        match value {
            Value::Truth(condition) => Some(condition),
            other => {
                let message = format!(
                    "a condition is needed here, this is {}",
                    other.description()
                );
                let hint = "compare numbers: `x > 0.0`, and join comparisons by `&&`, `||` and `!`";
                self.diagnostics
                    .error_with_hint(expression.span(), message, hint);
                None
            }
        }
    }

    /// Evaluates what is not always evaluated, or not known how often, so that it must change no variable.
    pub(super) fn unchanging<T>(
        &mut self,
        at: &impl Spanned,
        what: &str,
        scope: &mut Scope,
        work: impl FnOnce(&mut Self, &mut Scope) -> Option<T>,
    ) -> Option<T> {
        scope.begin_branch();
        let result = work(self, scope);
        if scope.end_branch().is_empty() {
            return result;
        }
        let hint = "assign in statements of their own: of a `for`, or of the branches of an `if`";
        self.unsupported(at.span(), what, hint)
    }

    /// `if a { x } else if b { y } else { z }`: the clauses in a list, so that a chain of them may be of any length. What is
    /// known not to be taken is not looked at.
    pub(super) fn choice(&mut self, choice: &ExprIf, scope: &mut Scope) -> Option<Value> {
        let mut clauses = Vec::new();
        let mut clause = choice;
        let last = loop {
            let mark = scope.enter();
            let condition = self.condition_of_clause(&clause.cond, scope);
            let branch = (condition != Some(Condition::Known(false))).then(|| {
                Branch::follow(scope, |scope| self.block(&clause.then_branch, scope, false))
            });
            scope.leave(mark);
            match (condition, branch) {
                (Some(Condition::Known(true)), Some(branch)) => break branch,
                (condition, Some(branch)) => clauses.push((condition, branch)),
                (_, None) => {}
            }
            match &clause.else_branch {
                Some((_, otherwise)) => match otherwise.as_ref() {
                    Expr::If(next) => clause = next,
                    last => break Branch::follow(scope, |scope| self.expression(last, scope)),
                },
                None => break self.without_else(choice, &clauses),
            }
        };
        self.chosen(clauses, last, choice, scope)
    }

    fn condition_of_clause(&mut self, condition: &Expr, scope: &mut Scope) -> Option<Condition> {
        if let Expr::Let(binding) = condition {
            // Its names are known, so that their uses are not reported too.
            scope.extend(unread(&binding.pat));
            let hint = "compare numbers: `x > 0.0`";
            return self.unsupported(binding.span(), "a pattern as a condition", hint);
        }
        self.unchanging(condition, CHANGED, scope, |reader, scope| {
            reader.condition(condition, scope)
        })
    }

    /// What is left of an `if` without `else`: nothing, where its clauses are statements.
    fn without_else(&mut self, choice: &ExprIf, clauses: &[Clause]) -> Branch {
        let gives = |(_, branch): &Clause| {
            let mut value = branch.value.iter();
            value.any(|value| !value.is_nothing())
        };
        let value = if clauses.iter().any(gives) {
            let hint = "write what the value is otherwise: `if … { a } else { b }`";
            self.unsupported(choice.if_token.span, "an `if` without `else`", hint)
        } else {
            Some(Value::nothing())
        };
        Branch {
            value,
            ..Branch::default()
        }
    }

    /// `match` on conditions and whole numbers, or on what is told apart by `if` behind a name. The last arm is what is left:
    /// the compiler sees to it that the arms have all cases.
    pub(super) fn matched(&mut self, choice: &ExprMatch, scope: &mut Scope) -> Option<Value> {
        let subject = self.expression(&choice.expr, scope);
        let mut clauses = Vec::new();
        for arm in &choice.arms {
            let mark = scope.enter();
            let condition = match &subject {
                Some(subject) => self.unchanging(&arm.pat, CHANGED, scope, |reader, scope| {
                    reader.pattern(&arm.pat, subject, scope)
                }),
                None => None,
            };
            let branch = match condition {
                Some(Condition::Known(false)) => None,
                Some(_) => Some(Branch::follow(scope, |scope| {
                    self.expression(&arm.body, scope)
                })),
                None => Some(Branch::default()),
            };
            scope.leave(mark);
            if let Some(branch) = branch {
                let is_sure = condition == Some(Condition::Known(true));
                clauses.push((condition, branch));
                if is_sure {
                    break;
                }
            }
        }
        let Some((condition, last)) = clauses.pop() else {
            return self.unsupported(choice.span(), "a `match` without arms", "give it arms");
        };
        condition?;
        self.chosen(clauses, last, choice, scope)
    }

    /// When a value is that of a pattern, whose names are bound.
    fn pattern(&mut self, pattern: &Pat, value: &Value, scope: &mut Scope) -> Option<Condition> {
        match (pattern, value) {
            (Pat::Wild(_), _) => Some(Condition::Known(true)),
            (Pat::Paren(inner), _) => self.pattern(&inner.pat, value, scope),
            (Pat::Ident(name), _) if name.by_ref.is_none() && name.subpat.is_none() => {
                scope.bind(name.ident.to_string(), Some(value.clone()));
                Some(Condition::Known(true))
            }
            (Pat::Guard(guarded), _) => {
                let outer = self.pattern(&guarded.pat, value, scope)?;
                if outer == Condition::Known(false) {
                    return Some(outer);
                }
                let guard = self.condition(&guarded.guard, scope)?;
                Some(outer.and(guard))
            }
            (Pat::Lit(literal), Value::Whole(value)) => match &literal.lit {
                Lit::Int(literal) => {
                    let known = whole::of_literal(literal);
                    Some(Condition::Known(known == Some(*value)))
                }
                other => self.unsupported(
                    other.span(),
                    "this pattern",
                    "match whole numbers by whole numbers",
                ),
            },
            (Pat::Or(any), _) => {
                let mut all = Vec::new();
                for pattern in &any.cases {
                    all.push(self.pattern(pattern, value, scope)?);
                }
                let any = all.into_iter().reduce(Condition::or);
                Some(any.unwrap_or(Condition::Known(false)))
            }
            (Pat::Lit(literal), Value::Truth(condition)) => match &literal.lit {
                Lit::Bool(truth) if truth.value => Some(condition.clone()),
                _ => Some(condition.clone().negated()),
            },
            (Pat::Tuple(tuple), Value::Tuple(parts)) if tuple.elems.len() == parts.len() => {
                let mut all = Vec::new();
                for (pattern, part) in tuple.elems.iter().zip(parts) {
                    all.push(self.pattern(pattern, part, scope)?);
                }
                let all = all.into_iter().reduce(Condition::and);
                Some(all.unwrap_or(Condition::Known(true)))
            }
            _ => {
                let hint = "match conditions by `true`, `false`, `_` and tuples of them, and numbers by a name and its `if`: `x if x < 0.0 => …`";
                self.unsupported(pattern.span(), "this pattern", hint)
            }
        }
    }
}
