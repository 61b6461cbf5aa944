//! The formulas that take part in a chain, of a module and of those that it links.

use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote};
use syn::Type;

use super::fallback::one_deeper;
use super::text::output_names;
use super::{Expansion, Formula};
use crate::chain::{Chain, Given, Member, StagedMember, Taken};
use crate::emit::{chain, staged};
use crate::graph::Node;
use crate::parse::attributes::{Request, root};
use crate::parse::body::{Reader, identifier};
use crate::parse::module::{Function, Module};
use crate::parse::names::Linked;
use crate::parse::numbers;
use crate::parse::shape::Shape;
use crate::parse::value::Value;
use crate::tables::Tables;

impl Expansion {
    /// Takes a formula into the chain. What cannot be in one is reported.
    pub(super) fn join_chain(&mut self, function: &Function, request: &Request) {
        let Some(formula) = self.formula(&function.name()) else {
            return;
        };
        match member(function, request, formula) {
            Some(Ok(member)) => self.members.push(member),
            Some(Err((message, hint))) => {
                let span = request.chain.as_ref().map(|chain| chain.span);
                let span = span.unwrap_or_else(|| function.item.sig.ident.span());
                self.diagnostics.error_with_hint(span, message, hint);
            }
            None => {}
        }
    }

    /// The module of the chain, if this module has one and formulas take part in it.
    pub(super) fn chain_items(&mut self) -> Option<TokenStream> {
        if !self.module.has_chain {
            return None;
        }
        let (mut members, mut imports) = (Vec::new(), Vec::new());
        let mut seen: Vec<&str> = Vec::new();
        for linked in &self.module.linked {
            let key = linked.module.key.as_str();
            if !seen.contains(&key) {
                seen.push(key);
                let of_it = linked_members(&linked.module);
                imports.extend(of_it.iter().map(|member| import(linked, &member.name)));
                members.extend(of_it);
            }
        }
        members.append(&mut self.members);
        for (place, member) in members.iter().enumerate() {
            if members[..place]
                .iter()
                .any(|other| other.name == member.name)
            {
                self.diagnostics.error_with_hint(
                    member.span,
                    format!("a second formula `{}` in the chain", member.name),
                    "give one of them another name",
                );
                return None;
            }
        }
        if members.is_empty() {
            return None;
        }
        let found = Chain::of(&members, &mut self.diagnostics)?;
        Some(chain::module(&found, &imports))
    }
}

/// The formulas of a linked module that take part; what is wrong with one is reported there.
fn linked_members(module: &Module) -> Vec<Member> {
    let mut tables = Tables::sketched();
    let functions = module.functions.iter();
    let members = functions.filter_map(|function| {
        let request = function
            .request
            .as_ref()
            .filter(|request| request.chain.is_some())?;
        let mut reader = Reader::new(module, &mut tables);
        let value = reader.read(function)?;
        let mut formula = Formula::of(reader.graph, &value, false);
        for target in request.targets() {
            if numbers::misfit(function, &target.symbol).is_none() {
                formula.input(&target.symbol);
            }
        }
        member(function, request, &formula)?.ok()
    });
    members.collect()
}

/// Brings a formula of a linked module into the module of the chain.
fn import(linked: &Linked, name: &str) -> TokenStream {
    let (place, name) = (
        linked.place.tokens_within(Span::call_site()),
        format_ident!("{name}"),
    );
    one_deeper(quote!(use #place::#name;))
}

/// A formula as a member of a chain, by itself; why it can't be one, if it asks for it.
fn member(
    function: &Function,
    request: &Request,
    formula: &Formula,
) -> Option<Result<Member, (String, &'static str)>> {
    let chain = request.chain.as_ref()?;
    let mut member = unnamed(function, request, formula);
    if !request.columns && request.stages.is_empty() {
        let what = format!(
            "`{}` is in the chain with no form over columns",
            member.name
        );
        return Some(Err((what, "write `columns` beside `chain`")));
    }
    if chain.names.is_empty() {
        return Some(Ok(member));
    }
    if member.structure.is_some() || chain.names.len() != member.gives.len() {
        let (results, names) = (member.gives.len(), chain.names.len());
        let what = format!(
            "`{}` gives {results} results, and the chain names {names}",
            member.name
        );
        let hint = "name each number of a tuple; the fields of a struct have names";
        return Some(Err((what, hint)));
    }
    for (given, name) in member.gives.iter_mut().zip(&chain.names) {
        given.name.clone_from(name);
    }
    Some(Ok(member))
}

/// A member whose results have the names that its type gives them.
fn unnamed(function: &Function, request: &Request, formula: &Formula) -> Member {
    let name = function.name();
    let symbols = formula.inputs();
    let structure = match &formula.value {
        Value::Struct { name, .. } => name.rsplit("::").next(),
        _ => None,
    };
    let mut names = output_names(&formula.value, &formula.graph, &[]);
    if let (Value::Number(_), [only]) = (&formula.value, names.as_mut_slice()) {
        only.clone_from(&name);
    }
    let needs = |root| {
        let known = formula.graph.symbols_of(&[root]);
        let places = symbols.iter().enumerate();
        places
            .filter_map(|(place, id)| known.contains(id).then_some(place))
            .collect()
    };
    let gives = names.into_iter().zip(&formula.roots);
    let gives = gives.map(|(name, root)| Given {
        name,
        needs: needs(*root),
        passes: match formula.graph.node(*root) {
            Node::Symbol(id) => symbols.iter().position(|known| known == id),
            _ => None,
        },
    });
    let takes = formula.input_names();
    let stages = request.stages.iter();
    let stages = stages.map(|stage| staged_member(&stage.symbols(), &takes));
    Member {
        span: function.item.sig.ident.span(),
        takes: takes.iter().map(|symbol| taken(function, symbol)).collect(),
        structure: structure.map(|last| last.trim().to_owned()),
        gives: gives.collect(),
        rows: request.columns,
        staged: stages.collect(),
        name,
    }
}

/// What a number is that a formula takes.
fn taken(function: &Function, symbol: &str) -> Taken {
    let parameter = function.parameter(root(symbol));
    let structure = parameter.filter(|parameter| matches!(parameter.shape, Shape::Struct(..)));
    match structure.and_then(|parameter| last_name(&parameter.ty)) {
        Some(structure) => Taken {
            structure: Some(structure),
            name: identifier(symbol.split_once('.').map_or(symbol, |(_, field)| field)),
        },
        None => Taken {
            structure: None,
            name: identifier(symbol),
        },
    }
}

fn last_name(ty: &Type) -> Option<String> {
    match ty {
        Type::Reference(reference) => last_name(&reference.elem),
        Type::Paren(paren) => last_name(&paren.elem),
        Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
        _ => None,
    }
}

fn staged_member(along: &[String], symbols: &[String]) -> StagedMember {
    StagedMember {
        module: staged::module_name(along),
        along: along
            .iter()
            .filter_map(|name| symbols.iter().position(|known| known == name))
            .collect(),
    }
}
