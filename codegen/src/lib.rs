//! Closed-form formulas in, specialised Rust out.

pub mod approximate;
pub mod cost;
pub mod diagnostics;
pub mod differentiate;
pub mod emit;
pub mod expand;
pub mod factor;
pub mod graph;
pub mod interpret;
pub mod parse;
pub mod rewrite;
pub mod show;
pub mod tables;

pub use expand::expand;
