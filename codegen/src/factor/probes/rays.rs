//! Points at which a form's own operations leave the range of numbers.
//!
//! Numbers that are equal in two forms leave the range at the same points; those of one form alone do so where no list of
//! special numbers has a point: $(2x)^{64}$ as $2^{64}x^{64}$ loses its digits only where x is between 2⁻¹⁷ and 2⁻¹⁶. So the form
//! itself is asked. Inputs are moved away from 1 along rays, one of them or several, also where another is 0 or a difference
//! of two vanishes, and the sizes of all operations are followed in numbers of unlimited range; where one of these passes the end of the range, there is a point.

use std::collections::BTreeSet;

pub use super::size::Size;
use super::{Difference, Random, everyday, within};
use crate::graph::{Graph, Sizes, Symbol, SymbolId};
use crate::interpret::Prepared;

/// How far along a ray sizes are looked at, as powers of two: as far as there are numbers. Between them the sizes are
/// straight lines nearly everywhere, but for exponentials, which leave the range for arguments of some hundreds.
const STEPS: [f64; 19] = [
    -1073.0, -530.0, -260.0, -70.0, -12.0, -9.5, -8.5, -7.5, -5.0, 0.0, 5.0, 7.5, 8.5, 9.5, 12.0,
    70.0, 260.0, 530.0, 1023.0,
];

/// How fast one of two inputs is moved: it is still a number where the other is among the smallest.
const SLOWER: f64 = 0.9;

/// The sizes just beyond the range of numbers, as powers of two: infinity, and numbers of which half of the digits are gone.
const ENDS: [f64; 2] = [1024.5, -1048.0];

/// How many rays move one input, where there are no more inputs than these.
const ALONE: usize = 4;

/// How many rays move several inputs, where there are several: those of all pairs first.
const SEVERAL: usize = 24;

/// How many rays there are at most where an input is 0 or a difference vanishes.
const VANISHING: usize = 24;

/// The most points of a ray.
const POINTS: usize = 12;

/// The points at which operations of a form leave the range: of so large a share of all rays.
pub fn rays(
    graph: &Graph,
    form: &Prepared<Size>,
    used: &[SymbolId],
    differences: &[Difference],
    share: f64,
) -> Vec<Vec<f64>> {
    if graph.sizes != Sizes::All {
        return Vec::new();
    }
    let mut memory = Vec::new();
    let rays = directions(used).chain(vanishing(used, differences));
    let rays = rays.enumerate().map(|(number, direction)| {
        let random = Random::new(6000 + number as u64);
        Ray::new(graph, &direction, random)
    });
    let points = super::spread(rays, share).flat_map(|ray| ray.points(graph, form, &mut memory));
    points.collect()
}

/// The inputs that are moved, with the powers by which they are, and the number that one of them has at the start.
#[derive(Clone, Default)]
struct Direction<'d> {
    moved: Vec<(SymbolId, f64)>,
    zero: Option<SymbolId>,
    vanishes: Option<&'d Difference>,
}

impl Direction<'_> {
    fn of(moved: Vec<(SymbolId, f64)>) -> Self {
        Self {
            moved,
            ..Self::default()
        }
    }
}

/// One input alone, then two of them together or in turn, then any of them.
fn directions<'d>(used: &[SymbolId]) -> impl Iterator<Item = Direction<'d>> {
    let alone = used.iter().map(|symbol| vec![(*symbol, 1.0)]);
    let pairs = used.iter().enumerate().flat_map(|(place, first)| {
        let seconds = used[..place].iter();
        seconds.flat_map(|second| {
            let pair = |[one, other]: [f64; 2]| vec![(*first, one), (*second, other)];
            [[1.0, -SLOWER], [-SLOWER, 1.0], [1.0, SLOWER]].map(pair)
        })
    });
    let any = (0..SEVERAL as u64).map(|number| {
        let mut random = Random::new(7000 + number);
        let power = |random: &mut Random| [1.0, -1.0, 0.5, 0.0][random.below(4) as usize];
        let moved = used.iter().map(|symbol| (*symbol, power(&mut random)));
        moved.collect::<Vec<_>>()
    });
    // A few inputs are each moved from several points.
    let times = (ALONE / used.len().max(1)).max(1);
    let alone = std::iter::repeat_n(alone, times).flatten();
    let several = if used.len() > 1 { SEVERAL } else { 0 };
    alone
        .chain(pairs.chain(any).take(several))
        .map(Direction::of)
}

/// One input that is moved where another is 0, and where a difference vanishes.
fn vanishing<'d>(
    used: &[SymbolId],
    differences: &'d [Difference],
) -> impl Iterator<Item = Direction<'d>> {
    let zeros = used.iter().flat_map(|zero| {
        let others = used.iter().filter(move |other| *other != zero);
        others.map(|other| Direction {
            moved: vec![(*other, 1.0)],
            zero: Some(*zero),
            vanishes: None,
        })
    });
    let equals = differences.iter().flat_map(|difference| {
        let moved = used.iter().filter(|symbol| **symbol != difference.symbol);
        moved.map(|symbol| Direction {
            moved: vec![(*symbol, 1.0)],
            zero: None,
            vanishes: Some(difference),
        })
    });
    let zeros: Vec<Direction<'_>> = zeros.collect();
    let equals: Vec<Direction<'_>> = equals.collect();
    [zeros, equals].into_iter().flat_map(|all| {
        let count = VANISHING / 2;
        // A few are looked at from several points each.
        let times = (count / all.len().max(1)).clamp(1, ALONE);
        let share = count as f64 / all.len().max(count) as f64;
        let chosen: Vec<Direction<'_>> = super::spread(all, share).collect();
        std::iter::repeat_n(chosen, times).flatten()
    })
}

/// A point with the powers by which its inputs are moved.
struct Ray {
    start: Vec<f64>,
    powers: Vec<f64>,
}

impl Ray {
    fn new(graph: &Graph, direction: &Direction<'_>, mut random: Random) -> Self {
        let symbols = graph.symbols().map(|(_, symbol)| symbol);
        let mut start: Vec<f64> = symbols
            .map(|symbol| within(symbol, everyday(&mut random)))
            .collect();
        let mut powers = vec![0.0; start.len()];
        for (symbol, power) in &direction.moved {
            powers[symbol.index()] = *power;
        }
        if let Some(symbol) = direction.zero {
            start[symbol.index()] = 0.0;
        }
        if let Some(Difference {
            symbol,
            other,
            ratio,
            ..
        }) = direction.vanishes
        {
            let equal = other.map_or(1.0, |other| start[other.index()]);
            start[symbol.index()] = ratio * equal;
            powers[symbol.index()] = other.map_or(0.0, |other| powers[other.index()]);
        }
        Self { start, powers }
    }

    /// The point at some distance along the ray; none where an input leaves its domain or the range of numbers.
    fn at(&self, graph: &Graph, distance: f64) -> Option<Vec<f64>> {
        let moved = self.start.iter().zip(&self.powers);
        let point: Vec<f64> = moved
            .map(|(start, power)| moved_by(*start, power * distance))
            .collect();
        let symbols = graph.symbols().map(|(_, symbol)| symbol);
        let mut all = symbols.zip(self.start.iter().zip(&point));
        let is_allowed = |(symbol, (start, value)): (&Symbol, (&f64, &f64))| {
            let is_lost = *value == 0.0 && *start != 0.0;
            value.is_finite() && !is_lost && symbol.domain.contains(*value)
        };
        all.all(is_allowed).then_some(point)
    }

    fn points(
        &self,
        graph: &Graph,
        form: &Prepared<Size>,
        memory: &mut Vec<Size>,
    ) -> Vec<Vec<f64>> {
        let mut distances: BTreeSet<i64> = BTreeSet::new();
        let mut before: Option<(f64, Vec<f64>)> = None;
        for step in STEPS {
            let moved = self.start.iter().zip(&self.powers);
            let sizes: Vec<Size> = moved
                .map(|(start, power)| Size::moved(*start, power * step))
                .collect();
            form.at_with(&sizes, memory);
            let logs: Vec<f64> = memory.iter().map(|size| size.log).collect();
            if let Some((last, known)) = &before {
                for (from, to) in known.iter().zip(&logs) {
                    distances.extend(passing([*last, *from], [step, *to]));
                }
            }
            before = Some((step, logs));
        }
        let distances: Vec<i64> = distances.into_iter().collect();
        let share = POINTS as f64 / distances.len().max(POINTS) as f64;
        let chosen = super::spread(distances, share);
        chosen
            .filter_map(|distance| self.at(graph, distance as f64 / SIXTEENTHS))
            .collect()
    }
}

/// Distances are told apart to a sixteenth of a power of two, so that the sixteenth power of a number is to one.
const SIXTEENTHS: f64 = 16.0;

/// Where a size passes the ends of the range on its way from one distance to another.
fn passing([from, size]: [f64; 2], [to, other]: [f64; 2]) -> impl Iterator<Item = i64> {
    ENDS.into_iter().filter_map(move |end| {
        let is_passed = (size < end) != (other < end) && size.is_finite() && other.is_finite();
        let share = (end - size) / (other - size);
        is_passed.then(|| (SIXTEENTHS * (from + share * (to - from))).round() as i64)
    })
}

/// A number times a power of two that may be no number itself.
fn moved_by(value: f64, power: f64) -> f64 {
    let half = (power / 2.0).exp2();
    value * half * half
}
