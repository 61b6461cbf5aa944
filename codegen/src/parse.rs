//! Rust source to functions over a graph.
//!
//! [`module`] reads the items of a module and [`attributes`] what is asked of each function; [`body`] follows a
//! function's statements with symbols in place of numbers. All three report what they can't take at its own token and
//! go on. [`linking`] reads modules that link each other, [`names`] finds what a path in one of them stands for.
//! [`tabulated`] says what a reader asks of whoever makes the tables of approximated functions.

pub mod attributes;
pub mod body;
pub mod condition;
mod cycles;
mod impls;
pub mod imports;
pub(crate) mod known_methods;
pub mod linking;
pub mod literal;
pub mod module;
pub mod names;
pub(crate) mod numbers;
pub mod place;
mod settings;
pub mod shape;
mod signature;
mod specialise;
pub mod tabulated;
pub mod value;
pub(crate) mod whole;
