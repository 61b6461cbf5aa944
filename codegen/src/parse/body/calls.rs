//! Calls of other formulas, of their partials and tables, and integrals.

use std::sync::Arc;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Ident, Pat};

use super::{Reader, Scope};
use crate::diagnostics::{Diagnostics, nearest};
use crate::graph::Role;
use crate::parse::known_methods;
use crate::parse::module::Function;
use crate::parse::names::{Callee, Kind, Miss, names_of};
use crate::parse::shape::Shape;
use crate::parse::value::Value;

const WHERE_FORMULAS_ARE: &str =
    "formulas call formulas of their own module, and those of modules that it links by `with(…)`";

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
        let span = path.path.span();
        let module = self.module;
        let own = |name: &Ident| module.function(&name.to_string());
        let plain = path.path.get_ident();
        if plain.is_some_and(|name| name == "integral" && own(name).is_none()) {
            return self.integral(call, scope);
        }
        let Some((callee, form)) = module.callee(&path.path) else {
            if let [of, method] = names_of(&path.path).as_slice()
                && of == "f64"
                && method == "from"
            {
                return self.number_from(call, scope);
            }
            if let [of, method] = names_of(&path.path).as_slice()
                && of == "f64"
                && let Some(last) = path.path.segments.last()
                && last.ident == method
            {
                return self.method_as_function(&last.ident, &call.args, call.span(), scope);
            }
            if let Some(function) = module.imports.of_crate(&path.path) {
                return self.function_of_crate(function, call, scope);
            }
            self.report_unknown_function(&path.path);
            self.all(call.args.iter(), scope);
            return None;
        };
        let Callee { home, function } = callee;
        let partial = form.filter(|form| form != "value");
        if let Some(partial) = &partial
            && home.key == self.reading.key
        {
            // Entered before it is known to exist, so that a call of one that does not is reported once.
            self.partials.insert((function.name(), partial.clone()));
        }
        let arguments = self.all(call.args.iter(), scope);
        let places: Vec<Span> = call.args.iter().map(Spanned::span).collect();
        let arguments = self.arguments(callee, arguments, &places, call.span())?;
        self.within(home, |reader| match partial {
            Some(partial) => reader.partial(function, &partial, arguments, span),
            None => reader.call_or_table(function, arguments, span),
        })
    }

    /// `c.method(…)`: a formula in an `impl` block of the struct.
    pub(super) fn method_of_struct(
        &mut self,
        call: &syn::ExprMethodCall,
        receiver: Value,
        scope: &mut Scope,
    ) -> Option<Value> {
        let of = match &receiver {
            Value::Parameter { of, .. } => of.clone(),
            Value::Struct { name, .. } => name
                .rsplit("::")
                .next()
                .unwrap_or_default()
                .trim()
                .to_owned(),
            _ => return None,
        };
        let name = call.method.to_string();
        let others = self.all(call.args.iter(), scope);
        if name == "clone" && call.args.is_empty() {
            return Some(receiver);
        }
        let module = self.module;
        let callee = match *module.methods(&of, &name).as_slice() {
            [callee] => callee,
            [] => {
                let message = format!("`{of}` has no method `{name}` here");
                let hint = "formulas call methods in `impl` blocks of their own module, and of those that it links by `with(…)`";
                self.diagnostics
                    .error_with_hint(call.method.span(), message, hint);
                return None;
            }
            [..] => {
                let what = format!("`{name}` of several structs `{of}`");
                let hint = "give one of the structs another name";
                return self.unsupported(call.method.span(), &what, hint);
            }
        };
        let arguments = others.map(|others| {
            let mut all = vec![receiver];
            all.extend(others);
            all
        });
        let mut places = vec![call.receiver.span()];
        places.extend(call.args.iter().map(Spanned::span));
        let arguments = self.arguments(callee, arguments, &places, call.span())?;
        let Callee { home, function } = callee;
        self.within(home, |reader| {
            reader.call_or_table(function, arguments, call.method.span())
        })
    }

    /// Reports a call of what is no formula that is known here.
    fn report_unknown_function(&mut self, path: &syn::Path) {
        let span = path.span();
        let names = names_of(path);
        if self.module.is_of_refused(&names) {
            return;
        }
        if let Err(Miss::Ambiguous(places)) = self.module.find(&names, Kind::Function) {
            let places: Vec<String> = places.iter().map(|place| format!("`{place}`")).collect();
            self.diagnostics.error_with_hint(
                span,
                format!("`{}` is in each of {}", names.join("::"), places.join(", ")),
                "import the one that is meant by its name, or call it by its path",
            );
            return;
        }
        if self.report_unknown_of_crate(&names, span) {
            return;
        }
        let (message, known) = match (names.as_slice(), self.module.module_of(&names)) {
            ([.., name], Some(linked)) => {
                let functions = linked.module.functions.iter();
                let functions = functions.map(|function| function.name()).collect();
                let message = format!("`{}` has no formula `{name}`", linked.place.text());
                (message, (name, functions))
            }
            ([name], None) => {
                let message = format!("unknown function `{name}`");
                (message, (name, self.module.functions_in_sight()))
            }
            ([of, name], None) if self.module.structs.iter().any(|(known, _)| known == of) => {
                let functions = self.module.functions.iter();
                let functions = functions.filter_map(|known| {
                    let of_it = known.of.as_ref().is_some_and(|its| its == of);
                    of_it.then(|| known.item.sig.ident.to_string())
                });
                let message = format!("`{of}` has no function `{name}` here");
                (message, (name, functions.collect()))
            }
            ([name, _], None) if !matches!(name.as_str(), "super" | "crate" | "self") => {
                let message = format!("unknown function `{name}`");
                (message, (name, self.module.functions_in_sight()))
            }
            _ => {
                self.unsupported::<()>(span, "a call outside the module", WHERE_FORMULAS_ARE);
                return;
            }
        };
        let (name, functions): (&String, Vec<String>) = known;
        let is_method = known_methods::all().any(|(method, _)| method == name);
        let hint = match nearest(name, functions.iter().map(String::as_str)) {
            _ if is_method => format!("it is a method: write `x.{name}(…)` or `f64::{name}(x, …)`"),
            Some(candidate) => format!("did you mean `{candidate}`?"),
            None => WHERE_FORMULAS_ARE.to_owned(),
        };
        // Of a path the name in the module is wrong.
        let last = path.segments.last().filter(|_| names.len() > 1);
        let span = match (last, self.module.module_of(&names)) {
            (Some(last), Some(_)) => last.ident.span(),
            _ => span,
        };
        self.diagnostics.error_with_hint(span, message, hint);
    }

    fn arguments(
        &mut self,
        Callee { home, function }: Callee<'m>,
        arguments: Option<Vec<Value>>,
        places: &[Span],
        call: Span,
    ) -> Option<Vec<Value>> {
        let linked = home.key != self.reading.key;
        let expected = function.parameters.len();
        if !function.readable {
            // It is reported where it stands.
            self.linked_mistake |= linked;
            return None;
        }
        if places.len() != expected {
            let names: Vec<String> = function
                .parameters
                .iter()
                .map(|parameter| parameter.name.to_string())
                .collect();
            self.diagnostics.error_with_hint(
                call,
                format!(
                    "`{}` takes {expected} argument{}, not {}",
                    function.name(),
                    if expected == 1 { "" } else { "s" },
                    places.len()
                ),
                format!("it is {}({})", function.name(), names.join(", ")),
            );
            return None;
        }
        let arguments = arguments?;
        let mut all_fit = true;
        for ((argument, parameter), place) in arguments.iter().zip(&function.parameters).zip(places)
        {
            if !suits(&parameter.shape, argument) {
                let hint = match &parameter.shape {
                    Shape::Number => "it is a number".to_owned(),
                    Shape::Array(element, length) if **element == Shape::Number => {
                        format!("it is an array of {length} numbers")
                    }
                    Shape::Array(_, length) => format!("it is an array of {length} elements"),
                    Shape::Struct(..) => "it is a struct".to_owned(),
                };
                self.diagnostics.error_with_hint(
                    *place,
                    format!(
                        "`{}` of `{}` can't be {}",
                        parameter.name,
                        function.name(),
                        match argument {
                            Value::Array(_) => "this array",
                            other => other.description(),
                        }
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
            if result.is_none() && !self.is_beyond {
                let reasons = self.diagnostics.split_off(before);
                self.explain_failed_call(function, &reasons, span);
            }
            return result;
        };
        // A table that could not be made is reported where its function stands.
        let (reading, home) = (self.reading, self.module);
        let table = self.tables.table(reading, home, function, approximation);
        self.linked_mistake |= table.is_none() && home.key != reading.key;
        let table = table?.clone();
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
        let linked = self.module.key != self.reading.key;
        let mut sketched = self.tables.sketched_apart();
        let tables = if linked {
            sketched.as_mut()
        } else {
            &mut *self.tables
        };
        let alone = Reader::new(self.module, tables).read(function);
        self.linked_mistake |= linked && alone.is_none();
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
        let mark = scope.enter();
        let value = Value::Number(self.graph.symbol_expression(symbol));
        scope.bind(variable, Some(value));
        let integrand = self.number(&closure.body, scope);
        scope.leave(mark);
        Some(Value::Number(
            self.graph.integral(symbol, integrand?, lower?, upper?),
        ))
    }
}

/// Whether a value may be given for a parameter.
fn suits(shape: &Shape, value: &Value) -> bool {
    match (shape, value) {
        (Shape::Number, Value::Number(_)) => true,
        (Shape::Array(element, length), Value::Array(values)) => {
            values.len() == *length && values.iter().all(|value| suits(element, value))
        }
        (Shape::Struct(..), Value::Parameter { .. } | Value::Struct { .. }) => true,
        _ => false,
    }
}
