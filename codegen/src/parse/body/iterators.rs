//! Arrays and what goes over them: `iter`, `map`, `zip`, `sum` and their like, followed element by element.

use syn::spanned::Spanned;
use syn::{Expr, ExprClosure, ExprMethodCall};

use super::scalars::Use;
use super::{Reader, Scope};
use crate::graph::{ExprId, whole};
use crate::parse::value::Value;
use crate::parse::whole::operation;

/// The methods that arrays and iterators have here, with the number of their arguments.
const METHODS: [(&str, usize); 16] = [
    ("iter", 0),
    ("into_iter", 0),
    ("copied", 0),
    ("cloned", 0),
    ("len", 0),
    ("rev", 0),
    ("enumerate", 0),
    ("zip", 1),
    ("chain", 1),
    ("skip", 1),
    ("take", 1),
    ("step_by", 1),
    ("map", 1),
    ("sum", 0),
    ("product", 0),
    ("fold", 2),
];

impl<'m> Reader<'m> {
    /// A method of an array or an iterator.
    pub(super) fn method_of_many(
        &mut self,
        call: &ExprMethodCall,
        receiver: Value,
        scope: &mut Scope,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let known = METHODS.iter().find(|(method, _)| *method == name);
        let Some((_, arity)) = known else {
            let names = METHODS.map(|(method, _)| method).join(", ");
            self.diagnostics.error_with_hint(
                call.method.span(),
                format!("{} has no method `{name}` here", receiver.description()),
                format!("the methods of arrays and what goes over them are {names}"),
            );
            return None;
        };
        if call.args.len() != *arity {
            let message = format!("`{name}` takes {arity} arguments, not {}", call.args.len());
            let hint = "write it as in Rust's standard library";
            self.diagnostics
                .error_with_hint(call.method.span(), message, hint);
            return None;
        }
        let is_array = matches!(receiver, Value::Array(_));
        let (Value::Array(values) | Value::Iterator(values)) = receiver else {
            return None;
        };
        match name.as_str() {
            "sum" => self.sum_of(values, call),
            "product" => self.product_of(values, call),
            "len" => Some(Value::Whole(i64::try_from(values.len()).ok()?)),
            "map" => {
                let mapped = self.mapped(values, &call.args[0], scope)?;
                Some(if is_array {
                    Value::Array(mapped)
                } else {
                    Value::Iterator(mapped)
                })
            }
            "fold" => {
                let first = self.expression(&call.args[0], scope)?;
                self.folded(values, first, &call.args[1], scope)
            }
            "zip" | "chain" => {
                let others = self.values(&call.args[0], scope)?;
                Some(Value::Iterator(joined(&name, values, others)))
            }
            "skip" | "take" | "step_by" => {
                let count = self.whole(&call.args[0], Use::Count, scope)?;
                self.some_of(&name, values, count, call)
            }
            _ => Some(Value::Iterator(in_turn(&name, values))),
        }
    }

    fn some_of(
        &mut self,
        method: &str,
        values: Vec<Value>,
        count: i64,
        call: &ExprMethodCall,
    ) -> Option<Value> {
        let least = i64::from(method == "step_by");
        let Some(count) = usize::try_from(count).ok().filter(|_| count >= least) else {
            let what = format!("`{method}` by {count}");
            let hint = format!("the count is {least} or more");
            return self.unsupported(call.args[0].span(), &what, &hint);
        };
        let values = values.into_iter();
        Some(Value::Iterator(match method {
            "skip" => values.skip(count).collect(),
            "take" => values.take(count).collect(),
            _ => values.step_by(count).collect(),
        }))
    }

    /// The sum from the first to the last.
    fn sum_of(&mut self, values: Vec<Value>, call: &ExprMethodCall) -> Option<Value> {
        let add = syn::BinOp::Add(syn::token::Plus::default());
        if let Some(sum) = self.of_whole(&values, 0, &add) {
            return Some(sum);
        }
        let numbers = self.numbers_of(values, call)?;
        let sum = self.graph.sum(numbers.into_iter().map(|id| (id, whole(1))));
        self.graph.note_author(sum);
        Some(Value::Number(sum))
    }

    /// The product from the first to the last.
    fn product_of(&mut self, values: Vec<Value>, call: &ExprMethodCall) -> Option<Value> {
        let multiply = syn::BinOp::Mul(syn::token::Star::default());
        if let Some(product) = self.of_whole(&values, 1, &multiply) {
            return Some(product);
        }
        let mut product = self.graph.one();
        for factor in self.numbers_of(values, call)? {
            let next = self.multiplied(&multiply, product, factor, call.span())?;
            if let Value::Number(id) = next {
                product = id;
            }
        }
        Some(Value::Number(product))
    }

    /// What an operator makes of whole numbers, if there are some and all are whole.
    fn of_whole(&self, values: &[Value], first: i64, operator: &syn::BinOp) -> Option<Value> {
        let all = values.iter().try_fold(first, |result, value| match value {
            Value::Whole(value) => operation(operator, result, *value),
            _ => None,
        });
        all.filter(|_| !values.is_empty()).map(Value::Whole)
    }

    fn numbers_of(&mut self, values: Vec<Value>, call: &ExprMethodCall) -> Option<Vec<ExprId>> {
        let mut numbers = Vec::new();
        for value in values {
            self.note(&value);
            numbers.push(match value {
                Value::Number(id) => id,
                other => {
                    let message = format!(
                        "`{}` is of numbers, and this goes over {}",
                        call.method,
                        match other {
                            Value::Whole(_) => "whole numbers too large to compute with",
                            ref other => other.description(),
                        }
                    );
                    let hint = "take the number of each first: `.map(|x| …)`";
                    self.diagnostics
                        .error_with_hint(call.method.span(), message, hint);
                    return None;
                }
            });
        }
        Some(numbers)
    }

    fn mapped(
        &mut self,
        values: Vec<Value>,
        closure: &Expr,
        scope: &mut Scope,
    ) -> Option<Vec<Value>> {
        let closure = self.closure(closure)?;
        let mut mapped = Vec::new();
        for value in values {
            mapped.push(self.called(closure, vec![value], scope)?);
        }
        Some(mapped)
    }

    fn folded(
        &mut self,
        values: Vec<Value>,
        first: Value,
        closure: &Expr,
        scope: &mut Scope,
    ) -> Option<Value> {
        let closure = self.closure(closure)?;
        let mut result = first;
        for value in values {
            result = self.called(closure, vec![result, value], scope)?;
        }
        Some(result)
    }

    fn closure<'e>(&mut self, expression: &'e Expr) -> Option<&'e ExprClosure> {
        match expression {
            Expr::Closure(closure) => Some(closure),
            Expr::Paren(inner) => self.closure(&inner.expr),
            other => self.unsupported(
                other.span(),
                "a function by its name here",
                "write a closure: `|x| …`",
            ),
        }
    }

    /// The value of a closure. It changes no variable: how often it is called is the iterator's affair.
    fn called(
        &mut self,
        closure: &ExprClosure,
        arguments: Vec<Value>,
        scope: &mut Scope,
    ) -> Option<Value> {
        self.count_statement(closure.span())?;
        let mark = scope.enter();
        let value = self.unchanging(closure, "a closure that assigns", scope, |reader, scope| {
            reader.bind_arguments(closure, arguments, scope)?;
            reader.expression(&closure.body, scope)
        });
        scope.leave(mark);
        value
    }
}

/// Two iterators made one.
fn joined(method: &str, values: Vec<Value>, others: Vec<Value>) -> Vec<Value> {
    let both = values.into_iter();
    match method {
        "zip" => both
            .zip(others)
            .map(|(a, b)| Value::Tuple(vec![a, b]))
            .collect(),
        _ => both.chain(others).collect(),
    }
}

/// All values in turn, as an iterator's method without arguments gives them.
fn in_turn(method: &str, values: Vec<Value>) -> Vec<Value> {
    let values = values.into_iter();
    match method {
        "rev" => values.rev().collect(),
        "enumerate" => (0..)
            .zip(values)
            .map(|(place, value)| Value::Tuple(vec![Value::Whole(place), value]))
            .collect(),
        _ => values.collect(),
    }
}
