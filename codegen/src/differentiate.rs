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

mod corners;

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{ExprId, Function, Graph, Node, Rational, SymbolId, ratio, whole};
use crate::rewrite::common::over_common_divisor;

/// The first partials of a function by the given symbols, in their order.
pub fn gradient(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    Sweeps {
        by,
        known: BTreeMap::new(),
    }
    .partials(graph, function)
}

/// The same over held products: a sweep down to their symbols, then from the last of them to what each is made of. What
/// the users of a product pass on to it is summed before it goes on to the many factors.
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

/// The sweeps for one gradient: one for the function, and one for each alternative of a choice in it.
struct Sweeps<'a> {
    by: &'a [SymbolId],
    /// The partials of alternatives.
    known: BTreeMap<ExprId, Vec<ExprId>>,
}

/// What a node's users pass on to it, to be summed.
type Adjoints = BTreeMap<ExprId, Vec<(ExprId, Rational)>>;

impl Sweeps<'_> {
    fn partials(&mut self, graph: &mut Graph, function: ExprId) -> Vec<ExprId> {
        if let Some(known) = self.known.get(&function) {
            return known.clone();
        }
        let wanted: BTreeSet<SymbolId> = self.by.iter().copied().collect();
        let depends = graph.depends_on(&wanted);
        let order = graph.reachable(&[function]);
        let mut adjoints = Adjoints::new();
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
            match graph.node(id).clone() {
                Node::Symbol(symbol) => {
                    // The contributions share the divisions that their way here has in common; a further derivative of them
                    // one by one would have differences that cancel.
                    of_symbols.insert(symbol, over_common_divisor(graph, adjoint));
                }
                Node::Apply(function, operands) if corners::is_choice(function) => {
                    self.pass_choice(graph, adjoint, (id, function), &operands, &mut adjoints);
                }
                Node::Apply(Function::Abs, operands) => {
                    let inner = self.partials(graph, operands[0]);
                    let side = corners::side(graph, operands[0], &inner);
                    let share = graph.multiply(adjoint, side);
                    adjoints
                        .entry(operands[0])
                        .or_default()
                        .push((share, whole(1)));
                }
                _ => {
                    for (operand, slope, coefficient) in slopes(graph, id, &depends) {
                        let share = graph.multiply(adjoint, slope);
                        adjoints
                            .entry(operand)
                            .or_default()
                            .push((share, coefficient));
                    }
                }
            }
        }
        let zero = graph.integer(0);
        let partials: Vec<ExprId> = self
            .by
            .iter()
            .map(|symbol| of_symbols.get(symbol).copied().unwrap_or(zero))
            .collect();
        self.known.insert(function, partials.clone());
        partials
    }

    /// The derivative of a choice is a choice between the derivatives, all factors included: a choice between 1 and 0 as a
    /// factor of them would be 0·∞ where the alternative that is not taken has an infinite derivative.
    fn pass_choice(
        &mut self,
        graph: &mut Graph,
        adjoint: ExprId,
        choice: (ExprId, Function),
        operands: &[ExprId],
        adjoints: &mut Adjoints,
    ) {
        let alternatives = corners::alternatives(operands);
        let [first, second] = alternatives.map(|alternative| self.partials(graph, alternative));
        let taken = corners::taken(graph, choice, operands, &first, &second);
        for ((symbol, first), second) in self.by.iter().zip(first).zip(second) {
            let partials = [first, second].map(|partial| graph.multiply(adjoint, partial));
            let share = taken.of(graph, partials);
            let symbol = graph.symbol_expression(*symbol);
            adjoints.entry(symbol).or_default().push((share, whole(1)));
        }
    }
}

/// The same in the forward mode: one sweep for each symbol. It is written over other parts than the reverse mode's: over
/// the derivatives of what the function is made of, which several functions of one formula may share.
pub fn gradient_forward(graph: &mut Graph, function: ExprId, by: &[SymbolId]) -> Vec<ExprId> {
    let order = graph.reachable(&[function]);
    let zero = graph.integer(0);
    let wanted: BTreeSet<SymbolId> = by.iter().copied().collect();
    let depends = graph.depends_on(&wanted);
    // For each node its derivatives by all symbols.
    let mut tangents: BTreeMap<ExprId, Vec<ExprId>> = BTreeMap::new();
    let nothing = vec![zero; by.len()];
    for id in order.into_iter().filter(|id| depends[id.index()]) {
        let of = |operand: &ExprId| tangents.get(operand).unwrap_or(&nothing).clone();
        let tangent = match graph.node(id).clone() {
            Node::Symbol(symbol) => {
                let one = graph.one();
                by.iter()
                    .map(|by| if *by == symbol { one } else { zero })
                    .collect()
            }
            Node::Apply(function, operands) if corners::is_choice(function) => {
                let [first, second] = corners::alternatives(&operands).map(|operand| of(&operand));
                let taken = corners::taken(graph, (id, function), &operands, &first, &second);
                let both = first.into_iter().zip(second);
                both.map(|(first, second)| taken.of(graph, [first, second]))
                    .collect()
            }
            Node::Apply(Function::Abs, operands) => {
                let inner = of(&operands[0]);
                let side = corners::side(graph, operands[0], &inner);
                inner
                    .into_iter()
                    .map(|inner| graph.multiply(inner, side))
                    .collect()
            }
            _ => {
                let slopes = slopes(graph, id, &depends);
                let inner: Vec<_> = slopes.iter().map(|(operand, ..)| of(operand)).collect();
                let by_symbol = (0..by.len()).map(|place| {
                    let terms = slopes.iter().zip(&inner);
                    let terms: Vec<_> = terms
                        .map(|((_, slope, q), inner)| {
                            (graph.multiply(inner[place], *slope), q.clone())
                        })
                        .collect();
                    graph.sum(terms)
                });
                by_symbol.collect()
            }
        };
        tangents.insert(id, tangent);
    }
    tangents.remove(&function).unwrap_or(nothing)
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
            let wanted = factors
                .iter()
                .enumerate()
                .filter(|(_, (operand, _))| matters(operand));
            let wanted: Vec<_> = wanted.map(|(place, factor)| (place, *factor)).collect();
            let slope = |(place, (operand, exponent)): (usize, (ExprId, i32))| {
                // (u/v)' is −(u/v)/v·v', which stays in the range of numbers where u/v² does not.
                let slope = if exponent < 0 {
                    graph.product([(id, 1), (operand, -1)])
                } else {
                    let mut others = factors.clone();
                    others[place].1 -= 1;
                    graph.product(others)
                };
                (operand, slope, whole(i64::from(exponent)))
            };
            wanted.into_iter().map(slope).collect()
        }
        Node::Apply(function, operands) => slopes_of_function(graph, id, function, &operands),
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
) -> Vec<(ExprId, ExprId, Rational)> {
    let one = graph.one();
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
        Function::MulAdd => match operands {
            [a, b, c] => vec![(*a, *b, whole(1)), (*b, *a, whole(1)), (*c, one, whole(1))],
            _ => Vec::new(),
        },
        // Steps have the slope 0.
        Function::Sign | Function::Side => Vec::new(),
        // Corners are passed on as a whole.
        Function::Abs | Function::Min | Function::Max | Function::Select => Vec::new(),
    }
}
