//! Pairs of factors, or of terms, that several products or sums have: each is computed once, the most frequent first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::Hash;
use std::ops::Deref;

use rustc_hash::FxHashMap;

use super::circuit::{Circuit, Factors, Net, Operation, Terms};
use crate::graph::{Rational, rational};

/// What stands at a member of an operation: the power of a factor, or the coefficient of a term.
pub(super) trait Share: Clone {
    /// The members of an operation of this kind.
    type Members: Clone + Deref<Target = [(Net, Self)]>;
    /// Two members of which several operations may have a multiple.
    type Pair: Clone + Ord + Hash;

    /// The members of an operation of this kind.
    fn members(operation: &Operation) -> Option<&Self::Members>;

    /// The operation of these members.
    fn operation(members: Self::Members) -> Operation;

    /// The pairs with a changed member, and how often each is there.
    fn pairs(members: &[(Net, Self)], is_changed: impl Fn(Net) -> bool)
    -> Vec<(Self::Pair, usize)>;

    /// What a pair is, and its members.
    fn shared(circuit: &mut Circuit, pair: &Self::Pair) -> (Net, [Net; 2]);

    /// Replaces a pair by what it is, as often as it is there; false where it is not.
    fn take(members: &mut Self::Members, pair: &Self::Pair, shared: Net) -> bool;
}

/// Computes the pairs that several operations of a kind have once.
pub(super) fn share<S: Share>(circuit: &mut Circuit) {
    let mut members: FxHashMap<Net, S::Members> = FxHashMap::default();
    let mut pairs = Pairs::new();
    for net in circuit.nets() {
        if let Some(own) = S::members(circuit.operation(net)) {
            pairs.add(net, S::pairs(own, |_| true));
            members.insert(net, own.clone());
        }
    }
    while let Some((pair, places)) = pairs.most_frequent() {
        let (shared, [a, b]) = S::shared(circuit, &pair);
        let is_changed = |net| [a, b, shared].contains(&net);
        for place in places {
            let Some(own) = members.get_mut(&place) else {
                continue;
            };
            if place == shared {
                // The shared operation itself is not taken apart any further.
                pairs.remove(S::pairs(own, |_| true));
                members.remove(&place);
                continue;
            }
            let before = S::pairs(own, is_changed);
            if S::take(own, &pair, shared) {
                pairs.remove(before);
                pairs.add(place, S::pairs(own, is_changed));
                circuit.replace(place, S::operation(own.clone()));
            }
        }
    }
}

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

/// Factors with powers; a pair is a product of two.
impl Share for u32 {
    type Members = Factors;
    type Pair = (Net, Net);

    fn members(operation: &Operation) -> Option<&Self::Members> {
        match operation {
            Operation::Product(factors) => Some(factors),
            _ => None,
        }
    }

    fn operation(members: Self::Members) -> Operation {
        Operation::Product(members)
    }

    fn pairs(
        factors: &[(Net, Self)],
        is_changed: impl Fn(Net) -> bool,
    ) -> Vec<(Self::Pair, usize)> {
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

    fn shared(circuit: &mut Circuit, (a, b): &Self::Pair) -> (Net, [Net; 2]) {
        (circuit.product([(*a, 1), (*b, 1)]), [*a, *b])
    }

    fn take(factors: &mut Self::Members, (a, b): &Self::Pair, shared: Net) -> bool {
        let power_of = |net: &Net| {
            let factor = factors.iter().find(|(factor, _)| factor == net);
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
            *power -= times * (Self::from(factor == a) + Self::from(factor == b));
        }
        factors.push((shared, times));
        rational::collect(factors);
        true
    }
}

/// Terms with coefficients; a pair is a sum of two, given by the ratio of the second's coefficient to the first's.
impl Share for Rational {
    type Members = Terms;
    type Pair = (Net, Net, Self);

    fn members(operation: &Operation) -> Option<&Self::Members> {
        match operation {
            Operation::Sum(terms) => Some(terms),
            _ => None,
        }
    }

    fn operation(members: Self::Members) -> Operation {
        Operation::Sum(members)
    }

    fn pairs(terms: &[(Net, Self)], is_changed: impl Fn(Net) -> bool) -> Vec<(Self::Pair, usize)> {
        let pairs = positions(terms, is_changed).into_iter().map(|(i, j)| {
            let ((a, first), (b, second)) = (&terms[i], &terms[j]);
            ((*a, *b, second / first), 1)
        });
        pairs.collect()
    }

    fn shared(circuit: &mut Circuit, (a, b, ratio): &Self::Pair) -> (Net, [Net; 2]) {
        let terms = [(*a, Self::ONE), (*b, ratio.clone())];
        (circuit.sum(terms), [*a, *b])
    }

    fn take(terms: &mut Self::Members, (a, b, ratio): &Self::Pair, shared: Net) -> bool {
        let coefficient_of = |net: &Net| {
            let term = terms.iter().find(|(term, _)| term == net);
            term.map(|(_, coefficient)| coefficient.clone())
        };
        let (Some(first), Some(second)) = (coefficient_of(a), coefficient_of(b)) else {
            return false;
        };
        if second != &first * ratio {
            return false;
        }
        terms.retain(|(term, _)| *term != *a && *term != *b);
        // The shared sum may be a term of this one already.
        terms.push((shared, first));
        rational::collect(terms);
        true
    }
}

#[cfg(test)]
mod tests {
    use smallvec::smallvec;

    use super::*;
    use crate::graph::{Graph, ratio, whole};

    /// Symbols of a circuit.
    fn symbols<const N: usize>(circuit: &mut Circuit) -> [Net; N] {
        let mut graph = Graph::new();
        std::array::from_fn(|place| {
            let symbol = graph.symbol_named(&format!("x{place}"));
            circuit.push(Operation::Symbol(symbol))
        })
    }

    #[test]
    fn the_most_frequent_product_comes_first_and_a_power_has_it_often() {
        let mut circuit = Circuit::default();
        let [a, b, c] = symbols(&mut circuit);
        // a·b is in the first three times, in the second once; b·c is in the second only.
        let first = circuit.product([(a, 3), (b, 3)]);
        let second = circuit.product([(a, 1), (b, 1), (c, 1)]);
        share::<u32>(&mut circuit);
        let shared = circuit.product([(a, 1), (b, 1)]);
        assert_eq!(
            circuit.operation(second),
            &Operation::Product(smallvec![(c, 1), (shared, 1)])
        );
        let Operation::Product(factors) = circuit.operation(first) else {
            panic!("{:?}", circuit.operation(first));
        };
        // Of (a·b)³, (a·b)² is no pair of several.
        assert_eq!(factors.as_slice(), [(shared, 3)]);
    }

    #[test]
    fn sums_are_shared_up_to_a_factor_and_only_in_their_ratio() {
        let mut circuit = Circuit::default();
        let [a, b, c, d] = symbols(&mut circuit);
        let terms =
            |factor: i64, last: Net| [(a, whole(factor)), (b, whole(2 * factor)), (last, whole(1))];
        let first = circuit.sum(terms(1, c));
        let second = circuit.sum(terms(-3, d));
        let other = circuit.sum([(a, whole(1)), (b, ratio(1, 2)), (c, whole(1))]);
        let before = circuit.operation(other).clone();
        share::<Rational>(&mut circuit);
        let shared = circuit.sum([(a, whole(1)), (b, whole(2))]);
        assert_eq!(
            circuit.operation(first),
            &Operation::Sum(smallvec![(c, whole(1)), (shared, whole(1))])
        );
        assert_eq!(
            circuit.operation(second),
            &Operation::Sum(smallvec![(d, whole(1)), (shared, whole(-3))])
        );
        assert_eq!(circuit.operation(other), &before);
    }
}
