//! A rotor's TOML file: read with every mistake shown at its line, and written with comments.
//!
//! The sections and keys are those of [`INPUTS`]: `disk_mass` is `mass` under `[disk]`. All twelve numbers must be
//! there, integers are taken as floats, `crack.model` and `crack.edge` have the library's defaults.

mod diagnostic;
mod template;

use std::fs;
use std::io::{self, Read as _};
use std::ops::Range;
use std::path::Path;

use rotor_core::rotor::{
    CrackEdge, CrackModel, INPUTS, InvalidRotor, NumericInput, Rotor, RotorParameters,
};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::failure::Failure;
pub(crate) use diagnostic::nearest;
use diagnostic::{Mistake, draw};
pub(crate) use template::template;

/// The sections of a file.
const SECTIONS: [&str; 3] = ["disk", "shaft", "crack"];
/// The inputs that are a choice, and may be left out.
pub(crate) const CHOICES: [(&str, &str, &str); 2] = [
    ("crack_model", "crack", "model"),
    ("crack_edge", "crack", "edge"),
];

/// A rotor and what to call it in a report.
#[derive(Clone, Debug)]
pub(crate) struct NamedRotor {
    /// The validated rotor.
    pub(crate) rotor: Rotor,
    /// `the paper's rotor`, or the file's name.
    pub(crate) name: String,
}

/// Reads the rotor of a file, of standard input (`-`), or the paper's rotor where there is no file.
///
/// # Errors
///
/// Where the file cannot be read or describes no rotor; every mistake is shown, each at its line.
pub(crate) fn load(path: Option<&Path>) -> Result<NamedRotor, Failure> {
    let Some(path) = path else {
        return Ok(NamedRotor {
            rotor: Rotor::default(),
            name: "the paper's rotor".to_owned(),
        });
    };
    let (bytes, name) = if path.as_os_str() == "-" {
        let mut bytes = Vec::new();
        io::stdin()
            .lock()
            .read_to_end(&mut bytes)
            .map_err(|source| Failure::stream("read", "standard input", source))?;
        (bytes, "standard input".to_owned())
    } else {
        (
            fs::read(path).map_err(|source| Failure::file("read", path, source))?,
            path.display().to_string(),
        )
    };
    let text = decode(bytes, &name)?;
    match parse(&text) {
        Ok(rotor) => Ok(NamedRotor { rotor, name }),
        Err(mistakes) => Err(Failure::rendered(draw(&text, &name, &mistakes))),
    }
}

fn decode(bytes: Vec<u8>, name: &str) -> Result<String, Failure> {
    let mut text = String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
        let hint = match error.as_bytes() {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => " (it is UTF-16)",
            _ => "",
        };
        Failure::input(format!(
            "`{name}` is not UTF-8{hint}: line {line}; save it as UTF-8"
        ))
    })?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

/// The rotor that a text describes.
///
/// # Errors
///
/// Every mistake in it.
fn parse(text: &str) -> Result<Rotor, Vec<Mistake>> {
    let (table, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(errors
            .iter()
            .map(|error| Mistake::syntax(error, text.len()))
            .collect());
    }
    let mut reading = Reading::default();
    reading.sections(table.get_ref());
    reading.finish()
}

/// What has been found so far.
struct Reading {
    parameters: RotorParameters,
    given: Vec<(&'static str, Range<usize>)>,
    mistakes: Vec<Mistake>,
}

impl Default for Reading {
    fn default() -> Self {
        Self {
            parameters: RotorParameters::PAPER,
            given: Vec::new(),
            mistakes: Vec::new(),
        }
    }
}

impl Reading {
    fn sections(&mut self, table: &DeTable<'_>) {
        for (section, value) in table {
            let name = section.get_ref().as_ref();
            if !SECTIONS.contains(&name) {
                self.mistakes
                    .push(Mistake::unknown_section(name, section.span(), &SECTIONS));
                continue;
            }
            match value.get_ref() {
                DeValue::Table(keys) => self.keys(name, keys),
                other => self.mistakes.push(Mistake::wrong_type(
                    name,
                    "a section",
                    other.type_str(),
                    value.span(),
                    Some(format!(
                        "write `[{name}]` on a line of its own, its keys below"
                    )),
                )),
            }
        }
    }

    fn keys(&mut self, section: &str, keys: &DeTable<'_>) {
        for (key, value) in keys {
            let key_name = key.get_ref().as_ref();
            let number = INPUTS
                .iter()
                .find(|input| input.section == section && input.key == key_name);
            let choice = CHOICES
                .iter()
                .find(|choice| choice.1 == section && choice.2 == key_name);
            match (number, choice) {
                (Some(input), _) => self.number(input, value),
                (None, Some((name, ..))) => self.choice(name, value),
                (None, None) => {
                    self.mistakes
                        .push(Mistake::unknown_key(section, key_name, key.span()));
                }
            }
        }
    }

    fn number(&mut self, input: &'static NumericInput, value: &Spanned<DeValue<'_>>) {
        self.given.push((input.name, value.span()));
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .ok()
                .map(|integer| integer as f64),
            other => {
                let help = matches!(other, DeValue::String(_))
                    .then(|| "write the number without quotes".to_owned());
                let name = format!("{}.{}", input.section, input.key);
                self.mistakes.push(Mistake::wrong_type(
                    &name,
                    "a number",
                    other.type_str(),
                    value.span(),
                    help,
                ));
                return;
            }
        };
        match number {
            Some(number) if input.allowed.contains(number) => {
                (input.set)(&mut self.parameters, number)
            }
            Some(number) => self
                .mistakes
                .push(Mistake::not_allowed(input, number, value.span())),
            None => self
                .mistakes
                .push(Mistake::not_allowed(input, f64::NAN, value.span())),
        }
    }

    fn choice(&mut self, name: &str, value: &Spanned<DeValue<'_>>) {
        let DeValue::String(text) = value.get_ref() else {
            let found = value.get_ref().type_str();
            let dotted = name.replacen('_', ".", 1);
            self.mistakes.push(Mistake::wrong_type(
                &dotted,
                "a text in quotes",
                found,
                value.span(),
                None,
            ));
            return;
        };
        if let Err(unknown) = set_choice(&mut self.parameters, name, text) {
            self.mistakes
                .push(Mistake::unknown_choice(&unknown, value.span()));
        }
    }

    fn finish(mut self) -> Result<Rotor, Vec<Mistake>> {
        let missing: Vec<_> = INPUTS
            .iter()
            .filter(|input| !self.given.iter().any(|(name, _)| *name == input.name))
            .collect();
        if !missing.is_empty() {
            self.mistakes.push(Mistake::missing(&missing));
        }
        if !self.mistakes.is_empty() {
            self.mistakes.sort_by_key(Mistake::place);
            return Err(self.mistakes);
        }
        Rotor::new(self.parameters).map_err(|invalid| vec![self.invalid(&invalid)])
    }

    /// A mistake of several inputs together, shown at the first of them.
    fn invalid(&self, invalid: &InvalidRotor) -> Mistake {
        let name = match invalid {
            InvalidRotor::OutOfRange { input, .. } => input.name,
            InvalidRotor::InertiaRatio { .. } => "disk_polar_inertia",
        };
        let span = self
            .given
            .iter()
            .find(|(given, _)| *given == name)
            .map(|(_, span)| span.clone());
        Mistake::invalid(invalid, span)
    }
}

/// Sets an input that is a choice, by its name.
///
/// # Errors
///
/// Where the text is none of the choices.
pub(crate) fn set_choice(
    parameters: &mut RotorParameters,
    name: &str,
    text: &str,
) -> Result<(), rotor_core::rotor::UnknownChoice> {
    match name {
        "crack_edge" => parameters.crack_edge = text.parse::<CrackEdge>()?,
        _ => parameters.crack_model = text.parse::<CrackModel>()?,
    }
    Ok(())
}
