//! Derivatives where a formula has a corner: at the tie of a smaller or larger of two, and of a size at 0.
//!
//! One convention holds for all: **at a corner the derivative is that of the side on which the first of the variables derived
//! by is a little larger**, the first that tells the two sides apart. Every corner of a formula is seen from the same side
//! then, so that where corners cancel, as in $\max(x, 0) - \max(-x, 0) = x$, in the softplus
//! $\max(x, 0) + \ln(1 + e^{-|x|})$ or in $x|x|$, the derivative is the true one, and so is that of the derivative.
//!
//! Which side that is shows by the sign of a derivative, as far as that is known while code is generated. Where it is not, the
//! side is taken on which the difference of the two, as it stands, is above zero; that of its negative is the same side.
//! Where one of two is not a number, the larger and the smaller of them are the other, and so is the derivative.
//!
//! The derivative of an `if` is that of the branch that is taken, also where its condition just holds; only of one between the two
//! numbers that it compares, which is the smaller or the larger of them, it is the one of that.

use crate::graph::{ExprId, Function, Graph, Images, Node, Rational, Sign};

/// Whether a function has a corner.
pub(super) fn has_any(graph: &Graph, function: ExprId) -> bool {
    let mut all = graph.reachable(&[function]).into_iter();
    all.any(
        |id| matches!(graph.node(id), Node::Apply(of, _) if of.is_choice() || *of == Function::Abs),
    )
}

/// Derivatives with the side of zero in the place of signs, so that at a negative zero too they are those of the side that
/// is taken: that of sign(x)·sinh|x| is 1 there.
pub fn with_sides(graph: &mut Graph, derivatives: &[ExprId]) -> Vec<ExprId> {
    let is_sign = |id: &ExprId| matches!(graph.node(*id), Node::Apply(Function::Sign, _));
    if !graph.reachable(derivatives).iter().any(is_sign) {
        return derivatives.to_vec();
    }
    let source = graph.clone();
    source.rebuild(graph, derivatives, |graph, _, image| {
        match graph.node(image) {
            Node::Apply(Function::Sign, operands) => {
                let operands = operands.clone();
                graph.apply(Function::Side, operands)
            }
            _ => image,
        }
    })
}

/// The two alternatives of a choice, by its operands.
pub(super) fn alternatives(operands: &[ExprId]) -> [ExprId; 2] {
    match *operands {
        [.., first, second] => [first, second],
        // Every choice has at least two operands.
        [..] => [ExprId::default(); 2],
    }
}

/// What a choice compares, by its operands.
fn compared(operands: &[ExprId]) -> [ExprId; 2] {
    match *operands {
        [first, second, ..] => [first, second],
        // Every choice has at least two operands.
        [..] => [ExprId::default(); 2],
    }
}

/// When the first alternative of a choice is taken.
pub(super) struct Taken {
    /// A choice by a comparison.
    comparison: Function,
    /// What is compared.
    compared: [ExprId; 2],
    /// Whether the first alternative is taken where the comparison fails.
    is_reversed: bool,
}

impl Taken {
    /// The one of two expressions that belongs to the alternative that is taken.
    pub(super) fn of(&self, graph: &mut Graph, [first, second]: [ExprId; 2]) -> ExprId {
        if first == second {
            return first;
        }
        let [a, b] = self.compared;
        let operands = if self.is_reversed {
            [a, b, second, first]
        } else {
            [a, b, first, second]
        };
        graph.apply(self.comparison, operands.as_slice())
    }
}

/// When which alternative of a choice is taken, from the derivatives of both.
pub(super) fn taken(
    graph: &mut Graph,
    signs: &mut Signs,
    (choice, function): (ExprId, Function),
    operands: &[ExprId],
    first: &[ExprId],
    second: &[ExprId],
) -> Taken {
    let [a, b] = alternatives(operands);
    let [c, d] = compared(operands);
    let by_comparison = |comparison: Function| Taken {
        comparison,
        compared: [c, d],
        is_reversed: false,
    };
    let is_ordering = matches!(function, Function::Less | Function::AtMost);
    if function.is_selection() && !(is_ordering && ([a, b] == [c, d] || [a, b] == [d, c])) {
        return by_comparison(function);
    }
    let mut both = first.iter().zip(second);
    let apart = both.find(|(first, second)| first != second);
    let growth = apart.map(|(first, second)| graph.subtract(*first, *second));
    let difference = graph.subtract(a, b);
    let goes_above = goes_above(graph, signs, difference, growth);
    if is_ordering {
        // Of two numbers that are compared the smaller or the larger: at the tie the first is taken where the comparison has
        // the equals, too.
        let is_larger = [a, b] == [d, c];
        return by_comparison(if goes_above == is_larger {
            Function::AtMost
        } else {
            Function::Less
        });
    }
    let takes_first = goes_above == (function == Function::Max);
    Taken {
        comparison: Function::Select,
        compared: [choice, if takes_first { a } else { b }],
        is_reversed: !takes_first,
    }
}

/// The derivative of a size by what it is the size of, 1 or −1, from the derivatives of the latter.
pub(super) fn side(graph: &mut Graph, signs: &mut Signs, of: ExprId, inner: &[ExprId]) -> ExprId {
    let is_zero = |id: &ExprId| graph.as_number(*id).is_some_and(Rational::is_zero);
    let growth = inner.iter().copied().find(|partial| !is_zero(partial));
    if goes_above(graph, signs, of, growth) {
        return graph.apply(Function::Side, [of].as_slice());
    }
    let opposite = graph.negate(of);
    let side = graph.apply(Function::Side, [opposite].as_slice());
    graph.negate(side)
}

/// Whether a difference is above zero on the side of a corner that is taken, from its first derivative that is not 0.
fn goes_above(
    graph: &Graph,
    signs: &mut Signs,
    difference: ExprId,
    growth: Option<ExprId>,
) -> bool {
    match growth.map(|growth| signs.of(graph, growth)) {
        Some(sign) if sign.is_not_negative() => true,
        Some(sign) if sign.is_not_positive() => false,
        _ => match graph.node(difference) {
            Node::Sum(terms) => {
                let first = terms.iter().min_by_key(|(operand, _)| *operand);
                first.is_none_or(|(_, coefficient)| !coefficient.is_negative())
            }
            _ => true,
        },
    }
}

/// What is known of the signs of the derivatives of one function: of the author's operations one by one what is known when
/// they are gathered, which each is once.
#[derive(Default)]
pub(super) struct Signs {
    gathered: Option<Graph>,
    images: Images,
}

impl Signs {
    fn of(&mut self, graph: &Graph, growth: ExprId) -> Sign {
        if !graph.is_as_written() {
            return graph.sign(growth);
        }
        let empty = || Graph::with_symbols_of(graph);
        let gathered = self.gathered.get_or_insert_with(empty);
        let image = graph.rebuild_more(gathered, growth, &mut self.images);
        gathered.sign(image)
    }
}
