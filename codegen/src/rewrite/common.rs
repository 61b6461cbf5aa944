//! What all terms of a sum are multiplied or divided by, taken out: xy − 2x²z is x(y − 2xz), x/z + y/z is (x + y)/z.
//!
//! That shares a division and may let factors cancel, or hide a sum that another expression has too; so it is no rule,
//! but one of the ways among which the cheapest is chosen.

use std::collections::BTreeMap;

use super::rules::parts;
use super::{Form, changed, product, simplify};
use crate::graph::{ExprId, Factors, Graph, Node};

/// Rebuilds the roots with the common factors of every sum taken out; `None` if no sum has any.
pub fn take_out(graph: &Graph, roots: &[ExprId]) -> Option<Form> {
    changed(graph, roots, factored)
}

/// The sum as a product, where its terms have factors in common.
fn factored(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Sum(terms) = graph.node(id).clone() else {
        return None;
    };
    let powers = terms.iter().map(|(term, _)| parts(graph, *term).1);
    let powers: Vec<Factors> = powers.collect();
    let is_product =
        |factors: &&Factors| factors.iter().map(|(_, n)| n.unsigned_abs()).sum::<u32>() > 1;
    let (first, rest) = powers.split_first().filter(|(_, rest)| !rest.is_empty())?;
    if powers.iter().filter(is_product).count() < 2 {
        return None;
    }
    let mut common = first.clone();
    for factors in rest {
        common.retain(|(factor, shared)| {
            let place = factors.binary_search_by_key(factor, |(other, _)| *other);
            let other = place.map_or(0, |place| factors[place].1);
            *shared = match (shared.signum(), other.signum()) {
                (1, 1) => other.min(*shared),
                (-1, -1) => other.max(*shared),
                _ => 0,
            };
            *shared != 0
        });
        if common.is_empty() {
            return None;
        }
    }
    let mut divided = Vec::new();
    for (term, coefficient) in terms {
        let inverse = common.iter().map(|(factor, exponent)| (*factor, -exponent));
        let factors: Factors = inverse.chain([(term, 1)]).collect();
        divided.push((product(graph, factors), coefficient));
    }
    let inner = graph.sum(divided);
    common.push((simplify(graph, inner), 1));
    Some(product(graph, common))
}

/// The sum as one quotient, where all its terms divide by the same and by nothing else: x/r + y/r is (x + y)/r.
pub fn over_common_divisor(graph: &mut Graph, id: ExprId) -> ExprId {
    if graph.is_as_written() {
        return id;
    }
    let Node::Sum(terms) = graph.node(id).clone() else {
        return id;
    };
    let divisors = |graph: &Graph, term: ExprId| -> BTreeMap<ExprId, i32> {
        let factors = parts(graph, term).1.into_iter();
        factors.filter(|(_, exponent)| *exponent < 0).collect()
    };
    let common = divisors(graph, terms[0].0);
    let same = terms
        .iter()
        .all(|(term, _)| divisors(graph, *term) == common);
    if !same || common.is_empty() || terms.len() < 2 {
        return id;
    }
    let mut above = Vec::new();
    for (term, coefficient) in terms {
        let inverse = common.iter().map(|(factor, exponent)| (*factor, -exponent));
        let factors: Vec<_> = inverse.chain([(term, 1)]).collect();
        above.push((graph.product(factors), coefficient));
    }
    let above = graph.sum(above);
    graph.product(common.into_iter().chain([(above, 1)]))
}
