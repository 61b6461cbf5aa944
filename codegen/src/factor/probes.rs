//! The points at which a form is held against the formula as written.

mod rays;
mod size;
mod special;

use crate::graph::{Domain, ExprId, Function, Graph, Node, Sizes, Symbol, SymbolId};
pub use rays::{Size, rays};
use special::{ALONE, TOGETHER, alone, together};

/// How many points have numbers of everyday sizes.
const ORDINARY: u64 = 96;

/// How many have numbers that are all far from 1, where products of two or three of them leave the range of numbers.
const FAR: u64 = 32;

/// And how many have numbers of which each is far from 1 in its own way.
const MIXED: u64 = 64;

/// The sizes of numbers at points far from 1, as powers of the largest that there is.
const FAR_SIZES: [f64; 4] = [0.55, -0.55, 1.0 / 3.0, -1.0 / 3.0];

/// The sizes at mixed points, where 1 stands for a number of everyday.
const FAR_MIXED: [f64; 8] = [0.0, 0.0, 0.55, -0.55, 0.65, -0.65, 0.97, -0.97];

/// The sizes at every other of these points, where numbers are only somewhat larger or smaller than others.
const NEAR_MIXED: [f64; 8] = [0.0, 0.0, 0.0, 0.01, -0.01, 0.03, -0.03, -0.02];

/// The largest size to a power, or the smallest to its size where the power is negative.
fn size(sizes: Sizes, power: f64) -> f64 {
    let (smallest, largest) = match sizes {
        Sizes::All => (1e-308, 1e308),
        Sizes::Within { smallest, largest } => (smallest, largest),
    };
    let edge: f64 = if power < 0.0 { smallest } else { largest };
    edge.powf(power.abs())
}

/// What looking at all points costs at most, in operations, each of which takes some 10 ns: a formula of more than 2,600
/// operations is looked at on fewer points, of every kind the same share.
const WORK: usize = 1 << 20;

/// The share of the points that is left of any formula: some seventy.
const LEAST_SHARE: f64 = 1.0 / 6.0;

/// The share of the points on which a formula of so many operations is looked at.
pub fn share(operations: usize) -> f64 {
    let points = ORDINARY + FAR + MIXED + ALONE as u64 + TOGETHER;
    let share = WORK as f64 / (operations.max(1) as f64 * points as f64);
    share.clamp(LEAST_SHARE, 1.0)
}

/// A share of some items, evenly spread.
fn spread<T>(items: impl IntoIterator<Item = T>, share: f64) -> impl Iterator<Item = T> {
    let is_kept =
        move |place: usize| (place as f64 * share).floor() < ((place + 1) as f64 * share).floor();
    let items = items.into_iter().enumerate();
    items.filter_map(move |(place, item)| is_kept(place).then_some(item))
}

/// The points for a formula, each a number for each symbol: those of everyday first. Of each kind a share.
pub fn points(
    graph: &Graph,
    roots: &[ExprId],
    differences: &[Difference],
    share: f64,
) -> Vec<Vec<f64>> {
    let used = graph.symbols_of(roots);
    let places: Vec<usize> = used.iter().map(|symbol| symbol.index()).collect();
    let everyday_and_far =
        spread(0..ORDINARY + FAR, share).map(|number| near_differences(graph, differences, number));
    let mixed = spread(0..MIXED, share).map(|number| mixed(graph, number));
    let special = [alone(graph, &places), together(graph, &places)];
    let special = special.into_iter().flat_map(|kind| spread(kind, share));
    let tiny = spread(tiny(graph), share);
    everyday_and_far
        .chain(mixed)
        .chain(special)
        .chain(tiny)
        .collect()
}

/// Points at which all numbers are so small that their inverses are infinite, for formulas with a length, which no square
/// makes 0: a share of the length is a number where the length's inverse is none.
fn tiny(graph: &Graph) -> Vec<Vec<f64>> {
    const POINTS: u64 = 8;
    let expressions = (0..graph.len()).filter_map(|position| graph.expression(position));
    let mut nodes = expressions.map(|id| graph.node(id));
    if graph.sizes != Sizes::All
        || !nodes.any(|node| matches!(node, Node::Apply(Function::Hypot, _)))
    {
        return Vec::new();
    }
    let point = |number: u64| {
        let mut random = Random::new(5000 + number);
        let symbols = graph.symbols();
        let value = |symbol: &Symbol| {
            // One in four is 0, so that the share of another is 1.
            let size = if random.below(4) == 0 { 0.0 } else { 1e-310 };
            within(symbol, size * everyday(&mut random))
        };
        symbols.map(|(_, symbol)| symbol).map(value).collect()
    };
    (0..POINTS).map(point).collect()
}

/// Two terms of a sum, or two sides of a comparison, that cancel where `symbol` has `ratio` times the value of `other`, and the sum's other symbols.
pub struct Difference {
    symbol: SymbolId,
    /// None for the number 1.
    other: Option<SymbolId>,
    ratio: f64,
    rest: Vec<SymbolId>,
}

/// Where the author subtracts inputs from each other or from numbers, or compares them: there they may well be nearly equal.
pub fn differences(graph: &Graph, roots: &[ExprId]) -> Vec<Difference> {
    let mut differences = Vec::new();
    for id in graph.reachable(roots) {
        let inputs = subtracted(graph, id);
        for (position, (symbol, coefficient)) in inputs.iter().enumerate() {
            for (other, subtracted) in inputs.iter().skip(position + 1) {
                let (symbol, other, ratio) = match (symbol, other) {
                    (Some(symbol), other) => (*symbol, *other, -subtracted / coefficient),
                    (None, Some(other)) => (*other, None, -coefficient / subtracted),
                    (None, None) => continue,
                };
                let rest = inputs.iter().filter_map(|(input, _)| *input);
                let rest = rest.filter(|input| *input != symbol && Some(*input) != other);
                differences.push(Difference {
                    symbol,
                    other,
                    ratio,
                    rest: rest.collect(),
                });
            }
        }
    }
    differences
}

/// The inputs, with their factors, and the numbers among the terms of a sum, or of the difference that a choice looks at; or
/// two inputs of which one is divided by the other, which may be a whole number of times.
fn subtracted(graph: &Graph, id: ExprId) -> Vec<(Option<SymbolId>, f64)> {
    let input = |operand: ExprId, coefficient: f64| match graph.node(operand) {
        Node::Symbol(symbol) => Some((Some(*symbol), coefficient)),
        Node::Number(value) => Some((None, coefficient * value.to_f64().unwrap_or(f64::NAN))),
        _ => None,
    };
    match graph.node(id) {
        Node::Sum(terms) => {
            let terms = terms.iter().map(|(operand, coefficient)| {
                input(*operand, coefficient.to_f64().unwrap_or(f64::NAN))
            });
            terms.flatten().collect()
        }
        Node::Product(factors) => {
            let divided = factors.iter().map(|(factor, exponent)| match exponent {
                1 => input(*factor, 1.0),
                -1 => input(*factor, -1.0),
                _ => None,
            });
            let divided: Vec<_> = divided.flatten().collect();
            let divides = matches!(divided.as_slice(), [(Some(_), 1.0), (Some(_), -1.0)]);
            if divides { divided } else { Vec::new() }
        }
        Node::Apply(function, operands) if function.is_choice() => {
            let compared = operands.iter().zip([1.0, -1.0]);
            compared
                .filter_map(|(operand, sign)| input(*operand, sign))
                .collect()
        }
        _ => Vec::new(),
    }
}

/// A number within a symbol's domain, of that size as far as the domain allows.
fn within(symbol: &Symbol, value: f64) -> f64 {
    let Domain { sign, lower, upper } = symbol.domain;
    let signed = if sign.is_not_negative() {
        value.abs()
    } else if sign.is_not_positive() {
        -value.abs()
    } else {
        value
    };
    if signed < lower || upper < signed {
        return inside(symbol.domain, value);
    }
    signed
}

/// A number inside of bounds, at a share of the way from one to the other that is the number's own.
fn inside(Domain { lower, upper, .. }: Domain, value: f64) -> f64 {
    // The digits of a number of any size.
    let share = (value.abs().log2() * 16.0).rem_euclid(1.0);
    let share = if share.is_finite() { share } else { 0.0 };
    if lower > 0.0 && upper.is_finite() {
        lower * (upper / lower).powf(share)
    } else if lower.is_finite() && upper.is_finite() {
        lower + share * (upper - lower)
    } else if lower.is_finite() {
        lower + value.abs()
    } else {
        upper - value.abs()
    }
}

/// A number of everyday, of a size from a half to 4, in one of four negative.
fn everyday(random: &mut Random) -> f64 {
    let size = [0.5, 1.0, 2.0][random.below(3) as usize];
    let magnitude = size * (1.0 + random.below(1 << 10) as f64 / 1024.0);
    if random.below(4) == 0 {
        -magnitude
    } else {
        magnitude
    }
}

/// The symbols' values at a point, each an exact number within its domain: of the sizes of everyday, and in most points
/// such that some of the differences nearly or wholly vanish; or all far from 1.
fn near_differences(graph: &Graph, differences: &[Difference], number: u64) -> Vec<f64> {
    let mut random = Random::new(number);
    let far = number >= ORDINARY;
    let size = if far {
        size(graph.sizes, FAR_SIZES[(number % 4) as usize])
    } else {
        let size = [1.0, 20.0, 200.0, 1e9, 1e-9, 0.3][(number % 6) as usize];
        within_sizes(graph.sizes, size)
    };
    let symbols = graph.symbols();
    let mut values: Vec<f64> = symbols
        .map(|(_, symbol)| within(symbol, size * everyday(&mut random)))
        .collect();
    if number.is_multiple_of(4) || differences.is_empty() {
        return values;
    }
    // Each difference is the last one at some points, so that no other moves its numbers apart again.
    let place = (number - number / 4 - 1) as usize;
    let (before, last) = (random.below(2) == 0, place % differences.len());
    let others = differences
        .iter()
        .take(if before { differences.len() } else { 0 });
    let others = others.filter(|_| random.below(2) == 0).collect::<Vec<_>>();
    for difference in others.into_iter().chain(&differences[last..=last]) {
        let other = difference.other.map_or(1.0, |other| values[other.index()]);
        // Twelve digits gone, six, or a few, so that what is left is small, and its inverse large but not very.
        let bits = [40, 40, 20, 9][random.below(4) as usize];
        let apart = (random.below(7) as f64 - 3.0) * 2.0_f64.powi(-bits);
        let near = 1.0 + apart;
        let symbol = graph.symbol(difference.symbol);
        values[difference.symbol.index()] = within(symbol, difference.ratio * other * near);
        if random.below(2) == 0 {
            for small in &difference.rest {
                values[small.index()] *= 1e-17;
            }
        }
    }
    values
}

/// The nearest size that numbers have.
fn within_sizes(sizes: Sizes, value: f64) -> f64 {
    match sizes {
        Sizes::All => value,
        Sizes::Within { smallest, largest } => value.clamp(smallest, largest),
    }
}

/// Numbers each far from 1 in its own way.
fn mixed(graph: &Graph, number: u64) -> Vec<f64> {
    let mut random = Random::new(1000 + number);
    let symbols = graph.symbols();
    let value = |symbol: &Symbol| {
        let powers = if number.is_multiple_of(2) {
            FAR_MIXED
        } else {
            NEAR_MIXED
        };
        let power = powers[random.below(powers.len() as u64) as usize];
        let size = size(graph.sizes, power);
        within(symbol, size * everyday(&mut random))
    };
    symbols.map(|(_, symbol)| symbol).map(value).collect()
}

/// Points of everyday with all digits, in groups that differ in the last digits alone: a share of the groups, and of each a
/// share, but two at least.
pub fn groups(graph: &Graph, differences: &[Difference], share: f64) -> Vec<Vec<Vec<f64>>> {
    const GROUPS: u64 = 5;
    const POINTS: u64 = 4;
    let [groups, points] = [GROUPS, POINTS].map(|all| (all as f64 * share).ceil().max(2.0) as u64);
    let group = |number: u64| {
        // Those of 1e9 and 1e-9 among them.
        let middle = near_differences(graph, differences, number);
        let point = |place: u64| {
            let mut random = Random::new(4000 + POINTS * number + place);
            let shift =
                |value: &f64| value * (1.0 + random.below(1 << 20) as f64 * 2.0_f64.powi(-50));
            middle.iter().map(shift).collect()
        };
        (0..points).map(point).collect()
    };
    (1..=groups).map(group).collect()
}

/// Pseudo-random numbers that are equal at every build.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, bound: u64) -> u64 {
        // A linear congruence; its upper bits are the good ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}
