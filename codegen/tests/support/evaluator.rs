//! Evaluates functions as they stand in Rust source: formulas as written, and the code generated from them. It shares
//! nothing with the generator, so that the two check each other.

use std::collections::BTreeMap;

use syn::{BinOp, Expr, Item, ItemFn, Lit, Member, Pat, Stmt, UnOp};

use super::bounded::Bounded;

/// A value of the source.
#[derive(Clone, Debug)]
pub enum Value {
    Number(Bounded),
    Whole(i128),
    List(Vec<Value>),
    Fields(BTreeMap<String, Value>),
}

impl Value {
    pub fn number(value: f64) -> Self {
        Self::Number(Bounded::exact(value))
    }

    pub fn numbers(values: &[f64]) -> Self {
        Self::List(values.iter().map(|value| Self::number(*value)).collect())
    }

    pub fn fields(fields: &[(&str, f64)]) -> Self {
        Self::Fields(
            fields
                .iter()
                .map(|(name, value)| ((*name).to_owned(), Self::number(*value)))
                .collect(),
        )
    }

    fn as_number(&self) -> Bounded {
        match self {
            Self::Number(value) => *value,
            other => panic!("{other:?} is no number"),
        }
    }

    /// All numbers in order, fields by their names.
    pub fn flatten(&self) -> Vec<Bounded> {
        match self {
            Self::Number(value) => vec![*value],
            Self::Whole(_) => Vec::new(),
            Self::List(values) => values.iter().flat_map(Self::flatten).collect(),
            Self::Fields(fields) => fields.values().flat_map(Self::flatten).collect(),
        }
    }
}

type Scope = BTreeMap<String, Value>;

/// The functions and constants that an evaluated function may use.
pub struct Source {
    functions: BTreeMap<String, ItemFn>,
    constants: BTreeMap<String, Expr>,
}

impl Source {
    pub fn of(items: &[Item]) -> Self {
        let (mut functions, mut constants) = (BTreeMap::new(), BTreeMap::new());
        for item in items {
            match item {
                Item::Fn(function) => {
                    functions.insert(function.sig.ident.to_string(), function.clone());
                }
                Item::Const(constant) => {
                    constants.insert(constant.ident.to_string(), (*constant.expr).clone());
                }
                _ => {}
            }
        }
        Self {
            functions,
            constants,
        }
    }

    /// The result of the function of that name.
    pub fn call(&self, name: &str, arguments: &[Value]) -> Value {
        let function = self
            .functions
            .get(name)
            .unwrap_or_else(|| panic!("no function {name}"));
        let mut scope = Scope::new();
        for (input, argument) in function.sig.inputs.iter().zip(arguments) {
            let syn::FnArg::Typed(typed) = input else {
                panic!("self")
            };
            bind(&typed.pat, argument.clone(), &mut scope);
        }
        self.block(&function.block, &scope)
    }

    fn block(&self, block: &syn::Block, scope: &Scope) -> Value {
        let mut scope = scope.clone();
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => {
                    let value = self.expression(&local.init.as_ref().unwrap().expr, &scope);
                    bind(&local.pat, value, &mut scope);
                }
                Stmt::Expr(Expr::Return(returned), _) => {
                    return self.expression(returned.expr.as_ref().unwrap(), &scope);
                }
                Stmt::Expr(value, None) => return self.expression(value, &scope),
                other => panic!("statement {other:?}"),
            }
        }
        panic!("a block without a value")
    }

    fn number(&self, expression: &Expr, scope: &Scope) -> Bounded {
        self.expression(expression, scope).as_number()
    }

    fn list<'e>(&self, expressions: impl IntoIterator<Item = &'e Expr>, scope: &Scope) -> Value {
        Value::List(
            expressions
                .into_iter()
                .map(|expression| self.expression(expression, scope))
                .collect(),
        )
    }

    fn expression(&self, expression: &Expr, scope: &Scope) -> Value {
        match expression {
            Expr::Lit(literal) => literal_value(&literal.lit),
            Expr::Path(path) => self.path(&path.path, scope),
            Expr::Paren(inner) => self.expression(&inner.expr, scope),
            Expr::Group(inner) => self.expression(&inner.expr, scope),
            Expr::Reference(inner) => self.expression(&inner.expr, scope),
            Expr::Block(inner) => self.block(&inner.block, scope),
            Expr::Unary(unary) => match (&unary.op, self.expression(&unary.expr, scope)) {
                (UnOp::Neg(_), Value::Whole(value)) => Value::Whole(-value),
                (UnOp::Neg(_), value) => Value::Number(value.as_number().negative()),
                (_, value) => value,
            },
            Expr::Binary(binary) => self.binary(binary, scope),
            Expr::If(choice) => self.choice(choice, scope),
            Expr::MethodCall(call) => self.method(call, scope),
            Expr::Call(call) => self.function_call(call, scope),
            Expr::Field(field) => match (self.expression(&field.base, scope), &field.member) {
                (Value::Fields(fields), Member::Named(name)) => fields[&name.to_string()].clone(),
                (Value::List(values), Member::Unnamed(index)) => {
                    values[index.index as usize].clone()
                }
                (base, member) => panic!("{member:?} of {base:?}"),
            },
            Expr::Index(index) => match (
                self.expression(&index.expr, scope),
                self.expression(&index.index, scope),
            ) {
                (Value::List(values), Value::Whole(position)) => {
                    values[usize::try_from(position).unwrap()].clone()
                }
                (base, index) => panic!("{index:?} of {base:?}"),
            },
            Expr::Tuple(tuple) => self.list(&tuple.elems, scope),
            Expr::Array(array) => self.list(&array.elems, scope),
            Expr::Struct(literal) => {
                let field = |field: &syn::FieldValue| {
                    let Member::Named(name) = &field.member else {
                        panic!("a field without a name")
                    };
                    (name.to_string(), self.expression(&field.expr, scope))
                };
                Value::Fields(literal.fields.iter().map(field).collect())
            }
            other => panic!("expression {other:?}"),
        }
    }

    fn binary(&self, binary: &syn::ExprBinary, scope: &Scope) -> Value {
        let left = self.number(&binary.left, scope);
        let right = self.number(&binary.right, scope);
        Value::Number(match binary.op {
            BinOp::Add(_) => left.plus(right),
            BinOp::Sub(_) => left.minus(right),
            BinOp::Mul(_) => left.times(right),
            BinOp::Div(_) => left.over(right),
            other => panic!("operator {other:?}"),
        })
    }

    fn choice(&self, choice: &syn::ExprIf, scope: &Scope) -> Value {
        let holds = self.condition(&choice.cond, scope);
        let first = self.block(&choice.then_branch, scope).as_number();
        let second = self.number(&choice.else_branch.as_ref().unwrap().1, scope);
        Value::Number(Bounded::choose(holds, first, second))
    }

    fn condition(&self, condition: &Expr, scope: &Scope) -> bool {
        match condition {
            Expr::Paren(inner) => self.condition(&inner.expr, scope),
            Expr::Unary(unary) => !self.condition(&unary.expr, scope),
            Expr::Binary(binary) => match binary.op {
                BinOp::And(_) => {
                    self.condition(&binary.left, scope) && self.condition(&binary.right, scope)
                }
                BinOp::Or(_) => {
                    self.condition(&binary.left, scope) || self.condition(&binary.right, scope)
                }
                _ => {
                    let [a, b] =
                        [&binary.left, &binary.right].map(|side| self.number(side, scope).value);
                    match binary.op {
                        BinOp::Lt(_) => a < b,
                        BinOp::Le(_) => a <= b,
                        BinOp::Gt(_) => a > b,
                        BinOp::Ge(_) => a >= b,
                        BinOp::Eq(_) => a == b,
                        _ => a != b,
                    }
                }
            },
            other => panic!("condition {other:?}"),
        }
    }

    fn method(&self, call: &syn::ExprMethodCall, scope: &Scope) -> Value {
        let name = call.method.to_string();
        let receiver = self.number(&call.receiver, scope);
        if name == "powi" {
            let Value::Whole(exponent) = self.expression(&call.args[0], scope) else {
                panic!("exponent")
            };
            return Value::Number(receiver.power(i32::try_from(exponent).unwrap()));
        }
        let rest = call
            .args
            .iter()
            .map(|argument| self.number(argument, scope));
        let operands: Vec<Bounded> = std::iter::once(receiver).chain(rest).collect();
        Value::Number(Bounded::method(&name, &operands).unwrap_or_else(|| panic!("method {name}")))
    }

    fn function_call(&self, call: &syn::ExprCall, scope: &Scope) -> Value {
        let Expr::Path(path) = call.func.as_ref() else {
            panic!("call {:?}", call.func)
        };
        let segments: Vec<String> = path
            .path
            .segments
            .iter()
            .map(|segment| segment.ident.to_string())
            .collect();
        let arguments: Vec<Value> = call
            .args
            .iter()
            .map(|argument| self.expression(argument, scope))
            .collect();
        match segments
            .iter()
            .map(String::as_str)
            .collect::<Vec<_>>()
            .as_slice()
        {
            ["f64", "from"] => arguments[0].clone(),
            ["f64", "from_bits"] => match arguments[0] {
                Value::Whole(bits) => Value::number(f64::from_bits(u64::try_from(bits).unwrap())),
                _ => panic!("bits"),
            },
            ["lanes", name] => {
                let Value::Number(operand) = &arguments[0] else {
                    panic!("operand of {name}")
                };
                let value = Bounded::method(name, std::slice::from_ref(operand));
                Value::Number(value.unwrap_or_else(|| panic!("function {name}")))
            }
            [name] => self.call(name, &arguments),
            other => panic!("call of {other:?}"),
        }
    }

    fn path(&self, path: &syn::Path, scope: &Scope) -> Value {
        let name = path.segments.last().unwrap().ident.to_string();
        if path.segments.len() == 1 {
            if let Some(value) = scope.get(&name) {
                return value.clone();
            }
            if let Some(value) = self.constants.get(&name) {
                return self.expression(value, &Scope::new());
            }
        }
        let value = match name.as_str() {
            "PI" => std::f64::consts::PI,
            "FRAC_PI_2" => std::f64::consts::FRAC_PI_2,
            "SQRT_2" => std::f64::consts::SQRT_2,
            "E" => std::f64::consts::E,
            "LN_2" => std::f64::consts::LN_2,
            other => panic!("unknown name {other}"),
        };
        Value::Number(Bounded::rounded(value))
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

fn literal_value(literal: &Lit) -> Value {
    match literal {
        Lit::Float(value) => Value::Number(Bounded::rounded(value.base10_parse().unwrap())),
        Lit::Int(value) if value.suffix() == "f64" => {
            Value::Number(Bounded::rounded(value.base10_parse().unwrap()))
        }
        Lit::Int(value) => Value::Whole(value.base10_parse().unwrap()),
        other => panic!("literal {other:?}"),
    }
}
