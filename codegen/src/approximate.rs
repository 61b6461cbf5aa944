//! Build-time numerics: costly functions of one variable become piecewise polynomials.
//!
//! A function such as a crack compliance is a nested integral. It is computed once, while the
//! crate that uses it is built, and what remains at run time is a table of polynomials:
//!
//! 1. [`quadrature`] evaluates an integral to a stated tolerance, or says why it cannot;
//! 2. [`piecewise`] fits polynomials to a function, and fails where the tolerance is not met;
//! 3. `emit` writes the fit as Rust.
//!
//! Nothing here knows where a function comes from: integrands and functions are closures.

mod chebyshev;
mod piece;
pub mod piecewise;
pub mod quadrature;
