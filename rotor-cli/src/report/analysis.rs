//! Everything that a report states about one rotor, computed once.

use rotor_core::equations::{Coefficients, CrackCompliance};
use rotor_core::region::{self, RegionKind};
use rotor_core::stability::Ends;

use super::hill;
use crate::failure::Failure;
use crate::rotor_file::NamedRotor;

/// The relative difference between Hill's and the exact width above which the report's check fails.
pub(crate) const AGREEMENT: f64 = 1e-6;

/// A rotor and what follows from it.
#[derive(Clone, Debug)]
pub(crate) struct Analysis {
    /// The rotor.
    pub(crate) named: NamedRotor,
    /// Crack compliance, Eq. (8).
    pub(crate) compliance: CrackCompliance,
    /// Dimensionless coefficients, Eq. (12).
    pub(crate) coefficients: Coefficients,
    /// ω_st, rad/s.
    pub(crate) reference_speed: f64,
    /// The regions, or why there is none.
    pub(crate) regions: Vec<(RegionKind, Result<Region, String>)>,
}

/// An instability region three ways, in units of the reference speed.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    /// Where it starts, Eqs. (15), (16).
    pub(crate) start: f64,
    /// Its approximate width, Eq. (31), or why there is none.
    pub(crate) width: Result<f64, String>,
    /// Its exact ends, or why there are none.
    pub(crate) exact: Result<Ends, String>,
    /// Its ends by Hill's method, or why they are not told.
    pub(crate) hill: Result<Ends, String>,
}

impl Region {
    /// Relative difference of the approximate width to the exact one; none where a width is missing or zero.
    pub(crate) fn approximation_difference(&self) -> Option<f64> {
        relative(
            *self.width.as_ref().ok()?,
            self.exact.as_ref().ok()?.width(),
        )
    }

    /// Relative difference of Hill's width to the exact one.
    pub(crate) fn hill_difference(&self) -> Option<f64> {
        relative(
            self.hill.as_ref().ok()?.width(),
            self.exact.as_ref().ok()?.width(),
        )
    }
}

fn relative(value: f64, reference: f64) -> Option<f64> {
    (reference > 0.0).then(|| value / reference - 1.0)
}

impl Analysis {
    /// Computes everything.
    ///
    /// # Errors
    ///
    /// Where the rotor has no coefficients in double precision.
    pub(crate) fn new(named: NamedRotor) -> Result<Self, Failure> {
        let rotor = &named.rotor;
        let failed = |error: rotor_core::rotor::NoCoefficients| {
            Failure::input(format!("{}: {error}", named.name))
        };
        let compliance = rotor.compliance().map_err(failed)?;
        let coefficients = rotor.coefficients().map_err(failed)?;
        let reference_speed = rotor.reference_speed().map_err(failed)?;
        let regions = regions(&coefficients);
        Ok(Self {
            named,
            compliance,
            coefficients,
            reference_speed,
            regions,
        })
    }

    /// The regions whose width by Hill's method is not the exact one.
    pub(crate) fn disagreements(&self) -> Vec<RegionKind> {
        let differs = |region: &Region| {
            region
                .hill_difference()
                .is_some_and(|difference| difference.abs() > AGREEMENT)
        };
        self.regions
            .iter()
            .filter(|(_, region)| region.as_ref().is_ok_and(differs))
            .map(|(kind, _)| *kind)
            .collect()
    }
}

/// The regions of a rotor. The second simple region is left out where there is none: few rotors have it.
fn regions(c: &Coefficients) -> Vec<(RegionKind, Result<Region, String>)> {
    let mut regions: Vec<_> = RegionKind::ALL
        .into_iter()
        .map(|kind| (kind, without_hill(kind, c)))
        .filter(|(kind, region)| *kind != RegionKind::UpperSimple || region.is_ok())
        .collect();
    let exact: Vec<Option<Ends>> = regions
        .iter()
        .map(|(_, region)| {
            region
                .as_ref()
                .ok()
                .and_then(|region| region.exact.as_ref().ok().copied())
        })
        .collect();
    for (index, (_, region)) in regions.iter_mut().enumerate() {
        if let Ok(region) = region {
            let others = exact
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index)
                .filter_map(|(_, ends)| *ends);
            region.hill = hill_ends(c, region, &others.collect::<Vec<_>>());
        }
    }
    regions
}

fn hill_ends(c: &Coefficients, region: &Region, others: &[Ends]) -> Result<Ends, String> {
    if let Ok(exact) = region.exact {
        // The growth rate says that the motion grows, not in which region.
        if others
            .iter()
            .any(|other| other.lower <= exact.upper && exact.lower <= other.upper)
        {
            return Err(
                "it overlaps another region, the growth rate does not tell them apart".to_owned(),
            );
        }
    }
    hill::ends(
        c,
        region.start,
        *region.width.as_ref().map_err(String::clone)?,
    )
}

fn without_hill(kind: RegionKind, c: &Coefficients) -> Result<Region, String> {
    let start = region::start(kind, c).map_err(|error| error.to_string())?;
    Ok(Region {
        start,
        width: region::width(kind, c).map_err(|error| error.to_string()),
        exact: region::exact_ends(kind, c).map_err(|error| error.to_string()),
        hill: Err("not computed".to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotor_core::rotor::Rotor;

    #[test]
    fn a_width_by_hill_that_is_off_fails_the_check() {
        let named = NamedRotor {
            rotor: Rotor::default(),
            name: "a test".to_owned(),
        };
        let mut analysis = Analysis::new(named).unwrap();
        assert_eq!(analysis.disagreements(), []);
        let region = analysis.regions[1].1.as_mut().unwrap();
        let hill = region.hill.clone().unwrap();
        region.hill = Ok(Ends {
            upper: hill.upper + 1e-5 * hill.width(),
            ..hill
        });
        assert_eq!(analysis.disagreements(), [RegionKind::Combination]);
    }

    #[test]
    fn hill_is_not_asked_where_regions_overlap() {
        let c = Rotor::default().coefficients().unwrap();
        let region = without_hill(RegionKind::Simple, &c).unwrap();
        let exact = region.exact.clone().unwrap();
        let touching = Ends {
            lower: exact.upper,
            upper: exact.upper + 1.0,
        };
        assert!(hill_ends(&c, &region, &[touching]).is_err());
        let apart = Ends {
            lower: exact.upper + 0.1,
            upper: exact.upper + 1.0,
        };
        assert!(hill_ends(&c, &region, &[apart]).is_ok());
    }
}
