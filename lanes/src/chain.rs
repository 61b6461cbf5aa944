//! How the kernels of a generated chain are reached: a formula is chosen while the program runs, and its kernel is a type.

use crate::Kernel;

/// Does something with the kernel of a formula, whichever it is.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// With the body of its rows, of whose results those of `WANTED` are its own; others are passed on as they are taken.
    fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> Self::Output
    where
        K: Kernel<0, ALONG, RESULTS>;
}

/// Does something with the kernels of a staged form, whichever it is.
pub trait StagedVisitor {
    /// What comes of it.
    type Output;

    /// With what is done for every value of what runs along, with what is done at every point, and with what the columns that
    /// stand still give once. That is none where their numbers are not as many as they have to be.
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
