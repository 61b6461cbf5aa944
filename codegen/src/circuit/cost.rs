//! What the operations of a circuit cost.

use super::{Circuit, Net, Operation};
use crate::cost::Cost;
use crate::graph::{Function, Rational};

impl Circuit {
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
            Operation::Apply(Function::Abs | Function::Sign | Function::SignBit, _) => {}
            // A zero is added, so that a negative one counts as zero.
            Operation::Apply(Function::Side, _) => cost.add = 1,
            Operation::Apply(function, _) if function.is_choice() => cost.choice = 1,
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
