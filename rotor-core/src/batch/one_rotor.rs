//! One rotor alone: its quantities, or why it has none.

use std::cell::OnceCell;

use thiserror::Error;

use crate::equations::chain::{self, Stage};
use crate::equations::{Coefficients, CrackCompliance, Stiffness};
use crate::error::StabilityError;
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::region::{self, NoEnds, NoRegion, RegionKind};
use crate::jeffcott::rotor::{NoCoefficients, Rotor};
use crate::quantity::{Measure, Quantity, Subject};

/// Why a rotor has no such quantity.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// It has no coefficients in double precision.
    #[error(transparent)]
    Coefficients(#[from] NoCoefficients),
    /// It has no such region, or the region no such quantity.
    #[error(transparent)]
    Region(#[from] NoRegion),
    /// The region has no two exact ends, or they were not found.
    #[error(transparent)]
    Stability(#[from] StabilityError),
    /// It is at a speed, and none is given.
    #[error("{0} is at a speed, and none is given")]
    NoSpeed(Quantity),
}

impl From<NoEnds> for Reason {
    fn from(reason: NoEnds) -> Self {
        match reason {
            NoEnds::Region(reason) => Self::Region(reason),
            NoEnds::Stability(reason) => Self::Stability(reason),
        }
    }
}

/// What the quantities of one rotor have in common, each computed at its first use.
pub(crate) struct OneRotor<'a> {
    rotor: &'a Rotor,
    compliance: OnceCell<Result<CrackCompliance, NoCoefficients>>,
    stiffness: OnceCell<Result<Stiffness, NoCoefficients>>,
    coefficients: OnceCell<Result<Coefficients, NoCoefficients>>,
    /// For each region in the order of [`RegionKind::ALL`].
    ends: [OnceCell<Result<Ends, Reason>>; RegionKind::ALL.len()],
}

impl<'a> OneRotor<'a> {
    pub(crate) const fn new(rotor: &'a Rotor) -> Self {
        Self {
            rotor,
            compliance: OnceCell::new(),
            stiffness: OnceCell::new(),
            coefficients: OnceCell::new(),
            ends: [const { OnceCell::new() }; RegionKind::ALL.len()],
        }
    }

    fn compliance(&self) -> Result<CrackCompliance, NoCoefficients> {
        *self.compliance.get_or_init(|| self.rotor.compliance())
    }

    fn stiffness(&self) -> Result<Stiffness, NoCoefficients> {
        *self
            .stiffness
            .get_or_init(|| self.rotor.stiffness_of(&self.compliance()?))
    }

    fn coefficients(&self) -> Result<Coefficients, NoCoefficients> {
        *self
            .coefficients
            .get_or_init(|| self.rotor.coefficients_of(&self.stiffness()?))
    }

    /// The exact ends of a region.
    fn ends(&self, region: RegionKind) -> Result<Ends, Reason> {
        let find = || Ok(region::exact_ends(region, &self.coefficients()?)?);
        self.ends[region as usize].get_or_init(find).clone()
    }

    /// The quantity, at a speed if it needs one.
    pub(crate) fn get(&self, quantity: Quantity, speed: Option<f64>) -> Result<f64, Reason> {
        Ok(match quantity.subject() {
            Subject::Plain => self.plain(quantity)?,
            Subject::Region(region, Measure::Start) => {
                region::start(region, &self.coefficients()?)?
            }
            Subject::Region(region, Measure::Width) => {
                region::width(region, &self.coefficients()?)?
            }
            Subject::Region(region, Measure::ZupAsymmetry) => {
                region::zup_asymmetry(region, &self.coefficients()?)?
            }
            Subject::Region(region, Measure::ExactLower) => self.ends(region)?.lower,
            Subject::Region(region, Measure::ExactUpper) => self.ends(region)?.upper,
            Subject::AtSpeed => {
                let speed = speed.ok_or(Reason::NoSpeed(quantity))?;
                exact::growth_rate(&self.coefficients()?, speed)?
            }
        })
    }

    /// A column of the chain of equations.
    fn plain(&self, quantity: Quantity) -> Result<f64, Reason> {
        let column = quantity.column();
        let stage = column.and_then(|column| column.stages().first().copied());
        let among = |numbers: &[f64]| {
            let mut columns = stage.map_or(&[][..], Stage::gives).iter();
            let place = columns.position(|other| Some(*other) == column);
            place.and_then(|place| numbers.get(place).copied())
        };
        let number = match stage {
            Some(Stage::CrackCompliance) => {
                among(&chain::numbers_of_crack_compliance(&self.compliance()?))
            }
            Some(Stage::Stiffness) => among(&chain::numbers_of_stiffness(&self.stiffness()?)),
            Some(Stage::Coefficients) => {
                among(&chain::numbers_of_coefficients(&self.coefficients()?))
            }
            _ => None,
        };
        match number {
            Some(number) => Ok(number),
            None => Ok(self.rotor.reference_speed_of(&self.stiffness()?)?),
        }
    }
}
