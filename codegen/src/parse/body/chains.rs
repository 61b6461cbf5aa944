//! Operators and methods: what begins with another expression, followed without recursion, so that a sum of 20,000 terms takes
//! no more of the stack than one of two.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, Lit, UnOp};

use super::assignments::assigns;
use super::choices::is_logical;
use super::methods::Called;
use super::{Reader, Scope};
use crate::graph::{ExprId, Rational, whole};
use crate::parse::value::Value;

/// The expression that another one begins with.
fn beginning(expression: &Expr) -> Option<&Expr> {
    Some(match expression {
        Expr::Paren(inner) => &inner.expr,
        Expr::Group(inner) => &inner.expr,
        Expr::Reference(inner) => &inner.expr,
        Expr::Unary(unary) => &unary.expr,
        Expr::Binary(binary) if !assigns(&binary.op) => &binary.left,
        Expr::MethodCall(call) => &call.receiver,
        _ => return None,
    })
}

/// Whether the expression adds or subtracts.
fn as_sum(expression: &Expr) -> Option<&ExprBinary> {
    match expression {
        Expr::Binary(binary) if matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)) => Some(binary),
        _ => None,
    }
}

/// The terms of a sum with their signs; None for those that could not be read.
type Terms = Vec<Option<(ExprId, Rational)>>;

impl<'m> Reader<'m> {
    /// The value of an expression.
    pub(super) fn chain(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        let mut links = Vec::new();
        let mut first = expression;
        while let Some(inner) = beginning(first) {
            links.push(first);
            first = inner;
        }
        let mut value = self.first(first, scope);
        // The terms of a chain `a + b - c`; parentheses close a sum, for they say how its author wants it rounded.
        let mut terms = Terms::new();
        while let Some(link) = links.pop() {
            let of_whole = terms.is_empty() && matches!(value, Some(Value::Whole(_)));
            let Some(sum) = as_sum(link).filter(|_| !of_whole) else {
                value = self.link(link, value, scope);
                continue;
            };
            if terms.is_empty() {
                let first = value
                    .take()
                    .and_then(|value| self.number_of(value, &sum.left));
                terms.push(first.map(|id| (id, whole(1))));
            }
            let sign = if matches!(sum.op, BinOp::Sub(_)) {
                -1
            } else {
                1
            };
            let term = self.number(&sum.right, scope);
            terms.push(term.map(|id| (id, whole(sign))));
            if links.last().is_none_or(|next| as_sum(next).is_none()) {
                value = self.closed(std::mem::take(&mut terms));
            }
        }
        value
    }

    fn closed(&mut self, terms: Terms) -> Option<Value> {
        let terms: Option<Vec<_>> = terms.into_iter().collect();
        let sum = self.graph.sum(terms?);
        self.graph.note_author(sum);
        Some(Value::Number(sum))
    }

    /// The value of an expression that is no sum, from the value of the one that it begins with.
    fn link(&mut self, link: &Expr, value: Option<Value>, scope: &mut Scope) -> Option<Value> {
        match link {
            Expr::Binary(binary) if is_logical(&binary.op) => self.logical(binary, value, scope),
            Expr::Binary(binary) => match value {
                Some(Value::Whole(left)) => self.of_whole_numbers(binary, left, scope),
                value => {
                    let left = value.and_then(|value| self.number_of(value, &binary.left));
                    self.product(binary, left, scope)
                }
            },
            Expr::MethodCall(call) => match value {
                Some(value @ (Value::Array(_) | Value::Iterator(_))) => {
                    self.method_of_many(call, value, scope)
                }
                Some(value @ (Value::Parameter { .. } | Value::Struct { .. })) => {
                    self.method_of_struct(call, value, scope)
                }
                value => {
                    let receiver = value.and_then(|value| self.number_of(value, &call.receiver));
                    self.method(&Called::of(call), receiver, scope)
                }
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => match value? {
                Value::Whole(value) => Some(Value::Whole(-value)),
                value => {
                    let operand = self.number_of(value, &unary.expr)?;
                    Some(Value::Number(self.graph.negate(operand)))
                }
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => {
                self.negation(value?, &unary.expr)
            }
            // Parentheses, references and what is behind them.
            _ => value,
        }
    }

    /// A product, or what else an operator makes of a whole number and another one.
    fn of_whole_numbers(
        &mut self,
        binary: &ExprBinary,
        left: i64,
        scope: &mut Scope,
    ) -> Option<Value> {
        let right = self.expression(&binary.right, scope)?;
        if !matches!(right, Value::Whole(_)) && !matches!(binary.op, BinOp::Rem(_)) {
            // That the left one has to be a number is said at it.
            return self
                .number_of(Value::Whole(left), &binary.left)
                .map(Value::Number);
        }
        self.whole_operation(binary, left, right)
    }

    fn product(
        &mut self,
        binary: &ExprBinary,
        left: Option<ExprId>,
        scope: &mut Scope,
    ) -> Option<Value> {
        if !is_product(&binary.op) {
            return self.unsupported_operator(&binary.op);
        }
        let right = self.number(&binary.right, scope);
        self.check_divisor(&binary.op, &binary.right)?;
        self.multiplied(&binary.op, left?, right?, binary.span())
    }

    /// Refuses a division by the literal 0.
    pub(super) fn check_divisor(&mut self, operator: &BinOp, divisor: &Expr) -> Option<()> {
        if matches!(operator, BinOp::Div(_) | BinOp::DivAssign(_)) && is_zero(divisor) {
            let hint = "it is infinite or NaN whatever the inputs: write a divisor that is not 0";
            return self.unsupported(divisor.span(), "a division by 0", hint);
        }
        Some(())
    }

    /// The product or the quotient of two numbers.
    pub(super) fn multiplied(
        &mut self,
        operator: &BinOp,
        left: ExprId,
        right: ExprId,
        span: Span,
    ) -> Option<Value> {
        let exponent = match operator {
            BinOp::Mul(_) | BinOp::MulAssign(_) => 1,
            BinOp::Div(_) | BinOp::DivAssign(_) => -1,
            other => return self.unsupported_operator(other),
        };
        let result = self.graph.multiply_as_written(left, (right, exponent));
        self.representable(result, span)
    }

    fn unsupported_operator(&mut self, operator: &BinOp) -> Option<Value> {
        self.unsupported(
            operator.span(),
            "this operator",
            "the operators are + - * /, += -= *= /=, of comparisons < <= > >= == != and && ||, and % of whole numbers",
        )
    }
}

fn is_product(operator: &BinOp) -> bool {
    matches!(operator, BinOp::Mul(_) | BinOp::Div(_))
}

/// Whether an expression is the literal 0, in parentheses or not, with a sign or without one.
fn is_zero(expression: &Expr) -> bool {
    match expression {
        Expr::Unary(inner) if matches!(inner.op, UnOp::Neg(_)) => is_zero(&inner.expr),
        Expr::Paren(inner) => is_zero(&inner.expr),
        Expr::Group(inner) => is_zero(&inner.expr),
        Expr::Lit(literal) => match &literal.lit {
            Lit::Float(number) => number.base10_parse().is_ok_and(|value: f64| value == 0.0),
            _ => false,
        },
        _ => false,
    }
}
