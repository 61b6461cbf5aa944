//! Calls of other formulas, of their partials and tables, and integrals.

use std::sync::Arc;

use std::collections::BTreeMap;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Pat};

use super::{Reader, Scope, identifier, partial_symbols};
use crate::diagnostics::{Diagnostics, alike, nearest};
use crate::graph::{ExprId, Role, SymbolId};
use crate::parse::module::{Function, ParameterKind};
use crate::parse::numbers;
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    pub(super) fn function_call(
        &mut self,
        call: &syn::ExprCall,
        scope: &mut Scope,
    ) -> Option<Value> {
        let Expr::Path(path) = call.func.as_ref() else {
            self.all(call.args.iter(), scope);
            return self.unsupported(
                call.func.span(),
                "this call",
                "call a formula of the module by its name",
            );
        };
        let segments: Vec<String> = path
            .path
            .segments
            .iter()
            .map(|segment| segment.ident.to_string())
            .collect();
        let span = path.path.span();
        if matches!(segments.as_slice(), [name] if name == "integral" && self.module.function(name).is_none())
        {
            return self.integral(call, scope);
        }
        let (name, partial) = match segments.as_slice() {
            [name] => (name, None),
            [name, partial] if name != "f64" => (name, Some(partial)),
            segments => {
                self.all(call.args.iter(), scope);
                if let [_, method] = segments {
                    let hint = format!("write `x.{method}(…)`");
                    return self.unsupported(span, "a method as a function", &hint);
                }
                return self.unsupported(
                    span,
                    "a call outside the module",
                    "formulas call formulas of their own module",
                );
            }
        };
        let Some(function) = self.known_function(name, span) else {
            self.all(call.args.iter(), scope);
            return None;
        };
        let partial = partial.filter(|partial| *partial != "value");
        if let Some(partial) = partial {
            // Entered before it is known to exist, so that a call of one that does not is reported once.
            self.partials.insert((function.name(), partial.clone()));
        }
        let arguments = self.arguments(function, call, scope)?;
        match partial {
            Some(partial) => self.partial(function, partial, arguments, span),
            None => self.call_or_table(function, arguments, span),
        }
    }

    fn known_function(&mut self, name: &str, span: Span) -> Option<&'m Function> {
        let module = self.module;
        let Some(function) = module.function(name) else {
            let names: Vec<String> = module
                .functions
                .iter()
                .map(|function| function.name())
                .collect();
            let hint = match nearest(name, names.iter().map(String::as_str)) {
                Some(candidate) => format!("did you mean `{candidate}`?"),
                None => "formulas call formulas of their own module".to_owned(),
            };
            self.diagnostics
                .error_with_hint(span, format!("unknown function `{name}`"), hint);
            return None;
        };
        Some(function)
    }

    fn arguments(
        &mut self,
        function: &Function,
        call: &syn::ExprCall,
        scope: &mut Scope,
    ) -> Option<Vec<Value>> {
        let expected = function.parameters.len();
        let arguments = self.all(call.args.iter(), scope);
        if !function.readable {
            // It is reported where it stands.
            return None;
        }
        if call.args.len() != expected {
            let names: Vec<String> = function
                .parameters
                .iter()
                .map(|parameter| parameter.name.to_string())
                .collect();
            self.diagnostics.error_with_hint(
                call.span(),
                format!(
                    "`{}` takes {expected} argument{}, not {}",
                    function.name(),
                    if expected == 1 { "" } else { "s" },
                    call.args.len()
                ),
                format!("it is {}({})", function.name(), names.join(", ")),
            );
            return None;
        }
        let arguments = arguments?;
        let mut all_fit = true;
        for ((argument, parameter), expression) in
            arguments.iter().zip(&function.parameters).zip(&call.args)
        {
            let fits = match parameter.kind {
                ParameterKind::Number => matches!(argument, Value::Number(_)),
                ParameterKind::Array(length) => {
                    matches!(argument, Value::Array(values) if values.len() == length)
                }
                ParameterKind::Struct => {
                    matches!(argument, Value::Parameter { .. } | Value::Struct { .. })
                }
            };
            if !fits {
                let hint = match parameter.kind {
                    ParameterKind::Number => "it is a number".to_owned(),
                    ParameterKind::Array(length) => format!("it is an array of {length} numbers"),
                    ParameterKind::Struct => "it is a struct".to_owned(),
                };
                self.diagnostics.error_with_hint(
                    expression.span(),
                    format!(
                        "`{}` of `{}` can't be {}",
                        parameter.name,
                        function.name(),
                        argument.description()
                    ),
                    hint,
                );
                all_fit = false;
            }
        }
        all_fit.then_some(arguments)
    }

    /// A function's value: through its table where it is tabulated, else through its body.
    pub(super) fn call_or_table(
        &mut self,
        function: &Function,
        arguments: Vec<Value>,
        span: Span,
    ) -> Option<Value> {
        let Some(approximation) = &function.approximation else {
            let before = self.diagnostics.len();
            let result = self.call(function, arguments);
            // What is too deep is so wherever the calls begin.
            if result.is_none() && !self.too_deep {
                let reasons = self.diagnostics.split_off(before);
                self.explain_failed_call(function, &reasons, span);
            }
            return result;
        };
        // A table that could not be made is reported where its function stands.
        let table = self
            .tables
            .get(self.module, function, approximation)?
            .clone();
        let position = self
            .graph
            .tables
            .iter()
            .position(|known| known.name == table.name)
            .unwrap_or_else(|| {
                Arc::make_mut(&mut self.graph.tables).push(table);
                self.graph.tables.len() - 1
            });
        let Some(Value::Number(argument)) = arguments.first() else {
            return None;
        };
        let value = self.graph.tabulated(position, 0, *argument);
        let factor = self.factor(approximation, *argument)?;
        Some(Value::Number(self.graph.multiply(factor, value)))
    }

    /// A function that is wrong in itself is reported where it stands, not at each of its calls; one that only these
    /// arguments don't suit is reported here.
    fn explain_failed_call(&mut self, function: &Function, reasons: &Diagnostics, span: Span) {
        let alone = Reader::new(self.module, self.tables).read(function);
        if let (Some(_), Some(reason)) = (alone, reasons.first()) {
            self.diagnostics.error_with_hint(
                span,
                format!(
                    "`{}` can't have these arguments: {}",
                    function.name(),
                    reason.message
                ),
                reason.hint.clone(),
            );
        }
    }

    /// `f::d_x(…)` or `f::d_x_y(…)`: a partial derivative of another formula, at these arguments.
    fn partial(
        &mut self,
        function: &'m Function,
        partial: &str,
        arguments: Vec<Value>,
        span: Span,
    ) -> Option<Value> {
        let role = Role::Argument(function.name().into());
        let placeholders = self.symbolic_arguments(function, &role);
        for number in numbers::known(self.module, function) {
            self.graph.symbol_of(role.clone(), &number);
        }
        let value = match self.call_or_table(function, placeholders, span)? {
            Value::Number(id) => id,
            other => {
                let message = format!(
                    "`{}` gives {}, a partial needs a number",
                    function.name(),
                    other.description()
                );
                self.diagnostics.error_with_hint(
                    span,
                    message,
                    "write a function that gives the one number",
                );
                return None;
            }
        };
        let mut derivative = value;
        for symbol in self.derived_by(function, partial, &role, span)? {
            derivative =
                crate::differentiate::gradient_forward(&mut self.graph, derivative, &[symbol])
                    .first()
                    .copied()?;
        }
        let names = function.parameters.iter();
        let names = names.map(|parameter| parameter.name.to_string());
        let scope: Scope = names.zip(arguments.into_iter().map(Some)).collect();
        let mut replacements = BTreeMap::new();
        for symbol in self.graph.symbols_of(&[derivative]) {
            let placeholder = self.graph.symbol(symbol).clone();
            if placeholder.role == role {
                replacements.insert(symbol, self.resolve(&placeholder.name, &scope, span)?);
            }
        }
        let result = self.graph.substitute(&[derivative], &replacements);
        result.first().map(|id| Value::Number(*id))
    }

    /// The symbols of that role that a partial is by.
    fn derived_by(
        &mut self,
        function: &Function,
        partial: &str,
        role: &Role,
        span: Span,
    ) -> Option<Vec<SymbolId>> {
        let mut names: Vec<(String, SymbolId)> = Vec::new();
        // Also those that the value does not depend on: the partial by them is zero.
        for (id, symbol) in self.graph.symbols() {
            if symbol.role == *role {
                names.push((identifier(&symbol.name), id));
            }
        }
        let ways = partial
            .strip_prefix("d_")
            .map(|suffix| partial_symbols(suffix, &names))
            .unwrap_or_default();
        match ways.as_slice() {
            [by] => return Some(by.clone()),
            [] => {
                let known: Vec<String> =
                    names.iter().map(|(name, _)| format!("d_{name}")).collect();
                let suffix = partial.strip_prefix("d_").unwrap_or(partial);
                let hint = match alike(suffix, names.iter().map(|(name, _)| name.as_str())) {
                    Some(known) => format!("did you mean `d_{known}`?"),
                    None => format!(
                        "its partials are {} and those by two of these names",
                        known.join(", ")
                    ),
                };
                self.diagnostics.error_with_hint(
                    span,
                    format!("`{}` has no partial `{partial}`", function.name()),
                    hint,
                );
            }
            ways => {
                let name = |symbol: &SymbolId| format!("`{}`", self.graph.symbol(*symbol).name);
                let ways: Vec<String> = ways
                    .iter()
                    .map(|by| by.iter().map(name).collect::<Vec<_>>().join(" and "))
                    .collect();
                self.diagnostics.error_with_hint(
                    span,
                    format!(
                        "`{partial}` of `{}` may be that by {}",
                        function.name(),
                        ways.join(" or by ")
                    ),
                    "rename a parameter, so that there is one way to read it",
                );
            }
        }
        None
    }

    /// The number at `c.beta` or `a[0]` of a scope.
    fn resolve(&mut self, path: &str, scope: &Scope, span: Span) -> Option<ExprId> {
        let expression: Expr = syn::parse_str(path).ok()?;
        let before = self.diagnostics.len();
        let found = self.number(&expression, &mut scope.clone());
        if found.is_none() {
            self.diagnostics.split_off(before);
            self.diagnostics.error_with_hint(
                span,
                format!("the argument has no `{path}`"),
                "the formula's partial uses it",
            );
        }
        found
    }

    /// `integral(|x| …, a..b)`
    fn integral(&mut self, call: &syn::ExprCall, scope: &mut Scope) -> Option<Value> {
        let parts: Vec<&Expr> = call.args.iter().collect();
        let [Expr::Closure(closure), Expr::Range(range)] = parts.as_slice() else {
            return self.unsupported(
                call.span(),
                "an integral of this form",
                "write `integral(|x| …, a..b)`",
            );
        };
        let variable = match closure.inputs.iter().collect::<Vec<_>>().as_slice() {
            [Pat::Ident(name)] => name.ident.to_string(),
            [Pat::Type(typed)] => match typed.pat.as_ref() {
                Pat::Ident(name) => name.ident.to_string(),
                _ => {
                    return self.unsupported(
                        typed.span(),
                        "this variable of integration",
                        "it is a plain name",
                    );
                }
            },
            _ => {
                return self.unsupported(
                    closure.span(),
                    "this integrand",
                    "it has one variable: `|x| …`",
                );
            }
        };
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.unsupported(range.span(), "an open range", "an integral has two bounds");
        };
        let (lower, upper) = (self.number(start, scope), self.number(end, scope));
        self.integrals += 1;
        let symbol = self
            .graph
            .symbol_of(Role::Variable(self.integrals), &variable);
        let mut inner = scope.clone();
        let value = Value::Number(self.graph.symbol_expression(symbol));
        inner.insert(variable, Some(value));
        let integrand = self.number(&closure.body, &mut inner)?;
        Some(Value::Number(
            self.graph.integral(symbol, integrand, lower?, upper?),
        ))
    }
}
