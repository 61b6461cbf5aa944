//! The one intermediate representation: a hash-consed directed acyclic graph of expressions.
//!
//! **Invariants**
//! - Equal nodes have equal handles, and a node's operands have smaller handles than the node.
//! - A sum holds no number among its operands (a constant is a multiple of [`Graph::one`]), no operand
//!   twice, no zero coefficient, and at least two terms or one with a coefficient other than 1.
//! - A product holds no product, no number other than a divisor 0, no operand twice, no zero exponent; rational
//!   coefficients stand in the sum around it.
//! - Nothing is ever multiplied out: the structure of a formula is its author's knowledge about rounding.
//! - No exponent is larger than [`LARGEST_EXPONENT`] and no constant longer than [`MOST_BITS`]; a graph in which one would be is
//!   marked as [exceeded](Graph::is_exceeded), and of no use.
//!
//! A graph [as written](Graph::as_written) keeps every operation in the order in which its author wrote it instead, as Rust
//! evaluates it: sums of terms from left to right, products of factors from left to right, numbers where they stand. It is
//! what a function's body is read into, and what all other forms of it are held against; only equal nodes are one.

mod canonical;
mod decimal;
mod function;
pub(crate) mod rational;
mod sign;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use crate::approximate::piecewise::PiecewisePolynomial;
pub use decimal::decimal;
pub use function::{Evaluation, Function};
pub use rational::{Rational, ratio, whole};
pub use sign::{Domain, Sign};

/// Handle of an expression in its [`Graph`]; by default that of the number 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(u32);

/// Handle of a symbol (a number that the formula's caller gives) in its [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(u32);

impl ExprId {
    /// Position of the expression in order of creation.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl SymbolId {
    /// Position of the symbol in order of creation.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Names of the mathematical constants that are not rational.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NamedConstant {
    /// Archimedes' constant π.
    Pi,
    /// Euler's number e.
    E,
    /// Natural logarithm of 2.
    Ln2,
    /// Natural logarithm of 10.
    Ln10,
    /// The Euler–Mascheroni constant γ.
    EulerGamma,
}

/// The terms of a sum. Two, and the other operands of most nodes, have no memory of their own.
pub type Terms = SmallVec<[(ExprId, Rational); 2]>;

/// The factors of a product.
pub type Factors = SmallVec<[(ExprId, i32); 4]>;

/// What a function is of.
pub type Operands = SmallVec<[ExprId; 4]>;

/// One node of the graph.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact rational constant.
    Number(Rational),
    /// A constant known by name.
    Constant(NamedConstant),
    /// A number that the caller gives.
    Symbol(SymbolId),
    /// Σ coefficient · operand, by ascending handle.
    Sum(Terms),
    /// Π operand^exponent, by ascending handle.
    Product(Factors),
    /// An elementary function of its operands.
    Apply(Function, Operands),
    /// The derivative of the given order of a tabulated function, a piecewise polynomial made when the crate is built.
    Tabulated {
        /// Position in [`Graph::tables`].
        table: usize,
        /// Order of the derivative, 0 for the function itself.
        order: usize,
        /// The function's argument.
        argument: ExprId,
    },
    /// A definite integral; evaluated when the crate is built, never emitted.
    Integral {
        /// The variable of integration.
        variable: SymbolId,
        /// The integrand.
        integrand: ExprId,
        /// Lower bound.
        lower: ExprId,
        /// Upper bound.
        upper: ExprId,
    },
}

/// What a symbol stands for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// A number that the formula's caller gives.
    Input,
    /// A number that the function of this name is called with, while a partial of it is derived within another formula.
    Argument(Arc<str>),
    /// The variable of the integral with this number.
    Variable(usize),
    /// The named product with this number.
    Product(usize),
}

/// A symbol: its name as the formula's author writes it, what it stands for, and what is known about its sign.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// `omega`, or `c.beta` for a field of a parameter.
    pub name: String,
    /// What it stands for.
    pub role: Role,
    /// The declared domain.
    pub domain: Domain,
}

/// How large the numbers are that a formula is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Sizes {
    /// All that an `f64` can be, infinities and what is no number included.
    #[default]
    All,
    /// Zero, and numbers from the smallest to the largest of these in size.
    Within {
        /// The smallest size beside 0.
        smallest: f64,
        /// The largest size.
        largest: f64,
    },
}

/// A tabulated function: its name, its polynomial, and what is known of its sign.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name of the function in the module.
    pub name: String,
    /// The fit.
    pub polynomial: PiecewisePolynomial,
    /// Sign of the function over its interval.
    pub sign: Sign,
}

impl Table {
    /// The derivative of the given order, 0 for the fit itself.
    pub fn derivative(&self, order: usize) -> PiecewisePolynomial {
        (0..order).fold(self.polynomial.clone(), |polynomial, _| {
            polynomial.derivative()
        })
    }
}

/// By an expression's position what it is in another graph, if it was rebuilt there.
pub type Images = Vec<Option<ExprId>>;

/// A hash-consed graph of expressions.
#[derive(Clone, Debug)]
pub struct Graph {
    nodes: Vec<Node>,
    signs: Vec<Sign>,
    /// Whether no rule of rewriting applies to the node; false where that was not looked at.
    settled: Vec<bool>,
    index: FxHashMap<Node, ExprId>,
    symbols: Vec<Symbol>,
    symbol_index: BTreeMap<(Role, String), SymbolId>,
    names: FxHashMap<ExprId, Arc<str>>,
    /// The sums that the author wrote, in a graph as written: not those of derivatives.
    authored: FxHashSet<ExprId>,
    /// Whether operations stay as they were written.
    is_as_written: bool,
    /// Whether a constant or an exponent has become too long.
    is_exceeded: bool,
    /// The tabulated functions that nodes refer to.
    pub tables: Arc<Vec<Table>>,
    /// How large the symbols' numbers are.
    pub sizes: Sizes,
}

/// The largest exponent of a factor, in size.
pub const LARGEST_EXPONENT: i32 = 10_000;

/// The most binary digits of an exact constant's numerator and denominator, ten times those of any `f64`.
pub const MOST_BITS: u64 = 20_000;

impl Default for Graph {
    fn default() -> Self {
        let mut graph = Self {
            nodes: Vec::new(),
            signs: Vec::new(),
            settled: Vec::new(),
            index: FxHashMap::default(),
            symbols: Vec::new(),
            symbol_index: BTreeMap::new(),
            names: FxHashMap::default(),
            authored: FxHashSet::default(),
            is_as_written: false,
            is_exceeded: false,
            tables: Arc::default(),
            sizes: Sizes::All,
        };
        graph.intern(Node::Number(Rational::ONE));
        graph
    }
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty graph whose operations stay as they are written.
    pub fn as_written() -> Self {
        Self {
            is_as_written: true,
            ..Self::default()
        }
    }

    /// A graph of the same symbols whose operations stay as they are written.
    pub fn as_written_with_symbols_of(other: &Self) -> Self {
        Self {
            is_as_written: true,
            ..Self::with_symbols_of(other)
        }
    }

    /// Whether operations stay as they are written.
    pub fn is_as_written(&self) -> bool {
        self.is_as_written
    }

    /// Whether a constant or an exponent has become longer than any that is gathered, so that expressions are not what they
    /// should be.
    pub fn is_exceeded(&self) -> bool {
        self.is_exceeded
    }

    /// An empty graph with the same symbols (by the same handles) and tables, to rebuild expressions in.
    pub fn with_symbols_of(other: &Self) -> Self {
        let mut graph = Self::new();
        graph.symbols.clone_from(&other.symbols);
        graph.symbol_index.clone_from(&other.symbol_index);
        graph.tables.clone_from(&other.tables);
        graph.is_exceeded = other.is_exceeded;
        graph.sizes = other.sizes;
        graph
    }

    /// The number 1.
    pub fn one(&self) -> ExprId {
        ExprId(0)
    }

    /// The node behind a handle.
    pub fn node(&self, id: ExprId) -> &Node {
        &self.nodes[id.index()]
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The expression made at that position.
    pub fn expression(&self, position: usize) -> Option<ExprId> {
        u32::try_from(position)
            .ok()
            .filter(|_| position < self.nodes.len())
            .map(ExprId)
    }

    /// A graph is never empty: it holds the number 1.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The symbol behind a handle.
    pub fn symbol(&self, id: SymbolId) -> &Symbol {
        &self.symbols[id.index()]
    }

    /// All symbols in order of creation.
    pub fn symbols(&self) -> impl Iterator<Item = (SymbolId, &Symbol)> {
        self.symbols
            .iter()
            .enumerate()
            .map(|(position, symbol)| (SymbolId(position as u32), symbol))
    }

    /// The input of that name, made if there is none.
    pub fn symbol_named(&mut self, name: &str) -> SymbolId {
        self.symbol_of(Role::Input, name)
    }

    /// The symbol of that role and name, made if there is none.
    pub fn symbol_of(&mut self, role: Role, name: &str) -> SymbolId {
        let next = SymbolId(self.symbols.len() as u32);
        let key = (role, name.to_owned());
        let id = *self.symbol_index.entry(key.clone()).or_insert(next);
        if id == next {
            let (role, name) = key;
            self.symbols.push(Symbol {
                name,
                role,
                domain: Domain::default(),
            });
        }
        id
    }

    /// The input of that name, if there is one.
    pub fn find_symbol(&self, name: &str) -> Option<SymbolId> {
        let key = (Role::Input, name.to_owned());
        self.symbol_index.get(&key).copied()
    }

    /// Declares where a symbol lies; its sign holds for expressions that are made afterwards.
    pub fn assume(&mut self, id: SymbolId, domain: Domain) {
        let known = &mut self.symbols[id.index()].domain;
        *known = known.and(domain);
    }

    /// Suggests a name for a temporary; the first suggestion stays.
    pub fn suggest_name(&mut self, id: ExprId, name: &str) {
        self.names.entry(id).or_insert_with(|| name.into());
    }

    /// The suggested name, if any.
    pub fn suggested_name(&self, id: ExprId) -> Option<&str> {
        self.names.get(&id).map(|name| &**name)
    }

    /// Notes that the author wrote an expression, so that it is no part of a derivative.
    pub fn note_author(&mut self, id: ExprId) {
        self.authored.insert(id);
    }

    /// Whether the author wrote the expression.
    pub fn is_authored(&self, id: ExprId) -> bool {
        self.authored.contains(&id)
    }

    fn intern(&mut self, node: Node) -> ExprId {
        if let Some(&id) = self.index.get(&node) {
            return id;
        }
        let id = ExprId(self.nodes.len() as u32);
        let sign = self.derive_sign(&node);
        self.signs.push(sign);
        self.settled.push(false);
        self.nodes.push(node.clone());
        self.index.insert(node, id);
        id
    }

    /// Whether a node is known to be one that no rule of rewriting applies to.
    pub fn is_settled(&self, id: ExprId) -> bool {
        self.settled[id.index()]
    }

    /// Notes that no rule of rewriting applies to a node.
    pub fn settle(&mut self, id: ExprId) {
        self.settled[id.index()] = true;
    }

    /// The operands of a node.
    pub fn operands(&self, id: ExprId) -> Vec<ExprId> {
        let mut operands = Vec::new();
        self.each_operand(id, |operand| operands.push(operand));
        operands
    }

    /// Calls `visit` with every operand of a node in order.
    pub(crate) fn each_operand(&self, id: ExprId, mut visit: impl FnMut(ExprId)) {
        match self.node(id) {
            Node::Number(_) | Node::Constant(_) | Node::Symbol(_) => {}
            Node::Sum(terms) => terms.iter().for_each(|(operand, _)| visit(*operand)),
            Node::Product(factors) => factors.iter().for_each(|(operand, _)| visit(*operand)),
            Node::Apply(_, operands) => operands.iter().for_each(|operand| visit(*operand)),
            Node::Tabulated { argument, .. } => visit(*argument),
            Node::Integral {
                integrand,
                lower,
                upper,
                ..
            } => [integrand, lower, upper]
                .into_iter()
                .for_each(|operand| visit(*operand)),
        }
    }

    /// Everything the roots need, operands before their users.
    pub fn reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<ExprId> = roots.to_vec();
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut seen[id.index()], true) {
                self.each_operand(id, |operand| stack.push(operand));
            }
        }
        (0..self.nodes.len())
            .filter(|&i| seen[i])
            .map(|i| ExprId(i as u32))
            .collect()
    }

    /// For every node, whether it depends on one of the symbols; a variable of integration is asked for alone.
    pub fn depends_on(&self, symbols: &BTreeSet<SymbolId>) -> Vec<bool> {
        let mut depends = vec![false; self.nodes.len()];
        for position in 0..self.nodes.len() {
            let id = ExprId(position as u32);
            depends[position] = match self.node(id) {
                Node::Symbol(symbol) => symbols.contains(symbol),
                // An integral does not depend on its own variable.
                Node::Integral {
                    variable,
                    lower,
                    upper,
                    ..
                } if symbols.contains(variable) => depends[lower.index()] || depends[upper.index()],
                _ => {
                    let mut operand_depends = false;
                    self.each_operand(id, |operand| operand_depends |= depends[operand.index()]);
                    operand_depends
                }
            };
        }
        depends
    }

    /// The symbols that the roots depend on, in order of creation.
    pub fn symbols_of(&self, roots: &[ExprId]) -> BTreeSet<SymbolId> {
        self.reachable(roots)
            .into_iter()
            .filter_map(|id| match self.node(id) {
                Node::Symbol(symbol) => Some(*symbol),
                _ => None,
            })
            .collect()
    }

    /// Rebuilds the roots in `target`, sending each rebuilt node through `visit`.
    ///
    /// `visit` gets the target graph, the old handle and the rebuilt node, and answers with the node that stands
    /// for it from there on: a substitution, a rewriting, or the node itself.
    pub fn rebuild(
        &self,
        target: &mut Graph,
        roots: &[ExprId],
        mut visit: impl FnMut(&mut Graph, ExprId, ExprId) -> ExprId,
    ) -> Vec<ExprId> {
        let mut images: Vec<Option<ExprId>> = vec![None; self.nodes.len()];
        // What is rebuilt of the same parts stays settled.
        let mut same = vec![false; self.nodes.len()];
        for id in self.reachable(roots) {
            let rebuilt = self.rebuild_node(target, id, &images);
            let mut is_same = true;
            self.each_operand(id, |operand| is_same &= same[operand.index()]);
            if is_same && self.is_settled(id) {
                target.settle(rebuilt);
            }
            let image = visit(target, id, rebuilt);
            same[id.index()] = is_same && image == rebuilt;
            if let Some(name) = self.names.get(&id) {
                target.names.entry(image).or_insert_with(|| name.clone());
            }
            if target.is_as_written && self.authored.contains(&id) {
                target.authored.insert(image);
            }
            images[id.index()] = Some(image);
        }
        let one = target.one();
        roots
            .iter()
            .map(|root| images[root.index()].unwrap_or(one))
            .collect()
    }

    /// Rebuilds one more expression in the target, of which `images` has what was rebuilt before.
    pub fn rebuild_more(&self, target: &mut Graph, root: ExprId, images: &mut Images) -> ExprId {
        images.resize(self.nodes.len(), None);
        let (mut order, mut stack) = (Vec::new(), vec![root]);
        let mut seen = FxHashSet::default();
        while let Some(id) = stack.pop() {
            if images[id.index()].is_none() && seen.insert(id) {
                order.push(id);
                self.each_operand(id, |operand| stack.push(operand));
            }
        }
        // Operands come before their users.
        order.sort_unstable();
        for id in order {
            images[id.index()] = Some(self.rebuild_node(target, id, images));
        }
        images[root.index()].unwrap_or(target.one())
    }

    fn rebuild_node(&self, target: &mut Graph, id: ExprId, images: &[Option<ExprId>]) -> ExprId {
        // Operands come before their users, so that an image is always there.
        let image = |operand: &ExprId| images[operand.index()].unwrap_or(ExprId(0));
        match self.node(id) {
            Node::Number(value) => target.number(value.clone()),
            Node::Constant(constant) => target.constant(*constant),
            Node::Symbol(symbol) => target.symbol_expression(*symbol),
            Node::Sum(terms) => {
                let terms: Terms = terms
                    .iter()
                    .map(|(operand, q)| (image(operand), q.clone()))
                    .collect();
                target.sum(terms)
            }
            Node::Product(factors) => {
                let factors: Factors = factors
                    .iter()
                    .map(|(operand, n)| (image(operand), *n))
                    .collect();
                target.product(factors)
            }
            Node::Apply(function, operands) => {
                let operands: Operands = operands.iter().map(image).collect();
                target.apply(*function, operands)
            }
            Node::Tabulated {
                table,
                order,
                argument,
            } => target.tabulated(*table, *order, image(argument)),
            Node::Integral {
                variable,
                integrand,
                lower,
                upper,
            } => target.integral(*variable, image(integrand), image(lower), image(upper)),
        }
    }

    /// Replaces symbols by expressions of the same graph, everywhere at once.
    pub fn substitute(
        &mut self,
        roots: &[ExprId],
        replacements: &BTreeMap<SymbolId, ExprId>,
    ) -> Vec<ExprId> {
        let source = self.clone();
        source.rebuild(self, roots, |_, old, image| match source.node(old) {
            Node::Symbol(symbol) => replacements.get(symbol).copied().unwrap_or(image),
            _ => image,
        })
    }
}
