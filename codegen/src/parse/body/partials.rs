//! Partials of formulas: the names by which they are called, and their values at arguments.

use std::collections::BTreeMap;

use proc_macro2::Span;
use syn::Expr;

use super::{Reader, Scope, identifier, partial_symbols};
use crate::diagnostics::alike;
use crate::graph::{ExprId, Role, SymbolId};
use crate::parse::module::Function;
use crate::parse::numbers;
use crate::parse::value::Value;

/// Why a partial's name has not one meaning.
#[derive(Clone, Debug)]
pub(crate) struct Misread {
    /// What is wrong with it.
    pub(crate) message: String,
    /// What to write instead.
    pub(crate) hint: String,
}

/// The symbols that the partial of a function is by, of those with these names; `symbol` gives how one is written.
pub(crate) fn read_partial(
    function: &str,
    partial: &str,
    names: &[(String, SymbolId)],
    symbol: impl Fn(SymbolId) -> String,
) -> Result<Vec<SymbolId>, Misread> {
    let suffix = partial.strip_prefix("d_");
    let ways = suffix.map(|suffix| partial_symbols(suffix, names));
    let ways = ways.unwrap_or_default();
    match ways.as_slice() {
        [by] => Ok(by.clone()),
        [] => {
            let known: Vec<String> = names.iter().map(|(name, _)| format!("d_{name}")).collect();
            let meant = alike(
                suffix.unwrap_or(partial),
                names.iter().map(|(name, _)| name.as_str()),
            );
            Err(Misread {
                message: format!("`{function}` has no partial `{partial}`"),
                hint: match meant {
                    Some(known) => format!("did you mean `d_{known}`?"),
                    None => format!(
                        "its partials are {} and those by two of these names",
                        known.join(", ")
                    ),
                },
            })
        }
        ways => {
            let name = |id: &SymbolId| format!("`{}`", symbol(*id));
            let way = |by: &Vec<SymbolId>| by.iter().map(name).collect::<Vec<_>>().join(" and ");
            let ways: Vec<String> = ways.iter().map(way).collect();
            Err(Misread {
                message: format!(
                    "`{partial}` of `{function}` may be that by {}",
                    ways.join(" or by ")
                ),
                hint: "rename a parameter, so that there is one way to read it".to_owned(),
            })
        }
    }
}

impl<'m> Reader<'m> {
    /// `f::d_x(…)` or `f::d_x_y(…)`: a partial derivative of another formula, at these arguments.
    pub(super) fn partial(
        &mut self,
        function: &'m Function,
        partial: &str,
        arguments: Vec<Value>,
        span: Span,
    ) -> Option<Value> {
        let asked = function
            .request
            .iter()
            .flat_map(|request| &request.partials);
        let mut asked = asked.map(|asked| asked.symbol.as_str());
        if self.module.key != self.reading.key && !asked.any(|asked| asked == partial) {
            self.diagnostics.error_with_hint(
                span,
                format!(
                    "`{0}` is of another module, which does not generate `{0}::{partial}`",
                    function.name()
                ),
                format!("ask for it where the formula stands: #[generate({partial})]"),
            );
            return None;
        }
        let role = Role::Argument(function.name().into());
        let placeholders = self.symbolic_arguments(function, &role);
        for number in numbers::known(function) {
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
        let mut scope = Scope::from(names.zip(arguments.into_iter().map(Some)));
        let mut replacements = BTreeMap::new();
        for symbol in self.graph.symbols_of(&[derivative]) {
            let placeholder = self.graph.symbol(symbol).clone();
            if placeholder.role == role {
                replacements.insert(symbol, self.resolve(&placeholder.name, &mut scope, span)?);
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
        let symbol = |symbol: SymbolId| self.graph.symbol(symbol).name.clone();
        match read_partial(&function.name(), partial, &names, symbol) {
            Ok(by) => Some(by),
            Err(Misread { message, hint }) => {
                self.diagnostics.error_with_hint(span, message, hint);
                None
            }
        }
    }

    /// The number at `c.beta` or `a[0]` of a scope.
    fn resolve(&mut self, path: &str, scope: &mut Scope, span: Span) -> Option<ExprId> {
        let expression: Expr = syn::parse_str(path).ok()?;
        let before = self.diagnostics.len();
        let found = self.number(&expression, scope);
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
}
