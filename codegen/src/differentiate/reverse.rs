//! The reverse mode: sweeps from a function down to the symbols.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashSet;

use super::corners::Signs;
use super::{LEAST_LOOKS, LOOKS_PER_NODE, corners, slopes};
use crate::budget::Budget;
use crate::graph::{ExprId, Function, Graph, Node, Operands, Rational, SymbolId, whole};
use crate::rewrite::common::over_common_divisor;

/// The partials of a function, or `None` if they are beyond the budget.
pub(super) fn gradient(
    graph: &mut Graph,
    function: ExprId,
    by: &[SymbolId],
    budget: &mut Budget,
) -> Option<Vec<ExprId>> {
    let depends = depending(graph, function, by);
    budget.allow(LEAST_LOOKS + LOOKS_PER_NODE * depends.len() * (1 + by.len()));
    let mut sweeps = Sweeps {
        by,
        depends,
        known: BTreeMap::new(),
        signs: Signs::default(),
    };
    sweeps.run(graph, function, budget)?;
    sweeps.known.remove(&function)
}

/// What a function is made of and depends on one of the symbols. The graph may be much larger than the function.
fn depending(graph: &Graph, function: ExprId, by: &[SymbolId]) -> FxHashSet<ExprId> {
    let wanted: BTreeSet<SymbolId> = by.iter().copied().collect();
    let mut reached = FxHashSet::from_iter([function]);
    let mut order = vec![function];
    let mut next = 0;
    while let Some(id) = order.get(next).copied() {
        graph.each_operand(id, |operand| {
            if reached.insert(operand) {
                order.push(operand);
            }
        });
        next += 1;
    }
    // Operands come before their users.
    order.sort_unstable();
    let mut depending = FxHashSet::default();
    for id in order {
        let mut depends = matches!(graph.node(id), Node::Symbol(symbol) if wanted.contains(symbol));
        graph.each_operand(id, |operand| depends |= depending.contains(&operand));
        if depends {
            depending.insert(id);
        }
    }
    depending
}

/// The sweeps for one gradient: one for the function, and one for each side of a corner in it.
struct Sweeps<'a> {
    by: &'a [SymbolId],
    /// The nodes that depend on one of the symbols.
    depends: FxHashSet<ExprId>,
    /// The partials of the functions that were swept.
    known: BTreeMap<ExprId, Vec<ExprId>>,
    signs: Signs,
}

/// What a node's users pass on to it, to be summed.
type Adjoints = BTreeMap<ExprId, Vec<(ExprId, Rational)>>;

/// One sweep, from a function to all that it depends on.
struct Sweep {
    function: ExprId,
    /// Of the nodes that are still to be visited, from the last to the first: a node's users come after it.
    adjoints: Adjoints,
    of_symbols: BTreeMap<SymbolId, ExprId>,
    /// A corner that waits for the partials of what meets in it.
    waiting: Option<Corner>,
}

/// A choice or a size, and what its users pass on to it.
struct Corner {
    id: ExprId,
    function: Function,
    operands: Operands,
    adjoint: ExprId,
}

impl Corner {
    /// What meets in it.
    fn sides(&self) -> Vec<ExprId> {
        match self.function {
            Function::Abs => self.operands.to_vec(),
            _ => corners::alternatives(&self.operands).to_vec(),
        }
    }
}

impl Sweep {
    fn of(graph: &Graph, function: ExprId) -> Self {
        Self {
            function,
            adjoints: Adjoints::from([(function, vec![(graph.one(), whole(1))])]),
            of_symbols: BTreeMap::new(),
            waiting: None,
        }
    }
}

impl Sweeps<'_> {
    /// Sweeps a function, and before it goes on from a corner what meets in it: a stack of sweeps, as corners may be nested to
    /// any depth.
    fn run(&mut self, graph: &mut Graph, function: ExprId, budget: &mut Budget) -> Option<()> {
        let mut stack = vec![Sweep::of(graph, function)];
        while let Some(sweep) = stack.last_mut() {
            if let Some(corner) = sweep.waiting.take() {
                let mut sides = corner.sides().into_iter();
                if let Some(side) = sides.find(|id| !self.known.contains_key(id)) {
                    sweep.waiting = Some(corner);
                    stack.push(Sweep::of(graph, side));
                    continue;
                }
                match corner.function {
                    Function::Abs => self.pass_size(graph, &corner, &mut sweep.adjoints),
                    _ => self.pass_choice(graph, &corner, &mut sweep.adjoints),
                }
            }
            match sweep.adjoints.pop_last() {
                Some((id, contributions)) => {
                    self.visit(graph, sweep, id, contributions, budget)?;
                }
                None => {
                    let zero = graph.integer(0);
                    let of_symbols = &sweep.of_symbols;
                    let partial = |symbol| of_symbols.get(symbol).copied().unwrap_or(zero);
                    let partials = self.by.iter().map(partial).collect();
                    self.known.insert(sweep.function, partials);
                    stack.pop();
                }
            }
        }
        Some(())
    }

    /// Passes on what a node gets from its users. `None` if the budget is spent.
    fn visit(
        &self,
        graph: &mut Graph,
        sweep: &mut Sweep,
        id: ExprId,
        contributions: Vec<(ExprId, Rational)>,
        budget: &mut Budget,
    ) -> Option<()> {
        if !self.depends.contains(&id) {
            return Some(());
        }
        let adjoint = graph.sum(contributions);
        if let Node::Symbol(symbol) = graph.node(id) {
            let symbol = *symbol;
            // The contributions share the divisions that their way here has in common; a further derivative of them one
            // by one would have differences that cancel.
            let partial = over_common_divisor(graph, adjoint);
            sweep.of_symbols.insert(symbol, partial);
            return Some(());
        }
        if let Node::Apply(function, operands) = graph.node(id)
            && (function.is_choice() || *function == Function::Abs)
        {
            sweep.waiting = Some(Corner {
                id,
                function: *function,
                operands: operands.clone(),
                adjoint,
            });
            return Some(());
        }
        budget.take(self.looks(graph, id)).then_some(())?;
        for (operand, slope, coefficient) in slopes(graph, id, |id| self.depends.contains(&id)) {
            let factors = std::iter::once((adjoint, 1)).chain(slope);
            let share = graph.product(factors);
            budget.take(width(graph, share)).then_some(())?;
            let adjoints = sweep.adjoints.entry(operand).or_default();
            adjoints.push((share, coefficient));
        }
        Some(())
    }

    /// How many factors the slopes of a node have together: of a product each that matters has that of all others.
    fn looks(&self, graph: &Graph, id: ExprId) -> usize {
        match graph.node(id) {
            Node::Product(factors) => {
                let matter = factors.iter().filter(|(id, _)| self.depends.contains(id));
                matter.count() * factors.len()
            }
            _ => 1,
        }
    }

    /// The derivative of a choice is a choice between the derivatives, all factors included: a choice between 1 and 0 as a
    /// factor of them would be 0·∞ where the alternative that is not taken has an infinite derivative.
    fn pass_choice(&mut self, graph: &mut Graph, corner: &Corner, adjoints: &mut Adjoints) {
        let [first, second] =
            corners::alternatives(&corner.operands).map(|id| self.known[&id].clone());
        let choice = (corner.id, corner.function);
        let taken = corners::taken(
            graph,
            &mut self.signs,
            choice,
            &corner.operands,
            &first,
            &second,
        );
        for ((symbol, first), second) in self.by.iter().zip(first).zip(second) {
            let both = [first, second].map(|partial| graph.multiply(corner.adjoint, partial));
            let share = taken.of(graph, both);
            let symbol = graph.symbol_expression(*symbol);
            // A symbol that comes after the choice is none of its parts, and may have been visited.
            if symbol < corner.id {
                adjoints.entry(symbol).or_default().push((share, whole(1)));
            }
        }
    }

    /// The derivative of a size is that of what it is the size of, times the side of 0 on which that is.
    fn pass_size(&mut self, graph: &mut Graph, corner: &Corner, adjoints: &mut Adjoints) {
        let inner = corner.operands[0];
        let side = corners::side(graph, &mut self.signs, inner, &self.known[&inner]);
        let share = graph.multiply(corner.adjoint, side);
        adjoints.entry(inner).or_default().push((share, whole(1)));
    }
}

/// How many factors an expression has.
fn width(graph: &Graph, id: ExprId) -> usize {
    match graph.node(id) {
        Node::Product(factors) => factors.len(),
        Node::Sum(terms) if terms.len() == 1 => match graph.node(terms[0].0) {
            Node::Product(factors) => factors.len(),
            _ => 1,
        },
        _ => 1,
    }
}
