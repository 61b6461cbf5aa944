//! How much rounding a form of a formula may bring in: the running error of every operation, added up at points that
//! are chosen to make sums cancel.
//!
//! Forms that are equal on paper differ in floating point: $(x-y)(x+y)$ keeps the digits that $x^2-y^2$ loses. A form with
//! fewer operations is taken only where it is as good as the author's at every point of [`Reference`], and finite
//! wherever that is. Of such forms one that also stays in the range of numbers far from 1, where the author's does, is
//! taken before a cheaper one that does not, unless it costs much more.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::circuit::Circuit;
use crate::graph::{
    ExprId, Function, Graph, NamedConstant, Node, Rational, Symbol, SymbolId, Table,
};
use crate::interpret::{self, Number, constant_value};
use crate::parallel::on_all_cores;

/// How many points are looked at.
const POINTS: u64 = 96;

/// And how many whose numbers are all far from 1, where products of two or three of them leave the range of numbers.
const FAR_POINTS: u64 = 32;

/// The sizes of numbers at those.
const FAR: [f64; 4] = [1e170, 1e-170, 1e100, 1e-100];

/// How much larger than the author's the error of a form may be. Both are bounds, which grow with the number of
/// operations; a cancellation is larger by orders of magnitude.
const ALLOWED: f64 = 64.0;

/// A value with a bound of its error in units of the last place of 1.
#[derive(Clone, Copy, Debug)]
struct Bounded {
    value: f64,
    error: f64,
}

impl Bounded {
    fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A result that is rounded to the nearest number.
    fn rounded(value: f64, inherited: f64) -> Self {
        Self {
            value,
            error: inherited + value.abs(),
        }
    }

    /// A product or quotient of numbers other than 0, which loses digits or all of them below the smallest normal number.
    fn scaled(value: f64, inherited: f64) -> Self {
        let mut scaled = Self::rounded(value, inherited);
        if value.abs() < f64::MIN_POSITIVE {
            scaled.error += f64::MIN_POSITIVE;
        }
        scaled
    }

    fn is_unit(self) -> bool {
        self.error == 0.0 && self.value.abs() == 1.0
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }

    /// Whether it has digits to lose.
    fn has_digits(self) -> bool {
        self.is_finite() && self.error * f64::EPSILON <= 1e-3 * self.value.abs()
    }
}

/// A function and its derivative at a value.
fn smooth(function: Function, x: f64) -> (f64, f64) {
    match function {
        Function::Sin => (x.sin(), x.cos()),
        Function::Cos => (x.cos(), x.sin()),
        Function::Tan => (x.tan(), 1.0 + x.tan().powi(2)),
        Function::Exp => (x.exp(), x.exp()),
        Function::Ln => (x.ln(), x.recip()),
        _ => (f64::NAN, f64::NAN),
    }
}

impl Number for Bounded {
    fn rational(value: &Rational) -> Self {
        let nearest = value.to_f64().unwrap_or(f64::NAN);
        if value.is_integer() && nearest.abs() < 1e15 {
            Self::exact(nearest)
        } else {
            Self::rounded(nearest, 0.0)
        }
    }

    fn constant(constant: NamedConstant) -> Self {
        Self::rounded(constant_value(constant), 0.0)
    }

    fn add(&self, other: &Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }

    fn multiply(&self, other: &Self) -> Self {
        let inherited = self.value.abs() * other.error + other.value.abs() * self.error;
        let value = self.value * other.value;
        if self.is_unit() || other.is_unit() {
            return Self {
                value,
                error: inherited,
            };
        }
        if self.value == 0.0 || other.value == 0.0 {
            return Self::rounded(value, inherited);
        }
        Self::scaled(value, inherited)
    }

    fn divide(&self, other: &Self) -> Self {
        let quotient = self.value / other.value;
        let inherited = (self.error + quotient.abs() * other.error) / other.value.abs();
        if other.is_unit() {
            return Self {
                value: quotient,
                error: inherited,
            };
        }
        if self.value == 0.0 {
            return Self::rounded(quotient, inherited);
        }
        Self::scaled(quotient, inherited)
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        match (function, operands) {
            (Function::Abs, [x]) => Self {
                value: x.value.abs(),
                error: x.error,
            },
            (Function::Sqrt, [x]) if x.error == 0.0 => Self::rounded(x.value.sqrt(), 0.0),
            (Function::Sqrt, [x]) => Self::rounded(x.value.sqrt(), 0.5 * x.error / x.value.sqrt()),
            (Function::Sign, [x]) => Self::exact(x.value.signum()),
            (Function::Min, [x, y]) => *if x.value <= y.value { x } else { y },
            (Function::Max, [x, y]) => *if x.value >= y.value { x } else { y },
            (Function::Select, [a, b, x, y]) => *if a.value <= b.value { x } else { y },
            (function, [x, ..]) => {
                let (value, slope) = smooth(function, x.value);
                Self::rounded(value, x.error * slope.abs())
            }
            _ => Self::exact(f64::NAN),
        }
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        let slope = table.derivative(order + 1).evaluate(argument.value);
        let value = table.derivative(order).evaluate(argument.value);
        Self::rounded(value, argument.error * slope.abs())
    }
}

/// The author's form at all points: what every other form is held against.
pub struct Reference {
    points: Vec<Vec<Bounded>>,
    outputs: Vec<Vec<Bounded>>,
}

impl Reference {
    /// The form in which the outputs stand in the graph.
    pub fn of(graph: &Graph, outputs: &[ExprId]) -> Self {
        let differences = differences(graph, outputs);
        let points: Vec<Vec<Bounded>> = (0..POINTS + FAR_POINTS)
            .map(|number| point(graph, &differences, number))
            .collect();
        let order = graph.reachable(outputs);
        let outputs = on_all_cores(&points, |point| {
            interpret::evaluate_in_order(graph, &order, outputs, point).unwrap_or_default()
        });
        Self { points, outputs }
    }

    /// Whether a circuit of the same outputs loses no more digits, and is finite wherever the author's form is.
    pub fn admits(&self, graph: &Graph, circuit: &Circuit) -> bool {
        self.admits_among(0..POINTS as usize, graph, circuit)
    }

    /// The same for numbers far from 1.
    pub fn admits_far(&self, graph: &Graph, circuit: &Circuit) -> bool {
        self.admits_among(POINTS as usize..self.points.len(), graph, circuit)
    }

    fn admits_among(&self, places: Range<usize>, graph: &Graph, circuit: &Circuit) -> bool {
        let is_admitted = AtomicBool::new(true);
        on_all_cores(&places.collect::<Vec<_>>(), |place| {
            // One point decides.
            if is_admitted.load(Ordering::Relaxed) && !self.admits_at(*place, graph, circuit) {
                is_admitted.store(false, Ordering::Relaxed);
            }
        });
        is_admitted.into_inner()
    }

    fn admits_at(&self, place: usize, graph: &Graph, circuit: &Circuit) -> bool {
        let found = interpret::evaluate_circuit(graph, circuit, &self.points[place]);
        let known = self.outputs[place].iter().zip(&found);
        let mut known = known.filter(|(known, _)| known.has_digits());
        known.all(|(known, found)| {
            found.is_finite() && found.error <= ALLOWED * (known.error + known.value.abs())
        })
    }
}

/// Two terms of a sum that cancel where `symbol` has `ratio` times the value of `other`, and the sum's other symbols.
struct Difference {
    symbol: SymbolId,
    /// None for the number 1.
    other: Option<SymbolId>,
    ratio: f64,
    rest: Vec<SymbolId>,
}

/// Where the author subtracts inputs from each other or from numbers: there they may well be nearly equal.
fn differences(graph: &Graph, roots: &[ExprId]) -> Vec<Difference> {
    let mut differences = Vec::new();
    for id in graph.reachable(roots) {
        let Node::Sum(terms) = graph.node(id) else {
            continue;
        };
        let mut inputs = Vec::new();
        for (operand, coefficient) in terms {
            let coefficient = coefficient.to_f64().unwrap_or(f64::NAN);
            match graph.node(*operand) {
                Node::Symbol(symbol) => inputs.push((Some(*symbol), coefficient)),
                Node::Number(value) if value.is_one() => inputs.push((None, coefficient)),
                _ => {}
            }
        }
        for (position, (symbol, coefficient)) in inputs.iter().enumerate() {
            for (other, subtracted) in inputs.iter().skip(position + 1) {
                let (symbol, other, ratio) = match (symbol, other) {
                    (Some(symbol), other) => (*symbol, *other, -subtracted / coefficient),
                    (None, Some(other)) => (*other, None, -coefficient / subtracted),
                    (None, None) => continue,
                };
                let rest = inputs.iter().filter_map(|(input, _)| *input);
                let rest = rest.filter(|input| *input != symbol && Some(*input) != other);
                differences.push(Difference {
                    symbol,
                    other,
                    ratio,
                    rest: rest.collect(),
                });
            }
        }
    }
    differences
}

/// The symbols' values at a point, each an exact number within its domain: of the sizes of everyday, and in most points
/// such that some of the differences nearly or wholly vanish.
fn point(graph: &Graph, differences: &[Difference], number: u64) -> Vec<Bounded> {
    let mut random = Random::new(number);
    let far = number >= POINTS;
    let size = if far {
        FAR[(number % 4) as usize]
    } else {
        [1.0, 1.0, 1.0, 1e9, 1e-9, 0.3][(number % 6) as usize]
    };
    let within = |symbol: &Symbol, value: f64| {
        if symbol.sign.is_not_negative() {
            value.abs()
        } else if symbol.sign.is_not_positive() {
            -value.abs()
        } else {
            value
        }
    };
    let mut values: Vec<f64> = Vec::new();
    for (_, symbol) in graph.symbols() {
        let magnitude = size * (1.0 + random.below(1 << 10) as f64 / 1024.0);
        let negative = random.below(4) == 0;
        values.push(within(
            symbol,
            if negative { -magnitude } else { magnitude },
        ));
    }
    for difference in differences {
        if far || number.is_multiple_of(4) || random.below(2) == 0 {
            continue;
        }
        let other = difference.other.map_or(1.0, |other| values[other.index()]);
        let near = 1.0 + random.below(4) as f64 * 2.0_f64.powi(-40);
        let symbol = graph.symbol(difference.symbol);
        values[difference.symbol.index()] = within(symbol, difference.ratio * other * near);
        if random.below(2) == 0 {
            for small in &difference.rest {
                values[small.index()] *= 1e-17;
            }
        }
    }
    values.into_iter().map(Bounded::exact).collect()
}

/// The same numbers at every build.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, bound: u64) -> u64 {
        // A linear congruence; its upper bits are the good ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}
