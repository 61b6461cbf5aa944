//! Where a formula is looked at.

use super::hostile::Random;
use super::program::{INPUTS, Program};

/// How the numbers of a point were chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// Full mantissas of ordinary size.
    Ordinary,
    /// Numbers beside each other and beside those of the formula, so that differences nearly vanish.
    Near,
    /// Zeros, infinities, NaN and the ends of the range.
    Special,
}

/// The formula's inputs in order.
pub type Inputs = [f64; INPUTS.len()];

const SPECIAL: [f64; 15] = [
    0.0,
    -0.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    1e170,
    1e-170,
    -1e170,
    1e300,
    1e-300,
    -1e-300,
    1e-310,
    5e-324,
    f64::MAX,
    f64::MIN_POSITIVE,
];

/// Some points of each kind, all in the program's domain.
pub fn points(random: &mut Random, program: &Program) -> Vec<(Place, Inputs)> {
    let literals = program.literals();
    let mut points = Vec::new();
    for decades in [0.5, 3.0, 8.0] {
        let point = std::array::from_fn(|_| ordinary(random, decades));
        points.push((Place::Ordinary, point));
    }
    for kind in 0..3 {
        points.push((Place::Near, near(random, kind, &literals)));
    }
    for often in [100, 60, 40, 40] {
        let point = std::array::from_fn(|_| {
            if random.percent(often) {
                random.one_of(&SPECIAL)
            } else {
                ordinary(random, 0.5)
            }
        });
        points.push((Place::Special, point));
    }
    for (_, point) in &mut points {
        for (input, comparison) in &program.domain {
            point[*input] = within(comparison, point[*input]);
        }
    }
    points
}

/// A number of either sign, of at most so many decades.
fn ordinary(random: &mut Random, decades: f64) -> f64 {
    let size = 10.0_f64.powf((2.0 * random.unit() - 1.0) * decades);
    if random.percent(40) { -size } else { size }
}

fn near(random: &mut Random, kind: usize, literals: &[f64]) -> Inputs {
    let base = match kind {
        0 => ordinary(random, 1.0),
        1 if !literals.is_empty() => random.one_of(literals),
        _ => random.below(9) as f64 - 4.0,
    };
    std::array::from_fn(|_| {
        let sign = if random.percent(20) { -1.0 } else { 1.0 };
        let apart = 2.0_f64.powi(-(random.below(56) as i32));
        match random.below(4) {
            0 => base * sign,
            1 => (base * sign).next_up(),
            2 => base * sign * (1.0 + apart),
            _ => base * sign * (1.0 - apart),
        }
    })
}

/// A number that meets a condition, the same one where it does.
fn within(comparison: &str, x: f64) -> f64 {
    let x = if x.is_nan() { 1.0 } else { x };
    let not_zero = if x == 0.0 { 1.0 } else { x };
    match comparison {
        ">" => not_zero.abs(),
        ">=" => x.abs(),
        "<" => -not_zero.abs(),
        "<=" => -x.abs(),
        _ => not_zero,
    }
}
