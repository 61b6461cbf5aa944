//! Methods of numbers as LaTeX, `x.sin()` and `f64::sin(x)`.

use syn::{Expr, Ident};

use super::expression::{Writer, Written, peeled, unsupported};
use super::piece::{Piece, Precedence, delimited, parentheses};

/// Functions that are written as a name before their argument.
const NAMED: [(&str, &str); 26] = [
    ("sin", "\\sin"),
    ("cos", "\\cos"),
    ("tan", "\\tan"),
    ("ln", "\\ln"),
    ("asin", "\\arcsin"),
    ("acos", "\\arccos"),
    ("atan", "\\arctan"),
    ("sinh", "\\sinh"),
    ("cosh", "\\cosh"),
    ("tanh", "\\tanh"),
    ("asinh", "\\operatorname{arsinh}"),
    ("acosh", "\\operatorname{arcosh}"),
    ("atanh", "\\operatorname{artanh}"),
    ("log10", "\\log_{10}"),
    ("log2", "\\log_2"),
    ("signum", "\\operatorname{sgn}"),
    ("round", "\\operatorname{round}"),
    ("trunc", "\\operatorname{trunc}"),
    ("fract", "\\operatorname{frac}"),
    ("min", "\\min"),
    ("max", "\\max"),
    ("atan2", "\\operatorname{atan2}"),
    ("clamp", "\\operatorname{clamp}"),
    ("to_radians", "\\operatorname{rad}"),
    ("to_degrees", "\\operatorname{deg}"),
    ("copysign", "\\operatorname{copysign}"),
];

/// How a function is written before its argument.
fn named(method: &str) -> Option<&'static str> {
    let (_, name) = NAMED.iter().find(|(known, _)| *known == method)?;
    Some(name)
}

impl Writer<'_> {
    /// A method of an expression.
    pub(super) fn method(
        &mut self,
        method: &Ident,
        receiver: &Expr,
        arguments: &[&Expr],
    ) -> Written {
        let name = method.to_string();
        if let Some(function) = named(&name) {
            let operands = self.list(std::iter::once(receiver).chain(arguments.iter().copied()))?;
            return Ok(Piece::atom(function.to_owned() + &parentheses(&operands)));
        }
        match (name.as_str(), arguments) {
            ("powi" | "powf", [exponent]) => self.power(receiver, exponent),
            ("recip", []) => Ok(Piece::atom("1").over(self.piece(receiver)?)),
            ("hypot", [other]) => {
                let first = self.piece(receiver)?.raised_to("2").text;
                let second = self.piece(other)?.raised_to("2").text;
                Ok(Piece::atom(format!("\\sqrt{{{first} + {second}}}")))
            }
            ("log", [base]) => {
                let (base, of) = (self.piece(base)?.text, self.piece(receiver)?.text);
                Ok(Piece::atom(format!("\\log_{{{base}}}{}", parentheses(&of))))
            }
            ("mul_add", [factor, summand]) => {
                let product = self.piece(receiver)?.times(self.piece(factor)?);
                let (negative, text) = self.piece(summand)?.term();
                let sign = if negative { '-' } else { '+' };
                Ok(Piece::new(
                    format!("{} {sign} {text}", product.text),
                    Precedence::Sum,
                ))
            }
            (_, []) => {
                let operand = self.piece(receiver)?.text;
                of_one(&name, operand).map_or_else(|| unsupported(method), Ok)
            }
            _ => unsupported(method),
        }
    }

    fn power(&mut self, base: &Expr, exponent: &Expr) -> Written {
        let exponent = self.piece(exponent)?.text;
        let open = peeled(base);
        if let Expr::MethodCall(call) = open
            && let name @ ("sin" | "cos" | "tan" | "ln" | "sinh" | "cosh" | "tanh") =
                call.method.to_string().as_str()
            && !exponent.starts_with('-')
        {
            let function = Piece::atom(format!("\\{name}")).raised_to(&exponent);
            let argument = parentheses(&self.piece(&call.receiver)?.text);
            return Ok(Piece::new(function.text + &argument, Precedence::Power));
        }
        Ok(self.piece(base)?.raised_to(&exponent))
    }
}

/// A function of one number that has its own notation.
fn of_one(method: &str, operand: String) -> Option<Piece> {
    Some(match method {
        "sqrt" => Piece::atom(format!("\\sqrt{{{operand}}}")),
        "cbrt" => Piece::atom(format!("\\sqrt[3]{{{operand}}}")),
        "abs" => Piece::atom(delimited("|", &operand, "|")),
        "floor" => Piece::atom(delimited("\\lfloor ", &operand, " \\rfloor")),
        "ceil" => Piece::atom(delimited("\\lceil ", &operand, " \\rceil")),
        "exp" => Piece::atom("e").raised_to(&operand),
        "exp2" => Piece::atom("2").raised_to(&operand),
        "exp_m1" => Piece::new(
            format!("{} - 1", Piece::atom("e").raised_to(&operand).text),
            Precedence::Sum,
        ),
        "ln_1p" => Piece::atom(format!("\\ln{}", parentheses(&format!("1 + {operand}")))),
        "sin_cos" => {
            let argument = parentheses(&operand);
            Piece::atom(parentheses(&format!("\\sin{argument}, \\cos{argument}")))
        }
        _ => return None,
    })
}
