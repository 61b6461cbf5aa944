//! Circuits without what no result needs, with operands before their users and equal operations made one.

use smallvec::smallvec;

use super::{Circuit, Factors, Net, Operation, Terms, hash_of};
use crate::graph::{Rational, SymbolId};

impl Circuit {
    /// Drops what no result needs, brings operands before their users, and makes equal operations one.
    pub fn tidy(&mut self) {
        if !self.tidy {
            self.rebuild(&[]);
        }
    }

    /// Tidies the circuit with the inputs first, in their author's order. Sums keep that order too: b − a − z with nearly
    /// equal a and b and a small z is not to become b − z − a.
    pub fn tidy_by_inputs(&mut self) {
        let symbols = self.live_symbols();
        self.rebuild(&symbols);
    }

    /// Puts the last outputs, one for each symbol, in the places of the symbols. False where a symbol's own definition needs it,
    /// as one may where equal expressions were made one: the circuit is of no use then.
    pub fn define(&mut self, symbols: &[SymbolId]) -> bool {
        let results = self.outputs.len().saturating_sub(symbols.len());
        let definitions = self.outputs.split_off(results);
        // Not by the index of hashes, of which an operation of the same hash may have taken the symbol's place.
        for net in self.nets() {
            let Operation::Symbol(symbol) = self.operation(net) else {
                continue;
            };
            let mut defined = symbols.iter().zip(&definitions);
            if let Some((_, definition)) = defined.find(|(known, _)| *known == symbol) {
                self.replace(net, Operation::Sum(smallvec![(*definition, Rational::ONE)]));
            }
        }
        let is_sound = !self.is_cyclic();
        if is_sound {
            self.tidy();
        }
        is_sound
    }

    /// Whether an operation that the results need is among its own operands, through however many others.
    fn is_cyclic(&self) -> bool {
        let (mut open, mut done) = (
            vec![false; self.operations.len()],
            vec![false; self.operations.len()],
        );
        let mut stack: Vec<(Net, bool)> = self.outputs.iter().map(|net| (*net, false)).collect();
        while let Some((net, expanded)) = stack.pop() {
            if expanded {
                (open[net.index()], done[net.index()]) = (false, true);
            } else if open[net.index()] {
                return true;
            } else if !done[net.index()] {
                open[net.index()] = true;
                stack.push((net, true));
                self.each_operand(net, |operand| stack.push((operand, false)));
            }
        }
        false
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

    /// Removes the operations that no result needs, such as those that were opened into their only user; the others keep
    /// their order.
    pub(super) fn swept(self) -> Self {
        let uses = self.live_uses_in_order();
        if uses.iter().all(|uses| *uses > 0) {
            return self;
        }
        let mut swept = Self::with_capacity(self.operations.len());
        let mut images: Vec<Net> = Vec::with_capacity(self.operations.len());
        for (operation, uses) in self.operations.into_iter().zip(&uses) {
            let net = Net(swept.operations.len() as u32);
            // The image of an operation that is not needed is never used: what is needed has only operands that are needed.
            images.push(net);
            if *uses > 0 {
                // Equal operations were made one before, so that none is found here.
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

    /// Counts the uses in one pass over a circuit whose operands come before their users.
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
                        // A multiple that several sums share stays an operation, and its negative is free. A multiple
                        // of a multiple is one multiple of the innermost operand.
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
                        // A product that is one factor of this one alone is opened into it; one that is raised to a
                        // power stays an operation.
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Graph, ratio};

    #[test]
    fn a_symbol_is_defined_also_where_an_operation_of_the_same_hash_came_after_it() {
        // The places of symbols are small numbers, and so are the parts of fractions: some of their hashes are equal.
        let mut graph = Graph::new();
        let symbols: Vec<SymbolId> = (0..64)
            .map(|number| graph.symbol_named(&format!("x{number}")))
            .collect();
        let fractions = (1..64).flat_map(|above| (1..64).map(move |below| ratio(above, below)));
        for symbol in symbols {
            let mut circuit = Circuit::default();
            let net = circuit.push(Operation::Symbol(symbol));
            let fractions: Vec<Net> = fractions.clone().map(|q| circuit.number(q)).collect();
            let definition = circuit.number(ratio(1, 2));
            circuit.outputs = vec![net, fractions[0], definition];
            assert!(circuit.define(&[symbol]));
            let is_symbol = |net: Net| matches!(circuit.operation(net), Operation::Symbol(_));
            assert!(!circuit.nets().any(is_symbol), "{symbol:?}");
        }
    }
}
