//! Ends of a region that growth rates do not show.

use thiserror::Error;

use crate::region::RegionKind;

/// Why growth rates do not show the ends of an instability region.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BoundaryError {
    /// The region that was expected has no width.
    #[error("the region is closed, its expected width is 0")]
    Closed,
    /// The width to search with is not positive.
    #[error("the region is closed, its approximate width is {width}")]
    NoWidth {
        /// The approximate width.
        width: f64,
    },
    /// Nothing grows fast enough in the middle of the region that was expected.
    #[error("the region is too narrow to tell, its growth rate is below {limit:.0e}")]
    TooNarrow {
        /// Slower growth does not tell a width.
        limit: f64,
    },
    /// Another region begins where the one that was expected ends.
    #[error("another region adjoins at {speed:.6}, growth rates do not tell the two apart")]
    Adjoined {
        /// The end that was expected.
        speed: f64,
    },
    /// Nothing grows near to where the region should start.
    #[error("within a width of the region's start no growth rate is above {limit:.0e}")]
    NoGrowth {
        /// Slower growth does not tell a width.
        limit: f64,
    },
    /// It grows as far as was looked.
    #[error("the motion grows at every speed on one side, there is no end")]
    Endless,
    /// The growth rates are not those of the region that was expected.
    #[error("at {speed} the growth rate is {growth:.3e}, and {expected:.3e} was expected")]
    Contradiction {
        /// Where.
        speed: f64,
        /// The growth rate.
        growth: f64,
        /// The one that was expected.
        expected: f64,
    },
    /// The region would start where the motion is unstable at every speed.
    #[error("its start lies where every speed from {lower:.6} × ω_st upwards is unstable")]
    AllUnstable {
        /// From here on every speed is unstable, in units of the reference speed.
        lower: f64,
    },
    /// The region starts inside another one.
    #[error("its start lies inside the {}, growth rates do not tell the two apart", .kind.description())]
    StartsInside {
        /// The other region.
        kind: RegionKind,
    },
    /// Growth goes on from the region into another one.
    #[error("growth goes on from its start into the {}", .kind.description())]
    LeadsInto {
        /// The other region.
        kind: RegionKind,
    },
}
