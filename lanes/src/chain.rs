//! Runs a kernel that is chosen while the program runs.
//!
//! A kernel is a type, so that a program that finds a formula by its name cannot hold the kernel in a variable. Instead it
//! writes what it wants to do with any kernel as a [`Visitor`], and the code that knows the names calls the visitor with the
//! right type. The macro `rotor_macros::symbolic` generates such code for the formulas of a chain.
//!
//! ```
//! use lanes::chain::Visitor;
//! use lanes::{ALL, Kernel, Pack, Simd, once};
//!
//! struct Square;
//! struct Cube;
//!
//! impl Kernel<0, 1, 1> for Square {
//!     #[inline(always)]
//!     fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 1] {
//!         [x * x]
//!     }
//! }
//!
//! impl Kernel<0, 1, 1> for Cube {
//!     #[inline(always)]
//!     fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 1] {
//!         [x * x * x]
//!     }
//! }
//!
//! fn visit<V: Visitor>(name: &str, visitor: V) -> Option<V::Output> {
//!     match name {
//!         "square" => Some(visitor.rows::<Square, ALL, 1, 1>()),
//!         "cube" => Some(visitor.rows::<Cube, ALL, 1, 1>()),
//!         _ => None,
//!     }
//! }
//!
//! /// Evaluates a kernel with one number as all its inputs.
//! struct At(f64);
//!
//! impl Visitor for At {
//!     type Output = f64;
//!
//!     fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> f64
//!     where
//!         K: Kernel<0, ALONG, RESULTS>,
//!     {
//!         once::<K, 0, ALONG, RESULTS>(&[], &[self.0; ALONG])[0]
//!     }
//! }
//!
//! assert_eq!(visit("cube", At(3.0)), Some(27.0));
//! assert_eq!(visit("root", At(3.0)), None);
//! ```

use crate::Kernel;

/// Something to do with the kernel of a formula, whichever it is.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Does it with the kernel `K`, of whose results those in `WANTED` are to be computed, a bit each; the others are inputs
    /// that the kernel passes on.
    fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> Self::Output
    where
        K: Kernel<0, ALONG, RESULTS>;
}

/// Something to do with the kernels of a formula that is evaluated in stages.
pub trait StagedVisitor {
    /// What comes of it.
    type Output;

    /// Does it with the stages of a formula: `fixed` computes once what depends on the shared columns alone, and answers
    /// `None` where it is given another count of numbers than it takes; `A` runs once for every value of the column that
    /// varies along the points; `P` runs at every point.
    fn staged<
        A,
        P,
        const FIXED: usize,
        const ALONG: usize,
        const TABLES: usize,
        const RESULTS: usize,
    >(
        self,
        fixed: fn(&[f64]) -> Option<[f64; FIXED]>,
    ) -> Self::Output
    where
        A: Kernel<0, ALONG, TABLES>,
        P: Kernel<FIXED, TABLES, RESULTS>;
}
