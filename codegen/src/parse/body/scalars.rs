//! Numbers of a formula and whole numbers: literals, casts, and what an expression of either kind has to be.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, Lit, Type, UnOp};

use super::{Reader, Scope};
use crate::graph::{ExprId, decimal};
use crate::parse::condition::Condition;
use crate::parse::value::Value;
use crate::parse::whole;

/// The largest exponent of `powi`, in size: a larger power of what is not nearly 1 is no `f64`.
const LARGEST_POWER: i32 = 1000;

/// What a whole number is needed for.
#[derive(Clone, Copy)]
pub(super) enum Use {
    /// It is an index.
    Index,
    /// It is the exponent of `powi`.
    Exponent,
    /// It is a bound of a range.
    Bound,
    /// It counts elements.
    Count,
}

impl Use {
    fn name(self) -> &'static str {
        match self {
            Self::Index => "this index",
            Self::Exponent => "this exponent",
            Self::Bound => "this bound",
            Self::Count => "this count",
        }
    }
}

/// The literal that is all of an expression, and whether it has an odd number of minus signs.
fn bare_literal(expression: &Expr) -> Option<(&Lit, bool)> {
    let (mut inner, mut negative) = (expression, false);
    loop {
        inner = match inner {
            Expr::Paren(paren) => &paren.expr,
            Expr::Group(group) => &group.expr,
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                negative = !negative;
                &unary.expr
            }
            Expr::Lit(literal) => return Some((&literal.lit, negative)),
            _ => return None,
        };
    }
}

impl<'m> Reader<'m> {
    /// Evaluates an expression that must be one number.
    pub(super) fn number(&mut self, expression: &Expr, scope: &mut Scope) -> Option<ExprId> {
        let value = self.expression(expression, scope)?;
        self.number_of(value, expression)
    }

    /// The one number that the value of an expression must be.
    pub(super) fn number_of(&mut self, value: Value, expression: &Expr) -> Option<ExprId> {
        if let Value::Whole(_) = value
            && let Some((Lit::Int(literal), negative)) = bare_literal(expression)
        {
            let sign = if negative { "-" } else { "" };
            let hint = format!("write `{sign}{}.0`", literal.base10_digits());
            return self.unsupported(expression.span(), "a whole number literal", &hint);
        }
        match value {
            Value::Number(id) => Some(id),
            other => {
                let message = format!("a number is needed here, this is {}", other.description());
                let hint = other.way_to_a_number();
                self.diagnostics
                    .error_with_hint(expression.span(), message, hint);
                None
            }
        }
    }

    /// Evaluates an expression that must be a whole number.
    pub(super) fn whole(
        &mut self,
        expression: &Expr,
        needed: Use,
        scope: &mut Scope,
    ) -> Option<i64> {
        match self.expression(expression, scope)? {
            Value::Whole(value) => Some(value),
            other => {
                let message = format!(
                    "{} has to be a whole number, this is {}",
                    needed.name(),
                    other.description()
                );
                let hint = "whole numbers are literals, constants such as `const N: usize = 3;`, the variables of loops, and what + - * / % make of them";
                self.diagnostics
                    .error_with_hint(expression.span(), message, hint);
                None
            }
        }
    }

    pub(super) fn literal(&mut self, literal: &Lit) -> Option<Value> {
        let value = match literal {
            Lit::Float(value) if matches!(value.suffix(), "" | "f64") => {
                decimal(value.base10_digits())
            }
            Lit::Int(value) if value.suffix() == "f64" => decimal(value.base10_digits()),
            Lit::Int(value) if value.suffix() != "f32" => {
                let Some(whole) = whole::of_literal(value) else {
                    return self.too_large(literal.span());
                };
                return Some(Value::Whole(whole));
            }
            Lit::Bool(truth) => return Some(Value::Truth(Condition::Known(truth.value))),
            _ => return self.unsupported(literal.span(), "this literal", "numbers are f64"),
        };
        match value {
            Some(value) => Some(Value::Number(self.graph.number(value))),
            None => self.unsupported(
                literal.span(),
                "a number of this size",
                "an f64 holds up to 1.8e308",
            ),
        }
    }

    fn too_large<T>(&mut self, span: Span) -> Option<T> {
        let hint = format!(
            "whole numbers of a formula go up to {}: compute with f64",
            whole::LARGEST
        );
        self.unsupported(span, "a whole number of this size", &hint)
    }

    /// `2 as f64`, `i as f64`: the number that a whole number is; what is an `f64` stays as it is. `i as i32`: a whole number
    /// that the type holds.
    pub(super) fn cast(&mut self, cast: &syn::ExprCast, scope: &mut Scope) -> Option<Value> {
        let hint = "all numbers of a formula are f64: write `2.0`, or `2 as f64`";
        let ty = match cast.ty.as_ref() {
            Type::Path(path) => path.path.get_ident().map(ToString::to_string),
            _ => None,
        };
        let ty = ty.unwrap_or_default();
        if ty == "f64" {
            return self.cast_to_number(&cast.expr, scope);
        }
        let Some((least, largest)) = whole::range_of(&ty) else {
            return self.unsupported(cast.ty.span(), "a cast to another type", hint);
        };
        match self.expression(&cast.expr, scope)? {
            Value::Whole(value) if (least..=largest).contains(&value) => Some(Value::Whole(value)),
            Value::Whole(value) => {
                let what = format!("the whole number {value} as `{ty}`");
                self.unsupported(cast.span(), &what, "it would be another number")
            }
            _ => self.unsupported(cast.ty.span(), "a cast to another type", hint),
        }
    }

    fn cast_to_number(&mut self, inner: &Expr, scope: &mut Scope) -> Option<Value> {
        // Literals may be of any size.
        if let Some((Lit::Int(literal), negative)) = bare_literal(inner)
            && let Some(number) = whole::as_number(literal)
        {
            let number = self.graph.number(if negative { -number } else { number });
            return Some(Value::Number(number));
        }
        match self.expression(inner, scope)? {
            Value::Whole(value) => Some(Value::Number(self.graph.integer(value))),
            other => self.number_of(other, inner).map(Value::Number),
        }
    }

    /// `f64::from(i)`
    pub(super) fn number_from(&mut self, call: &syn::ExprCall, scope: &mut Scope) -> Option<Value> {
        match call.args.first() {
            Some(argument) if call.args.len() == 1 => self.cast_to_number(argument, scope),
            _ => self.unsupported(call.span(), "this conversion", "write `f64::from(i)`"),
        }
    }

    /// `a + b`, `a % b` and the like of whole numbers.
    pub(super) fn whole_operation(
        &mut self,
        binary: &ExprBinary,
        left: i64,
        right: Value,
    ) -> Option<Value> {
        let Value::Whole(right) = right else {
            let message = format!(
                "a whole number and {} do not go together",
                right.description()
            );
            let hint = "make a number of the whole one: `2.0`, or `i as f64`";
            self.diagnostics
                .error_with_hint(binary.op.span(), message, hint);
            return None;
        };
        if let Some(value) = whole::operation(&binary.op, left, right) {
            return Some(Value::Whole(value));
        }
        let divides = matches!(
            binary.op,
            BinOp::Div(_) | BinOp::Rem(_) | BinOp::DivAssign(_) | BinOp::RemAssign(_)
        );
        if divides && right == 0 {
            return self.unsupported(
                binary.op.span(),
                "a whole number divided by 0",
                "choose by `if` where the divisor may be 0",
            );
        }
        if whole::is_operator(&binary.op) {
            return self.too_large(binary.span());
        }
        let hint = "the operators of whole numbers are + - * / % and comparisons";
        self.unsupported(binary.op.span(), "this operator", hint)
    }

    /// The exponent of `powi`.
    pub(super) fn exponent(&mut self, argument: &Expr, scope: &mut Scope) -> Option<i32> {
        let value = self.whole(argument, Use::Exponent, scope)?;
        let exponent = i32::try_from(value).ok();
        if let Some(exponent) = exponent.filter(|it| it.abs() <= LARGEST_POWER) {
            return Some(exponent);
        }
        let hint = format!("powi takes a whole number of at most {LARGEST_POWER}");
        self.unsupported(argument.span(), "this exponent", &hint)
    }
}
