//! `rotor show`: an equation as Rust, as LaTeX or as a graph, and the list of all.

mod plain_math;

use std::fmt::Write;

use codegen::expand::Expansion;
use codegen::show::{self, ShowError, Summary};
use rotor_core::equations::SOURCES;
use rotor_core::quantity::{Quantity, Subject};

use crate::failure::Failure;
use crate::output;
use crate::table::{LINE, wrapped};
use plain_math::plain;

/// The form in which an equation is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// The generated Rust.
    Rust,
    /// LaTeX.
    Latex,
    /// The operations, in Graphviz' language.
    Graph,
}

/// The equation `name` in the given form; without a name, the list of all equations.
///
/// # Errors
///
/// Where no equation has this name.
pub(crate) fn run(name: Option<&str>, form: Form) -> Result<String, Failure> {
    let told = |error: ShowError| Failure::input(error.to_string());
    let mut system = show::system(&SOURCES).map_err(told)?;
    let Some(name) = name else {
        return Ok(list(&system.list()));
    };
    let name = name.to_lowercase();
    let known = system.names().contains(&name);
    let name = match Quantity::ALL
        .into_iter()
        .find(|result| result.name() == name)
    {
        Some(result) if !known => formula_of(result)?,
        _ => &name,
    };
    let expansion = system.of(name).map_err(told)?;
    equation(expansion, name, form).map_err(told)
}

/// The formula that gives a result which is not a formula itself; it is said on stderr.
fn formula_of(result: Quantity) -> Result<&'static str, Failure> {
    let formula = match result.subject() {
        Subject::Plain if result.name().starts_with('c') => "crack_compliance",
        Subject::Plain => "coefficients",
        _ => {
            return Err(Failure::input(format!(
                "`{result}` is no closed form: it is computed from the roots of the frequency equation, see `rotor \
                 show phi`"
            )));
        }
    };
    output::remark(&format!("`{result}` is one of the results of `{formula}`:"));
    Ok(formula)
}

fn equation(expansion: &mut Expansion, name: &str, form: Form) -> Result<String, ShowError> {
    match form {
        Form::Rust => show::rust(expansion, name).map(|code| in_lines(&code, comment)),
        Form::Latex => show::latex_in_full(expansion, name)
            .map(|text| in_lines(&text, |_| Some("  ".to_owned()))),
        Form::Graph => show::graph(expansion, name),
    }
}

/// What a comment's further lines begin with, as its first; other code is not broken.
fn comment(line: &str) -> Option<String> {
    let text = line.trim_start();
    let slashes = text.len() - text.trim_start_matches('/').len();
    let indent = line.len() - text.len();
    (slashes >= 2).then(|| format!("{}{} ", " ".repeat(indent), "/".repeat(slashes)))
}

/// The text with its wide lines broken at spaces; `start` gives what further lines begin with. LaTeX reads the end of a
/// line as a space.
fn in_lines(text: &str, start: impl Fn(&str) -> Option<String>) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        let Some(start) = start(line) else {
            lines.push(line.to_owned());
            continue;
        };
        let mut broken = String::new();
        for word in line.split_inclusive(' ') {
            let width = broken.chars().count() + word.trim_end().chars().count();
            if width > LINE && broken.trim() != start.trim() {
                lines.push(broken.trim_end().to_owned());
                broken.clone_from(&start);
            }
            broken.push_str(word);
        }
        lines.push(broken.trim_end().to_owned());
    }
    lines.push(String::new());
    lines.join("\n")
}

/// One block for each equation: its name, the operations of its value, and what it is.
fn list(equations: &[Summary]) -> String {
    let width = equations
        .iter()
        .map(|equation| equation.name.len())
        .max()
        .unwrap_or_default();
    let mut text = String::new();
    for Summary { name, about, cost } in equations {
        let cost = cost.map_or_else(|| "an integral".to_owned(), |cost| cost.to_string());
        // Writing to a string never fails.
        let _ = writeln!(text, "{name:width$}  {cost}");
        text.push_str(&wrapped(&plain(about), "    "));
    }
    text
}
