//! What is wrong in a rotor file, as data, and how it is told.

use std::fmt;
use std::ops::Range;

use thiserror::Error;

use super::SECTIONS;
use crate::error::InputError;
use crate::input::name::{InputName, input_names};
use crate::input::{NumericInput, UnknownChoice};
use crate::text::{brief, shortened, shortest, significant};

/// One mistake in a file. Its `Display` is a title; [`label`](Self::label) stands beside what is marked, and
/// [`help`](Self::help) below.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{kind}")]
#[non_exhaustive]
pub struct Mistake {
    /// What is wrong.
    pub kind: MistakeKind,
    /// The bytes of the text that it is about, where they are there.
    pub span: Option<Range<usize>>,
}

/// What can be wrong in a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MistakeKind {
    /// The text is no TOML.
    Syntax {
        /// What the parser says.
        message: String,
    },
    /// A section, or a key outside of any section, that no rotor has.
    UnknownSection {
        /// Its name.
        found: String,
        /// The input that has this name in tables, such as `disk_mass`.
        input: Option<InputName>,
        /// The section nearest to it, if one is near.
        nearest: Option<&'static str>,
    },
    /// A key of a section whose header is not there.
    MissingHeader {
        /// The section.
        section: &'static str,
        /// The key.
        key: String,
    },
    /// Sections of which nothing is there.
    MissingSections {
        /// All of them.
        sections: Vec<&'static str>,
    },
    /// Keys that a section does not give.
    MissingKeys {
        /// The section.
        section: &'static str,
        /// All of them.
        keys: Vec<&'static str>,
    },
    /// A key that its section does not have.
    UnknownKey {
        /// The section.
        section: &'static str,
        /// The key.
        found: String,
        /// The inputs that were probably meant, of this section or of others.
        meant: Vec<InputName>,
    },
    /// A value of another type than it must have.
    WrongType {
        /// The input, such as `disk.mass`, or the section.
        name: String,
        /// What it must be.
        expected: Expected,
        /// The type in the file, as TOML calls it.
        found: &'static str,
    },
    /// A number outside the values that its input allows.
    NotAllowed {
        /// The input.
        input: &'static NumericInput,
        /// The number, NaN where it is none.
        value: f64,
    },
    /// A text that is none of the choices of an input.
    UnknownChoice {
        /// What was found, and what is allowed.
        unknown: UnknownChoice,
        /// The choice nearest to it, if one is near.
        nearest: Option<String>,
    },
    /// Inputs that are each allowed, but not together.
    Invalid(InputError),
}

/// What a value in a file must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Expected {
    /// A table.
    Section,
    /// An integer or a float.
    Number,
    /// A string.
    Text,
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Section => "a section",
            Self::Number => "a number",
            Self::Text => "a text in quotes",
        })
    }
}

/// An unknown choice is shown with at most so many of its letters: the choices follow on the same line.
const LONGEST_CHOICE: usize = 14;

/// What a number must be; of one that is not finite this has to be said, too.
fn allowed(input: &NumericInput, value: f64) -> String {
    match input.allowed.to_string() {
        allowed if value.is_finite() || allowed == "finite" => allowed,
        allowed => format!("finite and {allowed}"),
    }
}

impl fmt::Display for MistakeKind {
    /// The title.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax { .. } => f.write_str("this is not TOML"),
            Self::UnknownSection { found, .. } => {
                write!(f, "unknown section or key `{}`", brief(found))
            }
            Self::MissingHeader { section, .. } => write!(f, "the header `[{section}]` is missing"),
            Self::MissingSections { sections } => {
                let names: Vec<_> = sections.iter().map(|name| format!("`[{name}]`")).collect();
                let (what, verb) = match names.len() {
                    1 => ("section", "is"),
                    _ => ("sections", "are"),
                };
                write!(f, "the {what} {} {verb} missing", names.join(", "))
            }
            Self::MissingKeys { section, keys } => match keys.as_slice() {
                [key] => write!(f, "{section}.{key} is missing"),
                _ => write!(f, "[{section}] lacks {}", keys.join(", ")),
            },
            Self::UnknownKey { section, found, .. } => {
                write!(f, "unknown key `{}` in [{section}]", brief(found))
            }
            Self::WrongType { name, expected, .. } => write!(f, "`{name}` is not {expected}"),
            Self::NotAllowed { input, value } => {
                let (name, unit, allowed) = (input.name, input.unit, allowed(input, *value));
                let space = if unit.is_empty() { "" } else { " " };
                write!(f, "{name} is {value}{space}{unit}; it must be {allowed}")
            }
            Self::UnknownChoice { unknown, .. } => {
                let found = shortened(&brief(&unknown.found), LONGEST_CHOICE);
                let told = UnknownChoice {
                    found,
                    ..unknown.clone()
                };
                write!(f, "{told}")
            }
            Self::Invalid(InputError::InertiaRatio { beta, .. }) => write!(
                f,
                "beta = disk_polar_inertia / disk_diametral_inertia is {}; it must be > 0 and <= 2",
                significant(*beta, 6)
            ),
            Self::Invalid(invalid) => write!(f, "{invalid}"),
        }
    }
}

impl Mistake {
    /// Where it stands in the file; mistakes without a place come last.
    pub(super) fn place(&self) -> usize {
        self.span.as_ref().map_or(usize::MAX, |span| span.start)
    }

    /// What is said beside the bytes that are marked.
    #[must_use]
    pub fn label(&self) -> String {
        match &self.kind {
            MistakeKind::Syntax { message } => message.trim_end().replace('\n', "; "),
            MistakeKind::UnknownSection { .. } | MistakeKind::UnknownKey { .. } => {
                "no rotor has this".to_owned()
            }
            MistakeKind::MissingHeader { key, .. } => format!("`{key}` belongs under it"),
            MistakeKind::MissingSections { .. } => "here".to_owned(),
            MistakeKind::MissingKeys { .. } => "in this section".to_owned(),
            MistakeKind::WrongType { found, .. } => format!("this is of type {found}"),
            MistakeKind::NotAllowed { input, value } => {
                format!("must be {}", allowed(input, *value))
            }
            MistakeKind::UnknownChoice { .. } => "none of the choices".to_owned(),
            MistakeKind::Invalid(_) => "with this".to_owned(),
        }
    }

    /// What would be right, where that can be said.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match &self.kind {
            MistakeKind::UnknownSection { input, nearest, .. } => match (input, nearest) {
                (Some(input), _) => format!("write `{}` under `[{}]`", input.key, input.section),
                (None, Some(section)) => format!("did you mean `{section}`?"),
                (None, None) => format!("the sections are {}", SECTIONS.join(", ")),
            },
            MistakeKind::MissingHeader { section, .. } => {
                format!("write `[{section}]` on a line of its own above")
            }
            MistakeKind::UnknownKey {
                section,
                found,
                meant,
            } => help_with_key(section, found, meant),
            MistakeKind::WrongType {
                name,
                expected: Expected::Section,
                ..
            } => format!("write `[{name}]` on a line of its own, its keys below"),
            MistakeKind::WrongType {
                expected: Expected::Number,
                found: "string",
                ..
            } => "write the number without quotes".to_owned(),
            MistakeKind::UnknownChoice { nearest, .. } => {
                format!("did you mean \"{}\"?", nearest.as_ref()?)
            }
            MistakeKind::Invalid(InputError::InertiaRatio {
                disk_polar_inertia,
                disk_diametral_inertia,
                ..
            }) => format!(
                "it is {} kg m² / {} kg m²; no rigid body has more than 2",
                shortest(*disk_polar_inertia),
                shortest(*disk_diametral_inertia)
            ),
            _ => return None,
        })
    }
}

/// What was meant by a key that its section does not have.
fn help_with_key(section: &str, found: &str, meant: &[InputName]) -> String {
    match meant {
        [] => {
            let keys = input_names().filter(|input| input.section == section);
            let keys: Vec<_> = keys.map(|input| input.key).collect();
            format!("the keys of [{section}] are {}", keys.join(", "))
        }
        [input] if input.key == found => format!("`{found}` belongs under `[{}]`", input.section),
        [input] if input.section != section => {
            format!("did you mean `{}` under `[{}]`?", input.key, input.section)
        }
        inputs => {
            let names = inputs.iter().map(|input| format!("`{}`", input.key));
            format!("did you mean {}?", names.collect::<Vec<_>>().join(" or "))
        }
    }
}
