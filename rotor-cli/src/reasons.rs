//! Why a result is missing, in words that fit beside the results that are not.

use rotor_core::equations::Coefficients;
use rotor_core::error::StabilityError;
use rotor_core::jeffcott::region::{self, NoEnds, NoRegion, RegionKind};
use rotor_core::quantity::Quantity;
use rotor_core::study::Reason;

/// Why a quantity is missing.
pub(crate) fn of_quantity(reason: &Reason) -> String {
    match reason {
        Reason::Stability(error) => of_ends(error),
        other => other.to_string(),
    }
}

/// Why a region has no exact ends.
pub(crate) fn of_exact_ends(reason: &NoEnds) -> String {
    match reason {
        NoEnds::Stability(error) => of_ends(error),
        NoEnds::Region(reason) => reason.to_string(),
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
pub(crate) fn out_of_range(kind: RegionKind, c: &Coefficients) -> Option<String> {
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

/// The region that a quantity belongs to.
pub(crate) fn region_of(quantity: Quantity) -> Option<RegionKind> {
    quantity.region()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_know_their_region() {
        assert_eq!(region_of(Quantity::SirStart), Some(RegionKind::Simple));
        assert_eq!(
            region_of(Quantity::CirExactUpper),
            Some(RegionKind::Combination)
        );
        assert_eq!(region_of(Quantity::Beta), None);
    }
}
