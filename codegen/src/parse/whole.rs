//! Whole numbers of a source: lengths of arrays, bounds of loops, indices, exponents. They are known when a formula is read.

use syn::{BinOp, Expr, Lit, UnOp};

use super::module::Module;

use crate::graph::{Rational, decimal};

/// The largest whole number, in size: that of `i32`, which a whole number is in Rust where nothing says its type. What
/// leaves its range is refused, so that none is another one than in the function as written.
pub(crate) const LARGEST: i64 = i32::MAX as i64;

/// The whole number that a literal is. `None` if it is larger than any.
pub(super) fn of_literal(literal: &syn::LitInt) -> Option<i64> {
    bounded(literal.base10_parse().ok()?)
}

fn bounded(value: i64) -> Option<i64> {
    (-LARGEST..=LARGEST).contains(&value).then_some(value)
}

/// What an operator makes of two whole numbers, as Rust has it. `None` where that is a panic or no whole number.
pub(super) fn operation(operator: &BinOp, left: i64, right: i64) -> Option<i64> {
    bounded(match operator {
        BinOp::Add(_) | BinOp::AddAssign(_) => left.checked_add(right)?,
        BinOp::Sub(_) | BinOp::SubAssign(_) => left.checked_sub(right)?,
        BinOp::Mul(_) | BinOp::MulAssign(_) => left.checked_mul(right)?,
        BinOp::Div(_) | BinOp::DivAssign(_) => left.checked_div(right)?,
        BinOp::Rem(_) | BinOp::RemAssign(_) => left.checked_rem(right)?,
        _ => return None,
    })
}

/// Whether whole numbers have the operator.
pub(super) fn is_operator(operator: &BinOp) -> bool {
    operation(operator, 1, 1).is_some()
}

/// How many constants may stand for each other; what needs itself, which is reported, ends there.
const LONGEST_CHAIN: usize = 64;

/// The whole number that an expression over a module's constants is, such as the length of an array.
pub(super) fn constant(module: &Module, expression: &Expr) -> Option<i64> {
    constant_of(module, expression, LONGEST_CHAIN)
}

fn constant_of(module: &Module, expression: &Expr, steps: usize) -> Option<i64> {
    let steps = steps.checked_sub(1)?;
    match expression {
        Expr::Lit(syn::ExprLit {
            lit: Lit::Int(literal),
            ..
        }) => of_literal(literal),
        Expr::Paren(inner) => constant_of(module, &inner.expr, steps),
        Expr::Group(inner) => constant_of(module, &inner.expr, steps),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            constant_of(module, &unary.expr, steps).map(|value| -value)
        }
        Expr::Binary(binary) => operation(
            &binary.op,
            constant_of(module, &binary.left, steps)?,
            constant_of(module, &binary.right, steps)?,
        ),
        Expr::Path(path) => {
            let (home, name) = module.constant(&path.path)?;
            let (_, value) = home.constants.iter().find(|(known, _)| known == name)?;
            constant_of(home, value, steps)
        }
        _ => None,
    }
}

/// The least and the largest number of a type of whole numbers, as far as there are such here.
pub(super) fn range_of(name: &str) -> Option<(i64, i64)> {
    let signed = |bits: u32| (-1_i64 << (bits - 1), (1_i64 << (bits - 1)) - 1);
    let unsigned = |bits: u32| (0, (1_i64 << bits) - 1);
    Some(match name {
        "i8" => signed(8),
        "i16" => signed(16),
        "i32" | "i64" | "i128" | "isize" => signed(32),
        "u8" => unsigned(8),
        "u16" => unsigned(16),
        "u32" | "u64" | "u128" | "usize" => unsigned(31),
        _ => return None,
    })
}

/// The number `n as f64` of a literal `n` of any size.
pub(super) fn as_number(literal: &syn::LitInt) -> Option<Rational> {
    let is_whole = !matches!(literal.suffix(), "f32" | "f64");
    is_whole.then(|| decimal(literal.base10_digits()))?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_are_those_of_rust() {
        let of = |operator: &str, left, right| {
            let operator: BinOp = syn::parse_str(operator).unwrap();
            operation(&operator, left, right)
        };
        for (left, right) in [(7_i64, 2_i64), (-7, 2), (7, -2), (0, 5)] {
            assert_eq!(of("+", left, right), Some(left + right));
            assert_eq!(of("-", left, right), Some(left - right));
            assert_eq!(of("*=", left, right), Some(left * right));
            assert_eq!(of("/", left, right), Some(left / right));
            assert_eq!(of("%", left, right), Some(left % right));
        }
        for operator in ["/", "%"] {
            assert_eq!(of(operator, 1, 0), None);
        }
        assert_eq!(of("+", LARGEST, 1), None);
        assert_eq!(of("<<", 1, 1), None);
    }

    #[test]
    fn types_hold_what_they_do_in_rust() {
        assert_eq!(range_of("i8"), Some((i8::MIN.into(), i8::MAX.into())));
        assert_eq!(range_of("u16"), Some((0, u16::MAX.into())));
        assert_eq!(range_of("usize"), Some((0, LARGEST)));
        assert_eq!(range_of("f32"), None);
    }
}
