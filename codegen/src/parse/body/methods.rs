//! Methods of numbers, `x.sin()` and `f64::sin(x)`: powers, roots and the elementary functions.

use proc_macro2::Span;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Expr, Ident, Token};

use super::{Reader, Scope};
use crate::graph::{ExprId, Function as Elementary, NamedConstant, Node, Operands, ratio, whole};
use crate::interpret::node_value;
use crate::parse::known_methods;
use crate::parse::value::Value;

/// A method that is called, but for what it is called on.
pub(super) struct Called<'e> {
    pub name: &'e Ident,
    pub arguments: Vec<&'e Expr>,
    pub span: Span,
}

impl<'e> Called<'e> {
    pub(super) fn of(call: &'e syn::ExprMethodCall) -> Self {
        Self {
            name: &call.method,
            arguments: call.args.iter().collect(),
            span: call.span(),
        }
    }
}

impl<'m> Reader<'m> {
    /// `f64::sin(x)`: the first argument is what the method is of.
    pub(super) fn method_as_function(
        &mut self,
        name: &Ident,
        arguments: &Punctuated<Expr, Token![,]>,
        span: Span,
        scope: &mut Scope,
    ) -> Option<Value> {
        let mut arguments = arguments.iter();
        let Some(receiver) = arguments.next() else {
            let hint = format!("write `f64::{name}(x)` or `x.{name}()`");
            self.diagnostics
                .error_with_hint(span, format!("`f64::{name}` takes a number"), hint);
            return None;
        };
        let receiver = self.number(receiver, scope);
        let called = Called {
            name,
            arguments: arguments.collect(),
            span,
        };
        self.method(&called, receiver, scope)
    }

    pub(super) fn method(
        &mut self,
        call: &Called<'_>,
        receiver: Option<ExprId>,
        scope: &mut Scope,
    ) -> Option<Value> {
        let name = call.name.to_string();
        let known = known_methods::all().find(|(method, _)| *method == name);
        let Some((_, arity)) = known else {
            let is_closure = |argument: &&Expr| matches!(argument, Expr::Closure(_));
            let arguments = call.arguments.iter().copied();
            self.all(arguments.filter(|argument| !is_closure(argument)), scope);
            // What is no number may well have other methods.
            receiver?;
            self.diagnostics.error_with_hint(
                call.name.span(),
                format!("unknown method `{name}`"),
                known_methods::hint(&name),
            );
            return None;
        };
        if call.arguments.len() != arity {
            if name != "powi" {
                self.all(call.arguments.iter().copied(), scope);
            }
            self.diagnostics.error_with_hint(
                call.name.span(),
                format!(
                    "`{name}` takes {arity} argument{}, not {}",
                    if arity == 1 { "" } else { "s" },
                    call.arguments.len()
                ),
                format!("write `x.{name}({})`", ["", "y", "y, z"][arity]),
            );
            return None;
        }
        if name == "powi" {
            let exponent = self.exponent(call.arguments[0], scope);
            let power = self.graph.power(receiver?, exponent?);
            return self.representable(power, call.span);
        }
        let arguments: Vec<Option<ExprId>> = call
            .arguments
            .iter()
            .map(|argument| self.number(argument, scope))
            .collect();
        let arguments: Vec<ExprId> = arguments.into_iter().collect::<Option<_>>()?;
        match known_methods::function(&name) {
            Some(function) => {
                let operands: Operands = receiver.into_iter().chain(arguments).collect();
                receiver?;
                Some(Value::Number(self.graph.apply(function, operands)))
            }
            None => self.composed(&name, receiver?, &arguments, call.span),
        }
    }

    /// A method that stands for several operations, each as the standard library does it.
    fn composed(
        &mut self,
        method: &str,
        x: ExprId,
        arguments: &[ExprId],
        span: Span,
    ) -> Option<Value> {
        let graph = &mut self.graph;
        let result = match (method, arguments) {
            ("sin_cos", _) => {
                let both = [Elementary::Sin, Elementary::Cos];
                let both = both.map(|function| Value::Number(graph.apply(function, vec![x])));
                return Some(Value::Tuple(both.to_vec()));
            }
            ("fract", _) => {
                let whole = graph.apply(Elementary::Trunc, vec![x]);
                graph.subtract(x, whole)
            }
            ("to_radians", _) => {
                let pi = graph.constant(NamedConstant::Pi);
                let scale = graph.scale(pi, ratio(1, 180));
                graph.multiply(x, scale)
            }
            ("to_degrees", _) => {
                let (pi, half_turn) = (graph.constant(NamedConstant::Pi), graph.number(whole(180)));
                let scale = graph.divide(half_turn, pi);
                graph.multiply(x, scale)
            }
            // As Rust has it where x is NaN; it is no panic here where the bounds are none.
            ("clamp", [lower, upper]) => {
                let raised = graph.apply(Elementary::Less, vec![x, *lower, *lower, x]);
                graph.apply(Elementary::Less, vec![*upper, raised, *upper, raised])
            }
            ("copysign", [other]) => {
                let size = graph.apply(Elementary::Abs, vec![x]);
                let sign = graph.apply(Elementary::SignBit, vec![*other]);
                graph.multiply(size, sign)
            }
            ("log", [base]) => {
                let [above, below] = [x, *base].map(|of| graph.apply(Elementary::Ln, vec![of]));
                graph.divide(above, below)
            }
            _ => graph.power(x, -1),
        };
        self.representable(result, span)
    }

    /// A product or power, unless it is one of constants that no `f64` holds: what is gathered from it would be another
    /// number than what its author computes.
    pub(super) fn representable(&mut self, id: ExprId, span: Span) -> Option<Value> {
        let value = self.constant(id);
        let Node::Product(factors) = self.graph.node(id) else {
            return Some(Value::Number(id));
        };
        // What is divided by 0, or multiplied with it, is what the author asks for.
        let is_ordinary =
            |(factor, _): &(ExprId, i32)| self.constants[factor.index()].is_none_or(f64::is_normal);
        if !factors.iter().all(is_ordinary) || value.is_none_or(f64::is_normal) {
            return Some(Value::Number(id));
        }
        self.unsupported(
            span,
            "a power or constant of this size",
            "an f64 holds from 2.2e-308 to 1.8e308",
        )
    }

    /// The value of an expression that depends on no input.
    fn constant(&mut self, id: ExprId) -> Option<f64> {
        while self.constants.len() <= id.index() {
            let next = self.graph.expression(self.constants.len())?;
            let known = &self.constants;
            let is_constant = !matches!(
                self.graph.node(next),
                Node::Symbol(_) | Node::Integral { .. }
            ) && self
                .graph
                .operands(next)
                .iter()
                .all(|operand| known[operand.index()].is_some());
            let value = |operand: ExprId| known[operand.index()].unwrap_or(f64::NAN);
            let value = is_constant.then(|| node_value(&self.graph, next, &[], &value));
            self.constants.push(value.flatten());
        }
        self.constants[id.index()]
    }
}
