//! Operators and methods by their names.

use syn::BinOp;

use crate::support::tape::{Binary, Unary};

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
        other => panic!("function {other}"),
    }
}
