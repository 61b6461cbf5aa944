//! Why a result is missing, in words that fit beside the results that are not.

use crate::equations::Coefficients;
use crate::error::StabilityError;
use crate::jeffcott::region::{self, NoEnds, NoRegion, RegionKind};
use crate::periodic::boundary::NoBoundary;
use crate::study::Reason;

/// Why a quantity is missing.
#[must_use]
pub fn of_quantity(reason: &Reason) -> String {
    match reason {
        Reason::Stability(error) => of_ends(error),
        other => other.to_string(),
    }
}

/// Why a region has no exact ends.
#[must_use]
pub fn of_exact_ends(reason: &NoEnds) -> String {
    match reason {
        NoEnds::Stability(error) => of_ends(error),
        NoEnds::Region(reason) => reason.to_string(),
    }
}

/// Why growth rates do not show the ends of a rotor's region, of which the exact ends or the approximate width is known.
#[must_use]
pub fn of_boundary(reason: &NoBoundary) -> String {
    match reason {
        NoBoundary::Closed => "the region is closed, its exact width is 0".to_owned(),
        NoBoundary::NoWidth { .. } => "the region is closed, its width by Eq. (31) is 0".to_owned(),
        NoBoundary::Adjoined { speed } => format!(
            "another region adjoins at {speed:.6} × ω_st, growth rates do not tell the two apart"
        ),
        NoBoundary::Contradiction {
            speed,
            growth,
            expected,
        } => format!(
            "at {speed} × ω_st its growth rate is {growth:.3e} and the exact one {expected:.3e}"
        ),
        other => other.to_string(),
    }
}

/// The start and the approximate width may well be there, so that it must not read as if the region were not.
fn of_ends(error: &StabilityError) -> String {
    match error {
        StabilityError::NoRegion { kind, reason } => {
            format!("no exact ends of the {kind} instability region were found: {reason}")
        }
        other => other.to_string(),
    }
}

/// What is wrong with a rotor whose numbers do not fit in double precision: a start of 0 is an underflow, no start.
#[must_use]
pub fn out_of_range(kind: RegionKind, c: &Coefficients) -> Option<String> {
    match (region::start(kind, c), region::width(kind, c)) {
        (Ok(0.0), _) => Some(format!(
            "the start of the {} comes out as 0: the inputs are each allowed, but together they leave the range of \
             double precision; it must be > 0",
            kind.description()
        )),
        (Err(why @ NoRegion::NotFinite { .. }), _) | (_, Err(why @ NoRegion::NotFinite { .. })) => {
            Some(why.to_string())
        }
        _ => None,
    }
}
