//! From a formula as its author wrote it to the graph that is worked on: sums and products are gathered, constants folded.
//!
//! What is gathered is equal on paper. Where the author subtracts what a sum before it added, as in (a + b) − a, the
//! difference is what rounding took, and gathering would delete it: such a formula is [told apart](Gathered::undoes_rounding),
//! and stays as it is written.

use std::collections::BTreeMap;

use crate::fingerprint::vanishing;
use crate::graph::{Domain, ExprId, Graph, Node, Rational, Role, whole};
use crate::outputs::{Definitions, Held, Outputs};

/// A formula's numbers in the graph that is worked on.
#[derive(Debug)]
pub struct Gathered {
    /// The graph.
    pub graph: Graph,
    /// The numbers.
    pub roots: Vec<ExprId>,
    /// Whether a sum of the author's takes away what another one added, so that it is there for the sake of rounding.
    pub undoes_rounding: bool,
}

/// Gathers the numbers of a formula as written.
pub fn gather(written: &Graph, roots: &[ExprId]) -> Gathered {
    let mut graph = Graph::with_symbols_of(written);
    let mut images: BTreeMap<ExprId, ExprId> = BTreeMap::new();
    let mut sums = Vec::new();
    let mut undoes_rounding = false;
    let roots = written.rebuild(&mut graph, roots, |graph, original, image| {
        images.insert(original, image);
        if let Node::Sum(terms) = written.node(original)
            && written.is_authored(original)
        {
            let is_sum =
                |operand| matches!(written.node(operand), Node::Sum(terms) if terms.len() > 1);
            let has_sum = terms.iter().any(|(operand, _)| is_sum(*operand));
            let of_images = |(operand, q): &(ExprId, Rational)| (images[operand], q.clone());
            let terms: Vec<_> = terms.iter().map(of_images).collect();
            undoes_rounding |= has_sum && takes_away_what_was_added(graph, &terms);
            if graph.as_number(image).is_none() {
                sums.push(image);
            }
        }
        image
    });
    // A sum that is 0 whatever its inputs are is there for what rounding makes of it.
    undoes_rounding |= !vanishing(&graph, &sums).is_empty();
    Gathered {
        graph,
        roots,
        undoes_rounding,
    }
}

/// Terms by what they are multiples of: whether one is positive, whether one is negative, and what they come to.
type Multiples = BTreeMap<ExprId, ([bool; 2], Rational)>;

/// Whether terms of different signs are multiples of the same, where one of them was a sum (as in c − (c − x) with c = 1025·x,
/// by which a number is split), or whether what a sum among them has is taken away to the last of it, as in (a + b) − a,
/// where gathering would open that sum.
fn takes_away_what_was_added(graph: &Graph, terms: &[(ExprId, Rational)]) -> bool {
    let mut closed = Multiples::new();
    for (operand, q) in terms {
        // Numbers are constants that the author left to the compiler.
        if graph.as_number(*operand).is_none() {
            enter(graph, &mut closed, *operand, q);
        }
    }
    if closed.values().any(|(signs, _)| *signs == [true; 2]) {
        return true;
    }
    let mut opened = Multiples::new();
    for (operand, q) in terms {
        let (operand, q) = multiple_of(graph, *operand, q);
        match graph.node(operand) {
            Node::Sum(inner) => {
                for (operand, inner) in inner {
                    enter(graph, &mut opened, *operand, &(inner * &q));
                }
            }
            _ => enter(graph, &mut opened, operand, &q),
        }
    }
    let is_gone = |(signs, left): &([bool; 2], Rational)| *signs == [true; 2] && left.is_zero();
    opened.values().any(is_gone)
}

/// What a multiple is a multiple of, and of which size.
fn multiple_of(graph: &Graph, operand: ExprId, q: &Rational) -> (ExprId, Rational) {
    match graph.node(operand) {
        Node::Number(value) => (graph.one(), value * q),
        Node::Sum(inner) if inner.len() == 1 => (inner[0].0, &inner[0].1 * q),
        _ => (operand, q.clone()),
    }
}

fn enter(graph: &Graph, multiples: &mut Multiples, operand: ExprId, q: &Rational) {
    let (operand, q) = multiple_of(graph, operand, q);
    let (signs, left) = multiples.entry(operand).or_default();
    signs[usize::from(q.is_negative())] |= !q.is_zero();
    *left += &q;
}

/// Gathers the numbers of a formula with its named products as symbols of their own; `None` if there is none.
///
/// A product of products is one product: an author's `bending * c.c44` becomes a product of all that both are made of. Held,
/// each named product stays whole, so that a derivative goes from there to each of the many inputs at once, past the few
/// numbers that the author put between them.
pub fn hold(written: &Graph, roots: &[ExprId]) -> Option<Held> {
    let mut graph = Graph::with_symbols_of(written);
    let mut definitions = Vec::new();
    let values = written.rebuild(&mut graph, roots, |graph, original, image| {
        match written.suggested_name(original) {
            Some(name) => held(graph, &mut definitions, image, name),
            None => image,
        }
    });
    let outputs = Outputs {
        values,
        ..Outputs::default()
    };
    (!definitions.is_empty()).then_some(Held {
        graph,
        outputs,
        definitions,
    })
}

/// The number that stands for a named one: a symbol, or a multiple of one, for a product that divides by nothing that may
/// be 0.
fn held(graph: &mut Graph, definitions: &mut Definitions, id: ExprId, name: &str) -> ExprId {
    let (product, coefficient) = match graph.node(id) {
        Node::Sum(terms) => match terms.as_slice() {
            [(product, coefficient)] => (*product, coefficient.clone()),
            _ => return id,
        },
        _ => (id, whole(1)),
    };
    if !is_whole(graph, product) {
        return id;
    }
    let known = definitions.iter().find(|(_, known)| *known == product);
    let symbol = known.map(|(symbol, _)| *symbol).unwrap_or_else(|| {
        let symbol = graph.symbol_of(Role::Product(definitions.len()), name);
        graph.assume(symbol, Domain::of_sign(graph.sign(product)));
        definitions.push((symbol, product));
        graph.suggest_name(product, name);
        symbol
    });
    let symbol = graph.symbol_expression(symbol);
    graph.scale(symbol, coefficient)
}

/// Whether it is a product that is finite wherever its factors are.
fn is_whole(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Product(factors) => factors
            .iter()
            .all(|(factor, exponent)| *exponent > 0 || !graph.sign(*factor).zero),
        _ => false,
    }
}
