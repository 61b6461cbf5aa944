//! LaTeX text with how tightly it holds together, so that parentheses stand only where they are needed.

use crate::symbols::braced;

/// How tightly a text holds together, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Precedence {
    /// `a ∨ b`
    Or,
    /// `a ∧ b`
    And,
    /// `a < b`
    Comparison,
    /// `a + b`
    Sum,
    /// `-a`: the text begins with the sign, and what follows is a product or tighter.
    Negative,
    /// `a b`, and all that may stand beside a factor but not under an exponent: fractions, integrals.
    Product,
    /// A power.
    Power,
    /// A name, a number, a call.
    Atom,
}

/// A part of a formula.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) text: String,
    pub(super) precedence: Precedence,
}

impl Piece {
    pub(super) fn new(text: impl Into<String>, precedence: Precedence) -> Self {
        Self {
            text: text.into(),
            precedence,
        }
    }

    pub(super) fn atom(text: impl Into<String>) -> Self {
        Self::new(text, Precedence::Atom)
    }

    /// The text, in parentheses where it would fall apart.
    pub(super) fn at_least(self, precedence: Precedence) -> String {
        if self.precedence >= precedence {
            self.text
        } else {
            parentheses(&self.text)
        }
    }

    /// The piece without its sign, and whether it had one.
    fn unsigned(self) -> (bool, Self) {
        match self.text.strip_prefix('-') {
            Some(rest) if self.precedence == Precedence::Negative => {
                (true, Self::new(rest, Precedence::Product))
            }
            _ => (false, self),
        }
    }

    fn signed(self, negative: bool) -> Self {
        match negative {
            true => Self::new(
                format!("-{}", self.at_least(Precedence::Product)),
                Precedence::Negative,
            ),
            false => self,
        }
    }

    pub(super) fn negative(self) -> Self {
        let (negative, piece) = self.unsigned();
        piece.signed(!negative)
    }

    pub(super) fn times(self, other: Self) -> Self {
        let ((left_negative, left), (right_negative, right)) = (self.unsigned(), other.unsigned());
        let (left, right) = (
            left.at_least(Precedence::Product),
            right.at_least(Precedence::Product),
        );
        let last = left.rsplit(' ').next().unwrap_or(&left);
        let between = if right.starts_with(|c: char| c.is_ascii_digit()) {
            " \\cdot "
        } else if last.starts_with("\\mathrm")
            || right.starts_with("\\mathrm")
            || right.starts_with("\\int")
        {
            "\\, "
        } else {
            " "
        };
        Self::new(format!("{left}{between}{right}"), Precedence::Product)
            .signed(left_negative != right_negative)
    }

    pub(super) fn over(self, other: Self) -> Self {
        let ((left_negative, left), (right_negative, right)) = (self.unsigned(), other.unsigned());
        Self::new(
            format!("\\frac{{{}}}{{{}}}", left.text, right.text),
            Precedence::Product,
        )
        .signed(left_negative != right_negative)
    }

    pub(super) fn raised_to(self, exponent: &str) -> Self {
        Self::new(
            format!("{}^{}", self.at_least(Precedence::Atom), braced(exponent)),
            Precedence::Power,
        )
    }

    /// The piece as a term of a sum: its sign, and a text that may follow a sign.
    pub(super) fn term(self) -> (bool, String) {
        let (negative, piece) = self.unsigned();
        (negative, piece.at_least(Precedence::Product))
    }
}

/// `(text)`, as tall as what it holds.
pub(super) fn parentheses(text: &str) -> String {
    delimited("(", text, ")")
}

/// The text between delimiters that are as tall as it is.
pub(super) fn delimited(left: &str, text: &str, right: &str) -> String {
    let tall = ["\\frac", "\\int", "\\sqrt", "\\left", "\\begin"]
        .iter()
        .any(|command| text.contains(command));
    if tall {
        format!("\\left{left}{text}\\right{right}")
    } else {
        format!("{left}{text}{right}")
    }
}
