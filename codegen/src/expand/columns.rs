//! The forms over columns of one function.

use proc_macro2::TokenStream;

use super::text::output_names;
use super::{Expansion, Generated};
use crate::emit::columns;
use crate::emit::scalar::Form;
use crate::parse::module::Function;

impl Expansion {
    /// The struct of the input columns, and for each form the function that fills its result columns.
    pub(super) fn column_items(
        &mut self,
        function: &Function,
        generated: &[Generated],
    ) -> Vec<TokenStream> {
        let Some(formula) = self.formula(&function.name()) else {
            return Vec::new();
        };
        let symbols = formula.inputs();
        let mut items = vec![columns::inputs_type(&columns::names_of(
            &formula.graph,
            &symbols,
        ))];
        for form in generated {
            let names = output_names(&formula.value, &form.graph, &form.by);
            let (body, name) = match form.form {
                Form::Value => ("Rows", "columns"),
                Form::Jacobian => ("JacobianRows", "jacobian_columns"),
                Form::Gradient | Form::Hessian => ("GradientRows", "gradient_columns"),
            };
            let cost = form.circuit.cost();
            let documentation = [
                format!(
                    " [`{}`](super::{}()) of each row: {}.",
                    form.form.name(),
                    function.name(),
                    names.join(", ")
                ),
                String::new(),
                format!(" Per row: {cost}."),
                String::new(),
                " # Errors".to_owned(),
                " A column that is not as long as the first result.".to_owned(),
            ];
            items.push(columns::function(
                &form.graph,
                &form.circuit,
                &symbols,
                &columns::Form {
                    body,
                    name,
                    outputs: &names,
                    documentation: &documentation,
                },
            ));
        }
        self.uses_columns = true;
        items
    }
}
