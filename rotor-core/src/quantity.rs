//! Every result by its name, for tables, files and the command line.

use std::cell::OnceCell;
use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use crate::equations::{Coefficients, CrackCompliance, Stiffness};
use crate::error::StabilityError;
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::region::{self, NoEnds, NoRegion, RegionKind};
use crate::jeffcott::rotor::{NoCoefficients, Rotor};
use crate::unit::TIMES_REFERENCE_SPEED;

/// A result that a rotor has, or has at a speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(usize)]
pub enum Quantity {
    /// Crack compliance $c_{11}$, Eq. (8a).
    C11,
    /// Crack compliance $c_{22}$, Eq. (8b).
    C22,
    /// Crack compliance $c_{33}$, Eq. (8c).
    C33,
    /// Crack compliance $c_{44}$, Eq. (8d).
    C44,
    /// Reference speed $\omega_{st}$.
    ReferenceSpeed,
    /// Inertia ratio $\beta$.
    Beta,
    /// Coupling stiffness $\gamma$.
    Gamma,
    /// Tilting stiffness $\delta$.
    Delta,
    /// $\epsilon_1$, time-varying transverse stiffness.
    Epsilon1,
    /// $\epsilon_{12}$, time-varying coupling stiffness.
    Epsilon12,
    /// $\epsilon_2$, time-varying tilting stiffness.
    Epsilon2,
    /// Start $\Omega_s$ of the simple region, Eq. (15).
    SirStart,
    /// Start $\Omega_c$ of the combination region, Eq. (16).
    CirStart,
    /// Width $\lambda_s$ of the simple region, Eq. (31).
    SirWidth,
    /// Width $\lambda_c$ of the combination region, Eq. (31).
    CirWidth,
    /// Disk asymmetry that closes the simple region, Eq. (32).
    SirZupAsymmetry,
    /// Disk asymmetry that closes the combination region, Eq. (32).
    CirZupAsymmetry,
    /// Exact lower end of the simple region.
    SirExactLower,
    /// Exact upper end of the simple region.
    SirExactUpper,
    /// Exact lower end of the combination region.
    CirExactLower,
    /// Exact upper end of the combination region.
    CirExactUpper,
    /// Exact growth rate at a speed.
    GrowthRate,
}

/// Name, symbol, unit, description.
type Row = (
    Quantity,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
);

/// One row for each quantity, in the order of the variants.
#[rustfmt::skip]
const TABLE: [Row; 22] = [
    (Quantity::C11, "c11", "c₁₁", "m/N", "shear compliance of the crack along its depth, Eq. (8a)"),
    (Quantity::C22, "c22", "c₂₂", "m/N", "shear compliance of the crack along its edge, Eq. (8b)"),
    (Quantity::C33, "c33", "c₃₃", "rad/(N m)", "bending compliance of the crack that opens its whole edge, Eq. (8c)"),
    (Quantity::C44, "c44", "c₄₄", "rad/(N m)", "bending compliance of the crack that opens one half of its edge, Eq. (8d)"),
    (Quantity::ReferenceSpeed, "reference_speed", "ω_st", "rad/s", "reference speed √(k_tt/m_d)"),
    (Quantity::Beta, "beta", "β", "", "inertia ratio I_p/I_d"),
    (Quantity::Gamma, "gamma", "γ", "", "mean coupling stiffness"),
    (Quantity::Delta, "delta", "δ", "", "mean tilting stiffness"),
    (Quantity::Epsilon1, "epsilon_1", "ε₁", "", "relative variation of the transverse stiffness"),
    (Quantity::Epsilon12, "epsilon_12", "ε₁₂", "", "relative variation of the coupling stiffness"),
    (Quantity::Epsilon2, "epsilon_2", "ε₂", "", "relative variation of the tilting stiffness"),
    (Quantity::SirStart, "sir_start", "Ω_s", TIMES_REFERENCE_SPEED, "start of the simple instability region, Eq. (15)"),
    (Quantity::CirStart, "cir_start", "Ω_c", TIMES_REFERENCE_SPEED, "start of the combination instability region, Eq. (16)"),
    (Quantity::SirWidth, "sir_width", "λ_s", TIMES_REFERENCE_SPEED, "width of the simple instability region, Eq. (31)"),
    (Quantity::CirWidth, "cir_width", "λ_c", TIMES_REFERENCE_SPEED, "width of the combination instability region, Eq. (31)"),
    (Quantity::SirZupAsymmetry, "sir_zup_asymmetry", "Δ_d,s", "", "disk asymmetry that closes the simple region at φ = π/2, Eq. (32)"),
    (Quantity::CirZupAsymmetry, "cir_zup_asymmetry", "Δ_d,c", "", "disk asymmetry that closes the combination region at φ = 0, Eq. (32)"),
    (Quantity::SirExactLower, "sir_exact_lower", "Ω_s,lower", TIMES_REFERENCE_SPEED, "exact lower end of the simple instability region"),
    (Quantity::SirExactUpper, "sir_exact_upper", "Ω_s,upper", TIMES_REFERENCE_SPEED, "exact upper end of the simple instability region"),
    (Quantity::CirExactLower, "cir_exact_lower", "Ω_c,lower", TIMES_REFERENCE_SPEED, "exact lower end of the combination instability region"),
    (Quantity::CirExactUpper, "cir_exact_upper", "Ω_c,upper", TIMES_REFERENCE_SPEED, "exact upper end of the combination instability region"),
    (Quantity::GrowthRate, "growth_rate", "μ", TIMES_REFERENCE_SPEED, "exact growth rate at a speed, 0 where the motion is stable"),
];

impl Quantity {
    /// Every quantity, in the order of the documentation.
    pub const ALL: [Self; TABLE.len()] = {
        let mut all = [Self::C11; TABLE.len()];
        let mut index = 0;
        while index < all.len() {
            all[index] = TABLE[index].0;
            index += 1;
        }
        all
    };

    /// The variant's place is its row's place; a test holds them together.
    const fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// The one name, such as `sir_width`.
    pub const fn name(self) -> &'static str {
        self.row().1
    }

    /// The symbol, such as `λ_s`.
    pub const fn symbol(self) -> &'static str {
        self.row().2
    }

    /// The unit, empty where there is none.
    pub const fn unit(self) -> &'static str {
        self.row().3
    }

    /// What it is, in a few words, with its equation.
    pub const fn description(self) -> &'static str {
        self.row().4
    }

    /// Whether it is at a speed, and not of the rotor alone.
    pub const fn needs_speed(self) -> bool {
        matches!(self, Self::GrowthRate)
    }

    /// Computes it for one rotor; see [`evaluate`] for several and [`evaluate_at`] for those at a speed.
    ///
    /// # Errors
    /// Why the rotor has no such quantity.
    pub fn evaluate(self, rotor: &Rotor) -> Result<f64, Reason> {
        Shared::new(rotor).get(self, None)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is no quantity.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no quantity \"{found}\"; the nearest are {}", .nearest.join(", "))]
pub struct UnknownQuantity {
    /// What was given.
    pub found: String,
    /// The nearest names, the nearest first.
    pub nearest: Vec<&'static str>,
}

impl FromStr for Quantity {
    type Err = UnknownQuantity;

    fn from_str(text: &str) -> Result<Self, UnknownQuantity> {
        if let Some(quantity) = Self::ALL
            .into_iter()
            .find(|quantity| quantity.name() == text)
        {
            return Ok(quantity);
        }
        let mut names = Self::ALL.map(Self::name);
        names.sort_by(|a, b| {
            strsim::jaro_winkler(b, text).total_cmp(&strsim::jaro_winkler(a, text))
        });
        let nearest = names.into_iter().take(3).collect();
        Err(UnknownQuantity {
            found: text.to_owned(),
            nearest,
        })
    }
}

/// Why a rotor has no such quantity.
#[derive(Clone, Debug, PartialEq, Error)]
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

/// Computes several quantities of one rotor, in the order asked for. What they share (the crack's
/// compliance, the stiffness, the coefficients, the ends of a region) is computed once, and only if
/// one of them needs it.
pub fn evaluate(quantities: &[Quantity], rotor: &Rotor) -> Vec<Result<f64, Reason>> {
    evaluate_at(quantities, rotor, None)
}

/// The same at a speed, in units of the reference speed, for quantities that [need one](Quantity::needs_speed).
///
/// ```
/// use rotor_core::{quantity::{Quantity, evaluate_at}, jeffcott::rotor::Rotor};
/// let rotor = Rotor::default();
/// let [lower, upper] = [Quantity::SirExactLower, Quantity::SirExactUpper].map(|end| end.evaluate(&rotor));
/// let inside = 0.5 * (lower? + upper?);
/// let growth = evaluate_at(&[Quantity::GrowthRate], &rotor, Some(inside)).remove(0)?;
/// assert!(growth > 0.0);
/// # Ok::<(), rotor_core::quantity::Reason>(())
/// ```
pub fn evaluate_at(
    quantities: &[Quantity],
    rotor: &Rotor,
    speed: Option<f64>,
) -> Vec<Result<f64, Reason>> {
    let shared = Shared::new(rotor);
    quantities
        .iter()
        .map(|&quantity| shared.get(quantity, speed))
        .collect()
}

/// What the quantities of one rotor have in common, each computed at its first use.
pub(crate) struct Shared<'a> {
    rotor: &'a Rotor,
    compliance: OnceCell<Result<CrackCompliance, NoCoefficients>>,
    stiffness: OnceCell<Result<Stiffness, NoCoefficients>>,
    coefficients: OnceCell<Result<Coefficients, NoCoefficients>>,
    sir_ends: OnceCell<Result<Ends, Reason>>,
    cir_ends: OnceCell<Result<Ends, Reason>>,
}

impl<'a> Shared<'a> {
    pub(crate) const fn new(rotor: &'a Rotor) -> Self {
        Self {
            rotor,
            compliance: OnceCell::new(),
            stiffness: OnceCell::new(),
            coefficients: OnceCell::new(),
            sir_ends: OnceCell::new(),
            cir_ends: OnceCell::new(),
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

    /// The exact ends of the region that the cell is for.
    fn ends(
        &self,
        kind: RegionKind,
        cell: &OnceCell<Result<Ends, Reason>>,
    ) -> Result<Ends, Reason> {
        cell.get_or_init(|| Ok(region::exact_ends(kind, &self.coefficients()?)?))
            .clone()
    }

    /// The quantity, at a speed if it needs one.
    pub(crate) fn get(&self, quantity: Quantity, speed: Option<f64>) -> Result<f64, Reason> {
        use RegionKind::{Combination, Simple};
        Ok(match quantity {
            Quantity::C11 => self.compliance()?.c11,
            Quantity::C22 => self.compliance()?.c22,
            Quantity::C33 => self.compliance()?.c33,
            Quantity::C44 => self.compliance()?.c44,
            Quantity::ReferenceSpeed => self.rotor.reference_speed_of(&self.stiffness()?)?,
            Quantity::Beta => self.coefficients()?.beta,
            Quantity::Gamma => self.coefficients()?.gamma,
            Quantity::Delta => self.coefficients()?.delta,
            Quantity::Epsilon1 => self.coefficients()?.epsilon_1,
            Quantity::Epsilon12 => self.coefficients()?.epsilon_12,
            Quantity::Epsilon2 => self.coefficients()?.epsilon_2,
            Quantity::SirStart => region::start(Simple, &self.coefficients()?)?,
            Quantity::CirStart => region::start(Combination, &self.coefficients()?)?,
            Quantity::SirWidth => region::width(Simple, &self.coefficients()?)?,
            Quantity::CirWidth => region::width(Combination, &self.coefficients()?)?,
            Quantity::SirZupAsymmetry => region::zup_asymmetry(Simple, &self.coefficients()?)?,
            Quantity::CirZupAsymmetry => region::zup_asymmetry(Combination, &self.coefficients()?)?,
            Quantity::SirExactLower => self.ends(Simple, &self.sir_ends)?.lower,
            Quantity::SirExactUpper => self.ends(Simple, &self.sir_ends)?.upper,
            Quantity::CirExactLower => self.ends(Combination, &self.cir_ends)?.lower,
            Quantity::CirExactUpper => self.ends(Combination, &self.cir_ends)?.upper,
            Quantity::GrowthRate => {
                let speed = speed.ok_or(Reason::NoSpeed(quantity))?;
                exact::growth_rate(&self.coefficients()?, speed)?
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_stands_at_its_variant() {
        for (index, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(quantity as usize, index);
            assert_eq!(quantity.row().0, quantity);
            assert_eq!(quantity.name().parse(), Ok(quantity));
        }
    }

    #[test]
    fn an_unknown_name_lists_the_nearest() {
        let error = "sir_with".parse::<Quantity>().unwrap_err();
        assert_eq!(error.nearest.first(), Some(&"sir_width"));
        assert!(
            error
                .to_string()
                .starts_with("there is no quantity \"sir_with\"; the nearest are sir_width, ")
        );
    }

    #[test]
    fn together_is_the_same_as_alone() {
        let rotor = Rotor::default();
        let together = evaluate(&Quantity::ALL, &rotor);
        for (quantity, value) in Quantity::ALL.into_iter().zip(together) {
            assert_eq!(value, quantity.evaluate(&rotor), "{quantity}");
            assert_eq!(value.is_ok(), !quantity.needs_speed(), "{quantity}");
        }
    }

    #[test]
    fn one_missing_quantity_does_not_hide_the_others() {
        let rotor =
            Rotor::default().with(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia);
        let rotor = rotor.unwrap();
        let [sir, cir] = &evaluate(&[Quantity::SirWidth, Quantity::CirWidth], &rotor)[..] else {
            panic!("two answers")
        };
        assert!(sir.is_ok());
        assert!(
            matches!(cir, Err(Reason::Region(NoRegion::InertiaRatio { .. }))),
            "{cir:?}"
        );
    }
}
