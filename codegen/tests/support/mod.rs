//! What several tests share.
#![allow(dead_code, unreachable_pub, reason = "each test uses its part")]

pub mod bounded;
pub mod evaluator;
pub mod formulas;

use codegen::circuit::Circuit;
use codegen::diagnostics::Diagnostics;
use codegen::emit::scalar::Form;
use codegen::expand::{Expansion, Formula, Generated, derive, derive_written};
use codegen::factor;
use codegen::graph::{Sizes, SymbolId};
use codegen::parse::body::Reader;
use codegen::parse::module::Module;
use codegen::tables::Tables;

/// The module in a source text.
pub fn parsed(source: &str) -> syn::ItemMod {
    syn::parse_str(source).unwrap_or_else(|error| panic!("{error} in\n{source}"))
}

/// Sizes of numbers that leave the generator free to choose a form.
pub const EVERYDAY: Sizes = Sizes::Within {
    smallest: 1e-9,
    largest: 1e9,
};

/// The module of a source text, read, without mistakes, whose numbers are of everyday sizes.
pub fn module(source: &str) -> Module {
    let mut diagnostics = Diagnostics::default();
    let mut module = Module::read(parsed(source), &mut diagnostics);
    module.sizes = EVERYDAY;
    assert_eq!(messages(&diagnostics), Vec::<String>::new(), "{source}");
    module
}

/// The expansion of a source text without mistakes, whose numbers are of everyday sizes.
pub fn expansion(source: &str) -> Expansion {
    let attribute = quote::quote!(sizes = 1e-9..=1e9);
    let mut expansion = Expansion::unread(attribute, parsed(source));
    expansion.read_all();
    assert_eq!(
        messages(&expansion.diagnostics),
        Vec::<String>::new(),
        "{source}"
    );
    expansion
}

/// All messages with their hints.
pub fn messages(diagnostics: &Diagnostics) -> Vec<String> {
    diagnostics
        .iter()
        .map(|diagnostic| diagnostic.text())
        .collect()
}

/// One form of a function, by all that it uses.
pub fn generated(expansion: &mut Expansion, name: &str, form: Form) -> Generated {
    let function = expansion.module().function(name).cloned().unwrap();
    expansion.generate(&function, form, &[]).unwrap()
}

/// One function of a module alone, rewritten, so that the tables of the others need not be made.
pub fn formula(module: &Module, name: &str) -> Formula {
    let mut tables = Tables::default();
    let mut reader = Reader::new(module, &mut tables);
    let value = reader.read(module.function(name).unwrap());
    assert_eq!(messages(&reader.diagnostics), Vec::<String>::new());
    Formula::of(reader.graph, &value.unwrap(), false)
}

/// The circuit of one form, by the symbols of these names, by all where there are none.
pub fn circuit(formula: &Formula, form: Form, by: &[&str]) -> Circuit {
    let mut by: Vec<SymbolId> = by
        .iter()
        .map(|name| formula.graph.find_symbol(name).unwrap())
        .collect();
    if by.is_empty() {
        by = formula
            .graph
            .symbols_of(&formula.roots)
            .into_iter()
            .collect();
    }
    let (graph, outputs) = derive(formula, form, &by);
    factor::minimise(&graph, &outputs, &derive_written(formula, form, &by)).circuit
}
