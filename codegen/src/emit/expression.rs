//! Operations as Rust expressions, and the statements that compute a circuit's results.

use std::collections::BTreeSet;

use num_traits::{One, Signed};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::literal;
use super::namer::{Namer, method, table_function};
use crate::factor::circuit::{Circuit, Net, Operation};
use crate::graph::{Function, Graph, Rational, SymbolId};

/// Expressions of more operations than this are given a name, so that a line stays a line.
const LARGEST: usize = 7;

/// How tightly an expression holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Choice,
    Sum,
    Product,
    Negative,
    Atom,
}

struct Piece {
    tokens: TokenStream,
    precedence: Precedence,
}

impl Piece {
    fn atom(tokens: TokenStream) -> Self {
        Self { tokens, precedence: Precedence::Atom }
    }

    /// The tokens, in parentheses where they would fall apart beside an operator.
    fn at_least(self, precedence: Precedence) -> TokenStream {
        let tokens = self.tokens;
        if self.precedence >= precedence { tokens } else { quote!((#tokens)) }
    }
}

/// Writes one circuit.
pub struct Writer<'a> {
    graph: &'a Graph,
    circuit: &'a Circuit,
    symbol: &'a dyn Fn(SymbolId) -> TokenStream,
    namer: Namer,
}

/// The statements of a circuit and the expressions of its results.
pub struct Body {
    /// `let` statements in order.
    pub statements: Vec<TokenStream>,
    /// One expression for each output.
    pub outputs: Vec<TokenStream>,
}

impl<'a> Writer<'a> {
    /// A writer; `symbol` says how a symbol is written, `taken` which names are not free.
    pub fn new(
        graph: &'a Graph,
        circuit: &'a Circuit,
        symbol: &'a dyn Fn(SymbolId) -> TokenStream,
        taken: impl IntoIterator<Item = String>,
    ) -> Self {
        Self { graph, circuit, symbol, namer: Namer::new(taken) }
    }

    /// The circuit as statements and results.
    pub fn body(mut self) -> Body {
        let named = self.named();
        let mut statements = Vec::new();
        for net in self.circuit.nets() {
            if named.contains(&net) {
                let value = self.operation(net).tokens;
                let name = self.namer.bind(self.graph, self.circuit, net);
                statements.push(quote!(let #name = #value;));
            }
        }
        let outputs = self.circuit.outputs.iter().map(|output| self.operand(*output).tokens).collect();
        Body { statements, outputs }
    }

    /// Which operations get a name: those used twice, those that the author named, and parts of long expressions.
    fn named(&self) -> BTreeSet<Net> {
        let mut uses = self.circuit.uses();
        for net in self.circuit.nets() {
            match self.circuit.operation(net) {
                Operation::Product(factors) => {
                    for (operand, power) in factors.iter().filter(|(_, power)| *power > 1) {
                        uses[operand.index()] += *power as usize - 1;
                    }
                }
                // A choice writes an operand that it returns once more beside the comparison.
                Operation::Apply(Function::Select, _) => uses[net.index()] += 1,
                _ => {}
            }
        }
        let mut named = BTreeSet::new();
        let mut sizes = vec![0_usize; uses.len()];
        for net in self.circuit.nets() {
            if matches!(self.circuit.operation(net), Operation::Number(_) | Operation::Symbol(_)) {
                continue;
            }
            let operands = self.circuit.operands(net);
            let inner: usize =
                operands.iter().filter(|operand| !named.contains(*operand)).map(|operand| sizes[operand.index()]).sum();
            let own = operands.len().max(1);
            // The largest operands of a long expression get names of their own.
            if inner + own > LARGEST {
                for operand in operands {
                    if sizes[operand.index()] > 2 {
                        named.insert(operand);
                    }
                }
            }
            let inner: usize = self
                .circuit
                .operands(net)
                .iter()
                .filter(|operand| !named.contains(*operand))
                .map(|operand| sizes[operand.index()])
                .sum();
            sizes[net.index()] = inner + own;
            if uses[net.index()] > 1 || self.circuit.suggested_name(net).is_some() {
                named.insert(net);
            }
        }
        named
    }

    /// An operand: its name, or its expression where it has none.
    fn operand(&self, net: Net) -> Piece {
        match self.namer.name(net) {
            Some(name) => Piece::atom(quote!(#name)),
            None => self.operation(net),
        }
    }

    fn operation(&self, net: Net) -> Piece {
        match self.circuit.operation(net) {
            Operation::Number(value) => {
                let precedence = if value.is_negative() { Precedence::Negative } else { Precedence::Atom };
                Piece { tokens: literal::number(value), precedence }
            }
            Operation::Symbol(symbol) => Piece::atom((self.symbol)(*symbol)),
            Operation::Sum(terms) => self.sum(terms),
            Operation::Product(factors) => self.product(factors),
            Operation::Quotient(numerator, denominator) => {
                let numerator = self.operand(*numerator).at_least(Precedence::Product);
                let denominator = self.operand(*denominator).at_least(Precedence::Negative);
                Piece { tokens: quote!(#numerator / #denominator), precedence: Precedence::Product }
            }
            Operation::Apply(function, operands) => self.apply(*function, operands),
            Operation::Tabulated { table, order, argument } => {
                let function = format_ident!("{}", table_function(self.graph, *table, *order));
                let argument = self.operand(*argument).tokens;
                Piece::atom(quote!(#function(#argument)))
            }
        }
    }

    fn sum(&self, terms: &[(Net, Rational)]) -> Piece {
        let first = terms.iter().position(|(_, coefficient)| coefficient.is_positive()).unwrap_or(0);
        let rest = terms.iter().enumerate().filter(|(position, _)| *position != first).map(|(_, term)| term);
        let mut tokens = TokenStream::new();
        for (position, (operand, coefficient)) in terms.get(first).into_iter().chain(rest).enumerate() {
            let term = self.term(*operand, &coefficient.abs());
            let precedence = if position == 0 && terms.len() == 1 { Precedence::Product } else { Precedence::Product };
            let term = term.at_least(precedence);
            tokens.extend(match (position, coefficient.is_negative()) {
                (0, false) => term,
                (0, true) => quote!(-#term),
                (_, false) => quote!(+ #term),
                (_, true) => quote!(- #term),
            });
        }
        let precedence = match terms {
            [(_, coefficient)] if coefficient.is_negative() => Precedence::Negative,
            [_] => Precedence::Product,
            _ => Precedence::Sum,
        };
        Piece { tokens, precedence }
    }

    /// A positive multiple of an operand.
    fn term(&self, operand: Net, size: &Rational) -> Piece {
        if let Some(number) = self.circuit.as_number(operand) {
            return Piece::atom(literal::number(&(number * size)));
        }
        let piece = self.operand(operand);
        if size.is_one() {
            return piece;
        }
        let (size, operand) = (literal::number(size), piece.at_least(Precedence::Product));
        Piece { tokens: quote!(#size * #operand), precedence: Precedence::Product }
    }

    fn product(&self, factors: &[(Net, u32)]) -> Piece {
        let mut tokens = TokenStream::new();
        for (operand, power) in factors {
            for _ in 0..*power {
                let separator = (!tokens.is_empty()).then(|| quote!(*));
                // A product or quotient within stays together, as it was counted.
                let operand = self.operand(*operand).at_least(Precedence::Negative);
                tokens.extend(quote!(#separator #operand));
            }
        }
        Piece { tokens, precedence: Precedence::Product }
    }

    fn apply(&self, function: Function, operands: &[Net]) -> Piece {
        if let (Function::Select, [a, b, x, y]) = (function, operands) {
            let [a, b, x, y] = [a, b, x, y].map(|operand| self.operand(*operand).tokens);
            return Piece { tokens: quote!(if #a <= #b { #x } else { #y }), precedence: Precedence::Choice };
        }
        let name: Option<Ident> = method(function).map(|name| format_ident!("{name}"));
        let mut operands = operands.iter();
        let receiver = operands.next().map(|operand| self.receiver(*operand));
        let rest = operands.map(|operand| self.operand(*operand).tokens);
        Piece::atom(quote!(#receiver.#name(#(#rest),*)))
    }

    /// The operand of a method; the type of a bare literal must be said.
    fn receiver(&self, net: Net) -> TokenStream {
        match self.circuit.as_number(net) {
            Some(value) => {
                let value = literal::number(value);
                quote!(f64::from(#value))
            }
            None => self.operand(net).at_least(Precedence::Atom),
        }
    }
}
