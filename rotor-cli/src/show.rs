//! `rotor show`: an equation as Rust, as LaTeX or as a graph.

/// The form in which an equation is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// The generated Rust.
    Rust,
    /// LaTeX.
    Latex,
    /// The expression graph, in Graphviz' language.
    Graph,
}

/// Why an equation cannot be shown.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ShowError {
    /// No equation has this name.
    #[error("no equation is called `{0}`")]
    UnknownEquation(String),
}

/// The equation `name` in the given form.
///
/// # Errors
///
/// Where no equation has this name.
pub(crate) fn run(name: &str, _form: Form) -> Result<String, ShowError> {
    Err(ShowError::UnknownEquation(name.to_owned()))
}
