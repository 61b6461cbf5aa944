//! A function's result, as its author wrote it and as it is worked on.

use crate::emit::columns;
use crate::factor::identities::merge_held;
use crate::factor::rounding::Written;
use crate::gather::{gather, hold};
use crate::graph::{ExprId, Graph, Node, Role, SymbolId};
use crate::outputs::Held;
use crate::parse::value::Value;
use crate::rewrite;

/// A function's result over its own symbols.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The result as its author wrote it, operation by operation.
    pub written: Written,
    /// Rewritten graph of the result.
    pub graph: Graph,
    /// Shape of the result.
    pub value: Value,
    /// Its numbers.
    pub roots: Vec<ExprId>,
    /// The result over named products that are held as symbols, where a gradient is asked for.
    pub held: Option<Held>,
}

impl Formula {
    /// Whether an integral without a table is in it, so that there is no code for it.
    pub fn has_integral(&self) -> bool {
        holds_integral(&self.graph, &self.roots)
    }

    /// A result that was read into a graph as written.
    pub fn of(graph: Graph, value: &Value, hold: bool) -> Self {
        let numbers: Vec<ExprId> = value.numbers().into_iter().map(|(_, id)| id).collect();
        let gathered = gather(&graph, &numbers);
        let held = hold.then(|| self::hold(&graph, &numbers)).flatten();
        let (rewritten, roots) = rewrite::rewrite(&gathered.graph, &gathered.roots);
        Self {
            value: value.with_numbers(&mut roots.iter().copied()),
            graph: rewritten,
            roots,
            // What cancels between products that are held is seen only in their values, and is not to be derived.
            held: held.map(|held| rewrite::rewrite_held(&merge_held(&held))),
            written: Written {
                graph,
                reverse: numbers.clone(),
                roots: numbers,
                undoes_rounding: gathered.undoes_rounding,
            },
        }
    }

    /// Its inputs, also those that cancel, in the order in which it names them.
    pub fn inputs(&self) -> Vec<SymbolId> {
        let all = self.graph.symbols();
        let own = all.filter(|(_, symbol)| symbol.role == Role::Input);
        own.map(|(id, _)| id).collect()
    }

    /// Their names.
    pub fn input_names(&self) -> Vec<String> {
        columns::names_of(&self.graph, &self.inputs())
    }

    /// The input of that name, made where the formula does not depend on it.
    pub fn input(&mut self, name: &str) -> SymbolId {
        // Both graphs give a new symbol the same handle: each is made with the symbols of the one as written.
        self.written.graph.symbol_named(name);
        self.graph.symbol_named(name)
    }
}

/// Whether an integral is among what the numbers are made of.
pub(super) fn holds_integral(graph: &Graph, roots: &[ExprId]) -> bool {
    graph
        .reachable(roots)
        .into_iter()
        .any(|id| matches!(graph.node(id), Node::Integral { .. }))
}
