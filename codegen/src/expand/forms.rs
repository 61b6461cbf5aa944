//! The forms of one function, each by the way from its partials to a circuit to code.

use proc_macro2::TokenStream;

use super::fallback::{column_stubs, stub};
use super::text::{as_written, documentation};
use super::{Expansion, derive, derive_held, derive_written};
use crate::circuit::Circuit;
use crate::emit::chain::weights;
use crate::emit::scalar::{self, Form};
use crate::factor;
use crate::graph::{Graph, SymbolId};
use crate::parse::attributes::{Request, Target};
use crate::parse::module::Function;
use crate::parse::numbers;

/// One generated function.
#[derive(Debug)]
pub struct Generated {
    /// The circuit behind it.
    pub circuit: Circuit,
    /// The graph that its symbols and tables belong to.
    pub graph: Graph,
    /// What it returns.
    pub form: Form,
    /// The symbols it is derived by.
    pub by: Vec<SymbolId>,
    /// The function.
    pub tokens: TokenStream,
}

impl Expansion {
    /// Generates all forms that a function asks for, and adds them to the items of its module.
    pub(super) fn requested(
        &mut self,
        function: &Function,
        request: &Request,
        items: &mut Vec<TokenStream>,
    ) {
        let mut forms = vec![(request.value || request.columns, Form::Value, &[][..])];
        if let Some(by) = &request.gradient {
            forms.push((true, Form::Gradient, by.as_slice()));
        }
        if let Some(by) = &request.jacobian {
            forms.push((true, Form::Jacobian, by.as_slice()));
        }
        if let Some(by) = &request.hessian {
            forms.push((true, Form::Hessian, by.as_slice()));
        }
        // All are made known first: the columns of every form are those of all forms.
        for (_, _, by) in &forms {
            self.symbols(function, by);
        }
        let mut richest = None;
        let mut column_forms = Vec::new();
        for (wanted, form, by) in forms {
            let Some(generated) = self.generate(function, form, by).filter(|_| wanted) else {
                if wanted {
                    items.push(stub(&self.module, function, form, by.len()));
                }
                continue;
            };
            items.push(generated.tokens.clone());
            richest = Some((form, generated.circuit.cost()));
            if request.columns && form < Form::Hessian {
                column_forms.push(generated);
            }
        }
        for form in &column_forms {
            self.use_tables_in_packs(&form.graph, &form.circuit);
        }
        if !column_forms.is_empty() {
            items.extend(self.column_items(function, &column_forms));
        } else if request.columns {
            self.uses_columns = true;
            items.push(column_stubs(function, request));
        }
        let mut staged = Vec::new();
        for (place, stage) in request.stages.iter().enumerate() {
            if self.is_stage_repeated(&request.stages, place) {
                continue;
            }
            let (item, weights) = self.staged_item(function, stage);
            items.push(item);
            staged.push(weights);
        }
        let of_values = column_forms.iter().find(|form| form.form == Form::Value);
        let rows = of_values.map(|form| form.circuit.cost().weight());
        if request.chain.is_some() {
            items.push(weights(rows, &staged));
            self.join_chain(function, request);
        }
        if let Some((form, cost)) = richest {
            self.check_budget(function, request, form, cost);
        }
    }

    /// Generates one form of a function. `None` if the function could not be read or a name is unknown, which is
    /// reported.
    pub fn generate(
        &mut self,
        function: &Function,
        form: Form,
        by: &[Target],
    ) -> Option<Generated> {
        let by = self.symbols(function, by)?;
        let formula = self.formula(&function.name())?;
        let by = if form == Form::Value { Vec::new() } else { by };
        let (graph, outputs) = derive(formula, form, &by);
        let held = matches!(form, Form::Gradient | Form::Jacobian)
            .then(|| derive_held(formula, &by))
            .flatten();
        let written = derive_written(formula, form, &by);
        let found = factor::minimise_with(&graph, &outputs, &written, held.as_ref(), self.passes);
        let circuit = found.circuit;
        self.use_tables(&graph, &circuit);
        let mut documentation = documentation(function, &graph, form, &by, circuit.cost());
        documentation.extend(found.as_written.iter().flat_map(as_written));
        let value = &self.formula(&function.name())?.value;
        let tokens = scalar::function(
            &graph,
            &circuit,
            function,
            value,
            form,
            by.len(),
            &documentation,
        );
        Some(Generated {
            circuit,
            graph,
            form,
            by,
            tokens,
        })
    }

    /// The symbols to derive by; all that the function's source names where the list is empty. `None` if one is no number
    /// of the function, which is reported with the module.
    pub(super) fn symbols(&mut self, function: &Function, by: &[Target]) -> Option<Vec<SymbolId>> {
        let name = function.name();
        if by.is_empty() {
            return self.named.get(&name).cloned();
        }
        let formula = self.formulas.get_mut(&name)?.as_mut()?;
        let by = by.iter().map(|target| {
            let misfit = numbers::misfit(function, &target.symbol);
            let fits = misfit.is_none() && function.parameter(target.root()).is_some();
            fits.then(|| formula.input(&target.symbol))
        });
        by.collect()
    }
}
