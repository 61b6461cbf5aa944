//! Puts functions as they stand in Rust source on a tape: formulas as written, and the code generated from them.

mod names;

use std::collections::BTreeMap;

use syn::{BinOp, Expr, Item, ItemFn, Lit, Member, Pat, Stmt, Type, UnOp};

use names::{comparison, function, function_of_two, operation};

use super::derivative::derivative;
use super::tape::{Binary, Comparison, Place, Step, Tape, Unary};

/// A value of the source.
#[derive(Clone, Debug)]
pub enum Value {
    Number(Place),
    Whole(i128),
    List(Vec<Value>),
    Fields(Vec<(String, Value)>),
}

impl Value {
    fn as_number(&self) -> Place {
        match self {
            Self::Number(place) => *place,
            other => panic!("{other:?} is no number"),
        }
    }

    /// All numbers in order.
    pub fn flatten(&self) -> Vec<Place> {
        match self {
            Self::Number(place) => vec![*place],
            Self::Whole(_) => Vec::new(),
            Self::List(values) => values.iter().flat_map(Self::flatten).collect(),
            Self::Fields(fields) => fields.iter().flat_map(|(_, v)| v.flatten()).collect(),
        }
    }
}

type Scope = BTreeMap<String, Value>;

/// The items that a recorded function may use.
#[derive(Default)]
pub struct Recorder {
    functions: BTreeMap<String, ItemFn>,
    constants: BTreeMap<String, Expr>,
    structs: BTreeMap<String, Vec<String>>,
}

impl Recorder {
    pub fn of(items: &[Item]) -> Self {
        let mut recorder = Self::default();
        for item in items {
            recorder.add(item);
        }
        recorder
    }

    fn add(&mut self, item: &Item) {
        match item {
            Item::Fn(function) => {
                let name = function.sig.ident.to_string();
                self.functions.insert(name, function.clone());
            }
            Item::Const(constant) => {
                let name = constant.ident.to_string();
                self.constants.insert(name, (*constant.expr).clone());
            }
            Item::Struct(item) => {
                let fields = item.fields.iter().filter_map(|field| field.ident.as_ref());
                let fields = fields.map(ToString::to_string).collect();
                self.structs.insert(item.ident.to_string(), fields);
            }
            _ => {}
        }
    }

    /// The same with the structs of another.
    pub fn with_structs_of(mut self, other: &Self) -> Self {
        self.structs.clone_from(&other.structs);
        self
    }

    /// The numbers that a function returns, over its parameters' numbers as inputs in order.
    pub fn record(&self, name: &str, tape: &mut Tape) -> Vec<Place> {
        let function = self.function(name);
        let mut inputs = 0..;
        let arguments: Vec<Value> = parameters(function)
            .into_iter()
            .map(|(_, ty)| {
                self.argument(ty, &mut || tape.push(Step::Input(inputs.next().unwrap())))
            })
            .collect();
        self.call(name, &arguments, tape).flatten()
    }

    fn function(&self, name: &str) -> &ItemFn {
        let function = self.functions.get(name);
        function.unwrap_or_else(|| panic!("no function {name}"))
    }

    /// A parameter of that type, made of new numbers.
    fn argument(&self, ty: &Type, number: &mut impl FnMut() -> Place) -> Value {
        match ty {
            Type::Reference(reference) => self.argument(&reference.elem, number),
            Type::Array(array) => {
                let Expr::Lit(length) = &array.len else {
                    panic!("length {:?}", array.len)
                };
                let Value::Whole(length) = literal_value(&length.lit, &mut Tape::default()) else {
                    panic!("length")
                };
                Value::List((0..length).map(|_| Value::Number(number())).collect())
            }
            Type::Path(path) => {
                let name = path.path.segments.last().unwrap().ident.to_string();
                match self.structs.get(&name) {
                    Some(fields) => {
                        let field = |field: &String| (field.clone(), Value::Number(number()));
                        Value::Fields(fields.iter().map(field).collect())
                    }
                    None => Value::Number(number()),
                }
            }
            other => panic!("type {other:?}"),
        }
    }

    fn call(&self, name: &str, arguments: &[Value], tape: &mut Tape) -> Value {
        let function = self.function(name);
        let mut scope = Scope::new();
        for ((pattern, _), argument) in parameters(function).into_iter().zip(arguments) {
            bind(pattern, argument.clone(), &mut scope);
        }
        self.block(&function.block, &scope, tape)
    }

    /// `f::d_x(…)`: the derivative is taken over inputs of its own and put where it is called.
    fn partial(&self, name: &str, partial: &str, arguments: &[Value], tape: &mut Tape) -> Value {
        let mut alone = Tape::default();
        let outputs = self.record(name, &mut alone);
        let names = self.input_names(name);
        let suffix = partial.strip_prefix("d_").unwrap();
        let by = |wanted: &str| names.iter().position(|name| name == wanted);
        let pairs = suffix.match_indices('_');
        let pairs = pairs.map(|(at, _)| vec![&suffix[..at], &suffix[at + 1..]]);
        let ways = std::iter::once(vec![suffix]).chain(pairs);
        let mut ways = ways.filter_map(|way| way.into_iter().map(by).collect::<Option<Vec<_>>>());
        let zero = alone.literal("0.0");
        let mut output = outputs[0];
        for input in ways.next().unwrap() {
            let slope = derivative(&mut alone, &[output], &Step::Input(input))[0];
            output = slope.unwrap_or(zero);
        }
        let arguments: Vec<Place> = arguments.iter().flat_map(Value::flatten).collect();
        Value::Number(tape.replay(&alone, output, &arguments))
    }

    /// The numbers of a function's parameters as partials name them.
    pub fn input_names(&self, name: &str) -> Vec<String> {
        let mut names = Vec::new();
        for (pattern, ty) in parameters(self.function(name)) {
            let Pat::Ident(parameter) = pattern else {
                panic!("{pattern:?}")
            };
            let name = parameter.ident.to_string();
            match self.argument(ty, &mut || 0) {
                Value::List(values) => {
                    names.extend((0..values.len()).map(|place| format!("{name}_{place}")));
                }
                Value::Fields(fields) => {
                    names.extend(fields.iter().map(|(field, _)| format!("{name}_{field}")));
                }
                _ => names.push(name),
            }
        }
        names
    }

    fn block(&self, block: &syn::Block, scope: &Scope, tape: &mut Tape) -> Value {
        let mut scope = scope.clone();
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => {
                    let value = &local.init.as_ref().unwrap().expr;
                    let value = self.expression(value, &scope, tape);
                    bind(&local.pat, value, &mut scope);
                }
                Stmt::Expr(value, None) => return self.expression(value, &scope, tape),
                other => panic!("statement {other:?}"),
            }
        }
        panic!("a block without a value")
    }

    fn number(&self, expression: &Expr, scope: &Scope, tape: &mut Tape) -> Place {
        self.expression(expression, scope, tape).as_number()
    }

    fn all<'e>(
        &self,
        expressions: impl IntoIterator<Item = &'e Expr>,
        scope: &Scope,
        tape: &mut Tape,
    ) -> Vec<Value> {
        let expressions = expressions.into_iter();
        expressions
            .map(|expression| self.expression(expression, scope, tape))
            .collect()
    }

    fn expression(&self, expression: &Expr, scope: &Scope, tape: &mut Tape) -> Value {
        match expression {
            Expr::Lit(literal) => literal_value(&literal.lit, tape),
            Expr::Path(path) => self.path(&path.path, scope, tape),
            Expr::Paren(inner) => self.expression(&inner.expr, scope, tape),
            Expr::Group(inner) => self.expression(&inner.expr, scope, tape),
            Expr::Reference(inner) => self.expression(&inner.expr, scope, tape),
            Expr::Block(inner) => self.block(&inner.block, scope, tape),
            Expr::Unary(unary) => match (&unary.op, self.expression(&unary.expr, scope, tape)) {
                (UnOp::Neg(_), Value::Whole(value)) => Value::Whole(-value),
                (UnOp::Neg(_), value) => {
                    Value::Number(tape.unary(Unary::Negative, value.as_number()))
                }
                (_, value) => value,
            },
            Expr::Binary(binary) => {
                let left = self.number(&binary.left, scope, tape);
                let right = self.number(&binary.right, scope, tape);
                Value::Number(tape.binary(operation(&binary.op), left, right))
            }
            Expr::If(choice) => self.choice(choice, scope, tape),
            Expr::Cast(cast) => match cast.expr.as_ref() {
                Expr::Lit(syn::ExprLit {
                    lit: Lit::Int(whole),
                    ..
                }) => Value::Number(tape.literal(whole.base10_digits())),
                other => panic!("cast of {other:?}"),
            },
            Expr::MethodCall(call) => self.method(call, scope, tape),
            Expr::Call(call) => self.function_call(call, scope, tape),
            Expr::Field(field) => member(self.expression(&field.base, scope, tape), &field.member),
            Expr::Index(index) => {
                let base = self.expression(&index.expr, scope, tape);
                match (base, self.expression(&index.index, scope, tape)) {
                    (Value::List(values), Value::Whole(position)) => {
                        values[usize::try_from(position).unwrap()].clone()
                    }
                    (base, index) => panic!("{index:?} of {base:?}"),
                }
            }
            Expr::Tuple(tuple) => Value::List(self.all(&tuple.elems, scope, tape)),
            Expr::Array(array) => Value::List(self.all(&array.elems, scope, tape)),
            Expr::Struct(literal) => self.struct_literal(literal, scope, tape),
            other => panic!("expression {other:?}"),
        }
    }

    /// Fields in the order of the literal, then those of the rest.
    fn struct_literal(&self, literal: &syn::ExprStruct, scope: &Scope, tape: &mut Tape) -> Value {
        let mut fields = Vec::new();
        for field in &literal.fields {
            let Member::Named(name) = &field.member else {
                panic!("a field without a name")
            };
            fields.push((name.to_string(), self.expression(&field.expr, scope, tape)));
        }
        if let Some(rest) = &literal.rest {
            let Value::Fields(rest) = self.expression(rest, scope, tape) else {
                panic!("the rest of a struct")
            };
            for (name, value) in rest {
                if fields.iter().all(|(known, _)| *known != name) {
                    fields.push((name, value));
                }
            }
        }
        Value::Fields(fields)
    }

    fn choice(&self, choice: &syn::ExprIf, scope: &Scope, tape: &mut Tape) -> Value {
        let first = self.block(&choice.then_branch, scope, tape).as_number();
        let second = self.number(&choice.else_branch.as_ref().unwrap().1, scope, tape);
        Value::Number(self.select(&choice.cond, [first, second], scope, tape))
    }

    /// The first of two where a condition holds, else the second.
    fn select(
        &self,
        condition: &Expr,
        [first, second]: [Place; 2],
        scope: &Scope,
        tape: &mut Tape,
    ) -> Place {
        match condition {
            Expr::Paren(inner) => self.select(&inner.expr, [first, second], scope, tape),
            Expr::Unary(unary) => self.select(&unary.expr, [second, first], scope, tape),
            Expr::Binary(binary) => match binary.op {
                BinOp::And(_) => {
                    let inner = self.select(&binary.right, [first, second], scope, tape);
                    self.select(&binary.left, [inner, second], scope, tape)
                }
                BinOp::Or(_) => {
                    let inner = self.select(&binary.right, [first, second], scope, tape);
                    self.select(&binary.left, [first, inner], scope, tape)
                }
                _ => {
                    let [a, b] =
                        [&binary.left, &binary.right].map(|side| self.number(side, scope, tape));
                    match comparison(&binary.op) {
                        Some(comparison) => {
                            tape.push(Step::Select(comparison, [a, b, first, second]))
                        }
                        None => tape.push(Step::Select(Comparison::Equal, [a, b, second, first])),
                    }
                }
            },
            other => panic!("condition {other:?}"),
        }
    }

    fn method(&self, call: &syn::ExprMethodCall, scope: &Scope, tape: &mut Tape) -> Value {
        let x = self.number(&call.receiver, scope, tape);
        let arguments = self.all(&call.args, scope, tape);
        method_of(&call.method.to_string(), x, &arguments, tape)
    }

    fn function_call(&self, call: &syn::ExprCall, scope: &Scope, tape: &mut Tape) -> Value {
        let Expr::Path(path) = call.func.as_ref() else {
            panic!("call {:?}", call.func)
        };
        let segments = path.path.segments.iter();
        let segments: Vec<String> = segments.map(|segment| segment.ident.to_string()).collect();
        let segments: Vec<&str> = segments.iter().map(String::as_str).collect();
        let arguments = self.all(&call.args, scope, tape);
        match (segments.as_slice(), arguments.as_slice()) {
            (["f64", "from_bits"], [Value::Whole(bits)]) => {
                Value::Number(tape.push(Step::Bits(u64::try_from(*bits).unwrap())))
            }
            (["f64", "from"], [x]) => x.clone(),
            (["f64", name], [x, rest @ ..]) => method_of(name, x.as_number(), rest, tape),
            (["lanes", name], [x]) => Value::Number(tape.unary(function(name), x.as_number())),
            ([name], _) => self.call(name, &arguments, tape),
            ([name, partial], _) => self.partial(name, partial, &arguments, tape),
            other => panic!("call of {other:?}"),
        }
    }

    fn path(&self, path: &syn::Path, scope: &Scope, tape: &mut Tape) -> Value {
        let name = path.segments.last().unwrap().ident.to_string();
        if path.segments.len() == 1 {
            if let Some(value) = scope.get(&name) {
                return value.clone();
            }
            if let Some(value) = self.constants.get(&name) {
                return self.expression(value, &Scope::new(), tape);
            }
        }
        Value::Number(tape.push(Step::Constant(name)))
    }
}

/// A method of a number, those that stand for several operations as these.
fn method_of(name: &str, x: Place, arguments: &[Value], tape: &mut Tape) -> Value {
    let mut in_half_turns = |above: &str, below: &str| {
        let [above, below] = [above, below].map(|name| match name {
            "PI" => tape.push(Step::Constant(name.to_owned())),
            digits => tape.literal(digits),
        });
        let scale = tape.binary(Binary::Divide, above, below);
        tape.binary(Binary::Multiply, x, scale)
    };
    Value::Number(match (name, arguments) {
        ("powi", [Value::Whole(exponent)]) => {
            tape.push(Step::Power(x, i32::try_from(*exponent).unwrap()))
        }
        ("mul_add", [y, z]) => tape.push(Step::MulAdd(x, y.as_number(), z.as_number())),
        ("clamp", [low, high]) => {
            let (low, high) = (low.as_number(), high.as_number());
            let raised = tape.push(Step::Select(Comparison::Less, [x, low, low, x]));
            tape.push(Step::Select(
                Comparison::Greater,
                [raised, high, high, raised],
            ))
        }
        ("fract", []) => {
            let whole = tape.unary(Unary::Trunc, x);
            tape.binary(Binary::Subtract, x, whole)
        }
        ("to_radians", []) => in_half_turns("PI", "180.0"),
        ("to_degrees", []) => in_half_turns("180.0", "PI"),
        ("log", [base]) => {
            let [above, below] = [x, base.as_number()].map(|of| tape.unary(Unary::Ln, of));
            tape.binary(Binary::Divide, above, below)
        }
        ("sin_cos", []) => {
            let both = [Unary::Sin, Unary::Cos].map(|function| tape.unary(function, x));
            return Value::List(both.map(Value::Number).to_vec());
        }
        (_, [y]) => tape.binary(function_of_two(name).unwrap(), x, y.as_number()),
        (_, []) => tape.unary(function(name), x),
        other => panic!("method {other:?}"),
    })
}

fn parameters(function: &ItemFn) -> Vec<(&Pat, &Type)> {
    let inputs = function.sig.inputs.iter();
    inputs
        .map(|input| match input {
            syn::FnArg::Typed(typed) => (typed.pat.as_ref(), typed.ty.as_ref()),
            syn::FnArg::Receiver(_) => panic!("self"),
        })
        .collect()
}

fn member(base: Value, member: &Member) -> Value {
    match (base, member) {
        (Value::Fields(fields), Member::Named(name)) => {
            let mut fields = fields.into_iter();
            fields.find(|(field, _)| name == field).unwrap().1
        }
        (Value::List(values), Member::Unnamed(index)) => values[index.index as usize].clone(),
        (base, member) => panic!("{member:?} of {base:?}"),
    }
}

fn bind(pattern: &Pat, value: Value, scope: &mut Scope) {
    match (pattern, value) {
        (Pat::Ident(name), value) => {
            scope.insert(name.ident.to_string(), value);
        }
        (Pat::Type(typed), value) => bind(&typed.pat, value, scope),
        (Pat::Wild(_), _) => {}
        (Pat::Tuple(tuple), Value::List(values)) => {
            for (pattern, value) in tuple.elems.iter().zip(values) {
                bind(pattern, value, scope);
            }
        }
        (pattern, value) => panic!("{pattern:?} = {value:?}"),
    }
}

fn literal_value(literal: &Lit, tape: &mut Tape) -> Value {
    match literal {
        Lit::Float(value) => Value::Number(tape.literal(value.base10_digits())),
        Lit::Int(value) if value.suffix() == "f64" => {
            Value::Number(tape.literal(value.base10_digits()))
        }
        Lit::Int(value) => Value::Whole(value.base10_parse().unwrap()),
        other => panic!("literal {other:?}"),
    }
}
