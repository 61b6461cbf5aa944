//! Why a result is missing, in words that fit beside the results that are not.

use crate::equations::Coefficients;
use crate::error::{BoundaryError, Error, RegionError};
use crate::jeffcott::region::{Region, RegionKind};

/// Why growth rates do not show the ends of a rotor's region, of which the exact ends or the approximate width is known.
#[must_use]
pub fn of_boundary(error: &Error) -> String {
    let Error::Boundary(reason) = error else {
        return error.to_string();
    };
    match reason {
        BoundaryError::Closed => "the region is closed, its exact width is 0".to_owned(),
        BoundaryError::NoWidth { .. } => {
            "the region is closed, its width by Eq. (31) is 0".to_owned()
        }
        BoundaryError::Adjoined { speed } => format!(
            "another region adjoins at {speed:.6} × ω_st, growth rates do not tell the two apart"
        ),
        BoundaryError::Contradiction {
            speed,
            growth,
            expected,
        } => format!(
            "at {speed} × ω_st its growth rate is {growth:.3e} and the exact one {expected:.3e}"
        ),
        other => other.to_string(),
    }
}

/// What is wrong with a rotor whose numbers do not fit in double precision: a start of 0 is an underflow, no start.
#[must_use]
pub fn out_of_range(kind: RegionKind, c: &Coefficients) -> Option<String> {
    let region = Region::of(kind, c);
    if region.is_ok_and(|region| region.start() == 0.0) {
        return Some(format!(
            "the start of the {} comes out as 0: the inputs are each allowed, but together they leave the range of \
             double precision; it must be > 0",
            kind.description()
        ));
    }
    match region.and_then(|region| region.width()) {
        Err(why @ RegionError::NotFinite { .. }) => Some(why.to_string()),
        _ => None,
    }
}
