//! What an axis varies.

use crate::input::{Allowed, Bound, NumericInput, RotorParameters};
use crate::unit::TIMES_REFERENCE_SPEED;

/// What varies along an axis: an input of the rotor, or the speed at which it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variable {
    /// An input of the rotor.
    Input(&'static NumericInput),
    /// The speed $\Omega$ in units of each rotor's own reference speed $\omega_{st}$, for quantities that
    /// [need one](crate::quantity::Quantity::needs_speed).
    Speed,
}

impl Variable {
    /// The variable of a name such as `disk_mass`, `disk.mass` or `speed`.
    pub fn find(name: &str) -> Option<Self> {
        match name {
            "speed" => Some(Self::Speed),
            _ => NumericInput::find(name).map(Self::Input),
        }
    }

    /// The one name, such as `disk_mass`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Input(input) => input.name,
            Self::Speed => "speed",
        }
    }

    /// The name on the command line, such as `disk.mass`.
    pub fn dotted_name(self) -> String {
        match self {
            Self::Input(input) => format!("{}.{}", input.section, input.key),
            Self::Speed => self.name().to_owned(),
        }
    }

    /// The symbol in the paper, such as `m_d`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Input(input) => input.symbol,
            Self::Speed => "Ω",
        }
    }

    /// The unit, empty where there is none.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Input(input) => input.unit,
            Self::Speed => TIMES_REFERENCE_SPEED,
        }
    }

    /// What it is, in a few words.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Input(input) => input.description,
            Self::Speed => "speed at which the rotor runs",
        }
    }

    /// The values it allows.
    pub const fn allowed(self) -> Allowed {
        match self {
            Self::Input(input) => input.allowed,
            Self::Speed => Allowed {
                lower: Bound::Excluded(0.0),
                upper: Bound::Finite,
            },
        }
    }

    /// Writes it where it belongs.
    pub(crate) fn set(self, parameters: &mut RotorParameters, speed: &mut Option<f64>, value: f64) {
        match self {
            Self::Input(input) => (input.set)(parameters, value),
            Self::Speed => *speed = Some(value),
        }
    }
}

impl From<&'static NumericInput> for Variable {
    fn from(input: &'static NumericInput) -> Self {
        Self::Input(input)
    }
}
