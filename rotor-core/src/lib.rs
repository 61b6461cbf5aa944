//! Parametric instability of a rotor with an asymmetric disk and a transverse shaft crack.
//!
//! A Jeffcott rotor whose disk has two unequal diametral inertias and whose shaft has an open crack
//! is excited twice a turn. At some speeds it then whirls without bound, though nothing is out of
//! balance. This crate computes at which speeds, how far around them, how fast, and which disk
//! asymmetry, crack angle, depth and position cancel each other.
//!
//! | module | what |
//! |---|---|
//! | [`input`] | the one table of inputs, in SI units, with what each allows |
//! | [`equations`] | every closed form of the paper, each written once |
//! | [`jeffcott`] | the paper's rotor: [`rotor`](jeffcott::rotor) validated once, its [`region`](jeffcott::region)s, the [`zup`](jeffcott::zup) at which they close, and their [`exact`](jeffcott::exact) ends and growth rates |
//! | [`periodic`] | any linear periodic system: Hill's determinant and the monodromy matrix |
//! | [`model`] | what makes a periodic system of a rotor |
//! | [`quantity`] | every result by its name |
//! | [`study`] | quantities over grids, samples and tables of rotors |
//! | [`warning`], [`reason`] | what is odd about a rotor, and why a result is missing, in words |
//! | `file` | rotors from TOML files; with the feature `toml` |
//! | [`corrections`] | E1 to E13: what differs from the printed text, and why |
//!
//! ```
//! use rotor_core::quantity::Quantity;
//! use rotor_core::jeffcott::rotor::Rotor;
//! use rotor_core::input::RotorParameters;
//!
//! let rotor = Rotor::new(RotorParameters { crack_depth_ratio: 0.1, ..RotorParameters::PAPER })?;
//! let width = Quantity::SirWidth.evaluate(&rotor)?;
//! assert!(width > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! | feature | what |
//! |---|---|
//! | `rayon` (default) | scans run on all cores; without it on the calling thread |
//! | `serde` | `Serialize` and `Deserialize` for rotors, their inputs, coefficients and ends |
//! | `toml` | the module `file` |
//!
//! Without features the crate needs no threads and no files and builds for `wasm32-unknown-unknown`.
#[doc = include_str!("corrections.md")]
pub mod corrections {}
mod batch;
pub mod equations;
pub mod error;
#[cfg(feature = "toml")]
pub mod file;
pub mod input;
pub mod jeffcott;
pub mod model;
pub mod periodic;
pub mod quantity;
pub mod reason;
pub mod study;
pub mod text;
pub mod unit;
pub mod warning;

/// What is shared between threads: this does not compile where one of these types cannot be.
const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<jeffcott::rotor::Rotor>();
    is_shared::<equations::Coefficients>();
    is_shared::<periodic::PeriodicSystem>();
    is_shared::<study::Plan>();
};

/// The examples of README.md, compiled and run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
