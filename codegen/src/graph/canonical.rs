//! Constructors: each brings its node into the one form that [`Graph`]'s invariants name.

use super::{
    ExprId, Factors, Function, Graph, NamedConstant, Node, Operands, Rational, SymbolId, Terms,
    rational, whole,
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
                match self.node(*operand) {
                    Node::Sum(inner) => {
                        for (term, q) in inner {
                            self.open_multiple(&mut opened, *term, coefficient * q);
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
    fn open_multiple(&self, terms: &mut Terms, operand: ExprId, coefficient: Rational) {
        match self.node(operand) {
            Node::Number(value) => terms.push((self.one(), value * &coefficient)),
            Node::Sum(inner) if inner.len() == 1 => {
                self.open_multiple(terms, inner[0].0, &inner[0].1 * &coefficient);
            }
            _ => terms.push((operand, coefficient)),
        }
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
                *coefficient *= &value.pow(exponent);
            }
            Node::Product(inner) => {
                for (factor, power) in inner.clone() {
                    self.collect_factor(coefficient, powers, factor, power * exponent);
                }
            }
            Node::Sum(terms) => {
                let content = content_of(terms);
                if content.is_one() {
                    powers.push((operand, exponent));
                    return;
                }
                *coefficient *= &content.pow(exponent);
                let over = |(operand, q): &(ExprId, Rational)| (*operand, q / &content);
                let terms: Terms = terms.iter().map(over).collect();
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
