//! The items of a module of formulas.

use std::rc::Rc;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;
use syn::visit::Visit;
use syn::{FnArg, Ident, Item, ItemFn, ItemMod, Pat, Type};

use super::attributes::{Approximation, FunctionAttributes, OWN, Request, Specialisation};
use super::imports::Imports;
use super::{cycles, numbers, signature, specialise};
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sizes};

/// A module of formulas.
#[derive(Debug)]
pub struct Module {
    /// The item as written, without the generator's own attributes.
    pub item: ItemMod,
    /// Its functions in order.
    pub functions: Vec<Rc<Function>>,
    /// The place of each by its name, of two that have one name that of the first.
    places: BTreeMap<String, usize>,
    /// Its constants: name and value.
    pub constants: Vec<(String, syn::Expr)>,
    /// What it imports of the standard library's constants.
    pub imports: Imports,
    /// Constants whose value is needed for itself; that is reported, they have none.
    pub cyclic_constants: BTreeSet<String>,
    /// Its structs: name and fields.
    pub structs: Vec<(String, Vec<String>)>,
    /// How large the numbers are that its functions are given.
    pub sizes: Sizes,
    /// Where numbers of some names lie wherever a function takes them.
    pub domain: Vec<(String, Domain)>,
}

/// A function of the module.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its item, without the generator's own attributes.
    pub item: ItemFn,
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
    pub kind: ParameterKind,
    /// Its type as written.
    pub ty: Type,
}

/// What a parameter holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// One `f64`.
    Number,
    /// `[f64; n]`.
    Array(usize),
    /// A struct with fields of type `f64`.
    Struct,
}

impl Function {
    /// The function's name.
    pub fn name(&self) -> String {
        self.item.sig.ident.to_string()
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
    /// Reads a module. Functions whose signature can't be taken are left as written, and reported.
    pub fn read(mut item: ItemMod, diagnostics: &mut Diagnostics) -> Self {
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
        };
        let Some((_, items)) = &mut item.content else {
            diagnostics.error_with_hint(
                item.ident.span(),
                "the module's formulas are not here",
                "write the module inline: mod name { … }",
            );
            return module;
        };
        let mut specialisations = Vec::new();
        for item in items.iter_mut() {
            match item {
                Item::Fn(function) => {
                    specialisations.extend(module.read_function(function, diagnostics));
                }
                Item::Const(constant) => {
                    module
                        .constants
                        .push((constant.ident.to_string(), (*constant.expr).clone()));
                }
                Item::Struct(item) => {
                    let fields = item.fields.iter().enumerate();
                    let fields = fields.map(|(position, field)| match &field.ident {
                        Some(name) => name.to_string(),
                        None => position.to_string(),
                    });
                    module
                        .structs
                        .push((item.ident.to_string(), fields.collect()));
                }
                Item::Use(import) => module.imports.read(&mut Vec::new(), &import.tree),
                _ => {}
            }
        }
        module.item = item;
        numbers::check_domains(&module, diagnostics);
        // Only now all names are known that a new function could meet.
        for (original, specialisation) in specialisations {
            module.specialise(&original, specialisation, diagnostics);
        }
        numbers::check_targets(&module, diagnostics);
        cycles::check(&mut module, diagnostics);
        module
    }

    /// The function of that name.
    pub fn function(&self, name: &str) -> Option<&Rc<Function>> {
        self.functions.get(*self.places.get(name)?)
    }

    /// The fields of a struct of the module by its type or a reference to it; those of a struct from outside are not
    /// known.
    pub fn fields_of(&self, ty: &Type) -> Option<&[String]> {
        match ty {
            Type::Reference(reference) => self.fields_of(&reference.elem),
            Type::Paren(paren) => self.fields_of(&paren.elem),
            Type::Path(path) if path.qself.is_none() => self.fields_at(&path.path),
            _ => None,
        }
    }

    /// The fields of a struct of the module by its path.
    pub fn fields_at(&self, path: &syn::Path) -> Option<&[String]> {
        let segments: Vec<&Ident> = path.segments.iter().map(|part| &part.ident).collect();
        let name = match segments.as_slice() {
            [name] => name,
            [own, name] if *own == "self" => name,
            _ => return None,
        };
        let found = self.structs.iter().find(|(known, _)| *name == known);
        found.map(|(_, fields)| fields.as_slice())
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
        if let Some(special) = specialise::function(self, &function, specialisation, diagnostics) {
            self.functions.insert(position, Rc::new(special));
            let names = self.functions.iter().map(|function| function.name());
            self.places = names.zip(0..).collect();
        }
    }

    /// Adds a function; what is to be specialised from it, is left for later.
    fn read_function(
        &mut self,
        item: &mut ItemFn,
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
        let parameters = signature::read(item, diagnostics);
        let mut function = Function {
            item: item.clone(),
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
        let specialisations = attributes.specialisations.into_iter();
        specialisations
            .map(|special| (name.clone(), special))
            .collect()
    }
}
