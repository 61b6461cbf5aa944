//! Derivatives where a formula has a corner: at the tie of a smaller or larger of two, and of a size at 0.
//!
//! One convention holds for all: **at a corner the derivative is that of the side on which the first of the variables derived
//! by is a little larger**, the first that tells the two sides apart. Every corner of a formula is seen from the same side
//! then, so that where corners cancel, as in $\\max(x, 0) - \\max(-x, 0) = x$, in the softplus
//! $\\max(x, 0) + \\ln(1 + e^{-|x|})$ or in $x|x|$, the derivative is the true one, and so is that of the derivative.
//!
//! Which side that is shows mostly while code is generated, by the sign of a derivative; where it does not, the code looks.
//! Where one of two is not a number, the larger and smaller of them are the other, and so is the derivative.

use crate::graph::{ExprId, Function, Graph, Rational};

/// Whether the function is one of several alternatives.
pub(super) fn is_choice(function: Function) -> bool {
    matches!(function, Function::Min | Function::Max | Function::Select)
}

/// The two alternatives of a choice, by its operands.
pub(super) fn alternatives(operands: &[ExprId]) -> [ExprId; 2] {
    match *operands {
        [.., first, second] => [first, second],
        // Every choice has at least two operands.
        [..] => [ExprId::default(); 2],
    }
}

/// When the first alternative of a choice is taken.
pub(super) enum Taken {
    /// Where these two are equal the first, else the second.
    First([ExprId; 2]),
    /// Where these two are equal the second, else the first.
    Second([ExprId; 2]),
}

impl Taken {
    /// The one of two expressions that belongs to the alternative that is taken.
    pub(super) fn of(&self, graph: &mut Graph, [first, second]: [ExprId; 2]) -> ExprId {
        if first == second {
            return first;
        }
        let operands = match self {
            Self::First([a, b]) => [*a, *b, first, second],
            Self::Second([a, b]) => [*a, *b, second, first],
        };
        graph.apply(Function::Select, operands.as_slice())
    }
}

/// When which alternative of a choice is taken, from the derivatives of both.
pub(super) fn taken(
    graph: &mut Graph,
    (choice, function): (ExprId, Function),
    operands: &[ExprId],
    first: &[ExprId],
    second: &[ExprId],
) -> Taken {
    let [a, b] = alternatives(operands);
    if function == Function::Select {
        return Taken::First([operands[0], operands[1]]);
    }
    // At a tie the first is taken where it goes above the other and the larger is wanted, or below and the smaller.
    let apart = first
        .iter()
        .zip(second)
        .find(|(first, second)| first != second);
    let Some((first, second)) = apart else {
        return Taken::First([choice, a]);
    };
    let growth = if function == Function::Max {
        graph.subtract(*first, *second)
    } else {
        graph.subtract(*second, *first)
    };
    let sign = graph.sign(growth);
    if sign.is_not_negative() {
        return Taken::First([choice, a]);
    }
    if sign.is_not_positive() {
        return Taken::Second([choice, b]);
    }
    let [one, zero] = [graph.one(), graph.integer(0)];
    let larger = graph.apply(Function::Max, [growth, zero].as_slice());
    let at_tie = graph.apply(Function::Select, [larger, growth, one, zero].as_slice());
    let apart = graph.apply(Function::Select, [choice, a, one, zero].as_slice());
    let is_first = graph.apply(Function::Select, [a, b, at_tie, apart].as_slice());
    Taken::First([is_first, one])
}

/// The derivative of a size by what it is the size of, 1 or −1, from the derivatives of the latter.
pub(super) fn side(graph: &mut Graph, of: ExprId, inner: &[ExprId]) -> ExprId {
    let is_zero = |graph: &Graph, id: ExprId| graph.as_number(id).is_some_and(Rational::is_zero);
    let growth = inner
        .iter()
        .copied()
        .find(|partial| !is_zero(graph, *partial));
    let sign = growth.map(|growth| (growth, graph.sign(growth)));
    match sign {
        Some((_, sign)) if sign.is_not_positive() && !sign.is_not_negative() => {
            let opposite = graph.negate(of);
            let side = graph.apply(Function::Side, [opposite].as_slice());
            graph.negate(side)
        }
        Some((growth, sign)) if !sign.is_not_negative() => {
            let zero = graph.integer(0);
            let at_zero = graph.apply(Function::Side, [growth].as_slice());
            let apart = graph.apply(Function::Side, [of].as_slice());
            graph.apply(Function::Select, [of, zero, at_zero, apart].as_slice())
        }
        _ => graph.apply(Function::Side, [of].as_slice()),
    }
}
