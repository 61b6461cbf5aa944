//! What an expression of the source stands for while a function's body is followed.

use super::condition::Condition;
use super::shape::Fields;
use crate::graph::{ExprId, Rational, Role};

/// A number, or numbers under the names and places that the source gives them.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// One number.
    Number(ExprId),
    /// One number that terms are added to by `+=` and `-=`, until it is read: then it is their sum. Only variables hold it.
    Sum(Vec<(ExprId, Rational)>),
    /// A whole number, which is known: an index, an exponent, a bound of a loop.
    Whole(i64),
    /// What an `if` decides by.
    Truth(Condition),
    /// `(a, b)`; that of no values is what a statement gives.
    Tuple(Vec<Value>),
    /// `[a, b]`
    Array(Vec<Value>),
    /// What an iterator gives, one after the other.
    Iterator(Vec<Value>),
    /// `Name { field: a }`
    Struct {
        /// Path of the struct as written.
        name: String,
        /// The fields in the order of the literal.
        fields: Vec<(String, Value)>,
    },
    /// A parameter of a struct type: each field is a symbol `path.field`.
    Parameter {
        /// The parameter's name.
        path: String,
        /// The name of its type.
        of: String,
        /// What its symbols stand for.
        role: Role,
        /// Its fields, where the struct is known.
        fields: Option<Fields>,
        /// Fields that have another value: `S { field: a, ..path }`.
        replaced: Vec<(String, Value)>,
    },
}

impl Value {
    /// What the value is, for messages.
    pub fn description(&self) -> &'static str {
        match self {
            Self::Number(_) | Self::Sum(_) => "a number",
            Self::Whole(_) => "a whole number",
            Self::Truth(_) => "a condition",
            Self::Tuple(values) if values.is_empty() => "no value",
            Self::Tuple(_) => "a tuple",
            Self::Array(_) => "an array",
            Self::Iterator(_) => "an iterator",
            Self::Struct { .. } => "a struct",
            Self::Parameter { .. } => "a parameter of a struct type",
        }
    }

    /// How to get a number from the value, for hints.
    pub fn way_to_a_number(&self) -> &'static str {
        match self {
            Self::Number(_) | Self::Sum(_) => "it is used by its name alone",
            Self::Whole(_) => "make a number of it: `2.0`, or `i as f64`",
            Self::Truth(_) => "choose by it: `if … { a } else { b }`",
            Self::Tuple(values) if values.is_empty() => "end the block with an expression",
            Self::Tuple(_) => "take a part of it: `.0`",
            Self::Array(_) => "take an element of it: `[0]`",
            Self::Iterator(_) => "add up what it gives: `.sum::<f64>()`",
            Self::Struct { .. } | Self::Parameter { .. } => "take a field of it: `.name`",
        }
    }

    /// The fields that the value has, for hints.
    pub fn known_fields(&self) -> String {
        match self {
            Self::Tuple(values) => {
                let places: Vec<String> = (0..values.len())
                    .map(|place| format!("`.{place}`"))
                    .collect();
                format!("its parts are {}", places.join(", "))
            }
            Self::Struct { fields, .. } => {
                let names: Vec<String> =
                    fields.iter().map(|(name, _)| format!("`{name}`")).collect();
                format!("its fields are {}", names.join(", "))
            }
            Self::Parameter {
                fields: Some(fields),
                ..
            } => {
                let names: Vec<String> =
                    fields.iter().map(|(name, _)| format!("`{name}`")).collect();
                format!("its fields are {}", names.join(", "))
            }
            other => other.way_to_a_number().to_owned(),
        }
    }

    /// What a statement gives.
    pub fn nothing() -> Self {
        Self::Tuple(Vec::new())
    }

    /// Whether it is what a statement gives.
    pub fn is_nothing(&self) -> bool {
        *self == Self::nothing()
    }

    /// All numbers in order, with the way to each: `` for a number, `.0`, `[1]`, `.field`.
    pub fn numbers(&self) -> Vec<(String, ExprId)> {
        let prefixed = |prefix: String, value: &Value| -> Vec<(String, ExprId)> {
            value
                .numbers()
                .into_iter()
                .map(|(path, id)| (format!("{prefix}{path}"), id))
                .collect()
        };
        match self {
            Self::Number(id) => vec![(String::new(), *id)],
            Self::Tuple(values) => values
                .iter()
                .enumerate()
                .flat_map(|(i, value)| prefixed(format!(".{i}"), value))
                .collect(),
            Self::Array(values) => values
                .iter()
                .enumerate()
                .flat_map(|(i, value)| prefixed(format!("[{i}]"), value))
                .collect(),
            Self::Struct { fields, .. } => fields
                .iter()
                .flat_map(|(name, value)| prefixed(format!(".{name}"), value))
                .collect(),
            Self::Sum(_)
            | Self::Whole(_)
            | Self::Truth(_)
            | Self::Iterator(_)
            | Self::Parameter { .. } => Vec::new(),
        }
    }

    /// The parameter of a struct type that the value is or holds as a whole, which no literal gives the fields of.
    pub fn whole_parameter(&self) -> Option<&str> {
        match self {
            Self::Number(_) | Self::Sum(_) | Self::Whole(_) | Self::Truth(_) => None,
            Self::Tuple(values) | Self::Array(values) | Self::Iterator(values) => {
                values.iter().find_map(Self::whole_parameter)
            }
            Self::Struct { fields, .. } => {
                fields.iter().find_map(|(_, value)| value.whole_parameter())
            }
            Self::Parameter { path, .. } => Some(path),
        }
    }

    /// A value of this shape with other numbers, taken in order.
    pub fn with_numbers(&self, numbers: &mut impl Iterator<Item = ExprId>) -> Self {
        match self {
            Self::Number(old) => Self::Number(numbers.next().unwrap_or(*old)),
            Self::Tuple(values) => Self::Tuple(
                values
                    .iter()
                    .map(|value| value.with_numbers(numbers))
                    .collect(),
            ),
            Self::Array(values) => Self::Array(
                values
                    .iter()
                    .map(|value| value.with_numbers(numbers))
                    .collect(),
            ),
            Self::Struct { name, fields } => Self::Struct {
                name: name.clone(),
                fields: fields
                    .iter()
                    .map(|(field, value)| (field.clone(), value.with_numbers(numbers)))
                    .collect(),
            },
            Self::Sum(_)
            | Self::Whole(_)
            | Self::Truth(_)
            | Self::Iterator(_)
            | Self::Parameter { .. } => self.clone(),
        }
    }
}
