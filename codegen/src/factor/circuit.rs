//! The form between graph and code, in which every operation that will be done is visible.
//!
//! Unlike the graph's, its sums and products stay as they were taken apart: `(a·b)·c` with a shared `a·b` is two
//! products.

use std::hash::BuildHasher;
use std::sync::Arc;

use rustc_hash::{FxBuildHasher, FxHashMap};
use smallvec::{SmallVec, smallvec};

use crate::cost::Cost;
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

/// What a function is of.
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
    /// The same operation on other operands.
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
    /// Where the last operation of a hash is, if it was not replaced since.
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
        self.operations == other.operations && self.outputs == other.outputs
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

    /// The same with multiples among the operands as they are.
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

    /// A multiple as it stands.
    pub fn multiple(&mut self, (operand, coefficient): (Net, Rational)) -> Net {
        if coefficient.is_one() {
            return operand;
        }
        self.push(Operation::Sum(smallvec![(operand, coefficient)]))
    }

    /// A sum of two terms as it stands.
    pub fn sum_of_two(&mut self, first: (Net, Rational), second: (Net, Rational)) -> Net {
        let mut terms: Terms = smallvec![first, second];
        // The same operand twice is one with the sum of both coefficients, which is as exact; but x − x is not 0 where x is
        // infinite.
        if terms[0].0 != terms[1].0 || terms[0].1 != -&terms[1].1 {
            rational::collect(&mut terms);
        }
        match terms.as_slice() {
            [(operand, coefficient)] => self.multiple((*operand, coefficient.clone())),
            _ => self.push(Operation::Sum(terms)),
        }
    }

    /// A product of two factors as it stands.
    pub fn product_of_two(&mut self, first: Net, second: Net) -> Net {
        let mut factors: Factors = smallvec![(first, 1), (second, 1)];
        rational::collect(&mut factors);
        self.push(Operation::Product(factors))
    }

    /// The same operations without those that no result needs.
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

    /// Drops what no result needs, brings operands before their users, and makes equal operations one.
    pub fn tidy(&mut self) {
        if !self.tidy {
            self.rebuild(&[]);
        }
    }

    /// The same with the inputs first, in their author's order, and so in sums too: b − a − z with nearly equal a and b and
    /// a small z is not to become b − z − a.
    pub fn tidy_by_inputs(&mut self) {
        let symbols = self.live_symbols();
        self.rebuild(&symbols);
    }

    /// Puts the last outputs, one for each symbol, in the places of the symbols.
    pub fn define(&mut self, symbols: &[SymbolId]) {
        let results = self.outputs.len().saturating_sub(symbols.len());
        let definitions = self.outputs.split_off(results);
        for (symbol, definition) in symbols.iter().zip(definitions) {
            if let Some(&net) = self.index.get(&hash_of(&Operation::Symbol(*symbol))) {
                self.replace(net, Operation::Sum(smallvec![(definition, Rational::ONE)]));
            }
        }
        self.tidy();
    }

    fn rebuild(&mut self, first: &[(Net, SymbolId)]) {
        let mut tidied = Self::with_capacity(self.operations.len());
        let mut images: Vec<Option<Net>> = vec![None; self.operations.len()];
        // Operands may lie behind their users here, so that this is a depth-first walk with a stack of its own.
        let mut stack: Vec<(Net, bool)> = self
            .outputs
            .iter()
            .rev()
            .map(|output| (*output, false))
            .collect();
        let uses = self.live_uses();
        for (net, symbol) in first {
            images[net.index()] = Some(tidied.push(Operation::Symbol(*symbol)));
        }
        while let Some((net, expanded)) = stack.pop() {
            if images[net.index()].is_some() {
                continue;
            }
            if !expanded {
                stack.push((net, true));
                let first = stack.len();
                self.each_operand(net, |operand| stack.push((operand, false)));
                stack[first..].reverse();
                continue;
            }
            let image = self.image(&mut tidied, net, &images, &uses);
            if let Some(name) = self.names.get(&net) {
                tidied.names.entry(image).or_insert_with(|| name.clone());
            }
            images[net.index()] = Some(image);
        }
        tidied.outputs = self
            .outputs
            .iter()
            .filter_map(|output| images[output.index()])
            .collect();
        *self = tidied.swept();
        self.tidy = true;
    }

    /// The same operations in the same order without those that no result needs: what was opened into its only user.
    fn swept(self) -> Self {
        let uses = self.live_uses_in_order();
        if uses.iter().all(|uses| *uses > 0) {
            return self;
        }
        let mut swept = Self::with_capacity(self.operations.len());
        let mut images: Vec<Net> = Vec::with_capacity(self.operations.len());
        for (operation, uses) in self.operations.into_iter().zip(&uses) {
            let net = Net(swept.operations.len() as u32);
            // Of one that is not needed it is never looked at: what is needed has no operand that is not.
            images.push(net);
            if *uses > 0 {
                // No two become one: equal operations were one before.
                let operation = operation.with_operands(|operand| images[operand.index()]);
                swept.index.insert(hash_of(&operation), net);
                swept.operations.push(operation);
            }
        }
        let image = |net: &Net| images[net.index()];
        let names = self.names.into_iter();
        let needed = names.filter(|(net, _)| uses[net.index()] > 0);
        swept.names = needed.map(|(net, name)| (image(&net), name)).collect();
        swept.outputs = self.outputs.iter().map(image).collect();
        swept
    }

    /// The inputs that the results need, in their order.
    fn live_symbols(&self) -> Vec<(Net, SymbolId)> {
        let uses = self.live_uses();
        let mut symbols: Vec<(Net, SymbolId)> = self
            .nets()
            .filter(|net| uses[net.index()] > 0)
            .filter_map(|net| match self.operation(net) {
                Operation::Symbol(symbol) => Some((net, *symbol)),
                _ => None,
            })
            .collect();
        symbols.sort_by_key(|(_, symbol)| *symbol);
        symbols
    }

    /// How often what the results need uses each operation; 0 for what they do not need.
    pub fn live_uses(&self) -> Vec<usize> {
        if self.tidy {
            return self.live_uses_in_order();
        }
        let mut uses = vec![0_usize; self.operations.len()];
        let mut stack = Vec::new();
        for output in &self.outputs {
            uses[output.index()] += 1;
            stack.push(*output);
        }
        let mut seen = vec![false; self.operations.len()];
        while let Some(net) = stack.pop() {
            if std::mem::replace(&mut seen[net.index()], true) {
                continue;
            }
            self.each_operand(net, |operand| {
                uses[operand.index()] += 1;
                stack.push(operand);
            });
        }
        uses
    }

    /// The same of a circuit whose operands come before their users.
    fn live_uses_in_order(&self) -> Vec<usize> {
        let mut uses = vec![0_usize; self.operations.len()];
        for output in &self.outputs {
            uses[output.index()] += 1;
        }
        for position in (0..self.operations.len()).rev() {
            if uses[position] > 0 {
                self.each_operand(Net(position as u32), |operand| uses[operand.index()] += 1);
            }
        }
        uses
    }

    fn image(&self, tidied: &mut Self, net: Net, images: &[Option<Net>], uses: &[usize]) -> Net {
        // Every operand has its image before its user is asked for.
        let image = |operand: &Net| images[operand.index()].unwrap_or(Net(0));
        match self.operation(net) {
            Operation::Sum(terms) => {
                let mut opened = Terms::new();
                for (operand, coefficient) in terms {
                    match tidied.operation(image(operand)) {
                        // A multiple that several sums share is an operation of its own, and its negative is free; a
                        // multiple of it is no more than another multiple of what it is of.
                        Operation::Sum(inner)
                            if inner.len() == 1
                                && (uses[operand.index()] == 1
                                    || terms.len() == 1 && !coefficient.is_unit()) =>
                        {
                            opened.push((inner[0].0, &inner[0].1 * coefficient));
                        }
                        _ => opened.push((image(operand), coefficient.clone())),
                    }
                }
                tidied.closed_sum(opened)
            }
            Operation::Product(factors) => {
                let mut opened = Factors::new();
                for (operand, power) in factors {
                    match tidied.operation(image(operand)) {
                        // A product that only this one uses, and once, is no operation of its own; of its powers it is.
                        Operation::Product(inner) if uses[operand.index()] == 1 && *power == 1 => {
                            opened.extend(
                                inner
                                    .iter()
                                    .map(|(factor, exponent)| (*factor, exponent * power)),
                            );
                        }
                        _ => opened.push((image(operand), *power)),
                    }
                }
                tidied.product(opened)
            }
            other => tidied.push(other.clone().with_operands(image)),
        }
    }

    /// What one operation costs, its operands not counted.
    pub fn cost_of(&self, net: Net) -> Cost {
        let mut cost = Cost::default();
        match self.operation(net) {
            Operation::Number(_) | Operation::Symbol(_) => {}
            Operation::Sum(terms) => {
                cost.add = terms.len().saturating_sub(1);
                let multiple = |(operand, coefficient): &&(Net, Rational)| {
                    !coefficient.is_unit() && self.as_number(*operand).is_none()
                };
                cost.mul = terms.iter().filter(multiple).count();
            }
            Operation::Product(factors) => {
                let power: u32 = factors.iter().map(|(_, power)| power).sum();
                cost.mul = (power as usize).saturating_sub(1);
            }
            Operation::Quotient(..) => cost.div = 1,
            Operation::Apply(Function::Sqrt, _) => cost.sqrt = 1,
            Operation::Apply(Function::Abs | Function::Sign, _) => {}
            // A zero is added, so that a negative one counts as zero.
            Operation::Apply(Function::Side, _) => cost.add = 1,
            Operation::Apply(Function::Min | Function::Max | Function::Select, _) => {
                cost.choice = 1;
            }
            Operation::Apply(Function::MulAdd, _) => {
                cost.add = 1;
                cost.mul = 1;
            }
            Operation::Apply(..) | Operation::Tabulated { .. } => cost.call = 1,
        }
        cost
    }

    /// What the operations that the results need cost together.
    pub fn cost(&self) -> Cost {
        let uses = self.live_uses();
        self.nets()
            .filter(|net| uses[net.index()] > 0)
            .fold(Cost::default(), |cost, net| cost + self.cost_of(net))
    }
}
