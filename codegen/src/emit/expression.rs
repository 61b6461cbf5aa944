//! Operations as Rust expressions, and the statements that compute a circuit's results.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};

use super::literal;
use super::namer::{LONGEST, Namer, pack_table_function, table_function};
use super::roots;
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::{Function, Graph, Rational, SymbolId};

/// The width of a statement without its indentation, so that it stays on a line.
const WIDEST: usize = 68;

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
        Self {
            tokens,
            precedence: Precedence::Atom,
        }
    }

    /// The tokens, in parentheses where they would fall apart beside an operator.
    fn at_least(self, precedence: Precedence) -> TokenStream {
        let tokens = self.tokens;
        if self.precedence >= precedence {
            tokens
        } else {
            quote!((#tokens))
        }
    }
}

/// What the numbers of the written code are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// An `f64` each.
    Single,
    /// A `lanes::Pack` each; the instructions are called `simd`.
    Packs,
}

/// Writes one circuit.
pub struct Writer<'a> {
    graph: &'a Graph,
    circuit: &'a Circuit,
    symbol: &'a dyn Fn(SymbolId) -> TokenStream,
    numbers: Numbers,
    /// Whether single numbers have the sines and cosines of packs.
    with_sines_of_packs: bool,
    /// Roots that leave the divider to others.
    by_multiplication: BTreeSet<Net>,
    /// Sines and cosines of one angle, both under each of them: of packs they are computed together.
    sines_with_cosines: BTreeMap<Net, [Net; 2]>,
    namer: Namer,
}

/// A `let` statement: of one name, or of two where the expression is a pair.
pub struct Statement {
    /// The names that it gives.
    pub names: Vec<Ident>,
    /// What they are.
    pub expression: TokenStream,
}

impl Statement {
    /// Creates the statement that gives an expression a name.
    pub fn new(name: Ident, expression: TokenStream) -> Self {
        Self {
            names: vec![name],
            expression,
        }
    }
}

impl ToTokens for Statement {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let (names, expression) = (&self.names, &self.expression);
        tokens.extend(match names.as_slice() {
            [name] => quote!(let #name = #expression;),
            _ => quote!(let (#(#names),*) = #expression;),
        });
    }
}

/// The statements of a circuit and the expressions of its results.
pub struct Body {
    /// `let` statements in order.
    pub statements: Vec<Statement>,
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
        // A temporary of the name of a function would hide it.
        let tables = circuit
            .nets()
            .filter_map(|net| match circuit.operation(net) {
                Operation::Tabulated { table, order, .. } => {
                    Some(table_function(graph, *table, *order))
                }
                _ => None,
            })
            .flat_map(|name| [pack_table_function(&name), name]);
        Self {
            graph,
            circuit,
            symbol,
            numbers: Numbers::Single,
            with_sines_of_packs: false,
            by_multiplication: BTreeSet::new(),
            sines_with_cosines: BTreeMap::new(),
            namer: Namer::new(taken.into_iter().chain(tables)),
        }
    }

    /// Makes the writer use the sines and cosines of packs, so that a single number has the bits of one in a pack.
    pub fn with_sines_of_packs(self, wanted: bool) -> Self {
        Self {
            with_sines_of_packs: wanted,
            ..self
        }
    }

    /// Makes the writer write code over packs of numbers.
    pub fn in_packs(self) -> Self {
        Self {
            numbers: Numbers::Packs,
            by_multiplication: roots::by_multiplication(self.circuit),
            sines_with_cosines: sines_with_cosines(self.circuit),
            ..self
        }
    }

    /// The circuit as statements and results.
    pub fn body(mut self) -> Body {
        let frequent = self.frequent();
        let mut statements = Vec::new();
        for net in self.circuit.nets() {
            if self.is_leaf(net) || self.namer.name(net).is_some() {
                continue;
            }
            if let Some(pair) = self.sines_with_cosines.get(&net).copied() {
                self.shorten(net, &mut statements);
                self.state_pair(pair, &mut statements);
                continue;
            }
            let fits = self.shorten(net, &mut statements);
            if !fits || frequent.contains(&net) {
                self.state(net, &mut statements);
            }
        }
        let outputs = self
            .circuit
            .outputs
            .iter()
            .map(|output| self.value(*output).tokens)
            .collect();
        Body {
            statements,
            outputs,
        }
    }

    fn is_leaf(&self, net: Net) -> bool {
        matches!(
            self.circuit.operation(net),
            Operation::Number(_) | Operation::Symbol(_)
        )
    }

    /// Binds the sine and the cosine of an angle to names.
    fn state_pair(&mut self, pair: [Net; 2], statements: &mut Vec<Statement>) {
        let angle = self
            .circuit
            .operands(pair[0])
            .first()
            .map(|angle| self.receiver(*angle));
        let names = pair.map(|net| self.namer.bind(self.graph, self.circuit, net));
        statements.push(Statement {
            names: names.to_vec(),
            expression: quote!(#angle.sin_cos()),
        });
    }

    /// Which operations get a name however short they are: those used twice, and those that the author named.
    fn frequent(&self) -> BTreeSet<Net> {
        let mut uses = self.circuit.uses();
        for net in self.circuit.nets() {
            match self.circuit.operation(net) {
                Operation::Product(factors) => {
                    for (operand, power) in factors.iter().filter(|(_, power)| *power > 1) {
                        uses[operand.index()] += *power as usize - 1;
                    }
                }
                // A choice is a statement of its own.
                Operation::Apply(function, _) if function.is_selection() => {
                    uses[net.index()] += 1;
                }
                // So is this one, which names its operands more than once.
                Operation::Apply(Function::OverSquares, operands) => {
                    uses[net.index()] += 1;
                    operands
                        .iter()
                        .for_each(|operand| uses[operand.index()] += 1);
                }
                _ => {}
            }
        }
        self.circuit
            .nets()
            .filter(|net| uses[net.index()] > 1 || self.circuit.suggested_name(*net).is_some())
            .collect()
    }

    /// How wide an operation's expression may be, so that its statement stays on a line.
    fn room(&self, net: Net) -> usize {
        let name = self
            .circuit
            .suggested_name(net)
            .map_or(0, str::len)
            .max(LONGEST);
        WIDEST.saturating_sub(name).max(LONGEST)
    }

    /// Names the widest operands of an operation until its expression is short. Whether it is, at the end.
    fn shorten(&mut self, net: Net, statements: &mut Vec<Statement>) -> bool {
        let room = self.room(net);
        if self.circuit.operands(net).len() > room {
            self.name_all_operands(net, statements);
            return false;
        }
        loop {
            if width(self.operation(net).tokens) <= room {
                return true;
            }
            let unnamed = self
                .circuit
                .operands(net)
                .into_iter()
                .filter(|operand| self.can_be_named(*operand));
            let widest = unnamed
                .max_by_key(|operand| (width(self.operation(*operand).tokens), Reverse(*operand)));
            let Some(widest) = widest else { return false };
            self.state(widest, statements);
        }
    }

    /// Names the operands of an operation that has too many of them for a line, the widest first. No name changes the width
    /// of another operand: what has no name yet is used here alone.
    fn name_all_operands(&mut self, net: Net, statements: &mut Vec<Statement>) {
        let operands = self.circuit.operands(net).into_iter();
        let unnamed = operands.filter(|operand| self.can_be_named(*operand));
        let mut widths: Vec<_> = unnamed
            .map(|operand| (width(self.operation(operand).tokens), Reverse(operand)))
            .collect();
        widths.sort_unstable();
        for (_, Reverse(operand)) in widths.into_iter().rev() {
            self.state(operand, statements);
        }
    }

    fn can_be_named(&self, net: Net) -> bool {
        !self.is_leaf(net) && self.namer.name(net).is_none()
    }

    /// Binds an operation to a name. A long sum or product is gathered from the left, in as many statements as it takes.
    fn state(&mut self, net: Net, statements: &mut Vec<Statement>) {
        let room = self.room(net);
        let (mut gathered, mut links) = (TokenStream::new(), 0);
        for link in self.chain(net) {
            // One operand alone is not worth a name.
            if links > 1 && width(gathered.clone()) + width(link.clone()) > room {
                let part = self.namer.numbered("part");
                let part = format_ident!("{part}");
                let whole = std::mem::replace(&mut gathered, quote!(#part));
                statements.push(Statement::new(part, whole));
                links = 1;
            }
            gathered.extend(link);
            links += 1;
        }
        let name = self.namer.bind(self.graph, self.circuit, net);
        statements.push(Statement::new(name, gathered));
    }

    /// An operation as what may stand on lines of its own, one after the other: the terms of a sum with their signs, the
    /// factors of a product.
    fn chain(&self, net: Net) -> Vec<TokenStream> {
        match self.circuit.operation(net) {
            Operation::Sum(terms) => self.terms(terms),
            Operation::Product(factors) => self.factors(factors),
            _ => vec![self.operation(net).tokens],
        }
    }

    /// An operand: its name, or its expression where it has none.
    fn operand(&self, net: Net) -> Piece {
        match self.namer.name(net) {
            Some(name) => Piece::atom(quote!(#name)),
            None => self.operation(net),
        }
    }

    /// An operand where its type matters: of a function, or a result.
    fn value(&self, net: Net) -> Piece {
        match (self.numbers, self.circuit.as_number(net)) {
            (Numbers::Packs, Some(value)) => {
                let value = literal::number(value);
                Piece::atom(quote!(::lanes::Pack::splat(simd, #value)))
            }
            _ => self.operand(net),
        }
    }

    fn operation(&self, net: Net) -> Piece {
        match self.circuit.operation(net) {
            Operation::Number(value) => {
                let precedence = if value.is_negative() {
                    Precedence::Negative
                } else {
                    Precedence::Atom
                };
                Piece {
                    tokens: literal::number(value),
                    precedence,
                }
            }
            Operation::Symbol(symbol) => Piece::atom((self.symbol)(*symbol)),
            Operation::Sum(terms) => self.sum(terms),
            Operation::Product(factors) => self.product(factors),
            Operation::Quotient(numerator, denominator) => {
                // Of two numbers one must be a pack; a number alone may be divided by one.
                let numerator = match self.circuit.as_number(*denominator) {
                    Some(_) => self.value(*numerator),
                    None => self.operand(*numerator),
                };
                let numerator = numerator.at_least(Precedence::Product);
                let denominator = self.operand(*denominator).at_least(Precedence::Negative);
                Piece {
                    tokens: quote!(#numerator / #denominator),
                    precedence: Precedence::Product,
                }
            }
            Operation::Apply(function, operands) => self.apply(net, *function, operands),
            Operation::Tabulated {
                table,
                order,
                argument,
            } => {
                let name = table_function(self.graph, *table, *order);
                let function = match self.numbers {
                    Numbers::Single => format_ident!("{name}"),
                    Numbers::Packs => format_ident!("{}", pack_table_function(&name)),
                };
                let argument = self.value(*argument).tokens;
                Piece::atom(quote!(#function(#argument)))
            }
        }
    }

    /// The terms of a sum with their signs; a positive one comes first where there is one.
    fn terms(&self, terms: &[(Net, Rational)]) -> Vec<TokenStream> {
        let first = terms
            .iter()
            .position(|(_, coefficient)| coefficient.is_positive())
            .unwrap_or(0);
        let rest = terms
            .iter()
            .enumerate()
            .filter(|(position, _)| *position != first)
            .map(|(_, term)| term);
        let ordered = terms.get(first).into_iter().chain(rest).enumerate();
        ordered
            .map(|(position, (operand, coefficient))| {
                let term = self
                    .term(*operand, &coefficient.abs())
                    .at_least(Precedence::Product);
                match (position, coefficient.is_negative()) {
                    (0, false) => term,
                    (0, true) => quote!(-#term),
                    (_, false) => quote!(+ #term),
                    (_, true) => quote!(- #term),
                }
            })
            .collect()
    }

    fn sum(&self, terms: &[(Net, Rational)]) -> Piece {
        let tokens = self.terms(terms).into_iter().collect();
        let precedence = match terms {
            // Only a name or literal with its sign in front holds together as a divisor.
            [(operand, coefficient)] if coefficient.is_negative() => {
                let alone = self.term(*operand, &coefficient.abs()).precedence == Precedence::Atom;
                if alone {
                    Precedence::Negative
                } else {
                    Precedence::Product
                }
            }
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
        // A product or quotient stays together, as it was looked at: 2·(x/y) may be a number where (2·x)/y is none.
        let (size, operand) = (literal::number(size), piece.at_least(Precedence::Negative));
        Piece {
            tokens: quote!(#size * #operand),
            precedence: Precedence::Product,
        }
    }

    /// The factors of a product, all but the first with the operator in front.
    fn factors(&self, factors: &[(Net, u32)]) -> Vec<TokenStream> {
        let repeated = factors
            .iter()
            .flat_map(|(operand, power)| std::iter::repeat_n(*operand, *power as usize));
        repeated
            .enumerate()
            .map(|(position, operand)| {
                // A product or quotient within stays together, as it was counted.
                let operand = self.operand(operand).at_least(Precedence::Negative);
                if position == 0 {
                    operand
                } else {
                    quote!(* #operand)
                }
            })
            .collect()
    }

    fn product(&self, factors: &[(Net, u32)]) -> Piece {
        Piece {
            tokens: self.factors(factors).into_iter().collect(),
            precedence: Precedence::Product,
        }
    }

    fn apply(&self, net: Net, function: Function, operands: &[Net]) -> Piece {
        if let (true, [a, b, x, y]) = (function.is_selection(), operands) {
            return self.selection(function, [*a, *b, *x, *y]);
        }
        if let (Function::Side, Numbers::Single, [operand]) = (function, self.numbers, operands) {
            // With a zero added, a negative zero is a positive one.
            let operand = self.operand(*operand).at_least(Precedence::Sum);
            return Piece::atom(quote!(1.0_f64.copysign(#operand + 0.0)));
        }
        if let (Function::SignBit, Numbers::Single, [operand]) = (function, self.numbers, operands)
        {
            let operand = self.operand(*operand).tokens;
            return Piece::atom(quote!(1.0_f64.copysign(#operand)));
        }
        if let (Function::OverSquares, Numbers::Single, [x, y]) = (function, self.numbers, operands)
        {
            return self.over_squares([*x, *y]);
        }
        let name = if self.by_multiplication.contains(&net) {
            "sqrt_by_multiplication"
        } else {
            function.row().method
        };
        let name = format_ident!("{name}");
        if self.with_sines_of_packs && matches!(function, Function::Sin | Function::Cos) {
            let operands = operands.iter().map(|operand| self.value(*operand).tokens);
            return Piece::atom(quote!(::lanes::#name(#(#operands),*)));
        }
        if let (Some(of), Numbers::Single) = (function.row().of_crate, self.numbers) {
            let of = format_ident!("{of}");
            let operands = operands.iter().map(|operand| self.value(*operand).tokens);
            return Piece::atom(quote!(::#of::#name(#(#operands),*)));
        }
        let mut operands = operands.iter();
        let receiver = operands.next().map(|operand| self.receiver(*operand));
        let rest = operands.map(|operand| self.value(*operand).tokens);
        Piece::atom(quote!(#receiver.#name(#(#rest),*)))
    }

    /// x/(x² + y²) without the squares, as packs have it.
    fn over_squares(&self, operands: [Net; 2]) -> Piece {
        let [x, y] = operands.map(|operand| self.operand(operand).at_least(Precedence::Atom));
        let sizes = operands.map(|operand| self.receiver(operand));
        let [size, other] = sizes.map(|number| quote!(#number.abs()));
        Piece {
            tokens: quote! {
                if #size < #other {
                    #x / #y / (#y + #x * (#x / #y))
                } else {
                    1.0 / (#x + #y * (#y / #x))
                }
            },
            precedence: Precedence::Choice,
        }
    }

    /// One of two as a comparison says.
    fn selection(&self, function: Function, operands: [Net; 4]) -> Piece {
        if self.numbers == Numbers::Packs {
            let a = self.value(operands[0]).at_least(Precedence::Atom);
            let [_, b, x, y] = operands.map(|operand| self.value(operand).tokens);
            let method = format_ident!("{}", function.row().method);
            return Piece::atom(quote!(#a.#method(#b, #x, #y)));
        }
        let [a, b, x, y] = operands.map(|operand| self.operand(operand).tokens);
        let comparison = match function {
            Function::Less => quote!(<),
            Function::AtMost => quote!(<=),
            _ => quote!(==),
        };
        Piece {
            tokens: quote!(if #a #comparison #b { #x } else { #y }),
            precedence: Precedence::Choice,
        }
    }

    /// The operand of a method; the type of a bare literal must be said.
    fn receiver(&self, net: Net) -> TokenStream {
        match (self.numbers, self.circuit.as_number(net)) {
            (Numbers::Single, Some(value)) => {
                let value = literal::number(value);
                quote!(f64::from(#value))
            }
            _ => self.value(net).at_least(Precedence::Atom),
        }
    }
}

/// Finds the angles of which both the sine and the cosine are wanted; the pair is under each of both.
fn sines_with_cosines(circuit: &Circuit) -> BTreeMap<Net, [Net; 2]> {
    let uses = circuit.live_uses();
    let mut of_angle: BTreeMap<&[Net], [Option<Net>; 2]> = BTreeMap::new();
    for net in circuit.nets().filter(|net| uses[net.index()] > 0) {
        let (place, angle) = match circuit.operation(net) {
            Operation::Apply(Function::Sin, angle) => (0, angle),
            Operation::Apply(Function::Cos, angle) => (1, angle),
            _ => continue,
        };
        of_angle.entry(angle).or_default()[place] = Some(net);
    }
    let pairs = of_angle
        .into_values()
        .filter_map(|[sine, cosine]| Some([sine?, cosine?]));
    pairs.flat_map(|pair| pair.map(|net| (net, pair))).collect()
}

/// How wide tokens are when they are formatted, within a letter or two.
fn width(tokens: TokenStream) -> usize {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                4 + width(group.stream())
            }
            TokenTree::Group(group) => 2 + width(group.stream()),
            TokenTree::Punct(mark) if mark.as_char() == '.' => 1,
            TokenTree::Punct(mark) if mark.as_char() == ',' => 2,
            TokenTree::Punct(_) => 3,
            word => word.to_string().chars().count(),
        })
        .sum()
}
