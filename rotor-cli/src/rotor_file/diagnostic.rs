//! What is wrong in a rotor file, and how it is drawn: the line, what is marked in it, what is allowed.

use std::io::IsTerminal as _;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use rotor_core::input::{NumericInput, UnknownChoice};
use rotor_core::jeffcott::rotor::InvalidRotor;

use crate::nearest::{input_names, meant, nearest};
use crate::shown::{brief, shortened};
use crate::table::{LINE, shortest, significant};

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
        let flat = input_names().find(|input| input.name == name);
        let help = match (flat, nearest(name, sections.iter().copied())) {
            (Some(input), _) => format!("write `{}` under `[{}]`", input.key, input.section),
            (None, Some(section)) => format!("did you mean `{section}`?"),
            (None, None) => format!("the sections are {}", sections.join(", ")),
        };
        Self {
            title: format!("unknown section or key `{}`", brief(name)),
            mark: Some((span, "no rotor has this".to_owned())),
            help: Some(help),
        }
    }

    /// A key of a section whose header is not there.
    pub(crate) fn no_header(section: &str, key: &str, span: Range<usize>) -> Self {
        Self {
            title: format!("the header `[{section}]` is missing"),
            mark: Some((span, format!("`{key}` belongs under it"))),
            help: Some(format!("write `[{section}]` on a line of its own above")),
        }
    }

    /// Sections of which nothing is there.
    pub(crate) fn no_sections(sections: &[&str]) -> Self {
        let names: Vec<_> = sections.iter().map(|name| format!("`[{name}]`")).collect();
        let what = if names.len() == 1 {
            "section"
        } else {
            "sections"
        };
        let verb = if names.len() == 1 { "is" } else { "are" };
        Self {
            title: format!("the {what} {} {verb} missing", names.join(", ")),
            mark: None,
            help: Some(COMPLETE.to_owned()),
        }
    }

    /// A key that its section does not have.
    pub(crate) fn unknown_key(section: &str, key: &str, span: Range<usize>) -> Self {
        let elsewhere = input_names().find(|input| input.key == key);
        let here = meant(key, Some(section));
        let help = match (elsewhere, here.as_slice(), meant(key, None).as_slice()) {
            (Some(input), ..) => format!("`{key}` belongs under `[{}]`", input.section),
            (None, [_, ..], _) => {
                let names: Vec<_> = here
                    .iter()
                    .map(|input| format!("`{}`", input.key))
                    .collect();
                format!("did you mean {}?", names.join(" or "))
            }
            (None, [], [input]) => {
                format!("did you mean `{}` under `[{}]`?", input.key, input.section)
            }
            (None, [], _) => format!(
                "the keys of [{section}] are {}",
                input_names()
                    .filter(|input| input.section == section)
                    .map(|input| input.key)
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
        };
        Self {
            title: format!("unknown key `{}` in [{section}]", brief(key)),
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
        let allowed = match input.allowed.to_string() {
            allowed if value.is_finite() || allowed == "finite" => allowed,
            allowed => format!("finite and {allowed}"),
        };
        let space = if input.unit.is_empty() { "" } else { " " };
        Self {
            title: format!(
                "{} is {value}{space}{}; it must be {allowed}",
                input.name, input.unit
            ),
            mark: Some((span, format!("must be {allowed}"))),
            help: None,
        }
    }

    /// A text that is none of the choices of an input.
    pub(crate) fn unknown_choice(unknown: &UnknownChoice, span: Range<usize>) -> Self {
        let near = nearest(&unknown.found, unknown.allowed.split(", "));
        let told = UnknownChoice {
            found: shortened(&unknown.found, 14),
            ..unknown.clone()
        };
        Self {
            title: told.to_string(),
            mark: Some((span, "none of the choices".to_owned())),
            help: near.map(|near| format!("did you mean \"{near}\"?")),
        }
    }

    /// Keys that a section does not give.
    pub(crate) fn missing(section: &str, keys: &[&str], header: Range<usize>) -> Self {
        let title = match keys {
            [key] => format!("{section}.{key} is missing"),
            _ => format!("[{section}] lacks {}", keys.join(", ")),
        };
        Self {
            title,
            mark: Some((header, "in this section".to_owned())),
            help: Some(COMPLETE.to_owned()),
        }
    }

    /// Inputs that are each allowed, but not together.
    pub(crate) fn invalid(invalid: &InvalidRotor, span: Option<Range<usize>>) -> Self {
        let (title, help) = match invalid {
            InvalidRotor::InertiaRatio {
                beta,
                disk_polar_inertia,
                disk_diametral_inertia,
            } => (
                format!(
                    "beta = disk_polar_inertia / disk_diametral_inertia is {}; it must be > 0 and <= 2",
                    significant(*beta, 6)
                ),
                Some(format!(
                    "it is {} kg m² / {} kg m²; no rigid body has more than 2",
                    shortest(*disk_polar_inertia),
                    shortest(*disk_diametral_inertia)
                )),
            ),
            InvalidRotor::OutOfRange { .. } => (invalid.to_string(), None),
        };
        Self {
            title,
            mark: span.map(|span| (span, "with this".to_owned())),
            help,
        }
    }
}

const COMPLETE: &str = "`rotor init` writes a complete file to start from";

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
    }
    .term_width(LINE);
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
