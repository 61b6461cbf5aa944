//! Functions and constants that need their own value.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::Visit;

use super::module::{Function, Module};
use crate::diagnostics::Diagnostics;

/// What each name needs, with the token at which it does.
type Needs = BTreeMap<String, Vec<(String, Span)>>;

/// Reports functions that call themselves, and constants that need themselves, through however many others. No formula
/// is followed into them.
pub(super) fn check(module: &mut Module, diagnostics: &mut Diagnostics) {
    let calls: Needs = module
        .functions
        .iter()
        .map(|function| (function.name(), calls_of(module, function)))
        .collect();
    let cyclic = report(&calls, diagnostics, |names| match names {
        [_] => (
            "a function that calls itself is not a part of a formula".to_owned(),
            "write the terms out",
        ),
        names => (
            format!(
                "functions that call each other are not a part of a formula: {}",
                chain(names)
            ),
            "write the terms out, or give one of them its own formula",
        ),
    });
    for function in &mut module.functions {
        Rc::make_mut(function).readable &= !cyclic.contains(&function.name());
    }
    let constants = module.constants.iter();
    let constants: Needs = constants
        .map(|(name, value)| (name.clone(), names_of(value)))
        .collect();
    module.cyclic_constants = report(&constants, diagnostics, |names| {
        (
            format!("the value of this constant needs itself: {}", chain(names)),
            "give one of them a value of its own",
        )
    });
}

/// `a → b → a`
fn chain(names: &[String]) -> String {
    let names = names.iter().chain(names.first());
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    names.join(" → ")
}

/// Reports every cycle where it closes; gives the names on cycles.
fn report(
    needs: &Needs,
    diagnostics: &mut Diagnostics,
    text: impl Fn(&[String]) -> (String, &'static str),
) -> BTreeSet<String> {
    let mut cyclic = BTreeSet::new();
    let mut done = BTreeSet::new();
    for start in needs.keys() {
        // Depth first; the path holds each name with how many of its needs are followed.
        let mut path: Vec<(&String, usize)> = Vec::new();
        if !done.contains(start) {
            path.push((start, 0));
        }
        while let Some((name, next)) = path.last_mut() {
            let Some((needed, span)) = needs.get(*name).and_then(|needed| needed.get(*next)) else {
                done.insert(*name);
                path.pop();
                continue;
            };
            *next += 1;
            if let Some(begin) = path.iter().position(|(name, _)| *name == needed) {
                let names: Vec<String> = path[begin..]
                    .iter()
                    .map(|(name, _)| (*name).clone())
                    .collect();
                let (message, hint) = text(&names);
                diagnostics.error_with_hint(*span, message, hint);
                cyclic.extend(names);
            } else if !done.contains(needed)
                && let Some((needed, _)) = needs.get_key_value(needed)
            {
                path.push((needed, 0));
            }
        }
    }
    cyclic
}

/// The functions of its module that a function calls, those in the factor of its approximation among them. Those of
/// modules that are linked do not call back: modules that link each other in a circle are refused.
fn calls_of(module: &Module, function: &Function) -> Vec<(String, Span)> {
    struct Calls<'m>(&'m Module, Vec<(String, Span)>);
    impl<'ast> Visit<'ast> for Calls<'_> {
        fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
            if let syn::Expr::Path(path) = call.func.as_ref()
                && let Some((callee, _)) = self.0.callee(&path.path)
                && callee.home.key == self.0.key
            {
                self.1.push((callee.function.name(), path.path.span()));
            }
            syn::visit::visit_expr_call(self, call);
        }
    }
    let mut calls = Calls(module, Vec::new());
    calls.visit_block(&function.item.block);
    let factor = function.approximation.as_ref();
    if let Some(factor) = factor.and_then(|approximation| approximation.factor.as_ref()) {
        calls.visit_expr(factor);
    }
    calls.1
}

/// The names in a constant's value.
fn names_of(value: &syn::Expr) -> Vec<(String, Span)> {
    struct Names(Vec<(String, Span)>);
    impl<'ast> Visit<'ast> for Names {
        fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
            if let Some(name) = path.path.get_ident() {
                self.0.push((name.to_string(), name.span()));
            }
        }
    }
    let mut names = Names(Vec::new());
    names.visit_expr(value);
    names.0
}
