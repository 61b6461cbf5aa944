//! The form between graph and code, in which every operation that will be done is visible.
//!
//! Unlike the graph's, its sums and products stay as they were taken apart: `(a·b)·c` with a shared `a·b` is two
//! products.

mod cost;
mod tidy;

use std::hash::BuildHasher;
use std::sync::Arc;

use rustc_hash::{FxBuildHasher, FxHashMap};
use smallvec::{SmallVec, smallvec};

use crate::graph::{Function, Rational, SymbolId, rational};

/// Handle of an operation in its [`Circuit`]; by default the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Net(u32);

impl Net {
    /// Position of the operation; operands come before their users.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The terms of a sum. Two, and the other operands of most operations, have no memory of their own.
pub type Terms = SmallVec<[(Net, Rational); 2]>;

/// The factors of a product.
pub type Factors = SmallVec<[(Net, u32); 4]>;

/// The operands of a function.
pub type Operands = SmallVec<[Net; 4]>;

/// One operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// A constant.
    Number(Rational),
    /// A number that the caller gives.
    Symbol(SymbolId),
    /// Σ coefficient · operand, by ascending handle.
    Sum(Terms),
    /// Π operand^power, by ascending handle.
    Product(Factors),
    /// Numerator over denominator.
    Quotient(Net, Net),
    /// An elementary function.
    Apply(Function, Operands),
    /// A derivative of some order of a tabulated function.
    Tabulated {
        /// Position among the graph's tables.
        table: usize,
        /// Order of the derivative.
        order: usize,
        /// The argument.
        argument: Net,
    },
}

impl Operation {
    /// Replaces the operands of the operation.
    fn with_operands(self, image: impl Fn(&Net) -> Net) -> Self {
        match self {
            Self::Number(_) | Self::Symbol(_) => self,
            Self::Sum(mut terms) => {
                terms.iter_mut().for_each(|term| term.0 = image(&term.0));
                Self::Sum(terms)
            }
            Self::Product(mut factors) => {
                factors
                    .iter_mut()
                    .for_each(|factor| factor.0 = image(&factor.0));
                Self::Product(factors)
            }
            Self::Quotient(numerator, denominator) => {
                Self::Quotient(image(&numerator), image(&denominator))
            }
            Self::Apply(function, operands) => {
                Self::Apply(function, operands.iter().map(image).collect())
            }
            Self::Tabulated {
                table,
                order,
                argument,
            } => Self::Tabulated {
                table,
                order,
                argument: image(&argument),
            },
        }
    }
}

fn hash_of(operation: &Operation) -> u64 {
    FxBuildHasher.hash_one(operation)
}

/// Operations in order, with the places of the results.
#[derive(Clone, Debug, Default)]
pub struct Circuit {
    operations: Vec<Operation>,
    /// For each hash the last operation with it; the operation may have been replaced since.
    index: FxHashMap<u64, Net>,
    names: FxHashMap<Net, Arc<str>>,
    /// Whether nothing was added or replaced since it was last tidied.
    tidy: bool,
    /// The results in order.
    pub outputs: Vec<Net>,
}

impl Circuit {
    fn with_capacity(operations: usize) -> Self {
        Self {
            operations: Vec::with_capacity(operations),
            index: FxHashMap::with_capacity_and_hasher(operations, FxBuildHasher),
            ..Self::default()
        }
    }

    /// Whether another circuit has the same operations in the same order.
    pub fn is_same(&self, other: &Self) -> bool {
        self.outputs == other.outputs && self.operations == other.operations
    }

    /// Whether another circuit is the same in all that a search looks at: its operations, its results and their names.
    pub(crate) fn is_identical(&self, other: &Self) -> bool {
        self.is_same(other) && self.tidy == other.tidy && self.names == other.names
    }

    /// Adds an operation, or finds the equal one.
    pub fn push(&mut self, operation: Operation) -> Net {
        let new = Net(self.operations.len() as u32);
        let place = self.index.entry(hash_of(&operation)).or_insert(new);
        if *place != new && self.operations[place.index()] == operation {
            return *place;
        }
        *place = new;
        self.tidy = false;
        self.operations.push(operation);
        new
    }

    /// A constant.
    pub fn number(&mut self, value: Rational) -> Net {
        self.push(Operation::Number(value))
    }

    /// The operation behind a handle.
    pub fn operation(&self, net: Net) -> &Operation {
        &self.operations[net.index()]
    }

    /// Puts another operation in the place of one; its operands may have larger handles until [`Self::tidy`].
    pub fn replace(&mut self, net: Net, operation: Operation) {
        if self.operations[net.index()] != operation {
            self.tidy = false;
            self.operations[net.index()] = operation;
        }
    }

    /// All handles in order.
    pub fn nets(&self) -> impl Iterator<Item = Net> + use<> {
        (0..self.operations.len() as u32).map(Net)
    }

    /// Suggests a name; the first stays.
    pub fn suggest_name(&mut self, net: Net, name: &str) {
        self.names.entry(net).or_insert_with(|| name.into());
    }

    /// The suggested name, if any.
    pub fn suggested_name(&self, net: Net) -> Option<&str> {
        self.names.get(&net).map(|name| &**name)
    }

    /// The operands of an operation.
    pub fn operands(&self, net: Net) -> Vec<Net> {
        let mut operands = Vec::new();
        self.each_operand(net, |operand| operands.push(operand));
        operands
    }

    /// Calls `visit` with every operand of an operation in order.
    pub fn each_operand(&self, net: Net, mut visit: impl FnMut(Net)) {
        match self.operation(net) {
            Operation::Number(_) | Operation::Symbol(_) => {}
            Operation::Sum(terms) => terms.iter().for_each(|(operand, _)| visit(*operand)),
            Operation::Product(factors) => factors.iter().for_each(|(operand, _)| visit(*operand)),
            Operation::Quotient(numerator, denominator) => {
                visit(*numerator);
                visit(*denominator);
            }
            Operation::Apply(_, operands) => operands.iter().for_each(|operand| visit(*operand)),
            Operation::Tabulated { argument, .. } => visit(*argument),
        }
    }

    /// How often each operation is an operand or a result.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.operations.len()];
        for net in self.nets() {
            self.each_operand(net, |operand| uses[operand.index()] += 1);
        }
        for output in &self.outputs {
            uses[output.index()] += 1;
        }
        uses
    }

    /// Binary digits of the longest constant.
    pub fn longest_constant(&self) -> u64 {
        let of = |operation: &Operation| match operation {
            Operation::Number(value) => value.bits(),
            Operation::Sum(terms) => terms.iter().map(|(_, q)| q.bits()).max().unwrap_or(0),
            _ => 0,
        };
        self.operations.iter().map(of).max().unwrap_or(0)
    }

    /// Whether the operation is a constant.
    pub fn as_number(&self, net: Net) -> Option<&Rational> {
        match self.operation(net) {
            Operation::Number(value) => Some(value),
            _ => None,
        }
    }

    /// A sum in its simplest form: no zero term, no sum of one term with the coefficient 1. Multiples among the operands
    /// are opened.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (Net, Rational)>) -> Net {
        let opened = terms
            .into_iter()
            .map(|(operand, coefficient)| match self.operation(operand) {
                Operation::Sum(inner) if inner.len() == 1 => {
                    (inner[0].0, &inner[0].1 * &coefficient)
                }
                _ => (operand, coefficient),
            })
            .collect();
        self.closed_sum(opened)
    }

    /// A sum in its simplest form whose operands stay as they are.
    fn closed_sum(&mut self, terms: Terms) -> Net {
        let is_zero = |net: Net| self.as_number(net).is_some_and(Rational::is_zero);
        let mut terms = terms;
        terms.retain(|(operand, _)| !is_zero(*operand));
        rational::collect(&mut terms);
        match terms.as_slice() {
            [] => self.number(Rational::ZERO),
            [(operand, coefficient)] if coefficient.is_one() => *operand,
            [(operand, coefficient)] if self.as_number(*operand).is_some_and(Rational::is_one) => {
                let value = coefficient.clone();
                self.number(value)
            }
            _ => self.push(Operation::Sum(terms)),
        }
    }

    /// A multiple of an operand, which is not opened even if it is a multiple itself.
    pub fn multiple(&mut self, (operand, coefficient): (Net, Rational)) -> Net {
        if coefficient.is_one() {
            return operand;
        }
        self.push(Operation::Sum(smallvec![(operand, coefficient)]))
    }

    /// A sum of two terms, neither of which is opened.
    pub fn sum_of_two(&mut self, first: (Net, Rational), second: (Net, Rational)) -> Net {
        let mut terms: Terms = smallvec![first, second];
        // Two equal operands become one with the sum of both coefficients, which is as exact; but x − x is not 0 where x is
        // infinite.
        if terms[0].0 != terms[1].0 || terms[0].1 != -&terms[1].1 {
            rational::collect(&mut terms);
        }
        match terms.as_slice() {
            [(operand, coefficient)] => self.multiple((*operand, coefficient.clone())),
            _ => self.push(Operation::Sum(terms)),
        }
    }

    /// A product of two factors, neither of which is opened.
    pub fn product_of_two(&mut self, first: Net, second: Net) -> Net {
        let mut factors: Factors = smallvec![(first, 1), (second, 1)];
        rational::collect(&mut factors);
        self.push(Operation::Product(factors))
    }

    /// Removes the operations that no result needs.
    pub fn without_unused(self) -> Self {
        self.swept()
    }

    /// A product in its simplest form.
    pub fn product(&mut self, factors: impl IntoIterator<Item = (Net, u32)>) -> Net {
        let mut collected = Factors::new();
        for (operand, power) in factors {
            match self.as_number(operand) {
                Some(number) if power > 0 && number.is_zero() => return operand,
                Some(number) if number.is_one() => {}
                _ => collected.push((operand, power)),
            }
        }
        rational::collect(&mut collected);
        let factors = collected;
        match factors.as_slice() {
            [] => self.number(Rational::ONE),
            [(operand, 1)] => *operand,
            _ => self.push(Operation::Product(factors)),
        }
    }
}
