//! Everything that a report states about one rotor, computed once.

use rotor_core::equations::{Coefficients, CrackCompliance};
use rotor_core::error::InputError;
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::model::{Survey, SurveyedRegion};
use rotor_core::reason;

use crate::failure::Failure;
use crate::rotor_file::NamedRotor;

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
    /// Its instability regions.
    pub(crate) survey: Survey,
}

impl Analysis {
    /// Computes everything.
    ///
    /// # Errors
    ///
    /// Where the rotor has no coefficients, or a region no start, in double precision.
    pub(crate) fn new(named: NamedRotor) -> Result<Self, Failure> {
        let rotor = &named.rotor;
        let failed = |error: InputError| Failure::input(format!("{}: {error}", named.name));
        let compliance = rotor.compliance().map_err(failed)?;
        let coefficients = rotor.coefficients().map_err(failed)?;
        let reference_speed = rotor.reference_speed().map_err(failed)?;
        let out_of_range = RegionKind::ALL
            .into_iter()
            .find_map(|kind| reason::out_of_range(kind, &coefficients));
        if let Some(why) = out_of_range {
            return Err(Failure::input(format!("{}: {why}", named.name)));
        }
        Ok(Self {
            survey: Survey::of(&coefficients),
            named,
            compliance,
            coefficients,
            reference_speed,
        })
    }

    /// The regions whose check failed, and what it has found.
    pub(crate) fn disagreements(&self) -> Vec<(RegionKind, String)> {
        let found = self.survey.regions.iter();
        let found = found.filter_map(|(kind, region)| Some((*kind, region.as_ref().ok()?)));
        found
            .filter_map(|(kind, region)| Some((kind, disagreement(region)?)))
            .collect()
    }
}

/// What the check of a region has found where it failed.
fn disagreement(region: &SurveyedRegion) -> Option<String> {
    if region.agrees() {
        return None;
    }
    Some(match &region.hill {
        Err(why) => format!(
            "Hill's method does not give its exact ends: {}",
            reason::of_boundary(why)
        ),
        Ok(_) => format!(
            "its width by Hill's method is off the exact one by {:.1e} of it",
            region.hill_difference().unwrap_or_default()
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotor_core::error::SystemError;
    use rotor_core::jeffcott::rotor::Rotor;

    fn paper() -> Analysis {
        let named = NamedRotor {
            rotor: Rotor::paper(),
            name: "a test".to_owned(),
        };
        Analysis::new(named).unwrap()
    }

    fn failed(analysis: &Analysis) -> Vec<RegionKind> {
        let failed = analysis.disagreements().into_iter();
        failed.map(|(kind, _)| kind).collect()
    }

    #[test]
    fn a_width_by_hill_that_is_off_fails_the_check() {
        let mut analysis = paper();
        assert_eq!(failed(&analysis), []);
        let region = analysis.survey.regions[1].1.as_mut().unwrap();
        let hill = region.hill.as_mut().unwrap();
        hill.upper += 1e-5 * hill.width();
        assert_eq!(failed(&analysis), [RegionKind::Combination]);
    }

    #[test]
    fn a_failure_of_hills_method_fails_the_check() {
        let mut analysis = paper();
        let (_, region) = &mut analysis.survey.regions[0];
        let broken = SystemError::NoConvergence {
            what: "the Schur form",
            iterations: 1,
        };
        region.as_mut().unwrap().hill = Err(broken.into());
        assert_eq!(failed(&analysis), [RegionKind::Simple]);
    }
}
