//! What a path of a body stands for: a variable, or a constant of a module or of the standard library.

use syn::spanned::Spanned;

use super::{Reader, Scope};
use crate::diagnostics::nearest;
use crate::parse::literal;
use crate::parse::module::Module;
use crate::parse::names::names_of;
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    pub(super) fn path(&mut self, path: &syn::Path, scope: &mut Scope) -> Option<Value> {
        let last = path.segments.last()?;
        let name = last.ident.to_string();
        if path.segments.len() == 1
            && let Some(variable) = scope.find(&name)
        {
            let value = self.variable(variable, scope)?;
            self.note(&value);
            return Some(value);
        }
        let module = self.module;
        if let Some((home, name)) = module.constant(path) {
            return self.constant_of(home, name);
        }
        if let Some(standard) = self.module.imports.constant(path)
            && let Some(id) = literal::constant(&mut self.graph, &standard)
        {
            return Some(Value::Number(id));
        }
        if let Some(value) = names_of(path).strip_suffix(std::slice::from_ref(&name))
            && is_type(value)
            && let Some(value) = literal::of_type(&name)
        {
            return Some(Value::Number(self.graph.number(value)));
        }
        if literal::CONSTANTS.contains(&name.as_str()) || path.segments.len() > 1 {
            self.diagnostics.error_with_hint(
                path.span(),
                format!("the value of `{name}` is not known here"),
                "constants are those of the module and of std::f64::consts, by their path or imported in the module, and f64::EPSILON, MAX, MIN and MIN_POSITIVE",
            );
            return None;
        }
        let constants = self
            .module
            .constants
            .iter()
            .map(|(constant, _)| constant.as_str());
        let known = scope.names().chain(constants);
        let hint = match nearest(&name, known) {
            Some(candidate) => format!("did you mean `{candidate}`?"),
            None => "names are parameters, `let` bindings, constants of the module and of std::f64::consts".to_owned(),
        };
        self.diagnostics
            .error_with_hint(path.span(), format!("unknown name `{name}`"), hint);
        None
    }

    /// The value of a constant of a module.
    fn constant_of(&mut self, home: &'m Module, name: &str) -> Option<Value> {
        if home.cyclic_constants.contains(name) {
            return None;
        }
        let mut constants = home.constants.iter();
        let (_, value) = constants.find(|(constant, _)| constant == name)?;
        self.within(home, |reader| {
            reader.expression(value, &mut Scope::default())
        })
    }

    /// What work gives that looks names up in another module.
    pub(super) fn within<T>(&mut self, home: &'m Module, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.module, home);
        let result = work(self);
        self.module = before;
        result
    }
}

/// Whether a path is that of the type `f64`, or of the module of its name that has its constants.
fn is_type(path: &[String]) -> bool {
    matches!(path, [name] | [_, name] if name == "f64")
        && path
            .first()
            .is_some_and(|first| ["f64", "std", "core"].contains(&first.as_str()))
}
