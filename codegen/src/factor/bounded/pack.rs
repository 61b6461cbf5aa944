//! Numbers with bounds at several points at once.

use smallvec::SmallVec;

use super::Bounded;
use crate::graph::{Function, NamedConstant, Rational, Table};
use crate::interpret::Number;
use crate::interpret::double_double::stand_in;

/// How many points there are: enough that finding an operation and its operands is a small part of what it takes.
const LANES: usize = 8;

/// A number at several points; what is done to it is done to each.
#[derive(Clone, Copy, Debug)]
pub struct Pack {
    value: [f64; LANES],
    error: [f64; LANES],
}

impl Pack {
    /// How many points there are.
    pub const LANES: usize = LANES;

    /// Of each point a number.
    #[inline(always)]
    pub fn of(number: impl Fn(usize) -> Bounded) -> Self {
        let mut pack = Self {
            value: [0.0; LANES],
            error: [0.0; LANES],
        };
        for lane in 0..LANES {
            let Bounded { value, error } = number(lane);
            pack.value[lane] = value;
            pack.error[lane] = error;
        }
        pack
    }

    /// The number at one of the points.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Bounded {
        Bounded {
            value: self.value[lane],
            error: self.error[lane],
        }
    }

    /// What an operation makes of two numbers.
    #[inline(always)]
    fn of_two(self, other: Self, operation: impl Fn(&Bounded, &Bounded) -> Bounded) -> Self {
        Self::of(|lane| operation(&self.lane(lane), &other.lane(lane)))
    }
}

impl Number for Pack {
    fn rational(value: &Rational) -> Self {
        let number = Bounded::rational(value);
        Self::of(|_| number)
    }

    fn constant(constant: NamedConstant) -> Self {
        let number = Bounded::constant(constant);
        Self::of(|_| number)
    }

    fn add(&self, other: &Self) -> Self {
        self.of_two(*other, Bounded::add)
    }

    fn multiply(&self, other: &Self) -> Self {
        self.of_two(*other, Bounded::multiply)
    }

    fn divide(&self, other: &Self) -> Self {
        self.of_two(*other, Bounded::divide)
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        Self::of(|lane| {
            let operands = operands.iter().map(|operand| operand.lane(lane));
            let operands: SmallVec<[Bounded; 4]> = operands.collect();
            Bounded::apply(function, &operands)
        })
    }

    fn tabulated(table: &Table, order: usize, argument: &Self) -> Self {
        stand_in(table, order, argument)
    }
}
