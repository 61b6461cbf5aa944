//! Expressions that are equal though they are written differently become one.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use crate::fingerprint::{Fingerprint, Residue, is_zero, node_at, without_sign};
use crate::graph::{ExprId, Graph, Node, Rational, whole};
use crate::outputs::Held;
use crate::rewrite::Form;

/// Sums of more terms than this are not searched for equal parts: the search tries all subsets.
const MOST_TERMS: usize = 10;

/// Rebuilds the roots so that expressions with equal fingerprints, up to sign, are the same node, and sums whose parts
/// repeat each other are shortened; `None` where there is none of either.
pub fn merge(graph: &Graph, roots: &[ExprId]) -> Option<Form> {
    let mut target = Graph::with_symbols_of(graph);
    let mut merger = Merger::default();
    let mut is_changed = false;
    let roots = graph.rebuild(&mut target, roots, |target, _, image| {
        let representative = merger.representative(target, image);
        is_changed |= representative != image;
        representative
    });
    is_changed.then_some((target, roots))
}

/// Merges equal expressions of a form with held products, each of which has the value of its definition.
pub fn merge_held(held: &Held) -> Held {
    let source = &held.graph;
    let mut graph = Graph::with_symbols_of(source);
    let (symbols, products): (Vec<_>, Vec<_>) = held.definitions.iter().copied().unzip();
    let products = source.rebuild(&mut graph, &products, |_, _, image| image);
    let mut merger = Merger::default();
    for (symbol, product) in symbols.iter().zip(&products) {
        let value = merger.fingerprint(&graph, *product);
        let symbol = graph.symbol_expression(*symbol);
        merger.enter(symbol, value);
        let (unsigned, negated) = without_sign(value);
        merger.known.entry(unsigned).or_insert((symbol, negated));
    }
    let all = source.rebuild(&mut graph, &held.outputs.all(), |target, _, image| {
        merger.representative(target, image)
    });
    Held {
        graph,
        outputs: held.outputs.with_all(&all),
        definitions: symbols.into_iter().zip(products).collect(),
    }
}

#[derive(Default)]
struct Merger {
    /// By position in the target.
    fingerprints: Vec<Option<Fingerprint>>,
    known: FxHashMap<Fingerprint, (ExprId, bool)>,
}

impl Merger {
    fn fingerprint(&mut self, graph: &Graph, id: ExprId) -> Fingerprint {
        if let Some(Some(known)) = self.fingerprints.get(id.index()) {
            return *known;
        }
        for operand in graph.operands(id) {
            self.fingerprint(graph, operand);
        }
        let known = &self.fingerprints;
        let value = |point: usize| {
            node_at(graph, id, point as u64, |operand| {
                known
                    .get(operand.index())
                    .copied()
                    .flatten()
                    .map_or(Residue::ZERO, |fingerprint| fingerprint[point])
            })
        };
        let fingerprint = [value(0), value(1)];
        self.enter(id, fingerprint);
        fingerprint
    }

    fn enter(&mut self, id: ExprId, fingerprint: Fingerprint) {
        if self.fingerprints.len() <= id.index() {
            self.fingerprints.resize(id.index() + 1, None);
        }
        self.fingerprints[id.index()] = Some(fingerprint);
    }

    fn representative(&mut self, graph: &mut Graph, id: ExprId) -> ExprId {
        let fingerprint = self.fingerprint(graph, id);
        if is_zero(fingerprint) {
            return graph.integer(0);
        }
        let (unsigned, negated) = without_sign(fingerprint);
        if let Some(&(known, known_negated)) = self.known.get(&unsigned) {
            return if negated == known_negated {
                known
            } else {
                graph.negate(known)
            };
        }
        let short = self.shorten(graph, id);
        // A rational multiple is no node of its own: what it is a multiple of has been entered already.
        let multiple = matches!(graph.node(short), Node::Sum(terms) if terms.len() == 1);
        if !multiple {
            self.known.insert(unsigned, (short, negated));
        }
        short
    }

    /// A sum of which one part equals another, or its negative: that part is counted twice, or both are dropped.
    fn shorten(&mut self, graph: &mut Graph, id: ExprId) -> ExprId {
        let Node::Sum(terms) = graph.node(id).clone() else {
            return id;
        };
        if !(3..=MOST_TERMS).contains(&terms.len()) {
            return id;
        }
        let values: Vec<Fingerprint> = terms
            .iter()
            .map(|(operand, coefficient)| {
                let scale = Residue::rational(coefficient);
                self.fingerprint(graph, *operand)
                    .map(|residue| residue.times(scale))
            })
            .collect();
        let Some((kept, dropped, same_sign)) = equal_parts(&values) else {
            return id;
        };
        let mut shortened: Vec<(ExprId, Rational)> = Vec::new();
        for (position, (operand, coefficient)) in terms.into_iter().enumerate() {
            let bit = 1_usize << position;
            if dropped & bit != 0 || (kept & bit != 0 && !same_sign) {
                continue;
            }
            let factor = if kept & bit != 0 { whole(2) } else { whole(1) };
            shortened.push((operand, coefficient * factor));
        }
        let shortened = graph.sum(shortened);
        self.shorten(graph, shortened)
    }
}

/// Two disjoint sets of positions whose values add up to the same, up to sign: the one to keep (the smaller), the one
/// to drop (as large as can be), and whether their signs agree.
fn equal_parts(values: &[Fingerprint]) -> Option<(usize, usize, bool)> {
    let subsets = 1_usize << values.len();
    let mut sums: Vec<Fingerprint> = vec![[Residue::ZERO; 2]; subsets];
    let mut unsigned: Vec<(Fingerprint, usize, bool)> = Vec::with_capacity(subsets);
    for set in 1..subsets {
        let last = set.trailing_zeros() as usize;
        let rest = sums[set & (set - 1)];
        sums[set] = [rest[0].plus(values[last][0]), rest[1].plus(values[last][1])];
        let (sum, negated) = without_sign(sums[set]);
        unsigned.push((sum, set, negated));
    }
    unsigned.sort_unstable();
    let equals = unsigned.chunk_by(|left, right| left.0 == right.0);
    let pairs = equals.flat_map(|equals| {
        equals.iter().enumerate().flat_map(|(place, later)| {
            let earlier = equals[..place].iter();
            earlier.map(move |earlier| (earlier, later))
        })
    });
    let disjoint = pairs.filter(|((_, other, _), (_, set, _))| other & set == 0);
    let candidates = disjoint.map(|((_, other, other_negated), (_, set, negated))| {
        let (kept, dropped) = if other.count_ones() <= set.count_ones() {
            (*other, *set)
        } else {
            (*set, *other)
        };
        let same_sign = negated == other_negated;
        let of_kept = if same_sign { 0 } else { kept.count_ones() };
        // Of those that save as much it is the first: the one whose later set is the least, and of these the earlier.
        let saved = (dropped.count_ones() + of_kept, Reverse((*set, *other)));
        (saved, (kept, dropped, same_sign))
    });
    let best = candidates.max_by_key(|(saved, _)| *saved)?.1;
    (best.0.count_ones() + best.1.count_ones() > 2).then_some(best)
}
