//! `#[generate(…)]`: the forms that are asked for.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Ident};

use super::budget::{self, Limit};
use super::head;
use super::target::{Target, targets};
use crate::diagnostics::{Diagnostics, nearest};

/// The forms to generate from one function.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The value itself, as generated code.
    pub value: bool,
    /// First partials by these numbers, or by every number the function uses where the list is empty.
    pub gradient: Option<Vec<Target>>,
    /// First partials of a result of several numbers, by the same rule.
    pub jacobian: Option<Vec<Target>>,
    /// Second partials by these, by every number the function uses where the list is empty.
    pub hessian: Option<Vec<Target>>,
    /// Forms over slices, of the value and of the gradient where there is one.
    pub columns: bool,
    /// The value in stages, each along its inner parameters.
    pub stages: Vec<StageRequest>,
    /// Whether it takes part in the chain of its module, and what its results are called there.
    pub chain: Option<ChainRequest>,
    /// Partials `d_x` by their names, as functions that other modules call.
    pub partials: Vec<Target>,
    /// Greatest counts of the richest form asked for; partials that formulas call are forms of their own.
    pub budget: Vec<Limit>,
}

/// A part in the chain of a module: `chain` or `chain(first, second)`.
#[derive(Clone, Debug)]
pub struct ChainRequest {
    /// What the results are called, in order; without, a number has the name of its formula, a struct's those of its fields.
    pub names: Vec<String>,
    /// Where it is asked for.
    pub span: Span,
}

/// A staged form.
#[derive(Clone, Debug)]
pub struct StageRequest {
    /// The parameters that run along the points.
    pub inner: Vec<Target>,
    /// Where it is asked for.
    pub span: Span,
}

impl StageRequest {
    /// The names of the parameters that run along the points.
    pub fn symbols(&self) -> Vec<String> {
        self.inner
            .iter()
            .map(|target| target.symbol.clone())
            .collect()
    }
}

impl Request {
    /// Every number that the forms are derived by, or run along.
    pub fn targets(&self) -> impl Iterator<Item = &Target> {
        let lists = [&self.gradient, &self.jacobian, &self.hessian];
        let derived = lists.into_iter().flatten().flatten();
        derived.chain(self.stages.iter().flat_map(|stage| &stage.inner))
    }
}

/// The words of a request, but for partials.
const FORMS: [&str; 8] = [
    "value", "gradient", "jacobian", "hessian", "columns", "stage", "chain", "budget",
];

pub(super) fn read(words: &[Expr], span: Span, diagnostics: &mut Diagnostics) -> Request {
    let mut request = Request::default();
    if words.is_empty() {
        diagnostics.error_with_hint(
            span,
            "`generate` names no form",
            "write one of value, gradient(x, y), jacobian(x, y), hessian(x, y), columns, stage(x)",
        );
    }
    let mut asked: Vec<String> = Vec::new();
    for word in words {
        let Some((name, arguments)) = head(word) else {
            diagnostics.error_with_hint(
                word.span(),
                "not a form",
                format!("forms are {}", FORMS.join(", ")),
            );
            continue;
        };
        // There may be a stage along every parameter.
        if asked.contains(&name.to_string()) && name != "stage" {
            diagnostics.error_with_hint(
                name.span(),
                format!("`{name}` is asked for twice"),
                "write it once, with all its names",
            );
            continue;
        }
        asked.push(name.to_string());
        match name.to_string().as_str() {
            "value" => request.value = true,
            "columns" => request.columns = true,
            "gradient" => request.gradient = Some(targets(&arguments, diagnostics)),
            "jacobian" => request.jacobian = Some(targets(&arguments, diagnostics)),
            "hessian" => request.hessian = Some(targets(&arguments, diagnostics)),
            "stage" => request.stages.extend(stage(name, &arguments, diagnostics)),
            "chain" => request.chain = Some(chain(name, &arguments, diagnostics)),
            "budget" => budget::read(&mut request.budget, name, &arguments, diagnostics),
            partial if partial.starts_with("d_") && arguments.is_empty() => {
                request.partials.push(Target {
                    symbol: partial.to_owned(),
                    span: name.span(),
                });
            }
            other => {
                let hint = nearest(other, FORMS).map_or_else(
                    || format!("forms are {}", FORMS.join(", ")),
                    |form| format!("did you mean `{form}`?"),
                );
                diagnostics.error_with_hint(name.span(), format!("unknown form `{other}`"), hint);
            }
        }
    }
    check_budget_counts(words, &asked, diagnostics);
    request
}

/// Reports a budget without a form whose operations it would count.
fn check_budget_counts(words: &[Expr], asked: &[String], diagnostics: &mut Diagnostics) {
    let counted = |form: &String| form != "budget" && !form.starts_with("d_");
    let is_budget = |word: &&Expr| head(word).is_some_and(|(name, _)| name == "budget");
    if let Some(word) = words.iter().find(is_budget)
        && !asked.iter().any(counted)
    {
        diagnostics.error_with_hint(
            word.span(),
            "the budget has no form to count",
            "ask for a form beside it: value, gradient(x, y), hessian(x, y) or columns",
        );
    }
}

fn chain(name: &Ident, arguments: &[&Expr], diagnostics: &mut Diagnostics) -> ChainRequest {
    let mut names = Vec::new();
    for argument in arguments {
        match argument {
            Expr::Path(path) if path.path.get_ident().is_some() => {
                names.extend(path.path.get_ident().map(ToString::to_string));
            }
            other => diagnostics.error_with_hint(
                other.span(),
                "not the name of a result",
                "write for example chain(first_width, second_width)",
            ),
        }
    }
    ChainRequest {
        names,
        span: name.span(),
    }
}

fn stage(name: &Ident, arguments: &[&Expr], diagnostics: &mut Diagnostics) -> Option<StageRequest> {
    if arguments.is_empty() {
        diagnostics.error_with_hint(
            name.span(),
            "the stage names no inner parameter",
            "write for example stage(c.crack_angle): what changes from point to point",
        );
        return None;
    }
    Some(StageRequest {
        inner: targets(arguments, diagnostics),
        span: name.span(),
    })
}
