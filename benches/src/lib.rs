//! Operation counts and times of the generated code, and what other tools need to be measured beside it.
//!
//! | module | what |
//! |---|---|
//! | [`corpus`] | thirty public formulas, counted here and by the others |
//! | [`python`] | formulas from Rust to Python, so that every tool reads the same text |
//! | [`export`] | what the Python side of `peers/` reads |
//! | [`inputs`] | the numbers that every tool computes from |
//! | [`mod@column`] | columns of numbers, each from a line of its own on |
//! | [`cases`] | what is timed, a function for each |

pub mod cases;
pub mod column;
pub mod corpus;
pub mod export;
pub mod inputs;
pub mod python;
