//! The passes that make a circuit, and what each of them gives.
//!
//! The gain of a pass is the weight of the operations (`Cost::weight`, in additions) of a formula with all passes, and without
//! this one. The formulas are those of the corpus of operation counts, and where no formula there needs a pass, small
//! ones made for it. A test holds the table to the generator; it fails where a pass gives nothing.
//!
//! | pass | formula and form | with | without |
//! |---|---|---|---|
//! | [`Pass::Held`] | `peng_robinson`, gradient | 105 | 112 |
//! | [`Pass::Identities`] | `disguised_one`, value | 0 | 5 |
//! | [`Pass::Forward`] | `circumradius`, gradient | 60 | 77 |
//! | [`Pass::Homogeneous`] | `determinant_4`, gradient | 123 | 127 |
//! | [`Pass::RootsOfQuotients`] | `inverse_roots`, gradient | 46 | 71 |
//! | [`Pass::CommonFactors`] | `reprojection_error`, gradient | 47 | 55 |
//! | [`Pass::JoinedRoots`] | `geometric_mean`, value | 12 | 22 |
//! | [`Pass::Exponentials`] | `powers_of_exponential`, value | 31 | 63 |
//! | [`Pass::Exponentials`] | `product_of_exponentials`, value | 21 | 41 |
//! | [`Step::Factors`] | `peng_robinson`, gradient | 105 | 106 |
//! | [`Step::SharedFactors`] | `polynomial_and_slope`, value | 14 | 16 |
//! | [`Step::Products`] | `lennard_jones`, gradient | 23 | 57 |
//! | [`Step::Sums`] | `circumradius`, gradient | 60 | 64 |
//! | [`Step::Multiples`] | `quaternion_rotation`, gradient | 84 | 87 |
//! | [`Step::Coefficients`] | `quaternion_rotation`, gradient | 84 | 90 |
//! | [`Step::Distribute`] | `quaternion_rotation`, gradient | 84 | 94 |
//! | [`Pass::Repeats`] | `quaternion_rotation`, gradient | 84 | 86 |
//! | [`Pass::LoneDivisors`] | `circumradius`, gradient | 60 | 65 |
//! | [`Pass::SharedMultiples`] | `peng_robinson`, gradient | 105 | 107 |
//! | [`Pass::Quotients`] | `circumradius`, gradient | 60 | 64 |
//! | [`Pass::Written`] | `size_and_cube`, value | 2 | 4 |
//!
//! [`Pass::Held`] matters most where an author names many products: the gradient of the rotor's two widths by its
//! dimensions takes 1852 with it and 2597 without.

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
    /// The author's own operations, where they are the fewest.
    Written,
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
