//! Cuts a long body over packs into parts, each of which goes over a group of packs before the next one begins.
//!
//! Processors look a few hundred instructions ahead. In a long body whose operations wait for each other, that is not even the
//! next pack; in parts of some forty instructions it is several. The cuts are where the fewest numbers are to be kept from a
//! part for a later one. `lanes` has the loops (`lanes::Groups`).

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::quote;

use super::expression::Body;
use super::namer::is_pack_table_function;

/// The weight that a part may have. From 20 to 90, both widths from 8 columns were computed fastest with this one, 1.3 times as
/// fast as in one part on Zen 3; at half and twice of it 1.2 times.
const HEAVIEST: usize = 40;

/// The weight below which a body stays in one part: two packs of it are under way at once.
const LIGHT: usize = 100;

/// Weights of operations: a sum or product weighs 1, others as many as they take cycles of the multipliers or of the divider.
const QUOTIENT: usize = 4;
const ROOT: usize = 5;
/// A function that is a polynomial, or a call for each number.
const CALL: usize = 40;

/// What a loop over the packs of a group costs beside its loads and stores, in loads: the entry and a jump that is mispredicted.
const LOOP: usize = 4;

/// Consecutive statements of a body, with the names that they take from columns or from parts
/// before, and those that later parts take of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub(super) statements: Range<usize>,
    pub(super) takes: Vec<String>,
    pub(super) gives: Vec<String>,
    /// The names among those that it takes that no later part does.
    pub(super) ends: Vec<String>,
    /// Whether it has the results.
    pub(super) is_last: bool,
}

/// Cuts a body into parts; `columns` are the names of what it takes of each row. One part for a body that is short.
pub(super) fn of(body: &Body, columns: &[Ident]) -> Vec<Part> {
    let uses = Uses::of(body, columns);
    let cuts = if uses.weights.iter().sum::<usize>() < LIGHT || columns.is_empty() {
        vec![0, uses.count()]
    } else {
        uses.best_cuts()
    };
    let ranges = cuts.windows(2).map(|ends| ends[0]..ends[1]);
    ranges.map(|range| uses.part(range)).collect()
}

/// The names of a body: where each is defined, and which are used where. The results are a last statement that names nothing.
struct Uses {
    /// For each name of a statement its place; columns have none.
    defined: BTreeMap<String, Option<usize>>,
    /// The names that each statement uses, and those that it defines.
    used: Vec<BTreeSet<String>>,
    names: Vec<Vec<String>>,
    /// For each name the last statement that uses it.
    last: BTreeMap<String, usize>,
    weights: Vec<usize>,
}

impl Uses {
    fn of(body: &Body, columns: &[Ident]) -> Self {
        let mut defined: BTreeMap<String, Option<usize>> = BTreeMap::new();
        defined.extend(columns.iter().map(|column| (column.to_string(), None)));
        let mut names = Vec::new();
        for (place, statement) in body.statements.iter().enumerate() {
            let own: Vec<String> = statement.names.iter().map(ToString::to_string).collect();
            defined.extend(own.iter().map(|name| (name.clone(), Some(place))));
            names.push(own);
        }
        names.push(Vec::new());
        let outputs = &body.outputs;
        let outputs = quote!(#(#outputs),*);
        let expressions = body
            .statements
            .iter()
            .map(|statement| &statement.expression);
        let (mut used, mut weights) = (Vec::new(), Vec::new());
        for expression in expressions.chain([&outputs]) {
            let mut found = Words::default();
            found.read(expression.clone());
            weights.push(found.weight);
            found.words.retain(|word| defined.contains_key(word));
            used.push(found.words);
        }
        let places = used.iter().enumerate();
        let last =
            places.flat_map(|(place, names)| names.iter().map(move |name| (name.clone(), place)));
        Self {
            last: last.collect(),
            defined,
            used,
            names,
            weights,
        }
    }

    fn count(&self) -> usize {
        self.used.len()
    }

    /// The cuts, the start and the end among them, with the fewest loads and stores of all that leave no part too heavy.
    fn best_cuts(&self) -> Vec<usize> {
        // For each end of a part the least cost up to there, and where that part starts.
        let mut best = vec![(0, 0)];
        for end in 1..=self.count() {
            let mut least = (usize::MAX, end - 1);
            let mut part = Growing::default();
            for start in (0..end).rev() {
                part.take(self, start, end);
                if part.weight > HEAVIEST && start + 1 < end {
                    break;
                }
                let cost = best[start].0 + part.loads.len() + part.stores + LOOP;
                if cost < least.0 {
                    least = (cost, start);
                }
            }
            best.push(least);
        }
        let mut cuts = vec![self.count()];
        while let Some(end) = cuts.last().copied().filter(|end| *end > 0) {
            cuts.push(best[end].1);
        }
        cuts.reverse();
        cuts
    }

    fn part(&self, range: Range<usize>) -> Part {
        let statements = range.start..range.end.min(self.count() - 1);
        let is_before = |name: &&String| {
            let place = self.defined.get(*name).copied().flatten();
            place.is_none_or(|place| place < range.start)
        };
        let used: BTreeSet<&String> = self.used[range.clone()].iter().flatten().collect();
        let takes: Vec<String> = used.into_iter().filter(is_before).cloned().collect();
        let is_kept = |name: &&String| self.last.get(*name).is_some_and(|last| *last >= range.end);
        let named = self.names[range.clone()].iter().flatten();
        let ends = takes.iter().filter(|name| !is_kept(name));
        Part {
            ends: ends.cloned().collect(),
            takes,
            gives: named.filter(is_kept).cloned().collect(),
            statements,
            is_last: range.end == self.count(),
        }
    }
}

/// A part that takes one statement more before its first.
#[derive(Default)]
struct Growing<'a> {
    weight: usize,
    loads: BTreeSet<&'a str>,
    stores: usize,
}

impl<'a> Growing<'a> {
    fn take(&mut self, uses: &'a Uses, place: usize, end: usize) {
        self.weight += uses.weights[place];
        for name in &uses.names[place] {
            self.loads.remove(name.as_str());
            self.stores += usize::from(uses.last.get(name).is_some_and(|last| *last >= end));
        }
        self.loads
            .extend(uses.used[place].iter().map(String::as_str));
    }
}

/// The words of an expression, and what its operations weigh.
#[derive(Default)]
struct Words {
    words: BTreeSet<String>,
    weight: usize,
}

impl Words {
    fn read(&mut self, tokens: TokenStream) {
        let mut is_method = false;
        for token in tokens {
            let after_dot = std::mem::take(&mut is_method);
            match token {
                TokenTree::Group(group) => self.read(group.stream()),
                TokenTree::Punct(mark) => match mark.as_char() {
                    '.' => is_method = true,
                    '+' | '-' | '*' => self.weight += 1,
                    '/' => self.weight += QUOTIENT,
                    _ => {}
                },
                TokenTree::Ident(word) if after_dot => self.weight += weight_of(&word.to_string()),
                TokenTree::Ident(word) => {
                    let word = word.to_string();
                    if is_pack_table_function(&word) {
                        self.weight += CALL;
                    }
                    self.words.insert(word);
                }
                TokenTree::Literal(_) => {}
            }
        }
    }
}

/// What a method of packs weighs.
fn weight_of(method: &str) -> usize {
    match method {
        "sqrt" | "sqrt_by_multiplication" => ROOT,
        "abs" | "min" | "max" | "signum" | "side" | "sign_bit" | "mul_add" | "select_eq"
        | "select_lt" | "select_le" | "floor" | "ceil" | "trunc" => 1,
        _ => CALL,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::expression::Statement;
    use quote::format_ident;

    /// A chain of so many products, each of which takes the one before and a column.
    fn chain(length: usize) -> Body {
        let statement = |place: usize| {
            let name = format_ident!("t{place}");
            let before = place
                .checked_sub(1)
                .map_or_else(|| format_ident!("x"), |before| format_ident!("t{before}"));
            Statement::new(name, quote!(#before * y + 1.0))
        };
        let last = format_ident!("t{}", length - 1);
        Body {
            statements: (0..length).map(statement).collect(),
            outputs: vec![quote!(#last + t0)],
        }
    }

    #[test]
    fn a_long_chain_is_cut_into_parts_of_the_heaviest_weight_at_most() {
        let columns = ["x", "y"].map(|name| format_ident!("{name}"));
        let body = chain(100);
        let parts = of(&body, &columns);
        assert!(parts.len() >= 5, "{parts:?}");
        let mut next = 0;
        for part in &parts {
            assert_eq!(part.statements.start, next);
            assert!(2 * part.statements.len() <= HEAVIEST);
            next = part.statements.end;
        }
        assert_eq!(next, 100);
        // What the results take of the first statement is kept, and the last of each part.
        assert!(parts[0].gives.contains(&"t0".to_owned()));
        for pair in parts.windows(2) {
            let last = format!("t{}", pair[0].statements.end - 1);
            assert!(pair[0].gives.contains(&last) && pair[1].takes.contains(&last));
        }
        assert!(parts.last().unwrap().gives.is_empty());
    }

    #[test]
    fn a_short_body_and_one_without_columns_stay_whole() {
        let columns = ["x", "y"].map(|name| format_ident!("{name}"));
        assert_eq!(of(&chain(20), &columns).len(), 1);
        assert_eq!(of(&chain(100), &[]).len(), 1);
    }

    #[test]
    fn operations_weigh_as_much_as_they_take() {
        let mut found = Words::default();
        found.read(quote!(-a / (b + 2.0).sqrt() * c.sin()));
        assert_eq!(found.weight, 1 + QUOTIENT + 1 + ROOT + 1 + CALL);
        let words: Vec<&str> = found.words.iter().map(String::as_str).collect();
        assert_eq!(words, ["a", "b", "c"]);
    }
}
