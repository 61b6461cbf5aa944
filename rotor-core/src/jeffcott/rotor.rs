//! The physical rotor: its inputs in SI units, validated once.
//!
//! [`Rotor`] is what has passed [`INPUTS`]. Every formula is called from
//! [`equations`]; this module only decides which lever arm and which edge
//! factor they get, and refuses what double precision cannot hold.
//!
//! ```
//! use rotor_core::input::RotorParameters;
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! let rotor = Rotor::new(RotorParameters { shaft_radius: 0.06, ..RotorParameters::PAPER })?;
//! let thicker = rotor.with(|p| p.shaft_radius *= 1.1)?;
//! assert!(thicker.reference_speed()? > rotor.reference_speed()?);
//! // What no rotor has is refused by name.
//! let error = rotor.with(|p| p.crack_depth_ratio = 1.5).unwrap_err();
//! assert_eq!(error.to_string(), "crack_depth_ratio is 1.5; it must be >= 0 and <= 1");
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

#[cfg(test)]
mod tests;

use crate::equations::{self, Coefficients, CrackCompliance, SectionLoads, Stiffness};
use crate::error::InputError;
use crate::input::{CrackModel, INPUTS, RotorParameters};
use crate::warning::{self, Warning};

/// A rotor whose inputs have passed [`INPUTS`] and $\beta \le 2$.
///
/// With the feature `serde` it is read and written as its inputs; what is read is validated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "RotorParameters", into = "RotorParameters")
)]
pub struct Rotor {
    parameters: RotorParameters,
}

impl Default for Rotor {
    /// [The rotor of the paper](Rotor::paper).
    fn default() -> Self {
        Self::paper()
    }
}

impl TryFrom<RotorParameters> for Rotor {
    type Error = InputError;

    fn try_from(parameters: RotorParameters) -> Result<Self, InputError> {
        Self::new(parameters)
    }
}

impl From<Rotor> for RotorParameters {
    fn from(rotor: Rotor) -> Self {
        rotor.parameters
    }
}

impl Rotor {
    /// The rotor of the paper's Section 4.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            parameters: RotorParameters::PAPER,
        }
    }

    /// Validates the inputs.
    ///
    /// # Errors
    /// The first input, in the order of [`INPUTS`], that is outside the values it allows; then
    /// $\beta > 2$.
    pub fn new(parameters: RotorParameters) -> Result<Self, InputError> {
        for input in &INPUTS {
            let value = (input.get)(&parameters);
            if !input.allowed.contains(value) {
                return Err(InputError::OutOfRange { input, value });
            }
        }
        let beta = parameters.inertia_ratio();
        if !(beta > 0.0 && beta <= 2.0) {
            return Err(InputError::InertiaRatio {
                beta,
                disk_polar_inertia: parameters.disk_polar_inertia,
                disk_diametral_inertia: parameters.disk_diametral_inertia,
            });
        }
        Ok(Self { parameters })
    }

    /// The validated inputs.
    pub const fn parameters(&self) -> &RotorParameters {
        &self.parameters
    }

    /// The rotor with some inputs changed, validated again.
    ///
    /// # Errors
    /// As [`Rotor::new`].
    pub fn with(&self, change: impl FnOnce(&mut RotorParameters)) -> Result<Self, InputError> {
        let mut parameters = self.parameters;
        change(&mut parameters);
        Self::new(parameters)
    }

    /// What is doubtful about the rotor, though it can be computed.
    pub fn warnings(&self) -> Vec<Warning> {
        warning::warnings(&self.parameters).collect()
    }

    /// Additional compliance of the crack, Eq. (8); zero without a crack.
    ///
    /// # Errors
    /// Where a compliance is not a finite number ≥ 0.
    pub fn compliance(&self) -> Result<CrackCompliance, InputError> {
        let c = equations::crack_compliance::value(
            &self.parameters,
            self.parameters.crack_edge.factor(),
        );
        let named = [
            ("c11", c.c11),
            ("c22", c.c22),
            ("c33", c.c33),
            ("c44", c.c44),
        ];
        check(&named, |value| value >= 0.0, "a finite number >= 0")?;
        Ok(c)
    }

    /// Mean stiffness of the cracked shaft and its variation over a turn, Eq. (10).
    ///
    /// # Errors
    /// Where an entry is not finite, or the mean stiffness is not positive.
    pub fn stiffness(&self) -> Result<Stiffness, InputError> {
        self.stiffness_of(&self.compliance()?)
    }

    pub(crate) fn stiffness_of(&self, c: &CrackCompliance) -> Result<Stiffness, InputError> {
        let loads = self.section_loads();
        self.check_flexibility(&loads, c)?;
        let k = equations::stiffness::value(&self.parameters, &loads, c);
        check(
            &[("k_tt", k.k_tt), ("k_mm", k.k_mm)],
            |value| value > 0.0,
            "a finite number > 0",
        )?;
        let named = [
            ("k_tm", k.k_tm),
            ("delta_k_tt", k.delta_k_tt),
            ("delta_k_tm", k.delta_k_tm),
            ("delta_k_mm", k.delta_k_mm),
        ];
        check(&named, |_| true, "a finite number")?;
        Ok(k)
    }

    /// The variation of the stiffness has the product of both planes' inverse determinants of the flexibility as a factor.
    /// Where that underflows, a cracked rotor would come out as one that nothing excites.
    fn check_flexibility(
        &self,
        loads: &SectionLoads,
        c: &CrackCompliance,
    ) -> Result<(), InputError> {
        let f = equations::shaft_flexibility(&self.parameters);
        let planes = [
            equations::flexibility_determinant(&self.parameters, &f, loads, c.c11, c.c44),
            equations::flexibility_determinant(&self.parameters, &f, loads, c.c22, c.c33),
        ];
        check(
            &planes.map(|determinant| ("flexibility_determinant", determinant)),
            |value| (1e-150..=1e150).contains(&value),
            "from 1e-150 to 1e150 per N²",
        )
    }

    /// Reference speed $\omega_{st} = \sqrt{k_{tt}/m_d}$, rad/s.
    ///
    /// # Errors
    /// As [`Rotor::stiffness`], and where the speed itself is not a finite number > 0.
    pub fn reference_speed(&self) -> Result<f64, InputError> {
        self.reference_speed_of(&self.stiffness()?)
    }

    /// The dimensionless numbers of Eq. (12). Where $k_{tm}$ and $\Delta k_{tm}$ are both exactly
    /// zero (a disk at midspan without a crack), $\epsilon_{12}$ multiplies nothing and is 0.
    ///
    /// # Errors
    /// As [`Rotor::stiffness`]; where a coefficient is not finite; where $k_{tm}$ alone is zero.
    pub fn coefficients(&self) -> Result<Coefficients, InputError> {
        self.coefficients_of(&self.stiffness()?)
    }

    pub(crate) fn reference_speed_of(&self, k: &Stiffness) -> Result<f64, InputError> {
        let speed = equations::reference_speed::value(&self.parameters, k);
        check(
            &[("reference_speed", speed)],
            |value| value > 0.0,
            "a finite number > 0",
        )?;
        Ok(speed)
    }

    pub(crate) fn coefficients_of(&self, k: &Stiffness) -> Result<Coefficients, InputError> {
        let mut c = equations::coefficients::value(&self.parameters, k);
        // As one quotient: as the product with an inverse that others share, which is two roundings, it would miss the limits 1
        // and 2, at which regions end.
        c.beta = self.parameters.inertia_ratio();
        if k.k_tm == 0.0 {
            if k.delta_k_tm != 0.0 {
                return Err(InputError::CouplingVanishes {
                    delta_k_tm: k.delta_k_tm,
                });
            }
            c.epsilon_12 = 0.0;
        }
        check(
            &[("delta", c.delta)],
            |value| value > 0.0,
            "a finite number > 0",
        )?;
        let named = [
            ("gamma", c.gamma),
            ("epsilon_1", c.epsilon_1),
            ("epsilon_12", c.epsilon_12),
            ("epsilon_2", c.epsilon_2),
        ];
        check(&named, |_| true, "a finite number")?;
        Ok(c)
    }

    /// Which of the load formulas holds for the crack's model and place.
    pub(crate) fn load_case(&self) -> LoadCase {
        LoadCase::of(&self.parameters)
    }

    fn section_loads(&self) -> SectionLoads {
        self.load_case().loads(&self.parameters)
    }
}

/// The formulas for the loads at the crack's section: one per crack model, two where the side of the disk matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LoadCase {
    SupportArm,
    MidspanArm,
    SimplySupportedLeft,
    SimplySupportedRight,
}

impl LoadCase {
    /// The one for a rotor's crack.
    pub(crate) fn of(p: &RotorParameters) -> Self {
        match p.crack_model {
            CrackModel::SupportArm => Self::SupportArm,
            CrackModel::MidspanArm => Self::MidspanArm,
            CrackModel::SimplySupported if p.crack_position_ratio < p.disk_position_ratio => {
                Self::SimplySupportedLeft
            }
            CrackModel::SimplySupported => Self::SimplySupportedRight,
        }
    }

    /// The loads by it.
    pub(crate) fn loads(self, p: &RotorParameters) -> SectionLoads {
        match self {
            Self::SupportArm => equations::support_arm::value(p),
            Self::MidspanArm => equations::midspan_arm::value(p),
            Self::SimplySupportedLeft => equations::simply_supported_left::value(p),
            Self::SimplySupportedRight => equations::simply_supported_right::value(p),
        }
    }
}

fn check(
    named: &[(&'static str, f64)],
    holds: impl Fn(f64) -> bool,
    allowed: &'static str,
) -> Result<(), InputError> {
    match named
        .iter()
        .find(|(_, value)| !(value.is_finite() && holds(*value)))
    {
        Some(&(quantity, value)) => Err(InputError::OutOfNumericRange {
            quantity,
            value,
            allowed,
        }),
        None => Ok(()),
    }
}
