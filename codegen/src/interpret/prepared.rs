//! Expressions and circuits made ready for being evaluated at many points: their constants are converted once, and the
//! operands of all operations stand in one array.

use std::ops::Range;
use std::sync::Arc;

use smallvec::SmallVec;

use super::{Number, times_power};
use crate::circuit::{Circuit, Operation};
use crate::graph::{ExprId, Function, Graph, Node, Rational, Table};

/// Operations in order, operands before their users, over one kind of number.
pub struct Prepared<N> {
    steps: Vec<Step>,
    /// All constants and coefficients.
    constants: Vec<N>,
    /// What sums add: places of earlier steps, with the places of coefficients other than 1.
    terms: Vec<(u32, Option<u32>)>,
    /// What products multiply: places of earlier steps with powers.
    factors: Vec<(u32, u32)>,
    /// What functions are of.
    operands: Vec<u32>,
    outputs: Vec<u32>,
    tables: Arc<Vec<Table>>,
}

/// An operation; what it is of is a part of an array of [`Prepared`].
enum Step {
    Constant(u32),
    Symbol(usize),
    Sum(Range<u32>),
    Product(Range<u32>),
    /// A product over another; over nothing where the numerator is 1.
    Fraction(Range<u32>, Range<u32>),
    Quotient(u32, u32),
    Apply(Function, Range<u32>),
    Tabulated {
        table: usize,
        order: usize,
        argument: u32,
    },
}

/// What no operation gives.
fn nothing<N: Number>() -> N {
    N::rational(&Rational::ZERO).divide(&N::rational(&Rational::ZERO))
}

/// A part of an array.
fn part<'a, T>(array: &'a [T], range: &Range<u32>) -> &'a [T] {
    &array[range.start as usize..range.end as usize]
}

/// Adds to an array, and says where.
fn added<T>(array: &mut Vec<T>, items: impl IntoIterator<Item = T>) -> Range<u32> {
    let start = array.len() as u32;
    array.extend(items);
    start..array.len() as u32
}

impl<N: Number> Prepared<N> {
    fn empty(graph: &Graph, steps: usize) -> Self {
        Self {
            steps: Vec::with_capacity(steps),
            constants: Vec::new(),
            terms: Vec::new(),
            factors: Vec::new(),
            operands: Vec::new(),
            outputs: Vec::new(),
            tables: Arc::clone(&graph.tables),
        }
    }

    /// The roots of a graph, where the expressions that they need are known, operands before their users. `None` if an
    /// integral is among them.
    pub fn of_graph(graph: &Graph, order: &[ExprId], roots: &[ExprId]) -> Option<Self> {
        let mut prepared = Self::empty(graph, order.len());
        let mut places = vec![0_u32; graph.len()];
        for (place, id) in order.iter().enumerate() {
            let step = prepared.step_of_node(graph, *id, &places)?;
            prepared.steps.push(step);
            places[id.index()] = place as u32;
        }
        prepared.outputs = roots.iter().map(|root| places[root.index()]).collect();
        Some(prepared)
    }

    fn step_of_node(&mut self, graph: &Graph, id: ExprId, places: &[u32]) -> Option<Step> {
        let place = |operand: &ExprId| places[operand.index()];
        Some(match graph.node(id) {
            Node::Number(number) => Step::Constant(self.constant(N::rational(number))),
            Node::Constant(constant) => Step::Constant(self.constant(N::constant(*constant))),
            Node::Symbol(symbol) => Step::Symbol(symbol.index()),
            Node::Sum(terms) => self.sum(terms.iter().map(|(operand, q)| (place(operand), q))),
            Node::Product(factors) => {
                let side = |sign: i32| {
                    let factors = factors.iter().filter(move |(_, n)| n.signum() == sign);
                    factors.map(|(operand, n)| (place(operand), n.unsigned_abs()))
                };
                let above = added(&mut self.factors, side(1));
                let below = added(&mut self.factors, side(-1));
                if below.is_empty() {
                    Step::Product(above)
                } else {
                    Step::Fraction(above, below)
                }
            }
            Node::Apply(function, operands) => {
                let operands = operands.iter().map(place);
                Step::Apply(*function, added(&mut self.operands, operands))
            }
            Node::Tabulated {
                table,
                order,
                argument,
            } => Step::Tabulated {
                table: *table,
                order: *order,
                argument: place(argument),
            },
            Node::Integral { .. } => return None,
        })
    }

    /// The operations of a circuit, in the order in which its code does them.
    pub fn of_circuit(graph: &Graph, circuit: &Circuit) -> Self {
        let mut prepared = Self::empty(graph, circuit.nets().size_hint().0);
        for net in circuit.nets() {
            let step = prepared.step_of_operation(circuit.operation(net));
            prepared.steps.push(step);
        }
        let outputs = circuit.outputs.iter();
        prepared.outputs = outputs.map(|output| output.index() as u32).collect();
        prepared
    }

    fn step_of_operation(&mut self, operation: &Operation) -> Step {
        match operation {
            Operation::Number(number) => Step::Constant(self.constant(N::rational(number))),
            Operation::Symbol(symbol) => Step::Symbol(symbol.index()),
            Operation::Sum(terms) => {
                let terms = terms.iter();
                self.sum(terms.map(|(operand, q)| (operand.index() as u32, q)))
            }
            Operation::Product(factors) => {
                let factors = factors.iter();
                let factors = factors.map(|(operand, power)| (operand.index() as u32, *power));
                Step::Product(added(&mut self.factors, factors))
            }
            Operation::Quotient(numerator, denominator) => {
                Step::Quotient(numerator.index() as u32, denominator.index() as u32)
            }
            Operation::Apply(function, operands) => {
                let operands = operands.iter().map(|operand| operand.index() as u32);
                Step::Apply(*function, added(&mut self.operands, operands))
            }
            Operation::Tabulated {
                table,
                order,
                argument,
            } => Step::Tabulated {
                table: *table,
                order: *order,
                argument: argument.index() as u32,
            },
        }
    }

    /// The place of a constant.
    fn constant(&mut self, value: N) -> u32 {
        self.constants.push(value);
        (self.constants.len() - 1) as u32
    }

    /// A sum; most terms are of the coefficient 1, which is not multiplied with.
    fn sum<'q>(&mut self, terms: impl Iterator<Item = (u32, &'q Rational)>) -> Step {
        let start = self.terms.len() as u32;
        for (place, coefficient) in terms {
            let is_multiple = !coefficient.is_one();
            let coefficient = is_multiple.then(|| self.constant(N::rational(coefficient)));
            self.terms.push((place, coefficient));
        }
        Step::Sum(start..self.terms.len() as u32)
    }

    /// How many operations there are.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The outputs for values of the symbols, in the order in which the graph has these.
    pub fn at(&self, symbols: &[N]) -> Vec<N> {
        self.at_with(symbols, &mut Vec::new())
    }

    /// Evaluates at a point as [`at`](Self::at) does, in memory that the caller keeps for the next point.
    pub fn at_with(&self, symbols: &[N], values: &mut Vec<N>) -> Vec<N> {
        values.clear();
        values.reserve(self.steps.len());
        for step in &self.steps {
            let value = self.value(step, symbols, values);
            values.push(value);
        }
        let outputs = self.outputs.iter();
        outputs
            .map(|output| values[*output as usize].clone())
            .collect()
    }

    fn value(&self, step: &Step, symbols: &[N], values: &[N]) -> N {
        let value = |place: u32| &values[place as usize];
        match step {
            Step::Constant(place) => self.constants[*place as usize].clone(),
            Step::Symbol(symbol) => symbols.get(*symbol).cloned().unwrap_or_else(nothing),
            Step::Sum(terms) => self
                .sum_of(part(&self.terms, terms), values)
                .unwrap_or_else(|| N::rational(&Rational::ZERO)),
            Step::Product(factors) => self.product(factors, values).unwrap_or_else(nothing),
            Step::Fraction(above, below) => {
                let one = || N::rational(&Rational::ONE);
                let above = self.product(above, values).unwrap_or_else(one);
                let below = self.product(below, values).unwrap_or_else(one);
                above.divide(&below)
            }
            Step::Quotient(numerator, denominator) => value(*numerator).divide(value(*denominator)),
            Step::Apply(function, operands) => match part(&self.operands, operands) {
                [operand] => N::apply(*function, std::slice::from_ref(value(*operand))),
                operands => {
                    let operands = operands.iter().map(|operand| value(*operand).clone());
                    let operands: SmallVec<[N; 4]> = operands.collect();
                    N::apply(*function, &operands)
                }
            },
            Step::Tabulated {
                table,
                order,
                argument,
            } => match self.tables.get(*table) {
                Some(table) => N::tabulated(table, *order, value(*argument)),
                None => nothing(),
            },
        }
    }

    /// None of no terms.
    fn sum_of(&self, terms: &[(u32, Option<u32>)], values: &[N]) -> Option<N> {
        let mut sum: Option<N> = None;
        for (place, coefficient) in terms {
            let value = &values[*place as usize];
            let multiple = coefficient.map(|place| self.constants[place as usize].multiply(value));
            let term = multiple.as_ref().unwrap_or(value);
            sum = Some(match sum {
                None => term.clone(),
                Some(sum) => sum.add(term),
            });
        }
        sum
    }

    /// None of no factors.
    fn product(&self, factors: &Range<u32>, values: &[N]) -> Option<N> {
        let factors = part(&self.factors, factors).iter();
        factors.fold(None, |product, (place, power)| {
            times_power(product, &values[*place as usize], *power)
        })
    }
}
