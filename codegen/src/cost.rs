//! Counts of operations.

use std::fmt;
use std::ops::{Add, AddAssign};

/// How many operations of each kind a piece of code does. Negations and absolute values are free: they are one bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions and subtractions.
    pub add: usize,
    /// Multiplications.
    pub mul: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Choices: the smaller or larger of two, and the one or the other by a comparison.
    pub choice: usize,
    /// Calls of all other functions, and tabulated functions.
    pub call: usize,
}

/// A count that a budget can limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Additions, subtractions and multiplications.
    Operations,
    /// Additions and subtractions.
    Add,
    /// Multiplications.
    Mul,
    /// Divisions.
    Div,
    /// Square roots.
    Sqrt,
    /// Choices.
    Choice,
    /// Calls.
    Call,
}

impl Measure {
    /// The names in a budget.
    pub const NAMES: [&'static str; 7] =
        ["operations", "add", "mul", "div", "sqrt", "choice", "call"];

    /// The count of that name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "operations" => Self::Operations,
            "add" => Self::Add,
            "mul" => Self::Mul,
            "div" => Self::Div,
            "sqrt" => Self::Sqrt,
            "choice" => Self::Choice,
            "call" => Self::Call,
            _ => return None,
        })
    }

    /// The name in a budget.
    pub fn name(self) -> &'static str {
        match self {
            Self::Operations => "operations",
            Self::Add => "add",
            Self::Mul => "mul",
            Self::Div => "div",
            Self::Sqrt => "sqrt",
            Self::Choice => "choice",
            Self::Call => "call",
        }
    }
}

impl Cost {
    /// Additions, subtractions and multiplications.
    pub fn operations(&self) -> usize {
        self.add + self.mul
    }

    /// One of the counts.
    pub fn measure(&self, measure: Measure) -> usize {
        match measure {
            Measure::Operations => self.operations(),
            Measure::Add => self.add,
            Measure::Mul => self.mul,
            Measure::Div => self.div,
            Measure::Sqrt => self.sqrt,
            Measure::Choice => self.choice,
            Measure::Call => self.call,
        }
    }

    /// What the operations take, in additions: divisions and roots occupy their port 8 and 10 times as long, a choice
    /// is a comparison and a selection, a call costs some 20.
    pub fn weight(&self) -> usize {
        self.add + self.mul + 8 * self.div + 10 * self.sqrt + 2 * self.choice + 20 * self.call
    }
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            add: self.add + other.add,
            mul: self.mul + other.mul,
            div: self.div + other.div,
            sqrt: self.sqrt + other.sqrt,
            choice: self.choice + other.choice,
            call: self.call + other.call,
        }
    }
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            add,
            mul,
            div,
            sqrt,
            choice,
            call,
        } = self;
        write!(f, "{add} add, {mul} mul, {div} div, {sqrt} sqrt")?;
        // Few formulas have any.
        if *choice > 0 {
            write!(f, ", {choice} choice")?;
        }
        write!(f, ", {call} call")
    }
}
