//! The statements of a formula: constants, bindings, assignments, loops, and the value that a block ends with.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Item, Stmt, Type};

use super::assignments::assigns;
use super::patterns::unread;
use super::{Reader, Scope};
use crate::parse::value::Value;
use crate::parse::whole;

/// The most statements that are followed for one formula, those of loops and of called formulas as often as they are
/// passed. Each becomes an operation at least; of ten times fewer operations already one form alone is looked at.
pub(super) const MOST_STATEMENTS: usize = 100_000;

/// Whether an expression may stand alone for what it does.
fn acts(expression: &Expr) -> bool {
    match expression {
        Expr::Assign(_) | Expr::ForLoop(_) | Expr::If(_) | Expr::Match(_) | Expr::Block(_) => true,
        Expr::Binary(binary) => assigns(&binary.op),
        _ => false,
    }
}

impl<'m> Reader<'m> {
    /// The block's value; only a function's own block may say `return`, which in another would leave that function.
    pub(super) fn block(
        &mut self,
        block: &syn::Block,
        scope: &mut Scope,
        own: bool,
    ) -> Option<Value> {
        let mark = scope.enter();
        let value = self.statements(block, scope, own);
        scope.leave(mark);
        value
    }

    fn statements(&mut self, block: &syn::Block, scope: &mut Scope, own: bool) -> Option<Value> {
        let mut ending = None;
        let mut failed = self.constants_of(block, scope).is_none();
        for (place, statement) in block.stmts.iter().enumerate() {
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
            self.count_statement(statement.span())?;
            let is_last = place + 1 == block.stmts.len();
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
                Stmt::Expr(value, semicolon)
                    if acts(value) && !(is_last && semicolon.is_none()) =>
                {
                    failed |= self.action(value, scope).is_none();
                }
                Stmt::Expr(value, None) => {
                    let value = self.expression(value, scope);
                    failed |= value.is_none();
                    ending = Some(value);
                }
                other => {
                    self.unsupported_statement(other);
                    failed = true;
                }
            }
        }
        let has_value = |ending: &Option<Value>| !ending.as_ref().is_some_and(Value::is_nothing);
        if own && !failed && !ending.as_ref().is_some_and(has_value) {
            self.diagnostics.error_with_hint(
                block.brace_token.span.join(),
                "the formula has no value",
                "end it with an expression",
            );
            return None;
        }
        let ending = ending.unwrap_or_else(|| Some(Value::nothing()));
        ending.filter(|_| !failed)
    }

    /// An expression that stands alone for what it does.
    fn action(&mut self, expression: &Expr, scope: &mut Scope) -> Option<()> {
        let value = self.expression(expression, scope)?;
        if value.is_nothing() {
            return Some(());
        }
        let message = format!("{} that nothing is done with", value.description());
        self.diagnostics.error_with_hint(
            expression.span(),
            message,
            "bind it by `let`, or assign it to a variable",
        );
        None
    }

    fn unsupported_statement(&mut self, statement: &Stmt) {
        let (what, hint) = match statement {
            Stmt::Expr(Expr::Return(_), _) => (
                "a `return` within another block",
                "choose the value by `if … { a } else { b }`",
            ),
            Stmt::Expr(Expr::Break(_) | Expr::Continue(_), _) => (
                "a loop that is left early",
                "a loop goes over all that it names: choose by `if` what it does",
            ),
            Stmt::Expr(Expr::While(_) | Expr::Loop(_), _) => super::ENDLESS,
            _ => (
                "this statement",
                "a formula is `let` bindings, assignments, `for` and `if`, constants and an expression",
            ),
        };
        self.unsupported::<()>(statement.span(), what, hint);
    }

    /// Counts a statement that is followed. `None` if there are too many, which is reported once, at the outermost loop.
    pub(super) fn count_statement(&mut self, span: Span) -> Option<()> {
        self.statements += 1;
        if self.statements <= MOST_STATEMENTS {
            return Some(());
        }
        if !self.is_beyond {
            self.is_beyond = true;
            let message = format!("the formula has more than {MOST_STATEMENTS} statements");
            let hint = "those of a loop and of a called formula count as often as they are passed: shorten the loop, or sum over columns outside the formula";
            let span = self.outermost_loop.unwrap_or(span);
            self.diagnostics.error_with_hint(span, message, hint);
        }
        None
    }

    /// Takes the constants of a block, which all of it sees, also what stands before them.
    fn constants_of(&mut self, block: &syn::Block, scope: &mut Scope) -> Option<()> {
        let mut complete = Some(());
        for statement in &block.stmts {
            let Stmt::Item(Item::Const(constant)) = statement else {
                continue;
            };
            let value = match constant.ty.as_ref() {
                Type::Path(path) if path.path.is_ident("f64") => {
                    self.number(&constant.expr, scope).map(Value::Number)
                }
                Type::Path(path)
                    if path
                        .path
                        .get_ident()
                        .is_some_and(|name| whole::range_of(&name.to_string()).is_some()) =>
                {
                    self.expression(&constant.expr, scope)
                }
                Type::Array(_) => self.expression(&constant.expr, scope),
                other => {
                    let hint = "constants of a formula are numbers and arrays of them: `const K: f64 = 2.0;`, `const N: usize = 3;`";
                    self.unsupported(other.span(), "a constant of this type", hint)
                }
            };
            complete = complete.filter(|()| value.is_some());
            scope.bind(constant.ident.to_string(), value);
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
}
