//! The whole way of a module: parse, check, differentiate, rewrite, factor, emit.

mod fallback;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::ItemMod;

use crate::cost::Cost;
use crate::diagnostics::Diagnostics;
use crate::differentiate;
use crate::emit::columns;
use crate::emit::namer::{pack_table_function, table_function};
use crate::emit::scalar::{self, Form};
use crate::emit::staged;
use crate::factor::circuit::Circuit;
use crate::factor::{self, Outputs};
use crate::graph::{ExprId, Graph, Node, SymbolId};
use crate::latex::Symbols;
use crate::parse::attributes::{Request, StageRequest, Target};
use crate::parse::body::{Reader, identifier};
use crate::parse::module::{Function, Module, ParameterKind};
use crate::parse::value::Value;
use crate::rewrite;
use crate::stage::{self, Staged};
use crate::tables::Tables;
use fallback::{column_stubs, integral_function, one_deeper, staged_stub, stub, stub_function};

/// Expands a module of formulas: the module as written, with a module of generated forms beside each function that asks
/// for some. What is wrong comes out as `compile_error!`s at their tokens, all at once, beside everything that is right
/// and the signatures of what could not be generated.
///
/// `attribute` is what stands in the parentheses of `#[symbolic(…)]`: see [`Symbols`].
pub fn expand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    match syn::parse2::<ItemMod>(item) {
        Ok(item) => {
            let mut expansion = Expansion::unread(attribute, item);
            expansion.read_all();
            expansion.generate_all();
            expansion.into_tokens()
        }
        Err(error) => error.to_compile_error(),
    }
}

/// A function's result over its own symbols.
#[derive(Debug)]
pub struct Formula {
    /// Rewritten graph of the result.
    pub graph: Graph,
    /// Shape of the result.
    pub value: Value,
    /// Its numbers.
    pub roots: Vec<ExprId>,
}

impl Formula {
    /// Whether an integral without a table is in it, so that there is no code for it.
    pub fn has_integral(&self) -> bool {
        holds_integral(&self.graph, &self.roots)
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
    symbols: Symbols,
    tables: Tables,
    /// What was wrong.
    pub diagnostics: Diagnostics,
    /// The functions that were read; None for those that could not be.
    formulas: BTreeMap<String, Option<Formula>>,
    /// `f::d_x` as called by formulas.
    partials: BTreeSet<(String, String)>,
    /// Per function the items of its module of generated forms.
    forms: BTreeMap<String, Vec<TokenStream>>,
    uses_columns: bool,
    uses_integral: bool,
    used_tables: BTreeMap<String, TokenStream>,
}

impl Expansion {
    /// Reads a module and checks all its functions.
    pub fn of(item: ItemMod) -> Self {
        let mut expansion = Self::unread(TokenStream::new(), item);
        expansion.read_all();
        expansion
    }

    /// Reads a module's attribute and signatures, but no function's body yet.
    pub fn unread(attribute: TokenStream, item: ItemMod) -> Self {
        let mut diagnostics = Diagnostics::default();
        let symbols = Symbols::read(attribute, &mut diagnostics);
        let module = Module::read(item, &mut diagnostics);
        Self {
            module,
            symbols,
            tables: Tables::default(),
            diagnostics,
            formulas: BTreeMap::new(),
            partials: BTreeSet::new(),
            forms: BTreeMap::new(),
            uses_columns: false,
            uses_integral: false,
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
        self.module.functions.iter().map(Function::name).collect()
    }

    /// The module as read.
    pub fn module(&self) -> &Module {
        &self.module
    }

    /// How the module's names are written in LaTeX.
    pub fn latex_symbols(&self) -> &Symbols {
        &self.symbols
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
            let formula = self.formula_of(&function.clone());
            self.formulas.insert(name.to_owned(), formula);
        }
    }

    fn formula_of(&mut self, function: &Function) -> Option<Formula> {
        let mut reader = Reader::new(&self.module, &mut self.tables);
        let value = reader.read(function);
        // Bodies of tabulated functions are read by the table; what they call is known only there.
        let (graph, diagnostics) = (reader.graph, reader.diagnostics);
        self.partials.extend(reader.partials);
        self.uses_integral |= reader.integrals > 0 || function.approximation.is_some();
        self.diagnostics.append(diagnostics);
        self.diagnostics
            .append(std::mem::take(&mut self.tables.diagnostics));
        let value = value?;
        let numbers: Vec<ExprId> = value.numbers().into_iter().map(|(_, id)| id).collect();
        if holds_integral(&graph, &numbers) && function.request.is_some() {
            self.diagnostics.error_with_hint(
                function.item.sig.ident.span(),
                format!(
                    "`{}` holds an integral, which no code is generated for",
                    function.name()
                ),
                "give the integral a function of its own with #[approximate(…)]",
            );
            return None;
        }
        let (graph, roots) = rewrite::rewrite(&graph, &numbers);
        let value = value.with_numbers(&mut roots.iter().copied());
        Some(Formula {
            graph,
            value,
            roots,
        })
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
            let partials: Vec<String> = self
                .partials
                .iter()
                .filter(|(of, _)| *of == name)
                .map(|(_, partial)| partial.clone())
                .collect();
            for partial in partials {
                items.push(self.partial(function, &partial));
            }
            if !items.is_empty() {
                self.forms.insert(name, items);
            }
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
        for stage in &request.stages {
            items.push(self.staged_item(function, stage));
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
        let circuit = factor::minimise(&graph, &outputs);
        self.use_tables(&graph, &circuit);
        let documentation = documentation(function, &graph, form, &by, circuit.cost());
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

    /// The symbols to derive by; all that the function uses where the list is empty.
    fn symbols(&mut self, function: &Function, by: &[Target]) -> Option<Vec<SymbolId>> {
        let formula = self.formulas.get_mut(&function.name())?.as_mut()?;
        if by.is_empty() {
            return Some(
                formula
                    .graph
                    .symbols_of(&formula.roots)
                    .into_iter()
                    .collect(),
            );
        }
        let mut symbols = Vec::new();
        for target in by {
            let root = target.symbol.split(['.', '[']).next().unwrap_or_default();
            let parameter = function
                .parameters
                .iter()
                .find(|parameter| parameter.name == root);
            let fits = parameter.is_some_and(|parameter| match parameter.kind {
                ParameterKind::Number => target.symbol == root,
                ParameterKind::Array(length) => {
                    (0..length).any(|position| target.symbol == format!("{root}[{position}]"))
                }
                ParameterKind::Struct => target.symbol != root,
            });
            if fits {
                symbols.push(formula.graph.symbol_named(&target.symbol));
                continue;
            }
            let used = formula.graph.symbols_of(&formula.roots);
            let known: Vec<&str> = used
                .iter()
                .map(|symbol| formula.graph.symbol(*symbol).name.as_str())
                .collect();
            self.diagnostics.error_with_hint(
                target.span,
                format!(
                    "`{}` is no number that `{}` takes",
                    target.symbol,
                    function.name()
                ),
                format!("it uses {}", known.join(", ")),
            );
        }
        (symbols.len() == by.len()).then_some(symbols)
    }

    fn column_items(&mut self, function: &Function, generated: &[Generated]) -> Vec<TokenStream> {
        let Some(formula) = self.formula(&function.name()) else {
            return Vec::new();
        };
        // Also those that cancel: a column of each input, whatever becomes of it.
        let own = formula
            .graph
            .symbols()
            .filter(|(_, symbol)| !symbol.name.contains('#'));
        let symbols: Vec<SymbolId> = own.map(|(id, _)| id).collect();
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

    /// The module of a staged form.
    pub fn staged_item(&mut self, function: &Function, request: &StageRequest) -> TokenStream {
        match self.staged(function, request) {
            Some((staged, inner, outputs)) => {
                self.use_tables(&staged.graph, &staged.fixed);
                for circuit in [&staged.along, &staged.points] {
                    self.use_tables_in_packs(&staged.graph, circuit);
                }
                staged::module(&staged, function, &inner, &outputs)
            }
            None => staged_stub(function, request),
        }
    }

    /// A function in stages, its inner symbols, and the names of its results. None where it could not be read or a name is
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
        let circuit = stage::minimise(&graph, &outputs, &set);
        Some((stage::split(&graph, &circuit, &set), inner, names))
    }

    /// The function `d_x` or `d_x_y`.
    fn partial(&mut self, function: &Function, partial: &str) -> TokenStream {
        let name = format_ident!("{partial}");
        let parameters = scalar::parameters(function);
        let written = format!(
            " Partial `{partial}` of [`{0}`](super::{0}()).",
            function.name()
        );
        let Some(formula) = self.formula(&function.name()) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let mut graph = formula.graph.clone();
        // Those with a `#` belong to a partial within the formula.
        let own = graph
            .symbols()
            .filter(|(_, symbol)| !symbol.name.contains('#'));
        let names: Vec<(String, SymbolId)> = own
            .map(|(id, symbol)| (identifier(&symbol.name), id))
            .collect();
        let by = partial
            .strip_prefix("d_")
            .and_then(|suffix| crate::parse::body::partial_symbols(suffix, &names));
        let (Some(by), [root]) = (by, formula.roots.as_slice()) else {
            return stub_function(function, &quote!(#name), &quote!(f64));
        };
        let derivative = by.iter().fold(*root, |derivative, symbol| {
            differentiate::gradient(&mut graph, derivative, &[*symbol])
                .first()
                .copied()
                .unwrap_or(derivative)
        });
        let (graph, roots) = rewrite::rewrite(&graph, &[derivative]);
        let circuit = factor::minimise(
            &graph,
            &Outputs {
                values: roots,
                ..Outputs::default()
            },
        );
        self.use_tables(&graph, &circuit);
        let symbol = |symbol: SymbolId| scalar::symbol_tokens(&graph, symbol);
        let taken = function
            .parameters
            .iter()
            .map(|parameter| parameter.name.to_string());
        let body = crate::emit::expression::Writer::new(&graph, &circuit, &symbol, taken).body();
        let (statements, outputs) = (body.statements, body.outputs);
        let counts = format!(" Operations: {}.", circuit.cost());
        quote! {
            #[doc = #written]
            #[doc = ""]
            #[doc = #counts]
            #[inline]
            pub fn #name(#parameters) -> f64 {
                #(#statements)*
                #(#outputs)*
            }
        }
    }

    /// The tables of a circuit that runs in packs.
    fn use_tables_in_packs(&mut self, graph: &Graph, circuit: &Circuit) {
        self.use_tables(graph, circuit);
        for net in circuit.nets() {
            if let factor::circuit::Operation::Tabulated { table, order, .. } =
                circuit.operation(net)
                && let Some(known) = graph.tables.get(*table)
            {
                let name = table_function(graph, *table, *order);
                let pack_name = pack_table_function(&name);
                let idents = [&name, &pack_name].map(|name| format_ident!("{name}"));
                let [name, of_pack] = &idents;
                self.used_tables
                    .entry(pack_name)
                    .or_insert_with(|| known.derivative(*order).emit_for_packs(name, of_pack));
            }
        }
    }

    fn use_tables(&mut self, graph: &Graph, circuit: &Circuit) {
        for net in circuit.nets() {
            if let factor::circuit::Operation::Tabulated { table, order, .. } =
                circuit.operation(net)
                && let Some(known) = graph.tables.get(*table)
            {
                let name = table_function(graph, *table, *order);
                let summary = match order {
                    0 => format!("`{}` without its factor.", known.name),
                    order => format!(
                        "Derivative of order {order} of `{}` without its factor.",
                        known.name
                    ),
                };
                let ident = format_ident!("{name}");
                self.used_tables
                    .entry(name)
                    .or_insert_with(|| known.derivative(*order).emit(&ident, &summary));
            }
        }
    }

    /// The module with everything generated.
    pub fn into_tokens(self) -> TokenStream {
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
            let item = &function.item;
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
        for function in &self.module.functions {
            if let Some(items) = self.forms.get(&function.name()) {
                added.push(forms_module(function, items));
            }
        }
        match &mut item.content {
            Some((_, items)) => items.extend(added.into_iter().map(syn::Item::Verbatim)),
            None => return quote!(#item #errors),
        }
        quote!(#item #errors)
    }
}

/// The module of a function's generated forms.
pub fn forms_module(function: &Function, items: &[TokenStream]) -> TokenStream {
    let (visibility, name) = (&function.item.vis, &function.item.sig.ident);
    let doc = format!(" Generated forms of [`{name}`]({name}()).");
    let items = one_deeper(quote!(#(#items)*));
    quote! {
        #[doc = #doc]
        #[allow(clippy::all, clippy::pedantic, unused)]
        #visibility mod #name {
            use super::*;

            #items
        }
    }
}

/// The formula's numbers with the partials that a form asks for, rewritten.
pub fn derive(formula: &Formula, form: Form, by: &[SymbolId]) -> (Graph, Outputs) {
    let mut graph = formula.graph.clone();
    let mut outputs = Outputs {
        values: formula.roots.clone(),
        by: by.to_vec(),
        ..Outputs::default()
    };
    if form >= Form::Gradient {
        for root in &formula.roots {
            outputs
                .gradients
                .push(differentiate::gradient(&mut graph, *root, by));
        }
    }
    if form == Form::Hessian {
        for gradient in &outputs.gradients {
            let rows = differentiate::hessian(&mut graph, gradient, by);
            let triangle = rows
                .iter()
                .enumerate()
                .flat_map(|(row, entries)| entries.iter().skip(row))
                .copied();
            outputs.hessians.push(triangle.collect());
        }
    }
    if form > Form::Value {
        for gradient in &outputs.gradients {
            for (partial, symbol) in gradient.iter().zip(by) {
                let name = format!("d_{}", identifier(&graph.symbol(*symbol).name));
                graph.suggest_name(*partial, &name);
            }
        }
    }
    for triangle in &outputs.hessians {
        let pairs = (0..by.len()).flat_map(|row| (row..by.len()).map(move |column| (row, column)));
        for (second, (row, column)) in triangle.iter().zip(pairs) {
            let [row, column] =
                [row, column].map(|place| identifier(&graph.symbol(by[place]).name));
            graph.suggest_name(*second, &format!("d_{row}_{column}"));
        }
    }
    let (graph, all) = rewrite::rewrite(&graph, &outputs.all());
    let outputs = outputs.with_all(&all);
    (graph, outputs)
}

/// What each result of a column form is called.
fn output_names(value: &Value, graph: &Graph, by: &[SymbolId]) -> Vec<String> {
    let label = |path: &str| match identifier(path.trim_start_matches('.')) {
        name if name.is_empty() => "value".to_owned(),
        name if name.starts_with(|c: char| c.is_ascii_digit() || c == '_') => {
            format!("value_{}", name.trim_start_matches('_'))
        }
        name => name,
    };
    let values: Vec<String> = value
        .numbers()
        .iter()
        .map(|(path, _)| label(path))
        .collect();
    let partials = values.iter().flat_map(|value| {
        by.iter()
            .map(move |symbol| format!("d_{value}_d_{}", identifier(&graph.symbol(*symbol).name)))
    });
    values.iter().cloned().chain(partials).collect()
}

fn documentation(
    function: &Function,
    graph: &Graph,
    form: Form,
    by: &[SymbolId],
    cost: Cost,
) -> Vec<String> {
    let name = function.name();
    let symbols: Vec<String> = by
        .iter()
        .map(|symbol| format!("`{}`", graph.symbol(*symbol).name))
        .collect();
    let what = match form {
        Form::Value => format!(" Value of [`{name}`](super::{name}())."),
        Form::Gradient => format!(
            " Value of [`{name}`](super::{name}()) and its partials by {}.",
            symbols.join(", ")
        ),
        Form::Hessian => {
            format!(
                " Value of [`{name}`](super::{name}()), its first and second partials by {}.",
                symbols.join(", ")
            )
        }
    };
    vec![what, String::new(), format!(" Operations: {cost}.")]
}
