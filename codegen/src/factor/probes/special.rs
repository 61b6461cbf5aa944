//! Points with numbers that arithmetic has rules of their own for.

use super::{Random, everyday, spread, within, within_sizes};
use crate::graph::{Domain, Function, Graph, Node, Sizes, Symbol};

/// The most points of which one number is special.
pub(super) const ALONE: usize = 160;

/// How many have several, where there are more than two numbers.
pub(super) const TOGETHER: u64 = 96;

/// The most points of pairs, where there are two numbers, beside those of the numbers that come first.
const PAIRS: usize = 192;

/// How many of the special numbers come first, of which there are all pairs: zeros, ones, infinities and the smallest.
const FIRST: usize = 8;

/// The edges of the range of numbers, with numbers whose squares are beyond them.
const EDGES: [f64; 18] = [
    f64::INFINITY,
    f64::NEG_INFINITY,
    5e-324,
    -5e-324,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    1e-310,
    -1e-310,
    1e300,
    -1e300,
    1e-300,
    -1e-300,
    1e170,
    -1e170,
    1e-170,
    -1e-170,
];

/// Numbers that arithmetic has rules of their own for, and the edges of its range.
fn special(sizes: Sizes) -> Vec<f64> {
    let everywhere = [0.0, -0.0, 1.0, -1.0];
    let edges: Vec<f64> = match sizes {
        Sizes::All => EDGES.into_iter().chain([f64::NAN]).collect(),
        Sizes::Within { smallest, largest } => vec![smallest, largest, -smallest, -largest],
    };
    everywhere.into_iter().chain(edges).collect()
}

/// Arguments at the ends of the exponential's range: of it, of its powers up to the fourth, and where it is lost beside 1.
const EXPONENTS: [f64; 12] = [
    20.0, -20.0, 180.0, -180.0, 245.0, -245.0, 355.0, -355.0, 710.0, -710.0, 745.0, -745.0,
];

/// Numbers whose power to themselves is in the middle of the range of numbers, and near its end.
const POWERS: [f64; 2] = [75.0, 140.0];

/// Numbers between the edges of a function that has values from −1 to 1 alone, where those of everyday have none.
const WITHIN_ONE: [f64; 4] = [0.375, -0.75, 0.9990234375, -0.9990234375];

/// The functions whose arguments have edges beside those of numbers, with special numbers for them.
fn edges(function: Function) -> &'static [f64] {
    match function {
        Function::Exp
        | Function::ExpM1
        | Function::Exp2
        | Function::Sinh
        | Function::Cosh
        | Function::Tanh => &EXPONENTS,
        Function::Powf => &POWERS,
        Function::Asin | Function::Acos | Function::Atanh | Function::Ln1p => &WITHIN_ONE,
        _ => &[],
    }
}

/// The special numbers for a formula.
fn special_for(graph: &Graph) -> Vec<f64> {
    let mut numbers = special(graph.sizes);
    let fits = |size: &f64| within_sizes(graph.sizes, size.abs()) == size.abs();
    let mut seen: Vec<&[f64]> = Vec::new();
    for id in (0..graph.len()).filter_map(|position| graph.expression(position)) {
        if let Node::Apply(function, _) = graph.node(id)
            && let edges = edges(*function)
            && !seen.contains(&edges)
        {
            seen.push(edges);
            numbers.extend(edges.iter().copied().filter(fits));
        }
    }
    numbers
}

/// Points of which one number is special.
pub(super) fn alone(graph: &Graph, places: &[usize]) -> Vec<Vec<f64>> {
    let domains: Vec<Domain> = graph.symbols().map(|(_, symbol)| symbol.domain).collect();
    let special = special_for(graph);
    let edges = |place: usize| {
        let Domain { lower, upper, .. } = domains[place];
        [lower, upper].into_iter().filter(|edge| edge.is_finite())
    };
    let pairs = places.iter().flat_map(|place| {
        // A comparison with NaN fails, which shows only beside numbers with which it would hold: there are more of it.
        let more = special.iter().copied().filter(|number| number.is_nan());
        let more = more.flat_map(|nan| [nan; 3]);
        let values = special.iter().copied().chain(edges(*place)).chain(more);
        values.map(|value| (*place, value))
    });
    let pairs: Vec<(usize, f64)> = pairs
        .filter(|(place, value)| domains[*place].contains(*value))
        .collect();
    // Of many symbols each has some of them; of few each has all, several times beside others of other signs.
    let step = pairs.len().div_ceil(ALONE).max(1);
    let times = if places.len() > 1 {
        (ALONE / pairs.len().max(1)).max(1)
    } else {
        1
    };
    let chosen = pairs.iter().skip(step / 2).step_by(step);
    let chosen = std::iter::repeat_n(chosen, times).flatten().enumerate();
    let point = |(number, (place, special)): (usize, &(usize, f64))| {
        let mut random = Random::new(2000 + number as u64);
        let symbols = graph.symbols();
        let mut values: Vec<f64> = symbols
            .map(|(_, symbol)| within(symbol, everyday(&mut random)))
            .collect();
        values[*place] = *special;
        values
    };
    chosen.map(point).collect()
}

/// Points of which several numbers are special: of two numbers pairs from everywhere among all of them.
pub(super) fn together(graph: &Graph, places: &[usize]) -> Vec<Vec<f64>> {
    let special = special_for(graph);
    let symbols: Vec<&Symbol> = graph.symbols().map(|(_, symbol)| symbol).collect();
    let ordinary = |random: &mut Random| -> Vec<f64> {
        symbols
            .iter()
            .map(|symbol| within(symbol, everyday(random)))
            .collect()
    };
    if let [first, second] = *places {
        let mut random = Random::new(3000);
        let pairs = special
            .iter()
            .enumerate()
            .flat_map(|x| special.iter().enumerate().map(move |y| [x, y]));
        let are_allowed = |[(_, x), (_, y)]: &[(usize, &f64); 2]| {
            symbols[first].domain.contains(**x) && symbols[second].domain.contains(**y)
        };
        let come_first = |[(x, _), (y, _)]: &[(usize, &f64); 2]| *x < FIRST && *y < FIRST;
        let mut point = |[x, y]: [f64; 2]| {
            let mut values = ordinary(&mut random);
            (values[first], values[second]) = (x, y);
            values
        };
        let (all, others): (Vec<_>, Vec<_>) = pairs.filter(are_allowed).partition(come_first);
        let share = PAIRS as f64 / others.len().max(PAIRS) as f64;
        let chosen = all.into_iter().chain(spread(others, share));
        return chosen.map(|[(_, x), (_, y)]| point([*x, *y])).collect();
    }
    let point = |number: u64| {
        let mut random = Random::new(3000 + number);
        let mut values = ordinary(&mut random);
        for (value, symbol) in values.iter_mut().zip(&symbols) {
            let special = special[random.below(special.len() as u64) as usize];
            if random.below(2) == 0 && symbol.domain.contains(special) {
                *value = special;
            }
        }
        values
    };
    let count = if places.len() > 2 { TOGETHER } else { 0 };
    (0..count).map(point).collect()
}
