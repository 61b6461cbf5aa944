//! What a crack is like, apart from its numbers.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::RotorParameters;
use crate::text::brief;

/// How the crack's compliance enters the shaft's flexibility, Eq. (6), with E3 of the
/// [corrections](crate::corrections).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum CrackModel {
    /// Eq. (6) with the lever arm $-l_c$. Reproduces the zero unstable points of Section 4.
    #[default]
    SupportArm,
    /// Eq. (6) as printed, with the lever arm $L/2 - l_c$.
    MidspanArm,
    /// Statics of the simply supported beam: the crack bends and shears as its section does.
    SimplySupported,
}

impl CrackModel {
    /// Every model, the default first.
    pub const ALL: [Self; 3] = [Self::SupportArm, Self::MidspanArm, Self::SimplySupported];

    /// The name used in files, tables and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SupportArm => "support-arm",
            Self::MidspanArm => "midspan-arm",
            Self::SimplySupported => "simply-supported",
        }
    }
}

/// How much of the crack's edge the lateral moment opens: the factor of $c_{44}$ in Eq. (8d), E6.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum CrackEdge {
    /// The half that the moment opens, factor 32, as in the paper.
    #[default]
    Half,
    /// Both halves, factor 64: a crack that stays open.
    Full,
}

impl CrackEdge {
    /// Both choices, the default first.
    pub const ALL: [Self; 2] = [Self::Half, Self::Full];

    /// The name used in files, tables and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Half => "half",
            Self::Full => "full",
        }
    }

    /// The factor of $c_{44}$ in Eq. (8d).
    pub const fn factor(self) -> f64 {
        match self {
            Self::Half => 32.0,
            Self::Full => 64.0,
        }
    }
}

impl fmt::Display for CrackModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for CrackEdge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is none of the choices of an input.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{input} is \"{}\"; it must be one of {allowed}", brief(.found))]
pub struct UnknownChoice {
    /// The input, such as `crack_model`.
    pub input: &'static str,
    /// What was given.
    pub found: String,
    /// The choices, separated by commas.
    pub allowed: String,
}

impl RotorParameters {
    /// Sets an input that is a [choice](super::name::CHOICES), by its name and the name of what is chosen.
    ///
    /// # Errors
    /// Where the text is none of the choices.
    pub fn set_choice(&mut self, name: &str, text: &str) -> Result<(), UnknownChoice> {
        match name {
            "crack_edge" => self.crack_edge = text.parse()?,
            _ => self.crack_model = text.parse()?,
        }
        Ok(())
    }
}

impl FromStr for CrackModel {
    type Err = UnknownChoice;

    fn from_str(text: &str) -> Result<Self, UnknownChoice> {
        choose("crack_model", text, &Self::ALL, |model| model.name())
    }
}

impl FromStr for CrackEdge {
    type Err = UnknownChoice;

    fn from_str(text: &str) -> Result<Self, UnknownChoice> {
        choose("crack_edge", text, &Self::ALL, |edge| edge.name())
    }
}

fn choose<T: Copy>(
    input: &'static str,
    text: &str,
    all: &[T],
    name: impl Fn(T) -> &'static str,
) -> Result<T, UnknownChoice> {
    all.iter()
        .copied()
        .find(|&choice| name(choice) == text)
        .ok_or_else(|| UnknownChoice {
            input,
            found: text.to_owned(),
            allowed: all
                .iter()
                .map(|&choice| name(choice))
                .collect::<Vec<_>>()
                .join(", "),
        })
}
