//! Constructors: each brings its node into the one form that [`Graph`]'s invariants name, or leaves it as it is written.

use super::{
    ExprId, Factors, Function, Graph, LARGEST_EXPONENT, MOST_BITS, NamedConstant, Node, Operands,
    Rational, SymbolId, Terms, rational, whole,
};

impl Graph {
    /// An exact constant.
    pub fn number(&mut self, value: Rational) -> ExprId {
        self.intern(Node::Number(value))
    }

    /// A whole number.
    pub fn integer(&mut self, value: i64) -> ExprId {
        self.number(whole(value))
    }

    /// A named constant.
    pub fn constant(&mut self, constant: NamedConstant) -> ExprId {
        self.intern(Node::Constant(constant))
    }

    /// The expression that is just a symbol.
    pub fn symbol_expression(&mut self, symbol: SymbolId) -> ExprId {
        self.intern(Node::Symbol(symbol))
    }

    /// The value of a node that is a rational constant.
    pub fn as_number(&self, id: ExprId) -> Option<&Rational> {
        match self.node(id) {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Σ coefficient · operand. Equal operands are collected; a sum among the operands is opened only where that
    /// leaves no more terms than it had, as in (a + b) − b.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (ExprId, Rational)>) -> ExprId {
        if self.is_as_written {
            return self.written_sum(terms);
        }
        let mut closed = Terms::new();
        for (operand, coefficient) in terms {
            self.open_multiple(&mut closed, operand, coefficient);
        }
        rational::collect(&mut closed);
        let is_sum =
            |(operand, _): &(ExprId, Rational)| matches!(self.node(*operand), Node::Sum(_));
        if closed.iter().any(is_sum) {
            let mut opened = Terms::new();
            for (operand, coefficient) in &closed {
                match self.node(*operand).clone() {
                    Node::Sum(inner) => {
                        for (term, q) in inner {
                            let coefficient = self.gathered(coefficient, &q, 1);
                            self.open_multiple(&mut opened, term, coefficient);
                        }
                    }
                    _ => self.open_multiple(&mut opened, *operand, coefficient.clone()),
                }
            }
            rational::collect(&mut opened);
            if opened.len() <= closed.len() {
                return self.sum(opened);
            }
        }
        self.finish_sum(closed)
    }

    /// Adds a term: of a number as a multiple of 1, of a multiple as one of what it is of.
    fn open_multiple(&mut self, terms: &mut Terms, operand: ExprId, coefficient: Rational) {
        let (operand, inner) = match self.node(operand) {
            Node::Number(value) => (self.one(), value.clone()),
            // What is a multiple is none of a multiple.
            Node::Sum(inner) if inner.len() == 1 => inner[0].clone(),
            _ => return terms.push((operand, coefficient)),
        };
        let coefficient = self.gathered(&inner, &coefficient, 1);
        terms.push((operand, coefficient));
    }

    /// A constant times a power of another, unless it is longer than any that is gathered: then the graph is of no use.
    fn gathered(&mut self, constant: &Rational, other: &Rational, exponent: i32) -> Rational {
        let bits = |value: &Rational| if value.is_unit() { 0 } else { value.bits() };
        let power = bits(other).saturating_mul(exponent.unsigned_abs().into());
        if bits(constant).saturating_add(power) > MOST_BITS {
            self.is_exceeded = true;
            return constant.clone();
        }
        constant * &other.pow(exponent)
    }

    /// An exponent, unless it is larger than any: then the graph is of no use.
    fn bounded(&mut self, exponent: Option<i32>) -> i32 {
        let bounds = -LARGEST_EXPONENT..=LARGEST_EXPONENT;
        exponent
            .filter(|it| bounds.contains(it))
            .unwrap_or_else(|| {
                self.is_exceeded = true;
                1
            })
    }

    /// A sum as its author wrote it. Of one term with the coefficient 1 it is that term.
    fn written_sum(&mut self, terms: impl IntoIterator<Item = (ExprId, Rational)>) -> ExprId {
        let is_zero = |graph: &Self, id| graph.as_number(id).is_some_and(Rational::is_zero);
        let mut kept: Terms = terms.into_iter().collect();
        // Derivatives add nothing from what they do not depend on.
        kept.retain(|(operand, q)| !q.is_zero() && !is_zero(self, *operand));
        match kept.as_slice() {
            [] => self.number(Rational::ZERO),
            [(operand, q)] if q.is_one() => *operand,
            [(operand, q)] if *operand == self.one() => {
                let q = q.clone();
                self.number(q)
            }
            _ => self.intern(Node::Sum(kept)),
        }
    }

    /// A product as its author wrote it; factors of 1 and −1 are left out, and one of 0, which
    /// derivatives have, makes it 0.
    fn written_product(&mut self, factors: impl IntoIterator<Item = (ExprId, i32)>) -> ExprId {
        let one = self.one();
        let (mut product, mut sign) = (None, Rational::ONE);
        for (operand, exponent) in factors {
            match self.as_number(operand) {
                _ if exponent == 0 => continue,
                Some(value) if value.is_unit() => {
                    sign *= &value.pow(exponent);
                    continue;
                }
                Some(value) if value.is_zero() && exponent > 0 => {
                    return self.number(Rational::ZERO);
                }
                _ => {}
            }
            // A power is an operation of its own.
            let (operand, exponent) = if exponent.abs() == 1 {
                (operand, exponent)
            } else {
                let power = Factors::from_slice(&[(operand, exponent)]);
                (self.intern(Node::Product(power)), 1)
            };
            product = Some(match product {
                None if exponent == 1 => operand,
                None => self.intern(Node::Product(Factors::from_slice(&[(operand, -1)]))),
                Some(left) => {
                    let both = Factors::from_slice(&[(left, 1), (operand, exponent)]);
                    self.intern(Node::Product(both))
                }
            });
        }
        self.written_sum([(product.unwrap_or(one), sign)])
    }

    /// A product or quotient of two that the author wrote, by the exponent of the second. One with a factor of 0 is an
    /// operation like others: it is NaN where the other is infinite or NaN, and `min`, `max` and comparisons see that.
    pub fn multiply_as_written(
        &mut self,
        left: ExprId,
        (right, exponent): (ExprId, i32),
    ) -> ExprId {
        let numbers = [left, right].map(|id| self.as_number(id));
        let is_zero = |number: &Option<&Rational>| number.is_some_and(Rational::is_zero);
        let both = [(left, 1), (right, exponent)];
        if self.is_as_written && numbers.iter().any(is_zero) && numbers.contains(&None) {
            return self.intern(Node::Product(Factors::from_slice(&both)));
        }
        self.product(both)
    }

    fn finish_sum(&mut self, terms: Terms) -> ExprId {
        match terms.as_slice() {
            [] => self.number(Rational::ZERO),
            [(operand, coefficient)] if *operand == self.one() => {
                let value = coefficient.clone();
                self.number(value)
            }
            [(operand, coefficient)] if coefficient.is_one() => *operand,
            _ => self.intern(Node::Sum(terms)),
        }
    }

    /// Π operand^exponent. Products among the operands are opened, rational factors gathered in front.
    pub fn product(&mut self, factors: impl IntoIterator<Item = (ExprId, i32)>) -> ExprId {
        if self.is_as_written {
            return self.written_product(factors);
        }
        let mut coefficient = Rational::ONE;
        let mut powers = Factors::new();
        for (operand, exponent) in factors {
            self.collect_factor(&mut coefficient, &mut powers, operand, exponent);
        }
        if coefficient.is_zero() {
            return self.number(coefficient);
        }
        rational::collect(&mut powers);
        let product = match powers.as_slice() {
            [] => return self.number(coefficient),
            [(operand, 1)] => *operand,
            _ => self.intern(Node::Product(powers)),
        };
        self.sum([(product, coefficient)])
    }

    fn collect_factor(
        &mut self,
        coefficient: &mut Rational,
        powers: &mut Factors,
        operand: ExprId,
        exponent: i32,
    ) {
        if exponent == 0 {
            return;
        }
        match self.node(operand) {
            Node::Number(value) if !value.is_zero() || exponent > 0 => {
                let value = value.clone();
                *coefficient = self.gathered(coefficient, &value, exponent);
            }
            Node::Product(inner) => {
                for (factor, power) in inner.clone() {
                    let power = self.bounded(power.checked_mul(exponent));
                    self.collect_factor(coefficient, powers, factor, power);
                }
            }
            Node::Sum(terms) => {
                let content = content_of(terms);
                if content.is_one() {
                    powers.push((operand, exponent));
                    return;
                }
                let over = |(operand, q): &(ExprId, Rational)| (*operand, q / &content);
                let terms: Terms = terms.iter().map(over).collect();
                *coefficient = self.gathered(coefficient, &content, exponent);
                let primitive = self.sum(terms);
                self.collect_factor(coefficient, powers, primitive, exponent);
            }
            _ => powers.push((operand, exponent)),
        }
    }

    /// The sum of two.
    pub fn add(&mut self, left: ExprId, right: ExprId) -> ExprId {
        self.sum([(left, whole(1)), (right, whole(1))])
    }

    /// The difference of two.
    pub fn subtract(&mut self, left: ExprId, right: ExprId) -> ExprId {
        self.sum([(left, whole(1)), (right, whole(-1))])
    }

    /// The negative.
    pub fn negate(&mut self, operand: ExprId) -> ExprId {
        self.sum([(operand, whole(-1))])
    }

    /// A rational multiple.
    pub fn scale(&mut self, operand: ExprId, coefficient: Rational) -> ExprId {
        self.sum([(operand, coefficient)])
    }

    /// The product of two.
    pub fn multiply(&mut self, left: ExprId, right: ExprId) -> ExprId {
        self.product([(left, 1), (right, 1)])
    }

    /// The quotient of two.
    pub fn divide(&mut self, left: ExprId, right: ExprId) -> ExprId {
        self.product([(left, 1), (right, -1)])
    }

    /// A whole power.
    pub fn power(&mut self, operand: ExprId, exponent: i32) -> ExprId {
        self.product([(operand, exponent)])
    }

    /// An elementary function of its operands, as it stands; see `rewrite` for what is known of them.
    pub fn apply(&mut self, function: Function, operands: impl Into<Operands>) -> ExprId {
        self.intern(Node::Apply(function, operands.into()))
    }

    /// The square root.
    pub fn sqrt(&mut self, operand: ExprId) -> ExprId {
        self.apply(Function::Sqrt, [operand].as_slice())
    }

    /// A derivative of a tabulated function.
    pub fn tabulated(&mut self, table: usize, order: usize, argument: ExprId) -> ExprId {
        self.intern(Node::Tabulated {
            table,
            order,
            argument,
        })
    }

    /// A definite integral.
    pub fn integral(
        &mut self,
        variable: SymbolId,
        integrand: ExprId,
        lower: ExprId,
        upper: ExprId,
    ) -> ExprId {
        self.intern(Node::Integral {
            variable,
            integrand,
            lower,
            upper,
        })
    }
}

/// The rational factor of a sum that leaves one which begins with a positive term, so that (b − a) and (a − b),
/// (2a + 2b) and (a + b) are one factor.
fn content_of(terms: &[(ExprId, Rational)]) -> Rational {
    let Some((_, first)) = terms.first() else {
        return Rational::ONE;
    };
    if terms.iter().all(|(_, q)| q.abs() == first.abs()) {
        first.clone()
    } else {
        first.signum()
    }
}
