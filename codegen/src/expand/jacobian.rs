//! Jacobians: forms of results of several numbers alone.

use syn::spanned::Spanned;

use super::Expansion;
use crate::parse::module::Function;
use crate::parse::value::Value;

impl Expansion {
    /// Reports a Jacobian that is asked for of one number.
    pub(super) fn check_jacobian(&mut self, function: &Function, value: &Value) -> Option<()> {
        let request = function.request.as_ref()?;
        if request.jacobian.is_none() || !matches!(value, Value::Number(_)) {
            return Some(());
        }
        self.diagnostics.error_with_hint(
            function.item.sig.output.span(),
            format!(
                "`{}` gives one number, a Jacobian is of several",
                function.name()
            ),
            "ask for its gradient: gradient(x, y)",
        );
        None
    }
}
