//! Parametric instability of a rotor with an asymmetric disk and a transverse shaft crack.
//!
//! A Jeffcott rotor whose disk has two unequal diametral inertias and whose shaft has an open crack
//! is excited twice a turn. At some speeds it then whirls without bound, though nothing is out of
//! balance. This crate computes at which speeds, how far around them, how fast, and which disk
//! asymmetry, crack angle, depth and position cancel each other.
//!
//! ```
//! use rotor_core::jeffcott::region::RegionKind;
//! use rotor_core::jeffcott::rotor::Rotor;
//! use rotor_core::jeffcott::zup::zup_depth;
//!
//! // The rotor of the paper's Section 4, with another crack; every input is in SI units.
//! let rotor = Rotor::paper().with(|p| p.crack_depth_ratio = 0.1)?;
//! let region = rotor.region(RegionKind::Simple)?;
//! let rad_per_s = rotor.reference_speed()?;
//! println!("unstable over {:.3} rad/s about {:.1} rad/s", region.width()? * rad_per_s, region.start() * rad_per_s);
//! // The depth, over the shaft's radius, at which the crack cancels the disk's asymmetry.
//! let closing = zup_depth(&rotor, RegionKind::Simple)?;
//! assert_eq!(closing.len(), 1);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```
//!
//! | to … | see |
//! |---|---|
//! | describe a rotor | [`input`], the one table of inputs, and [`Rotor`](jeffcott::rotor::Rotor); `file` with the feature `toml` |
//! | ask for one region | [`Region`](jeffcott::region::Region), [`zup`](jeffcott::zup), [`exact`](jeffcott::exact) |
//! | see all regions, checked against each other | [`Survey`](model::Survey) |
//! | scan grids, samples and tables of rotors | [`study`], of any [`quantity`] |
//! | solve another periodic system | [`periodic`] (Hill's determinant, the monodromy matrix), [`model`] |
//! | use the paper's equations themselves | [`equations`], [`corrections`] (E1 to E13: what differs from the printed text, and why) |
//! | know what went wrong, or is odd | [`error`], [`reason`], [`warning`] |
//!
//! The equations are those of *Parametric instability of a Jeffcott rotor with rotationally asymmetric inertia and transverse
//! crack*, Nonlinear Dynamics (2013).
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
mod region;
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
