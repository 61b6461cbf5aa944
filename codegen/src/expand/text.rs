//! The names and the documentation of generated forms.

use crate::cost::Cost;
use crate::emit::scalar::Form;
use crate::factor::rounding::Fault;
use crate::graph::{Graph, SymbolId};
use crate::parse::body::identifier;
use crate::parse::module::Function;
use crate::parse::value::Value;

/// What each result of a column form is called.
pub(super) fn output_names(value: &Value, graph: &Graph, by: &[SymbolId]) -> Vec<String> {
    let label = |path: &str| match identifier(path.trim_start_matches('.')) {
        name if name.is_empty() => "value".to_owned(),
        name if name.starts_with(|c: char| c.is_ascii_digit() || c == '_') => {
            format!("value_{}", name.trim_start_matches('_'))
        }
        name => name,
    };
    let values: Vec<String> = value
        .numbers()
        .iter()
        .map(|(path, _)| label(path))
        .collect();
    let partials = values.iter().flat_map(|value| {
        by.iter()
            .map(move |symbol| format!("d_{value}_d_{}", identifier(&graph.symbol(*symbol).name)))
    });
    values.iter().cloned().chain(partials).collect()
}

/// The documentation of a form.
pub(super) fn documentation(
    function: &Function,
    graph: &Graph,
    form: Form,
    by: &[SymbolId],
    cost: Cost,
) -> Vec<String> {
    let name = function.name();
    let symbols: Vec<String> = by
        .iter()
        .map(|symbol| format!("`{}`", graph.symbol(*symbol).name))
        .collect();
    let value = format!(" Value of [`{name}`](super::{name}())");
    let what = match form {
        Form::Value => format!("{value}."),
        Form::Gradient | Form::Jacobian | Form::Hessian if by.is_empty() => {
            format!("{value}, which depends on no number: it has no partials.")
        }
        Form::Gradient => format!("{value} and its partials by {}.", symbols.join(", ")),
        Form::Jacobian => format!(
            "{value} and, in a row for each of its numbers, the partials by {}.",
            symbols.join(", ")
        ),
        Form::Hessian => format!(
            "{value}, its first and second partials by {}.",
            symbols.join(", ")
        ),
    };
    vec![what, String::new(), format!(" Operations: {cost}.")]
}

/// Why a form is the author's own, as lines of its documentation.
pub(super) fn as_written(fault: &Fault) -> [String; 2] {
    [String::new(), format!(" As it is written: {fault}.")]
}
