//! Methods of numbers: powers, roots and the elementary functions.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Lit, UnOp};

use super::{Reader, Scope};
use crate::diagnostics::nearest;
use crate::graph::{ExprId, Function as Elementary, Node, Operands};
use crate::interpret::node_value;
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    pub(super) fn method(
        &mut self,
        call: &syn::ExprMethodCall,
        receiver: Option<ExprId>,
        scope: &mut Scope,
    ) -> Option<Value> {
        const METHODS: [(&str, usize); 13] = [
            ("powi", 1),
            ("sqrt", 0),
            ("sin", 0),
            ("cos", 0),
            ("tan", 0),
            ("exp", 0),
            ("ln", 0),
            ("abs", 0),
            ("signum", 0),
            ("recip", 0),
            ("mul_add", 2),
            ("min", 1),
            ("max", 1),
        ];
        let name = call.method.to_string();
        let Some((_, arity)) = METHODS.into_iter().find(|(method, _)| *method == name) else {
            self.all(call.args.iter(), scope);
            // What is no number may well have other methods.
            receiver?;
            return self.unknown_method(&call.method, &METHODS.map(|(method, _)| method));
        };
        if call.args.len() != arity {
            if name != "powi" {
                self.all(call.args.iter(), scope);
            }
            self.diagnostics.error_with_hint(
                call.method.span(),
                format!(
                    "`{name}` takes {arity} argument{}, not {}",
                    if arity == 1 { "" } else { "s" },
                    call.args.len()
                ),
                format!("write `x.{name}({})`", ["", "y", "y, z"][arity]),
            );
            return None;
        }
        if name == "powi" {
            let exponent = self.exponent(&call.args[0]);
            let power = self.graph.power(receiver?, exponent?);
            return self.representable(power, call.span());
        }
        let arguments: Vec<Option<ExprId>> = call
            .args
            .iter()
            .map(|argument| self.number(argument, scope))
            .collect();
        let arguments: Vec<ExprId> = arguments.into_iter().collect::<Option<_>>()?;
        let result = self.apply(&name, receiver?, &arguments);
        self.representable(result, call.span())
    }

    fn unknown_method(&mut self, method: &syn::Ident, known: &[&str]) -> Option<Value> {
        let name = method.to_string();
        let hint = match nearest(&name, known.iter().copied()) {
            _ if name == "powf" => {
                "a whole power is `powi(n)`, a root is `sqrt()`, any other is `(y * x.ln()).exp()`"
                    .to_owned()
            }
            Some(method) => format!("did you mean `{method}`?"),
            None => format!("the methods are {}", known.join(", ")),
        };
        self.diagnostics
            .error_with_hint(method.span(), format!("unknown method `{name}`"), hint);
        None
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

    fn apply(&mut self, method: &str, receiver: ExprId, arguments: &[ExprId]) -> ExprId {
        let function = match (method, arguments) {
            ("recip", _) => return self.graph.power(receiver, -1),
            ("mul_add", _) => Elementary::MulAdd,
            ("sqrt", _) => Elementary::Sqrt,
            ("sin", _) => Elementary::Sin,
            ("cos", _) => Elementary::Cos,
            ("tan", _) => Elementary::Tan,
            ("exp", _) => Elementary::Exp,
            ("ln", _) => Elementary::Ln,
            ("min", _) => Elementary::Min,
            ("max", _) => Elementary::Max,
            ("signum", _) => Elementary::Sign,
            _ => Elementary::Abs,
        };
        let operands: Operands = std::iter::once(receiver)
            .chain(arguments.iter().copied())
            .collect();
        self.graph.apply(function, operands)
    }

    fn exponent(&mut self, argument: &Expr) -> Option<i32> {
        let (negative, literal) = match argument {
            Expr::Unary(syn::ExprUnary {
                op: UnOp::Neg(_),
                expr,
                ..
            }) => (true, expr.as_ref()),
            other => (false, other),
        };
        if let Expr::Lit(syn::ExprLit {
            lit: Lit::Int(value),
            ..
        }) = literal
            && let Ok(value) = value.base10_parse::<i32>()
            && value <= 1000
        {
            return Some(if negative { -value } else { value });
        }
        self.unsupported(
            argument.span(),
            "this exponent",
            "powi takes a whole number literal of at most 1000",
        )
    }
}
