//! What the Python side of `peers/` reads: the corpus's formulas as Python, and a description of each.

use std::fmt::Write;

use codegen::emit::scalar::Form;
use codegen::expand::derive;
use codegen::interpret;
use codegen::parse::shape::Shape;
use codegen::show::ShowError;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;
use serde_json::{Value, json};

use crate::corpus::{FIELDS, Field};
use crate::python::{self, TranslationError};

/// Why there is nothing to hand over.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExportError {
    /// A formula could not be translated.
    #[error(transparent)]
    Translation(#[from] TranslationError),
    /// A formula could not be read.
    #[error(transparent)]
    Formula(#[from] ShowError),
    /// A formula has no number at the point where tools are compared.
    #[error("`{0}` cannot be computed at the point of comparison")]
    NoNumber(String),
}

/// The formulas of all fields as one Python module, a class of static functions for each field.
///
/// # Errors
/// A formula uses something outside the language of formulas.
pub fn python_text() -> Result<String, ExportError> {
    let mut text =
        String::from("# Written from the Rust sources; see benches/src/python.rs.\n\n\n");
    for field in &FIELDS {
        let _ = writeln!(text, "def {}():", field.name);
        let sources = field.sources.iter().map(|(_, source)| *source);
        for line in python::module(sources)?.lines() {
            let _ = writeln!(text, "{}{line}", if line.is_empty() { "" } else { "    " });
        }
        text.push_str("    return locals()\n\n\n");
    }
    Ok(text)
}

/// Each formula's parameters, symbols with what is known of their signs, the symbols of its gradient, a point, and the
/// value and gradient there, by which the other tools' results are checked.
///
/// # Errors
/// A formula could not be read, or has no finite value at the point.
pub fn descriptions() -> Result<Value, ExportError> {
    let mut all = Vec::new();
    for field in &FIELDS {
        for name in field.formulas {
            all.push(description(field, name)?);
        }
    }
    Ok(Value::Array(all))
}

fn description(field: &Field, name: &str) -> Result<Value, ExportError> {
    let mut system = field.system()?;
    let counted = field.counted(&mut system, name)?;
    let no_number = || ExportError::NoNumber(name.to_owned());
    let formula = system.of(name)?.formula(name).ok_or_else(no_number)?;
    let (graph, outputs) = derive(formula, Form::Gradient, &counted.gradient.by);
    let symbols: Vec<_> = graph.symbols().collect();
    let point: Vec<f64> = symbols
        .iter()
        .enumerate()
        .map(|(place, (_, symbol))| number_at(field, &symbol.name, place))
        .collect();
    let expected = interpret::evaluate(&graph, &outputs.all(), &point).ok_or_else(no_number)?;
    if !expected.iter().all(|number: &f64| number.is_finite()) {
        return Err(no_number());
    }
    let parameters = counted.function.parameters.iter().map(|parameter| {
        let kind = match &parameter.shape {
            Shape::Number => json!("number"),
            Shape::Array(_, length) => json!(length),
            Shape::Struct(..) => json!("struct"),
        };
        json!({ "name": parameter.name.to_string(), "kind": kind })
    });
    let name_of = |symbol| graph.symbol(symbol).name.clone();
    Ok(json!({
        "field": field.name,
        "name": name,
        "parameters": parameters.collect::<Vec<_>>(),
        "symbols": symbols.iter().zip(&point).map(|((_, symbol), value)| json!({
            "name": symbol.name,
            "positive": symbol.domain.sign.is_positive(),
            "value": value,
        })).collect::<Vec<_>>(),
        "by": counted.gradient.by.iter().map(|symbol| name_of(*symbol)).collect::<Vec<_>>(),
        "expected": expected,
    }))
}

/// An input's value at the point of comparison: the paper's rotor's for the rotor's coefficients, between 1 and 2 for others.
fn number_at(field: &Field, symbol: &str, place: usize) -> f64 {
    let plain = 1.0 + (0.618_033_988_749_895 * (place + 1) as f64).fract();
    if field.name != "rotor" {
        return plain;
    }
    let rotor = Rotor::new(RotorParameters::PAPER).ok();
    let Some(c) = rotor.and_then(|rotor| rotor.coefficients().ok()) else {
        return plain;
    };
    match symbol {
        "c.beta" => c.beta,
        "c.gamma" => c.gamma,
        "c.delta" => c.delta,
        "c.epsilon_1" => c.epsilon_1,
        "c.epsilon_12" => c.epsilon_12,
        "c.epsilon_2" => c.epsilon_2,
        "c.disk_asymmetry" => c.disk_asymmetry,
        "c.crack_angle" => 0.7,
        _ => plain,
    }
}
