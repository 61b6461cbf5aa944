//! What can go wrong, in one type for the whole crate.
//!
//! [`enum@Error`] says of what kind a failure is; each kind has a type of its own with the numbers that its message names, so that a
//! program can tell them apart. Messages name the quantity, its value and what is allowed.
//!
//! ```
//! use rotor_core::error::{Error, RegionError};
//! use rotor_core::jeffcott::{region::RegionKind, rotor::Rotor};
//!
//! let disk = Rotor::paper().with(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia)?;
//! match disk.region(RegionKind::Combination) {
//!     Err(Error::Region(RegionError::InertiaRatio { beta, limit, .. })) => assert_eq!((beta, limit), (2.0, 2.0)),
//!     other => panic!("{other:?}"),
//! }
//! # Ok::<(), Error>(())
//! ```

mod boundary;
mod input;
mod region;
mod study;
mod system;

pub use boundary::BoundaryError;
pub use input::InputError;
pub use region::RegionError;
pub use study::StudyError;
pub use system::SystemError;

pub(crate) use system::require;

/// Why something could not be answered.
#[derive(Clone, Debug, thiserror::Error, PartialEq)]
#[error(transparent)]
#[non_exhaustive]
pub enum Error {
    /// The inputs describe no rotor, or one whose numbers leave the range of double precision.
    Input(#[from] InputError),
    /// The rotor has no such instability region, or the region no such quantity.
    Region(#[from] RegionError),
    /// A periodic system or its characteristic equation could not be solved.
    System(#[from] SystemError),
    /// Growth rates do not show the ends of an instability region.
    Boundary(#[from] BoundaryError),
    /// A scan, a reduction or a table of rotors is not possible, or stopped early.
    Study(#[from] StudyError),
}

/// Errors travel between threads, and stay small enough to be returned by value.
const _: () = {
    const fn is_shared<T: Send + Sync + 'static>() {}
    is_shared::<Error>();
    assert!(size_of::<Error>() <= 96);
};
