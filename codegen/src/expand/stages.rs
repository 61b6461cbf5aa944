//! Formulas in stages: what is generated along an inner parameter.

use proc_macro2::TokenStream;

use super::fallback::staged_stub;
use super::text::output_names;
use super::{Expansion, Formula, derive, derive_written};
use crate::emit::scalar::Form;
use crate::emit::staged;
use crate::graph::SymbolId;
use crate::parse::attributes::StageRequest;
use crate::parse::module::Function;
use crate::stage::{self, Staged};

impl Expansion {
    /// The module of a staged form, and what it costs for every value of what runs along and at every point.
    pub fn staged_item(
        &mut self,
        function: &Function,
        request: &StageRequest,
    ) -> (TokenStream, [usize; 2]) {
        let Some((staged, inner, outputs)) = self.staged(function, request) else {
            return (staged_stub(function, request), [0; 2]);
        };
        self.use_tables(&staged.graph, &staged.fixed);
        for circuit in [&staged.along, &staged.points] {
            self.use_tables_in_packs(&staged.graph, circuit);
        }
        let own = self.formula(&function.name()).map(Formula::inputs);
        let own = own.unwrap_or_default();
        let module = staged::module(&staged, function, &own, &inner, &outputs);
        let weights = [&staged.along, &staged.points].map(|circuit| circuit.cost().weight());
        (module, weights)
    }

    /// A function in stages, its inner symbols, and the names of its results. `None` if it could not be read or a name is
    /// unknown, which is reported.
    pub fn staged(
        &mut self,
        function: &Function,
        request: &StageRequest,
    ) -> Option<(Staged, Vec<SymbolId>, Vec<String>)> {
        let inner = self.symbols(function, &request.inner)?;
        let formula = self.formula(&function.name())?;
        let (graph, outputs) = derive(formula, Form::Value, &[]);
        let names = output_names(&formula.value, &graph, &[]);
        let set = inner.iter().copied().collect();
        let written = derive_written(formula, Form::Value, &[]);
        let circuit = stage::minimise(&graph, &outputs, &written, &set);
        Some((stage::split(&graph, &circuit, &set), inner, names))
    }
}
