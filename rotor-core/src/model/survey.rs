//! Every instability region of a rotor three ways: closed form, exact ends, Hill's method.

#[cfg(test)]
mod tests;

use crate::equations::Coefficients;
use crate::error::{BoundaryError, Error, RegionError};
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::region::{Region, RegionKind};
use crate::periodic::boundary::{self, Boundary};

use super::{Model, confirm_ends};

/// The relative difference between Hill's and the exact width above which they disagree, where rounding
/// alone moves the width of a narrow region by less.
const AGREEMENT: f64 = 1e-6;
/// Speeds at which the motion between two ends is looked at, and how near to the ends between them, over these.
const BETWEEN: u32 = 64;
const BESIDE: f64 = 1e-6;

/// The instability regions of a rotor, and from which speed on it is unstable at every speed.
///
/// ```
/// use rotor_core::jeffcott::rotor::Rotor;
/// use rotor_core::model::Survey;
///
/// let survey = Survey::of(&Rotor::paper().coefficients()?);
/// for (kind, region) in &survey.regions {
///     let region = region.as_ref().map_err(Clone::clone)?;
///     println!("{kind}: {:?}, exactly {:?}", region.width, region.exact);
///     assert!(region.agrees());
/// }
/// assert_eq!(survey.unstable_from, None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Survey {
    /// Each kind of region, found or with the reason why there is none. The upper simple region is left out where there is
    /// none: few rotors have it.
    pub regions: Vec<(RegionKind, Result<SurveyedRegion, RegionError>)>,
    /// The speed from which on the motion is unstable at every speed, in units of the reference speed.
    pub unstable_from: Option<f64>,
}

impl Survey {
    /// Finds the regions of a rotor with these coefficients.
    #[must_use]
    pub fn of(c: &Coefficients) -> Self {
        let mut regions: Vec<_> = RegionKind::ALL
            .into_iter()
            .map(|kind| (kind, Region::of(kind, c)))
            .filter(|(kind, region)| *kind != RegionKind::UpperSimple || region.is_ok())
            .map(|(kind, region)| (kind, region.map(SurveyedRegion::without_hill)))
            .collect();
        let known: Vec<(RegionKind, Ends)> = regions
            .iter()
            .filter_map(|(kind, region)| Some((*kind, *region.as_ref().ok()?.exact.as_ref().ok()?)))
            .collect();
        let unstable_from = unstable_from(c, &known);
        for (_, region) in &mut regions {
            if let Ok(region) = region {
                region.hill = hill_ends(c, region, &known, unstable_from);
            }
        }
        Self {
            regions,
            unstable_from,
        }
    }
}

/// An instability region three ways, in units of the reference speed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SurveyedRegion {
    /// Where it starts, Eqs. (15), (16).
    pub start: f64,
    /// Its approximate width, Eq. (31), or why there is none.
    pub width: Result<f64, RegionError>,
    /// Its exact ends, or why there are none.
    pub exact: Result<Ends, Error>,
    /// Its ends by Hill's method, or why growth rates do not show them.
    pub hill: Result<Boundary, Error>,
}

impl SurveyedRegion {
    fn without_hill(region: Region) -> Self {
        Self {
            start: region.start(),
            width: region.width(),
            exact: region.exact_ends(),
            hill: Err(BoundaryError::Closed.into()),
        }
    }

    /// Relative difference of the approximate width to the exact one; none where a width is missing or zero.
    #[must_use]
    pub fn approximation_difference(&self) -> Option<f64> {
        relative(
            *self.width.as_ref().ok()?,
            self.exact.as_ref().ok()?.width(),
        )
    }

    /// Relative difference of Hill's width to the exact one; none where a width is missing or zero.
    #[must_use]
    pub fn hill_difference(&self) -> Option<f64> {
        relative(
            self.hill.as_ref().ok()?.width(),
            self.exact.as_ref().ok()?.width(),
        )
    }

    /// Whether Hill's method and the exact ends agree, as far as Hill's method tells.
    #[must_use]
    pub fn agrees(&self) -> bool {
        match &self.hill {
            Ok(hill) => self
                .hill_difference()
                .is_none_or(|difference| difference.abs() <= AGREEMENT.max(hill.rounding)),
            Err(why) => !boundary::is_contradiction(why),
        }
    }
}

fn relative(value: f64, reference: f64) -> Option<f64> {
    (reference > 0.0).then(|| value / reference - 1.0)
}

/// The speed from which on every speed is unstable. Where |Δ_d| > |β − 1| the last end of the simple regions has no
/// partner; other regions, of which the ends are `known`, may lie inside that one or lead into it.
fn unstable_from(c: &Coefficients, known: &[(RegionKind, Ends)]) -> Option<f64> {
    let simple = exact::simple_region_ends(c).ok()?;
    let (last, others) = simple.split_last()?;
    if simple.len() % 2 == 0 {
        return None;
    }
    let known = known.iter().flat_map(|(_, ends)| [ends.lower, ends.upper]);
    let below: Vec<f64> = others
        .iter()
        .copied()
        .chain(known)
        .filter(|end| end < last)
        .collect();
    let all_grow_from = |lower: f64| {
        let part = |index: u32| (f64::from(index) + 0.5) / f64::from(BETWEEN);
        let grid = (0..BETWEEN).map(|index| lower + part(index) * (last - lower));
        let inner = below.iter().chain([last]).filter(|&&end| end > lower);
        let beside = inner.flat_map(|end| [end * (1.0 - BESIDE), end * (1.0 + BESIDE)]);
        grid.chain(beside)
            .all(|speed| exact::growth_rate(c, speed).is_ok_and(|rate| rate > 0.0))
    };
    let lower = below.iter().copied().filter(|&end| all_grow_from(end));
    Some(lower.fold(*last, f64::min))
}

/// A region's ends by Hill's method, near the exact ones or, where there are none, about its start. The growth rate says
/// that the motion grows, not in which region: ends that are not known must lie apart from the `known` regions.
fn hill_ends(
    c: &Coefficients,
    region: &SurveyedRegion,
    known: &[(RegionKind, Ends)],
    unstable_from: Option<f64>,
) -> Result<Boundary, Error> {
    if let Ok(exact) = region.exact {
        return confirm_ends(c, exact);
    }
    if let Some(lower) = unstable_from.filter(|lower| *lower <= region.start) {
        return Err(BoundaryError::AllUnstable { lower }.into());
    }
    let mut around = known.iter();
    if let Some((kind, _)) =
        around.find(|(_, ends)| (ends.lower..=ends.upper).contains(&region.start))
    {
        return Err(BoundaryError::StartsInside { kind: *kind }.into());
    }
    let found = boundary::search(|speed| c.growth_rate(speed), region.start, region.width?)?;
    let overlaps = |ends: &Ends| ends.lower <= found.upper && found.lower <= ends.upper;
    match known.iter().find(|(_, ends)| overlaps(ends)) {
        Some((kind, _)) => Err(BoundaryError::LeadsInto { kind: *kind }.into()),
        None => Ok(found),
    }
}
