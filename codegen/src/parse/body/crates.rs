//! Functions of other crates, which the standard library has not.

use proc_macro2::Span;
use syn::spanned::Spanned;

use super::{Reader, Scope};
use crate::graph::{ExprId, Function};
use crate::parse::value::Value;

impl<'m> Reader<'m> {
    /// `libm::erf(x)`
    pub(super) fn function_of_crate(
        &mut self,
        function: Function,
        call: &syn::ExprCall,
        scope: &mut Scope,
    ) -> Option<Value> {
        let arguments = call.args.iter();
        let arguments: Vec<Option<ExprId>> = arguments
            .map(|argument| self.number(argument, scope))
            .collect();
        let row = function.row();
        if arguments.len() != row.arity {
            let message = format!(
                "`{}` takes one argument, not {}",
                row.method,
                arguments.len()
            );
            let hint = format!("write `libm::{}(x)`", row.method);
            self.diagnostics.error_with_hint(call.span(), message, hint);
            return None;
        }
        let arguments: Vec<ExprId> = arguments.into_iter().collect::<Option<_>>()?;
        Some(Value::Number(self.graph.apply(function, arguments)))
    }

    /// Reports a function that formulas have not of a crate of which they have others. Answers whether it is one.
    pub(super) fn report_unknown_of_crate(&mut self, names: &[String], span: Span) -> bool {
        let [of, name] = names else {
            return false;
        };
        let known = Function::of_crate_named(of);
        if known.is_empty() {
            return false;
        }
        let message = format!("unknown function `{of}::{name}`");
        let hint = format!("of the crate `{of}` formulas have {}", known.join(", "));
        self.diagnostics.error_with_hint(span, message, hint);
        true
    }
}
