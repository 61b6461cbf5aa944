//! What is known of an expression's sign from the declared domains of its symbols.

use super::{ExprId, Function, Graph, Node};

/// Which of negative, zero and positive a number may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    /// It may be below zero.
    pub negative: bool,
    /// It may be zero.
    pub zero: bool,
    /// It may be above zero.
    pub positive: bool,
}

/// Where a number may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Which signs it may have.
    pub sign: Sign,
    /// The least that it may be.
    pub lower: f64,
    /// The greatest that it may be.
    pub upper: f64,
}

impl Default for Domain {
    /// Anywhere.
    fn default() -> Self {
        Self::of_sign(Sign::UNKNOWN)
    }
}

impl Domain {
    /// Anywhere with such a sign.
    pub fn of_sign(sign: Sign) -> Self {
        Self {
            sign,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
        }
    }

    /// From a number on.
    pub fn at_least(lower: f64) -> Self {
        let sign = if lower > 0.0 {
            Sign::POSITIVE
        } else {
            Sign::UNKNOWN
        };
        Self {
            lower,
            ..Self::of_sign(sign)
        }
    }

    /// Up to a number.
    pub fn at_most(upper: f64) -> Self {
        let sign = if upper < 0.0 {
            Sign::NEGATIVE
        } else {
            Sign::UNKNOWN
        };
        Self {
            upper,
            ..Self::of_sign(sign)
        }
    }

    /// Where it may lie if it is in both.
    pub fn and(self, other: Self) -> Self {
        Self {
            sign: self.sign.and(other.sign),
            lower: self.lower.max(other.lower),
            upper: self.upper.min(other.upper),
        }
    }

    /// Whether no number is in it.
    pub fn is_empty(self) -> bool {
        let Sign {
            negative,
            zero,
            positive,
        } = self.sign;
        self.lower > self.upper || !(negative || zero || positive)
    }

    /// Whether a number is in it; what is no number is where nothing is said.
    pub fn contains(self, value: f64) -> bool {
        if value.is_nan() {
            return self == Self::default();
        }
        let fits = if value == 0.0 {
            self.sign.zero
        } else if value > 0.0 {
            self.sign.positive
        } else {
            self.sign.negative
        };
        fits && self.lower <= value && value <= self.upper
    }
}

impl Sign {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self {
        negative: true,
        zero: true,
        positive: true,
    };
    /// Above zero.
    pub const POSITIVE: Self = Self {
        negative: false,
        zero: false,
        positive: true,
    };
    /// Below zero.
    pub const NEGATIVE: Self = Self {
        negative: true,
        zero: false,
        positive: false,
    };
    /// Zero or above.
    pub const NOT_NEGATIVE: Self = Self {
        negative: false,
        zero: true,
        positive: true,
    };
    /// Zero or below.
    pub const NOT_POSITIVE: Self = Self {
        negative: true,
        zero: true,
        positive: false,
    };
    /// Any but zero.
    pub const NOT_ZERO: Self = Self {
        negative: true,
        zero: false,
        positive: true,
    };

    /// What holds where both hold.
    pub fn and(self, other: Self) -> Self {
        Self {
            negative: self.negative && other.negative,
            zero: self.zero && other.zero,
            positive: self.positive && other.positive,
        }
    }

    /// What holds where one of two holds.
    pub fn or(self, other: Self) -> Self {
        Self {
            negative: self.negative || other.negative,
            zero: self.zero || other.zero,
            positive: self.positive || other.positive,
        }
    }

    /// Never below zero.
    pub fn is_not_negative(self) -> bool {
        !self.negative
    }

    /// Never above zero.
    pub fn is_not_positive(self) -> bool {
        !self.positive
    }

    /// Above zero.
    pub fn is_positive(self) -> bool {
        !self.negative && !self.zero
    }

    /// Below zero.
    pub fn is_negative(self) -> bool {
        !self.positive && !self.zero
    }

    fn negated(self) -> Self {
        Self {
            negative: self.positive,
            zero: self.zero,
            positive: self.negative,
        }
    }

    fn times(self, other: Self) -> Self {
        Self {
            negative: (self.negative && other.positive) || (self.positive && other.negative),
            zero: self.zero || other.zero,
            positive: (self.positive && other.positive) || (self.negative && other.negative),
        }
    }

    fn plus(self, other: Self) -> Self {
        let negative = self.negative || other.negative;
        let positive = self.positive || other.positive;
        let zero = (self.zero && other.zero)
            || (self.negative && other.positive)
            || (self.positive && other.negative);
        Self {
            negative,
            zero,
            positive,
        }
    }

    fn squared(self) -> Self {
        Self {
            negative: false,
            zero: self.zero,
            positive: self.positive || self.negative,
        }
    }

    /// This, or zero where that may be.
    fn or_zero(self, may_be: bool) -> Self {
        Self {
            zero: self.zero || may_be,
            ..self
        }
    }

    fn of_number(value: &super::Rational) -> Self {
        if value.is_positive() {
            Self::POSITIVE
        } else if value.is_negative() {
            Self::NEGATIVE
        } else {
            Self {
                negative: false,
                zero: true,
                positive: false,
            }
        }
    }
}

impl Graph {
    /// What is known of an expression's sign, wherever the expression is defined.
    pub fn sign(&self, id: ExprId) -> Sign {
        self.signs[id.index()]
    }

    /// The sign of a node from the signs of its operands.
    pub(super) fn derive_sign(&self, node: &Node) -> Sign {
        match node {
            Node::Number(value) => Sign::of_number(value),
            Node::Constant(_) => Sign::POSITIVE,
            Node::Symbol(symbol) => self.symbol(*symbol).domain.sign,
            Node::Sum(terms) => {
                let mut terms = terms.iter().map(|(operand, coefficient)| {
                    let sign = self.sign(*operand);
                    if coefficient.is_negative() {
                        sign.negated()
                    } else {
                        sign
                    }
                });
                let first = terms.next().unwrap_or(Sign::UNKNOWN);
                terms.fold(first, Sign::plus)
            }
            Node::Product(factors) => {
                factors
                    .iter()
                    .fold(Sign::POSITIVE, |product, (operand, exponent)| {
                        let sign = self.sign(*operand);
                        let mut power = if exponent % 2 == 0 {
                            sign.squared()
                        } else {
                            sign
                        };
                        // A divisor is not zero where the quotient is defined.
                        power.zero &= *exponent > 0;
                        product.times(power)
                    })
            }
            Node::Apply(function, operands) => self.sign_of_function(*function, operands),
            Node::Tabulated {
                table, order: 0, ..
            } => self.tables.get(*table).map_or(Sign::UNKNOWN, |t| t.sign),
            Node::Tabulated { .. } | Node::Integral { .. } => Sign::UNKNOWN,
        }
    }

    fn sign_of_function(&self, function: Function, operands: &[ExprId]) -> Sign {
        let sign = |position: usize| {
            operands
                .get(position)
                .map_or(Sign::UNKNOWN, |id| self.sign(*id))
        };
        match function {
            Function::Sqrt => Sign {
                negative: false,
                zero: sign(0).zero,
                positive: true,
            },
            Function::Abs => sign(0).squared(),
            Function::Exp | Function::Exp2 | Function::Cosh => Sign::POSITIVE,
            Function::Sign | Function::Side | Function::SignBit => Sign {
                negative: sign(0).negative,
                zero: false,
                positive: sign(0).positive || sign(0).zero,
            },
            Function::Min | Function::Max => {
                let (a, b) = (sign(0), sign(1));
                let mut either = a.or(b);
                if function == Function::Max {
                    either.negative = a.negative && b.negative;
                    either.zero &= !a.is_positive() && !b.is_positive();
                } else {
                    either.positive = a.positive && b.positive;
                    either.zero &= (a.zero || a.positive) && (b.zero || b.positive);
                }
                either
            }
            Function::Select | Function::Less | Function::AtMost => sign(2).or(sign(3)),
            Function::MulAdd => sign(0).times(sign(1)).plus(sign(2)),
            // Odd functions that rise, and others through 0 that do.
            Function::Asin
            | Function::Atan
            | Function::Sinh
            | Function::Tanh
            | Function::Asinh
            | Function::Atanh
            | Function::ExpM1
            | Function::Ln1p
            | Function::Cbrt
            | Function::Erf
            | Function::OverSquares => sign(0),
            Function::Acos | Function::Acosh | Function::Erfc => Sign::NOT_NEGATIVE,
            Function::Hypot => sign(0).squared().plus(sign(1).squared()),
            Function::Floor => sign(0).or_zero(sign(0).positive),
            Function::Ceil => sign(0).or_zero(sign(0).negative),
            Function::Round | Function::Trunc => sign(0).or_zero(true),
            // Of a zero of which sign the angle is depends on the other number.
            Function::Atan2 if !sign(0).zero => sign(0),
            Function::Powf if sign(0).is_positive() => Sign::POSITIVE,
            Function::Powf if sign(0).is_not_negative() => Sign::NOT_NEGATIVE,
            Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Ln
            | Function::Log10
            | Function::Log2
            | Function::Atan2
            | Function::Powf => Sign::UNKNOWN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_follow_the_declared_domains() {
        let mut graph = Graph::new();
        let x = graph.symbol_named("x");
        graph.assume(x, Domain::of_sign(Sign::POSITIVE));
        let x = graph.symbol_expression(x);
        let y = graph.symbol_named("y");
        let y = graph.symbol_expression(y);
        let square = graph.power(y, 2);
        let sum = graph.add(x, square);
        assert_eq!(graph.sign(sum), Sign::POSITIVE);
        let difference = graph.subtract(x, square);
        assert_eq!(graph.sign(difference), Sign::UNKNOWN);
        let negative = graph.negate(sum);
        assert_eq!(graph.sign(negative), Sign::NEGATIVE);
        let product = graph.multiply(negative, square);
        assert_eq!(graph.sign(product), Sign::NOT_POSITIVE);
    }
}
