//! One rotor alone: its quantities, or why it has none.

use std::cell::OnceCell;

use crate::equations::chain::{self, Stage};
use crate::equations::{Coefficients, CrackCompliance, Stiffness};
use crate::error::{Error, InputError};
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::region::{Region, RegionKind};
use crate::jeffcott::rotor::Rotor;
use crate::quantity::{Measure, Quantity, Subject};

/// Every plain quantity is one that [`OneRotor::plain`] knows: the reference speed, or a column of one of three stages.
const _: () = {
    let mut place = 0;
    while place < Quantity::ALL.len() {
        let quantity = Quantity::ALL[place];
        if let (Subject::Plain, Some(column)) = (quantity.subject(), quantity.column()) {
            assert!(
                match column.stages() {
                    [] => matches!(quantity, Quantity::ReferenceSpeed),
                    [stage] => matches!(
                        stage,
                        Stage::CrackCompliance | Stage::Stiffness | Stage::Coefficients
                    ),
                    _ => false,
                },
                "`OneRotor::plain` does not know a plain quantity"
            );
        }
        place += 1;
    }
};

/// What the quantities of one rotor have in common, each computed at its first use.
pub(crate) struct OneRotor<'a> {
    rotor: &'a Rotor,
    compliance: OnceCell<Result<CrackCompliance, InputError>>,
    stiffness: OnceCell<Result<Stiffness, InputError>>,
    coefficients: OnceCell<Result<Coefficients, InputError>>,
    /// For each region in the order of [`RegionKind::ALL`].
    ends: [OnceCell<Result<Ends, Error>>; RegionKind::ALL.len()],
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

    fn compliance(&self) -> Result<&CrackCompliance, InputError> {
        let computed = self.compliance.get_or_init(|| self.rotor.compliance());
        computed.as_ref().map_err(Clone::clone)
    }

    fn stiffness(&self) -> Result<&Stiffness, InputError> {
        let compute = || self.rotor.stiffness_of(self.compliance()?);
        let computed = self.stiffness.get_or_init(compute);
        computed.as_ref().map_err(Clone::clone)
    }

    fn coefficients(&self) -> Result<&Coefficients, InputError> {
        let compute = || self.rotor.coefficients_of(self.stiffness()?);
        let computed = self.coefficients.get_or_init(compute);
        computed.as_ref().map_err(Clone::clone)
    }

    fn region(&self, kind: RegionKind) -> Result<Region, Error> {
        Ok(Region::of(kind, self.coefficients()?)?)
    }

    /// The exact ends of a region.
    fn ends(&self, region: RegionKind) -> Result<Ends, Error> {
        let find = || self.region(region)?.exact_ends();
        self.ends[region as usize].get_or_init(find).clone()
    }

    /// The quantity, at a speed if it needs one.
    pub(crate) fn get(&self, quantity: Quantity, speed: Option<f64>) -> Result<f64, Error> {
        let number = match quantity.subject() {
            Subject::Plain => self.plain(quantity)?,
            Subject::Region(region, Measure::Start) => self.region(region)?.start(),
            Subject::Region(region, Measure::Width) => self.region(region)?.width()?,
            Subject::Region(region, Measure::ZupAsymmetry) => {
                self.region(region)?.zup_asymmetry()?
            }
            Subject::Region(region, Measure::ExactLower) => self.ends(region)?.lower,
            Subject::Region(region, Measure::ExactUpper) => self.ends(region)?.upper,
            Subject::AtSpeed => {
                let speed = speed.ok_or(InputError::NoSpeed {
                    quantity: quantity.name(),
                })?;
                exact::growth_rate(self.coefficients()?, speed)?
            }
        };
        // A zero has no sign.
        Ok(number + 0.0)
    }

    /// A column of the chain of equations.
    fn plain(&self, quantity: Quantity) -> Result<f64, Error> {
        let column = quantity.column();
        let stage = column.and_then(|column| column.stages().first().copied());
        let among = |numbers: &[f64]| {
            let mut columns = stage.map_or(&[][..], Stage::gives).iter();
            let place = columns.position(|other| Some(*other) == column);
            place.and_then(|place| numbers.get(place).copied())
        };
        let number = match stage {
            Some(Stage::CrackCompliance) => {
                among(&chain::numbers_of_crack_compliance(self.compliance()?))
            }
            Some(Stage::Stiffness) => among(&chain::numbers_of_stiffness(self.stiffness()?)),
            Some(Stage::Coefficients) => {
                among(&chain::numbers_of_coefficients(self.coefficients()?))
            }
            _ => None,
        };
        match number {
            Some(number) => Ok(number),
            None => Ok(self.rotor.reference_speed_of(self.stiffness()?)?),
        }
    }
}
