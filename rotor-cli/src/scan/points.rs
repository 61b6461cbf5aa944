//! The table of a scan's points: a row each, the inputs that vary, then the quantities.

use std::io;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_schema::SchemaRef;
use rotor_core::input::INPUTS;
use rotor_core::study::{Axis, Chunk, Plan};
use serde_json::json;

use crate::files::{Format, Layout, number_field, schema};

/// The layout of the table of a plan's points.
pub(super) fn layout(plan: &Plan, format: Format, about: &str) -> Layout {
    let inputs = plan.space().axes().iter().flat_map(Axis::variables);
    let inputs = inputs.map(|variable| {
        let about = (variable.symbol(), variable.unit(), variable.description());
        number_field(variable.name(), false, about)
    });
    let quantities = plan.quantities().iter().map(|quantity| {
        let about = (quantity.symbol(), quantity.unit(), quantity.description());
        number_field(quantity.name(), true, about)
    });
    Layout {
        format,
        schema: schema(inputs.chain(quantities).collect(), about.to_owned()),
        rows: plan.space().len(),
        longest_text: 0,
    }
}

/// What a file says about its scan: the axes with their units, and the rotor about which they vary.
pub(super) fn about(plan: &Plan) -> String {
    let axes = plan.space().axes().iter().map(|axis| {
        let inputs = axis.variables().enumerate().map(|(column, variable)| {
            json!({
                "input": variable.name(),
                "symbol": variable.symbol(),
                "unit": variable.unit(),
                "first": axis.value(column, 0),
                "last": axis.value(column, axis.len() - 1),
            })
        });
        json!({ "length": axis.len(), "inputs": inputs.collect::<Vec<_>>() })
    });
    let base = plan.base();
    let numbers = INPUTS
        .iter()
        .map(|input| (input.name.to_owned(), json!((input.get)(base))));
    let choices = [
        ("crack_model".to_owned(), json!(base.crack_model.name())),
        ("crack_edge".to_owned(), json!(base.crack_edge.name())),
    ];
    let quantities = plan.quantities().iter().map(|quantity| {
        json!({ "name": quantity.name(), "symbol": quantity.symbol(), "unit": quantity.unit() })
    });
    json!({
        "axes": axes.collect::<Vec<_>>(),
        "quantities": quantities.collect::<Vec<_>>(),
        "rotor": numbers.chain(choices).collect::<serde_json::Map<_, _>>(),
    })
    .to_string()
}

/// A chunk as a batch of rows.
pub(super) fn batch(
    chunk: &Chunk<'_>,
    schema: &SchemaRef,
    quantities: usize,
) -> io::Result<RecordBatch> {
    let mut columns: Vec<ArrayRef> = Vec::new();
    for (number, axis) in chunk.space().axes().iter().enumerate() {
        for column in 0..axis.variables().len() {
            columns.push(Arc::new(Float64Array::from(chunk.values(number, column))));
        }
    }
    for quantity in 0..quantities {
        let column = chunk.quantity(quantity);
        let array = match column.complete() {
            Some(values) => Float64Array::from(values.to_vec()),
            None => column.iter().collect(),
        };
        columns.push(Arc::new(array));
    }
    RecordBatch::try_new(Arc::clone(schema), columns).map_err(io::Error::other)
}
