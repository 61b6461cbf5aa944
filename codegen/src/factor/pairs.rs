//! Pairs of factors, or of terms, that several products or sums have: each is computed once, the most frequent first.
//!
//! Only operands that stand in several places are looked at: no pair with another one is there twice. Where these are so many
//! that all pairs of them are beyond the [`Budget`], each operation is taken in blocks of neighbours, and again until no
//! pair of neighbours is left: what is shared then is found in halves of blocks, blocks and rows of blocks.

mod kinds;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::Hash;
use std::ops::Deref;

use rustc_hash::FxHashMap;

use crate::budget::Budget;
use crate::circuit::{Circuit, Net, Operation};

/// What stands at a member of an operation: the power of a factor, or the coefficient of a term.
pub(super) trait Share: Clone {
    /// The members of an operation of this kind.
    type Members: Clone + Default + Deref<Target = [(Net, Self)]> + Extend<(Net, Self)>;
    /// Two members of which several operations may have a multiple.
    type Pair: Clone + Ord + Hash;

    /// The members of an operation of this kind.
    fn members(operation: &Operation) -> Option<&Self::Members>;

    /// The operation of these members, which may be there several times.
    fn operation(members: Self::Members) -> Operation;

    /// How often a member can be in a pair.
    fn times(&self) -> usize;

    /// The pairs of two members at these positions.
    fn pairs(
        members: &[(Net, Self)],
        positions: &[(usize, usize)],
    ) -> impl Iterator<Item = (Self::Pair, usize)>;

    /// The pairs of a member with itself.
    fn squares(member: &(Net, Self)) -> Option<(Self::Pair, usize)>;

    /// What a pair is, and its members.
    fn shared(circuit: &mut Circuit, pair: &Self::Pair) -> (Net, [Net; 2]);

    /// Replaces a pair by what it is, as often as it is there; false where it is not.
    fn take(members: &mut Self::Members, pair: &Self::Pair, shared: Net) -> bool;
}

/// Computes the pairs that several operations of a kind have once.
pub(super) fn share<S: Share>(circuit: &mut Circuit, budget: &mut Budget) {
    budget.renew(circuit.nets().count());
    while let Some(mut search) = Search::<S>::of(circuit, budget) {
        let is_done = search.block == WHOLE;
        let found = search.run(circuit);
        search.write(circuit);
        if is_done || !found {
            break;
        }
    }
}

/// The block that holds all members of an operation.
const WHOLE: usize = usize::MAX;

/// Larger blocks find no more in what is shared by halves, and cost more in proportion.
const LARGEST_BLOCK: usize = 32;

/// The members of an operation that are looked at together: all of them, or a block.
struct Place<S: Share> {
    net: Net,
    members: S::Members,
    is_changed: bool,
    /// Whether it is a shared operation itself, which is not taken apart any further.
    is_shared: bool,
}

/// A search through the operations of a kind.
struct Search<S: Share> {
    places: Vec<Place<S>>,
    /// By place of the operand: how often it can be in a pair. It is looked at from two times on, for good.
    times: Vec<usize>,
    /// The place of an operand that is in one only.
    lone: FxHashMap<Net, usize>,
    pairs: Pairs<S::Pair>,
    block: usize,
}

impl<S: Share> Search<S> {
    /// `None` if the budget is spent, or nothing is in two places.
    fn of(circuit: &Circuit, budget: &mut Budget) -> Option<Self> {
        let mut times = vec![0; circuit.nets().count()];
        let mut operations = Vec::new();
        for net in circuit.nets() {
            if let Some(members) = S::members(circuit.operation(net)) {
                for (operand, member) in members.iter() {
                    times[operand.index()] += member.times();
                }
                operations.push((net, members));
            }
        }
        let is_candidate = |(operand, _): &&(Net, S)| times[operand.index()] > 1;
        let widths = operations
            .iter()
            .map(|(_, members)| members.iter().filter(is_candidate).count());
        let block = affordable_block(&widths.collect::<Vec<_>>(), budget)?;
        let mut search = Self {
            places: Vec::new(),
            lone: FxHashMap::default(),
            pairs: Pairs::new(),
            block,
            times,
        };
        let ranks = search.ranks();
        for (net, members) in operations {
            search.enter(net, members, &ranks);
        }
        Some(search)
    }

    /// How many operands that are looked at come before each.
    fn ranks(&self) -> Vec<usize> {
        let ranks = self.times.iter().scan(0, |before, times| {
            let rank = *before;
            *before += usize::from(*times > 1);
            Some(rank)
        });
        ranks.collect()
    }

    /// Adds an operation in blocks. The blocks of all operations are cut at the same operands, so that what they share is in
    /// the same one.
    fn enter(&mut self, net: Net, members: &[(Net, S)], ranks: &[usize]) {
        let size = self.block;
        let block_of = |(operand, _): &(Net, S)| ranks[operand.index()] / size;
        for block in members.chunk_by(|left, right| block_of(left) == block_of(right)) {
            let place = self.places.len();
            for (operand, member) in block {
                if self.times[operand.index()] == 1 && member.times() == 1 {
                    self.lone.insert(*operand, place);
                }
            }
            let mut members = S::Members::default();
            members.extend(block.iter().cloned());
            self.places.push(Place {
                net,
                members,
                is_changed: false,
                is_shared: false,
            });
            let pairs = self.pairs_at(place, |_| true);
            self.pairs.add(place, pairs);
        }
    }

    /// The pairs at a place of which one member at least is a changed one, and how often each is there.
    fn pairs_at(&self, place: usize, is_changed: impl Fn(Net) -> bool) -> Vec<(S::Pair, usize)> {
        let Place {
            members, is_shared, ..
        } = &self.places[place];
        if *is_shared {
            return Vec::new();
        }
        let candidates: Vec<(usize, bool)> = members
            .iter()
            .enumerate()
            .filter(|(_, (operand, _))| self.times[operand.index()] > 1)
            .map(|(position, (operand, _))| (position, is_changed(*operand)))
            .collect();
        let mut positions = Vec::new();
        let mut squares = Vec::new();
        for (i, (position, is_changed)) in candidates.iter().enumerate() {
            if *is_changed {
                squares.extend(S::squares(&members[*position]));
                positions.extend(candidates[i + 1..].iter().map(|(j, _)| (*position, *j)));
                let unchanged = candidates[..i].iter().filter(|(_, changed)| !changed);
                positions.extend(unchanged.map(|(j, _)| (*j, *position)));
            }
        }
        S::pairs(members, &positions).chain(squares).collect()
    }

    /// Takes out one pair after the other; whether there was any.
    fn run(&mut self, circuit: &mut Circuit) -> bool {
        let mut found = false;
        while let Some((pair, places)) = self.pairs.most_frequent() {
            let (shared, changed) = S::shared(circuit, &pair);
            self.times.resize(circuit.nets().count(), 0);
            for place in places {
                if self.places[place].net == shared {
                    let pairs = self.pairs_at(place, |_| true);
                    self.pairs.remove(pairs);
                    self.places[place].is_shared = true;
                } else if !self.places[place].is_shared {
                    found |= self.take(place, &pair, shared, changed);
                    self.write_multiple(circuit, place);
                }
            }
        }
        found
    }

    fn take(&mut self, place: usize, pair: &S::Pair, shared: Net, [a, b]: [Net; 2]) -> bool {
        let is_changed = |net| [a, b, shared].contains(&net);
        let before = self.pairs_at(place, is_changed);
        let members = &mut self.places[place].members;
        let times_of = |members: &S::Members| {
            let member = members.iter().find(|(net, _)| *net == shared);
            member.map_or(0, |(_, member)| member.times())
        };
        let times_before = times_of(members);
        if !S::take(members, pair, shared) {
            return false;
        }
        let times_after = times_of(members);
        self.places[place].is_changed = true;
        self.pairs.remove(before);
        let was_candidate = self.times[shared.index()] > 1;
        let times = self.times[shared.index()] - times_before + times_after;
        // Of one that is looked at there may be pairs on the list, so that it stays one.
        self.times[shared.index()] = times.max(if was_candidate { 2 } else { 0 });
        if !was_candidate && times == 1 {
            self.lone.insert(shared, place);
        }
        if !was_candidate
            && times > 1
            && let Some(lone) = self.lone.remove(&shared).filter(|lone| *lone != place)
        {
            let pairs = self.pairs_at(lone, |net| net == shared);
            self.pairs.add(lone, pairs);
        }
        let pairs = self.pairs_at(place, is_changed);
        self.pairs.add(place, pairs);
        true
    }

    /// An operation that has become a multiple of another is one at once: further sums are made of what it is of.
    fn write_multiple(&self, circuit: &mut Circuit, place: usize) {
        let place = &self.places[place];
        if self.block == WHOLE && place.is_changed && place.members.len() == 1 {
            circuit.replace(place.net, S::operation(place.members.clone()));
        }
    }

    /// Puts the changed operations into the circuit.
    fn write(self, circuit: &mut Circuit) {
        for blocks in self.places.chunk_by(|left, right| left.net == right.net) {
            if blocks.iter().any(|block| block.is_changed) {
                let mut members = S::Members::default();
                for block in blocks {
                    members.extend(block.members.iter().cloned());
                }
                circuit.replace(blocks[0].net, S::operation(members));
            }
        }
    }
}

/// The largest block with which the pairs of operations with so many candidates are within the budget; they are taken from
/// it.
fn affordable_block(widths: &[usize], budget: &mut Budget) -> Option<usize> {
    let looks = |block: usize| -> usize {
        let pairs = widths.iter().map(|width| {
            let partners = block.min(*width).saturating_sub(1);
            width.saturating_mul(partners) / 2 + width
        });
        pairs.fold(0, usize::saturating_add)
    };
    let halves = std::iter::successors(Some(LARGEST_BLOCK), |block| Some(block / 2));
    let blocks = std::iter::once(WHOLE).chain(halves.take_while(|block| *block > 1));
    let mut affordable = blocks.filter(|block| looks(*block) > 0);
    affordable.find(|block| budget.take(looks(*block)))
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
    /// The places that had it at some time; one may stand here twice.
    places: Vec<usize>,
}

impl<K: Ord + Clone + Hash> Pairs<K> {
    fn new() -> Self {
        Self {
            known: FxHashMap::default(),
            queue: BinaryHeap::new(),
        }
    }

    fn add(&mut self, place: usize, pairs: Vec<(K, usize)>) {
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
    fn most_frequent(&mut self) -> Option<(K, Vec<usize>)> {
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

#[cfg(test)]
mod tests {
    use smallvec::smallvec;

    use super::*;
    use crate::graph::{Graph, Rational, ratio, whole};

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
        share::<u32>(&mut circuit, &mut Budget::default());
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
        share::<Rational>(&mut circuit, &mut Budget::default());
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
