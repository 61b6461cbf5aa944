//! The two kinds of operations that pairs are looked for in: products and sums.

use super::Share;
use crate::circuit::{Circuit, Factors, Net, Operation, Terms};
use crate::graph::{Rational, rational};

/// Factors with powers; a pair is a product of two.
impl Share for u32 {
    type Members = Factors;
    type Pair = (Net, Net);

    fn members(operation: &Operation) -> Option<&Self::Members> {
        match operation {
            Operation::Product(factors) => Some(factors),
            _ => None,
        }
    }

    fn operation(mut members: Self::Members) -> Operation {
        rational::collect(&mut members);
        Operation::Product(members)
    }

    fn times(&self) -> usize {
        *self as usize
    }

    fn pairs(
        factors: &[(Net, Self)],
        positions: &[(usize, usize)],
    ) -> impl Iterator<Item = (Self::Pair, usize)> {
        positions.iter().map(|(i, j)| {
            let ((a, power_a), (b, power_b)) = (factors[*i], factors[*j]);
            ((a, b), power_a.min(power_b) as usize)
        })
    }

    fn squares((net, power): &(Net, Self)) -> Option<(Self::Pair, usize)> {
        (*power >= 2).then_some(((*net, *net), (power / 2) as usize))
    }

    fn shared(circuit: &mut Circuit, (a, b): &Self::Pair) -> (Net, [Net; 2]) {
        (circuit.product([(*a, 1), (*b, 1)]), [*a, *b])
    }

    fn take(factors: &mut Self::Members, (a, b): &Self::Pair, shared: Net) -> bool {
        let power_of = |net: &Net| {
            let factor = factors.iter().find(|(factor, _)| factor == net);
            factor.map_or(0, |(_, power)| *power)
        };
        let times = if a == b {
            power_of(a) / 2
        } else {
            power_of(a).min(power_of(b))
        };
        if times == 0 {
            return false;
        }
        for (factor, power) in factors.iter_mut() {
            // Twice where a is b.
            *power -= times * (Self::from(factor == a) + Self::from(factor == b));
        }
        factors.push((shared, times));
        rational::collect(factors);
        true
    }
}

/// Terms with coefficients; a pair is a sum of two, given by the ratio of the second's coefficient to the first's.
impl Share for Rational {
    type Members = Terms;
    type Pair = (Net, Net, Self);

    fn members(operation: &Operation) -> Option<&Self::Members> {
        match operation {
            Operation::Sum(terms) => Some(terms),
            _ => None,
        }
    }

    fn operation(mut members: Self::Members) -> Operation {
        rational::collect(&mut members);
        Operation::Sum(members)
    }

    fn times(&self) -> usize {
        1
    }

    fn pairs(
        terms: &[(Net, Self)],
        positions: &[(usize, usize)],
    ) -> impl Iterator<Item = (Self::Pair, usize)> {
        positions.iter().map(|(i, j)| {
            let ((a, first), (b, second)) = (&terms[*i], &terms[*j]);
            ((*a, *b, second / first), 1)
        })
    }

    fn squares(_: &(Net, Self)) -> Option<(Self::Pair, usize)> {
        None
    }

    fn shared(circuit: &mut Circuit, (a, b, ratio): &Self::Pair) -> (Net, [Net; 2]) {
        let terms = [(*a, Self::ONE), (*b, ratio.clone())];
        (circuit.sum(terms), [*a, *b])
    }

    fn take(terms: &mut Self::Members, (a, b, ratio): &Self::Pair, shared: Net) -> bool {
        let coefficient_of = |net: &Net| {
            let term = terms.iter().find(|(term, _)| term == net);
            term.map(|(_, coefficient)| coefficient.clone())
        };
        let (Some(first), Some(second)) = (coefficient_of(a), coefficient_of(b)) else {
            return false;
        };
        if second != &first * ratio {
            return false;
        }
        terms.retain(|(term, _)| *term != *a && *term != *b);
        // The shared sum may be a term of this one already.
        terms.push((shared, first));
        rational::collect(terms);
        true
    }
}
