//! The formulas of a module that take part in its chain.

use proc_macro2::TokenStream;
use syn::Type;

use super::text::output_names;
use super::{Expansion, Formula};
use crate::chain::{Chain, Given, Member, StagedMember, Taken};
use crate::emit::{chain, staged};
use crate::graph::Node;
use crate::parse::attributes::{Request, root};
use crate::parse::body::identifier;
use crate::parse::module::{Function, ParameterKind};
use crate::parse::value::Value;

impl Expansion {
    /// Takes a formula into the chain: `rows` is what its column form costs a row, `staged` what each of its staged forms costs
    /// for every value of what runs along and at every point. What cannot be in the chain is reported.
    pub(super) fn join_chain(
        &mut self,
        function: &Function,
        request: &Request,
        rows: Option<usize>,
        staged: &[[usize; 2]],
    ) {
        let Some(chain) = &request.chain else { return };
        let Some(formula) = self.formula(&function.name()) else {
            return;
        };
        let mut member = member(function, formula);
        member.rows = rows;
        let symbols = formula.input_names();
        let forms = request.stages.iter().zip(staged);
        member.staged = forms
            .map(|(stage, weights)| staged_member(&stage.symbols(), &symbols, *weights))
            .collect();
        let problem = if !request.columns && request.stages.is_empty() {
            let what = format!(
                "`{}` is in the chain with no form over columns",
                member.name
            );
            Some((what, "write `columns` beside `chain`"))
        } else if chain.names.is_empty() {
            None
        } else if member.structure.is_some() || chain.names.len() != member.gives.len() {
            let (results, names) = (member.gives.len(), chain.names.len());
            let what = format!(
                "`{}` gives {results} results, and the chain names {names}",
                member.name
            );
            Some((
                what,
                "name each number of a tuple; the fields of a struct have names",
            ))
        } else {
            for (given, name) in member.gives.iter_mut().zip(&chain.names) {
                given.name.clone_from(name);
            }
            None
        };
        match problem {
            Some((what, hint)) => self.diagnostics.error_with_hint(chain.span, what, hint),
            None => self.members.push(member),
        }
    }

    /// The module of the chain, if formulas take part in one.
    pub(super) fn chain_items(&mut self) -> Option<TokenStream> {
        if self.members.is_empty() {
            return None;
        }
        let found = Chain::of(&self.members, &mut self.diagnostics)?;
        Some(chain::module(&found))
    }
}

/// A formula as a member of a chain, by itself.
fn member(function: &Function, formula: &Formula) -> Member {
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
    Member {
        span: function.item.sig.ident.span(),
        takes: takes.iter().map(|symbol| taken(function, symbol)).collect(),
        structure: structure.map(|last| last.trim().to_owned()),
        gives: gives.collect(),
        rows: None,
        staged: Vec::new(),
        name,
    }
}

/// What a number is that a formula takes.
fn taken(function: &Function, symbol: &str) -> Taken {
    let parameter = function.parameter(root(symbol));
    let structure = parameter.filter(|parameter| parameter.kind == ParameterKind::Struct);
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

fn staged_member(along: &[String], symbols: &[String], weights: [usize; 2]) -> StagedMember {
    StagedMember {
        module: staged::module_name(along),
        weights,
        along: along
            .iter()
            .filter_map(|name| symbols.iter().position(|known| known == name))
            .collect(),
    }
}
