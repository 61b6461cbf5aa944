//! A rotor's TOML file: read with every mistake shown at its line, and written with comments.
//!
//! The sections and keys are those of [`INPUTS`]: `disk_mass` is `mass` under `[disk]`. All twelve numbers must be
//! there, integers are taken as floats, `crack.model` and `crack.edge` have the library's defaults.

mod diagnostic;
mod template;

use std::fs::File;
use std::io::{self, Read as _};
use std::ops::Range;
use std::path::Path;

use rotor_core::input::{
    CrackEdge, CrackModel, INPUTS, NumericInput, RotorParameters, UnknownChoice,
};
use rotor_core::jeffcott::rotor::{InvalidRotor, Rotor};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::failure::Failure;
use crate::nearest::{input_names, meant, nearest};
use crate::shown::brief;
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
    let (text, name) = read(path)?;
    match parse(&text) {
        Ok(rotor) => Ok(NamedRotor { rotor, name }),
        Err(mistakes) => Err(Failure::rendered(draw(&text, &name, &mistakes))),
    }
}

/// The inputs that stand in for those without a column: of a file, of standard input (`-`), or the paper's. What is
/// said of the `replaced` ones does not matter.
///
/// # Errors
///
/// Where the file cannot be read, or no column can make it a rotor.
pub(crate) fn load_base(
    path: Option<&Path>,
    replaced: &[&'static str],
) -> Result<RotorParameters, Failure> {
    let Some(path) = path else {
        return Ok(RotorParameters::PAPER);
    };
    let (text, name) = read(path)?;
    parse_without(&text, replaced)
        .map_err(|mistakes| Failure::rendered(draw(&text, &name, &mistakes)))
}

/// A rotor file has a few hundred bytes; this much is something else.
const LONGEST: u64 = 1 << 20;

/// The text of a file, and what to call it.
fn read(path: &Path) -> Result<(String, String), Failure> {
    let mut bytes = Vec::new();
    let name = if path.as_os_str() == "-" {
        let name = "standard input".to_owned();
        let mut taken = io::stdin().lock().take(LONGEST + 1);
        taken
            .read_to_end(&mut bytes)
            .map_err(|source| Failure::stream("read", &name, source))?;
        name
    } else {
        File::open(path)
            .and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes))
            .map_err(|source| Failure::file("read", path, source))?;
        brief(&path.display().to_string())
    };
    if bytes.len() as u64 > LONGEST {
        return Err(Failure::input(format!(
            "`{name}` is longer than {LONGEST} bytes; this is no rotor file"
        )));
    }
    Ok((decode(bytes, &name)?, name))
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
    let reading = Reading::of(text, &[])?;
    Rotor::new(reading.parameters).map_err(|invalid| vec![reading.invalid(&invalid)])
}

/// The inputs that a text gives, where those `replaced` need not be given, and may be anything.
///
/// # Errors
///
/// Every mistake in the other ones.
fn parse_without(text: &str, replaced: &[&'static str]) -> Result<RotorParameters, Vec<Mistake>> {
    let reading = Reading::of(text, replaced)?;
    match Rotor::new(reading.parameters) {
        // Whether the two inertias go together is then a matter of each row.
        Err(InvalidRotor::InertiaRatio { .. })
            if INERTIAS.iter().any(|name| replaced.contains(name)) =>
        {
            Ok(reading.parameters)
        }
        Err(invalid) => Err(vec![reading.invalid(&invalid)]),
        Ok(_) => Ok(reading.parameters),
    }
}

/// The inputs that must go together.
const INERTIAS: [&str; 2] = ["disk_polar_inertia", "disk_diametral_inertia"];

/// What has been found so far.
struct Reading<'a> {
    parameters: RotorParameters,
    replaced: &'a [&'static str],
    given: Vec<(&'static str, Range<usize>)>,
    /// Inputs that a mistake speaks of already: they are not missing, too.
    excused: Vec<&'static str>,
    /// The headers of the sections.
    headers: Vec<(&'static str, Range<usize>)>,
    /// The keys of sections whose header is not there.
    headless: Vec<(&'static str, String, Range<usize>)>,
    mistakes: Vec<Mistake>,
}

impl<'a> Reading<'a> {
    /// Reads a text.
    ///
    /// # Errors
    ///
    /// Every mistake in it but those of inputs together.
    fn of(text: &str, replaced: &'a [&'static str]) -> Result<Self, Vec<Mistake>> {
        let (table, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            return Err(errors
                .iter()
                .map(|error| Mistake::syntax(error, text.len()))
                .collect());
        }
        let mut reading = Self {
            parameters: RotorParameters::PAPER,
            replaced,
            given: Vec::new(),
            excused: Vec::new(),
            headers: Vec::new(),
            headless: Vec::new(),
            mistakes: Vec::new(),
        };
        let table = table.get_ref();
        for (name, _) in table {
            let known = SECTIONS.iter().find(|section| *section == name.get_ref());
            reading
                .headers
                .extend(known.map(|section| (*section, name.span())));
        }
        reading.sections(table);
        reading.remark_on_headless();
        reading.remark_on_missing();
        if reading.mistakes.is_empty() {
            return Ok(reading);
        }
        reading.mistakes.sort_by_key(Mistake::place);
        Err(reading.mistakes)
    }

    fn sections(&mut self, table: &DeTable<'_>) {
        for (section, value) in table {
            let name = section.get_ref().as_ref();
            if !SECTIONS.contains(&name) {
                self.no_section(name, section.span(), value.get_ref());
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

    /// A name beside the sections.
    fn no_section(&mut self, name: &str, span: Range<usize>, value: &DeValue<'_>) {
        let is_table = matches!(value, DeValue::Table(_));
        match self.headless_section(name) {
            Some(section) if !is_table => {
                self.headless.push((section, name.to_owned(), span));
                return;
            }
            _ => {}
        }
        if let Some(section) = nearest(name, SECTIONS.into_iter()).filter(|_| is_table) {
            self.excuse(|input| input.section == section);
        }
        self.excuse(|input| input.name == name);
        self.mistakes
            .push(Mistake::unknown_section(name, span, &SECTIONS));
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
            match (number, choice, self.headless_section(key_name)) {
                (Some(input), ..) => self.number(input, value),
                (None, Some((name, ..)), _) => self.choice(name, value),
                (None, None, Some(section)) => {
                    self.headless
                        .push((section, key_name.to_owned(), key.span()));
                }
                (None, None, None) => {
                    let names: Vec<_> = meant(key_name, Some(section))
                        .iter()
                        .map(|input| input.name)
                        .collect();
                    self.excuse(|input| names.contains(&input.name));
                    self.mistakes
                        .push(Mistake::unknown_key(section, key_name, key.span()));
                }
            }
        }
    }

    /// The section of a key whose header the file lacks.
    fn headless_section(&self, key: &str) -> Option<&'static str> {
        input_names()
            .filter(|input| input.key == key)
            .map(|input| input.section)
            .find(|section| !self.headers.iter().any(|(header, _)| header == section))
    }

    fn excuse(&mut self, which: impl Fn(&NumericInput) -> bool) {
        let names = INPUTS
            .iter()
            .filter(|input| which(input))
            .map(|input| input.name);
        self.excused.extend(names);
    }

    /// One mistake for the keys of each section without its header.
    fn remark_on_headless(&mut self) {
        for section in SECTIONS {
            let keys: Vec<_> = self
                .headless
                .iter()
                .filter(|(of, ..)| *of == section)
                .cloned()
                .collect();
            if let Some((_, first, span)) = keys.iter().min_by_key(|(.., span)| span.start) {
                self.mistakes
                    .push(Mistake::no_header(section, first, span.clone()));
                self.excuse(|input| input.section == section);
            }
        }
    }

    /// One mistake for the missing inputs of each section, one for all missing sections.
    fn remark_on_missing(&mut self) {
        let missing: Vec<_> = INPUTS
            .iter()
            .filter(|input| !self.given.iter().any(|(name, _)| *name == input.name))
            .filter(|input| !self.excused.contains(&input.name))
            .filter(|input| !self.replaced.contains(&input.name))
            .collect();
        let mut absent = Vec::new();
        for section in SECTIONS {
            let keys: Vec<_> = missing
                .iter()
                .filter(|input| input.section == section)
                .map(|input| input.key)
                .collect();
            let header = self.headers.iter().find(|(header, _)| *header == section);
            match header {
                _ if keys.is_empty() => {}
                Some((_, span)) => {
                    self.mistakes
                        .push(Mistake::missing(section, &keys, span.clone()))
                }
                None => absent.push(section),
            }
        }
        if !absent.is_empty() {
            self.mistakes.push(Mistake::no_sections(&absent));
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
            _ if self.replaced.contains(&input.name) => {}
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

    /// A mistake of several inputs together, shown at the first of them.
    fn invalid(&self, invalid: &InvalidRotor) -> Mistake {
        let name = match invalid {
            InvalidRotor::OutOfRange { input, .. } => input.name,
            InvalidRotor::InertiaRatio { .. } => INERTIAS[0],
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
) -> Result<(), UnknownChoice> {
    let result = match name {
        "crack_edge" => text
            .parse::<CrackEdge>()
            .map(|edge| parameters.crack_edge = edge),
        _ => text
            .parse::<CrackModel>()
            .map(|model| parameters.crack_model = model),
    };
    result.map_err(|unknown| UnknownChoice {
        found: brief(&unknown.found),
        ..unknown
    })
}
