//! What is asked of a function: `#[generate]`, `#[domain]`, `#[approximate]`, `#[specialise]`.

mod approximation;
pub mod of_module;

use proc_macro2::Span;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, BinOp, Expr, Ident, Lit, Token};

use crate::cost::Measure;
use crate::diagnostics::{Diagnostics, nearest};
use crate::graph::{Domain, Sign};

/// A number named in an attribute: a parameter, `c.field` or `a[0]`, with its place for messages.
#[derive(Clone, Debug)]
pub struct Target {
    /// The symbol's name.
    pub symbol: String,
    /// Where it is named.
    pub span: Span,
}

impl Target {
    /// The parameter that the number is of.
    pub fn root(&self) -> &str {
        root(&self.symbol)
    }
}

/// The parameter that a number is of: `c` of `c.field`, `a` of `a[0]`.
pub fn root(symbol: &str) -> &str {
    symbol.split(['.', '[']).next().unwrap_or(symbol)
}

/// The forms to generate from one function.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The value itself, as generated code.
    pub value: bool,
    /// First partials by these, by every number the function uses where the list is empty.
    pub gradient: Option<Vec<Target>>,
    /// Second partials, likewise.
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
        let lists = [&self.gradient, &self.hessian];
        let derived = lists.into_iter().flatten().flatten();
        derived.chain(self.stages.iter().flat_map(|stage| &stage.inner))
    }
}

/// One entry of a budget.
#[derive(Clone, Debug)]
pub struct Limit {
    /// What is counted.
    pub measure: Measure,
    /// The most that is allowed.
    pub most: usize,
    /// The entry, for the message.
    pub span: Span,
}

/// A function to be tabulated when the crate is built.
#[derive(Clone, Debug)]
pub struct Approximation {
    /// The function's one parameter.
    pub variable: Ident,
    /// Lower end of the interval.
    pub lower: f64,
    /// Upper end of the interval.
    pub upper: f64,
    /// Factor that is kept as it is, so that only the quotient is approximated.
    pub factor: Option<Expr>,
    /// Greatest relative error.
    pub tolerance: f64,
    /// Where it is asked for.
    pub span: Span,
}

/// A new function, made by fixing parameters of the one it stands at.
#[derive(Clone, Debug)]
pub struct Specialisation {
    /// The new function's name.
    pub name: Ident,
    /// Parameter, or one number of it, and the expression in its place.
    pub replacements: Vec<(Target, Expr)>,
    /// What to generate from it.
    pub request: Request,
}

/// Everything that a function's attributes say.
#[derive(Clone, Debug, Default)]
pub struct FunctionAttributes {
    /// `#[generate(…)]`
    pub request: Option<Request>,
    /// `#[domain(…)]`
    pub domain: Vec<(Target, Domain)>,
    /// `#[approximate(…)]`
    pub approximation: Option<Approximation>,
    /// `#[specialise(…)]`, any number of them.
    pub specialisations: Vec<Specialisation>,
}

/// The attributes that belong to the generator; all others stay on the function.
pub const OWN: [&str; 4] = ["generate", "domain", "approximate", "specialise"];

impl FunctionAttributes {
    /// Reads the generator's attributes among `attributes`.
    pub fn read(attributes: &[Attribute], diagnostics: &mut Diagnostics) -> Self {
        let mut read = Self::default();
        for attribute in attributes {
            let Some(name) = OWN.into_iter().find(|name| attribute.path().is_ident(name)) else {
                continue;
            };
            let Some(words) = words(attribute, example(name), diagnostics) else {
                continue;
            };
            let span = attribute.path().span();
            let repeated = match name {
                "generate" => read.request.is_some(),
                "approximate" => read.approximation.is_some(),
                _ => false,
            };
            if repeated {
                diagnostics.error_with_hint(
                    span,
                    format!("a second `{name}` of one function"),
                    "write all of it in one attribute",
                );
                continue;
            }
            match name {
                "generate" => read.request = Some(request(&words, span, diagnostics)),
                "domain" => {
                    read.domain
                        .extend(words.iter().filter_map(|word| domain(word, diagnostics)));
                }
                "approximate" => {
                    read.approximation = approximation::read(&words, span, diagnostics);
                }
                _ => read
                    .specialisations
                    .extend(specialisation(&words, span, diagnostics)),
            }
        }
        read
    }
}

/// How an attribute is written, for hints.
fn example(attribute: &str) -> &'static str {
    match attribute {
        "generate" => "write for example generate(value, gradient(x, c.y), columns)",
        "domain" => DOMAIN,
        "approximate" => approximation::EXAMPLE,
        _ => SPECIALISATION,
    }
}

const DOMAIN: &str = "write comparisons with a number: x > 0.0, x <= 2.0 or x != 0.0";

const SPECIALISATION: &str =
    "write for example specialise(phi_on_sir, omega = speed, generate(gradient(speed)))";

fn words(attribute: &Attribute, example: &str, diagnostics: &mut Diagnostics) -> Option<Vec<Expr>> {
    let parser = Punctuated::<Expr, Token![,]>::parse_terminated;
    let tokens = match &attribute.meta {
        syn::Meta::List(list) => list.tokens.clone(),
        _ => proc_macro2::TokenStream::new(),
    };
    match parser.parse2(tokens) {
        Ok(words) => Some(words.into_iter().collect()),
        Err(error) => {
            diagnostics.syntax(&error, example);
            None
        }
    }
}

/// The word of `word` or `word(arguments)`.
fn head(expression: &Expr) -> Option<(&Ident, Vec<&Expr>)> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(|ident| (ident, Vec::new())),
        Expr::Call(call) => match call.func.as_ref() {
            Expr::Path(path) => path
                .path
                .get_ident()
                .map(|ident| (ident, call.args.iter().collect())),
            _ => None,
        },
        _ => None,
    }
}

const FORMS: [&str; 7] = [
    "value", "gradient", "hessian", "columns", "stage", "chain", "budget",
];

fn request(words: &[Expr], span: Span, diagnostics: &mut Diagnostics) -> Request {
    let mut request = Request::default();
    if words.is_empty() {
        diagnostics.error_with_hint(
            span,
            "`generate` names no form",
            "write one of value, gradient(x, y), hessian(x, y), columns, stage(x)",
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
            "hessian" => request.hessian = Some(targets(&arguments, diagnostics)),
            "stage" => request.stages.extend(stage(name, &arguments, diagnostics)),
            "chain" => request.chain = Some(chain(name, &arguments, diagnostics)),
            "budget" => budget(&mut request.budget, name, &arguments, diagnostics),
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

fn targets(arguments: &[&Expr], diagnostics: &mut Diagnostics) -> Vec<Target> {
    arguments
        .iter()
        .filter_map(|argument| target(argument, diagnostics))
        .collect()
}

/// `omega`, `c.beta` or `a[0]` as the name of a symbol.
fn target(expression: &Expr, diagnostics: &mut Diagnostics) -> Option<Target> {
    let symbol = symbol_path(expression);
    if symbol.is_none() {
        diagnostics.error_with_hint(
            expression.span(),
            "not the name of a number",
            "write a parameter `x`, a field `c.x` or an element `a[0]`",
        );
    }
    Some(Target {
        symbol: symbol?,
        span: expression.span(),
    })
}

fn symbol_path(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        Expr::Field(field) => {
            let base = symbol_path(&field.base)?;
            match &field.member {
                syn::Member::Named(name) => Some(format!("{base}.{name}")),
                syn::Member::Unnamed(index) => Some(format!("{base}.{}", index.index)),
            }
        }
        Expr::Index(index) => match index.index.as_ref() {
            Expr::Lit(syn::ExprLit {
                lit: Lit::Int(position),
                ..
            }) => Some(format!(
                "{}[{}]",
                symbol_path(&index.expr)?,
                position.base10_digits()
            )),
            _ => None,
        },
        _ => None,
    }
}

fn budget(
    limits: &mut Vec<Limit>,
    name: &Ident,
    arguments: &[&Expr],
    diagnostics: &mut Diagnostics,
) {
    const EXAMPLE: &str = "write for example budget(operations = 96, div = 1)";
    if arguments.is_empty() {
        diagnostics.error_with_hint(name.span(), "the budget names no count", EXAMPLE);
    }
    for argument in arguments {
        let entry = match argument {
            Expr::Assign(assign) => (head(&assign.left), assign.right.as_ref()),
            _ => (None, *argument),
        };
        let (
            Some((key, _)),
            Expr::Lit(syn::ExprLit {
                lit: Lit::Int(most),
                ..
            }),
        ) = entry
        else {
            diagnostics.error_with_hint(
                argument.span(),
                "an entry of the budget is a count and a whole number",
                EXAMPLE,
            );
            continue;
        };
        let Some(measure) = Measure::named(&key.to_string()) else {
            diagnostics.error_with_hint(
                key.span(),
                format!("unknown count `{key}`"),
                format!("counts are {}", Measure::NAMES.join(", ")),
            );
            continue;
        };
        if limits.iter().any(|limit| limit.measure == measure) {
            diagnostics.error_with_hint(
                argument.span(),
                format!("`{key}` has a limit already"),
                "leave one of the two",
            );
            continue;
        }
        match most.base10_parse() {
            Ok(most) => limits.push(Limit {
                measure,
                most,
                span: argument.span(),
            }),
            Err(error) => diagnostics.syntax(&error, EXAMPLE),
        }
    }
}

fn domain(condition: &Expr, diagnostics: &mut Diagnostics) -> Option<(Target, Domain)> {
    if let Expr::Binary(binary) = condition
        && let Some(bound) = number(&binary.right)
    {
        let domain = match binary.op {
            BinOp::Gt(_) if bound == 0.0 => Some(Domain::of_sign(Sign::POSITIVE)),
            BinOp::Ge(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_NEGATIVE)),
            BinOp::Lt(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NEGATIVE)),
            BinOp::Le(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_POSITIVE)),
            BinOp::Ne(_) if bound == 0.0 => Some(Domain::of_sign(Sign::NOT_ZERO)),
            // Whether the bound itself is in it is no matter to a form.
            BinOp::Gt(_) | BinOp::Ge(_) => Some(Domain::at_least(bound)),
            BinOp::Lt(_) | BinOp::Le(_) => Some(Domain::at_most(bound)),
            _ => None,
        };
        if let Some(domain) = domain {
            return target(&binary.left, diagnostics).map(|target| (target, domain));
        }
    }
    diagnostics.error_with_hint(condition.span(), "not a domain", DOMAIN);
    None
}

/// A literal number of an attribute.
fn number(expression: &Expr) -> Option<f64> {
    match expression {
        Expr::Lit(syn::ExprLit {
            lit: Lit::Float(value),
            ..
        }) => value.base10_parse().ok(),
        Expr::Lit(syn::ExprLit {
            lit: Lit::Int(value),
            ..
        }) => value.base10_parse().ok(),
        Expr::Unary(syn::ExprUnary {
            op: syn::UnOp::Neg(_),
            expr,
            ..
        }) => number(expr).map(|value: f64| -value),
        _ => None,
    }
}

fn specialisation(
    words: &[Expr],
    span: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Specialisation> {
    let mut words = words.iter();
    let Some((name, _)) = words.next().and_then(head) else {
        diagnostics.error_with_hint(
            span,
            "a specialisation begins with the new function's name",
            SPECIALISATION,
        );
        return None;
    };
    let mut specialisation = Specialisation {
        name: name.clone(),
        replacements: Vec::new(),
        request: Request {
            value: true,
            ..Request::default()
        },
    };
    let before = diagnostics.len();
    for word in words {
        match word {
            Expr::Assign(assign) => match target(&assign.left, diagnostics) {
                Some(target) if replaces(&specialisation.replacements, &target) => {
                    diagnostics.error_with_hint(
                        target.span,
                        format!("`{}` is replaced already", target.symbol),
                        "leave one of the two",
                    );
                }
                Some(target) => {
                    let expression = assign.right.as_ref().clone();
                    specialisation.replacements.push((target, expression));
                }
                None => {}
            },
            Expr::Call(call) if head(word).is_some_and(|(name, _)| name == "generate") => {
                let forms: Vec<Expr> = call.args.iter().cloned().collect();
                specialisation.request = request(&forms, call.span(), diagnostics);
            }
            _ => diagnostics.error_with_hint(
                word.span(),
                "not a part of a specialisation",
                SPECIALISATION,
            ),
        }
    }
    if specialisation.replacements.is_empty() && diagnostics.len() == before {
        diagnostics.error_with_hint(
            name.span(),
            "the specialisation fixes no parameter",
            SPECIALISATION,
        );
    }
    (diagnostics.len() == before).then_some(specialisation)
}

/// Whether the number, or the parameter that it is of, is among those replaced, or a number of it is.
fn replaces(replacements: &[(Target, Expr)], target: &Target) -> bool {
    replacements.iter().any(|(known, _)| {
        let both_whole = known.symbol == target.symbol;
        let one_whole = known.symbol == known.root() || target.symbol == target.root();
        both_whole || (one_whole && known.root() == target.root())
    })
}
