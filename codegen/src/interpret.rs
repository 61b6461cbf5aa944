//! Evaluates a graph, node by node: what generated code is tested against, and what the numerics of the build use.

pub mod double_double;
pub mod prepared;

use std::collections::BTreeSet;

pub use prepared::Prepared;

use crate::approximate::piecewise::PiecewisePolynomial;
use crate::approximate::quadrature::integrate;
use crate::circuit::Circuit;
use crate::graph::{
    Evaluation, ExprId, Function, Graph, NamedConstant, Node, Rational, SymbolId, Table,
};

/// A kind of number that a graph can be evaluated in: `f64`, or more digits in tests.
pub trait Number: Clone {
    /// The nearest to an exact constant.
    fn rational(value: &Rational) -> Self;
    /// The nearest to a named constant.
    fn constant(constant: NamedConstant) -> Self;
    /// The sum of two.
    fn add(&self, other: &Self) -> Self;
    /// The product of two.
    fn multiply(&self, other: &Self) -> Self;
    /// The quotient of two.
    fn divide(&self, other: &Self) -> Self;
    /// An elementary function.
    fn apply(function: Function, operands: &[Self]) -> Self;
    /// The derivative of some order of a tabulated function.
    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self;
}

/// The named constant to the nearest `f64`.
pub fn constant_value(constant: NamedConstant) -> f64 {
    match constant {
        NamedConstant::Pi => std::f64::consts::PI,
        NamedConstant::E => std::f64::consts::E,
        NamedConstant::Ln2 => std::f64::consts::LN_2,
        NamedConstant::Ln10 => std::f64::consts::LN_10,
        NamedConstant::EulerGamma => std::f64::consts::EULER_GAMMA,
    }
}

impl Number for f64 {
    fn rational(value: &Rational) -> Self {
        value.to_f64().unwrap_or(f64::NAN)
    }

    fn constant(constant: NamedConstant) -> Self {
        constant_value(constant)
    }

    fn add(&self, other: &Self) -> Self {
        self + other
    }

    fn multiply(&self, other: &Self) -> Self {
        self * other
    }

    fn divide(&self, other: &Self) -> Self {
        self / other
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        match (function.row().evaluation, operands) {
            (Evaluation::One(value, _) | Evaluation::Step(value), [x]) => value(*x),
            (Evaluation::Two(value, _), [x, y]) => value(*x, *y),
            _ => own_value(function, operands),
        }
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        table.derivative(order).evaluate(*argument)
    }
}

/// The value of a function that has rules of its own.
fn own_value(function: Function, operands: &[f64]) -> f64 {
    match (function, operands) {
        (Function::Sqrt, [x]) => x.sqrt(),
        (Function::Abs, [x]) => x.abs(),
        (Function::Sign, [x]) => x.signum(),
        (Function::Min, [x, y]) => x.min(*y),
        (Function::Max, [x, y]) => x.max(*y),
        (Function::Side, [x]) => 1.0_f64.copysign(x + 0.0),
        (Function::SignBit, [x]) => 1.0_f64.copysign(*x),
        (Function::MulAdd, [a, b, c]) => a.mul_add(*b, *c),
        (_, [a, b, x, y]) => {
            if function.holds(a, b) {
                *x
            } else {
                *y
            }
        }
        _ => f64::NAN,
    }
}

/// A term of a sum; most are of the coefficient 1.
fn multiple<T: Number>(coefficient: &Rational, value: T) -> T {
    if coefficient.is_one() {
        value
    } else {
        T::rational(coefficient).multiply(&value)
    }
}

/// Powers up to this are products of so many factors, as they are emitted; of larger ones that would take as long as a
/// formula of that size.
const LARGEST_PRODUCT: u32 = 16;

/// A product with a power of a number as one more factor, or as so many; nothing of no factors.
fn times_power<T: Number>(product: Option<T>, base: &T, power: u32) -> Option<T> {
    let times = |product: Option<T>, factor: &T| match product {
        None => factor.clone(),
        Some(product) => product.multiply(factor),
    };
    if power > LARGEST_PRODUCT {
        return Some(times(product, &raised(base, power)));
    }
    (0..power).fold(product, |product, _| Some(times(product, base)))
}

/// A power of at least one, worked out by squares.
fn raised<T: Number>(base: &T, power: u32) -> T {
    let bits = (0..power.ilog2()).rev().map(|bit| power >> bit & 1 == 1);
    bits.fold(base.clone(), |raised, is_odd| {
        let square = raised.multiply(&raised);
        if is_odd {
            square.multiply(base)
        } else {
            square
        }
    })
}

/// One node's value from the values of its operands. Integrals have none here.
pub(crate) fn node_value<T: Number>(
    graph: &Graph,
    id: ExprId,
    symbols: &[T],
    value: &impl Fn(ExprId) -> T,
) -> Option<T> {
    Some(match graph.node(id) {
        Node::Number(number) => T::rational(number),
        Node::Constant(constant) => T::constant(*constant),
        Node::Symbol(symbol) => symbols.get(symbol.index())?.clone(),
        Node::Sum(terms) => {
            let mut terms = terms
                .iter()
                .map(|(operand, coefficient)| multiple(coefficient, value(*operand)));
            let first = terms.next()?;
            terms.fold(first, |sum, term| sum.add(&term))
        }
        Node::Product(factors) => {
            let one = T::rational(&crate::graph::whole(1));
            let (mut numerator, mut denominator) = (Some(one.clone()), Some(one));
            for (operand, exponent) in factors {
                let side = if *exponent > 0 {
                    &mut numerator
                } else {
                    &mut denominator
                };
                *side = times_power(side.take(), &value(*operand), exponent.unsigned_abs());
            }
            numerator?.divide(&denominator?)
        }
        Node::Apply(function, operands) => {
            let operands: Vec<T> = operands.iter().map(|operand| value(*operand)).collect();
            T::apply(*function, &operands)
        }
        Node::Tabulated {
            table,
            order,
            argument,
        } => T::tabulated(graph.tables.get(*table)?, *order, &value(*argument)),
        Node::Integral { .. } => return None,
    })
}

/// The values of the roots, for values of the symbols in the order in which the graph has them. `None` if an
/// integral is among them or a symbol has no value.
pub fn evaluate<T: Number>(graph: &Graph, roots: &[ExprId], symbols: &[T]) -> Option<Vec<T>> {
    let mut values: Vec<Option<T>> = vec![None; graph.len()];
    let zero = T::rational(&Rational::ZERO);
    for id in graph.reachable(roots) {
        let value = node_value(graph, id, symbols, &|operand: ExprId| {
            values[operand.index()]
                .clone()
                .unwrap_or_else(|| zero.clone())
        })?;
        values[id.index()] = Some(value);
    }
    roots
        .iter()
        .map(|root| values[root.index()].clone())
        .collect()
}

/// Why a function of one variable has no value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct EvaluateError(String);

/// One node made ready for being evaluated many times in `f64`.
enum Step {
    Value(f64),
    Symbol(usize),
    Sum(Vec<(usize, f64)>),
    Product(Vec<(usize, i32)>),
    Apply(Function, Vec<usize>),
    Tabulated(PiecewisePolynomial, usize),
    Integral {
        variable: usize,
        integrand: usize,
        lower: usize,
        upper: usize,
        inner: Vec<usize>,
    },
}

/// Evaluates functions of one variable that hold integrals, for the numerics of the build.
pub struct Integrator<'g> {
    graph: &'g Graph,
    tolerance: f64,
    symbols: Vec<f64>,
    values: Vec<f64>,
    steps: Vec<Step>,
}

impl<'g> Integrator<'g> {
    /// An evaluator of everything in the graph; `tolerance` is relative and for each integral.
    pub fn new(graph: &'g Graph, tolerance: f64) -> Self {
        let steps = (0..graph.len())
            .filter_map(|position| graph.expression(position))
            .map(|id| step(graph, id))
            .collect();
        Self {
            graph,
            tolerance,
            symbols: vec![f64::NAN; graph.symbols().count()],
            values: vec![f64::NAN; graph.len()],
            steps,
        }
    }

    /// The root's value where the symbol has the given value.
    ///
    /// # Errors
    /// The text of what the quadrature could not do.
    pub fn evaluate(
        &mut self,
        root: ExprId,
        symbol: SymbolId,
        value: f64,
    ) -> Result<f64, EvaluateError> {
        self.symbols[symbol.index()] = value;
        let inside: BTreeSet<usize> = self
            .steps
            .iter()
            .flat_map(|step| match step {
                Step::Integral { inner, .. } => inner.as_slice(),
                _ => &[],
            })
            .copied()
            .collect();
        let reachable = self.graph.reachable(&[root]).into_iter().map(ExprId::index);
        let order: Vec<usize> = reachable
            .filter(|position| !inside.contains(position))
            .collect();
        self.run(&order)?;
        Ok(self.values[root.index()])
    }

    fn run(&mut self, order: &[usize]) -> Result<(), EvaluateError> {
        for &position in order {
            let value = match &mut self.steps[position] {
                Step::Integral { inner, .. } => {
                    let inner = std::mem::take(inner);
                    let result = self.integral(position, &inner);
                    if let Step::Integral { inner: place, .. } = &mut self.steps[position] {
                        *place = inner;
                    }
                    result?
                }
                step => elementary(step, &self.values, &self.symbols),
            };
            self.values[position] = value;
        }
        Ok(())
    }

    fn integral(&mut self, position: usize, inner: &[usize]) -> Result<f64, EvaluateError> {
        let Step::Integral {
            variable,
            integrand,
            lower,
            upper,
            ..
        } = self.steps[position]
        else {
            return Ok(self.values[position]);
        };
        let (lower, upper, tolerance) = (self.values[lower], self.values[upper], self.tolerance);
        let mut sample = |x: f64| -> Result<f64, EvaluateError> {
            self.symbols[variable] = x;
            self.run(inner)?;
            Ok(self.values[integrand])
        };
        integrate(&mut sample, lower, upper, tolerance)
            .map_err(|error| EvaluateError(describe(&error)))
    }
}

fn step(graph: &Graph, id: ExprId) -> Step {
    match graph.node(id) {
        Node::Number(value) => Step::Value(f64::rational(value)),
        Node::Constant(constant) => Step::Value(constant_value(*constant)),
        Node::Symbol(symbol) => Step::Symbol(symbol.index()),
        Node::Sum(terms) => Step::Sum(
            terms
                .iter()
                .map(|(operand, q)| (operand.index(), f64::rational(q)))
                .collect(),
        ),
        Node::Product(factors) => Step::Product(
            factors
                .iter()
                .map(|(operand, n)| (operand.index(), *n))
                .collect(),
        ),
        Node::Apply(function, operands) => Step::Apply(
            *function,
            operands.iter().map(|operand| operand.index()).collect(),
        ),
        Node::Tabulated {
            table,
            order,
            argument,
        } => match graph.tables.get(*table) {
            Some(table) => Step::Tabulated(table.derivative(*order), argument.index()),
            None => Step::Value(f64::NAN),
        },
        Node::Integral {
            variable,
            integrand,
            lower,
            upper,
        } => Step::Integral {
            variable: variable.index(),
            integrand: integrand.index(),
            lower: lower.index(),
            upper: upper.index(),
            inner: changing(graph, *integrand, *variable)
                .into_iter()
                .map(ExprId::index)
                .collect(),
        },
    }
}

/// The value of a step that is no integral.
fn elementary(step: &Step, values: &[f64], symbols: &[f64]) -> f64 {
    match step {
        Step::Value(value) => *value,
        Step::Symbol(symbol) => symbols[*symbol],
        Step::Sum(terms) => terms
            .iter()
            .map(|(operand, coefficient)| coefficient * values[*operand])
            .sum(),
        Step::Product(factors) => {
            let (mut above, mut below) = (1.0, 1.0);
            for (operand, exponent) in factors {
                let value = values[*operand];
                match exponent {
                    1 => above *= value,
                    -1 => below *= value,
                    2.. => above *= value.powi(*exponent),
                    _ => below *= value.powi(-exponent),
                }
            }
            above / below
        }
        Step::Apply(function, operands) => match operands.as_slice() {
            [x] => f64::apply(*function, &[values[*x]]),
            operands => f64::apply(
                *function,
                &operands
                    .iter()
                    .map(|operand| values[*operand])
                    .collect::<Vec<_>>(),
            ),
        },
        Step::Tabulated(polynomial, argument) => polynomial.evaluate(values[*argument]),
        Step::Integral { .. } => f64::NAN,
    }
}

/// The error with what caused it.
pub(crate) fn describe(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(source) => format!("{error}: {}", describe(source)),
        None => error.to_string(),
    }
}

/// The nodes of an integrand that change with its variable, but for those that nested integrals run through.
fn changing(graph: &Graph, integrand: ExprId, variable: SymbolId) -> Vec<ExprId> {
    let depends = graph.depends_on(&BTreeSet::from([variable]));
    let nested: Vec<Vec<bool>> = bound_variables(graph, integrand)
        .into_iter()
        .map(|variable| graph.depends_on(&BTreeSet::from([variable])))
        .collect();
    graph
        .reachable(&[integrand])
        .into_iter()
        .filter(|id| depends[id.index()] && !nested.iter().any(|inside| inside[id.index()]))
        .collect()
}

fn bound_variables(graph: &Graph, root: ExprId) -> BTreeSet<SymbolId> {
    graph
        .reachable(&[root])
        .into_iter()
        .filter_map(|id| match graph.node(id) {
            Node::Integral { variable, .. } => Some(*variable),
            _ => None,
        })
        .collect()
}

/// The outputs of a circuit, computed in the order in which its code computes them; `symbols` has a number for each symbol
/// of its graph.
pub fn evaluate_circuit<N: Number>(graph: &Graph, circuit: &Circuit, symbols: &[N]) -> Vec<N> {
    Prepared::of_circuit(graph, circuit).at(symbols)
}
