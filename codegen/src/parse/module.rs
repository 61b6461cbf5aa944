//! The items of a module of formulas.

use std::rc::Rc;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;
use syn::visit::Visit;
use syn::{FnArg, Ident, Item, ItemFn, ItemMod, Pat, Type, Visibility};

use super::attributes::{Approximation, FunctionAttributes, OWN, Request, Specialisation};
use super::imports::Imports;
use super::names::{Kind, Linked};
use super::place::Place;
use super::shape::Shape;
use super::{cycles, impls, numbers, signature, specialise};
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sizes};
use crate::symbols::Symbols;

/// A module of formulas.
#[derive(Clone, Debug)]
pub struct Module {
    /// The item as written, without the generator's own attributes.
    pub item: ItemMod,
    /// Its functions in order.
    pub functions: Vec<Rc<Function>>,
    /// The place of each by its name, of two that have one name that of the first.
    places: BTreeMap<String, usize>,
    /// Its constants: name and value.
    pub constants: Vec<(String, syn::Expr)>,
    /// What it imports of the standard library's constants, and of the modules that it links.
    pub imports: Imports,
    /// Constants whose value is needed for itself; that is reported, they have none.
    pub cyclic_constants: BTreeSet<String>,
    /// Its structs: name and fields, each with its type.
    pub structs: Vec<(String, Vec<(String, Type)>)>,
    /// How large the numbers are that its functions are given.
    pub sizes: Sizes,
    /// Where numbers of some names lie wherever a function takes them.
    pub domain: Vec<(String, Domain)>,
    /// How names are written in LaTeX.
    pub symbols: Symbols,
    /// What tells it from the others where modules link each other.
    pub key: String,
    /// The modules that it links, those that they link among them.
    pub linked: Vec<Linked>,
    /// Whether it has the chain of its formulas and of those that it links.
    pub has_chain: bool,
    /// Where modules are that it links and that are not known, which is reported.
    pub(super) refused: Vec<Place>,
    /// Its items that no other module sees.
    pub(super) private: BTreeSet<(Kind, String)>,
}

/// A function of the module.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its item, without the generator's own attributes.
    pub item: ItemFn,
    /// The type that it is a method or a function of.
    pub of: Option<Ident>,
    /// Its parameters in order.
    pub parameters: Vec<Parameter>,
    /// What is asked of it.
    pub request: Option<Request>,
    /// Declared domains: symbol, domain, place.
    pub domain: Vec<(String, Domain, Span)>,
    /// Whether and how it is tabulated.
    pub approximation: Option<Approximation>,
    /// Whether its signature and its approximation can be taken and it does not call itself. Where not, that is reported,
    /// its body is read for its mistakes alone, and its callers are not followed into it.
    pub readable: bool,
    /// For a specialisation: the function it stands at and its replacements are in the body.
    pub specialises: Option<String>,
}

/// A parameter of a function.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: Ident,
    /// What it holds.
    pub shape: Shape,
    /// Its type as written.
    pub ty: Type,
}

impl Function {
    /// The function's name, that of a method with its type before it: `Name::method`.
    pub fn name(&self) -> String {
        let name = &self.item.sig.ident;
        match &self.of {
            Some(of) => format!("{of}::{name}"),
            None => name.to_string(),
        }
    }

    /// Whether it is generated over columns too.
    pub fn asks_for_columns(&self) -> bool {
        self.request.as_ref().is_some_and(|request| request.columns)
    }

    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
    }

    /// The conditions `#[cfg(…)]` under which the function is compiled: what is generated from it stands under them too.
    pub fn conditions(&self) -> impl Iterator<Item = &syn::Attribute> {
        let attributes = self.item.attrs.iter();
        attributes.filter(|attribute| attribute.path().is_ident("cfg"))
    }

    /// Every name that the signature binds, those of parameters that can't be taken among them.
    pub fn bound_names(&self) -> Vec<String> {
        let patterns = self.item.sig.inputs.iter().filter_map(|input| match input {
            FnArg::Typed(typed) => Some(typed.pat.as_ref()),
            FnArg::Receiver(_) => None,
        });
        patterns.flat_map(bound_names).collect()
    }
}

/// The names that a pattern binds.
pub(super) fn bound_names(pattern: &Pat) -> Vec<String> {
    struct Names(Vec<String>);
    impl<'ast> Visit<'ast> for Names {
        fn visit_pat_ident(&mut self, name: &'ast syn::PatIdent) {
            self.0.push(name.ident.to_string());
        }
    }
    let mut names = Names(Vec::new());
    names.visit_pat(pattern);
    names.0
}

impl Module {
    /// Reads a module that links no other. Functions whose signature can't be taken are left as written, and reported.
    pub fn read(item: ItemMod, diagnostics: &mut Diagnostics) -> Self {
        Self::read_among(String::new(), Vec::new(), item, diagnostics)
    }

    /// Reads a module that links others.
    pub fn read_among(
        key: String,
        linked: Vec<Linked>,
        mut item: ItemMod,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut module = Self {
            item: item.clone(),
            functions: Vec::new(),
            places: BTreeMap::new(),
            constants: Vec::new(),
            imports: Imports::default(),
            cyclic_constants: BTreeSet::new(),
            structs: Vec::new(),
            sizes: Sizes::All,
            domain: Vec::new(),
            symbols: Symbols::default(),
            key,
            linked,
            has_chain: false,
            refused: Vec::new(),
            private: BTreeSet::new(),
        };
        let Some((_, items)) = &mut item.content else {
            diagnostics.error_with_hint(
                item.ident.span(),
                "the module's formulas are not here",
                "write the module inline: mod name { … }",
            );
            return module;
        };
        // Types of parameters say structs and constants by their names.
        let mut blocks = Vec::new();
        for item in items.iter_mut() {
            blocks.extend(module.read_item(item, diagnostics));
        }
        let mut specialisations = Vec::new();
        for item in items.iter_mut() {
            if let Item::Fn(function) = item {
                specialisations.extend(module.read_function(function, None, diagnostics));
            }
        }
        for impls::Block { of, functions, .. } in blocks {
            for mut function in functions {
                module.read_function(&mut function, Some(&of), diagnostics);
            }
        }
        module.check_names_of_methods(diagnostics);
        module.item = item;
        numbers::check_domains(&module, diagnostics);
        // Only now all names are known that a new function could meet.
        for (original, specialisation) in specialisations {
            module.specialise(&original, specialisation, diagnostics);
        }
        numbers::settle_targets(&mut module, diagnostics);
        cycles::check(&mut module, diagnostics);
        module
    }

    /// Adds what an item says, but for functions; the methods of an `impl` block are left for later.
    fn read_item(
        &mut self,
        item: &mut Item,
        diagnostics: &mut Diagnostics,
    ) -> Option<impls::Block> {
        match item {
            Item::Fn(function) => {
                self.note_private(Kind::Function, &function.sig.ident, &function.vis);
            }
            Item::Const(constant) => {
                self.note_private(Kind::Constant, &constant.ident, &constant.vis);
                let value = (*constant.expr).clone();
                self.constants.push((constant.ident.to_string(), value));
            }
            Item::Struct(item) => {
                self.note_private(Kind::Struct, &item.ident, &item.vis);
                let fields = item.fields.iter().enumerate();
                let fields = fields.map(|(position, field)| {
                    let name = field.ident.as_ref().map(ToString::to_string);
                    (
                        name.unwrap_or_else(|| position.to_string()),
                        field.ty.clone(),
                    )
                });
                self.structs
                    .push((item.ident.to_string(), fields.collect()));
            }
            Item::Use(import) => self.imports.read(import),
            Item::Impl(item) => {
                let block = impls::read(item, diagnostics)?;
                for (name, value) in &block.constants {
                    let name = format!("{}::{name}", block.of);
                    self.constants.push((name, value.clone()));
                }
                return Some(block);
            }
            _ => {}
        }
        None
    }

    /// Reports methods whose generated forms would be in the module of another function's, and asks for none of them.
    fn check_names_of_methods(&mut self, diagnostics: &mut Diagnostics) {
        let functions = self.functions.iter();
        let others: Vec<(String, Ident)> = functions
            .filter(|known| known.of.is_none() || known.request.is_some())
            .map(|known| (known.name(), known.item.sig.ident.clone()))
            .collect();
        for function in &mut self.functions {
            let (name, ident) = (function.name(), function.item.sig.ident.clone());
            let chain = function.request.as_ref().and_then(|it| it.chain.as_ref());
            if let (Some(_), Some(chain)) = (&function.of, chain) {
                diagnostics.error_with_hint(
                    chain.span,
                    "a method takes no part in the chain",
                    "write a function that calls it",
                );
                if let Some(request) = &mut Rc::make_mut(function).request {
                    request.chain = None;
                }
            }
            let before = others.iter().take_while(|(other, _)| *other != name);
            if function.of.is_some()
                && function.request.is_some()
                && before.into_iter().any(|(_, other)| *other == ident)
            {
                diagnostics.error_with_hint(
                    ident.span(),
                    format!("the generated forms of another function are in a module `{ident}`"),
                    "give one of the two another name: forms are in a module of their function's name",
                );
                Rc::make_mut(function).request = None;
            }
        }
    }

    fn note_private(&mut self, kind: Kind, name: &Ident, visibility: &Visibility) {
        if matches!(visibility, Visibility::Inherited) {
            self.private.insert((kind, name.to_string()));
        }
    }

    /// The function of that name.
    pub fn function(&self, name: &str) -> Option<&Rc<Function>> {
        self.functions.get(*self.places.get(name)?)
    }

    /// Whether code is generated from it that runs in packs.
    pub fn runs_on_lanes(&self) -> bool {
        let mut requests = self.functions.iter().flat_map(|known| &known.request);
        requests.any(|request| request.columns || !request.stages.is_empty())
    }

    fn specialise(
        &mut self,
        original: &str,
        specialisation: Specialisation,
        diagnostics: &mut Diagnostics,
    ) {
        let name = &specialisation.name;
        if self.function(&name.to_string()).is_some() {
            diagnostics.error_with_hint(
                name.span(),
                format!("the module has a function `{name}` already"),
                "give the specialisation another name",
            );
            return;
        }
        let Some(position) = (self.functions.iter()).position(|known| known.name() == original)
        else {
            return;
        };
        let function = Rc::clone(&self.functions[position]);
        if let Some(special) = specialise::function(&function, specialisation, diagnostics) {
            self.functions.insert(position, Rc::new(special));
            let names = self.functions.iter().map(|function| function.name());
            self.places = names.zip(0..).collect();
        }
    }

    /// Adds a function; what is to be specialised from it, is left for later.
    fn read_function(
        &mut self,
        item: &mut ItemFn,
        of: Option<&Ident>,
        diagnostics: &mut Diagnostics,
    ) -> Vec<(String, Specialisation)> {
        let attributes = FunctionAttributes::read(&item.attrs, diagnostics);
        let approximated = item
            .attrs
            .iter()
            .any(|attribute| attribute.path().is_ident("approximate"));
        item.attrs
            .retain(|attribute| !OWN.iter().any(|name| attribute.path().is_ident(name)));
        if attributes.request.is_some() {
            // Its generated forms may be all that is called.
            item.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
        }
        let before = diagnostics.len();
        let parameters = signature::read(self, item, diagnostics);
        let mut function = Function {
            item: item.clone(),
            of: of.cloned(),
            parameters,
            readable: true,
            request: attributes.request,
            domain: attributes
                .domain
                .into_iter()
                .map(|(target, sign)| (target.symbol, sign, target.span))
                .collect(),
            approximation: attributes.approximation,
            specialises: None,
        };
        if let Some(approximation) = &function.approximation {
            signature::check_approximation(&function, approximation, diagnostics);
        }
        function.readable =
            diagnostics.len() == before && approximated == function.approximation.is_some();
        let name = function.name();
        if self.function(&name).is_some() {
            diagnostics.error_with_hint(
                item.sig.ident.span(),
                format!("a second function `{name}`"),
                "a formula is found by its name: give each its own",
            );
            return Vec::new();
        }
        let place = self.functions.len();
        self.places.entry(function.name()).or_insert(place);
        self.functions.push(Rc::new(function));
        if let (Some(of), Some(special)) = (of, attributes.specialisations.first()) {
            diagnostics.error_with_hint(
                special.name.span(),
                format!("a method of `{of}` is not specialised"),
                "write a function that calls it",
            );
            return Vec::new();
        }
        let specialisations = attributes.specialisations.into_iter();
        specialisations
            .map(|special| (name.clone(), special))
            .collect()
    }
}
