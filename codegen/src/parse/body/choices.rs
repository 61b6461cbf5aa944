//! Choices: conditions, `if` and `match`, of which both values are followed and one is selected.

use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, ExprIf, ExprMatch, Lit, Pat};

use super::{Reader, Scope};
use crate::graph::{ExprId, Function};
use crate::parse::condition::Condition;
use crate::parse::module::bound_names;
use crate::parse::value::Value;

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
            let left = left.and_then(|value| self.number_of(value, &binary.left));
            let right = self.number(&binary.right, scope);
            return Some(Value::Truth(comparison(&binary.op, [left?, right?])));
        }
        let left = left.and_then(|value| self.condition_of(value, &binary.left));
        let right = self.condition(&binary.right, scope);
        let (left, right) = (left?, right?);
        Some(Value::Truth(match binary.op {
            BinOp::And(_) => left.and(right),
            _ => left.or(right),
        }))
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

    /// `if a { x } else if b { y } else { z }`: the clauses in a list, so that a chain of them may be of any length.
    pub(super) fn choice(&mut self, choice: &ExprIf, scope: &mut Scope) -> Option<Value> {
        let mut clauses = Vec::new();
        let mut clause = choice;
        let last = loop {
            let mut inner = scope.clone();
            let condition = match clause.cond.as_ref() {
                Expr::Let(binding) => {
                    // Its names are known, so that their uses are not reported too.
                    let names = bound_names(&binding.pat).into_iter();
                    inner.extend(names.map(|name| (name, None)));
                    let hint = "compare numbers: `x > 0.0`";
                    self.unsupported(binding.span(), "a pattern as a condition", hint)
                }
                condition => self.condition(condition, scope),
            };
            let value = self.block(&clause.then_branch, &mut inner, false);
            clauses.push((condition, value));
            match &clause.else_branch {
                Some((_, otherwise)) => match otherwise.as_ref() {
                    Expr::If(next) => clause = next,
                    last => break self.expression(last, scope),
                },
                None => {
                    let hint = "write what the value is otherwise: `if … { a } else { b }`";
                    break self.unsupported(clause.if_token.span, "an `if` without `else`", hint);
                }
            }
        };
        self.chosen(clauses, last, choice)
    }

    /// `match` on conditions, or on what is told apart by `if` behind a name. The last arm is what is left: the compiler sees
    /// to it that the arms have all cases.
    pub(super) fn matched(&mut self, choice: &ExprMatch, scope: &mut Scope) -> Option<Value> {
        let subject = self.expression(&choice.expr, scope);
        let mut clauses = Vec::new();
        for arm in &choice.arms {
            let mut inner = scope.clone();
            let condition = match &subject {
                Some(subject) => self.pattern(&arm.pat, subject, &mut inner),
                None => None,
            };
            let value = if condition.is_some() {
                self.expression(&arm.body, &mut inner)
            } else {
                None
            };
            clauses.push((condition, value));
        }
        let Some((condition, last)) = clauses.pop() else {
            return self.unsupported(choice.span(), "a `match` without arms", "give it arms");
        };
        condition?;
        self.chosen(clauses, last, choice)
    }

    /// When a value is that of a pattern, whose names are bound.
    fn pattern(&mut self, pattern: &Pat, value: &Value, scope: &mut Scope) -> Option<Condition> {
        match (pattern, value) {
            (Pat::Wild(_), _) => Some(Condition::Known(true)),
            (Pat::Paren(inner), _) => self.pattern(&inner.pat, value, scope),
            (Pat::Ident(name), _) if name.by_ref.is_none() && name.subpat.is_none() => {
                scope.insert(name.ident.to_string(), Some(value.clone()));
                Some(Condition::Known(true))
            }
            (Pat::Guard(guarded), _) => {
                let outer = self.pattern(&guarded.pat, value, scope)?;
                let guard = self.condition(&guarded.guard, scope)?;
                Some(match outer {
                    Condition::Known(true) => guard,
                    outer => outer.and(guard),
                })
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
                all.retain(|condition| *condition != Condition::Known(true));
                Some(match all.len() {
                    0 => Condition::Known(true),
                    _ => Condition::All(all),
                })
            }
            _ => {
                let hint = "match conditions by `true`, `false`, `_` and tuples of them, and numbers by a name and its `if`: `x if x < 0.0 => …`";
                self.unsupported(pattern.span(), "this pattern", hint)
            }
        }
    }

    /// The value of the first clause whose condition holds, else the last value.
    fn chosen(
        &mut self,
        clauses: Vec<(Option<Condition>, Option<Value>)>,
        last: Option<Value>,
        at: &impl Spanned,
    ) -> Option<Value> {
        let clauses: Option<Vec<_>> = clauses
            .into_iter()
            .map(|(condition, value)| condition.zip(value))
            .collect();
        let (clauses, mut value) = (clauses?, last?);
        for (condition, first) in clauses.into_iter().rev() {
            value = self.select(&condition, first, value, at)?;
        }
        Some(value)
    }

    /// One of two values of the same shape, number by number.
    fn select(
        &mut self,
        condition: &Condition,
        first: Value,
        second: Value,
        at: &impl Spanned,
    ) -> Option<Value> {
        if let (Value::Truth(first), Value::Truth(second)) = (&first, &second) {
            let (holds, fails) = (condition.clone(), condition.clone().negated());
            let either = holds.and(first.clone()).or(fails.and(second.clone()));
            return Some(Value::Truth(either));
        }
        let (numbers, others) = (first.numbers(), second.numbers());
        let other = |place: &String| others.iter().find(|(other, _)| other == place);
        let pairs: Option<Vec<(ExprId, ExprId)>> = numbers
            .iter()
            .map(|(place, id)| Some((*id, other(place)?.1)))
            .collect();
        let pairs = pairs.filter(|pairs| {
            let are_whole = [&first, &second].map(|value| value.whole_parameter().is_none());
            pairs.len() == others.len() && !pairs.is_empty() && are_whole == [true; 2]
        });
        let Some(pairs) = pairs else {
            return self.unsupported(
                at.span(),
                "a choice between these values",
                "choose between numbers, or between tuples, arrays and struct literals of numbers",
            );
        };
        let chosen = pairs.into_iter();
        let chosen: Vec<ExprId> = chosen
            .map(|(first, second)| condition.select(&mut self.graph, first, second))
            .collect();
        Some(first.with_numbers(&mut chosen.into_iter()))
    }
}
