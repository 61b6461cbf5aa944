//! From the text of a rotor file to its inputs, with every mistake on the way.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Expected, INERTIAS, Mistake, MistakeKind, SECTIONS};
use crate::error::InputError;
use crate::input::name::{CHOICES, InputName, input_names, meant, nearest};
use crate::input::{INPUTS, NumericInput, RotorParameters};

/// What has been found so far.
pub(super) struct Reading<'a> {
    pub(super) parameters: RotorParameters,
    replaced: &'a [&'a str],
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
    pub(super) fn of(text: &str, replaced: &'a [&'a str]) -> Result<Self, Vec<Mistake>> {
        let (table, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            return Err(errors.iter().map(|error| no_toml(error, text)).collect());
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

    /// Takes notice of a mistake.
    fn mistake(&mut self, kind: MistakeKind, span: Option<Range<usize>>) {
        self.mistakes.push(Mistake { kind, span });
    }

    fn wrong_type(&mut self, name: String, expected: Expected, value: &Spanned<DeValue<'_>>) {
        let found = value.get_ref().type_str();
        let kind = MistakeKind::WrongType {
            name,
            expected,
            found,
        };
        self.mistake(kind, Some(value.span()));
    }

    fn sections(&mut self, table: &DeTable<'_>) {
        for (section, value) in table {
            let name = section.get_ref().as_ref();
            let known = SECTIONS.into_iter().find(|section| *section == name);
            match (known, value.get_ref()) {
                (None, value) => self.no_section(name, section.span(), value),
                (Some(section), DeValue::Table(keys)) => self.keys(section, keys),
                (Some(_), _) => self.wrong_type(name.to_owned(), Expected::Section, value),
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
        let nearest = nearest(name, SECTIONS.into_iter());
        if let Some(section) = nearest.filter(|_| is_table) {
            self.excuse(|input| input.section == section);
        }
        self.excuse(|input| input.name == name);
        let kind = MistakeKind::UnknownSection {
            found: name.to_owned(),
            input: input_names().find(|input| input.name == name),
            nearest,
        };
        self.mistake(kind, Some(span));
    }

    fn keys(&mut self, section: &'static str, keys: &DeTable<'_>) {
        for (key, value) in keys {
            let name = key.get_ref().as_ref();
            let number = INPUTS
                .iter()
                .find(|input| input.section == section && input.key == name);
            let choice = CHOICES
                .iter()
                .find(|choice| choice.section == section && choice.key == name);
            match (number, choice, self.headless_section(name)) {
                (Some(input), ..) => self.number(input, value),
                (None, Some(choice), _) => self.choice(choice, value),
                (None, None, Some(section)) => {
                    self.headless.push((section, name.to_owned(), key.span()));
                }
                (None, None, None) => self.no_key(section, name, key.span()),
            }
        }
    }

    /// A key that its section does not have.
    fn no_key(&mut self, section: &'static str, key: &str, span: Range<usize>) {
        let here = meant(key, Some(section));
        let names: Vec<_> = here.iter().map(|input| input.name).collect();
        self.excuse(|input| names.contains(&input.name));
        let elsewhere = input_names().find(|input| input.key == key);
        let meant = match (elsewhere, meant(key, None).as_slice()) {
            (Some(input), _) => vec![input],
            (None, &[input]) if here.is_empty() => vec![input],
            (None, _) => here,
        };
        let kind = MistakeKind::UnknownKey {
            section,
            found: key.to_owned(),
            meant,
        };
        self.mistake(kind, Some(span));
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
            if let Some((_, first, span)) = keys.into_iter().min_by_key(|(.., span)| span.start) {
                let key = first;
                self.mistake(MistakeKind::MissingHeader { section, key }, Some(span));
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
            match header.map(|(_, span)| span.clone()) {
                _ if keys.is_empty() => {}
                None => absent.push(section),
                span => self.mistake(MistakeKind::MissingKeys { section, keys }, span),
            }
        }
        if !absent.is_empty() {
            let sections = absent;
            self.mistake(MistakeKind::MissingSections { sections }, None);
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
            _ => {
                let name = format!("{}.{}", input.section, input.key);
                self.wrong_type(name, Expected::Number, value);
                return;
            }
        };
        match number {
            Some(number) if input.allowed.contains(number) => {
                (input.set)(&mut self.parameters, number);
            }
            _ if self.replaced.contains(&input.name) => {}
            other => {
                let span = Some(value.span());
                let value = other.unwrap_or(f64::NAN);
                self.mistake(MistakeKind::NotAllowed { input, value }, span);
            }
        }
    }

    fn choice(&mut self, choice: &InputName, value: &Spanned<DeValue<'_>>) {
        let DeValue::String(text) = value.get_ref() else {
            let name = format!("{}.{}", choice.section, choice.key);
            self.wrong_type(name, Expected::Text, value);
            return;
        };
        if let Err(unknown) = self.parameters.set_choice(choice.name, text) {
            let nearest = nearest(&unknown.found, unknown.allowed.split(", "));
            let nearest = nearest.map(str::to_owned);
            let kind = MistakeKind::UnknownChoice { unknown, nearest };
            self.mistake(kind, Some(value.span()));
        }
    }

    /// A mistake of several inputs together, shown at the first of them.
    pub(super) fn invalid(&self, invalid: InputError) -> Mistake {
        let name = match &invalid {
            InputError::OutOfRange { input, .. } => input.name,
            _ => INERTIAS[0],
        };
        let mut given = self.given.iter();
        let span = given.find(|(given, _)| *given == name);
        Mistake {
            kind: MistakeKind::Invalid(invalid),
            span: span.map(|(_, span)| span.clone()),
        }
    }
}

/// A text that is no TOML.
fn no_toml(error: &toml::de::Error, text: &str) -> Mistake {
    let end = text.len()..text.len();
    let message = error.message().to_owned();
    Mistake {
        kind: MistakeKind::Syntax { message },
        span: Some(error.span().unwrap_or(end)),
    }
}
