//! Every result by its name, for tables, files and the command line.
//!
//! ```
//! use rotor_core::jeffcott::rotor::Rotor;
//! use rotor_core::quantity::Quantity;
//!
//! let width: Quantity = "sir_width".parse()?;
//! assert_eq!(width, Quantity::SirWidth);
//! let value = width.evaluate(&Rotor::paper())?;
//! println!("{} = {value} {}", width.symbol(), width.unit());
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

use std::fmt;
use std::str::FromStr;

use crate::equations::chain::Column;
use crate::error::InputError;
use crate::input::is_same;
use crate::jeffcott::region::RegionKind;
use crate::unit::TIMES_REFERENCE_SPEED;

use Measure::{ExactLower, ExactUpper, Start, Width, ZupAsymmetry};
use RegionKind::{Combination, Simple, UpperSimple};
use Subject::{AtSpeed, Plain, Region};

/// A result that a rotor has, or has at a speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(usize)]
#[non_exhaustive]
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
    /// Start $\Omega_{s,2}$ of the upper simple region, for $\beta < 1$ (E9).
    UpperSirStart,
    /// Start $\Omega_c$ of the combination region, Eq. (16).
    CirStart,
    /// Width $\lambda_s$ of the simple region, Eq. (31).
    SirWidth,
    /// Width $\lambda_{s,2}$ of the upper simple region, Eq. (31).
    UpperSirWidth,
    /// Width $\lambda_c$ of the combination region, Eq. (31).
    CirWidth,
    /// Disk asymmetry that closes the simple region, Eq. (32).
    SirZupAsymmetry,
    /// Disk asymmetry that closes the upper simple region, Eq. (32).
    UpperSirZupAsymmetry,
    /// Disk asymmetry that closes the combination region, Eq. (32).
    CirZupAsymmetry,
    /// Exact lower end of the simple region.
    SirExactLower,
    /// Exact upper end of the simple region.
    SirExactUpper,
    /// Exact lower end of the upper simple region.
    UpperSirExactLower,
    /// Exact upper end of the upper simple region.
    UpperSirExactUpper,
    /// Exact lower end of the combination region.
    CirExactLower,
    /// Exact upper end of the combination region.
    CirExactUpper,
    /// Exact growth rate at a speed.
    GrowthRate,
}

/// What a quantity describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Subject {
    /// The rotor itself: a column of the chain of equations.
    Plain,
    /// An instability region, and what is measured of it.
    Region(RegionKind, Measure),
    /// The rotor at a speed: the exact growth rate.
    AtSpeed,
}

/// What is measured of an instability region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Measure {
    /// Where it starts, Eqs. (15), (16).
    Start,
    /// How wide it is, Eq. (31).
    Width,
    /// The disk asymmetry that closes it, Eq. (32).
    ZupAsymmetry,
    /// Its exact lower end.
    ExactLower,
    /// Its exact upper end.
    ExactUpper,
}

/// Subject, name, symbol, unit, description.
type Row = (
    Quantity,
    Subject,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
);

/// One row for each quantity, in the order of the variants. A quantity that is not found by iteration has the name of its column
/// in the chain of equations.
#[rustfmt::skip]
const TABLE: [Row; 27] = [
    (Quantity::C11, Plain, "c11", "c₁₁", "m/N", "shear compliance of the crack along its depth, Eq. (8a)"),
    (Quantity::C22, Plain, "c22", "c₂₂", "m/N", "shear compliance of the crack along its edge, Eq. (8b)"),
    (Quantity::C33, Plain, "c33", "c₃₃", "rad/(N m)", "bending compliance of the crack that opens its whole edge, Eq. (8c)"),
    (Quantity::C44, Plain, "c44", "c₄₄", "rad/(N m)", "bending compliance of the crack that opens one half of its edge, Eq. (8d)"),
    (Quantity::ReferenceSpeed, Plain, "reference_speed", "ω_st", "rad/s", "reference speed √(k_tt/m_d)"),
    (Quantity::Beta, Plain, "beta", "β", "", "inertia ratio I_p/I_d"),
    (Quantity::Gamma, Plain, "gamma", "γ", "", "mean coupling stiffness"),
    (Quantity::Delta, Plain, "delta", "δ", "", "mean tilting stiffness"),
    (Quantity::Epsilon1, Plain, "epsilon_1", "ε₁", "", "relative variation of the transverse stiffness"),
    (Quantity::Epsilon12, Plain, "epsilon_12", "ε₁₂", "", "relative variation of the coupling stiffness"),
    (Quantity::Epsilon2, Plain, "epsilon_2", "ε₂", "", "relative variation of the tilting stiffness"),
    (Quantity::SirStart, Region(Simple, Start), "sir_start", "Ω_s", TIMES_REFERENCE_SPEED, "start of the simple instability region, Eq. (15)"),
    (Quantity::UpperSirStart, Region(UpperSimple, Start), "upper_sir_start", "Ω_s,2", TIMES_REFERENCE_SPEED, "start of the upper simple instability region, for β < 1 (E9)"),
    (Quantity::CirStart, Region(Combination, Start), "cir_start", "Ω_c", TIMES_REFERENCE_SPEED, "start of the combination instability region, Eq. (16)"),
    (Quantity::SirWidth, Region(Simple, Width), "sir_width", "λ_s", TIMES_REFERENCE_SPEED, "width of the simple instability region, Eq. (31)"),
    (Quantity::UpperSirWidth, Region(UpperSimple, Width), "upper_sir_width", "λ_s,2", TIMES_REFERENCE_SPEED, "width of the upper simple instability region, Eq. (31)"),
    (Quantity::CirWidth, Region(Combination, Width), "cir_width", "λ_c", TIMES_REFERENCE_SPEED, "width of the combination instability region, Eq. (31)"),
    (Quantity::SirZupAsymmetry, Region(Simple, ZupAsymmetry), "sir_zup_asymmetry", "Δ_d,s", "", "disk asymmetry that closes the simple region at φ = π/2, Eq. (32)"),
    (Quantity::UpperSirZupAsymmetry, Region(UpperSimple, ZupAsymmetry), "upper_sir_zup_asymmetry", "Δ_d,s,2", "", "disk asymmetry that closes the upper simple region at φ = π/2, Eq. (32)"),
    (Quantity::CirZupAsymmetry, Region(Combination, ZupAsymmetry), "cir_zup_asymmetry", "Δ_d,c", "", "disk asymmetry that closes the combination region at φ = 0, Eq. (32)"),
    (Quantity::SirExactLower, Region(Simple, ExactLower), "sir_exact_lower", "Ω_s,lower", TIMES_REFERENCE_SPEED, "exact lower end of the simple instability region"),
    (Quantity::SirExactUpper, Region(Simple, ExactUpper), "sir_exact_upper", "Ω_s,upper", TIMES_REFERENCE_SPEED, "exact upper end of the simple instability region"),
    (Quantity::UpperSirExactLower, Region(UpperSimple, ExactLower), "upper_sir_exact_lower", "Ω_s,2,lower", TIMES_REFERENCE_SPEED, "exact lower end of the upper simple instability region"),
    (Quantity::UpperSirExactUpper, Region(UpperSimple, ExactUpper), "upper_sir_exact_upper", "Ω_s,2,upper", TIMES_REFERENCE_SPEED, "exact upper end of the upper simple instability region"),
    (Quantity::CirExactLower, Region(Combination, ExactLower), "cir_exact_lower", "Ω_c,lower", TIMES_REFERENCE_SPEED, "exact lower end of the combination instability region"),
    (Quantity::CirExactUpper, Region(Combination, ExactUpper), "cir_exact_upper", "Ω_c,upper", TIMES_REFERENCE_SPEED, "exact upper end of the combination instability region"),
    (Quantity::GrowthRate, AtSpeed, "growth_rate", "μ", TIMES_REFERENCE_SPEED, "exact growth rate at a speed, 0 where the motion is stable"),
];

/// The column of each quantity in the chain of equations, by its name.
const COLUMNS: [Option<Column>; TABLE.len()] = {
    let mut columns = [None; TABLE.len()];
    let mut row = 0;
    while row < TABLE.len() {
        let mut place = 0;
        while place < Column::ALL.len() {
            if is_same(TABLE[row].2, Column::ALL[place].name()) {
                columns[row] = Some(Column::ALL[place]);
            }
            place += 1;
        }
        row += 1;
    }
    columns
};

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
        self.row().2
    }

    /// The symbol, such as `λ_s`.
    pub const fn symbol(self) -> &'static str {
        self.row().3
    }

    /// The unit, empty where there is none.
    pub const fn unit(self) -> &'static str {
        self.row().4
    }

    /// What it is, in a few words, with its equation.
    pub const fn description(self) -> &'static str {
        self.row().5
    }

    /// What it is of.
    pub const fn subject(self) -> Subject {
        self.row().1
    }

    /// The instability region that it is of.
    pub const fn region(self) -> Option<RegionKind> {
        match self.subject() {
            Subject::Region(region, _) => Some(region),
            Subject::Plain | Subject::AtSpeed => None,
        }
    }

    /// Whether it is positive wherever it exists and is not at the edge of what it can be.
    pub(crate) const fn is_positive(self) -> bool {
        match self.subject() {
            Subject::Region(_, measure) => !matches!(measure, Measure::ZupAsymmetry),
            Subject::Plain => matches!(self, Self::ReferenceSpeed),
            Subject::AtSpeed => false,
        }
    }

    /// The column of the chain of equations that it is, unless it is found by iteration.
    pub(crate) const fn column(self) -> Option<Column> {
        COLUMNS[self as usize]
    }

    /// Whether it is at a speed, and not of the rotor alone.
    pub const fn needs_speed(self) -> bool {
        matches!(self.subject(), Subject::AtSpeed)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Quantity {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
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
        Err(InputError::UnknownQuantity {
            found: text.to_owned(),
            nearest,
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
        assert!(
            error
                .to_string()
                .starts_with("there is no quantity \"sir_with\"; the nearest are sir_width, ")
        );
    }
}
