//! The physical rotor: its inputs in SI units, validated once.
//!
//! [`Rotor`] is what has passed [`INPUTS`]. Every formula is called from
//! [`equations`]; this module only decides which lever arm and which edge
//! factor they get, and refuses what double precision cannot hold.

#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::equations::{self, Coefficients, CrackCompliance, SectionLoads, Stiffness};
use crate::input::{CrackModel, INPUTS, NumericInput, RotorParameters};
use crate::warning::{self, Warning};

/// Why inputs describe no rotor.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidRotor {
    /// An input is outside the values it allows, or not a finite number.
    #[error("{name} is {value}{space}{unit}; it must be {allowed}",
        name = .input.name, unit = .input.unit, allowed = .input.allowed,
        space = if .input.unit.is_empty() { "" } else { " " })]
    OutOfRange {
        /// The row of [`INPUTS`].
        input: &'static NumericInput,
        /// What was given.
        value: f64,
    },
    /// More polar inertia than any rigid body has: $I_p \le I_{dx} + I_{dy} = 2I_d$.
    #[error(
        "beta = disk_polar_inertia / disk_diametral_inertia = {disk_polar_inertia} kg m² / \
         {disk_diametral_inertia} kg m² = {beta}; it must be > 0 and <= 2, since no rigid body has more"
    )]
    InertiaRatio {
        /// $\beta = I_p/I_d$.
        beta: f64,
        /// $I_p$, kg m².
        disk_polar_inertia: f64,
        /// $I_d$, kg m².
        disk_diametral_inertia: f64,
    },
}

/// Why a valid rotor has no coefficients in double precision.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoCoefficients {
    /// The inputs are so extreme that a derived quantity overflows or loses all its digits.
    #[error(
        "{quantity} comes out as {value}: the inputs are each allowed, but together they leave \
         the range of double precision; it must be {allowed}"
    )]
    OutOfNumericRange {
        /// The derived quantity, such as `k_tt`.
        quantity: &'static str,
        /// What came out.
        value: f64,
        /// What it has to be.
        allowed: &'static str,
    },
    /// $\epsilon_{12} = \Delta k_{tm}/k_{tm}$ with $k_{tm} = 0$ and $\Delta k_{tm} \ne 0$.
    #[error(
        "epsilon_12 = delta_k_tm / k_tm is not defined: k_tm is exactly 0 N while delta_k_tm is \
         {delta_k_tm} N (displacement and tilt are uncoupled in the mean, but not over a turn)"
    )]
    CouplingVanishes {
        /// $\Delta k_{tm}$, N.
        delta_k_tm: f64,
    },
}

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
    type Error = InvalidRotor;

    fn try_from(parameters: RotorParameters) -> Result<Self, InvalidRotor> {
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
    pub fn new(parameters: RotorParameters) -> Result<Self, InvalidRotor> {
        for input in &INPUTS {
            let value = (input.get)(&parameters);
            if !input.allowed.contains(value) {
                return Err(InvalidRotor::OutOfRange { input, value });
            }
        }
        let beta = parameters.inertia_ratio();
        if !(beta > 0.0 && beta <= 2.0) {
            return Err(InvalidRotor::InertiaRatio {
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
    pub fn with(&self, change: impl FnOnce(&mut RotorParameters)) -> Result<Self, InvalidRotor> {
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
    pub fn compliance(&self) -> Result<CrackCompliance, NoCoefficients> {
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
    pub fn stiffness(&self) -> Result<Stiffness, NoCoefficients> {
        self.stiffness_of(&self.compliance()?)
    }

    pub(crate) fn stiffness_of(&self, c: &CrackCompliance) -> Result<Stiffness, NoCoefficients> {
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
    ) -> Result<(), NoCoefficients> {
        let f = equations::shaft_flexibility(&self.parameters);
        let planes = [
            equations::flexibility_determinant(&f, loads, c.c11, c.c44),
            equations::flexibility_determinant(&f, loads, c.c22, c.c33),
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
    pub fn reference_speed(&self) -> Result<f64, NoCoefficients> {
        self.reference_speed_of(&self.stiffness()?)
    }

    /// The dimensionless numbers of Eq. (12). Where $k_{tm}$ and $\Delta k_{tm}$ are both exactly
    /// zero (a disk at midspan without a crack), $\epsilon_{12}$ multiplies nothing and is 0.
    ///
    /// # Errors
    /// As [`Rotor::stiffness`]; where a coefficient is not finite; where $k_{tm}$ alone is zero.
    pub fn coefficients(&self) -> Result<Coefficients, NoCoefficients> {
        self.coefficients_of(&self.stiffness()?)
    }

    pub(crate) fn reference_speed_of(&self, k: &Stiffness) -> Result<f64, NoCoefficients> {
        let speed = equations::reference_speed::value(&self.parameters, k);
        check(
            &[("reference_speed", speed)],
            |value| value > 0.0,
            "a finite number > 0",
        )?;
        Ok(speed)
    }

    pub(crate) fn coefficients_of(&self, k: &Stiffness) -> Result<Coefficients, NoCoefficients> {
        let mut c = equations::coefficients::value(&self.parameters, k);
        if k.k_tm == 0.0 {
            if k.delta_k_tm != 0.0 {
                return Err(NoCoefficients::CouplingVanishes {
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
) -> Result<(), NoCoefficients> {
    match named
        .iter()
        .find(|(_, value)| !(value.is_finite() && holds(*value)))
    {
        Some(&(quantity, value)) => Err(NoCoefficients::OutOfNumericRange {
            quantity,
            value,
            allowed,
        }),
        None => Ok(()),
    }
}
