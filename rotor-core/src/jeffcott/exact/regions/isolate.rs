//! The positive roots of a polynomial with whole coefficients, each alone in an interval.
//!
//! Intervals are halved until Descartes' rule of signs finds no root in them, or one. Two roots, real or complex, that differ by
//! less than [`RESOLVED`] of their size are not parted: such a cluster is a point for all that doubles tell.

use std::cmp::Ordering;
use std::ops::Range;

use num_bigint::BigInt;

use super::whole::{Dyadic, Whole};

/// The binary digits of a root's position in which it is told from others. Halving ends there, for a root that is a double one
/// would be halved for ever.
const RESOLVED: u64 = 160;

/// An interval of the variable, number / 2^depth to (number + 1) / 2^depth of a bound, and the polynomial over it, with the
/// variable from 0 to 1.
#[derive(Clone, Debug)]
struct Cell {
    polynomial: Whole,
    number: BigInt,
    depth: u64,
}

/// One root, or a cluster of them.
#[derive(Clone, Debug)]
pub(super) struct Isolated {
    /// No root is below this but those before.
    pub(super) low: Dyadic,
    /// No root is above this but those behind; the same as `low` where that is the root.
    pub(super) high: Dyadic,
    /// Where it is.
    pub(super) value: f64,
    /// How many roots of a cluster there are, by Descartes' rule; 1 for a root alone.
    pub(super) count: usize,
    /// The interval, of one root that is inside.
    cell: Option<Cell>,
}

/// The positive roots in ascending order, with room between neighbours; where exponents of two are given, those from the first of
/// these powers up to the second. The polynomial is not zero everywhere.
pub(super) fn positive_roots(polynomial: &Whole, within: Option<Range<i64>>) -> Vec<Isolated> {
    let polynomial = polynomial.without_zero_roots();
    let (least, bound) = (-bound(&polynomial.reversed()), bound(&polynomial));
    let within = within.map_or(least..bound, |wanted| {
        wanted.start.max(least)..wanted.end.min(bound)
    });
    let mut roots = Vec::new();
    let mut open = Vec::new();
    for octave in octaves(&polynomial, within) {
        let (start, cell) = Cell::octave(&polynomial, octave, bound);
        roots.extend(start);
        open.push(cell);
    }
    while let Some(cell) = open.pop() {
        let inside = cell.polynomial.of_unit_interval();
        match inside.variations() {
            0 => {}
            count if count == 1 || cell.number.bits() > RESOLVED => {
                roots.push(cell.isolated(count, &inside, bound));
            }
            _ => {
                let (lower, middle, upper) = cell.halves(bound);
                roots.extend(middle);
                open.extend([upper, lower]);
            }
        }
    }
    roots.sort_by(Isolated::order);
    make_room(&mut roots, bound);
    roots
}

/// The exponents of those octaves, each from a power of two to the next, that may have roots.
fn octaves(polynomial: &Whole, within: Range<i64>) -> Vec<i64> {
    let mut found = Vec::new();
    let mut open = vec![within];
    while let Some(Range { start, end }) = open.pop() {
        if end - start == 1 {
            found.push(start);
        }
        if end - start < 2 {
            continue;
        }
        // From 2^start to a little beyond 2^end, as start + (end − start) in powers of two.
        let from_start = polynomial.stretched(-start).shifted();
        let has_start = from_start.coefficients().first() == Some(&BigInt::ZERO);
        let all = from_start.stretched(start - end).of_unit_interval();
        if has_start || all.variations() > 0 {
            let middle = (start + end).div_euclid(2);
            open.extend([start..middle, middle..end]);
        }
    }
    found
}

/// Halves intervals that touch a root beside them.
fn make_room(roots: &mut [Isolated], bound: i64) {
    for place in 0..roots.len() {
        loop {
            let own = &roots[place];
            let is_point = |other: &Isolated| other.low == other.high;
            let before = place.checked_sub(1).and_then(|before| roots.get(before));
            let touches_before =
                before.is_some_and(|other| is_point(other) && !other.high.is_less(&own.low));
            let next = roots.get(place + 1);
            let touches_next =
                next.is_some_and(|other| is_point(other) && !own.high.is_less(&other.low));
            let touches = touches_before || touches_next;
            let Some(cell) = own.cell.clone().filter(|_| touches) else {
                break;
            };
            roots[place] = cell.halved(bound);
        }
    }
}

impl Isolated {
    fn order(&self, other: &Self) -> Ordering {
        if self.low.is_less(&other.low) || self.high.is_less(&other.high) {
            Ordering::Less
        } else if other.low.is_less(&self.low) || other.high.is_less(&self.high) {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    }
}

/// The power of two beyond all roots: from each coefficient against the last one (Lagrange).
fn bound(polynomial: &Whole) -> i64 {
    let coefficients = polynomial.coefficients();
    let degree = coefficients.len().saturating_sub(1);
    let last = coefficients.last().map_or(0, BigInt::bits) as i64;
    let each = coefficients.iter().take(degree).enumerate();
    let sizes = each.filter(|(_, coefficient)| **coefficient != BigInt::ZERO);
    let powers = sizes.map(|(power, coefficient)| {
        let apart = coefficient.bits() as i64 - last + 1;
        apart.div_euclid((degree - power) as i64) + 1
    });
    powers.max().unwrap_or(0) + 1
}

impl Cell {
    /// The octave from a power of two to the next, and the root at its start.
    fn octave(polynomial: &Whole, exponent: i64, bound: i64) -> (Option<Isolated>, Self) {
        let shifted = polynomial.stretched(-exponent).shifted();
        let cell = Self {
            polynomial: shifted.without_zero_roots(),
            number: BigInt::from(1),
            depth: (bound - exponent).unsigned_abs(),
        };
        let count = shifted.coefficients().len() - cell.polynomial.coefficients().len();
        ((count > 0).then(|| cell.at_start(count, bound)), cell)
    }

    /// The lower half, the root between the halves if there is one, and the upper half without it.
    fn halves(self, bound: i64) -> (Self, Option<Isolated>, Self) {
        let polynomial = self.polynomial.stretched(1);
        let shifted = polynomial.shifted();
        let (number, depth) = (self.number << 1, self.depth + 1);
        let upper = Self {
            polynomial: shifted.without_zero_roots(),
            number: &number + 1,
            depth,
        };
        let count = shifted.coefficients().len() - upper.polynomial.coefficients().len();
        let middle = (count > 0).then(|| upper.at_start(count, bound));
        let lower = Self {
            polynomial,
            number,
            depth,
        };
        (lower, middle, upper)
    }

    /// The half that has the root, of a cell with one; or the root between the halves.
    fn halved(self, bound: i64) -> Isolated {
        let (lower, middle, upper) = self.halves(bound);
        if let Some(middle) = middle {
            return middle;
        }
        let inside = lower.polynomial.of_unit_interval();
        if inside.variations() == 1 {
            return lower.isolated(1, &inside, bound);
        }
        let inside = upper.polynomial.of_unit_interval();
        upper.isolated(1, &inside, bound)
    }

    /// `number` / 2^depth of the bound.
    fn place(&self, number: BigInt, bound: i64) -> Dyadic {
        let places = self.depth as i64 - bound;
        Dyadic {
            mantissa: number << (-places).max(0),
            places: places.max(0) as u64,
        }
    }

    /// The root at the interval's start.
    fn at_start(&self, count: usize, bound: i64) -> Isolated {
        let place = self.place(self.number.clone(), bound);
        Isolated {
            value: scaled(&self.number, 0.0, bound - self.depth as i64),
            low: place.clone(),
            high: place,
            count,
            cell: None,
        }
    }

    fn isolated(self, count: usize, inside: &Whole, bound: i64) -> Isolated {
        // A cluster is where its interval is, which is far shorter than the spacing of doubles.
        let part = if count == 1 { root_inside(inside) } else { 0.5 };
        Isolated {
            low: self.place(self.number.clone(), bound),
            high: self.place(&self.number + 1, bound),
            value: scaled(&self.number, part, bound - self.depth as i64),
            count,
            cell: (count == 1).then_some(self),
        }
    }
}

/// (number + part) · 2^exponent.
fn scaled(number: &BigInt, part: f64, exponent: i64) -> f64 {
    // Of a long number the leading 64 digits decide, of a short one the part beside it too.
    let spare = number.bits().saturating_sub(64);
    let leading = u64::try_from(number >> spare).map_or(f64::NAN, |leading| leading as f64);
    let sum = if spare > 0 { leading } else { leading + part };
    powered(sum, exponent + spare as i64)
}

/// value · 2^exponent, also where the power alone leaves the range of doubles.
fn powered(value: f64, exponent: i64) -> f64 {
    let half = (exponent / 2).clamp(-1000, 1000) as i32;
    let rest = (exponent - i64::from(half)).clamp(-1000, 1000) as i32;
    value * 2.0_f64.powi(half) * 2.0_f64.powi(rest)
}

/// The root between 0 and 1 of a polynomial, from its form of the unit interval, in which the signs change once.
///
/// The terms of one sign and those of the other meet at the one positive root t of that form, 1/(1 + t) is the root asked for.
/// Each side is a sum of numbers of one sign, so that doubles are enough.
fn root_inside(inside: &Whole) -> f64 {
    let terms: Vec<(f64, i64)> = inside.coefficients().iter().map(leading).collect();
    // Which side is the larger at t = (1 + part) 2^power: the higher powers, the lower ones or neither.
    let side = |part: f64, power: i64| {
        let exponents = terms
            .iter()
            .enumerate()
            .map(|(place, (mantissa, exponent))| {
                let all = exponent + place as i64 * power;
                if *mantissa == 0.0 { i64::MIN } else { all }
            });
        let largest = exponents.clone().max().unwrap_or(0);
        let sized = terms.iter().zip(exponents);
        let values = sized.map(|((mantissa, _), exponent)| {
            powered(*mantissa, exponent.saturating_sub(largest).max(-2000))
        });
        let sum = values
            .rev()
            .fold(0.0, |sum, value| sum * (1.0 + part) + value);
        let last = terms.last().map_or(0.0, |(mantissa, _)| mantissa.signum());
        (sum * last).partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    };
    let (mut low, mut high) = (-FARTHEST, FARTHEST);
    while high - low > 1 {
        let middle = (low + high).div_euclid(2);
        match side(0.0, middle) {
            Ordering::Greater => high = middle,
            _ => low = middle,
        }
    }
    let power = low;
    let (mut low, mut high) = (0.0, 1.0);
    // As many as a double has digits.
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = 0.5 * (low + high);
        match side(middle, power) {
            Ordering::Greater => high = middle,
            _ => low = middle,
        }
    }
    1.0 / (1.0 + powered(1.0 + 0.5 * (low + high), power))
}

/// The power of two that t and 1/t do not exceed: a root nearer to an end of its interval is at that end for doubles.
const FARTHEST: i64 = 300;

/// A whole number as a mantissa and a power of two.
fn leading(number: &BigInt) -> (f64, i64) {
    let spare = number.bits().saturating_sub(64);
    let digits = i128::try_from(number >> spare).map_or(f64::NAN, |digits| digits as f64);
    (digits, spare as i64)
}
