//! `rotor show`: an equation as Rust, as LaTeX or as a graph, and the list of all.

use std::fmt::Write;

use codegen::expand::Expansion;
use codegen::show::{self, ShowError, Summary};
use rotor_core::equations::SOURCE;

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
pub(crate) fn run(name: Option<&str>, form: Form) -> Result<String, ShowError> {
    let mut expansion = show::module(SOURCE)?;
    match name {
        Some(name) => equation(&mut expansion, name, form),
        None => Ok(list(&show::list(&mut expansion))),
    }
}

fn equation(expansion: &mut Expansion, name: &str, form: Form) -> Result<String, ShowError> {
    match form {
        Form::Rust => show::rust(expansion, name),
        Form::Latex => show::latex(expansion, name),
        Form::Graph => show::graph(expansion, name),
    }
}

/// The longest line of the list.
const WIDTH: usize = 100;

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
        push_wrapped(&mut text, about);
    }
    text
}

/// Adds the words in indented lines.
fn push_wrapped(text: &mut String, words: &str) {
    const INDENT: usize = 3;
    let mut column = 0;
    for word in words.split_whitespace() {
        let length = 1 + word.chars().count();
        if column == 0 || column + length > WIDTH {
            text.push_str(if column == 0 { "" } else { "\n" });
            text.push_str(&" ".repeat(INDENT));
            column = INDENT;
        }
        text.push(' ');
        text.push_str(word);
        column += length;
    }
    text.push('\n');
}
