//! Which square roots of a body over packs are computed by multiplications, so that divider and multipliers share the work.

use std::collections::BTreeSet;

use crate::circuit::{Circuit, Net, Operation};
use crate::cost::Cost;
use crate::graph::Function;

/// Cycles for which roots of a pack of 8 occupy the divider, on Zen 4; on Intel's machines they are as many or more.
const ROOT: usize = 17;
/// Cycles for which quotients of a pack of 8 occupy the divider, on Zen 4.
const QUOTIENT: usize = 10;
/// Cycles for which roots by multiplications occupy the multipliers, which take a multiplication of packs each cycle.
const ROOT_BY_MULTIPLICATION: usize = 12;
/// Cycles for which another function of a pack, such as a sine, occupies the multipliers.
const CALL: usize = 20;

/// The roots to compute by multiplications: as many as bring the longer of both, the time of the divider and that of the
/// multipliers, to its least, the last of all and others evenly between.
pub(super) fn by_multiplication(circuit: &Circuit) -> BTreeSet<Net> {
    let uses = circuit.live_uses();
    let is_root = |net: &Net| {
        let is_root = matches!(circuit.operation(*net), Operation::Apply(Function::Sqrt, _));
        is_root && uses[net.index()] > 0
    };
    let roots: Vec<Net> = circuit.nets().filter(is_root).collect();
    let moved = balanced(&circuit.cost());
    let chosen = roots
        .iter()
        .enumerate()
        .filter(|(place, _)| (place + 1) * moved / roots.len() > place * moved / roots.len());
    chosen.map(|(_, net)| *net).collect()
}

/// How many roots of a body of this cost are better computed by multiplications. `None` if that saves less than a quarter:
/// such a root is longer in coming, and of a long body too few packs are under way to hide it.
fn balanced(cost: &Cost) -> usize {
    let time = |moved: usize| {
        let divider = ROOT * (cost.sqrt - moved) + QUOTIENT * cost.div;
        let multipliers = cost.mul + CALL * cost.call + ROOT_BY_MULTIPLICATION * moved;
        divider.max(multipliers)
    };
    // Of equal times the first, with the fewest roots moved.
    let best = (0..=cost.sqrt).min_by_key(|moved| time(*moved));
    best.filter(|moved| 4 * time(*moved) <= 3 * time(0))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(sqrt: usize, div: usize, mul: usize) -> usize {
        balanced(&Cost {
            sqrt,
            div,
            mul,
            ..Cost::default()
        })
    }

    #[test]
    fn divider_and_multipliers_share_the_roots() {
        assert_eq!(moved(0, 3, 0), 0);
        assert_eq!(moved(1, 0, 0), 1);
        assert_eq!(moved(2, 0, 8), 1);
        assert_eq!(moved(4, 0, 8), 2);
        assert_eq!(moved(2, 4, 8), 2);
    }

    #[test]
    fn little_is_not_worth_it() {
        assert_eq!(moved(6, 4, 80), 0);
    }

    #[test]
    fn busy_multipliers_get_no_roots() {
        assert_eq!(moved(2, 0, 40), 0);
        assert_eq!(moved(1, 1, 30), 0);
    }
}
