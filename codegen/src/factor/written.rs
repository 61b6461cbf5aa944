//! The author's form as a circuit: every operation as it is written, those that are written twice done once.

use num_bigint::BigInt;
use smallvec::smallvec;

use super::constants;
use super::lower::digits_of;
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::{ExprId, Graph, MOST_BITS, Node, Rational};
use crate::interpret::Number;

/// The circuit of a graph as written. It is not to be tidied, which gathers sums and products.
pub fn circuit(graph: &Graph, roots: &[ExprId]) -> Circuit {
    let mut circuit = Circuit::default();
    let mut nets: Vec<Option<Net>> = vec![None; graph.len()];
    for id in graph.reachable(roots) {
        let net = net_of(&mut circuit, graph, id, &nets);
        if let Some(name) = graph.suggested_name(id) {
            circuit.suggest_name(net, name);
        }
        nets[id.index()] = Some(net);
    }
    circuit.outputs = roots.iter().filter_map(|root| nets[root.index()]).collect();
    circuit.without_unused()
}

fn net_of(circuit: &mut Circuit, graph: &Graph, id: ExprId, nets: &[Option<Net>]) -> Net {
    // Operands come before their users.
    let image = |operand: &ExprId| nets[operand.index()].unwrap_or_default();
    if let Some(value) = constant(circuit, graph, id, &image) {
        return circuit.number(value);
    }
    match graph.node(id) {
        Node::Number(value) => circuit.number(value.clone()),
        Node::Constant(constant) => circuit.number(digits_of(*constant)),
        Node::Symbol(symbol) => circuit.push(Operation::Symbol(*symbol)),
        Node::Sum(terms) => {
            let mut terms = terms.iter().map(|(operand, q)| (image(operand), q.clone()));
            let first = terms.next().unwrap_or_default();
            let Some(second) = terms.next() else {
                return circuit.multiple(first);
            };
            let mut sum = circuit.sum_of_two(first, second);
            for term in terms {
                sum = circuit.sum_of_two((sum, Rational::ONE), term);
            }
            sum
        }
        Node::Product(factors) => {
            let mut product: Option<Net> = None;
            for (operand, exponent) in factors {
                let power = power(circuit, image(operand), exponent.unsigned_abs());
                product = Some(match product {
                    None if *exponent > 0 => power,
                    None => {
                        let one = circuit.number(Rational::ONE);
                        circuit.push(Operation::Quotient(one, power))
                    }
                    Some(left) if *exponent < 0 => quotient(circuit, left, power),
                    Some(left) => circuit.product_of_two(left, power),
                });
            }
            product.unwrap_or_default()
        }
        Node::Apply(function, operands) => {
            let operands = operands.iter().map(image).collect();
            circuit.push(Operation::Apply(*function, operands))
        }
        Node::Tabulated {
            table,
            order,
            argument,
        } => circuit.push(Operation::Tabulated {
            table: *table,
            order: *order,
            argument: image(argument),
        }),
        // Integrals were refused before anything is lowered.
        Node::Integral { .. } => circuit.number(Rational::ZERO),
    }
}

/// A quotient; that by a power of two is a product, which is as exact.
fn quotient(circuit: &mut Circuit, numerator: Net, denominator: Net) -> Net {
    let inverse = circuit
        .as_number(denominator)
        .filter(|value| is_power_of_two(value));
    match inverse.map(|value| value.pow(-1)) {
        Some(inverse) => circuit.multiple((numerator, inverse)),
        None => circuit.push(Operation::Quotient(numerator, denominator)),
    }
}

/// Whether a constant and its inverse are powers of two that every `f64` can be multiplied with.
fn is_power_of_two(value: &Rational) -> bool {
    let bits = |part: BigInt| part.magnitude().count_ones() == 1 && part.bits() < 1000;
    bits(value.numerator()) && bits(value.denominator())
}

/// The value of an operation on constants: of a sum as `f64` arithmetic rounds it, which its author may count on, of the others
/// rounded once.
fn constant(
    circuit: &Circuit,
    graph: &Graph,
    id: ExprId,
    image: &impl Fn(&ExprId) -> Net,
) -> Option<Rational> {
    let value = |operand: &ExprId| circuit.as_number(image(operand));
    match graph.node(id) {
        Node::Sum(terms) if terms.len() == 1 => Some(value(&terms[0].0)? * &terms[0].1),
        Node::Sum(terms) => {
            let mut sum: Option<f64> = None;
            for (operand, q) in terms {
                let term = f64::rational(&(value(operand)? * q));
                sum = Some(sum.map_or(term, |sum| sum + term));
            }
            Rational::of_f64(sum?)
        }
        Node::Product(factors) => {
            factors
                .iter()
                .try_fold(Rational::ONE, |product, (operand, n)| {
                    let factor = value(operand).filter(|factor| *n > 0 || !factor.is_zero())?;
                    let bits = factor.bits().saturating_mul(n.unsigned_abs().into());
                    (bits <= MOST_BITS).then(|| product * factor.pow(*n))
                })
        }
        Node::Apply(function, operands) => {
            let operands: Option<Vec<Rational>> = operands
                .iter()
                .map(|operand| value(operand).cloned())
                .collect();
            constants::value(*function, &operands?)
        }
        _ => None,
    }
}

fn power(circuit: &mut Circuit, operand: Net, exponent: u32) -> Net {
    if exponent == 1 {
        operand
    } else {
        circuit.push(Operation::Product(smallvec![(operand, exponent)]))
    }
}
