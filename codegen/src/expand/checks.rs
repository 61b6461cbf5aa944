//! What is reported once formulas are read and generated: results without code, budgets that are exceeded, formulas that
//! were not read.

use syn::spanned::Spanned;

use super::Expansion;
use super::formula::holds_integral;
use crate::cost::Cost;
use crate::emit::scalar::Form;
use crate::emit::staged;
use crate::graph::{ExprId, Graph};
use crate::parse::attributes::{Request, StageRequest};
use crate::parse::module::Function;
use crate::parse::value::Value;

impl Expansion {
    /// Reports a result that no code can be generated for.
    pub(super) fn check_generable(
        &mut self,
        function: &Function,
        graph: &Graph,
        value: &Value,
        numbers: &[ExprId],
    ) -> Option<()> {
        let name = function.name();
        if holds_integral(graph, numbers) {
            self.diagnostics.error_with_hint(
                function.item.sig.ident.span(),
                format!("`{name}` holds an integral, which no code is generated for"),
                "give the integral a function of its own with #[approximate(…)]",
            );
            return None;
        }
        if let Some(parameter) = value.whole_parameter() {
            let end = function.item.block.stmts.last().map(Spanned::span);
            self.diagnostics.error_with_hint(
                end.unwrap_or_else(|| function.item.sig.ident.span()),
                format!("`{name}` gives its parameter `{parameter}` as a whole"),
                format!("write the struct literal with its fields: `{parameter}.field`"),
            );
            return None;
        }
        Some(())
    }

    /// Whether a stage has the module name of one before it, which is reported.
    pub(super) fn is_stage_repeated(&mut self, stages: &[StageRequest], place: usize) -> bool {
        let name = |stage: &StageRequest| staged::module_name(&stage.symbols());
        let mut names = stages.iter().map(name);
        let Some(own) = names.nth(place) else {
            return false;
        };
        let is_repeated = stages[..place].iter().any(|stage| name(stage) == own);
        if is_repeated {
            self.diagnostics.error_with_hint(
                stages[place].span,
                format!("a second stage whose module is `{own}`"),
                "leave one of them, or name its parameters in another order",
            );
        }
        is_repeated
    }

    /// Reports a form that takes more operations than its budget allows.
    pub(super) fn check_budget(
        &mut self,
        function: &Function,
        request: &Request,
        form: Form,
        cost: Cost,
    ) {
        for limit in &request.budget {
            let count = cost.measure(limit.measure);
            if count > limit.most {
                self.diagnostics.error_with_hint(
                    limit.span,
                    format!(
                        "`{}::{}` takes {count} {}, {} more than its budget of {}",
                        function.name(),
                        form.name(),
                        limit.measure.name(),
                        count - limit.most,
                        limit.most
                    ),
                    format!("its counts are {cost}"),
                );
            }
        }
    }

    /// Nothing stands in for generated code without an error, be it in a linked module.
    pub(super) fn report_unread(&mut self) {
        let unread = self.module.functions.iter().find(|function| {
            let name = function.name();
            self.forms.contains_key(&name) && self.formula(&name).is_none()
        });
        let reported = !self.diagnostics.is_empty() || self.linked_mistake;
        if let Some(function) = unread.filter(|_| !reported) {
            self.diagnostics.error_with_hint(
                function.item.sig.ident.span(),
                format!("`{}` was not read", function.name()),
                "formulas are read before code is generated from them",
            );
        }
    }
}
