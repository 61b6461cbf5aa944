//! The search for the cheapest circuit: which forms are taken apart in which orders of extraction.

use std::collections::BTreeSet;

use super::extract::{ORDERS, Step};
use super::orders::Orders;
use super::passes::Passes;
use crate::circuit::Circuit;

/// Works out forms in the orders of extraction: the most promising forms in all orders first, the others only where those
/// lose digits.
///
/// Which form is best shows in one or two orders; trying them all on every form takes three to six times as long and has
/// found nothing cheaper in any formula that was looked at.
pub(super) struct Search {
    /// The forms with what the first orders made of them, by their places, the dearest first.
    forms: Vec<(usize, Vec<usize>)>,
    /// The orders that are left to be tried.
    rest: Vec<&'static [Step]>,
    orders: Orders,
    /// The places of the circuits that were given already.
    given: BTreeSet<usize>,
}

/// Forms that are worked out together.
const FORMS: usize = 2;

/// The places of the orders that show which form is best.
const FIRST_ORDERS: [usize; 2] = [1, 2];

/// The size beyond which a circuit is large, the order that then shows it, and the others that are tried: for large
/// circuits one of these has been the best.
const LARGE: usize = 240;
const FIRST_OF_LARGE: [usize; 1] = [4];
const REST_OF_LARGE: [usize; 3] = [1, 7, 8];

/// The size beyond which one form and that one order have to do: the others would take three times as long as all the rest.
pub(super) const HUGE: usize = 2_000;

impl Search {
    pub(super) fn new(passes: Passes) -> Self {
        Self {
            forms: Vec::new(),
            rest: Vec::new(),
            orders: Orders::new(passes),
            given: BTreeSet::new(),
        }
    }

    /// Goes on with other forms. A circuit that was given before is not given again.
    pub(super) fn enter(&mut self, forms: Vec<Circuit>) {
        let size = forms.iter().map(|form| form.nets().count()).max();
        let size = size.unwrap_or(0);
        let all = 0..ORDERS.len();
        let (first, rest): (&[usize], Vec<usize>) = if size > HUGE {
            (&FIRST_OF_LARGE, Vec::new())
        } else if size > LARGE {
            (&FIRST_OF_LARGE, REST_OF_LARGE.to_vec())
        } else {
            let rest = all.filter(|place| !FIRST_ORDERS.contains(place));
            (&FIRST_ORDERS, rest.collect())
        };
        let of = |places: &[usize]| places.iter().map(|place| ORDERS[*place]).collect();
        let (first, rest): (Vec<_>, Vec<_>) = (of(first), of(&rest));
        let orders = &mut self.orders;
        let forms = forms.into_iter().map(|form| orders.place_of(form));
        let forms: Vec<usize> = forms.collect();
        let tried = orders.extracted(&forms, &first);
        let tried = tried.chunks(first.len()).map(<[usize]>::to_vec);
        let mut forms: Vec<_> = forms.into_iter().zip(tried).collect();
        let least = |(_, tried): &(usize, Vec<usize>)| {
            let weights = tried
                .iter()
                .map(|place| orders.circuit(*place).cost().weight());
            weights.min()
        };
        // The first of equals comes first.
        forms.reverse();
        forms.sort_by_cached_key(|form| std::cmp::Reverse(least(form)));
        (self.forms, self.rest) = (forms, rest);
    }
}

impl Iterator for Search {
    type Item = Vec<Circuit>;

    fn next(&mut self) -> Option<Vec<Circuit>> {
        let kept = self.forms.len().saturating_sub(FORMS);
        let (forms, mut tried): (Vec<_>, Vec<_>) = self.forms.drain(kept..).rev().unzip();
        if forms.is_empty() {
            return None;
        }
        tried.push(self.orders.extracted(&forms, &self.rest));
        let places = tried.into_iter().flatten();
        let new = places.filter(|place| self.given.insert(*place));
        let circuits = new.map(|place| self.orders.circuit(place).clone());
        Some(circuits.collect())
    }
}
