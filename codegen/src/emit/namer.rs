//! Names of temporaries: the author's where a `let` gave one, else made from what is computed.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use proc_macro2::{Ident, Span};

use crate::circuit::{Circuit, Net, Operation};
use crate::graph::{Function, Graph, Rational, SymbolId, ratio, whole};
use crate::parse::body::identifier;

/// The longest name that is made from others.
pub const LONGEST: usize = 24;

/// Chooses names and keeps them apart.
pub struct Namer {
    taken: BTreeSet<String>,
    names: BTreeMap<Net, String>,
    /// Names that say no more than the kind of their operation.
    plain: BTreeSet<Net>,
    /// For each operation the named one that it is for, where there is one alone; made at the first question.
    purposes: Option<Vec<Option<String>>>,
    counter: BTreeMap<&'static str, usize>,
    /// For each name that was wished for, the last number that was tried with it: all before are taken.
    attempts: HashMap<String, usize>,
}

impl Namer {
    /// A namer that leaves the given names alone.
    pub fn new(taken: impl IntoIterator<Item = String>) -> Self {
        Self {
            taken: taken.into_iter().collect(),
            names: BTreeMap::new(),
            plain: BTreeSet::new(),
            purposes: None,
            counter: BTreeMap::new(),
            attempts: HashMap::new(),
        }
    }

    /// The name given to an operation, if it has one.
    pub fn name(&self, net: Net) -> Option<Ident> {
        self.names
            .get(&net)
            .map(|name| Ident::new(name, Span::call_site()))
    }

    /// Gives an operation its name.
    pub fn bind(&mut self, graph: &Graph, circuit: &Circuit, net: Net) -> Ident {
        let wish = circuit
            .suggested_name(net)
            .map(ToOwned::to_owned)
            .or_else(|| self.describe(graph, circuit, net));
        let name = match wish {
            Some(wish) => self.unique(&wish),
            None => {
                self.plain.insert(net);
                match self.purpose(circuit, net) {
                    Some(purpose) => self.unique(&purpose),
                    None => self.numbered(kind(circuit.operation(net))),
                }
            }
        };
        let ident = Ident::new(&name, Span::call_site());
        self.names.insert(net, name);
        ident
    }

    fn unique(&mut self, wish: &str) -> String {
        let wish = wish.trim_start_matches("r#");
        let attempt = self.attempts.entry(wish.to_owned()).or_insert(0);
        loop {
            *attempt += 1;
            let name = match *attempt {
                1 => wish.to_owned(),
                number => format!("{wish}_{number}"),
            };
            if is_identifier(&name) && self.taken.insert(name.clone()) {
                return name;
            }
        }
    }

    /// A name of a kind with a number.
    pub fn numbered(&mut self, kind: &'static str) -> String {
        let count = self.counter.entry(kind).or_insert(0);
        *count += 1;
        let wish = format!("{kind}_{count}");
        self.unique(&wish)
    }

    /// A name after the one result or named number that an operation is for.
    fn purpose(&mut self, circuit: &Circuit, net: Net) -> Option<String> {
        let purposes = self.purposes.get_or_insert_with(|| purposes(circuit));
        let purpose = purposes.get(net.index())?.as_ref()?;
        let name = format!("{purpose}_{}", kind(circuit.operation(net)));
        (name.len() <= LONGEST).then_some(name)
    }

    /// What an operand is called within other names.
    fn part(&self, graph: &Graph, circuit: &Circuit, net: Net) -> Option<String> {
        match circuit.operation(net) {
            Operation::Symbol(symbol) => Some(short(graph, *symbol)),
            _ => self.names.get(&net).cloned(),
        }
    }

    /// Whether one name among these says more than the kind of its operation; several that do not say nothing together.
    fn is_telling(&self, operands: &[Net]) -> bool {
        operands.iter().any(|net| !self.plain.contains(net))
    }

    fn describe_sum(
        &self,
        graph: &Graph,
        circuit: &Circuit,
        terms: &[(Net, Rational)],
    ) -> Option<String> {
        let word = |net: Net| match circuit.as_number(net) {
            Some(number) => number.is_one().then(|| "one".to_owned()),
            None => self.part(graph, circuit, net),
        };
        match terms {
            [(x, a)] if *a == whole(2) => Some(format!("twice_{}", word(*x)?)),
            [(x, a)] if *a == ratio(1, 2) => Some(format!("half_{}", word(*x)?)),
            [(x, a), (y, b)] if a.is_unit() && b.is_unit() => {
                let (first, second) = if a.is_positive() { (x, y) } else { (y, x) };
                let sign = match (a.is_positive(), b.is_positive()) {
                    (true, true) => "plus",
                    (false, false) => return None,
                    _ => "minus",
                };
                let name = || Some(format!("{}_{sign}_{}", word(*first)?, word(*second)?));
                self.is_telling(&[*x, *y]).then(name)?
            }
            _ => None,
        }
    }

    fn describe(&self, graph: &Graph, circuit: &Circuit, net: Net) -> Option<String> {
        let part = |net: Net| self.part(graph, circuit, net);
        let telling = |operands: &[Net]| self.is_telling(operands);
        let name = match circuit.operation(net) {
            Operation::Product(factors) => match factors.as_slice() {
                [(x, 2)] => format!("{}_squared", part(*x)?),
                [(x, 3)] => format!("{}_cubed", part(*x)?),
                [(x, 1), (y, 1)] if telling(&[*x, *y]) => format!("{}_{}", part(*x)?, part(*y)?),
                [(x, 1), (y, 1), (z, 1)] if telling(&[*x, *y, *z]) => {
                    format!("{}_{}_{}", part(*x)?, part(*y)?, part(*z)?)
                }
                _ => return None,
            },
            Operation::Quotient(numerator, denominator)
                if circuit.as_number(*numerator).is_some() =>
            {
                format!("inverse_{}", part(*denominator)?)
            }
            Operation::Quotient(numerator, denominator) if telling(&[*numerator, *denominator]) => {
                format!("{}_over_{}", part(*numerator)?, part(*denominator)?)
            }
            Operation::Sum(terms) => self.describe_sum(graph, circuit, terms)?,
            Operation::Apply(function, operands) => match (function, operands.as_slice()) {
                (Function::Sqrt, [x]) => format!("root_{}", part(*x)?),
                (Function::Abs, [x]) => format!("size_{}", part(*x)?),
                (function, [x]) => format!("{}_{}", function.row().method, part(*x)?),
                _ => return None,
            },
            Operation::Tabulated { table, order, .. } => {
                let name = graph
                    .tables
                    .get(*table)
                    .map_or("", |table| table.name.as_str());
                if *order == 0 {
                    format!("{name}_fit")
                } else {
                    format!("{name}_fit_{order}")
                }
            }
            Operation::Quotient(..) | Operation::Number(_) | Operation::Symbol(_) => return None,
        };
        (name.len() <= LONGEST).then_some(name)
    }
}

/// Whether a word is no keyword. None has an underscore beside other letters, so that most names need not be read as tokens.
fn is_identifier(word: &str) -> bool {
    (word.len() > 1 && word.contains('_')) || syn::parse_str::<Ident>(word).is_ok()
}

/// For each operation the named operation that all its users lead to, if that is one alone.
fn purposes(circuit: &Circuit) -> Vec<Option<String>> {
    let nets: Vec<Net> = circuit.nets().collect();
    let mut users: Vec<BTreeSet<Option<String>>> = vec![BTreeSet::new(); nets.len()];
    for output in &circuit.outputs {
        // What a result is for is said by its own name, where it has one.
        users[output.index()].insert(None);
    }
    let mut purposes = vec![None; nets.len()];
    for net in nets.into_iter().rev() {
        let mut of_users = users[net.index()].iter();
        let alone = of_users.next().cloned().flatten();
        let purpose = alone.filter(|_| of_users.next().is_none());
        let passed_on = circuit
            .suggested_name(net)
            .map(ToOwned::to_owned)
            .or(purpose.clone());
        for operand in circuit.operands(net) {
            users[operand.index()].insert(passed_on.clone());
        }
        purposes[net.index()] = purpose;
    }
    purposes
}

/// The last part of a symbol's path.
fn short(graph: &Graph, symbol: SymbolId) -> String {
    let name = &graph.symbol(symbol).name;
    identifier(name.rsplit('.').next().unwrap_or(name))
}

/// What an operation without a better name is called.
fn kind(operation: &Operation) -> &'static str {
    match operation {
        Operation::Sum(terms) if terms.len() == 1 => "multiple",
        Operation::Sum(_) => "sum",
        Operation::Product(_) => "product",
        Operation::Quotient(..) => "quotient",
        Operation::Apply(Function::Sqrt, _) => "root",
        Operation::Apply(function, _) if function.is_selection() => "choice",
        _ => "value",
    }
}

/// Name of the function that evaluates a table's derivative.
pub fn table_function(graph: &Graph, table: usize, order: usize) -> String {
    let table = graph.tables.get(table);
    table_function_of(table.map_or("", |table| table.name.as_str()), order)
}

/// Name of the function that evaluates a derivative of the table with this name.
pub fn table_function_of(name: &str, order: usize) -> String {
    match order {
        0 => format!("{name}_table"),
        1 => format!("{name}_table_slope"),
        2 => format!("{name}_table_curvature"),
        _ => format!("{name}_table_derivative_{order}"),
    }
}

/// How the names of functions end that evaluate a table for a pack.
const OF_PACK: &str = "_of_pack";

/// Name of the function that evaluates a table for a pack, given the name of the one for a number.
pub fn pack_table_function(table_function: &str) -> String {
    format!("{table_function}{OF_PACK}")
}

/// Whether a name is that of a function that evaluates a table for a pack.
pub fn is_pack_table_function(name: &str) -> bool {
    name.ends_with(OF_PACK)
}
