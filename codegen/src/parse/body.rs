//! Follows a function's statements with expressions in place of numbers.

mod assignments;
mod branches;
mod calls;
mod chains;
mod choices;
mod crates;
mod iterators;
mod loops;
mod methods;
mod names;
pub(crate) mod partials;
mod patterns;
mod places;
mod result;
mod scalars;
mod scope;
mod statements;
mod structs;

use std::collections::BTreeSet;

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use super::attributes::Approximation;
use super::module::{Function, Module};
use super::numbers;
use super::shape::Shape;
use super::tabulated::TableSource;
use super::value::Value;
use crate::diagnostics::Diagnostics;
use crate::graph::{ExprId, Graph, Node, Role, SymbolId};
use scope::Scope;

/// A loop that nothing says the turns of, with what to write instead.
const ENDLESS: (&str, &str) = (
    "a loop without a range",
    "loop over a range that is known, `for i in 0..N`, or give the sum as an integral or a function of its own",
);

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
    /// The functions whose calls are being followed, by where they are kept.
    callers: BTreeSet<*const Function>,
    /// How many statements were followed.
    statements: usize,
    /// The outermost loop that is being followed.
    outermost_loop: Option<Span>,
    /// Whether calls went deeper, or statements were more, than they may; nothing is followed from there on.
    pub is_beyond: bool,
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
            callers: BTreeSet::new(),
            statements: 0,
            outermost_loop: None,
            is_beyond: false,
            linked_mistake: false,
            constants: Vec::new(),
        }
    }

    /// The function's result over symbols named as its parameters. `None` if something was reported.
    pub fn read(&mut self, function: &Function) -> Option<Value> {
        for number in numbers::known(function) {
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
            if numbers::misfit(function, symbol).is_none() {
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
        let parameters = function.parameters.iter();
        parameters
            .map(|parameter| self.symbolic(&parameter.shape, parameter.name.to_string(), role))
            .collect()
    }

    /// A value over symbols of that name; those of a struct are made when its fields are read.
    fn symbolic(&mut self, shape: &Shape, path: String, role: &Role) -> Value {
        match shape {
            Shape::Number => {
                let id = self.symbol(role, &path);
                Value::Number(self.graph.symbol_expression(id))
            }
            Shape::Array(element, length) => {
                let places = 0..*length;
                let elements =
                    places.map(|place| self.symbolic(element, format!("{path}[{place}]"), role));
                Value::Array(elements.collect())
            }
            Shape::Struct(of, fields) => Value::Parameter {
                path,
                of: of.clone(),
                role: role.clone(),
                fields: fields.clone(),
                replaced: Vec::new(),
            },
        }
    }

    /// The function's result for these arguments.
    fn call(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        if self.is_beyond {
            return None;
        }
        let callee = std::ptr::from_ref(function);
        // Which method is called is known only here, so that methods that call each other are not found before.
        let again = self.callers.contains(&callee);
        if again || self.callers.len() == DEEPEST_CALL {
            self.is_beyond = true;
            let (message, hint) = if again {
                let message = format!("`{}` needs its own value", function.name());
                (message, "write the terms out")
            } else {
                let message = format!("calls of formulas go deeper than {DEEPEST_CALL}");
                let hint =
                    "give the value between two calls as a parameter of a function of its own";
                (message, hint)
            };
            let span = function.item.sig.ident.span();
            self.diagnostics.error_with_hint(span, message, hint);
            return None;
        }
        self.callers.insert(callee);
        let result = self.followed(function, arguments);
        self.callers.remove(&callee);
        result
    }

    fn followed(&mut self, function: &Function, arguments: Vec<Value>) -> Option<Value> {
        let names = function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        // Parameters that can't be taken are known, so that their uses are not reported too.
        let bound = function.bound_names().into_iter();
        let mut scope = Scope::from(bound.map(|name| (name, None)));
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
            Expr::Block(inner) => self.block(&inner.block, scope, false),
            Expr::Assign(assign) => self.assignment(assign, scope),
            Expr::Binary(binary) => self.compound(binary, scope),
            Expr::ForLoop(turns) => self.for_loop(turns, scope),
            Expr::Range(range) => self.range(range, scope),
            Expr::Call(call) => self.function_call(call, scope),
            Expr::Field(_) | Expr::Index(_) => self.access(expression, scope),
            Expr::Tuple(tuple) => self.all(tuple.elems.iter(), scope).map(Value::Tuple),
            Expr::Array(array) => self.all(array.elems.iter(), scope).map(Value::Array),
            Expr::Repeat(repeat) => self.repeated(repeat, scope),
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
            Expr::While(_) | Expr::Loop(_) => self.unsupported(span, ENDLESS.0, ENDLESS.1),
            Expr::Macro(_) => self.unsupported(span, "a macro call", "write the expression out"),
            Expr::Closure(_) => self.unsupported(span, "a closure here", "closures are the integrands of `integral(|x| …, a..b)`, and what `map` and `fold` of an array call"),
            _ => self.unsupported(span, "this expression", "formulas are + - * /, methods such as powi, sqrt, sin and max, `if`, and calls of other formulas"),
        }
    }

    fn unsupported<T>(&mut self, span: Span, what: &str, hint: &str) -> Option<T> {
        self.diagnostics
            .error_with_hint(span, format!("{what} is not a part of a formula"), hint);
        None
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
