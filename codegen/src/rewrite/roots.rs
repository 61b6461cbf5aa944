//! Square roots whose operands differ by a square are one root: √(x³y) is |x|·√(xy), √(x/y) is √(xy)/|y|. And those that
//! stand in one product may be one: √x/√y is √(x/y).

use std::collections::{HashMap, HashSet};

use super::fractions::root_of_quotient;
use super::rules::{exact_root, parts};
use super::{Form, applied, changed, product, simplify};
use crate::graph::{ExprId, Factors, Function, Graph, Node, Rational};

/// Rebuilds the roots of the graph so that square roots which differ by a square of known factors are shared.
pub fn share(graph: Graph, roots: Vec<ExprId>) -> Form {
    let shared = differing_by_squares(&graph, &roots);
    if shared.is_empty() {
        return (graph, roots);
    }
    let mut target = Graph::with_symbols_of(&graph);
    let mut known = HashMap::new();
    let roots = graph.rebuild(&mut target, &roots, |target, original, image| match target
        .node(image)
    {
        Node::Apply(Function::Sqrt, operands) if shared.contains(&original) => {
            let radicand = operands[0];
            multiple_of_shared(target, radicand, &mut known).unwrap_or(image)
        }
        _ => simplify(target, image),
    });
    (target, roots)
}

/// Rebuilds the roots of the graph with one square root in each product; `None` if no product has two. It saves roots
/// unless one of them is needed alone as well, so that it is no rule, but one of the ways among which the cheapest is
/// chosen.
pub fn join(graph: &Graph, roots: &[ExprId]) -> Option<Form> {
    changed(graph, roots, joined)
}

/// Rebuilds the roots of the graph with √(ab)/|b| for √(a/b); `None` if there is no root of a quotient. It saves a division
/// beside others by b, but ab may leave the range of numbers where a/b does not.
pub fn without_quotients(graph: &Graph, roots: &[ExprId]) -> Option<Form> {
    changed(graph, roots, root_of_quotient)
}

/// A product with one root for all that it has.
fn joined(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, id);
    let (mut radicand, mut others) = (Vec::new(), Vec::new());
    for (factor, exponent) in factors {
        match graph.node(factor) {
            Node::Apply(Function::Sqrt, operands) if exponent.abs() == 1 => {
                radicand.push((operands[0], exponent));
            }
            _ => others.push((factor, exponent)),
        }
    }
    if radicand.len() < 2 {
        return None;
    }
    let radicand = product(graph, radicand);
    others.push((applied(graph, Function::Sqrt, radicand), 1));
    let id = product(graph, others);
    Some(graph.scale(id, coefficient))
}

/// The factors with odd powers in a radicand: radicands that have the same ones differ by a square.
fn odd_factors(factors: &[(ExprId, i32)]) -> Vec<ExprId> {
    let odd = factors.iter().filter(|(_, exponent)| exponent % 2 != 0);
    odd.map(|(factor, _)| *factor).collect()
}

/// The square roots that have such a companion.
fn differing_by_squares(graph: &Graph, roots: &[ExprId]) -> HashSet<ExprId> {
    let mut alike: HashMap<Vec<ExprId>, Vec<ExprId>> = HashMap::new();
    for id in graph.reachable(roots) {
        if let Node::Apply(Function::Sqrt, operands) = graph.node(id) {
            let (_, factors) = parts(graph, operands[0]);
            alike.entry(odd_factors(&factors)).or_default().push(id);
        }
    }
    let companions = alike.into_values().filter(|alike| alike.len() > 1);
    companions.flatten().collect()
}

/// The first root of each kind: its rational factor, and the odd factors with the signs of their exponents.
type First = (Rational, Factors);

/// √radicand as a multiple of the first root that differs from it by a square: of √(x/y), √(y/x) is the multiple |y/x|, so
/// that x·y, which may leave the range of numbers, is not computed. `None` if the two rational factors do not differ by the
/// square of a rational number.
fn multiple_of_shared(
    graph: &mut Graph,
    radicand: ExprId,
    known: &mut HashMap<Vec<ExprId>, First>,
) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, radicand);
    // What turns out to be 0 is no multiple of another, nor another of it.
    if coefficient.is_zero() {
        return None;
    }
    let odd = odd_factors(&factors);
    let signs = factors.iter().filter(|(_, exponent)| exponent % 2 != 0);
    let signs = signs.map(|(factor, exponent)| (*factor, exponent.signum()));
    let (common, first) = known
        .entry(odd)
        .or_insert_with(|| (coefficient.clone(), signs.collect()))
        .clone();
    let scale = exact_root(&(coefficient / &common))?;
    let inner = product(graph, first.clone());
    let inner = graph.scale(inner, common);
    let mut outside = vec![(applied(graph, Function::Sqrt, inner), 1)];
    for (factor, exponent) in factors {
        let under_root = first.iter().find(|(known, _)| *known == factor);
        let half = (exponent - under_root.map_or(0, |(_, sign)| *sign)) / 2;
        if half != 0 {
            outside.push((applied(graph, Function::Abs, factor), half));
        }
    }
    if outside.len() == 1 && scale.is_one() {
        return Some(outside[0].0);
    }
    let id = product(graph, outside);
    Some(graph.scale(id, scale))
}
