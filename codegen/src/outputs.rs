//! What one generated function gives: numbers of a graph, with the partials that are asked for.

use crate::graph::{ExprId, Graph, SymbolId};

/// The numbers that one generated function gives.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// The values.
    pub values: Vec<ExprId>,
    /// The symbols that the gradient is by.
    pub by: Vec<SymbolId>,
    /// For each value its partials by those symbols.
    pub gradients: Vec<Vec<ExprId>>,
    /// For each value the upper triangle of its second partials, by rows.
    pub hessians: Vec<Vec<ExprId>>,
}

impl Outputs {
    /// All numbers in order.
    pub fn all(&self) -> Vec<ExprId> {
        let gradients = self.gradients.iter().flatten();
        let hessians = self.hessians.iter().flatten();
        self.values
            .iter()
            .chain(gradients)
            .chain(hessians)
            .copied()
            .collect()
    }

    /// Outputs of this shape with other numbers, taken in order.
    pub fn with_all(&self, all: &[ExprId]) -> Self {
        let mut all = all.iter().copied();
        let mut take =
            |old: &Vec<ExprId>| -> Vec<ExprId> { all.by_ref().take(old.len()).collect() };
        Self {
            values: take(&self.values),
            by: self.by.clone(),
            gradients: self.gradients.iter().map(&mut take).collect(),
            hessians: self.hessians.iter().map(&mut take).collect(),
        }
    }
}

/// The named products of a formula in the order of their making: the symbol of each, and what it is.
pub type Definitions = Vec<(SymbolId, ExprId)>;

/// A function's numbers over named products that are held as symbols.
#[derive(Clone, Debug)]
pub struct Held {
    /// The graph, whose first symbols are those of the other form.
    pub graph: Graph,
    /// The numbers.
    pub outputs: Outputs,
    /// What each held symbol is, over the symbols before it.
    pub definitions: Definitions,
}

impl Held {
    /// The numbers, then the products.
    pub fn all(&self) -> Vec<ExprId> {
        let products = self.definitions.iter().map(|(_, product)| *product);
        self.outputs.all().into_iter().chain(products).collect()
    }
}
