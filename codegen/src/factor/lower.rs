//! From the graph to operations: constants to their decimal values, quotients to as few divisions as there can be.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Pow, Signed};
use rustc_hash::FxHashMap;
use smallvec::smallvec;

use super::constants;
use crate::circuit::{Circuit, Net, Operation, Terms};
use crate::graph::{ExprId, Function, Graph, NamedConstant, Node, Rational, decimal, rational};

/// Digits of a constant that is not rational, many more than any number type of the output has.
const CONSTANT_DIGITS: u32 = 60;

/// The circuit of the roots as they stand, without any extraction: the inverse of a size by itself or as the size of an
/// inverse, whichever costs less.
pub fn lower(graph: &Graph, roots: &[ExprId]) -> Circuit {
    let apart = lowered(graph, roots, false);
    let is_size = |id: ExprId| matches!(graph.node(id), Node::Apply(Function::Abs, _));
    if !graph.reachable(roots).into_iter().any(is_size) {
        return apart;
    }
    let shared = lowered(graph, roots, true);
    if shared.cost().weight() < apart.cost().weight() {
        shared
    } else {
        apart
    }
}

fn lowered(graph: &Graph, roots: &[ExprId], sizes: bool) -> Circuit {
    let mut lowering = Lowering {
        graph,
        circuit: Circuit::default(),
        values: vec![None; graph.len()],
        inverted: shared_divisors(graph, roots, sizes),
    };
    for id in graph.reachable(roots) {
        let value = lowering.value(id);
        if let Some(name) = graph.suggested_name(id)
            && value.0.is_one()
        {
            lowering.circuit.suggest_name(value.1, name);
        }
        lowering.values[id.index()] = Some(value);
    }
    let mut outputs = Vec::new();
    for root in roots {
        let net = lowering.net(*root);
        if let Some(name) = graph.suggested_name(*root) {
            lowering.circuit.suggest_name(net, name);
        }
        outputs.push(net);
    }
    lowering.circuit.outputs = outputs;
    lowering.circuit.tidy();
    lowering.circuit
}

/// A rational multiple of an operation; a constant is a multiple of the number 1.
type Multiple = (Rational, Net);

struct Lowering<'g> {
    graph: &'g Graph,
    circuit: Circuit,
    values: Vec<Option<Multiple>>,
    inverted: Divisors,
}

/// How divisions are shared.
#[derive(Default)]
struct Divisors {
    /// Whether the inverse of a size is the size of the inverse.
    sizes: bool,
    /// Factors whose inverse is computed once and multiplied by.
    factors: BTreeSet<ExprId>,
    /// Whole denominators whose inverse is computed once and multiplied by.
    products: BTreeSet<Vec<(ExprId, u32)>>,
}

impl Lowering<'_> {
    fn multiple(&mut self, id: ExprId) -> Multiple {
        match &self.values[id.index()] {
            Some(value) => value.clone(),
            // Operands are lowered before their users.
            None => self.value(id),
        }
    }

    /// The operation whose value is that of the expression, the rational factor included.
    fn net(&mut self, id: ExprId) -> Net {
        let (coefficient, net) = self.multiple(id);
        self.circuit.sum([(net, coefficient)])
    }

    fn one(&mut self) -> Net {
        self.circuit.number(Rational::ONE)
    }

    fn value(&mut self, id: ExprId) -> Multiple {
        match self.graph.node(id) {
            Node::Number(value) => (value.clone(), self.one()),
            Node::Constant(constant) => (digits_of(*constant), self.one()),
            Node::Symbol(symbol) => (Rational::ONE, self.circuit.push(Operation::Symbol(*symbol))),
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => self.product(factors),
            Node::Apply(function, operands) => self.apply(*function, operands),
            Node::Tabulated {
                table,
                order,
                argument,
            } => {
                let argument = self.net(*argument);
                let operation = Operation::Tabulated {
                    table: *table,
                    order: *order,
                    argument,
                };
                (Rational::ONE, self.circuit.push(operation))
            }
            // Integrals were refused before anything is lowered.
            Node::Integral { .. } => (Rational::ZERO, self.one()),
        }
    }

    fn sum(&mut self, terms: &[(ExprId, Rational)]) -> Multiple {
        let mut collected = Terms::with_capacity(terms.len());
        for (operand, coefficient) in terms {
            let (inner, net) = self.multiple(*operand);
            collected.push((net, coefficient * &inner));
        }
        rational::collect(&mut collected);
        let terms = collected;
        let (first, terms) = match terms.as_slice() {
            [] => return (Rational::ZERO, self.one()),
            [(net, coefficient)] => return (coefficient.clone(), *net),
            [(_, first), ..] => (first.clone(), terms),
        };
        // A factor common to all terms is taken out: one multiplication for all.
        let common = terms
            .iter()
            .all(|(_, coefficient)| coefficient.abs() == first.abs());
        let content = if common { first.abs() } else { Rational::ONE };
        let scaled: Vec<_> = terms
            .into_iter()
            .map(|(net, coefficient)| (net, &coefficient / &content))
            .collect();
        (content, self.circuit.sum(scaled))
    }

    fn product(&mut self, factors: &[(ExprId, i32)]) -> Multiple {
        let mut coefficient = Rational::ONE;
        let mut numerator = Vec::new();
        let mut denominator = Vec::new();
        let mut divisors = Vec::new();
        let (quotient, power, factors) = power_of_quotient(factors);
        if power > 1 {
            let (inner, net) = self.product(&quotient);
            coefficient *= &inner.pow(power.cast_signed());
            numerator.push((net, power));
        }
        for (factor, exponent) in &factors {
            let (inner, net) = self.multiple(*factor);
            if inner.is_zero() && *exponent < 0 {
                // A division by zero stays one, with the result that it has in floating point.
                denominator.push((self.circuit.number(inner), 1));
                divisors.push((*factor, exponent.unsigned_abs()));
                continue;
            }
            coefficient *= &inner.pow(*exponent);
            if self.circuit.as_number(net).is_some_and(Rational::is_one) {
                continue;
            }
            if *exponent > 0 {
                numerator.push((net, exponent.unsigned_abs()));
            } else if self
                .inverted
                .factors
                .contains(&self.inverted.key(self.graph, *factor))
            {
                let inverse = self.inverse(*factor, net);
                numerator.push((inverse, exponent.unsigned_abs()));
            } else {
                denominator.push((net, exponent.unsigned_abs()));
                divisors.push((*factor, exponent.unsigned_abs()));
            }
        }
        let denominator = self.circuit.product(denominator);
        self.quotient(coefficient, numerator, denominator, &divisors)
    }

    /// A product over another, which is that of `divisors`.
    fn quotient(
        &mut self,
        coefficient: Rational,
        mut numerator: Vec<(Net, u32)>,
        denominator: Net,
        divisors: &Denominator,
    ) -> Multiple {
        if self
            .circuit
            .as_number(denominator)
            .is_some_and(|value| !value.is_zero())
        {
            return (coefficient, self.circuit.product(numerator));
        }
        if self.inverted.products.contains(divisors) {
            let one = self.one();
            numerator.push((self.circuit.push(Operation::Quotient(one, denominator)), 1));
            return (coefficient, self.circuit.product(numerator));
        }
        let numerator = self.circuit.product(numerator);
        if self.circuit.as_number(numerator).is_some() {
            let numerator = self.circuit.number(coefficient);
            return (
                Rational::ONE,
                self.circuit
                    .push(Operation::Quotient(numerator, denominator)),
            );
        }
        (
            coefficient,
            self.circuit
                .push(Operation::Quotient(numerator, denominator)),
        )
    }

    /// The inverse of a divisor, whose value is `net`; that of a size is the size of the inverse.
    fn inverse(&mut self, divisor: ExprId, net: Net) -> Net {
        let one = self.one();
        match self.circuit.operation(net).clone() {
            Operation::Apply(Function::Abs, operands)
                if self.inverted.key(self.graph, divisor) != divisor =>
            {
                let inverse = self.circuit.push(Operation::Quotient(one, operands[0]));
                self.circuit
                    .push(Operation::Apply(Function::Abs, smallvec![inverse]))
            }
            _ => self.circuit.push(Operation::Quotient(one, net)),
        }
    }

    fn apply(&mut self, function: Function, operands: &[ExprId]) -> Multiple {
        if let [operand] = operands {
            let (coefficient, net) = self.multiple(*operand);
            let constant = self.circuit.as_number(net).is_some();
            match function {
                Function::Abs if constant => return (coefficient.abs(), net),
                Function::Abs => {
                    return (
                        coefficient.abs(),
                        self.circuit
                            .push(Operation::Apply(function, smallvec![net])),
                    );
                }
                Function::Sqrt if constant && !coefficient.is_negative() => {
                    return (root_of(&coefficient), net);
                }
                _ => {}
            }
        }
        let constants: Option<Vec<Rational>> = operands
            .iter()
            .map(|operand| {
                let (coefficient, net) = self.multiple(*operand);
                Some(coefficient * self.circuit.as_number(net)?)
            })
            .collect();
        if let Some(value) = constants.and_then(|constants| constants::value(function, &constants))
        {
            return (value, self.one());
        }
        let operands = operands.iter().map(|operand| self.net(*operand)).collect();
        (
            Rational::ONE,
            self.circuit.push(Operation::Apply(function, operands)),
        )
    }
}

impl Divisors {
    /// The divisor whose inverse serves for this one: of a size what it is the size of.
    fn key(&self, graph: &Graph, divisor: ExprId) -> ExprId {
        match graph.node(divisor) {
            Node::Apply(Function::Abs, operands) if self.sizes => operands[0],
            _ => divisor,
        }
    }

    /// The different divisors in denominators.
    fn keys<'d>(
        &self,
        graph: &Graph,
        denominators: impl IntoIterator<Item = &'d (ExprId, u32)>,
    ) -> BTreeSet<ExprId> {
        let divisors = denominators.into_iter();
        divisors
            .map(|(factor, _)| self.key(graph, *factor))
            .collect()
    }
}

/// Factors with their exponents.
type Factors = Vec<(ExprId, i32)>;

/// A product as a power of a quotient and the rest: x⁴z/y² is (x²/y)²·z. The power of a quotient stays in the range of
/// numbers where x⁴ and y² may not, and takes fewer operations. The power is 1 where there is none.
fn power_of_quotient(factors: &[(ExprId, i32)]) -> (Factors, u32, Factors) {
    let (powers, rest): (Factors, Factors) =
        factors.iter().partition(|(_, exponent)| exponent.abs() > 1);
    let power = powers.iter().fold(0_u32, |power, (_, exponent)| {
        power.gcd(&exponent.unsigned_abs())
    });
    let both_signs = powers.iter().any(|(_, n)| *n > 0) && powers.iter().any(|(_, n)| *n < 0);
    if power < 2 || !both_signs {
        return (Vec::new(), 1, factors.to_vec());
    }
    let quotient = powers
        .iter()
        .map(|(factor, exponent)| (*factor, exponent / power as i32));
    (quotient.collect(), power, rest)
}

/// Digits of a named constant.
pub(super) fn digits_of(constant: NamedConstant) -> Rational {
    let digits = match constant {
        NamedConstant::Pi => "3.14159265358979323846264338327950288419716939937510582097494",
        NamedConstant::E => "2.71828182845904523536028747135266249775724709369995957496697",
        NamedConstant::Ln2 => "0.693147180559945309417232121458176568075500134360255254120680",
        NamedConstant::Ln10 => "2.30258509299404568401799145468436420760110148862877297603333",
        NamedConstant::EulerGamma => {
            "0.577215664901532860606512090082402431042159335939923598805767"
        }
    };
    decimal(digits).unwrap_or(Rational::ONE)
}

/// The square root of a constant to [`CONSTANT_DIGITS`] digits.
fn root_of(value: &Rational) -> Rational {
    let scale = Pow::pow(BigInt::from(10), CONSTANT_DIGITS);
    let scaled = value.numerator() * value.denominator() * &scale * &scale;
    Rational::new(scaled.sqrt(), value.denominator() * scale)
}

/// Decides which inverses are shared: per group of quotients that have divisors in common, either each divisor is
/// inverted once or each whole denominator is, whichever needs fewer divisions.
fn shared_divisors(graph: &Graph, roots: &[ExprId], sizes: bool) -> Divisors {
    let mut quotients: Vec<Vec<(ExprId, u32)>> = Vec::new();
    for id in graph.reachable(roots) {
        if let Node::Product(factors) = graph.node(id) {
            let (quotient, _, rest) = power_of_quotient(factors);
            for factors in [quotient, rest] {
                let divisors = factors.iter().filter(|(_, exponent)| *exponent < 0);
                let divisors: Vec<_> = divisors
                    .map(|(factor, exponent)| (*factor, exponent.unsigned_abs()))
                    .collect();
                if !divisors.is_empty() {
                    quotients.push(divisors);
                }
            }
        }
    }
    let keys = Divisors {
        sizes,
        ..Divisors::default()
    };
    let mut shared = Divisors {
        sizes,
        ..Divisors::default()
    };
    for group in groups(quotients, |quotient| keys.keys(graph, quotient)) {
        let factors = keys.keys(graph, group.iter().flatten());
        let mut whole: BTreeMap<&Denominator, usize> = BTreeMap::new();
        for divisors in &group {
            *whole.entry(divisors).or_insert(0) += 1;
        }
        if group.len() == 1 {
            continue;
        }
        if factors.len() < whole.len() {
            shared.factors.extend(factors);
        } else {
            let repeated = whole.into_iter().filter(|(_, count)| *count > 1);
            let repeated = repeated.map(|(divisors, _)| divisors.clone());
            shared.products.extend(repeated);
        }
    }
    shared
}

/// What a quotient divides by, with powers.
type Denominator = Vec<(ExprId, u32)>;

/// Quotients connected by common divisors.
fn groups(
    quotients: Vec<Denominator>,
    keys: impl Fn(&Denominator) -> BTreeSet<ExprId>,
) -> Vec<Vec<Denominator>> {
    let mut groups: Vec<(Vec<ExprId>, Vec<Denominator>)> = Vec::new();
    let mut group_of: FxHashMap<ExprId, usize> = FxHashMap::default();
    for quotient in quotients {
        let factors = keys(&quotient);
        let known = factors.iter().filter_map(|factor| group_of.get(factor));
        let connected: BTreeSet<usize> = known.copied().collect();
        let largest = connected.iter().max_by_key(|group| groups[**group].0.len());
        let largest = largest.copied().unwrap_or(groups.len());
        if largest == groups.len() {
            groups.push((Vec::new(), Vec::new()));
        }
        let mut joined: (Vec<ExprId>, _) = (factors.into_iter().collect(), vec![quotient]);
        for group in connected.into_iter().filter(|group| *group != largest) {
            let (others, members) = std::mem::take(&mut groups[group]);
            joined.0.extend(others);
            joined.1.extend(members);
        }
        for factor in &joined.0 {
            group_of.insert(*factor, largest);
        }
        groups[largest].0.extend(joined.0);
        groups[largest].1.extend(joined.1);
    }
    let members = groups.into_iter().map(|(_, members)| members);
    members.filter(|members| !members.is_empty()).collect()
}
