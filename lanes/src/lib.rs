//! The SIMD layer under generated code: one generic body per formula, run at the widest level that the machine has.
//!
//! A generated kernel is a [`Kernel`]: straight-line arithmetic over a [`Pack`] of rows, with no loop, no memory and no
//! level in it. The loops are here: [`store`] writes results to columns, [`once`] is for one row,
//! [`fold`] consumes results where they arise, so that a reduction needs no output array.
//!
//! **Invariants**
//! - A result has the same bits on every [`Level`], in a full pack and in the tail of a column: a body is additions,
//!   multiplications, divisions and roots in the order in which they are written, nothing of it is contracted to a fused
//!   multiplication, and sines and cosines are this crate's own ([`Pack::sin`], [`Pack::cos`]). Within
//!   [`Pack::sqrt_by_multiplication`] multiplications are fused, and what it gives is rounded as any other root.
//! - The instructions are those of the crate `fearless_simd`, whose tokens prove that the machine has them. There is no `unsafe`.

extern crate self as lanes;

pub mod chain;
mod kernel;
mod level;
mod pack;
mod pieces;
mod root;
mod trigonometry;

pub use fearless_simd::Simd;
pub use kernel::{
    ALL, ColumnLengthError, Consumer, Kernel, LONGEST, LengthError, fold, once, rows, store,
};
pub use level::{Level, UnknownLevel};
pub use pack::Pack;
pub use pieces::{MOST_PIECES, Pieces};
pub use trigonometry::{EXACT_BEYOND, cos, sin};
