//! Conditions: comparisons of numbers, and what `&&`, `||` and `!` make of them.

use crate::graph::{ExprId, Function, Graph};

/// What an `if` decides by.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// `true` or `false`
    Known(bool),
    /// Whether two numbers compare as a choice of that function does.
    Comparison(Function, [ExprId; 2]),
    /// `!a`
    Not(Box<Condition>),
    /// `a && b && …`
    All(Vec<Condition>),
    /// `a || b || …`
    Any(Vec<Condition>),
}

impl Condition {
    /// The opposite.
    pub fn negated(self) -> Self {
        match self {
            Self::Known(value) => Self::Known(!value),
            Self::Not(inner) => *inner,
            other => Self::Not(Box::new(other)),
        }
    }

    /// `self && other`; a chain is one list, so that no walk of it is as deep as it is long.
    pub fn and(self, other: Self) -> Self {
        match self {
            Self::Known(true) => other,
            Self::Known(false) => self,
            first if other == Self::Known(true) => first,
            Self::All(mut conditions) => {
                conditions.push(other);
                Self::All(conditions)
            }
            first => Self::All(vec![first, other]),
        }
    }

    /// `self || other`
    pub fn or(self, other: Self) -> Self {
        match self {
            Self::Known(false) => other,
            Self::Known(true) => self,
            first if other == Self::Known(false) => first,
            Self::Any(mut conditions) => {
                conditions.push(other);
                Self::Any(conditions)
            }
            first => Self::Any(vec![first, other]),
        }
    }

    /// The first number where the condition holds, else the second: choices one after the other, so that what is not chosen
    /// has no part in the value, whatever it is.
    pub fn select(&self, graph: &mut Graph, first: ExprId, second: ExprId) -> ExprId {
        if first == second {
            return first;
        }
        match self {
            Self::Known(true) => first,
            Self::Known(false) => second,
            Self::Comparison(function, [a, b]) => {
                graph.apply(*function, [*a, *b, first, second].as_slice())
            }
            Self::Not(inner) => inner.select(graph, second, first),
            Self::All(conditions) => (conditions.iter().rev()).fold(first, |chosen, condition| {
                condition.select(graph, chosen, second)
            }),
            Self::Any(conditions) => (conditions.iter().rev()).fold(second, |chosen, condition| {
                condition.select(graph, first, chosen)
            }),
        }
    }
}
