//! Constructs of the language as LaTeX.

use std::collections::{BTreeMap, BTreeSet};

use quote::ToTokens;
use syn::visit::Visit;
use syn::{BinOp, Expr, ExprCall, ExprField, Lit, Member, Pat, Stmt, UnOp};

use super::piece::{Piece, Precedence, delimited, parentheses};
use super::{Line, bound_names, type_name};
use crate::parse::module::{Function, Module};
use crate::parse::shape::Shape;
use crate::symbols::{Symbols, with_subscript};

/// What the names of one function stand for.
pub(super) struct Names<'a> {
    module: &'a Module,
    symbols: &'a Symbols,
    function: &'a Function,
    /// Parameters that are not written, for their fields stand for them.
    silent: BTreeSet<String>,
    /// Fields that several structs have here, so that they are written with their struct.
    ambiguous: BTreeSet<String>,
}

impl<'a> Names<'a> {
    /// The names of a function.
    pub(super) fn of(module: &'a Module, symbols: &'a Symbols, function: &'a Function) -> Self {
        let mut fields = Fields::default();
        fields.visit_block(&function.item.block);
        let ambiguous = fields
            .bases
            .into_iter()
            .filter(|(_, bases)| bases.len() > 1)
            .map(|(field, _)| field)
            .collect();
        let structs = || {
            function
                .parameters
                .iter()
                .filter(|parameter| matches!(parameter.shape, Shape::Struct(..)))
        };
        let alone = |name: &Option<String>| {
            structs()
                .filter(|other| type_name(&other.ty) == *name)
                .count()
                == 1
        };
        let silent = structs()
            .filter(|parameter| alone(&type_name(&parameter.ty)))
            .map(|parameter| parameter.name.to_string())
            .collect();
        Self {
            module,
            symbols,
            function,
            silent,
            ambiguous,
        }
    }
}

/// Which structs each field is taken from.
#[derive(Default)]
struct Fields {
    bases: BTreeMap<String, BTreeSet<String>>,
}

impl<'ast> Visit<'ast> for Fields {
    fn visit_expr_field(&mut self, field: &'ast ExprField) {
        let (base, member) = (
            field.base.to_token_stream().to_string(),
            field.member.to_token_stream().to_string(),
        );
        self.bases.entry(member).or_default().insert(base);
        syn::visit::visit_expr_field(self, field);
    }
}

/// Writes one function's body.
pub(super) struct Writer<'a> {
    names: Names<'a>,
    /// Symbols of bindings, where they are not by the plain rule.
    pub(super) bound: BTreeMap<String, String>,
    /// The bindings so far.
    pub(super) lines: Vec<Line>,
}

pub(super) type Written = syn::Result<Piece>;

pub(super) fn unsupported<T>(tokens: &impl ToTokens) -> syn::Result<T> {
    Err(syn::Error::new_spanned(
        tokens,
        format!("`{}` is not typeset", tokens.to_token_stream()),
    ))
}

impl<'a> Writer<'a> {
    pub(super) fn new(names: Names<'a>) -> Self {
        Self {
            names,
            bound: BTreeMap::new(),
            lines: Vec::new(),
        }
    }

    /// A name in LaTeX.
    pub(super) fn symbol(&self, name: &str) -> String {
        self.bound
            .get(name)
            .cloned()
            .unwrap_or_else(|| self.names.symbols.latex(name))
    }

    /// The function's arguments in parentheses, nothing where it has none to write.
    pub(super) fn signature(&self) -> String {
        let parameters = self
            .names
            .function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        let written: Vec<String> = parameters
            .filter(|name| !self.names.silent.contains(name))
            .map(|name| self.symbol(&name))
            .collect();
        if written.is_empty() {
            String::new()
        } else {
            parentheses(&written.join(", "))
        }
    }

    /// Writes a `let` as a line of its own.
    pub(super) fn binding(&mut self, statement: &Stmt) -> syn::Result<()> {
        let local = match statement {
            Stmt::Local(local) => local,
            Stmt::Item(syn::Item::Const(constant)) => {
                let (name, terms) = (constant.ident.to_string(), self.terms(&constant.expr)?);
                let symbol = self.names.symbols.latex(&name);
                self.bound.insert(name, symbol.clone());
                self.lines.push(Line::new(symbol, &terms));
                return Ok(());
            }
            Stmt::Expr(Expr::ForLoop(turns), _) => {
                let message = "a loop is not typeset";
                return Err(syn::Error::new_spanned(turns.for_token, message));
            }
            _ => return unsupported(statement),
        };
        let Some(init) = &local.init else {
            return unsupported(local);
        };
        let names = bound_names(&local.pat)?;
        if let [name] = names.as_slice()
            && let Some(square) = self.square(name, &init.expr)
        {
            self.bound.insert(name.clone(), square);
            return Ok(());
        }
        let terms = self.terms(&init.expr)?;
        let mut symbols = Vec::new();
        for name in names {
            let again = self.bound.contains_key(&name)
                || self
                    .names
                    .function
                    .parameters
                    .iter()
                    .any(|known| known.name == name);
            let symbol = if again {
                format!("{}'", self.symbol(&name))
            } else {
                self.names.symbols.latex(&name)
            };
            self.bound.insert(name, symbol.clone());
            symbols.push(symbol);
        }
        let left = match (symbols.as_slice(), &local.pat) {
            ([symbol], pattern) if !matches!(pattern, Pat::Tuple(_)) => symbol.clone(),
            (symbols, _) => parentheses(&symbols.join(", ")),
        };
        self.lines.push(Line::new(left, &terms));
        Ok(())
    }

    /// A square named after its root, `gamma_2` for the square of `gamma`, is written as such where it is used.
    fn square(&self, name: &str, value: &Expr) -> Option<String> {
        let Expr::MethodCall(call) = peeled(value) else {
            return None;
        };
        let root = match peeled(&call.receiver) {
            Expr::Path(path) => path.path.get_ident()?.to_string(),
            Expr::Field(field) => field.member.to_token_stream().to_string(),
            _ => return None,
        };
        let squared = call.method == "powi" && call.args.to_token_stream().to_string() == "2";
        (squared && name == format!("{root}_2"))
            .then(|| Piece::atom(self.symbol(&root)).raised_to("2").text)
    }

    /// The terms of an expression, each with its sign where it is not the first.
    pub(super) fn terms(&mut self, expression: &Expr) -> syn::Result<Vec<String>> {
        match expression {
            Expr::Binary(binary) if matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)) => {
                let mut terms = self.terms(&binary.left)?;
                let right = self.piece(&binary.right)?;
                // Parentheses around a sum that is added say nothing but how it is rounded.
                let (negative, text) = match (&binary.op, right.precedence) {
                    (BinOp::Add(_), Precedence::Sum) if !right.text.starts_with('-') => {
                        (false, right.text)
                    }
                    _ => right.term(),
                };
                let minus = negative != matches!(binary.op, BinOp::Sub(_));
                terms.push(format!("{} {text}", if minus { "-" } else { "+" }));
                Ok(terms)
            }
            Expr::Paren(inner) => self.terms(&inner.expr),
            Expr::Group(inner) => self.terms(&inner.expr),
            other => Ok(vec![self.piece(other)?.text]),
        }
    }

    pub(super) fn piece(&mut self, expression: &Expr) -> Written {
        match expression {
            Expr::Lit(literal) => number(&literal.lit),
            Expr::Path(path) => Ok(self.path(&path.path)),
            Expr::Paren(inner) => self.piece(&inner.expr),
            Expr::Group(inner) => self.piece(&inner.expr),
            Expr::Reference(inner) => self.piece(&inner.expr),
            Expr::Block(block) => self.block(&block.block),
            Expr::Unary(unary) => match unary.op {
                UnOp::Deref(_) => self.piece(&unary.expr),
                UnOp::Neg(_) => Ok(self.piece(&unary.expr)?.negative()),
                UnOp::Not(_) => self.negation(&unary.expr),
                _ => unsupported(expression),
            },
            Expr::Binary(binary) => match binary.op {
                BinOp::Add(_) | BinOp::Sub(_) => Ok(Piece::new(
                    self.terms(expression)?.join(" "),
                    Precedence::Sum,
                )),
                BinOp::Mul(_) => Ok(self.piece(&binary.left)?.times(self.piece(&binary.right)?)),
                BinOp::Div(_) => Ok(self.piece(&binary.left)?.over(self.piece(&binary.right)?)),
                _ => self.logical(binary),
            },
            Expr::MethodCall(call) => {
                let arguments: Vec<&Expr> = call.args.iter().collect();
                self.method(&call.method, &call.receiver, &arguments)
            }
            Expr::If(choice) => self.choice(choice),
            Expr::Match(choice) => self.matched(choice),
            Expr::Cast(cast) => self.piece(&cast.expr),
            Expr::Call(call) => self.call(call),
            Expr::Field(field) => Ok(self.field(field)),
            Expr::Index(index) => {
                let base = self.piece(&index.expr)?.at_least(Precedence::Atom);
                let position = self.piece(&index.index)?;
                Ok(Piece::atom(with_subscript(&base, &position.text)))
            }
            Expr::Tuple(tuple) => Ok(Piece::atom(parentheses(&self.list(&tuple.elems)?))),
            Expr::Array(array) => Ok(Piece::atom(delimited("[", &self.list(&array.elems)?, "]"))),
            Expr::Struct(literal) => self.struct_literal(literal),
            other => unsupported(other),
        }
    }

    pub(super) fn list<'e>(
        &mut self,
        expressions: impl IntoIterator<Item = &'e Expr>,
    ) -> syn::Result<String> {
        let texts: syn::Result<Vec<String>> = expressions
            .into_iter()
            .map(|expression| Ok(self.piece(expression)?.text))
            .collect();
        Ok(texts?.join(", "))
    }

    /// A block's value; its bindings become lines of the formula.
    pub(super) fn block(&mut self, block: &syn::Block) -> Written {
        let Some((Stmt::Expr(value, None), bindings)) = block.stmts.split_last() else {
            return unsupported(block);
        };
        for binding in bindings {
            self.binding(binding)?;
        }
        self.piece(value)
    }

    fn struct_literal(&mut self, literal: &syn::ExprStruct) -> Written {
        let mut fields = Vec::new();
        for field in &literal.fields {
            let value = self.piece(&field.expr)?.text;
            fields.push(format!(
                "{} = {value}",
                self.names
                    .symbols
                    .latex(&field.member.to_token_stream().to_string())
            ));
        }
        Ok(Piece::atom(parentheses(&fields.join(",\\; "))))
    }

    fn path(&self, path: &syn::Path) -> Piece {
        let name = path
            .segments
            .last()
            .map(|last| last.ident.to_string())
            .unwrap_or_default();
        let own = self.bound.contains_key(&name)
            || self
                .names
                .function
                .parameters
                .iter()
                .any(|parameter| parameter.name == name)
            || self
                .names
                .module
                .constants
                .iter()
                .any(|(constant, _)| *constant == name);
        let of_type = path.segments.len() > 1 && name == "EPSILON";
        if of_type {
            return Piece::atom("2").raised_to("-52");
        }
        if !own && let Some(constant) = constant(&name) {
            return constant;
        }
        symbol_piece(self.symbol(&name))
    }

    fn field(&self, field: &ExprField) -> Piece {
        let member = match &field.member {
            Member::Named(name) => name.to_string(),
            Member::Unnamed(index) => {
                let base = self.symbol(&field.base.to_token_stream().to_string());
                return Piece::atom(with_subscript(&base, &(index.index + 1).to_string()));
            }
        };
        let symbol = self.names.symbols.latex(&member);
        if self.names.ambiguous.contains(&member) {
            let base = self.symbol(&field.base.to_token_stream().to_string());
            return Piece::atom(format!("{base}.{symbol}"));
        }
        symbol_piece(symbol)
    }

    fn call(&mut self, call: &ExprCall) -> Written {
        let Expr::Path(path) = call.func.as_ref() else {
            return unsupported(call);
        };
        let module = self.names.module;
        let called = path.path.segments.iter();
        let segments: Vec<String> = called.map(|segment| segment.ident.to_string()).collect();
        match (segments.as_slice(), module.callee(&path.path)) {
            ([name], None) if name == "integral" => self.integral(call),
            ([of, _], None) if of == "f64" => {
                let arguments: Vec<&Expr> = call.args.iter().collect();
                match (path.path.segments.last(), arguments.split_first()) {
                    (Some(method), Some((receiver, rest))) => {
                        self.method(&method.ident, receiver, rest)
                    }
                    _ => unsupported(call),
                }
            }
            ([.., name], None) if module.imports.of_crate(&path.path).is_some() => {
                let arguments = self.arguments(call)?;
                Ok(Piece::atom(
                    format!("\\operatorname{{{name}}}") + &arguments,
                ))
            }
            ([name], None) => {
                let arguments = self.arguments(call)?;
                Ok(Piece::atom(self.names.symbols.latex(name) + &arguments))
            }
            (_, Some((callee, None))) => {
                let name = callee.function.name();
                let arguments = self.arguments(call)?;
                Ok(Piece::atom(self.names.symbols.latex(&name) + &arguments))
            }
            (_, Some((callee, Some(partial)))) => {
                let name = &callee.function.name();
                let Some(by) = self.partial(callee.function, &partial) else {
                    return unsupported(call);
                };
                let arguments = self.arguments(call)?;
                let function = self.names.symbols.latex(name);
                let text = match by.as_slice() {
                    [one, two] if one == two => {
                        format!("\\frac{{\\partial^2 {function}}}{{\\partial {one}^2}}")
                    }
                    [one, two] => format!(
                        "\\frac{{\\partial^2 {function}}}{{\\partial {one}\\, \\partial {two}}}"
                    ),
                    by => format!(
                        "\\frac{{\\partial {function}}}{{\\partial {}}}",
                        by.concat()
                    ),
                };
                Ok(Piece::new(text + &arguments, Precedence::Product))
            }
            _ => unsupported(call),
        }
    }

    /// The arguments in parentheses; a parameter that is not written, handed on, is not written either.
    fn arguments(&mut self, call: &ExprCall) -> syn::Result<String> {
        let silent = |argument: &&Expr| match peeled(argument) {
            Expr::Path(path) => !path
                .path
                .get_ident()
                .is_some_and(|name| self.names.silent.contains(&name.to_string())),
            _ => true,
        };
        let written: Vec<&Expr> = call.args.iter().filter(silent).collect();
        let list = self.list(written)?;
        Ok(if list.is_empty() {
            list
        } else {
            parentheses(&list)
        })
    }

    /// What a partial `d_x`, `d_c_y` or `d_x_y` is by.
    fn partial(&self, function: &Function, partial: &str) -> Option<Vec<String>> {
        let suffix = partial.strip_prefix("d_")?;
        if let Some(symbol) = self.parameter(function, suffix) {
            return Some(vec![symbol]);
        }
        suffix.match_indices('_').find_map(|(position, _)| {
            let (one, two) = (suffix.get(..position)?, suffix.get(position + 1..)?);
            Some(vec![
                self.parameter(function, one)?,
                self.parameter(function, two)?,
            ])
        })
    }

    /// The symbol of `x`, of the field `c_x`, or of the element `a_0`.
    fn parameter(&self, function: &Function, name: &str) -> Option<String> {
        function.parameters.iter().find_map(|parameter| {
            let rest = name.strip_prefix(&parameter.name.to_string())?;
            let inner = rest.strip_prefix('_');
            match (&parameter.shape, inner) {
                (Shape::Number, _) => rest.is_empty().then(|| self.names.symbols.latex(name)),
                (Shape::Array(_, length), Some(index)) => {
                    let known = index.parse::<usize>().is_ok_and(|index| index < *length);
                    known.then(|| {
                        with_subscript(
                            &self.names.symbols.latex(&parameter.name.to_string()),
                            index,
                        )
                    })
                }
                (Shape::Struct(_, fields), Some(field)) => {
                    // The fields of a struct from elsewhere are not known.
                    let known = fields
                        .as_ref()
                        .is_none_or(|fields| fields.iter().any(|(known, _)| known == field));
                    known.then(|| self.names.symbols.latex(field))
                }
                _ => None,
            }
        })
    }

    fn integral(&mut self, call: &ExprCall) -> Written {
        let parts: Vec<&Expr> = call.args.iter().collect();
        let [Expr::Closure(closure), Expr::Range(range)] = parts.as_slice() else {
            return unsupported(call);
        };
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return unsupported(range);
        };
        let (lower, upper) = (self.piece(start)?.text, self.piece(end)?.text);
        let names: Vec<String> = closure
            .inputs
            .iter()
            .map(bound_names)
            .collect::<syn::Result<Vec<_>>>()?
            .concat();
        let [variable] = names.as_slice() else {
            return unsupported(closure);
        };
        let outer = self
            .bound
            .insert(variable.clone(), self.names.symbols.latex(variable));
        let integrand = self.piece(&closure.body)?.at_least(Precedence::Negative);
        let text = format!(
            "\\int_{{{lower}}}^{{{upper}}} {integrand} \\,\\mathrm{{d}}{}",
            self.symbol(variable)
        );
        match outer {
            Some(outer) => self.bound.insert(variable.clone(), outer),
            None => self.bound.remove(variable),
        };
        Ok(Piece::new(text, Precedence::Product))
    }
}

/// The expression within parentheses and references.
pub(super) fn peeled(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => peeled(&inner.expr),
        Expr::Group(inner) => peeled(&inner.expr),
        Expr::Reference(inner) => peeled(&inner.expr),
        other => other,
    }
}

/// A symbol from a table may be a product, `\Delta k`, a fraction, or have an exponent.
fn symbol_piece(symbol: String) -> Piece {
    let mut depth = 0_i32;
    let mut loose = symbol.starts_with("\\frac");
    for character in symbol.chars() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ' ' | '^' => loose |= depth == 0,
            _ => {}
        }
    }
    Piece::new(
        symbol,
        if loose {
            Precedence::Product
        } else {
            Precedence::Atom
        },
    )
}

fn number(literal: &Lit) -> Written {
    let digits = match literal {
        Lit::Float(value) => value.base10_digits().to_owned(),
        Lit::Int(value) => value.base10_digits().to_owned(),
        Lit::Bool(truth) => return Ok(Piece::atom(format!("\\text{{{}}}", truth.value))),
        other => return unsupported(other),
    };
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((&digits, ""));
    let mantissa = match mantissa.split_once('.') {
        Some((whole, fraction)) if fraction.chars().all(|digit| digit == '0') => whole,
        _ => mantissa,
    };
    Ok(match exponent.trim_start_matches('+') {
        "" => Piece::atom(mantissa),
        exponent if mantissa == "1" => Piece::atom("10").raised_to(exponent),
        exponent => Piece::atom(mantissa).times(Piece::atom("10").raised_to(exponent)),
    })
}

/// A constant of `std::f64::consts`.
fn constant(name: &str) -> Option<Piece> {
    let atom = |text: &str| Some(Piece::atom(text));
    let quotient = |above: &str, below: &str| Some(Piece::atom(above).over(Piece::atom(below)));
    match name {
        "PI" => atom("\\pi"),
        "TAU" => Some(Piece::new("2 \\pi", Precedence::Product)),
        "FRAC_PI_2" => quotient("\\pi", "2"),
        "FRAC_PI_3" => quotient("\\pi", "3"),
        "FRAC_PI_4" => quotient("\\pi", "4"),
        "FRAC_PI_6" => quotient("\\pi", "6"),
        "FRAC_PI_8" => quotient("\\pi", "8"),
        "FRAC_1_PI" => quotient("1", "\\pi"),
        "FRAC_2_PI" => quotient("2", "\\pi"),
        "FRAC_2_SQRT_PI" => quotient("2", "\\sqrt{\\pi}"),
        "SQRT_2" => atom("\\sqrt{2}"),
        "FRAC_1_SQRT_2" => quotient("1", "\\sqrt{2}"),
        "E" => atom("e"),
        "LN_2" => atom("\\ln(2)"),
        "LN_10" => atom("\\ln(10)"),
        "LOG2_E" => quotient("1", "\\ln(2)"),
        "LOG10_E" => quotient("1", "\\ln(10)"),
        "GOLDEN_RATIO" => quotient("1 + \\sqrt{5}", "2"),
        "LOG2_10" => quotient("\\ln(10)", "\\ln(2)"),
        "LOG10_2" => quotient("\\ln(2)", "\\ln(10)"),
        "EULER_GAMMA" => atom("\\gamma"),
        _ => None,
    }
}
