//! The statements of a formula: bindings, their patterns, and the value that a block ends with.

use syn::spanned::Spanned;
use syn::{Expr, Item, Pat, Stmt, Type};

use super::{Reader, Scope};
use crate::parse::module::bound_names;
use crate::parse::value::Value;

/// The names of a binding that failed: they count as known, so that its mistake is reported once.
fn unread(pattern: &Pat) -> impl Iterator<Item = (String, Option<Value>)> {
    bound_names(pattern).into_iter().map(|name| (name, None))
}

impl<'m> Reader<'m> {
    /// The block's value; only a function's own block may say `return`, which in another would leave that function.
    pub(super) fn block(
        &mut self,
        block: &syn::Block,
        scope: &mut Scope,
        own: bool,
    ) -> Option<Value> {
        let mut ending = None;
        let mut failed = self.constants_of(block, scope).is_none();
        for statement in &block.stmts {
            if ending.is_some() && !failed {
                let hint = "the formula ends at the expression before it";
                self.diagnostics.error_with_hint(
                    statement.span(),
                    "this statement is never reached",
                    hint,
                );
                failed = true;
            }
            if failed && ending.is_some() {
                break;
            }
            match statement {
                Stmt::Item(Item::Const(_)) => {}
                Stmt::Local(local) => failed |= self.binding(local, scope).is_none(),
                Stmt::Expr(
                    Expr::Return(syn::ExprReturn {
                        expr: Some(value), ..
                    }),
                    _,
                ) if own => {
                    let value = self.expression(value, scope);
                    failed |= value.is_none();
                    ending = Some(value);
                }
                Stmt::Expr(value, None) => {
                    let value = self.expression(value, scope);
                    failed |= value.is_none();
                    ending = Some(value);
                }
                other => {
                    self.diagnostics.error_with_hint(
                        other.span(),
                        "this statement is not a part of a formula",
                        "a formula is `let` bindings, constants and an expression",
                    );
                    failed = true;
                }
            }
        }
        if ending.is_none() && !failed {
            self.diagnostics.error_with_hint(
                block.brace_token.span.join(),
                "the formula has no value",
                "end it with an expression",
            );
        }
        ending.flatten().filter(|_| !failed)
    }

    /// Takes the constants of a block, which all of it sees, also what stands before them.
    fn constants_of(&mut self, block: &syn::Block, scope: &mut Scope) -> Option<()> {
        let mut complete = Some(());
        for statement in &block.stmts {
            let Stmt::Item(Item::Const(constant)) = statement else {
                continue;
            };
            let is_number =
                matches!(constant.ty.as_ref(), Type::Path(path) if path.path.is_ident("f64"));
            let value = if is_number {
                self.number(&constant.expr, scope).map(Value::Number)
            } else {
                let hint = "constants of a formula are f64: `const K: f64 = 2.0;`";
                self.unsupported(constant.ty.span(), "a constant of this type", hint)
            };
            complete = complete.filter(|()| value.is_some());
            scope.insert(constant.ident.to_string(), value);
        }
        complete
    }

    fn binding(&mut self, local: &syn::Local, scope: &mut Scope) -> Option<()> {
        let Some(init) = local.init.as_ref().filter(|init| init.diverge.is_none()) else {
            self.diagnostics.error_with_hint(
                local.span(),
                "a binding needs its value at once",
                "write `let x = …;`",
            );
            scope.extend(unread(&local.pat));
            return None;
        };
        let value = self.expression(&init.expr, scope);
        let failed = value.is_none();
        if self.bind(&local.pat, value, scope).is_none() {
            scope.extend(unread(&local.pat));
            return None;
        }
        (!failed).then_some(())
    }

    fn bind(&mut self, pattern: &Pat, value: Option<Value>, scope: &mut Scope) -> Option<()> {
        match pattern {
            Pat::Ident(name)
                if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() =>
            {
                let text = name.ident.to_string();
                if let Some(Value::Number(id)) = value {
                    self.graph.suggest_name(id, &text);
                }
                scope.insert(text, value);
                Some(())
            }
            Pat::Type(typed) => self.bind(&typed.pat, value, scope),
            Pat::Paren(inner) => self.bind(&inner.pat, value, scope),
            Pat::Wild(_) => Some(()),
            Pat::Tuple(tuple) => {
                let parts = match value {
                    Some(Value::Tuple(parts)) if parts.len() == tuple.elems.len() => {
                        parts.into_iter().map(Some).collect()
                    }
                    None => vec![None; tuple.elems.len()],
                    Some(other) => {
                        self.diagnostics.error_with_hint(
                            tuple.span(),
                            format!(
                                "{} can't be taken apart into {} parts",
                                other.description(),
                                tuple.elems.len()
                            ),
                            "bind it to one name, or take apart a tuple of as many parts",
                        );
                        return None;
                    }
                };
                let mut complete = Some(());
                for (pattern, part) in tuple.elems.iter().zip(parts) {
                    complete = self.bind(pattern, part, scope).and(complete);
                }
                complete
            }
            Pat::Ident(name) => {
                let hint = "a formula never changes a number; bind the new one to another name";
                self.diagnostics
                    .error_with_hint(name.span(), "a binding is a plain name", hint);
                None
            }
            other => {
                self.diagnostics.error_with_hint(
                    other.span(),
                    "this pattern is not a part of a formula",
                    "bind a name or a tuple of names",
                );
                None
            }
        }
    }
}
