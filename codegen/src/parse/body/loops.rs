//! Loops over what is known when a formula is read: they are followed turn by turn, so that what comes out has none.

use syn::spanned::Spanned;
use syn::{Expr, ExprForLoop, ExprRange, ExprRepeat, RangeLimits};

use super::scalars::Use;
use super::statements::MOST_STATEMENTS;
use super::{Reader, Scope};
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    /// `for x in … { … }`
    pub(super) fn for_loop(&mut self, turns: &ExprForLoop, scope: &mut Scope) -> Option<Value> {
        let values = self.values(&turns.expr, scope)?;
        let outermost = self.outermost_loop;
        self.outermost_loop = outermost.or(Some(turns.for_token.span));
        let mut complete = Some(());
        for value in values {
            complete = self.turn(turns, value, scope);
            // A mistake in one turn is one in all.
            if complete.is_none() {
                break;
            }
        }
        self.outermost_loop = outermost;
        complete.map(|()| Value::nothing())
    }

    fn turn(&mut self, turns: &ExprForLoop, value: Value, scope: &mut Scope) -> Option<()> {
        self.count_statement(turns.for_token.span)?;
        let mark = scope.enter();
        if self.bind(&turns.pat, Some(value), scope).is_none() {
            scope.leave(mark);
            return None;
        }
        let done = self.block(&turns.body, scope, false);
        scope.leave(mark);
        done.map(|_| ())
    }

    /// The values that a loop goes over.
    pub(super) fn values(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Vec<Value>> {
        if let Expr::Reference(reference) = expression
            && reference.mutability.is_some()
        {
            let hint = "go over the places: `for i in 0..N { a[i] = …; }`";
            return self.unsupported(expression.span(), "a loop over what it changes", hint);
        }
        match self.expression(expression, scope)? {
            Value::Array(values) | Value::Iterator(values) => Some(values),
            other => {
                let message = format!(
                    "a loop goes over several values, this is {}",
                    other.description()
                );
                let hint = "loops are over ranges `0..N` of whole numbers and over arrays";
                self.diagnostics
                    .error_with_hint(expression.span(), message, hint);
                None
            }
        }
    }

    /// `a..b` and `a..=b` of whole numbers.
    pub(super) fn range(&mut self, range: &ExprRange, scope: &mut Scope) -> Option<Value> {
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            let hint = "write both bounds: `0..N`";
            return self.unsupported(range.span(), "an open range", hint);
        };
        let start = self.whole(start, Use::Bound, scope);
        let end = self.whole(end, Use::Bound, scope);
        let (start, mut end) = (start?, end?);
        if matches!(range.limits, RangeLimits::Closed(_)) {
            end += 1;
        }
        let length = usize::try_from(end - start).unwrap_or(0);
        if length > MOST_STATEMENTS {
            let what = format!("a range of {length} numbers");
            let hint = format!(
                "a formula has at most {MOST_STATEMENTS} statements, those of loops as often as they are passed"
            );
            return self.unsupported(range.span(), &what, &hint);
        }
        Some(Value::Iterator((start..end).map(Value::Whole).collect()))
    }

    /// `[x; N]`
    pub(super) fn repeated(&mut self, repeat: &ExprRepeat, scope: &mut Scope) -> Option<Value> {
        let element = self.expression(&repeat.expr, scope);
        let length = self.whole(&repeat.len, Use::Count, scope);
        let (element, length) = (element?, usize::try_from(length?).unwrap_or(0));
        let numbers = element.numbers().len().max(1).saturating_mul(length);
        if numbers > MOST_STATEMENTS {
            let what = format!("an array of {numbers} numbers");
            let hint = format!("arrays of a formula have at most {MOST_STATEMENTS} numbers");
            return self.unsupported(repeat.span(), &what, &hint);
        }
        Some(Value::Array(vec![element; length]))
    }
}
