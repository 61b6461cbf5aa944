//! The whole way of a module: parse, check, differentiate, rewrite, factor, emit.

mod assemble;
mod chain;
mod checks;
mod collisions;
mod columns;
mod depth;
mod derivatives;
mod fallback;
mod forms;
mod formula;
mod jacobian;
mod partial;
mod stages;
mod tabulated;
mod text;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::{Item, ItemMod};

use crate::chain::Member;
use crate::diagnostics::Diagnostics;
use crate::factor::passes::Passes;
use crate::graph::{ExprId, Graph, Role, SymbolId};
use crate::parse::attributes::root;
use crate::parse::body::Reader;
use crate::parse::linking::{Source, Sources};
use crate::parse::module::{Function, Module};
use crate::parse::place::Place;
use crate::symbols::Symbols;
use crate::tables::Tables;
use depth::{DEEPEST_GROUP, deeper_than};
pub use derivatives::{derive, derive_held, derive_written};
pub use forms::Generated;
pub use formula::Formula;

/// Expands a module of formulas: the module as written, with a module of generated forms beside each function that asks
/// for some. What is wrong comes out as `compile_error!`s at their tokens, all at once, beside everything that is right
/// and the signatures of what could not be generated.
///
/// `attribute` is what stands in the parentheses of `#[symbolic(…)]`: see [`Symbols`]. The module is by itself: it links no
/// other one, as it can by [`mod@crate::link`].
pub fn expand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    const MODULE: &str =
        "the attribute stands at a module of functions: #[symbolic] mod name { … }";
    let mut diagnostics = Diagnostics::default();
    if let Some(span) = nested_too_deep(&item) {
        let message = format!("groups of tokens are nested deeper than {DEEPEST_GROUP}");
        let hint = "bind what is inside to names with `let`";
        diagnostics.error_with_hint(span, message, hint);
        return diagnostics.to_tokens();
    }
    match syn::parse2::<Item>(item.clone()) {
        Ok(Item::Mod(item)) => {
            let mut expansion = Expansion::unread(attribute, item);
            expansion.read_all();
            expansion.generate_all();
            expansion.into_tokens()
        }
        // Another item stays, so that what uses it is not reported too.
        Ok(other) => {
            let start = other.to_token_stream().into_iter().next();
            let span = start.map_or_else(Span::call_site, |token| token.span());
            diagnostics.error_with_hint(span, "formulas are functions of a module", MODULE);
            let errors = diagnostics.to_tokens();
            quote!(#other #errors)
        }
        Err(error) => {
            diagnostics.syntax(&error, MODULE);
            diagnostics.to_tokens()
        }
    }
}

/// Where groups of tokens are nested deeper than can be read.
pub(crate) fn nested_too_deep(tokens: &TokenStream) -> Option<Span> {
    deeper_than(DEEPEST_GROUP, tokens)
}

/// A module on its way.
#[derive(Debug)]
pub struct Expansion {
    module: Module,
    tables: Tables,
    /// The passes by which circuits are made.
    passes: Passes,
    /// What was wrong.
    pub diagnostics: Diagnostics,
    /// The functions that were read; None for those that could not be.
    formulas: BTreeMap<String, Option<Formula>>,
    /// The numbers that each function's source names, in the order of its parameters.
    named: BTreeMap<String, Vec<SymbolId>>,
    /// `f::d_x` as called by formulas.
    partials: BTreeSet<(String, String)>,
    /// Per function the items of its module of generated forms.
    forms: BTreeMap<String, Vec<TokenStream>>,
    /// The formulas that take part in the chain.
    members: Vec<Member>,
    uses_columns: bool,
    uses_integral: bool,
    /// The module of the chain, where there is one.
    chain: Option<TokenStream>,
    /// Whether it was reported that calls go too deep or statements are too many.
    is_beyond: bool,
    /// Whether a formula could not be read for a mistake in a linked module, which reports it.
    linked_mistake: bool,
    used_tables: BTreeMap<String, TokenStream>,
}

impl Expansion {
    /// Reads a module and checks all its functions.
    pub fn of(item: ItemMod) -> Self {
        let mut expansion = Self::unread(TokenStream::new(), item);
        expansion.read_all();
        expansion
    }

    /// Reads a module's attribute and signatures, but no function's body yet. It links no other module: those that its
    /// attribute names are unknown.
    pub fn unread(attribute: TokenStream, item: ItemMod) -> Self {
        let source = Source {
            key: String::new(),
            attribute,
            item: item.clone(),
            places: vec![Place::AROUND],
        };
        let mut diagnostics = Diagnostics::default();
        let module = Sources::new(vec![source]).module(0, &mut diagnostics);
        let module = module.unwrap_or_else(|| Module::read(item, &mut diagnostics));
        Self::of_module(module, diagnostics)
    }

    /// A module that was read, with what was wrong in it; no function's body was read yet.
    pub fn of_module(module: Module, diagnostics: Diagnostics) -> Self {
        Self {
            module,
            tables: Tables::default(),
            passes: Passes::ALL,
            diagnostics,
            formulas: BTreeMap::new(),
            named: BTreeMap::new(),
            partials: BTreeSet::new(),
            forms: BTreeMap::new(),
            members: Vec::new(),
            uses_columns: false,
            uses_integral: false,
            chain: None,
            is_beyond: false,
            linked_mistake: false,
            used_tables: BTreeMap::new(),
        }
    }

    /// Has tables that are read from here on only sketched: good enough to look at code that calls them, in a hundredth of
    /// the time; see [`Tables::sketched`].
    pub fn with_sketched_tables(mut self) -> Self {
        self.tables = Tables::sketched();
        self
    }

    /// Has circuits made by these passes alone from here on, to measure what the others give.
    pub fn with_passes(mut self, passes: Passes) -> Self {
        self.passes = passes;
        self
    }

    /// Names of the module's functions in order.
    pub fn function_names(&self) -> Vec<String> {
        self.module
            .functions
            .iter()
            .map(|function| function.name())
            .collect()
    }

    /// The module as read.
    pub fn module(&self) -> &Module {
        &self.module
    }

    /// How the module's names are written in LaTeX.
    pub fn latex_symbols(&self) -> &Symbols {
        &self.module.symbols
    }

    /// The formula of that name, if it was read and could be.
    pub fn formula(&self, name: &str) -> Option<&Formula> {
        self.formulas.get(name)?.as_ref()
    }

    /// Reads every function that was not read yet.
    pub fn read_all(&mut self) {
        for name in self.function_names() {
            self.read_only(&name);
        }
    }

    /// Reads one function, with the bodies and tables of those that it calls, unless it was read before. A name that no
    /// function has is left alone.
    pub fn read_only(&mut self, name: &str) {
        if self.formulas.contains_key(name) {
            return;
        }
        if let Some(function) = self.module.function(name) {
            let formula = self.formula_of(&Rc::clone(function));
            self.formulas.insert(name.to_owned(), formula);
        }
    }

    fn formula_of(&mut self, function: &Function) -> Option<Formula> {
        let mut reader = Reader::new(&self.module, &mut self.tables);
        let value = reader.read(function);
        // Bodies of tabulated functions are read by the table; what they call is known only there.
        let (graph, mut diagnostics, named) = (reader.graph, reader.diagnostics, reader.named);
        // Of all functions that are followed too far one is reported.
        if reader.is_beyond && std::mem::replace(&mut self.is_beyond, true) {
            diagnostics = Diagnostics::default();
        }
        self.linked_mistake |= reader.linked_mistake;
        self.partials.extend(reader.partials);
        self.uses_integral |= reader.integrals > 0 || function.approximation.is_some();
        self.diagnostics.append(diagnostics);
        self.diagnostics
            .append(std::mem::take(&mut self.tables.diagnostics));
        let value = value?;
        let numbers: Vec<ExprId> = value.numbers().into_iter().map(|(_, id)| id).collect();
        if function.request.is_some() {
            self.check_generable(function, &graph, &value, &numbers)?;
            self.check_jacobian(function, &value)?;
        }
        self.named
            .insert(function.name(), in_order(function, &graph, named));
        let request = function.request.as_ref();
        let has_gradient =
            request.is_some_and(|request| request.gradient.is_some() || request.jacobian.is_some());
        Some(Formula::of(graph, &value, has_gradient))
    }

    /// Generates every form that is asked for, and the partials that formulas call.
    pub fn generate_all(&mut self) {
        let functions = self.module.functions.clone();
        for function in &functions {
            let name = function.name();
            let mut items = Vec::new();
            if let Some(request) = &function.request {
                self.requested(function, request, &mut items);
            }
            let called = self.partials.iter().filter(|(of, _)| *of == name);
            let mut partials: BTreeSet<String> =
                called.map(|(_, partial)| partial.clone()).collect();
            for asked in function
                .request
                .iter()
                .flat_map(|request| &request.partials)
            {
                self.check_partial(function, asked);
                partials.insert(asked.symbol.clone());
            }
            for partial in partials {
                items.push(self.partial(function, &partial));
            }
            if !items.is_empty() {
                self.forms.insert(name, items);
            }
        }
        self.lend_tables();
        self.report_collisions();
        self.report_unread();
        self.chain = self.chain_items();
    }
}

/// The symbols, by the order of the function's parameters.
fn in_order(function: &Function, graph: &Graph, named: BTreeSet<SymbolId>) -> Vec<SymbolId> {
    let own = named
        .into_iter()
        .filter(|symbol| graph.symbol(*symbol).role == Role::Input);
    let mut own: Vec<SymbolId> = own.collect();
    let names: Vec<String> = function
        .parameters
        .iter()
        .map(|known| known.name.to_string())
        .collect();
    // Those of one parameter stay as they are.
    own.sort_by_key(|symbol| {
        let name = &graph.symbol(*symbol).name;
        names.iter().position(|known| known == root(name))
    });
    own
}
