//! The whole way of a module: parse, check, differentiate, rewrite, factor, emit.

mod chain;
mod collisions;
mod depth;
mod derivatives;
mod fallback;
mod partial;
mod stages;
mod tabulated;
mod text;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::{Item, ItemMod};

use crate::chain::Member;
use crate::cost::Cost;
use crate::diagnostics::Diagnostics;
use crate::emit::columns;
use crate::emit::scalar::{self, Form};
use crate::factor::circuit::Circuit;
use crate::factor::identities::merge_held;
use crate::factor::rounding::Written;
use crate::factor::{self, Held};
use crate::gather::{gather, hold};
use crate::graph::{ExprId, Graph, Node, Role, SymbolId};
use crate::latex::Symbols;
use crate::parse::attributes::{Request, Target, root};
use crate::parse::body::Reader;
use crate::parse::linking::{Source, Sources};
use crate::parse::module::{Function, Module};
use crate::parse::numbers;
use crate::parse::place::Place;
use crate::parse::value::Value;
use crate::rewrite;
use crate::tables::Tables;
use depth::{DEEPEST_GROUP, deeper_than};
pub use derivatives::{derive, derive_held, derive_written};
use fallback::{column_stubs, integral_function, one_deeper, stub};
use text::{as_written, documentation, output_names};

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

/// A function's result over its own symbols.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The result as its author wrote it, operation by operation.
    pub written: Written,
    /// Rewritten graph of the result.
    pub graph: Graph,
    /// Shape of the result.
    pub value: Value,
    /// Its numbers.
    pub roots: Vec<ExprId>,
    /// The same with named products held, where a gradient is asked for.
    pub held: Option<Held>,
}

impl Formula {
    /// Whether an integral without a table is in it, so that there is no code for it.
    pub fn has_integral(&self) -> bool {
        holds_integral(&self.graph, &self.roots)
    }

    /// A result that was read into a graph as written.
    pub fn of(graph: Graph, value: &Value, hold: bool) -> Self {
        let numbers: Vec<ExprId> = value.numbers().into_iter().map(|(_, id)| id).collect();
        let gathered = gather(&graph, &numbers);
        let held = hold.then(|| self::hold(&graph, &numbers)).flatten();
        let (rewritten, roots) = rewrite::rewrite(&gathered.graph, &gathered.roots);
        Self {
            value: value.with_numbers(&mut roots.iter().copied()),
            graph: rewritten,
            roots,
            // What cancels between products that are held is seen only in their values, and is not to be derived.
            held: held.map(|held| merge_held(&held).rewritten()),
            written: Written {
                graph,
                reverse: numbers.clone(),
                roots: numbers,
                undoes_rounding: gathered.undoes_rounding,
            },
        }
    }

    /// Its inputs, also those that cancel, in the order in which it names them.
    pub fn inputs(&self) -> Vec<SymbolId> {
        let all = self.graph.symbols();
        let own = all.filter(|(_, symbol)| symbol.role == Role::Input);
        own.map(|(id, _)| id).collect()
    }

    /// Their names.
    pub fn input_names(&self) -> Vec<String> {
        columns::names_of(&self.graph, &self.inputs())
    }

    /// The input of that name, made where the formula does not depend on it.
    pub fn input(&mut self, name: &str) -> SymbolId {
        // The same in both graphs: each is made with the symbols of the one as written.
        self.written.graph.symbol_named(name);
        self.graph.symbol_named(name)
    }
}

fn holds_integral(graph: &Graph, roots: &[ExprId]) -> bool {
    graph
        .reachable(roots)
        .into_iter()
        .any(|id| matches!(graph.node(id), Node::Integral { .. }))
}

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

/// A module on its way.
#[derive(Debug)]
pub struct Expansion {
    module: Module,
    tables: Tables,
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
    /// Whether it was reported that calls go too deep.
    too_deep: bool,
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
            diagnostics,
            formulas: BTreeMap::new(),
            named: BTreeMap::new(),
            partials: BTreeSet::new(),
            forms: BTreeMap::new(),
            members: Vec::new(),
            uses_columns: false,
            uses_integral: false,
            chain: None,
            too_deep: false,
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
        // Of all functions that call too deep one is reported.
        if reader.too_deep && std::mem::replace(&mut self.too_deep, true) {
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
        }
        self.named
            .insert(function.name(), in_order(function, &graph, named));
        let request = function.request.as_ref();
        let has_gradient = request.is_some_and(|request| request.gradient.is_some());
        Some(Formula::of(graph, &value, has_gradient))
    }

    /// Reports a result that no code can be generated for.
    fn check_generable(
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

    /// Nothing stands in for generated code without an error, be it in a linked module.
    fn report_unread(&mut self) {
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

    fn requested(&mut self, function: &Function, request: &Request, items: &mut Vec<TokenStream>) {
        let mut forms = vec![(request.value || request.columns, Form::Value, &[][..])];
        if let Some(by) = &request.gradient {
            forms.push((true, Form::Gradient, by.as_slice()));
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
            if request.columns && form <= Form::Gradient {
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
            items.push(column_stubs(
                &self.module,
                function,
                request.gradient.is_some(),
            ));
        }
        let mut staged = Vec::new();
        for stage in &request.stages {
            let (item, weights) = self.staged_item(function, stage);
            items.push(item);
            staged.push(weights);
        }
        let of_values = column_forms.iter().find(|form| form.form == Form::Value);
        let rows = of_values.map(|form| form.circuit.cost().weight());
        if request.chain.is_some() {
            items.push(crate::emit::chain::weights(rows, &staged));
            self.join_chain(function, request);
        }
        if let Some((form, cost)) = richest {
            self.check_budget(function, request, form, cost);
        }
    }

    fn check_budget(&mut self, function: &Function, request: &Request, form: Form, cost: Cost) {
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

    /// Generates one form of a function. None where the function could not be read or a name is unknown, which is
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
        let held = (form == Form::Gradient)
            .then(|| derive_held(formula, &by))
            .flatten();
        let written = derive_written(formula, form, &by);
        let found = factor::minimise_with(&graph, &outputs, &written, held.as_ref());
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

    /// The symbols to derive by; all that the function's source names where the list is empty. None where one is no number
    /// of the function, which is reported with the module.
    fn symbols(&mut self, function: &Function, by: &[Target]) -> Option<Vec<SymbolId>> {
        let name = function.name();
        if by.is_empty() {
            return self.named.get(&name).cloned();
        }
        let formula = self.formulas.get_mut(&name)?.as_mut()?;
        let by = by.iter().map(|target| {
            let misfit = numbers::misfit(&self.module, function, &target.symbol);
            let fits = misfit.is_none() && function.parameter(target.root()).is_some();
            fits.then(|| formula.input(&target.symbol))
        });
        by.collect()
    }

    fn column_items(&mut self, function: &Function, generated: &[Generated]) -> Vec<TokenStream> {
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
            let (body, name) = if form.form == Form::Value {
                ("Rows", "columns")
            } else {
                ("GradientRows", "gradient_columns")
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

    /// The module with everything generated.
    pub fn into_tokens(self) -> TokenStream {
        let (item, errors) = self.into_parts();
        quote!(#item #errors)
    }

    /// The module with everything generated, and what was wrong.
    pub fn into_parts(self) -> (ItemMod, TokenStream) {
        let mut item = self.module.item;
        for function in item.content.iter_mut().flat_map(|(_, items)| items) {
            // It may be called through its partials alone.
            if let syn::Item::Fn(function) = function
                && self.partials.iter().any(|(of, _)| function.sig.ident == of)
            {
                function.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
            }
        }
        let errors = self.diagnostics.to_tokens();
        let mut added = Vec::new();
        for function in self
            .module
            .functions
            .iter()
            .filter(|function| function.specialises.is_some())
        {
            let mut item = function.item.clone();
            if self
                .formulas
                .get(&function.name())
                .is_some_and(Option::is_none)
            {
                // Its replacements are reported; what they say is not compiled as well.
                item.block = syn::parse_quote!({ loop {} });
            }
            added.push(quote!(#item));
        }
        if self.uses_columns {
            added.push(columns::error_type());
        }
        if self.uses_integral
            && !self
                .module
                .functions
                .iter()
                .any(|function| function.name() == "integral")
        {
            added.push(integral_function());
        }
        added.extend(self.used_tables.into_values());
        added.extend(self.chain);
        for function in &self.module.functions {
            if let Some(items) = self.forms.get(&function.name()) {
                added.push(forms_module(function, items));
            }
        }
        if let Some((_, items)) = &mut item.content {
            items.extend(added.into_iter().map(syn::Item::Verbatim));
        }
        (item, errors)
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

/// The module of a function's generated forms.
pub fn forms_module(function: &Function, items: &[TokenStream]) -> TokenStream {
    let (visibility, name) = (&function.item.vis, &function.item.sig.ident);
    let doc = format!(" Generated forms of [`{name}`]({name}()).");
    let conditions = function.conditions();
    let items = one_deeper(quote!(#(#items)*));
    quote! {
        #(#conditions)*
        #[doc = #doc]
        #[allow(clippy::all, clippy::pedantic, unused)]
        #visibility mod #name {
            use super::*;

            #items
        }
    }
}
