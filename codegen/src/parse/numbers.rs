//! The numbers that attributes name: parameters, their fields and elements.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::attributes::{Request, Target, root};
use super::module::{Function, Module};
use super::shape::Shape;
use crate::diagnostics::{Diagnostics, alike};
use crate::graph::Domain;

/// Puts the numbers of a parameter, or of a part of one, in its place among those that forms are derived by. Reports what is
/// neither that nor a number of the function.
pub(super) fn settle_targets(module: &mut Module, diagnostics: &mut Diagnostics) {
    for function in &mut module.functions {
        let function = Rc::make_mut(function);
        let Some(mut request) = function.request.take() else {
            continue;
        };
        let Request {
            gradient,
            jacobian,
            hessian,
            ..
        } = &mut request;
        for list in [gradient, jacobian, hessian].into_iter().flatten() {
            let targets = std::mem::take(list);
            list.extend(
                targets
                    .into_iter()
                    .flat_map(|target| numbers_of(function, target)),
            );
        }
        for target in request.targets() {
            check(function, target, diagnostics);
        }
        function.request = Some(request);
    }
}

/// The numbers of an array or a struct that is named; what is anything else stays.
fn numbers_of(function: &Function, target: Target) -> Vec<Target> {
    let part = function.parameter(target.root()).and_then(|parameter| {
        let path = &target.symbol[target.root().len()..];
        parameter.shape.part(target.root(), path).ok()
    });
    match part {
        Some(part) if *part != Shape::Number && part.count().is_some_and(|count| count > 0) => {
            let numbers = part.numbers(&target.symbol).into_iter();
            let span = target.span;
            numbers.map(|symbol| Target { symbol, span }).collect()
        }
        _ => vec![target],
    }
}

/// Reports domains of what is no number of the function, and such that nothing meets.
pub(super) fn check_domains(module: &Module, diagnostics: &mut Diagnostics) {
    for function in &module.functions {
        let mut domains: BTreeMap<&str, Domain> = BTreeMap::new();
        for (symbol, domain, span) in &function.domain {
            let target = Target {
                symbol: symbol.clone(),
                span: *span,
            };
            check(function, &target, diagnostics);
            let known = domains.entry(symbol).or_default();
            let both = known.and(*domain);
            if both.is_empty() {
                diagnostics.error_with_hint(
                    *span,
                    format!("no `{symbol}` meets this and what is said of it before"),
                    "leave one of the two",
                );
            } else {
                *known = both;
            }
        }
    }
}

/// Reports a name that is no number of the function.
pub(super) fn check(function: &Function, target: &Target, diagnostics: &mut Diagnostics) {
    if let Some(hint) = misfit(function, &target.symbol) {
        diagnostics.error_with_hint(
            target.span,
            format!(
                "`{}` is no number that `{}` takes",
                target.symbol,
                function.name()
            ),
            hint,
        );
    }
}

/// Why the name is no number of the function: what to write instead. `None` if it is one, or where its parameter can't be
/// taken, which is reported.
pub(crate) fn misfit(function: &Function, symbol: &str) -> Option<String> {
    let name = root(symbol);
    let Some(parameter) = function.parameter(name) else {
        let bound = function.bound_names();
        return (!bound.iter().any(|bound| bound == name)).then(|| {
            let known = bound.iter().map(String::as_str);
            let meant = alike(name, known).map(|known| format!("{known}{}", &symbol[name.len()..]));
            match meant.filter(|meant| misfit(function, meant).is_none()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None if bound.is_empty() => "it has no parameters".to_owned(),
                None => format!("its parameters are {}", bound.join(", ")),
            }
        });
    };
    match parameter.shape.part(name, &symbol[name.len()..]) {
        Err(hint) => Some(hint),
        Ok(Shape::Number) => None,
        Ok(part) => Some(match part.numbers(symbol).first() {
            Some(first) => format!("name a number of it: `{first}`"),
            None => format!("name a field of it: `{symbol}.field`"),
        }),
    }
}

/// All numbers of a function's parameters that its types and attributes tell; a struct from outside may have more.
pub(crate) fn known(function: &Function) -> Vec<String> {
    let mut numbers = Vec::new();
    for parameter in &function.parameters {
        numbers.extend(parameter.shape.numbers(&parameter.name.to_string()));
    }
    let targets = function.request.iter().flat_map(Request::targets);
    let targets = targets.map(|target| &target.symbol);
    let domains = function.domain.iter().map(|(symbol, ..)| symbol);
    for symbol in targets.chain(domains) {
        if misfit(function, symbol).is_none() && !numbers.contains(symbol) {
            numbers.push(symbol.clone());
        }
    }
    numbers
}
