//! Exponentials whose arguments are whole multiples of each other are powers of one, and a product of several is that of
//! the sum of their arguments.
//!
//! Neither is a rule: which of them saves calls depends on what else is needed.

use std::collections::{BTreeMap, BTreeSet};

use super::rules::{factors_with, operand_of, parts};
use super::{applied, product, simplify};
use crate::graph::{ExprId, Factors, Function, Graph, Rational, ratio};

/// A power beyond this is left a call: its error grows with the exponent.
const LARGEST_POWER: i32 = 8;

/// The other forms of the roots that their exponentials give, each where there are such exponentials.
pub fn forms(graph: &Graph, roots: &[ExprId]) -> Vec<(Graph, Vec<ExprId>)> {
    let powers = powers(graph, roots);
    let mut forms = Vec::new();
    if !powers.is_empty() {
        forms.push(rebuilt(graph, roots, |target, original, image| {
            power_of_base(target, image, powers.get(&original)?)
        }));
    }
    if exponentials(graph, roots).len() > 1 {
        forms.push(rebuilt(graph, roots, |target, _, image| {
            product_of_exponentials(target, image)
        }));
    }
    forms
}

fn rebuilt(
    graph: &Graph,
    roots: &[ExprId],
    change: impl Fn(&mut Graph, ExprId, ExprId) -> Option<ExprId>,
) -> (Graph, Vec<ExprId>) {
    let mut target = Graph::with_symbols_of(graph);
    let roots = graph.rebuild(&mut target, roots, |target, original, image| {
        let image = simplify(target, image);
        change(target, original, image).unwrap_or(image)
    });
    (target, roots)
}

/// The exponentials with their arguments.
fn exponentials(graph: &Graph, roots: &[ExprId]) -> BTreeMap<ExprId, ExprId> {
    let all = graph.reachable(roots).into_iter();
    all.filter_map(|id| Some((id, operand_of(graph, id, Function::Exp)?)))
        .collect()
}

/// For each exponential that is a power of another, its exponent: of those with a common argument up to a rational factor,
/// the one of the smallest factor is the base if all are whole powers of it.
fn powers(graph: &Graph, roots: &[ExprId]) -> BTreeMap<ExprId, i32> {
    // By the argument without its rational factor: that factor, and the exponential.
    type Group = Vec<(Rational, ExprId)>;
    let mut groups: BTreeMap<Factors, Group> = BTreeMap::new();
    for (exponential, argument) in exponentials(graph, roots) {
        let (coefficient, factors) = parts(graph, argument);
        groups
            .entry(factors)
            .or_default()
            .push((coefficient, exponential));
    }
    let mut powers = BTreeMap::new();
    for group in groups.into_values() {
        // Of x and −x the first: an inverse is taken only where there is a number to take it of.
        let smallest =
            |(coefficient, _): &&(Rational, ExprId)| (coefficient.abs(), coefficient.is_negative());
        let Some((base, _)) = group.iter().min_by_key(smallest) else {
            continue;
        };
        let exponents: Option<BTreeSet<(ExprId, i32)>> = group
            .iter()
            .map(|(coefficient, id)| {
                let ratio = coefficient / base;
                let exponent = ratio.to_i32()?;
                (exponent.abs() <= LARGEST_POWER).then_some((*id, exponent))
            })
            .collect();
        let powered = exponents.into_iter().flatten();
        powers.extend(powered.filter(|(_, exponent)| *exponent != 1));
    }
    powers
}

/// exp(nu) as exp(u)ⁿ.
fn power_of_base(graph: &mut Graph, id: ExprId, exponent: &i32) -> Option<ExprId> {
    let argument = operand_of(graph, id, Function::Exp)?;
    let base = graph.scale(argument, ratio(1, i64::from(*exponent)));
    let base = applied(graph, Function::Exp, base);
    Some(product(graph, vec![(base, *exponent)]))
}

/// A product with one exponential for all that it has.
pub(super) fn product_of_exponentials(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Exp])?;
    let (mut arguments, mut others) = (Vec::new(), Vec::new());
    for (factor, exponent) in factors {
        match operand_of(graph, factor, Function::Exp) {
            Some(argument) => arguments.push((argument, crate::graph::whole(exponent.into()))),
            None => others.push((factor, exponent)),
        }
    }
    if arguments.len() < 2 {
        return None;
    }
    let sum = graph.sum(arguments);
    let sum = simplify(graph, sum);
    others.push((applied(graph, Function::Exp, sum), 1));
    Some(product(graph, others))
}
