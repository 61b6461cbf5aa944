//! How a mistake in a rotor file is drawn: the line, what is marked in it, what is allowed.

use std::io::IsTerminal as _;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use rotor_core::file::{Mistake, MistakeKind};

use crate::table::LINE;

/// Helps with what is not there.
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

/// What would be right.
fn help(mistake: &Mistake) -> Option<String> {
    let is_missing = matches!(
        mistake.kind,
        MistakeKind::MissingKeys { .. } | MistakeKind::MissingSections { .. }
    );
    mistake
        .help()
        .or_else(|| is_missing.then(|| COMPLETE.to_owned()))
}

fn group<'a>(source: &'a str, name: &'a str, mistake: &Mistake) -> Group<'a> {
    let title = Level::ERROR.primary_title(mistake.to_string());
    let mut group = match &mistake.span {
        Some(span) => title.element(
            Snippet::source(source).path(name).annotation(
                AnnotationKind::Primary
                    .span(span.clone())
                    .label(mistake.label()),
            ),
        ),
        None => title.element(Level::NOTE.message(format!("in {name}"))),
    };
    if let Some(help) = help(mistake) {
        group = group.element(Level::HELP.message(help));
    }
    group
}
