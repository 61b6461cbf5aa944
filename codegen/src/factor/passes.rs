//! The passes of which a circuit is the outcome, and what each of them gives.

use super::extract::Step;

/// A pass that can be left out, to measure what it gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Forms over the products that the author named, each held as a symbol.
    Held,
    /// Expressions that have equal values become one.
    Identities,
    /// Gradients in the forward mode beside those in the reverse mode.
    Forward,
    /// Values rebuilt from their partials by Euler's relation.
    Homogeneous,
    /// √(a/b) as √(ab)/|b|.
    RootsOfQuotients,
    /// Factors that all terms of a sum have, taken out.
    CommonFactors,
    /// √a·√b as √(ab).
    JoinedRoots,
    /// Exponentials as powers of one, and products of them as one of a sum.
    Exponentials,
    /// A step of extraction.
    Step(Step),
    /// Operations with equal values become one.
    Repeats,
    /// a·(1/b) as a/b where nothing else needs 1/b.
    LoneDivisors,
    /// Multiples that several operations have are computed once.
    SharedMultiples,
    /// a/(b·c) as (a/b)/c where a/b is computed.
    Quotients,
}

/// The passes that run: all of them, or all but one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Passes {
    left_out: Option<Pass>,
}

impl Passes {
    /// All passes.
    pub const ALL: Self = Self { left_out: None };

    /// All passes but one.
    pub fn without(pass: Pass) -> Self {
        Self {
            left_out: Some(pass),
        }
    }

    /// Whether the pass runs.
    pub fn has(self, pass: Pass) -> bool {
        self.left_out != Some(pass)
    }
}
