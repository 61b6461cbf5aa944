//! A rotor's TOML file: read with every mistake found, and written with comments.
//!
//! The sections and keys are those of [`INPUTS`](crate::input::INPUTS): `disk_mass` is `mass` under `[disk]`. All twelve
//! numbers must be there, integers are taken as floats, `crack.model` and `crack.edge` have the library's defaults. A
//! [`Mistake`] says where it is, what was found and what is allowed; how it is drawn is its reader's business.
//!
//! ```
//! use rotor_core::file::{self, MistakeKind};
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! let text = file::template();
//! assert_eq!(file::parse(&text), Ok(Rotor::paper()));
//!
//! let mistakes = file::parse(&text.replace("mass =", "mas =")).unwrap_err();
//! assert!(matches!(&mistakes[0].kind, MistakeKind::UnknownKey { found, .. } if found == "mas"));
//! assert_eq!(mistakes[0].help().as_deref(), Some("did you mean `mass`?"));
//! ```

mod mistake;
mod reading;
mod template;

use crate::error::InputError;
use crate::input::RotorParameters;
use crate::jeffcott::rotor::Rotor;
use reading::Reading;

pub use mistake::{Expected, Mistake, MistakeKind};
pub use template::template;

/// The sections of a file, in the order in which they are written.
pub const SECTIONS: [&str; 3] = ["disk", "shaft", "crack"];

/// The inputs that must go together.
const INERTIAS: [&str; 2] = ["disk_polar_inertia", "disk_diametral_inertia"];

/// The rotor that a text describes.
///
/// # Errors
///
/// Every mistake in it, in the order of the text; those without a place come last.
pub fn parse(text: &str) -> Result<Rotor, Vec<Mistake>> {
    let reading = Reading::of(text, &[])?;
    Rotor::new(reading.parameters).map_err(|invalid| vec![reading.invalid(invalid)])
}

/// The inputs that a text gives, where those `replaced`, such as `disk_mass`, need not be given, and may be anything.
///
/// # Errors
///
/// Every mistake in the other ones, as [`parse`].
pub fn parse_base(text: &str, replaced: &[&str]) -> Result<RotorParameters, Vec<Mistake>> {
    let reading = Reading::of(text, replaced)?;
    match Rotor::new(reading.parameters) {
        // Whether the two inertias go together is then known only with what replaces one of them.
        Err(InputError::InertiaRatio { .. })
            if INERTIAS.iter().any(|name| replaced.contains(name)) =>
        {
            Ok(reading.parameters)
        }
        Err(invalid) => Err(vec![reading.invalid(invalid)]),
        Ok(_) => Ok(reading.parameters),
    }
}
