//! Formulas from Rust to Python, statement by statement, so that every tool reads the text that the generator reads.
//!
//! A function `f(x, c)` becomes `def f(op, x, c)`, in which `op` is what the tool at hand computes with: it has `number`,
//! `constant`, `sqrt` and the like, and `table` for functions that are tabulated here. Arrays become lists, structs
//! namespaces, a partial `f::d_x(…)` a call of `op.partial`.

use std::collections::BTreeSet;
use std::fmt::Write;

use syn::{Attribute, BinOp, Expr, FnArg, Item, ItemFn, Lit, Member, Pat, Stmt, UnOp};

/// What has no counterpart in Python here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TranslationError {
    /// The source is no Rust, or has no module of formulas.
    #[error("the source can't be read: {0}")]
    Source(String),
    /// A statement or expression that the translation does not know.
    #[error("`{function}` holds {what}, which is not translated")]
    Unknown {
        /// The function.
        function: String,
        /// What it holds.
        what: String,
    },
}

/// All functions of the modules of formulas in source texts, which may call each other's, as Python.
///
/// # Errors
/// A text is no Rust, has no module of formulas, or uses something outside the language of formulas.
pub fn module<'a>(sources: impl IntoIterator<Item = &'a str>) -> Result<String, TranslationError> {
    let mut items = Vec::new();
    for source in sources {
        let file =
            syn::parse_file(source).map_err(|error| TranslationError::Source(error.to_string()))?;
        let modules = file.items.into_iter().filter_map(|item| match item {
            Item::Mod(item) if has(&item.attrs, "symbolic") => item.content,
            _ => None,
        });
        let mut found = 0;
        for (_, content) in modules {
            items.extend(content);
            found += 1;
        }
        if found == 0 {
            let missing = "no module `symbolic`".to_owned();
            return Err(TranslationError::Source(missing));
        }
    }
    let mut functions: Vec<&ItemFn> = Vec::new();
    let mut text = String::new();
    let mut constants = BTreeSet::new();
    for item in &items {
        match item {
            Item::Fn(function) => functions.push(function),
            Item::Const(constant) => {
                constants.insert(constant.ident.to_string());
            }
            _ => {}
        }
    }
    for item in &items {
        if let Item::Const(constant) = item {
            let name = constant.ident.to_string();
            let translator = Translator {
                function: &name,
                constants: &constants,
                functions: &functions,
            };
            let value = translator.expression(&constant.expr)?;
            // Writing to a string can't fail.
            let _ = write!(text, "def {name}(op):\n    return {value}\n\n\n");
        }
    }
    for function in &functions {
        let name = function.sig.ident.to_string();
        let translator = Translator {
            function: &name,
            constants: &constants,
            functions: &functions,
        };
        text.push_str(&translator.function(function)?);
    }
    Ok(text)
}

/// Whether one of the attributes is of that name, in whatever module.
fn has(attributes: &[Attribute], name: &str) -> bool {
    attributes.iter().any(|attribute| {
        let last = attribute.path().segments.last();
        last.is_some_and(|segment| segment.ident == name)
    })
}

/// The names of a function's parameters.
fn parameters(function: &ItemFn) -> Vec<String> {
    let name = |input: &FnArg| match input {
        FnArg::Typed(typed) => match &*typed.pat {
            Pat::Ident(name) => Some(name.ident.to_string()),
            _ => None,
        },
        FnArg::Receiver(_) => None,
    };
    function.sig.inputs.iter().filter_map(name).collect()
}

/// One function on its way.
struct Translator<'a> {
    function: &'a str,
    constants: &'a BTreeSet<String>,
    functions: &'a [&'a ItemFn],
}

impl Translator<'_> {
    fn unknown(&self, what: &str) -> TranslationError {
        TranslationError::Unknown {
            function: self.function.to_owned(),
            what: what.to_owned(),
        }
    }

    fn function(&self, function: &ItemFn) -> Result<String, TranslationError> {
        let names = parameters(function);
        let mut text = format!("def {}(op, {}):\n", self.function, names.join(", "));
        if has(&function.attrs, "approximate") {
            let _ = write!(
                text,
                "    return op.table(\"{}\", {})\n\n\n",
                self.function, names[0]
            );
            return Ok(text);
        }
        for statement in &function.block.stmts {
            let line = match statement {
                Stmt::Local(local) => {
                    let value = local.init.as_ref().map(|init| self.expression(&init.expr));
                    let value = value.ok_or_else(|| self.unknown("a `let` without a value"))??;
                    format!("{} = {value}", self.pattern(&local.pat)?)
                }
                Stmt::Expr(value, None) => format!("return {}", self.expression(value)?),
                _ => return Err(self.unknown("a statement that is neither `let` nor the result")),
            };
            let _ = writeln!(text, "    {line}");
        }
        text.push_str("\n\n");
        Ok(text)
    }

    fn pattern(&self, pattern: &Pat) -> Result<String, TranslationError> {
        match pattern {
            Pat::Ident(name) => Ok(name.ident.to_string()),
            Pat::Type(typed) => self.pattern(&typed.pat),
            Pat::Tuple(tuple) => {
                let parts: Result<Vec<_>, _> =
                    tuple.elems.iter().map(|part| self.pattern(part)).collect();
                Ok(format!("({},)", parts?.join(", ")))
            }
            _ => Err(self.unknown("a pattern that is neither a name nor a tuple")),
        }
    }

    fn list<'e>(
        &self,
        values: impl IntoIterator<Item = &'e Expr>,
    ) -> Result<String, TranslationError> {
        let values: Result<Vec<_>, _> = values
            .into_iter()
            .map(|value| self.expression(value))
            .collect();
        Ok(values?.join(", "))
    }

    fn expression(&self, expression: &Expr) -> Result<String, TranslationError> {
        Ok(match expression {
            Expr::Lit(literal) => self.literal(&literal.lit)?,
            Expr::Path(path) => self.name(&path.path),
            Expr::Paren(inner) => format!("({})", self.expression(&inner.expr)?),
            Expr::Reference(inner) => self.expression(&inner.expr)?,
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                format!("(-{})", self.expression(&unary.expr)?)
            }
            Expr::Binary(binary) => {
                let operator = match binary.op {
                    BinOp::Add(_) => "+",
                    BinOp::Sub(_) => "-",
                    BinOp::Mul(_) => "*",
                    BinOp::Div(_) => "/",
                    _ => return Err(self.unknown("an operator other than + - * /")),
                };
                let (left, right) = (&binary.left, &binary.right);
                format!(
                    "{} {operator} {}",
                    self.expression(left)?,
                    self.expression(right)?
                )
            }
            Expr::MethodCall(call) => {
                let arguments = self.list(std::iter::once(&*call.receiver).chain(&call.args))?;
                format!("op.{}({arguments})", call.method)
            }
            Expr::Field(field) => {
                let base = self.expression(&field.base)?;
                match &field.member {
                    Member::Named(name) => format!("{base}.{name}"),
                    Member::Unnamed(index) => format!("{base}[{}]", index.index),
                }
            }
            Expr::Index(index) => match &*index.index {
                Expr::Lit(place) => match &place.lit {
                    Lit::Int(place) => {
                        format!(
                            "{}[{}]",
                            self.expression(&index.expr)?,
                            place.base10_digits()
                        )
                    }
                    _ => return Err(self.unknown("an index that is no whole number")),
                },
                _ => return Err(self.unknown("an index that is no whole number")),
            },
            Expr::Array(array) => format!("[{}]", self.list(&array.elems)?),
            Expr::Tuple(tuple) => format!("({},)", self.list(&tuple.elems)?),
            Expr::Struct(literal) => {
                let field = |field: &syn::FieldValue| match &field.member {
                    Member::Named(name) => Ok(format!("{name}={}", self.expression(&field.expr)?)),
                    Member::Unnamed(_) => Err(self.unknown("a struct without names")),
                };
                let fields: Result<Vec<_>, _> = literal.fields.iter().map(field).collect();
                format!("op.struct({})", fields?.join(", "))
            }
            Expr::Call(call) => self.call(call)?,
            _ => return Err(self.unknown("an expression outside the language of formulas")),
        })
    }

    fn literal(&self, literal: &Lit) -> Result<String, TranslationError> {
        match literal {
            Lit::Float(value) => Ok(format!("op.number(\"{}\")", value.base10_digits())),
            Lit::Int(value) => Ok(value.base10_digits().to_owned()),
            _ => Err(self.unknown("a literal that is no number")),
        }
    }

    /// A parameter, a binding, a constant of the module or of the standard library.
    fn name(&self, path: &syn::Path) -> String {
        let last = path
            .segments
            .last()
            .map(|segment| segment.ident.to_string());
        let last = last.unwrap_or_default();
        if path.segments.len() > 1 {
            format!("op.constant(\"{last}\")")
        } else if self.constants.contains(&last) {
            format!("{last}(op)")
        } else {
            last
        }
    }

    fn call(&self, call: &syn::ExprCall) -> Result<String, TranslationError> {
        let Expr::Path(path) = &*call.func else {
            return Err(self.unknown("a call of something without a name"));
        };
        let segments: Vec<String> = path
            .path
            .segments
            .iter()
            .map(|part| part.ident.to_string())
            .collect();
        let arguments = self.list(&call.args)?;
        match segments.as_slice() {
            [name] => Ok(format!("{name}(op, {arguments})")),
            [name, partial] => {
                let by = partial.strip_prefix("d_").unwrap_or_default();
                let function = self
                    .functions
                    .iter()
                    .find(|function| function.sig.ident == *name);
                let place = function.and_then(|function| {
                    parameters(function)
                        .iter()
                        .position(|parameter| parameter == by)
                });
                let place =
                    place.ok_or_else(|| self.unknown("a partial of an unknown function"))?;
                Ok(format!("op.partial({name}, {place}, {arguments})"))
            }
            _ => Err(self.unknown("a call of a function elsewhere")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_translated_as_it_stands() {
        let source = "
            #[symbolic]
            mod m {
                const K: f64 = 0.5;
                pub fn f(x: f64, c: &C) -> f64 { K * (x - c.a).powi(2) / std::f64::consts::PI }
                pub fn g(x: f64, c: &C) -> (f64, f64) {
                    let (y, z) = (-f::d_x(x, c), [x, 1.0][1]);
                    (y.sqrt(), f(z, c))
                }
            }";
        let expected = "def K(op):\n    return op.number(\"0.5\")\n\n\n\
            def f(op, x, c):\n    return K(op) * op.powi((x - c.a), 2) / op.constant(\"PI\")\n\n\n\
            def g(op, x, c):\n    (y, z,) = ((-op.partial(f, 0, x, c)), [x, op.number(\"1.0\")][1],)\n    \
            return (op.sqrt(y), f(op, z, c),)\n\n\n";
        assert_eq!(module([source]).unwrap(), expected);
    }

    #[test]
    fn what_is_unknown_is_an_error() {
        let source = "#[symbolic] mod m { fn f(x: f64) -> f64 { if x > 0.0 { x } else { 0.0 } } }";
        assert!(matches!(
            module([source]),
            Err(TranslationError::Unknown { .. })
        ));
        assert!(matches!(
            module(["mod m {}"]),
            Err(TranslationError::Source(_))
        ));
    }
}
