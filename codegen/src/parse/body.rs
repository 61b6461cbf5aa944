//! Follows a function's statements with expressions in place of numbers.

mod calls;
mod methods;
mod statements;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, Lit, UnOp};

use super::attributes::Approximation;
use super::literal;
use super::module::{Function, Module, ParameterKind};
use super::value::Value;
use crate::diagnostics::{Diagnostics, nearest};
use crate::graph::{ExprId, Graph, Rational, SymbolId, whole};
use crate::tables::Tables;

/// Names in scope.
type Scope = BTreeMap<String, Value>;

/// Reads bodies of one module's functions into one graph.
pub struct Reader<'m> {
    module: &'m Module,
    tables: &'m mut Tables,
    /// The graph that is written to.
    pub graph: Graph,
    /// What was wrong.
    pub diagnostics: Diagnostics,
    calls: Vec<String>,
    /// How many integrals were read.
    pub integrals: usize,
    /// The partials `f::d_x` that were called: function and partial.
    pub partials: BTreeSet<(String, String)>,
}

impl<'m> Reader<'m> {
    /// A reader with an empty graph.
    pub fn new(module: &'m Module, tables: &'m mut Tables) -> Self {
        Self {
            module,
            tables,
            graph: Graph::new(),
            diagnostics: Diagnostics::default(),
            calls: Vec::new(),
            integrals: 0,
            partials: BTreeSet::new(),
        }
    }

    /// The function's result over symbols named as its parameters. None where something was reported.
    pub fn read(&mut self, function: &Function) -> Option<Value> {
        if !function.readable {
            return None;
        }
        self.assume_domain(function);
        let arguments = self.symbolic_arguments(function, "");
        if function.approximation.is_some() {
            return self.call_or_table(function, arguments);
        }
        self.call(function, arguments)
    }

    /// The result of the function's own body, also where calls of it go through a table.
    pub fn read_body(&mut self, function: &Function) -> Option<Value> {
        let arguments = self.symbolic_arguments(function, "");
        self.call(function, arguments)
    }

    /// The factor that an approximated function keeps, over a symbol named as its parameter; 1 without one.
    pub fn read_factor(&mut self, approximation: &Approximation) -> Option<ExprId> {
        let symbol = self.graph.symbol_named(&approximation.variable.to_string());
        let argument = self.graph.symbol_expression(symbol);
        self.factor(approximation, argument)
    }

    fn factor(&mut self, approximation: &Approximation, argument: ExprId) -> Option<ExprId> {
        let Some(factor) = &approximation.factor else {
            return Some(self.graph.one());
        };
        let mut scope =
            Scope::from([(approximation.variable.to_string(), Value::Number(argument))]);
        self.number(factor, &mut scope)
    }

    /// Declares the function's domains; call it before anything is built.
    fn assume_domain(&mut self, function: &Function) {
        for (symbol, sign, span) in &function.domain {
            let parameter = symbol.split(['.', '[']).next().unwrap_or(symbol);
            if !function
                .parameters
                .iter()
                .any(|known| known.name == parameter)
            {
                let names: Vec<String> = function
                    .parameters
                    .iter()
                    .map(|known| known.name.to_string())
                    .collect();
                let hint = format!("its parameters are {}", names.join(", "));
                self.diagnostics.error_with_hint(
                    *span,
                    format!("`{}` has no parameter `{parameter}`", function.name()),
                    hint,
                );
                continue;
            }
            let id = self.graph.symbol_named(symbol);
            self.graph.assume(id, *sign);
        }
    }

    fn symbolic_arguments(&mut self, function: &Function, prefix: &str) -> Vec<Value> {
        let symbol = |graph: &mut Graph, name: String| {
            let id = graph.symbol_named(&name);
            Value::Number(graph.symbol_expression(id))
        };
        let mut arguments = Vec::new();
        for parameter in &function.parameters {
            let name = format!("{prefix}{}", parameter.name);
            arguments.push(match parameter.kind {
                ParameterKind::Number => symbol(&mut self.graph, name),
                ParameterKind::Array(length) => Value::Array(
                    (0..length)
                        .map(|i| symbol(&mut self.graph, format!("{name}[{i}]")))
                        .collect(),
                ),
                ParameterKind::Struct => Value::Parameter { path: name },
            });
        }
        arguments
    }

    /// The function's result for these arguments.
    fn call(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        let name = function.name();
        self.calls.push(name);
        let names = function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        let mut scope: Scope = names.zip(arguments).collect();
        let result = self.block(&function.item.block, &mut scope, true);
        self.calls.pop();
        result
    }

    fn expression(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => self.path(&path.path, scope),
            Expr::Paren(inner) => self.expression(&inner.expr, scope),
            Expr::Group(inner) => self.expression(&inner.expr, scope),
            Expr::Reference(inner) => self.expression(&inner.expr, scope),
            Expr::Block(inner) => self.block(&inner.block, &mut scope.clone(), false),
            Expr::Unary(unary) => match unary.op {
                UnOp::Deref(_) => self.expression(&unary.expr, scope),
                UnOp::Neg(_) => {
                    let operand = self.number(&unary.expr, scope)?;
                    Some(Value::Number(self.graph.negate(operand)))
                }
                _ => self.unsupported(expression.span(), "`!`", "formulas have no logical values"),
            },
            Expr::Binary(binary) => self.binary(binary, scope),
            Expr::MethodCall(call) => self.method(call, scope),
            Expr::Call(call) => self.function_call(call, scope),
            Expr::Field(field) => self.field(field, scope),
            Expr::Index(index) => self.element(index, scope),
            Expr::Tuple(tuple) => self.all(tuple.elems.iter(), scope).map(Value::Tuple),
            Expr::Array(array) => self.all(array.elems.iter(), scope).map(Value::Array),
            Expr::Struct(literal) => self.struct_literal(literal, scope),
            other => self.unsupported_expression(other),
        }
    }

    fn unsupported_expression(&mut self, expression: &Expr) -> Option<Value> {
        let span = expression.span();
        match expression {
            Expr::If(_) | Expr::Match(_) => {
                self.unsupported(span, "a branch", "use min, max or abs, or write one formula per case and choose between them outside")
            }
            Expr::ForLoop(_) | Expr::While(_) | Expr::Loop(_) => {
                self.unsupported(span, "a loop", "write the terms out, or give the sum as an integral or a function of its own")
            }
            Expr::Cast(_) => self.unsupported(span, "a cast", "all numbers of a formula are f64"),
            Expr::Macro(_) => self.unsupported(span, "a macro call", "write the expression out"),
            Expr::Assign(_) => self.unsupported(span, "an assignment", "bind the new value with `let`"),
            Expr::Closure(_) => self.unsupported(span, "a closure here", "closures are the integrands of `integral(|x| …, a..b)`"),
            _ => self.unsupported(span, "this expression", "formulas are + - * /, powi, sqrt, sin, cos, tan, exp, ln, abs, recip, mul_add, min, max and calls of other formulas"),
        }
    }

    fn unsupported<T>(&mut self, span: Span, what: &str, hint: &str) -> Option<T> {
        self.diagnostics
            .error_with_hint(span, format!("{what} is not a part of a formula"), hint);
        None
    }

    /// Evaluates an expression that must be one number.
    fn number(&mut self, expression: &Expr, scope: &mut Scope) -> Option<ExprId> {
        match self.expression(expression, scope)? {
            Value::Number(id) => Some(id),
            other => {
                let message = format!("a number is needed here, this is {}", other.description());
                self.diagnostics.error_with_hint(
                    expression.span(),
                    message,
                    other.way_to_a_number(),
                );
                None
            }
        }
    }

    /// Evaluates all, so that every mistake is reported.
    fn all<'e>(
        &mut self,
        expressions: impl Iterator<Item = &'e Expr>,
        scope: &mut Scope,
    ) -> Option<Vec<Value>> {
        let values: Vec<Option<Value>> = expressions
            .map(|expression| self.expression(expression, scope))
            .collect();
        values.into_iter().collect()
    }

    fn literal(&mut self, literal: &Lit) -> Option<Value> {
        let value = match literal {
            Lit::Float(value) if matches!(value.suffix(), "" | "f64") => {
                literal::decimal(value.base10_digits())
            }
            Lit::Int(value) if value.suffix() == "f64" => literal::decimal(value.base10_digits()),
            Lit::Int(value) => {
                let hint = format!("write `{}.0`", value.base10_digits());
                return self.unsupported(literal.span(), "a whole number literal", &hint);
            }
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

    fn path(&mut self, path: &syn::Path, scope: &mut Scope) -> Option<Value> {
        let last = path.segments.last()?;
        let name = last.ident.to_string();
        if path.segments.len() == 1 {
            if let Some(value) = scope.get(&name) {
                return Some(value.clone());
            }
            if let Some((_, value)) = self
                .module
                .constants
                .iter()
                .find(|(constant, _)| *constant == name)
            {
                return self.expression(value, &mut Scope::new());
            }
        }
        if let Some(standard) = self.module.imports.constant(path)
            && let Some(id) = literal::constant(&mut self.graph, &standard)
        {
            return Some(Value::Number(id));
        }
        if literal::CONSTANTS.contains(&name.as_str()) || path.segments.len() > 1 {
            self.diagnostics.error_with_hint(
                path.span(),
                format!("the value of `{name}` is not known here"),
                "constants are those of the module and of std::f64::consts, by their path or imported in the module",
            );
            return None;
        }
        let constants = self
            .module
            .constants
            .iter()
            .map(|(constant, _)| constant.as_str());
        let known = scope.keys().map(String::as_str).chain(constants);
        let hint = match nearest(&name, known) {
            Some(candidate) => format!("did you mean `{candidate}`?"),
            None => "names are parameters, `let` bindings, constants of the module and of std::f64::consts".to_owned(),
        };
        self.diagnostics
            .error_with_hint(path.span(), format!("unknown name `{name}`"), hint);
        None
    }

    fn binary(&mut self, binary: &syn::ExprBinary, scope: &mut Scope) -> Option<Value> {
        match binary.op {
            BinOp::Add(_) | BinOp::Sub(_) => {
                let mut terms = Vec::new();
                self.terms(binary, scope, &mut terms);
                let terms: Option<Vec<_>> = terms.into_iter().collect();
                Some(Value::Number(self.graph.sum(terms?)))
            }
            BinOp::Mul(_) | BinOp::Div(_) => {
                let (left, right) = (
                    self.number(&binary.left, scope),
                    self.number(&binary.right, scope),
                );
                let (left, right) = (left?, right?);
                let result = if matches!(binary.op, BinOp::Mul(_)) {
                    self.graph.multiply(left, right)
                } else {
                    self.graph.divide(left, right)
                };
                self.of_bounded_size(result, binary.span())
            }
            _ => self.unsupported(
                binary.op.span(),
                "this operator",
                "the operators are + - * /",
            ),
        }
    }

    /// The terms of a chain `a + b - c`; parentheses close a sum, for they say how its author wants it rounded.
    fn terms(
        &mut self,
        binary: &syn::ExprBinary,
        scope: &mut Scope,
        terms: &mut Vec<Option<(ExprId, Rational)>>,
    ) {
        match binary.left.as_ref() {
            Expr::Binary(left) if matches!(left.op, BinOp::Add(_) | BinOp::Sub(_)) => {
                self.terms(left, scope, terms)
            }
            left => terms.push(self.number(left, scope).map(|id| (id, whole(1)))),
        }
        let sign = if matches!(binary.op, BinOp::Sub(_)) {
            -1
        } else {
            1
        };
        terms.push(
            self.number(&binary.right, scope)
                .map(|id| (id, whole(sign))),
        );
    }

    fn field(&mut self, field: &syn::ExprField, scope: &mut Scope) -> Option<Value> {
        let base = self.expression(&field.base, scope)?;
        let member = match &field.member {
            syn::Member::Named(name) => name.to_string(),
            syn::Member::Unnamed(index) => index.index.to_string(),
        };
        let (description, hint) = (base.description(), base.known_fields());
        let found = match base {
            Value::Parameter { path } => {
                let id = self.graph.symbol_named(&format!("{path}.{member}"));
                return Some(Value::Number(self.graph.symbol_expression(id)));
            }
            Value::Struct { fields, .. } => fields
                .into_iter()
                .find(|(name, _)| *name == member)
                .map(|(_, value)| value),
            Value::Tuple(mut values) => member
                .parse()
                .ok()
                .filter(|position| *position < values.len())
                .map(|position| values.swap_remove(position)),
            Value::Number(_) | Value::Array(_) => None,
        };
        if found.is_none() {
            self.diagnostics.error_with_hint(
                field.member.span(),
                format!("{description} has no field `{member}`"),
                hint,
            );
        }
        found
    }

    fn element(&mut self, index: &syn::ExprIndex, scope: &mut Scope) -> Option<Value> {
        let base = self.expression(&index.expr, scope)?;
        let Expr::Lit(syn::ExprLit {
            lit: Lit::Int(position),
            ..
        }) = index.index.as_ref()
        else {
            return self.unsupported(
                index.index.span(),
                "this index",
                "an index is a whole number literal",
            );
        };
        let position = position.base10_parse::<usize>().ok();
        match base {
            Value::Array(values) => {
                let length = values.len();
                let element = position.and_then(|position| values.into_iter().nth(position));
                if element.is_none() {
                    let hint = match length.checked_sub(1) {
                        Some(last) => format!("its last one is `[{last}]`"),
                        None => "it is empty".to_owned(),
                    };
                    self.diagnostics.error_with_hint(
                        index.index.span(),
                        format!("the array has {length} elements"),
                        hint,
                    );
                }
                element
            }
            other => {
                let message = format!("{} has no elements", other.description());
                self.diagnostics.error_with_hint(
                    index.expr.span(),
                    message,
                    other.way_to_a_number(),
                );
                None
            }
        }
    }

    fn struct_literal(&mut self, literal: &syn::ExprStruct, scope: &mut Scope) -> Option<Value> {
        if let Some(rest) = &literal.rest {
            return self.unsupported(rest.span(), "`..` in a struct", "name every field");
        }
        let values = self.all(literal.fields.iter().map(|field| &field.expr), scope)?;
        let path = &literal.path;
        let mut fields = Vec::new();
        for (field, value) in literal.fields.iter().zip(values) {
            let syn::Member::Named(name) = &field.member else {
                return self.unsupported(
                    field.member.span(),
                    "a field without a name",
                    "use a tuple",
                );
            };
            if let Value::Number(id) = &value {
                self.graph.suggest_name(*id, &name.to_string());
            }
            fields.push((name.to_string(), value));
        }
        Some(Value::Struct {
            name: quote::ToTokens::to_token_stream(path).to_string(),
            fields,
        })
    }
}

/// `c.beta` as an identifier: `c_beta`; `a[0]`: `a_0`; `r#type`, which only stands alone: `type_`.
pub fn identifier(symbol: &str) -> String {
    let name = symbol
        .replace("r#", "")
        .replace(['.', '['], "_")
        .replace(']', "");
    let word = name.starts_with(|first: char| first.is_alphabetic());
    if word && syn::parse_str::<syn::Ident>(&name).is_err() {
        format!("{name}_")
    } else {
        name
    }
}

/// The one or two symbols whose names make up the suffix of a partial.
pub fn partial_symbols(suffix: &str, names: &[(String, SymbolId)]) -> Option<Vec<SymbolId>> {
    if let Some((_, symbol)) = names.iter().find(|(name, _)| name == suffix) {
        return Some(vec![*symbol]);
    }
    names.iter().find_map(|(first, one)| {
        let rest = suffix.strip_prefix(first.as_str())?.strip_prefix('_')?;
        names
            .iter()
            .find(|(second, _)| second == rest)
            .map(|(_, other)| vec![*one, *other])
    })
}
