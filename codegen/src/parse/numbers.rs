//! The numbers that attributes name: parameters, their fields and elements.

use std::collections::BTreeMap;

use super::attributes::{Request, Target, root};
use super::module::{Function, Module, ParameterKind};
use crate::diagnostics::{Diagnostics, alike};
use crate::graph::Domain;

/// Reports what a function's forms are derived by that is no number of it.
pub(super) fn check_targets(module: &Module, diagnostics: &mut Diagnostics) {
    for function in &module.functions {
        for target in function.request.iter().flat_map(Request::targets) {
            check(module, function, target, diagnostics);
        }
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
            check(module, function, &target, diagnostics);
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
pub(super) fn check(
    module: &Module,
    function: &Function,
    target: &Target,
    diagnostics: &mut Diagnostics,
) {
    if let Some(hint) = misfit(module, function, &target.symbol) {
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
pub(crate) fn misfit(module: &Module, function: &Function, symbol: &str) -> Option<String> {
    let name = root(symbol);
    let Some(parameter) = function.parameter(name) else {
        let bound = function.bound_names();
        return (!bound.iter().any(|bound| bound == name)).then(|| {
            let known = bound.iter().map(String::as_str);
            let meant = alike(name, known).map(|known| format!("{known}{}", &symbol[name.len()..]));
            match meant.filter(|meant| misfit(module, function, meant).is_none()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None if bound.is_empty() => "it has no parameters".to_owned(),
                None => format!("its parameters are {}", bound.join(", ")),
            }
        });
    };
    let part = &symbol[name.len()..];
    match parameter.kind {
        ParameterKind::Number => {
            (!part.is_empty()).then(|| format!("write `{name}`: it is a number"))
        }
        ParameterKind::Array(length) => {
            let fits = (0..length).any(|position| part == format!("[{position}]"));
            (!fits).then(|| match length.checked_sub(1) {
                Some(last) => format!("its elements are `{name}[0]` to `{name}[{last}]`"),
                None => format!("`{name}` is empty"),
            })
        }
        ParameterKind::Struct => {
            let field = part
                .strip_prefix('.')
                .filter(|field| !field.contains(['.', '[']));
            match (field, module.fields_of(&parameter.ty)) {
                (Some(_), None) => None,
                (None, None) => Some(format!("name a field of it: `{name}.field`")),
                (field, Some(fields)) => misfit_of_field(name, field, fields),
            }
        }
    }
}

fn misfit_of_field(name: &str, field: Option<&str>, fields: &[String]) -> Option<String> {
    if fields.iter().any(|known| Some(known.as_str()) == field) {
        return None;
    }
    let known = fields.iter().map(String::as_str);
    Some(match field.and_then(|field| alike(field, known)) {
        Some(known) => format!("did you mean `{name}.{known}`?"),
        None => {
            let fields: Vec<String> = fields
                .iter()
                .map(|field| format!("`{name}.{field}`"))
                .collect();
            format!("its numbers are {}", fields.join(", "))
        }
    })
}

/// All numbers of a function's parameters that its types and attributes tell; a struct from outside may have more.
pub(crate) fn known(module: &Module, function: &Function) -> Vec<String> {
    let mut numbers = Vec::new();
    for parameter in &function.parameters {
        let name = &parameter.name;
        match parameter.kind {
            ParameterKind::Number => numbers.push(name.to_string()),
            ParameterKind::Array(length) => {
                numbers.extend((0..length).map(|position| format!("{name}[{position}]")));
            }
            ParameterKind::Struct => {
                let fields = module.fields_of(&parameter.ty).unwrap_or_default();
                numbers.extend(fields.iter().map(|field| format!("{name}.{field}")));
            }
        }
    }
    let targets = function.request.iter().flat_map(Request::targets);
    let targets = targets.map(|target| &target.symbol);
    let domains = function.domain.iter().map(|(symbol, ..)| symbol);
    for symbol in targets.chain(domains) {
        if misfit(module, function, symbol).is_none() && !numbers.contains(symbol) {
            numbers.push(symbol.clone());
        }
    }
    numbers
}
