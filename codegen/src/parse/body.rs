//! Follows a function's statements with expressions in place of numbers.

mod calls;
mod chains;
mod choices;
mod methods;
pub(crate) mod partials;
mod result;
mod statements;
mod structs;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Lit, Type, UnOp};

use super::attributes::Approximation;
use super::literal;
use super::module::{Function, Module, ParameterKind};
use super::names::names_of;
use super::numbers;
use super::tabulated::TableSource;
use super::value::Value;
use crate::diagnostics::{Diagnostics, nearest};
use crate::graph::{ExprId, Graph, Node, Role, SymbolId, decimal};

/// Names in scope; those whose value could not be read, which is reported, have none.
type Scope = BTreeMap<String, Option<Value>>;

/// How deep calls of formulas within formulas may go: each is followed on the stack.
const DEEPEST_CALL: usize = 256;

/// Reads bodies of one module's functions into one graph, operation by operation as they are written.
pub struct Reader<'m> {
    /// The module for which is read: its settings hold.
    reading: &'m Module,
    /// The module in which what is read stands: names are looked up there.
    module: &'m Module,
    tables: &'m mut dyn TableSource,
    /// The graph that is written to.
    pub graph: Graph,
    /// What was wrong.
    pub diagnostics: Diagnostics,
    /// How many integrals were read.
    pub integrals: usize,
    /// The partials `f::d_x` that were called: function and partial.
    pub partials: BTreeSet<(String, String)>,
    /// The numbers of parameters that the source names, whatever becomes of them.
    pub named: BTreeSet<SymbolId>,
    /// How many calls are being followed.
    depth: usize,
    /// Whether calls went deeper than they may.
    pub too_deep: bool,
    /// Whether something could not be read for a mistake in a linked module, which reports it.
    pub linked_mistake: bool,
    /// The values of expressions that depend on no input, by position, as far as they were asked for.
    constants: Vec<Option<f64>>,
}

impl<'m> Reader<'m> {
    /// A reader with an empty graph.
    pub fn new(module: &'m Module, tables: &'m mut dyn TableSource) -> Self {
        let mut graph = Graph::as_written();
        graph.sizes = module.sizes;
        Self {
            reading: module,
            module,
            tables,
            graph,
            diagnostics: Diagnostics::default(),
            integrals: 0,
            partials: BTreeSet::new(),
            named: BTreeSet::new(),
            depth: 0,
            too_deep: false,
            linked_mistake: false,
            constants: Vec::new(),
        }
    }

    /// The function's result over symbols named as its parameters. `None` if something was reported.
    pub fn read(&mut self, function: &Function) -> Option<Value> {
        for number in numbers::known(self.module, function) {
            let in_a_struct = number.contains('.');
            if !in_a_struct {
                self.symbol(&Role::Input, &number);
            }
        }
        self.assume_domain(function);
        let arguments = self.symbolic_arguments(function, &Role::Input);
        let value = if function.readable && function.approximation.is_some() {
            let name = function.item.sig.ident.span();
            self.call_or_table(function, arguments, name)?
        } else {
            self.call(function, arguments)?
        };
        for (_, number) in value.numbers() {
            self.note(&Value::Number(number));
        }
        self.check_result(function, &value)?;
        function.readable.then_some(value)
    }

    /// The result of the function's own body, also where calls of it go through a table.
    pub fn read_body(&mut self, function: &Function) -> Option<Value> {
        let arguments = self.symbolic_arguments(function, &Role::Input);
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
        let argument = Some(Value::Number(argument));
        let mut scope = Scope::from([(approximation.variable.to_string(), argument)]);
        self.number(factor, &mut scope)
    }

    /// Declares the function's domains; call it before anything is built.
    fn assume_domain(&mut self, function: &Function) {
        for (symbol, domain, _) in &function.domain {
            // What is no number of the function is reported with the module.
            if numbers::misfit(self.module, function, symbol).is_none() {
                let id = self.symbol(&Role::Input, symbol);
                self.graph.assume(id, *domain);
            }
        }
    }

    /// The symbol of that name, an input in the domain that the module says.
    fn symbol(&mut self, role: &Role, name: &str) -> SymbolId {
        let id = self.graph.symbol_of(role.clone(), name);
        if *role == Role::Input {
            let of_module = self.reading.domain.iter();
            for (_, domain) in of_module.filter(|(known, _)| known == name) {
                self.graph.assume(id, *domain);
            }
        }
        id
    }

    /// Notes a number that is one of a parameter as named in the source.
    fn note(&mut self, value: &Value) {
        if let Value::Number(id) = value
            && let Node::Symbol(symbol) = self.graph.node(*id)
        {
            self.named.insert(*symbol);
        }
    }

    fn symbolic_arguments(&mut self, function: &Function, role: &Role) -> Vec<Value> {
        let module = self.module;
        let mut symbol = |name: String| {
            let id = self.symbol(role, &name);
            Value::Number(self.graph.symbol_expression(id))
        };
        let mut arguments = Vec::new();
        for parameter in &function.parameters {
            let name = parameter.name.to_string();
            arguments.push(match parameter.kind {
                ParameterKind::Number => symbol(name),
                ParameterKind::Array(length) => Value::Array(
                    (0..length)
                        .map(|i| symbol(format!("{name}[{i}]")))
                        .collect(),
                ),
                ParameterKind::Struct => Value::Parameter {
                    path: name,
                    role: role.clone(),
                    fields: module.fields_of(&parameter.ty).map(<[_]>::to_vec),
                    replaced: Vec::new(),
                },
            });
        }
        arguments
    }

    /// The function's result for these arguments.
    fn call(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        if self.depth == DEEPEST_CALL {
            self.too_deep = true;
            let hint = "give the value between two calls as a parameter of a function of its own";
            self.diagnostics.error_with_hint(
                function.item.sig.ident.span(),
                format!("calls of formulas go deeper than {DEEPEST_CALL}"),
                hint,
            );
            return None;
        }
        self.depth += 1;
        let result = self.followed(function, arguments);
        self.depth -= 1;
        result
    }

    fn followed(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        let names = function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        // Parameters that can't be taken are known, so that their uses are not reported too.
        let bound = function.bound_names().into_iter();
        let mut scope: Scope = bound.map(|name| (name, None)).collect();
        scope.extend(names.zip(arguments.into_iter().map(Some)));
        self.block(&function.item.block, &mut scope, true)
    }

    fn expression(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        self.chain(expression, scope)
    }

    /// An expression that begins with no other expression.
    fn first(&mut self, expression: &Expr, scope: &mut Scope) -> Option<Value> {
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => self.path(&path.path, scope),
            Expr::Block(inner) => self.block(&inner.block, &mut scope.clone(), false),
            Expr::Call(call) => self.function_call(call, scope),
            Expr::Field(field) => self.field(field, scope),
            Expr::Index(index) => self.element(index, scope),
            Expr::Tuple(tuple) => self.all(tuple.elems.iter(), scope).map(Value::Tuple),
            Expr::Array(array) => self.all(array.elems.iter(), scope).map(Value::Array),
            Expr::Struct(literal) => self.struct_literal(literal, scope),
            Expr::If(choice) => self.choice(choice, scope),
            Expr::Match(choice) => self.matched(choice, scope),
            Expr::Cast(cast) => self.cast(cast, scope),
            other => self.unsupported_expression(other),
        }
    }

    fn unsupported_expression(&mut self, expression: &Expr) -> Option<Value> {
        let span = expression.span();
        match expression {
            Expr::ForLoop(_) | Expr::While(_) | Expr::Loop(_) => {
                self.unsupported(span, "a loop", "write the terms out, or give the sum as an integral or a function of its own")
            }
            Expr::Macro(_) => self.unsupported(span, "a macro call", "write the expression out"),
            Expr::Assign(_) => self.unsupported(span, "an assignment", "bind the new value with `let`"),
            Expr::Closure(_) => self.unsupported(span, "a closure here", "closures are the integrands of `integral(|x| …, a..b)`"),
            _ => self.unsupported(span, "this expression", "formulas are + - * /, methods such as powi, sqrt, sin and max, `if`, and calls of other formulas"),
        }
    }

    fn unsupported<T>(&mut self, span: Span, what: &str, hint: &str) -> Option<T> {
        self.diagnostics
            .error_with_hint(span, format!("{what} is not a part of a formula"), hint);
        None
    }

    /// Evaluates an expression that must be one number.
    fn number(&mut self, expression: &Expr, scope: &mut Scope) -> Option<ExprId> {
        let value = self.expression(expression, scope)?;
        self.number_of(value, expression)
    }

    /// The one number that the value of an expression must be.
    fn number_of(&mut self, value: Value, expression: &Expr) -> Option<ExprId> {
        match value {
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
                decimal(value.base10_digits())
            }
            Lit::Int(value) if value.suffix() == "f64" => decimal(value.base10_digits()),
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

    /// `2 as f64`: the number that a whole number literal is; what is an `f64` stays as it is.
    fn cast(&mut self, cast: &syn::ExprCast, scope: &mut Scope) -> Option<Value> {
        let hint = "all numbers of a formula are f64: write `2.0`, or `2 as f64`";
        if !matches!(cast.ty.as_ref(), Type::Path(path) if path.path.is_ident("f64")) {
            return self.unsupported(cast.ty.span(), "a cast to another type", hint);
        }
        let (mut inner, mut negative) = (cast.expr.as_ref(), false);
        loop {
            inner = match inner {
                Expr::Paren(paren) => &paren.expr,
                Expr::Group(group) => &group.expr,
                Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                    negative = !negative;
                    &unary.expr
                }
                _ => break,
            };
        }
        if let Expr::Lit(syn::ExprLit {
            lit: Lit::Int(whole),
            ..
        }) = inner
            && !matches!(whole.suffix(), "f32" | "f64")
            && let Some(number) = decimal(whole.base10_digits())
        {
            let number = self.graph.number(if negative { -number } else { number });
            return Some(Value::Number(number));
        }
        let number = self.number(&cast.expr, scope)?;
        Some(Value::Number(number))
    }

    fn path(&mut self, path: &syn::Path, scope: &mut Scope) -> Option<Value> {
        let last = path.segments.last()?;
        let name = last.ident.to_string();
        if path.segments.len() == 1
            && let Some(value) = scope.get(&name)
        {
            let value = value.clone()?;
            self.note(&value);
            return Some(value);
        }
        let module = self.module;
        if let Some((home, name)) = module.constant(path) {
            return self.constant_of(home, name);
        }
        if let Some(standard) = self.module.imports.constant(path)
            && let Some(id) = literal::constant(&mut self.graph, &standard)
        {
            return Some(Value::Number(id));
        }
        if let Some(value) = names_of(path).strip_suffix(std::slice::from_ref(&name))
            && is_type(value)
            && let Some(value) = literal::of_type(&name)
        {
            return Some(Value::Number(self.graph.number(value)));
        }
        if literal::CONSTANTS.contains(&name.as_str()) || path.segments.len() > 1 {
            self.diagnostics.error_with_hint(
                path.span(),
                format!("the value of `{name}` is not known here"),
                "constants are those of the module and of std::f64::consts, by their path or imported in the module, and f64::EPSILON, MAX, MIN and MIN_POSITIVE",
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

    /// The value of a constant of a module.
    fn constant_of(&mut self, home: &'m Module, name: &str) -> Option<Value> {
        if home.cyclic_constants.contains(name) {
            return None;
        }
        let mut constants = home.constants.iter();
        let (_, value) = constants.find(|(constant, _)| constant == name)?;
        self.within(home, |reader| reader.expression(value, &mut Scope::new()))
    }

    /// What work gives that looks names up in another module.
    fn within<T>(&mut self, home: &'m Module, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.module, home);
        let result = work(self);
        self.module = before;
        result
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
                element.inspect(|element| self.note(element))
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
}

/// Whether a path is that of the type `f64`, or of the module of its name that has its constants.
fn is_type(path: &[String]) -> bool {
    matches!(path, [name] | [_, name] if name == "f64")
        && path
            .first()
            .is_some_and(|first| ["f64", "std", "core"].contains(&first.as_str()))
}

/// `c.beta` as an identifier: `c_beta`; `a[0]`: `a_0`; `r#type`: `type_`.
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

/// The one or two symbols whose names make up the suffix of a partial: every way of reading it, which should be one.
pub fn partial_symbols(suffix: &str, names: &[(String, SymbolId)]) -> Vec<Vec<SymbolId>> {
    let named = |wanted: &str| {
        let found = names.iter().filter(move |(name, _)| name == wanted);
        found.map(|(_, symbol)| *symbol).collect::<Vec<_>>()
    };
    let mut ways: BTreeSet<Vec<SymbolId>> =
        named(suffix).into_iter().map(|one| vec![one]).collect();
    for (first, one) in names {
        let rest = suffix.strip_prefix(first.as_str());
        if let Some(rest) = rest.and_then(|rest| rest.strip_prefix('_')) {
            // The order of the two makes no difference.
            ways.extend(
                named(rest)
                    .into_iter()
                    .map(|other| vec![*one.min(&other), *one.max(&other)]),
            );
        }
    }
    ways.into_iter().collect()
}
