//! The tables that generated code calls: those of the module's own functions, and those that linked modules have.

use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote};

use super::Expansion;
use crate::circuit::{Circuit, Operation};
use crate::emit::namer::{pack_table_function, table_function_of};
use crate::graph::{Graph, Table};
use crate::parse::tabulated::TableSource;
use crate::tables::{Lent, orders_for_others};

impl Expansion {
    /// The tables of a circuit.
    pub(super) fn use_tables(&mut self, graph: &Graph, circuit: &Circuit) {
        for net in circuit.nets() {
            if let Operation::Tabulated { table, order, .. } = circuit.operation(net)
                && let Some(known) = graph.tables.get(*table)
            {
                self.use_table(known, *order, false);
            }
        }
    }

    /// The tables of a circuit that runs in packs.
    pub(super) fn use_tables_in_packs(&mut self, graph: &Graph, circuit: &Circuit) {
        for net in circuit.nets() {
            if let Operation::Tabulated { table, order, .. } = circuit.operation(net)
                && let Some(known) = graph.tables.get(*table)
            {
                self.use_table(known, *order, false);
                self.use_table(known, *order, true);
            }
        }
    }

    /// The tables of the module's own functions that other modules may call, whether this one does or not.
    pub(super) fn lend_tables(&mut self) {
        let packs = self.module.runs_on_lanes();
        for function in self.module.functions.clone() {
            let module = &self.module;
            if let Some(most) = orders_for_others(&function)
                && let Some(approximation) = &function.approximation
                && let Some(table) = self.tables.table(module, module, &function, approximation)
            {
                let table = table.clone();
                for order in 0..=most {
                    self.use_table(&table, order, false);
                    if packs {
                        self.use_table(&table, order, true);
                    }
                }
            }
        }
    }

    fn use_table(&mut self, table: &Table, order: usize, in_packs: bool) {
        let function = table_function_of(&table.name, order);
        let name = if in_packs {
            pack_table_function(&function)
        } else {
            function.clone()
        };
        if self.used_tables.contains_key(&name) {
            return;
        }
        let lent = self.tables.lent(&table.name).cloned();
        let tokens = match lent {
            Some(lent) if lent.has(&self.module, order, in_packs) => {
                imported(&lent, &name, order, in_packs)
            }
            Some(_) => {
                let table = self.tables.in_full(&self.module, table);
                emitted(&table, order, in_packs, &quote!())
            }
            None => emitted(table, order, in_packs, &self.visibility(table, order)),
        };
        self.used_tables.insert(name, tokens);
    }

    /// How far the function of a table of the module's own is seen.
    fn visibility(&self, table: &Table, order: usize) -> TokenStream {
        let function = self.module.function(&table.name);
        let most = function.and_then(|function| orders_for_others(function));
        match most {
            Some(most) if order <= most => quote!(pub(crate)),
            _ => TokenStream::new(),
        }
    }
}

/// The import of a table's function from the module that has it.
fn imported(lent: &Lent, name: &str, order: usize, in_packs: bool) -> TokenStream {
    let function = table_function_of(&lent.function, order);
    let there = if in_packs {
        pack_table_function(&function)
    } else {
        function
    };
    let place = lent.place.tokens_within(Span::call_site());
    let [there, here] = [there.as_str(), name].map(|name| format_ident!("{name}"));
    if there == here {
        quote!(use #place::#there;)
    } else {
        quote!(use #place::#there as #here;)
    }
}

/// A table's function.
fn emitted(table: &Table, order: usize, in_packs: bool, visibility: &TokenStream) -> TokenStream {
    let function = table_function_of(&table.name, order);
    let name = format_ident!("{function}");
    let polynomial = table.derivative(order);
    let tokens = if in_packs {
        let of_pack = format_ident!("{}", pack_table_function(&function));
        polynomial.emit_for_packs(&name, visibility, &of_pack)
    } else {
        let summary = match order {
            0 => format!("`{}` without its factor.", table.name),
            order => format!(
                "Derivative of order {order} of `{}` without its factor.",
                table.name
            ),
        };
        polynomial.emit(&name, visibility, &summary)
    };
    // Others may call it where the module itself does not.
    let unused = (!visibility.is_empty()).then(|| quote!(#[allow(dead_code)]));
    quote!(#unused #tokens)
}
