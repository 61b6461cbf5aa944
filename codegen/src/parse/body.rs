//! Follows a function's statements with expressions in place of numbers.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, Lit, Pat, Stmt, UnOp};

use super::attributes::Approximation;
use super::literal;
use super::module::{Function, Module, ParameterKind};
use super::value::Value;
use crate::diagnostics::{Diagnostics, nearest};
use crate::graph::{ExprId, Function as Elementary, Graph, Rational, SymbolId, whole};
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
        let Some(factor) = &approximation.factor else { return Some(self.graph.one()) };
        let mut scope = Scope::from([(approximation.variable.to_string(), Value::Number(argument))]);
        self.number(factor, &mut scope)
    }

    /// Declares the function's domains; call it before anything is built.
    fn assume_domain(&mut self, function: &Function) {
        for (symbol, sign, span) in &function.domain {
            let parameter = symbol.split(['.', '[']).next().unwrap_or(symbol);
            if !function.parameters.iter().any(|known| known.name == parameter) {
                let names: Vec<String> = function.parameters.iter().map(|known| known.name.to_string()).collect();
                let hint = format!("its parameters are {}", names.join(", "));
                self.diagnostics.error_with_hint(*span, format!("`{}` has no parameter `{parameter}`", function.name()), hint);
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
                ParameterKind::Array(length) => {
                    Value::Array((0..length).map(|i| symbol(&mut self.graph, format!("{name}[{i}]"))).collect())
                }
                ParameterKind::Struct => Value::Parameter { path: name },
            });
        }
        arguments
    }

    /// The function's result for these arguments.
    fn call(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        let name = function.name();
        self.calls.push(name);
        let names = function.parameters.iter().map(|parameter| parameter.name.to_string());
        let mut scope: Scope = names.zip(arguments).collect();
        let result = self.block(&function.item.block, &mut scope);
        self.calls.pop();
        result
    }

    fn block(&mut self, block: &syn::Block, scope: &mut Scope) -> Option<Value> {
        let mut result = None;
        let mut failed = false;
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => failed |= self.binding(local, scope).is_none(),
                Stmt::Expr(Expr::Return(returned), _) => {
                    result = returned.expr.as_ref().and_then(|value| self.expression(value, scope));
                }
                Stmt::Expr(value, None) => result = self.expression(value, scope),
                other => {
                    self.diagnostics.error_with_hint(
                        other.span(),
                        "this statement is not a part of a formula",
                        "a formula is `let` bindings and an expression",
                    );
                    failed = true;
                }
            }
        }
        if result.is_none() && !failed && self.diagnostics.is_empty() {
            self.diagnostics.error_with_hint(
                block.brace_token.span.join(),
                "the formula has no value",
                "end it with an expression",
            );
        }
        result.filter(|_| !failed)
    }

    fn binding(&mut self, local: &syn::Local, scope: &mut Scope) -> Option<()> {
        let Some(init) = local.init.as_ref().filter(|init| init.diverge.is_none()) else {
            self.diagnostics.error_with_hint(local.span(), "a binding needs its value at once", "write `let x = …;`");
            return None;
        };
        let value = self.expression(&init.expr, scope);
        let failed = value.is_none();
        // The names of a failed binding count as known, so that one mistake is reported once.
        self.bind(&local.pat, value, scope)?;
        (!failed).then_some(())
    }

    fn bind(&mut self, pattern: &Pat, value: Option<Value>, scope: &mut Scope) -> Option<()> {
        match pattern {
            Pat::Ident(name) if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() => {
                let text = name.ident.to_string();
                if let Some(Value::Number(id)) = &value {
                    self.graph.suggest_name(*id, &text);
                }
                let placeholder = Value::Number(self.graph.one());
                scope.insert(text, value.unwrap_or(placeholder));
                Some(())
            }
            Pat::Type(typed) => self.bind(&typed.pat, value, scope),
            Pat::Paren(inner) => self.bind(&inner.pat, value, scope),
            Pat::Wild(_) => Some(()),
            Pat::Tuple(tuple) => {
                let parts = match value {
                    Some(Value::Tuple(parts)) if parts.len() == tuple.elems.len() => parts.into_iter().map(Some).collect(),
                    None => vec![None; tuple.elems.len()],
                    Some(other) => {
                        self.diagnostics.error(
                            tuple.span(),
                            format!("{} can't be taken apart into {} parts", other.description(), tuple.elems.len()),
                        );
                        return None;
                    }
                };
                let mut complete = Some(());
                for (pattern, part) in tuple.elems.iter().zip(parts) {
                    complete = self.bind(pattern, part, scope).and(complete);
                }
                complete
            }
            Pat::Ident(name) => {
                let hint = "a formula never changes a number; bind the new one to another name";
                self.diagnostics.error_with_hint(name.span(), "a binding is a plain name", hint);
                None
            }
            other => {
                self.diagnostics.error_with_hint(other.span(), "this pattern is not a part of a formula", "bind a name or a tuple of names");
                None
            }
        }
    }

    fn expression(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => self.path(&path.path, scope),
            Expr::Paren(inner) => self.expression(&inner.expr, scope),
            Expr::Group(inner) => self.expression(&inner.expr, scope),
            Expr::Reference(inner) => self.expression(&inner.expr, scope),
            Expr::Block(inner) => self.block(&inner.block, &mut scope.clone()),
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
        self.diagnostics.error_with_hint(span, format!("{what} is not a part of a formula"), hint);
        None
    }

    /// Evaluates an expression that must be one number.
    fn number(&mut self, expression: &Expr, scope: &mut Scope) -> Option<ExprId> {
        match self.expression(expression, scope)? {
            Value::Number(id) => Some(id),
            other => {
                self.diagnostics.error(expression.span(), format!("a number is needed here, this is {}", other.description()));
                None
            }
        }
    }

    /// Evaluates all, so that every mistake is reported.
    fn all<'e>(&mut self, expressions: impl Iterator<Item = &'e Expr>, scope: &mut Scope) -> Option<Vec<Value>> {
        let values: Vec<Option<Value>> = expressions.map(|expression| self.expression(expression, scope)).collect();
        values.into_iter().collect()
    }

    fn literal(&mut self, literal: &Lit) -> Option<Value> {
        let value = match literal {
            Lit::Float(value) if matches!(value.suffix(), "" | "f64") => literal::decimal(value.base10_digits()),
            Lit::Int(value) if value.suffix() == "f64" => literal::decimal(value.base10_digits()),
            Lit::Int(value) => {
                let hint = format!("write `{}.0`", value.base10_digits());
                return self.unsupported(literal.span(), "a whole number literal", &hint);
            }
            _ => return self.unsupported(literal.span(), "this literal", "numbers are f64"),
        };
        match value {
            Some(value) => Some(Value::Number(self.graph.number(value))),
            None => self.unsupported(literal.span(), "a number of this size", "an f64 holds up to 1.8e308"),
        }
    }

    fn path(&mut self, path: &syn::Path, scope: &mut Scope) -> Option<Value> {
        let Some(last) = path.segments.last() else { return None };
        let name = last.ident.to_string();
        if path.segments.len() == 1 {
            if let Some(value) = scope.get(&name) {
                return Some(value.clone());
            }
            if let Some((_, value)) = self.module.constants.iter().find(|(constant, _)| *constant == name) {
                return self.expression(value, &mut Scope::new());
            }
        }
        let prefix: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        let standard = prefix.len() == 1 || prefix.iter().any(|segment| segment == "consts");
        if standard && let Some(id) = literal::constant(&mut self.graph, &name) {
            return Some(Value::Number(id));
        }
        let constants = self.module.constants.iter().map(|(constant, _)| constant.as_str());
        let known = scope.keys().map(String::as_str).chain(constants).chain(literal::CONSTANTS);
        let hint = match nearest(&name, known) {
            Some(candidate) => format!("did you mean `{candidate}`?"),
            None => "names are parameters, `let` bindings, constants of the module and of std::f64::consts".to_owned(),
        };
        self.diagnostics.error_with_hint(path.span(), format!("unknown name `{name}`"), hint);
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
                let (left, right) = (self.number(&binary.left, scope), self.number(&binary.right, scope));
                let (left, right) = (left?, right?);
                Some(Value::Number(if matches!(binary.op, BinOp::Mul(_)) {
                    self.graph.multiply(left, right)
                } else {
                    self.graph.divide(left, right)
                }))
            }
            _ => self.unsupported(binary.op.span(), "this operator", "the operators are + - * /"),
        }
    }

    /// The terms of a chain `a + b - c`; parentheses close a sum, for they say how its author wants it rounded.
    fn terms(&mut self, binary: &syn::ExprBinary, scope: &mut Scope, terms: &mut Vec<Option<(ExprId, Rational)>>) {
        match binary.left.as_ref() {
            Expr::Binary(left) if matches!(left.op, BinOp::Add(_) | BinOp::Sub(_)) => self.terms(left, scope, terms),
            left => terms.push(self.number(left, scope).map(|id| (id, whole(1)))),
        }
        let sign = if matches!(binary.op, BinOp::Sub(_)) { -1 } else { 1 };
        terms.push(self.number(&binary.right, scope).map(|id| (id, whole(sign))));
    }

    fn method(&mut self, call: &syn::ExprMethodCall, scope: &mut Scope) -> Option<Value> {
        const METHODS: [(&str, usize); 12] = [
            ("powi", 1), ("sqrt", 0), ("sin", 0), ("cos", 0), ("tan", 0), ("exp", 0), ("ln", 0), ("abs", 0),
            ("recip", 0), ("mul_add", 2), ("min", 1), ("max", 1),
        ];
        let receiver = self.number(&call.receiver, scope);
        let name = call.method.to_string();
        let Some((_, arity)) = METHODS.into_iter().find(|(method, _)| *method == name) else {
            let hint = match name.as_str() {
                "powf" => "a whole power is `powi(n)`, a root is `sqrt()`, any other is `(y * x.ln()).exp()`".to_owned(),
                _ => match nearest(&name, METHODS.map(|(method, _)| method)) {
                    Some(method) => format!("did you mean `{method}`?"),
                    None => format!("the methods are {}", METHODS.map(|(method, _)| method).join(", ")),
                },
            };
            self.diagnostics.error_with_hint(call.method.span(), format!("unknown method `{name}`"), hint);
            return None;
        };
        if call.args.len() != arity {
            self.diagnostics.error(
                call.method.span(),
                format!("`{name}` takes {arity} argument{}, not {}", if arity == 1 { "" } else { "s" }, call.args.len()),
            );
            return None;
        }
        if name == "powi" {
            let exponent = self.exponent(&call.args[0]);
            return Some(Value::Number(self.graph.power(receiver?, exponent?)));
        }
        let arguments: Vec<Option<ExprId>> = call.args.iter().map(|argument| self.number(argument, scope)).collect();
        let arguments: Vec<ExprId> = arguments.into_iter().collect::<Option<_>>()?;
        Some(Value::Number(self.apply(&name, receiver?, &arguments)))
    }

    fn apply(&mut self, method: &str, receiver: ExprId, arguments: &[ExprId]) -> ExprId {
        let function = match (method, arguments) {
            ("recip", _) => return self.graph.power(receiver, -1),
            ("mul_add", [factor, summand]) => {
                let product = self.graph.multiply(receiver, *factor);
                return self.graph.add(product, *summand);
            }
            ("sqrt", _) => Elementary::Sqrt,
            ("sin", _) => Elementary::Sin,
            ("cos", _) => Elementary::Cos,
            ("tan", _) => Elementary::Tan,
            ("exp", _) => Elementary::Exp,
            ("ln", _) => Elementary::Ln,
            ("min", _) => Elementary::Min,
            ("max", _) => Elementary::Max,
            _ => Elementary::Abs,
        };
        let operands = std::iter::once(receiver).chain(arguments.iter().copied()).collect();
        self.graph.apply(function, operands)
    }

    fn exponent(&mut self, argument: &Expr) -> Option<i32> {
        let (negative, literal) = match argument {
            Expr::Unary(syn::ExprUnary { op: UnOp::Neg(_), expr, .. }) => (true, expr.as_ref()),
            other => (false, other),
        };
        if let Expr::Lit(syn::ExprLit { lit: Lit::Int(value), .. }) = literal
            && let Ok(value) = value.base10_parse::<i32>()
            && value <= 1000
        {
            return Some(if negative { -value } else { value });
        }
        self.unsupported(argument.span(), "this exponent", "powi takes a whole number literal of at most 1000")
    }

    fn field(&mut self, field: &syn::ExprField, scope: &mut Scope) -> Option<Value> {
        let base = self.expression(&field.base, scope)?;
        let member = match &field.member {
            syn::Member::Named(name) => name.to_string(),
            syn::Member::Unnamed(index) => index.index.to_string(),
        };
        let description = base.description();
        let found = match base {
            Value::Parameter { path } => {
                let id = self.graph.symbol_named(&format!("{path}.{member}"));
                return Some(Value::Number(self.graph.symbol_expression(id)));
            }
            Value::Struct { fields, .. } => fields.into_iter().find(|(name, _)| *name == member).map(|(_, value)| value),
            Value::Tuple(mut values) => {
                member.parse().ok().filter(|position| *position < values.len()).map(|position| values.swap_remove(position))
            }
            Value::Number(_) | Value::Array(_) => None,
        };
        if found.is_none() {
            self.diagnostics.error(field.member.span(), format!("{description} has no field `{member}`"));
        }
        found
    }

    fn element(&mut self, index: &syn::ExprIndex, scope: &mut Scope) -> Option<Value> {
        let base = self.expression(&index.expr, scope)?;
        let Expr::Lit(syn::ExprLit { lit: Lit::Int(position), .. }) = index.index.as_ref() else {
            return self.unsupported(index.index.span(), "this index", "an index is a whole number literal");
        };
        let position = position.base10_parse::<usize>().ok();
        match base {
            Value::Array(values) => {
                let length = values.len();
                let element = position.and_then(|position| values.into_iter().nth(position));
                if element.is_none() {
                    self.diagnostics.error(index.index.span(), format!("the array has {length} elements"));
                }
                element
            }
            other => {
                self.diagnostics.error(index.expr.span(), format!("{} has no elements", other.description()));
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
                return self.unsupported(field.member.span(), "a field without a name", "use a tuple");
            };
            if let Value::Number(id) = &value {
                self.graph.suggest_name(*id, &name.to_string());
            }
            fields.push((name.to_string(), value));
        }
        Some(Value::Struct { name: quote::ToTokens::to_token_stream(path).to_string(), fields })
    }

    fn function_call(&mut self, call: &syn::ExprCall, scope: &mut Scope) -> Option<Value> {
        let Expr::Path(path) = call.func.as_ref() else {
            return self.unsupported(call.func.span(), "this call", "call a formula of the module by its name");
        };
        let segments: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        match segments.as_slice() {
            [name] if name == "integral" && self.module.function(name).is_none() => self.integral(call, scope),
            [name] => {
                let function = self.known_function(name, path.path.span())?;
                let arguments = self.arguments(function, call, scope)?;
                self.call_or_table(function, arguments)
            }
            [name, partial] => {
                let function = self.known_function(name, path.path.span())?;
                let arguments = self.arguments(function, call, scope)?;
                self.partial(function, partial, arguments, path.path.span())
            }
            _ => self.unsupported(path.path.span(), "a call outside the module", "formulas call formulas of their own module"),
        }
    }

    fn known_function(&mut self, name: &str, span: Span) -> Option<&'m Function> {
        let module = self.module;
        let Some(function) = module.function(name) else {
            let names: Vec<String> = module.functions.iter().map(Function::name).collect();
            let hint = match nearest(name, names.iter().map(String::as_str)) {
                Some(candidate) => format!("did you mean `{candidate}`?"),
                None => "formulas call formulas of their own module".to_owned(),
            };
            self.diagnostics.error_with_hint(span, format!("unknown function `{name}`"), hint);
            return None;
        };
        if self.calls.iter().any(|caller| caller == name) {
            return self.unsupported(span, "a function that calls itself", "write the terms out");
        }
        Some(function)
    }

    fn arguments(&mut self, function: &Function, call: &syn::ExprCall, scope: &mut Scope) -> Option<Vec<Value>> {
        let expected = function.parameters.len();
        if call.args.len() != expected {
            let names: Vec<String> = function.parameters.iter().map(|parameter| parameter.name.to_string()).collect();
            self.diagnostics.error_with_hint(
                call.span(),
                format!("`{}` takes {expected} argument{}, not {}", function.name(), if expected == 1 { "" } else { "s" }, call.args.len()),
                format!("it is {}({})", function.name(), names.join(", ")),
            );
            return None;
        }
        let arguments = self.all(call.args.iter(), scope)?;
        for ((argument, parameter), expression) in arguments.iter().zip(&function.parameters).zip(&call.args) {
            let fits = match parameter.kind {
                ParameterKind::Number => matches!(argument, Value::Number(_)),
                ParameterKind::Array(length) => matches!(argument, Value::Array(values) if values.len() == length),
                ParameterKind::Struct => matches!(argument, Value::Parameter { .. } | Value::Struct { .. }),
            };
            if !fits {
                self.diagnostics.error(
                    expression.span(),
                    format!("`{}` of `{}` can't be {}", parameter.name, function.name(), argument.description()),
                );
                return None;
            }
        }
        Some(arguments)
    }

    /// A function's value: through its table where it is tabulated, else through its body.
    fn call_or_table(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        let Some(approximation) = &function.approximation else {
            // A function that is wrong in itself is reported where it stands, not at each of its calls.
            let before = self.diagnostics.clone();
            let result = self.call(function, arguments);
            if result.is_none() {
                self.diagnostics = before;
            }
            return result;
        };
        // A table that could not be made is reported where its function stands.
        let table = self.tables.get(self.module, function, approximation)?.clone();
        let position = self.graph.tables.iter().position(|known| known.name == table.name).unwrap_or_else(|| {
            self.graph.tables.push(table);
            self.graph.tables.len() - 1
        });
        let Some(Value::Number(argument)) = arguments.first() else { return None };
        let value = self.graph.tabulated(position, 0, *argument);
        let factor = self.factor(approximation, *argument)?;
        Some(Value::Number(self.graph.multiply(factor, value)))
    }

    /// `f::d_x(…)` or `f::d_x_y(…)`: a partial derivative of another formula, at these arguments.
    fn partial(&mut self, function: &'m Function, partial: &str, arguments: Vec<Value>, span: Span) -> Option<Value> {
        let prefix = format!("{}#", function.name());
        let placeholders = self.symbolic_arguments(function, &prefix);
        let value = match self.call_or_table(function, placeholders)? {
            Value::Number(id) => id,
            other => {
                self.diagnostics.error(span, format!("`{}` gives {}, a partial needs a number", function.name(), other.description()));
                return None;
            }
        };
        let symbols = self.graph.symbols_of(&[value]);
        let names: Vec<(String, SymbolId)> = symbols
            .iter()
            .filter_map(|id| Some((identifier(self.graph.symbol(*id).name.strip_prefix(&prefix)?), *id)))
            .collect();
        let Some(by) = partial.strip_prefix("d_").and_then(|suffix| partial_symbols(suffix, &names)) else {
            let known: Vec<String> = names.iter().map(|(name, _)| format!("d_{name}")).collect();
            let hint = format!("its partials are {} and those by two of these names", known.join(", "));
            self.diagnostics.error_with_hint(span, format!("`{}` has no partial `{partial}`", function.name()), hint);
            return None;
        };
        self.partials.insert((function.name(), partial.to_owned()));
        let mut derivative = value;
        for symbol in by {
            derivative = crate::differentiate::gradient(&mut self.graph, derivative, &[symbol]).first().copied()?;
        }
        let scope: Scope =
            function.parameters.iter().map(|parameter| parameter.name.to_string()).zip(arguments).collect();
        let mut replacements = BTreeMap::new();
        for symbol in self.graph.symbols_of(&[derivative]) {
            let name = self.graph.symbol(symbol).name.clone();
            if let Some(path) = name.strip_prefix(&prefix) {
                replacements.insert(symbol, self.resolve(path, &scope, span)?);
            }
        }
        let result = self.graph.substitute(&[derivative], &replacements);
        result.first().map(|id| Value::Number(*id))
    }

    /// The number at `c.beta` or `a[0]` of a scope.
    fn resolve(&mut self, path: &str, scope: &Scope, span: Span) -> Option<ExprId> {
        let expression: Expr = syn::parse_str(path).ok()?;
        let found = self.number(&expression, &mut scope.clone());
        if found.is_none() {
            self.diagnostics.error(span, format!("the argument has no `{path}`"));
        }
        found
    }

    /// `integral(|x| …, a..b)`
    fn integral(&mut self, call: &syn::ExprCall, scope: &mut Scope) -> Option<Value> {
        let parts: Vec<&Expr> = call.args.iter().collect();
        let [Expr::Closure(closure), Expr::Range(range)] = parts.as_slice() else {
            return self.unsupported(call.span(), "an integral of this form", "write `integral(|x| …, a..b)`");
        };
        let variable = match closure.inputs.iter().collect::<Vec<_>>().as_slice() {
            [Pat::Ident(name)] => name.ident.to_string(),
            [Pat::Type(typed)] => match typed.pat.as_ref() {
                Pat::Ident(name) => name.ident.to_string(),
                _ => return self.unsupported(typed.span(), "this variable of integration", "it is a plain name"),
            },
            _ => return self.unsupported(closure.span(), "this integrand", "it has one variable: `|x| …`"),
        };
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.unsupported(range.span(), "an open range", "an integral has two bounds");
        };
        let (lower, upper) = (self.number(start, scope), self.number(end, scope));
        self.integrals += 1;
        let symbol = self.graph.symbol_named(&format!("{variable}@{}", self.integrals));
        let mut inner = scope.clone();
        inner.insert(variable, Value::Number(self.graph.symbol_expression(symbol)));
        let integrand = self.number(&closure.body, &mut inner)?;
        Some(Value::Number(self.graph.integral(symbol, integrand, lower?, upper?)))
    }
}

/// `c.beta` as an identifier: `c_beta`; `a[0]`: `a_0`.
pub fn identifier(symbol: &str) -> String {
    symbol.replace(['.', '['], "_").replace(']', "")
}

/// The one or two symbols whose names make up the suffix of a partial.
pub fn partial_symbols(suffix: &str, names: &[(String, SymbolId)]) -> Option<Vec<SymbolId>> {
    if let Some((_, symbol)) = names.iter().find(|(name, _)| name == suffix) {
        return Some(vec![*symbol]);
    }
    names.iter().find_map(|(first, one)| {
        let rest = suffix.strip_prefix(first.as_str())?.strip_prefix('_')?;
        names.iter().find(|(second, _)| second == rest).map(|(_, other)| vec![*one, *other])
    })
}
