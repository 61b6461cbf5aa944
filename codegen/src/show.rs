//! A formula to look at: the code generated from it, its LaTeX, its graph.

use proc_macro2::TokenStream;
use syn::{Item, ItemMod};

use crate::diagnostics::nearest;
use crate::emit;
use crate::emit::scalar::Form;
use crate::expand::{Expansion, Generated};

/// Why there is nothing to show.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShowError {
    /// The source is not Rust.
    #[error("the source can't be parsed: {0}")]
    Syntax(String),
    /// The source has no `#[symbolic]` module.
    #[error("the source has no module with the attribute `symbolic`")]
    NoModule,
    /// The module has no function of that name.
    #[error("there is no formula `{name}`{}", hint(nearest, known))]
    Unknown {
        /// The name asked for.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
        /// All names.
        known: Vec<String>,
    },
    /// The formula has mistakes.
    #[error("the formula can't be expanded: {0}")]
    Mistakes(String),
}

fn hint(nearest: &Option<String>, known: &[String]) -> String {
    match nearest {
        Some(name) => format!("; did you mean `{name}`?"),
        None => format!("; formulas are {}", known.join(", ")),
    }
}

/// The `#[symbolic]` module of a source file.
///
/// # Errors
/// The source is no Rust, or has no such module.
pub fn module(source: &str) -> Result<Expansion, ShowError> {
    let file = syn::parse_file(source).map_err(|error| ShowError::Syntax(error.to_string()))?;
    let symbolic = |item: &ItemMod| {
        item.attrs.iter().any(|attribute| attribute.path().segments.last().is_some_and(|last| last.ident == "symbolic"))
    };
    let found = file.items.into_iter().find_map(|item| match item {
        Item::Mod(item) if symbolic(&item) => Some(item),
        _ => None,
    });
    found.map(Expansion::of).ok_or(ShowError::NoModule)
}

/// The forms of a formula as they are generated, formatted, with their operation counts.
///
/// A formula that asks for no form is shown by its value.
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn rust(expansion: &mut Expansion, name: &str) -> Result<String, ShowError> {
    let forms = forms(expansion, name)?;
    let tokens: TokenStream = forms.into_iter().map(|form| form.tokens).collect();
    emit::format(tokens).ok_or_else(|| ShowError::Mistakes(name.to_owned()))
}

/// The forms of a formula that its attributes ask for, the value where they ask for none.
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn forms(expansion: &mut Expansion, name: &str) -> Result<Vec<Generated>, ShowError> {
    let known = expansion.function_names();
    let Some(function) = expansion.module().function(name).cloned() else {
        let nearest = nearest(name, known.iter().map(String::as_str)).map(ToOwned::to_owned);
        return Err(ShowError::Unknown { name: name.to_owned(), nearest, known });
    };
    let request = function.request.clone().unwrap_or_default();
    let mut wanted = vec![(Form::Value, Vec::new())];
    wanted.extend(request.gradient.map(|by| (Form::Gradient, by)));
    wanted.extend(request.hessian.map(|by| (Form::Hessian, by)));
    let mut forms = Vec::new();
    for (form, by) in wanted {
        match expansion.generate(&function, form, &by) {
            Some(generated) => forms.push(generated),
            None => {
                let messages: Vec<String> = expansion.diagnostics.iter().map(|message| message.text()).collect();
                return Err(ShowError::Mistakes(messages.join("; ")));
            }
        }
    }
    Ok(forms)
}
