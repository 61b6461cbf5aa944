//! What is wrong in a rotor file, and how it is drawn: the line, what is marked in it, what is allowed.

use std::io::IsTerminal as _;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use rotor_core::rotor::{INPUTS, InvalidRotor, NumericInput, UnknownChoice};

use super::CHOICES;

/// One mistake in a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mistake {
    title: String,
    /// The bytes of the file that are marked, and what is said beside them.
    mark: Option<(Range<usize>, String)>,
    help: Option<String>,
}

impl Mistake {
    /// Where it stands in the file; mistakes without a place come last.
    pub(crate) fn place(&self) -> usize {
        self.mark
            .as_ref()
            .map_or(usize::MAX, |(span, _)| span.start)
    }

    /// The file is no TOML.
    pub(crate) fn syntax(error: &toml::de::Error, length: usize) -> Self {
        let span = error.span().unwrap_or(length..length);
        Self {
            title: "this is not TOML".to_owned(),
            mark: Some((span, error.message().trim_end().replace('\n', "; "))),
            help: None,
        }
    }

    /// A section, or a key outside of any section, that no rotor has.
    pub(crate) fn unknown_section(name: &str, span: Range<usize>, sections: &[&str]) -> Self {
        let flat = dotted_names().find(|(flat, _)| *flat == name);
        let help = match (flat, nearest(name, sections.iter().copied())) {
            (Some((_, (section, key))), _) => format!("write `{key}` under `[{section}]`"),
            (None, Some(section)) => format!("did you mean `{section}`?"),
            (None, None) => format!("the sections are {}", sections.join(", ")),
        };
        Self {
            title: format!("unknown section or key `{name}`"),
            mark: Some((span, "no rotor has this".to_owned())),
            help: Some(help),
        }
    }

    /// A key that its section does not have.
    pub(crate) fn unknown_key(section: &str, key: &str, span: Range<usize>) -> Self {
        let here = dotted_names()
            .filter(|(_, (other, _))| *other == section)
            .map(|(_, (_, key))| key);
        let elsewhere = dotted_names()
            .find(|(_, (_, other))| *other == key)
            .map(|(_, (section, _))| section);
        let help = match (elsewhere, nearest(key, here.clone())) {
            (Some(elsewhere), _) => format!("`{key}` belongs under `[{elsewhere}]`"),
            (None, Some(near)) => format!("did you mean `{near}`?"),
            (None, None) => format!(
                "the keys of [{section}] are {}",
                here.collect::<Vec<_>>().join(", ")
            ),
        };
        Self {
            title: format!("unknown key `{key}` in [{section}]"),
            mark: Some((span, "no rotor has this".to_owned())),
            help: Some(help),
        }
    }

    /// A value of another kind than the input's.
    pub(crate) fn wrong_type(
        name: &str,
        expected: &str,
        found: &str,
        span: Range<usize>,
        help: Option<String>,
    ) -> Self {
        Self {
            title: format!("`{name}` is not {expected}"),
            mark: Some((span, format!("this is of type {found}"))),
            help,
        }
    }

    /// A number outside the values that its input allows.
    pub(crate) fn not_allowed(
        input: &'static NumericInput,
        value: f64,
        span: Range<usize>,
    ) -> Self {
        let invalid = InvalidRotor::OutOfRange { input, value };
        Self {
            title: invalid.to_string(),
            mark: Some((span, format!("must be {}", input.allowed))),
            help: None,
        }
    }

    /// A text that is none of the choices of an input.
    pub(crate) fn unknown_choice(unknown: &UnknownChoice, span: Range<usize>) -> Self {
        let near = nearest(&unknown.found, unknown.allowed.split(", "));
        Self {
            title: unknown.to_string(),
            mark: Some((span, "none of the choices".to_owned())),
            help: near.map(|near| format!("did you mean \"{near}\"?")),
        }
    }

    /// Inputs that the file does not give.
    pub(crate) fn missing(inputs: &[&NumericInput]) -> Self {
        let names: Vec<_> = inputs
            .iter()
            .map(|input| format!("{}.{}", input.section, input.key))
            .collect();
        let verb = if names.len() == 1 { "is" } else { "are" };
        Self {
            title: format!("{} {verb} missing", names.join(", ")),
            mark: None,
            help: Some("`rotor init` writes a complete file to start from".to_owned()),
        }
    }

    /// Inputs that are each allowed, but not together.
    pub(crate) fn invalid(invalid: &InvalidRotor, span: Option<Range<usize>>) -> Self {
        Self {
            title: invalid.to_string(),
            mark: span.map(|span| (span, "with this".to_owned())),
            help: None,
        }
    }
}

/// Every input with its section and key.
fn dotted_names() -> impl Iterator<Item = (&'static str, (&'static str, &'static str))> + Clone {
    let numbers = INPUTS
        .iter()
        .map(|input| (input.name, (input.section, input.key)));
    numbers.chain(
        CHOICES
            .iter()
            .map(|&(name, section, key)| (name, (section, key))),
    )
}

/// The name nearest to a misspelt one, if one is near: at most a third of its letters differ.
pub(crate) fn nearest<'a>(misspelt: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let lower = misspelt.to_lowercase();
    names
        .map(|name| (strsim::damerau_levenshtein(&lower, name), name))
        .filter(|(distance, name)| 3 * distance <= name.chars().count().max(3))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// At most so many mistakes are drawn: a file with more is something else than a rotor.
const MOST: usize = 20;

/// Draws mistakes as text, in colour where stderr is a terminal that wants it.
pub(crate) fn draw(source: &str, name: &str, mistakes: &[Mistake]) -> String {
    let coloured = std::io::stderr().is_terminal()
        && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let renderer = if coloured {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let groups: Vec<_> = mistakes
        .iter()
        .take(MOST)
        .map(|mistake| group(source, name, mistake))
        .collect();
    let mut drawn: Vec<_> = groups
        .iter()
        .map(|group| renderer.render(std::slice::from_ref(group)))
        .collect();
    let more = mistakes.len().saturating_sub(MOST);
    if more > 0 {
        drawn.push(format!("and {more} more in {name}"));
    }
    drawn.join("\n\n")
}

fn group<'a>(source: &'a str, name: &'a str, mistake: &'a Mistake) -> Group<'a> {
    let title = Level::ERROR.primary_title(mistake.title.as_str());
    let mut group = match &mistake.mark {
        Some((span, label)) => title.element(
            Snippet::source(source).path(name).annotation(
                AnnotationKind::Primary
                    .span(span.clone())
                    .label(label.as_str()),
            ),
        ),
        None => title.element(Level::NOTE.message(format!("in {name}"))),
    };
    if let Some(help) = &mistake.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    group
}
