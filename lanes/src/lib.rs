//! Runs a formula over columns of numbers with the widest SIMD instructions that the machine has.
//!
//! Write the formula once, as a [`Kernel`]: arithmetic over [`Pack`]s, each of which holds the numbers of several rows. Then
//! run it: [`store`] writes its results to columns, [`fold`] hands them to a reduction without storing them, and [`once`]
//! evaluates a single row. Which instructions are used, SSE2, AVX2 or AVX-512, is found when the program runs
//! ([`Level::best`]).
//!
//! ```
//! use lanes::{ALL, Kernel, Level, LengthError, Pack, Simd, store};
//!
//! /// Hypotenuse of a right triangle: no shared numbers, two inputs of each row, one result.
//! struct Hypotenuse;
//!
//! impl Kernel<0, 2, 1> for Hypotenuse {
//!     #[inline(always)]
//!     fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [a, b]: [Pack<S>; 2]) -> [Pack<S>; 1] {
//!         [(a * a + b * b).sqrt()]
//!     }
//! }
//!
//! let (a, b) = ([3.0, 5.0, 8.0], [4.0, 12.0, 15.0]);
//! let mut lengths = [0.0; 3];
//! store::<Hypotenuse, ALL, 0, 2, 1>(Level::best(), &[], [&a, &b], [&mut lengths])?;
//! assert_eq!(lengths, [5.0, 13.0, 17.0]);
//! # Ok::<(), LengthError>(())
//! ```
//!
//! Kernels are seldom written by hand: the macro `rotor_macros::symbolic` makes them from plain functions of `f64`, with
//! `#[generate(columns)]`.
//!
//! **A result has the same bits on every level**, in a full pack and in the last rows of a column. Additions,
//! multiplications, divisions and roots are done in the order in which they are written, and none is fused with another;
//! sines and cosines are this crate's own ([`Pack::sin`], [`Pack::cos`]). Within [`Pack::sqrt_by_multiplication`] some
//! multiplications are fused, but its result is rounded as every other root is.
//!
//! **There is no `unsafe` code.** The instructions are those of the crate `fearless_simd`, whose tokens prove that the
//! machine has them.

extern crate self as lanes;

pub mod chain;
mod fold;
mod group;
mod kernel;
mod level;
mod pack;
mod pieces;
mod root;
mod trigonometry;

pub use fearless_simd::Simd;
pub use fold::{Consumer, fold};
pub use group::{GROUP, Group, Groups, Kept};
pub use kernel::{ALL, ColumnLengthError, Kernel, LONGEST, LengthError, once, rows, store};
pub use level::{Level, UnknownLevel};
pub use pack::Pack;
pub use pieces::{MOST_PIECES, Pieces};
pub use trigonometry::{EXACT_BEYOND, cos, sin};
