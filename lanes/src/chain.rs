//! How the kernels of a generated chain are reached: a formula is chosen while the program runs, and its kernel is a type.

use crate::Kernel;

/// A generic function of a formula's kernel.
pub trait Visitor {
    /// What the function returns.
    type Output;

    /// Visits the body of a formula's rows. The results of `WANTED` are computed; others are inputs that are passed on.
    fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> Self::Output
    where
        K: Kernel<0, ALONG, RESULTS>;
}

/// A generic function of a staged form's kernels.
pub trait StagedVisitor {
    /// What the function returns.
    type Output;

    /// Visits the bodies `A`, which runs once for every value of what varies along the points, and `P`, which runs at every point;
    /// `fixed` computes once what the other columns decide, and gives none where it gets another count of numbers.
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
