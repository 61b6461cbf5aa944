//! Parametric instability of a rotor with an asymmetric disk and a transverse shaft crack.
//!
//! A Jeffcott rotor whose disk has two unequal diametral inertias and whose shaft has an open crack
//! is excited twice a turn. At some speeds it then whirls without bound, though nothing is out of
//! balance. This crate computes at which speeds, how far around them, how fast, and which disk
//! asymmetry, crack angle, depth and position cancel each other.
//!
//! In the order in which a rotor passes:
//!
//! | module | what |
//! |---|---|
//! | [`rotor`] | the physical description in SI units, validated once |
//! | [`equations`] | every closed form of the paper, each written once |
//! | [`region`] | start, width, growth rate and exact ends of an unstable region |
//! | [`zero_unstable_point`] | the crack angle, depth and position that close a region |
//! | [`stability`] | the exact quartic, Hill's determinant and the monodromy matrix |
//! | [`quantity`] | every result by its name |
//! | [`scan`] | quantities over grids and samples of rotors |
//! | [`table`] | quantities of rotors that are given, a row each |
//! | [`corrections`] | E1 to E13: what differs from the printed text, and why |
//!
//! ```
//! use rotor_core::quantity::Quantity;
//! use rotor_core::rotor::{Rotor, RotorParameters};
//!
//! let rotor = Rotor::new(RotorParameters { crack_depth_ratio: 0.1, ..RotorParameters::PAPER })?;
//! let width = Quantity::SirWidth.evaluate(&rotor)?;
//! assert!(width > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#[doc = include_str!("corrections.md")]
pub mod corrections {}
pub mod equations;
mod extremes;
mod kernel;
pub mod quantity;
pub mod region;
mod roots;
pub mod rotor;
pub mod scan;
pub mod stability;
mod statistic;
pub mod table;
mod variable;
pub mod zero_unstable_point;

/// The examples of README.md, compiled and run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
