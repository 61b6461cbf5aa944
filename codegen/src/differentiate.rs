//! Partial derivatives by the reverse mode: one sweep from a function to all that it is derived by; and by the forward
//! mode, for formulas that come out shorter that way.
//!
//! Each node's rule is written over its own value, as in $(\sqrt u)' = u'/(2\sqrt u)$ or
//! $(u/v)' = (u' - (u/v)\,v')/v$, so that a derivative is finite wherever the function and its parts are.
//!
//! Not where a part has no finite derivative though the whole has one: the slope of $\sqrt u$ is infinite at $u = 0$, and
//! that of $\sqrt{x^4 + y^4}$, which is 0 at the origin, comes out as $0 \cdot \infty$, NaN. No rule without a case can tell
//! it from $\sqrt{x^2 + y^2}$, which has none there; the caller keeps away from such a point, or writes the limit as a formula
//! of its own.

pub mod corners;
mod reverse;
mod slopes;

use std::collections::BTreeMap;

use corners::Signs;

use crate::budget::Budget;
use crate::graph::{ExprId, Factors, Function, Graph, Node, Rational, SymbolId, whole};
use crate::rewrite::common::over_common_divisor;

/// The first partials of a function by the given symbols, in their order: by the reverse mode, or where that is beyond its
/// budget by the forward mode.
///
/// The reverse mode multiplies what a node gets from its users on to its operands. Along a chain of products, where every
/// step has a factor more than the one before, and of a product of many factors, each of which is passed the product of all
/// others, that is the square of the length; the forward mode has a sum in between.
pub fn gradient(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    gradient_within(graph, function, by, &mut Budget::default())
}

/// Factors that the reverse mode may pass on in any function, and beyond that for each of its nodes and each symbol: the forward
/// mode visits all nodes for every symbol. No function in the tests of this crate needs more than 600.
const LEAST_LOOKS: usize = 1 << 11;
const LOOKS_PER_NODE: usize = 4;

/// Derives as [`gradient`] does, with a budget that counts the factors that are passed on.
pub fn gradient_within(
    graph: &mut Graph,
    function: ExprId,
    by: &[SymbolId],
    budget: &mut Budget,
) -> Vec<ExprId> {
    reverse::gradient(graph, function, by, budget)
        .unwrap_or_else(|| gradient_forward(graph, function, by))
}

/// The first partials of a function over held products: a sweep goes down to their symbols, then from the last product to
/// the factors of each. What the users of a product pass on to it is summed before it goes on to its many factors.
pub fn gradient_held(
    graph: &mut Graph,
    function: ExprId,
    by: &[SymbolId],
    definitions: &[(SymbolId, ExprId)],
) -> Vec<ExprId> {
    let held = definitions.iter().map(|(symbol, _)| *symbol);
    let all: Vec<SymbolId> = by.iter().copied().chain(held).collect();
    let mut adjoints = vec![Vec::new(); all.len()];
    let mut sweep = vec![(function, graph.one(), whole(1))];
    for place in (by.len()..=all.len()).rev() {
        for (part, share, coefficient) in sweep {
            let partials = gradient(graph, part, &all);
            for (adjoint, partial) in adjoints.iter_mut().zip(partials) {
                adjoint.push((graph.multiply(share, partial), coefficient.clone()));
            }
        }
        let Some(definition) = place.checked_sub(by.len() + 1) else {
            break;
        };
        let adjoint = graph.sum(std::mem::take(&mut adjoints[place - 1]));
        let adjoint = over_common_divisor(graph, adjoint);
        sweep = shares(graph, adjoint, definitions[definition]);
    }
    let adjoints = adjoints.into_iter().take(by.len());
    let partials = adjoints.map(|adjoint| {
        let partial = graph.sum(adjoint);
        over_common_divisor(graph, partial)
    });
    partials.collect()
}

/// What a held product passes on to its factors: factor, share, rational coefficient.
fn shares(
    graph: &mut Graph,
    adjoint: ExprId,
    (symbol, product): (SymbolId, ExprId),
) -> Vec<(ExprId, ExprId, Rational)> {
    if graph.as_number(adjoint).is_some_and(Rational::is_zero) {
        return Vec::new();
    }
    let Node::Product(factors) = graph.node(product).clone() else {
        // Rewriting has made something simpler of it.
        return vec![(product, adjoint, whole(1))];
    };
    let value = graph.symbol_expression(symbol);
    let mut shares = Vec::new();
    for (factor, exponent) in &factors {
        // Over the product itself, which all its inputs share, where that divides by nothing that may be 0.
        let slope = match graph.node(*factor) {
            Node::Symbol(_) if !graph.sign(*factor).zero => graph.divide(value, *factor),
            _ => {
                let mut others = factors.clone();
                others.push((*factor, -1));
                graph.product(others)
            }
        };
        let share = graph.multiply(adjoint, slope);
        shares.push((*factor, share, whole(i64::from(*exponent))));
    }
    shares
}

/// The first partials of a function in the forward mode, from the symbols up to the function. They are made of the
/// derivatives of the function's parts, which several functions of one formula may share.
pub fn gradient_forward(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    let order = graph.reachable(&[function]);
    let [zero, one] = [graph.integer(0), graph.one()];
    let depends = graph.depends_on(&by.iter().copied().collect());
    // For each node its derivatives by all symbols.
    let mut tangents: BTreeMap<ExprId, Vec<ExprId>> = BTreeMap::new();
    let nothing = vec![zero; by.len()];
    let mut signs = Signs::default();
    for id in order.into_iter().filter(|id| depends[id.index()]) {
        let of = |operand: ExprId| tangents.get(&operand).unwrap_or(&nothing).clone();
        let tangent = match graph.node(id).clone() {
            Node::Symbol(symbol) => {
                let of_symbol = |by: &SymbolId| if *by == symbol { one } else { zero };
                by.iter().map(of_symbol).collect()
            }
            Node::Apply(function, operands) if function.is_choice() => {
                let [first, second] = corners::alternatives(&operands).map(of);
                let taken = corners::taken(
                    graph,
                    &mut signs,
                    (id, function),
                    &operands,
                    &first,
                    &second,
                );
                let both = first.into_iter().zip(second);
                both.map(|(first, second)| taken.of(graph, [first, second]))
                    .collect()
            }
            Node::Apply(Function::Abs, operands) => {
                let inner = of(operands[0]);
                let side = corners::side(graph, &mut signs, operands[0], &inner);
                inner
                    .into_iter()
                    .map(|inner| graph.multiply(inner, side))
                    .collect()
            }
            _ => {
                let by_symbol = (0..by.len()).map(|place| {
                    let inner = |operand| tangents.get(&operand).map_or(zero, |of| of[place]);
                    tangent(graph, id, &depends, &inner)
                });
                by_symbol.collect()
            }
        };
        tangents.insert(id, tangent);
    }
    tangents.remove(&function).unwrap_or(nothing)
}

/// The derivative of a node that has no corner from those of its operands. Of the author's operations it is a quotient where
/// the function's slope is one, u'/√…: its own derivative then stays in the range of numbers where that of u'·(1/√…) does not.
fn tangent(
    graph: &mut Graph,
    id: ExprId,
    depends: &[bool],
    inner: &impl Fn(ExprId) -> ExprId,
) -> ExprId {
    if let Node::Product(factors) = graph.node(id)
        && factors.len() > MOST_FACTORS
    {
        let factors = factors.clone();
        return tangent_of_factors(graph, &factors, inner).1;
    }
    if graph.is_as_written()
        && let Node::Product(factors) = graph.node(id)
        && let [(above, 1), (below, -1)] = **factors
    {
        return tangent_of_quotient(graph, id, [above, below], inner);
    }
    let mut terms = Vec::new();
    // Nodes made meanwhile lie behind the last known one; no operand of an old node does.
    let matters = |id: ExprId| depends.get(id.index()).copied().unwrap_or(false);
    let divides = graph.is_as_written() && matches!(graph.node(id), Node::Apply(..));
    for (operand, slope, coefficient) in slopes(graph, id, matters) {
        if divides && slope.iter().all(|(_, exponent)| *exponent < 0) {
            let divisors = slope.iter().map(|(factor, exponent)| (*factor, -exponent));
            let divisor = graph.product(divisors);
            terms.push((graph.divide(inner(operand), divisor), coefficient));
            continue;
        }
        let factors = std::iter::once((inner(operand), 1)).chain(slope);
        terms.push((graph.product(factors), coefficient));
    }
    graph.sum(terms)
}

/// The derivative of u/v as dual numbers have it: (u' − (u/v)·v')/v, which is 0 where the author divides equals.
fn tangent_of_quotient(
    graph: &mut Graph,
    quotient: ExprId,
    [above, below]: [ExprId; 2],
    inner: &impl Fn(ExprId) -> ExprId,
) -> ExprId {
    let of_below = graph.multiply(quotient, inner(below));
    let difference = graph.subtract(inner(above), of_below);
    graph.divide(difference, below)
}

/// Products of more factors than this are derived by halves; with fewer, a product of the others for each factor is as short.
const MOST_FACTORS: usize = 24;

/// A product and its derivative by halves, (uv)' = u'v + uv', so that the products in it have together no more than n·log n
/// of its n factors.
fn tangent_of_factors(
    graph: &mut Graph,
    factors: &[(ExprId, i32)],
    inner: &impl Fn(ExprId) -> ExprId,
) -> (ExprId, ExprId) {
    if let [(factor, exponent)] = factors {
        let slope = graph.product([(inner(*factor), 1), (*factor, exponent - 1)]);
        let slope = graph.scale(slope, whole(i64::from(*exponent)));
        return (graph.power(*factor, *exponent), slope);
    }
    let (left, right) = factors.split_at(factors.len() / 2);
    let [(u, u_slope), (v, v_slope)] =
        [left, right].map(|half| tangent_of_factors(graph, half, inner));
    let slopes = [graph.multiply(u_slope, v), graph.multiply(u, v_slope)];
    (graph.multiply(u, v), graph.add(slopes[0], slopes[1]))
}

/// The second partials, by rows; the matrix is symmetric by construction. `gradient` derives the first partials.
pub fn hessian(
    graph: &mut Graph,
    gradient_of: &[ExprId],
    by: &[SymbolId],
    gradient: Gradient,
) -> Vec<Vec<ExprId>> {
    let mut rows: Vec<Vec<ExprId>> = Vec::with_capacity(by.len());
    for (position, first) in gradient_of.iter().enumerate() {
        // All corners are seen from the side of the same variable, the first of all.
        let tail = if corners::has_any(graph, *first) {
            let row = gradient(graph, *first, by);
            row.get(position..).unwrap_or_default().to_vec()
        } else {
            gradient(graph, *first, by.get(position..).unwrap_or_default())
        };
        let mut row: Vec<ExprId> = rows
            .iter()
            .filter_map(|earlier| earlier.get(position).copied())
            .collect();
        row.extend(tail);
        rows.push(row);
    }
    rows
}

/// A way to derive a function: [`gradient`] or [`gradient_forward`].
pub type Gradient = fn(&mut Graph, ExprId, &[SymbolId]) -> Vec<ExprId>;

/// A node's derivative by one of its operands: operand, factors, rational factor. What the derivative is multiplied with comes
/// before its factors: (u/v)' is −((u/v)·v')/v, which stays in the range of numbers where (u/v)/v may not.
type Slope = (ExprId, Factors, Rational);

/// The node's derivative by each of its operands that matters.
fn slopes(graph: &mut Graph, id: ExprId, matters: impl Fn(ExprId) -> bool) -> Vec<Slope> {
    match graph.node(id).clone() {
        Node::Number(_) | Node::Constant(_) | Node::Symbol(_) | Node::Integral { .. } => Vec::new(),
        Node::Sum(terms) => {
            let terms = terms.into_iter();
            let wanted = terms.filter(|(operand, _)| matters(*operand));
            wanted
                .map(|(operand, q)| (operand, Factors::new(), q))
                .collect()
        }
        Node::Product(factors) => {
            let wanted = factors
                .iter()
                .enumerate()
                .filter(|(_, (operand, _))| matters(*operand));
            let wanted: Vec<_> = wanted.map(|(place, factor)| (place, *factor)).collect();
            let slope = |(place, (operand, exponent)): (usize, (ExprId, i32))| {
                let mut slope = factors.clone();
                if exponent < 0 {
                    slope = Factors::from_slice(&[(id, 1), (operand, -1)]);
                } else {
                    slope[place].1 -= 1;
                }
                (operand, slope, whole(i64::from(exponent)))
            };
            wanted.into_iter().map(slope).collect()
        }
        Node::Apply(function, operands) => slopes::of_function(graph, id, function, &operands),
        Node::Tabulated {
            table,
            order,
            argument,
        } => {
            let slope = graph.tabulated(table, order + 1, argument);
            vec![(argument, alone(slope), whole(1))]
        }
    }
}

/// A slope that is one expression.
fn alone(slope: ExprId) -> Factors {
    Factors::from_slice(&[(slope, 1)])
}
