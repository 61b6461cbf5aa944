//! Partial derivatives by the reverse mode: one sweep from a function to all that it is derived by; and by the forward
//! mode, for formulas that come out shorter that way.
//!
//! Each node's rule is written over its own value, as in $(\sqrt u)' = u'/(2\sqrt u)$ or
//! $(u/v)' = (u' - (u/v)\,v')/v$, so that a derivative is finite wherever the function and its parts are.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{ExprId, Function, Graph, Node, Rational, SymbolId, ratio, whole};

/// The first partials of a function by the given symbols, in their order.
pub fn gradient(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    let wanted: BTreeSet<SymbolId> = by.iter().copied().collect();
    let depends = graph.depends_on(&wanted);
    let order = graph.reachable(&[function]);
    let mut adjoints: BTreeMap<ExprId, Vec<(ExprId, Rational)>> = BTreeMap::new();
    let mut of_symbols: BTreeMap<SymbolId, ExprId> = BTreeMap::new();
    adjoints.insert(function, vec![(graph.one(), whole(1))]);
    for id in order.into_iter().rev() {
        if !depends[id.index()] {
            continue;
        }
        let Some(contributions) = adjoints.remove(&id) else {
            continue;
        };
        let adjoint = graph.sum(contributions);
        if let Node::Symbol(symbol) = graph.node(id) {
            of_symbols.insert(*symbol, adjoint);
            continue;
        }
        for (operand, slope, coefficient) in slopes(graph, id, &depends) {
            let share = graph.multiply(adjoint, slope);
            adjoints
                .entry(operand)
                .or_default()
                .push((share, coefficient));
        }
    }
    let zero = graph.integer(0);
    by.iter()
        .map(|symbol| of_symbols.get(symbol).copied().unwrap_or(zero))
        .collect()
}

/// The same in the forward mode: one sweep for each symbol. It is written over other parts than the reverse mode's: over
/// the derivatives of what the function is made of, which several functions of one formula may share.
pub fn gradient_forward(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    let order = graph.reachable(&[function]);
    let zero = graph.integer(0);
    let mut partials = Vec::with_capacity(by.len());
    for symbol in by {
        let depends = graph.depends_on(&BTreeSet::from([*symbol]));
        let mut tangents: BTreeMap<ExprId, ExprId> = BTreeMap::new();
        for id in order.iter().copied().filter(|id| depends[id.index()]) {
            let tangent = if let Node::Symbol(_) = graph.node(id) {
                graph.one()
            } else {
                let mut terms = Vec::new();
                for (operand, slope, coefficient) in slopes(graph, id, &depends) {
                    let inner = tangents.get(&operand).copied().unwrap_or(zero);
                    terms.push((graph.multiply(inner, slope), coefficient));
                }
                graph.sum(terms)
            };
            tangents.insert(id, tangent);
        }
        partials.push(tangents.get(&function).copied().unwrap_or(zero));
    }
    partials
}

/// The second partials, by rows; the matrix is symmetric by construction.
pub fn hessian(graph: &mut Graph, gradient_of: &[ExprId], by: &[SymbolId]) -> Vec<Vec<ExprId>> {
    let mut rows: Vec<Vec<ExprId>> = Vec::with_capacity(by.len());
    for (position, first) in gradient_of.iter().enumerate() {
        let tail = gradient(graph, *first, by.get(position..).unwrap_or_default());
        let mut row: Vec<ExprId> = rows
            .iter()
            .filter_map(|earlier| earlier.get(position).copied())
            .collect();
        row.extend(tail);
        rows.push(row);
    }
    rows
}

/// The node's derivative by each of its operands that matters: operand, derivative, rational factor.
fn slopes(graph: &mut Graph, id: ExprId, depends: &[bool]) -> Vec<(ExprId, ExprId, Rational)> {
    // Nodes made during the sweep lie behind the last known one; no operand of an old node does.
    let matters = |operand: &ExprId| depends.get(operand.index()).copied().unwrap_or(false);
    match graph.node(id).clone() {
        Node::Number(_) | Node::Constant(_) | Node::Symbol(_) | Node::Integral { .. } => Vec::new(),
        Node::Sum(terms) => {
            let one = graph.one();
            terms
                .into_iter()
                .filter(|(operand, _)| matters(operand))
                .map(|(operand, q)| (operand, one, q))
                .collect()
        }
        Node::Product(factors) => {
            let wanted: Vec<_> = factors
                .iter()
                .filter(|(operand, _)| matters(operand))
                .copied()
                .collect();
            wanted
                .into_iter()
                .map(|(operand, exponent)| {
                    let mut others = factors.clone();
                    others.push((operand, -1));
                    (operand, graph.product(others), whole(i64::from(exponent)))
                })
                .collect()
        }
        Node::Apply(function, operands) => {
            slopes_of_function(graph, id, function, &operands, matters)
        }
        Node::Tabulated {
            table,
            order,
            argument,
        } => {
            vec![(
                argument,
                graph.tabulated(table, order + 1, argument),
                whole(1),
            )]
        }
    }
}

fn slopes_of_function(
    graph: &mut Graph,
    id: ExprId,
    function: Function,
    operands: &[ExprId],
    matters: impl Fn(&ExprId) -> bool,
) -> Vec<(ExprId, ExprId, Rational)> {
    let one = graph.one();
    let zero = graph.integer(0);
    let u = operands.first().copied().unwrap_or(one);
    let single = |slope: ExprId, coefficient: Rational| vec![(u, slope, coefficient)];
    match function {
        Function::Sqrt => {
            let inverse = graph.power(id, -1);
            single(inverse, ratio(1, 2))
        }
        Function::Sin => {
            let cos = graph.apply(Function::Cos, vec![u]);
            single(cos, whole(1))
        }
        Function::Cos => {
            let sin = graph.apply(Function::Sin, vec![u]);
            single(sin, whole(-1))
        }
        Function::Tan => {
            let square = graph.power(id, 2);
            let slope = graph.add(one, square);
            single(slope, whole(1))
        }
        Function::Exp => single(id, whole(1)),
        Function::Ln => {
            let inverse = graph.power(u, -1);
            single(inverse, whole(1))
        }
        Function::Abs => {
            let sign = graph.apply(Function::Sign, vec![u]);
            single(sign, whole(1))
        }
        Function::Sign => Vec::new(),
        Function::Min | Function::Max | Function::Select => {
            let [a, b] = [operands[0], operands[1]];
            // Select's two results are operands 2 and 3; the smaller and larger of two choose their own.
            let (first, second) = match function {
                Function::Min => (a, b),
                Function::Max => (b, a),
                _ => (operands[2], operands[3]),
            };
            let mut slopes = Vec::new();
            if matters(&first) {
                slopes.push((
                    first,
                    graph.apply(Function::Select, vec![a, b, one, zero]),
                    whole(1),
                ));
            }
            if matters(&second) {
                slopes.push((
                    second,
                    graph.apply(Function::Select, vec![a, b, zero, one]),
                    whole(1),
                ));
            }
            slopes
        }
    }
}
