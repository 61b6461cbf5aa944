//! Operators and methods by their names.

use syn::BinOp;

use crate::support::tape::{Binary, Comparison, Unary};

/// The operation of an operator.
pub fn operation(operator: &BinOp) -> Binary {
    match operator {
        BinOp::Add(_) => Binary::Add,
        BinOp::Sub(_) => Binary::Subtract,
        BinOp::Mul(_) => Binary::Multiply,
        BinOp::Div(_) => Binary::Divide,
        other => panic!("operator {other:?}"),
    }
}

/// The function of two numbers of a name, if it is one.
pub fn function_of_two(name: &str) -> Option<Binary> {
    Some(match name {
        "min" => Binary::Min,
        "max" => Binary::Max,
        "atan2" => Binary::Atan2,
        "hypot" => Binary::Hypot,
        "powf" => Binary::Powf,
        "copysign" => Binary::Copysign,
        _ => return None,
    })
}

/// How two numbers are compared; none of an operator that joins conditions.
pub fn comparison(operator: &BinOp) -> Option<Comparison> {
    Some(match operator {
        BinOp::Le(_) => Comparison::AtMost,
        BinOp::Lt(_) => Comparison::Less,
        BinOp::Eq(_) => Comparison::Equal,
        BinOp::Ge(_) => Comparison::AtLeast,
        BinOp::Gt(_) => Comparison::Greater,
        _ => return None,
    })
}

/// The function of a name.
pub fn function(name: &str) -> Unary {
    match name {
        "sqrt" => Unary::Sqrt,
        "sin" => Unary::Sin,
        "cos" => Unary::Cos,
        "tan" => Unary::Tan,
        "exp" => Unary::Exp,
        "ln" => Unary::Ln,
        "abs" => Unary::Abs,
        "signum" => Unary::Signum,
        "recip" => Unary::Recip,
        "asin" => Unary::Asin,
        "acos" => Unary::Acos,
        "atan" => Unary::Atan,
        "sinh" => Unary::Sinh,
        "cosh" => Unary::Cosh,
        "tanh" => Unary::Tanh,
        "asinh" => Unary::Asinh,
        "acosh" => Unary::Acosh,
        "atanh" => Unary::Atanh,
        "exp_m1" => Unary::ExpM1,
        "ln_1p" => Unary::Ln1p,
        "cbrt" => Unary::Cbrt,
        "log10" => Unary::Log10,
        "log2" => Unary::Log2,
        "exp2" => Unary::Exp2,
        "floor" => Unary::Floor,
        "ceil" => Unary::Ceil,
        "round" => Unary::Round,
        "trunc" => Unary::Trunc,
        other => panic!("function {other}"),
    }
}
