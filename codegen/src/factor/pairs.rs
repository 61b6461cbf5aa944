//! Pairs of factors, or of terms, that several products or sums have: each is computed once, the most frequent first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::Hash;

use rustc_hash::FxHashMap;

use super::circuit::{Circuit, Net, Operation};
use crate::graph::Rational;

/// Products or sums by their handles, each with its members by ascending handle: factors with powers, or terms with
/// coefficients.
type Members<V> = FxHashMap<Net, Vec<(Net, V)>>;

/// Which pairs the members have.
struct Pairs<K> {
    known: FxHashMap<K, Occurrences>,
    /// Each pair with every count that it had since it was last looked at, the most frequent first and of those the least.
    queue: BinaryHeap<(usize, Reverse<K>)>,
}

/// Where a pair is.
#[derive(Default)]
struct Occurrences {
    count: usize,
    /// The products or sums that had it at some time; one may stand here twice.
    places: Vec<Net>,
}

impl<K: Ord + Clone + Hash> Pairs<K> {
    fn new() -> Self {
        Self {
            known: FxHashMap::default(),
            queue: BinaryHeap::new(),
        }
    }

    fn add(&mut self, place: Net, pairs: Vec<(K, usize)>) {
        for (pair, count) in pairs {
            let known = self.known.entry(pair.clone()).or_default();
            known.count += count;
            known.places.push(place);
            if known.count >= 2 {
                self.queue.push((known.count, Reverse(pair)));
            }
        }
    }

    fn remove(&mut self, pairs: Vec<(K, usize)>) {
        for (pair, count) in pairs {
            if let Some(known) = self.known.get_mut(&pair) {
                known.count = known.count.saturating_sub(count);
                if known.count == 0 {
                    self.known.remove(&pair);
                }
            }
        }
    }

    /// The most frequent pair that occurs at least twice, and where it may be.
    fn most_frequent(&mut self) -> Option<(K, Vec<Net>)> {
        while let Some((count, Reverse(pair))) = self.queue.pop() {
            let Some(known) = self.known.get(&pair) else {
                continue;
            };
            if known.count == count {
                let mut places = known.places.clone();
                places.sort_unstable();
                places.dedup();
                return Some((pair, places));
            }
            if (2..count).contains(&known.count) {
                self.queue.push((known.count, Reverse(pair)));
            }
        }
        None
    }
}

/// The positions i < j of every two members of which one at least is among the changed ones.
fn positions<V>(members: &[(Net, V)], is_changed: impl Fn(Net) -> bool) -> Vec<(usize, usize)> {
    let changed: Vec<bool> = members.iter().map(|(net, _)| is_changed(*net)).collect();
    let mut positions = Vec::new();
    for (i, _) in changed.iter().enumerate().filter(|(_, changed)| **changed) {
        for (j, other_changed) in changed.iter().enumerate() {
            if j > i || j < i && !other_changed {
                positions.push((i.min(j), i.max(j)));
            }
        }
    }
    positions
}

/// Two factors, and how often their product is in a product.
fn factor_pairs(
    factors: &[(Net, u32)],
    is_changed: impl Fn(Net) -> bool,
) -> Vec<((Net, Net), usize)> {
    let squares = factors
        .iter()
        .filter(|(net, power)| *power >= 2 && is_changed(*net))
        .map(|(net, power)| ((*net, *net), (power / 2) as usize));
    let pairs = positions(factors, &is_changed).into_iter().map(|(i, j)| {
        let ((a, power_a), (b, power_b)) = (factors[i], factors[j]);
        ((a, b), power_a.min(power_b) as usize)
    });
    squares.chain(pairs).collect()
}

/// A product of two factors that several products have is computed once.
pub(super) fn share_products(circuit: &mut Circuit) {
    let mut members: Members<u32> = FxHashMap::default();
    let mut pairs = Pairs::new();
    for net in circuit.nets() {
        if let Operation::Product(factors) = circuit.operation(net) {
            pairs.add(net, factor_pairs(factors, |_| true));
            members.insert(net, factors.clone());
        }
    }
    while let Some(((a, b), places)) = pairs.most_frequent() {
        let shared = circuit.product([(a, 1), (b, 1)]);
        let is_changed = |net| [a, b, shared].contains(&net);
        for place in places {
            let Some(factors) = members.get_mut(&place) else {
                continue;
            };
            if place == shared {
                // The shared product itself is not taken apart any further.
                pairs.remove(factor_pairs(factors, |_| true));
                members.remove(&place);
                continue;
            }
            let before = factor_pairs(factors, is_changed);
            if take_pair(factors, a, b, shared) {
                pairs.remove(before);
                pairs.add(place, factor_pairs(factors, is_changed));
                circuit.replace(place, Operation::Product(factors.clone()));
            }
        }
    }
}

/// Replaces a·b by one factor, as often as it occurs; false where it does not.
fn take_pair(factors: &mut Vec<(Net, u32)>, a: Net, b: Net, shared: Net) -> bool {
    let power_of = |net: Net| {
        let factor = factors.iter().find(|(factor, _)| *factor == net);
        factor.map_or(0, |(_, power)| *power)
    };
    let times = if a == b {
        power_of(a) / 2
    } else {
        power_of(a).min(power_of(b))
    };
    if times == 0 {
        return false;
    }
    for (factor, power) in factors.iter_mut() {
        // Twice where a is b.
        *power -= times * (u32::from(*factor == a) + u32::from(*factor == b));
    }
    factors.retain(|(_, power)| *power > 0);
    match factors.binary_search_by_key(&shared, |(factor, _)| *factor) {
        Ok(position) => factors[position].1 += times,
        Err(position) => factors.insert(position, (shared, times)),
    }
    true
}

/// A pair of terms by their handles and the ratio of their coefficients.
type TermPair = (Net, Net, Rational);

fn term_pairs(
    terms: &[(Net, Rational)],
    is_changed: impl Fn(Net) -> bool,
) -> Vec<(TermPair, usize)> {
    let pairs = positions(terms, is_changed).into_iter().map(|(i, j)| {
        let ((a, first), (b, second)) = (&terms[i], &terms[j]);
        ((*a, *b, second / first), 1)
    });
    pairs.collect()
}

/// A sum of two terms that several sums have, up to a common factor, is computed once.
pub(super) fn share_sums(circuit: &mut Circuit) {
    let mut members: Members<Rational> = FxHashMap::default();
    let mut pairs = Pairs::new();
    for net in circuit.nets() {
        if let Operation::Sum(terms) = circuit.operation(net) {
            pairs.add(net, term_pairs(terms, |_| true));
            members.insert(net, terms.clone());
        }
    }
    while let Some(((a, b, ratio), places)) = pairs.most_frequent() {
        let shared = circuit.sum([(a, Rational::ONE), (b, ratio.clone())]);
        let is_changed = |net| [a, b, shared].contains(&net);
        for place in places {
            let Some(terms) = members.get_mut(&place) else {
                continue;
            };
            if place == shared {
                pairs.remove(term_pairs(terms, |_| true));
                members.remove(&place);
                continue;
            }
            let before = term_pairs(terms, is_changed);
            if take_sum(terms, a, (b, &ratio), shared) {
                pairs.remove(before);
                pairs.add(place, term_pairs(terms, is_changed));
                circuit.replace(place, Operation::Sum(terms.clone()));
            }
        }
    }
}

/// Replaces two terms by one, q·a + q·ratio·b by q·shared; false where the sum does not have them.
fn take_sum(
    terms: &mut Vec<(Net, Rational)>,
    a: Net,
    (b, ratio): (Net, &Rational),
    shared: Net,
) -> bool {
    let coefficient_of = |net: Net| {
        let term = terms.iter().find(|(term, _)| *term == net);
        term.map(|(_, coefficient)| coefficient.clone())
    };
    let (Some(first), Some(second)) = (coefficient_of(a), coefficient_of(b)) else {
        return false;
    };
    if second != &first * ratio {
        return false;
    }
    // The shared sum may be a term of this one already.
    let coefficient = coefficient_of(shared).unwrap_or(Rational::ZERO) + first;
    terms.retain(|(term, _)| ![a, b, shared].contains(term));
    if !coefficient.is_zero() {
        let position = terms.partition_point(|(term, _)| *term < shared);
        terms.insert(position, (shared, coefficient));
    }
    true
}
