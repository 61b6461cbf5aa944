//! Named products as symbols of their own.
//!
//! A product of products is one product: an author's `bending * c.c44` becomes a product of all that both are made of.
//! Then a derivative goes from there to each of the many inputs at once, past the few numbers that the author put between
//! them. A reader that holds gives each product that has a name a symbol, so that it stays whole.

use super::Reader;
use crate::graph::{ExprId, Graph, Node, SymbolId, whole};
use crate::parse::value::Value;

/// The named products of a formula in the order of their making: the symbol of each, and what it is.
pub type Definitions = Vec<(SymbolId, ExprId)>;

impl Reader<'_> {
    /// A value that the source gives a name.
    pub(super) fn named_number(&mut self, value: Value, name: &str) -> Value {
        match value {
            Value::Number(id) => {
                self.graph.suggest_name(id, name);
                Value::Number(self.held(id, name))
            }
            other => other,
        }
    }

    /// The number that stands for this one from here on: a symbol, or a multiple of one, for a product that divides by
    /// nothing that may be 0.
    fn held(&mut self, id: ExprId, name: &str) -> ExprId {
        let Some(definitions) = &mut self.definitions else {
            return id;
        };
        let (product, coefficient) = match self.graph.node(id).clone() {
            Node::Sum(terms) => match terms.as_slice() {
                [(product, coefficient)] => (*product, coefficient.clone()),
                _ => return id,
            },
            _ => (id, whole(1)),
        };
        if !is_whole(&self.graph, product) {
            return id;
        }
        let known = definitions.iter().find(|(_, known)| *known == product);
        let symbol = known.map(|(symbol, _)| *symbol).unwrap_or_else(|| {
            let symbol = self
                .graph
                .symbol_named(&format!("{name}~{}", definitions.len()));
            self.graph.assume(symbol, self.graph.sign(product));
            definitions.push((symbol, product));
            self.graph.suggest_name(product, name);
            symbol
        });
        let symbol = self.graph.symbol_expression(symbol);
        self.graph.scale(symbol, coefficient)
    }
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
