//! A formula to look at, of a module or of several that link each other: the code generated from it, its LaTeX, its graph.

use std::rc::Rc;

use proc_macro2::TokenStream;
use syn::{Attribute, Item, ItemMod, Meta};

use crate::cost::Cost;
use crate::diagnostics::{Diagnostics, nearest};
use crate::emit::scalar::Form;
use crate::expand::{Expansion, Formula, Generated};
use crate::parse::attributes::Request;
use crate::parse::linking::{Source, Sources};
use crate::parse::module::Function;
use crate::parse::place::Place;
use crate::{dot, emit, latex};

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

/// A formula in a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// Its name.
    pub name: String,
    /// The first paragraph of its documentation, in one line.
    pub about: String,
    /// The operations of its value; `None` if the formula has mistakes or is an integral.
    pub cost: Option<Cost>,
}

/// The `#[symbolic]` module of a source file. Its formulas are read as they are asked for.
///
/// # Errors
/// The source is no Rust, or has no such module.
pub fn module(source: &str) -> Result<Expansion, ShowError> {
    let file = syn::parse_file(source).map_err(|error| ShowError::Syntax(error.to_string()))?;
    let mut modules = file.items.into_iter().filter_map(|item| match item {
        Item::Mod(item) => Some(item),
        _ => None,
    });
    let (attribute, item) = modules.find_map(symbolic).ok_or(ShowError::NoModule)?;
    // The code that is shown calls its tables, but does not hold them.
    Ok(Expansion::unread(attribute, item).with_sketched_tables())
}

/// The modules of several files, which link each other: each file with its path below the crate's source, and its text.
/// Formulas are read as they are asked for.
///
/// # Errors
/// A file is no Rust, or none has such a module.
pub fn system(files: &[(&str, &str)]) -> Result<System, ShowError> {
    let mut sources = Vec::new();
    for (path, text) in files {
        let file =
            syn::parse_file(text).map_err(|error| ShowError::Syntax(format!("{path}: {error}")))?;
        let place = place_of(path);
        let items = file.items.into_iter().filter_map(|item| match item {
            Item::Mod(item) => symbolic(item),
            _ => None,
        });
        let mut found: Vec<Source> = items
            .map(|(attribute, item)| Source {
                key: format!("{path}: {}", item.ident),
                attribute,
                places: vec![place.child(&item.ident.to_string())],
                item,
            })
            .collect();
        // What is alone in its file is found by the file, which has its items as its own.
        if let [alone] = found.as_mut_slice() {
            alone.places.insert(0, place);
        }
        sources.extend(found);
    }
    if sources.is_empty() {
        return Err(ShowError::NoModule);
    }
    let count = sources.len();
    let mut sources = Sources::new(sources);
    let modules = (0..count).filter_map(|position| {
        let mut diagnostics = Diagnostics::default();
        let module = sources.module(position, &mut diagnostics)?;
        Some(Expansion::of_module(module, diagnostics).with_sketched_tables())
    });
    let modules = modules.collect();
    Ok(System { modules })
}

/// The module that a file is: `a/b.rs` and `a/b/mod.rs` are `crate::a::b`.
fn place_of(path: &str) -> Place {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    let mut names: Vec<String> = path.split('/').map(ToOwned::to_owned).collect();
    let root = names.len() == 1;
    let own = names.last().map(String::as_str);
    if own == Some("mod") || (root && matches!(own, Some("lib" | "main"))) {
        names.pop();
    }
    Place::in_crate(names)
}

/// Modules of formulas that link each other.
#[derive(Debug)]
pub struct System {
    /// The modules in the order of their files.
    pub modules: Vec<Expansion>,
}

impl System {
    /// The names of all formulas, in the order of the files.
    pub fn names(&self) -> Vec<String> {
        let modules = self.modules.iter();
        modules.flat_map(Expansion::function_names).collect()
    }

    /// The module that has the formula of that name: the first, if several have one.
    ///
    /// # Errors
    /// There is no such formula.
    pub fn of(&mut self, name: &str) -> Result<&mut Expansion, ShowError> {
        let known = self.names();
        let mut modules = self.modules.iter_mut();
        modules
            .find(|module| module.module().function(name).is_some())
            .ok_or_else(|| unknown(name, known))
    }

    /// All formulas in the order of the files.
    pub fn list(&mut self) -> Vec<Summary> {
        self.modules.iter_mut().flat_map(list).collect()
    }
}

/// The tokens in the attribute `symbolic(…)` and the module without it, where it has one.
fn symbolic(mut item: ItemMod) -> Option<(TokenStream, ItemMod)> {
    let named = |attribute: &Attribute| {
        attribute
            .path()
            .segments
            .last()
            .is_some_and(|last| last.ident == "symbolic")
    };
    let position = item.attrs.iter().position(named)?;
    let tokens = match item.attrs.remove(position).meta {
        Meta::List(list) => list.tokens,
        _ => TokenStream::new(),
    };
    Some((tokens, item))
}

/// All formulas in the order of the source.
pub fn list(expansion: &mut Expansion) -> Vec<Summary> {
    let names = expansion.function_names();
    let summary = |name: String| {
        let function = expansion.module().function(&name).cloned();
        let about = function.as_deref().map(about).unwrap_or_default();
        let cost = function
            .and_then(|function| value(expansion, &function).ok())
            .map(|value| value.circuit.cost());
        Summary { name, about, cost }
    };
    names.into_iter().map(summary).collect()
}

/// The first paragraph of a function's documentation.
fn about(function: &Function) -> String {
    let lines = function
        .item
        .attrs
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Str(text),
                    ..
                }) => Some(text.value().trim().to_owned()),
                _ => None,
            },
            _ => None,
        });
    let about = lines
        .take_while(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    // The brackets of links within the documentation.
    about.replace("[`", "`").replace("`]", "`")
}

/// A formula as its author wrote it, as LaTeX for a display, without delimiters; see [`latex::formula`].
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn latex(expansion: &Expansion, name: &str) -> Result<String, ShowError> {
    let function = function(expansion, name)?;
    latex::formula(expansion.module(), expansion.latex_symbols(), &function)
        .map_err(|error| ShowError::Mistakes(error.to_string()))
}

/// As [`latex()`], with the definitions of all formulas that it calls; see [`in_full`](mod@latex).
///
/// # Errors
/// There is no such formula, or one of them has mistakes.
pub fn latex_in_full(expansion: &Expansion, name: &str) -> Result<String, ShowError> {
    let function = function(expansion, name)?;
    latex::in_full(expansion.module(), expansion.latex_symbols(), &function)
        .map_err(|error| ShowError::Mistakes(error.to_string()))
}

/// The operations of a formula's value as a graph in Graphviz' language; see [`dot::dot`].
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn graph(expansion: &mut Expansion, name: &str) -> Result<String, ShowError> {
    let function = function(expansion, name)?;
    let generated = value(expansion, &function)?;
    let paths = expansion
        .formula(name)
        .map(|formula| formula.value.numbers())
        .unwrap_or_default();
    let results: Vec<String> = paths
        .into_iter()
        .map(|(path, _)| format!("{name}{path}"))
        .collect();
    Ok(dot::dot(
        name,
        &generated.graph,
        &generated.circuit,
        &results,
    ))
}

/// The forms of a formula as they are generated, formatted, with their operation counts.
///
/// A formula that asks for no form is shown by its value.
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn rust(expansion: &mut Expansion, name: &str) -> Result<String, ShowError> {
    let forms = forms(expansion, name)?;
    let mut tokens: TokenStream = forms.into_iter().map(|form| form.tokens).collect();
    let function = function(expansion, name)?;
    for stage in function.request.iter().flat_map(|request| &request.stages) {
        tokens.extend(expansion.staged_item(&function, stage).0);
    }
    emit::format(tokens).ok_or_else(|| ShowError::Mistakes(name.to_owned()))
}

/// The forms of a formula that its attributes ask for, the value where they ask for none.
///
/// # Errors
/// There is no such formula, or it has mistakes.
pub fn forms(expansion: &mut Expansion, name: &str) -> Result<Vec<Generated>, ShowError> {
    let function = function(expansion, name)?;
    let Request {
        gradient,
        jacobian,
        hessian,
        ..
    } = function.request.clone().unwrap_or_default();
    let mut forms = vec![value(expansion, &function)?];
    let asked = [
        (Form::Gradient, gradient),
        (Form::Jacobian, jacobian),
        (Form::Hessian, hessian),
    ];
    for (form, by) in asked {
        if let Some(by) = by {
            let generated = expansion.generate(&function, form, &by);
            forms.push(generated.ok_or_else(|| mistakes(expansion, name))?);
        }
    }
    Ok(forms)
}

fn function(expansion: &Expansion, name: &str) -> Result<Rc<Function>, ShowError> {
    let function = expansion.module().function(name).cloned();
    function.ok_or_else(|| unknown(name, expansion.function_names()))
}

fn unknown(name: &str, known: Vec<String>) -> ShowError {
    let nearest = nearest(name, known.iter().map(String::as_str)).map(ToOwned::to_owned);
    ShowError::Unknown {
        name: name.to_owned(),
        nearest,
        known,
    }
}

fn value(expansion: &mut Expansion, function: &Function) -> Result<Generated, ShowError> {
    let name = function.name();
    expansion.read_only(&name);
    // An integral without a table has a graph, but no operations.
    let integral = expansion.formula(&name).is_some_and(Formula::has_integral);
    let generated = if integral {
        None
    } else {
        expansion.generate(function, Form::Value, &[])
    };
    generated.ok_or_else(|| mistakes(expansion, &name))
}

fn mistakes(expansion: &Expansion, name: &str) -> ShowError {
    let messages: Vec<String> = expansion
        .diagnostics
        .iter()
        .map(|message| message.text())
        .collect();
    ShowError::Mistakes(match messages.is_empty() {
        true => format!("`{name}` is an integral without a table; give it #[approximate(…)]"),
        false => messages.join("; "),
    })
}

#[cfg(test)]
mod tests;
