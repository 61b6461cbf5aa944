//! Values at random points of two prime fields, by which equal expressions are told.
//!
//! Rational operations are done in both fields; any other function of an operand gets a value drawn by the operand's
//! fingerprint, so that it equals just itself. Two polynomials of degree d that differ agree at both points and in both fields with
//! a probability of at most (d/p)⁴ (Schwartz and Zippel), 1e-60 for the degrees of formulas. No power of two or ten, and no
//! number near one, is a small number in either field, let alone the same one in both. A constant of which a prime divides a
//! part, and a divisor that vanishes in one field alone, have a value in that field that is drawn as a function's is. The points
//! are fixed, so that the same formulas always give the same code; what was taken for equal is confirmed where the
//! finished form is held against the author's ([`rounding`](crate::factor::rounding)).

use num_bigint::BigInt;
use num_traits::ToPrimitive;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{ExprId, Function, Graph, Node, Rational, SymbolId};

/// What each prime is below 2⁶¹: drawn at random from 2²⁶ to 2²⁷, so that 2⁶¹ is a number in the fields that no formula has.
const BELOW: [u64; 2] = [75916291, 95946753];

/// The primes.
const PRIMES: [u64; 2] = [(1 << 61) - BELOW[0], (1 << 61) - BELOW[1]];

/// A number of both fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Residue([u64; 2]);

/// A number below 2¹²² in the field of one prime.
fn reduced(wide: u128, field: usize) -> u64 {
    const LOW: u128 = (1 << 61) - 1;
    // 2⁶¹ is the small number that the prime is below it: the bits from there on are added so many times to those below.
    let below = u128::from(BELOW[field]);
    let once = (wide & LOW) + (wide >> 61) * below;
    let twice = ((once & LOW) + (once >> 61) * below) as u64;
    let mut rest = twice;
    while rest >= PRIMES[field] {
        rest -= PRIMES[field];
    }
    rest
}

fn product_in(field: usize, left: u64, right: u64) -> u64 {
    reduced(u128::from(left) * u128::from(right), field)
}

fn power_in(field: usize, base: u64, exponent: u64) -> u64 {
    let (mut result, mut base, mut rest) = (1, base, exponent);
    while rest > 0 {
        if rest % 2 == 1 {
            result = product_in(field, result, base);
        }
        base = product_in(field, base, base);
        rest /= 2;
    }
    result
}

/// The inverse by Euclid's algorithm, which ends after a few divisions where the number is small; that of 0 is 0.
fn inverse_in(field: usize, number: u64) -> u64 {
    let prime = PRIMES[field].cast_signed();
    let (mut rest, mut next) = (prime, number.cast_signed());
    // What each of the two is a multiple of the number by, but for multiples of the prime; no larger than it in size.
    let (mut of_rest, mut of_next) = (0, 1);
    while next != 0 {
        let quotient = rest / next;
        (rest, next) = (next, rest - quotient * next);
        (of_rest, of_next) = (of_next, of_rest - quotient * of_next);
    }
    let inverse = if of_rest < 0 {
        of_rest + prime
    } else {
        of_rest
    };
    inverse.unsigned_abs()
}

/// A small number of both fields.
fn small(number: u64) -> Residue {
    Residue::of(|field| number % PRIMES[field])
}

fn signed(number: i64) -> Residue {
    let size = small(number.unsigned_abs());
    if number < 0 { size.negative() } else { size }
}

impl Residue {
    /// 0
    pub const ZERO: Self = Self([0; 2]);
    /// 1
    pub const ONE: Self = Self([1; 2]);

    /// What a number is in each field.
    fn of(number: impl Fn(usize) -> u64) -> Self {
        Self([number(0), number(1)])
    }

    /// The residue of a rational number; in a field whose prime divides its numerator or denominator it is drawn.
    pub fn rational(value: &Rational) -> Self {
        let parts = match value.small_parts() {
            // Most constants of formulas are whole and small.
            Some((numerator, 1)) => return signed(numerator),
            Some((numerator, denominator)) => [signed(numerator), small(denominator)],
            None => [value.numerator(), value.denominator()].map(|part| whole(&part)),
        };
        let [above, below] = parts;
        let quotient = above.times(below.inverse());
        if quotient.vanishes() {
            return quotient.or_where_zero(drawn(CONSTANT, 0, parts.into_iter()));
        }
        quotient
    }

    /// The other number in the fields in which this one is 0.
    fn or_where_zero(self, other: Self) -> Self {
        Self::of(|field| {
            if self.0[field] == 0 {
                other.0[field]
            } else {
                self.0[field]
            }
        })
    }

    /// Whether it is 0 in one of the fields.
    fn vanishes(self) -> bool {
        self.0.contains(&0)
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        Self::of(|field| {
            let sum = self.0[field] + other.0[field];
            sum.checked_sub(PRIMES[field]).unwrap_or(sum)
        })
    }

    /// The negative.
    pub fn negative(self) -> Self {
        Self::of(|field| match self.0[field] {
            0 => 0,
            number => PRIMES[field] - number,
        })
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        Self::of(|field| product_in(field, self.0[field], other.0[field]))
    }

    /// The power.
    pub fn power(self, exponent: u64) -> Self {
        match exponent {
            1 => self,
            2 => self.times(self),
            _ => Self::of(|field| power_in(field, self.0[field], exponent)),
        }
    }

    /// The inverse; that of 0 is 0.
    pub fn inverse(self) -> Self {
        Self::of(|field| inverse_in(field, self.0[field]))
    }

    /// The inverses of many, of which only one is worked out: the others are products.
    pub fn inverses(residues: &[Self]) -> Vec<Self> {
        let or_one = |residue: &Self| residue.or_where_zero(Self::ONE);
        let mut product = Self::ONE;
        let mut inverses = Vec::with_capacity(residues.len());
        for residue in residues {
            inverses.push(product);
            product = product.times(or_one(residue));
        }
        let mut of_rest = product.inverse();
        for (inverse, residue) in inverses.iter_mut().zip(residues).rev() {
            let all = inverse.times(of_rest);
            *inverse = Self::of(|field| {
                if residue.0[field] == 0 {
                    0
                } else {
                    all.0[field]
                }
            });
            of_rest = of_rest.times(or_one(residue));
        }
        inverses
    }

    /// The fraction with the smallest parts whose residue this is, if any has parts up to 64.
    pub fn as_fraction(self) -> Option<(i64, i64)> {
        (1..=64_i64).find_map(|denominator| {
            let scaled = self.times(Self([denominator.unsigned_abs(); 2]));
            let signed = |field: usize| {
                let number = scaled.0[field];
                let negative = PRIMES[field] - number;
                let size = i64::try_from(number.min(negative)).ok()?;
                Some(if number <= negative { size } else { -size })
            };
            let numerator = signed(0).filter(|numerator| numerator.abs() <= 64)?;
            (signed(1) == Some(numerator)).then_some((numerator, denominator))
        })
    }
}

fn whole(value: &BigInt) -> Residue {
    Residue::of(|field| {
        let modulus = BigInt::from(PRIMES[field]);
        let reduced = ((value % &modulus) + &modulus) % &modulus;
        reduced.to_u64().unwrap_or(0)
    })
}

/// Deterministic noise (the finaliser of splitmix64).
fn scramble(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The kinds of numbers that are drawn, beside functions and tables.
const CONSTANT: u64 = 2_000_000;
const DIVISION_BY_ZERO: u64 = 3_000_000;

/// A number of both fields by noise.
fn noise(seed: u64) -> Residue {
    Residue::of(|field| scramble(seed.wrapping_add(field as u64)) % PRIMES[field])
}

/// The value of an expression at two points.
pub type Fingerprint = [Residue; 2];

/// The fingerprint with its sign dropped, and whether it was negated for that.
pub fn without_sign(fingerprint: Fingerprint) -> (Fingerprint, bool) {
    let negated = fingerprint.map(Residue::negative);
    if negated < fingerprint {
        (negated, true)
    } else {
        (fingerprint, false)
    }
}

/// The value of a symbol at a point.
pub fn symbol_at(symbol: SymbolId, point: u64) -> Residue {
    noise(scramble(scramble(point) ^ (symbol.index() as u64)))
}

/// The value of a function that is no sum or product, drawn by its kind and its operands.
pub fn drawn(kind: u64, point: u64, operands: impl Iterator<Item = Residue>) -> Residue {
    let start =
        scramble(kind.wrapping_mul(0x0001_0000_0001) ^ point.wrapping_mul(0xD6E8_FEB8_6659_FD93));
    let enter = |seed, number: u64| scramble(seed ^ number);
    let seed = operands.fold(start, |seed, operand| {
        operand.0.into_iter().fold(seed, enter)
    });
    noise(seed)
}

/// A number for each function, to draw its values by.
pub fn kind_of(function: Function) -> u64 {
    1 + function as u64
}

/// A number for each derivative of a tabulated function.
pub fn kind_of_table(table: usize, order: usize) -> u64 {
    2000 + 64 * (table as u64) + (order as u64)
}

/// The value of a node at a point from the values of its operands.
pub fn node_at(
    graph: &Graph,
    id: ExprId,
    point: u64,
    value: impl Fn(ExprId) -> Residue,
) -> Residue {
    let inverse = |divisor| inverse(value(divisor), point);
    node_with(graph, id, point, &value, inverse)
}

/// The value of a node at a point, from the values of its operands and their inverses.
fn node_with(
    graph: &Graph,
    id: ExprId,
    point: u64,
    value: impl Fn(ExprId) -> Residue,
    mut inverse: impl FnMut(ExprId) -> Residue,
) -> Residue {
    let drawn = |kind: u64, operands: &[ExprId]| {
        drawn(kind, point, operands.iter().map(|operand| value(*operand)))
    };
    match graph.node(id) {
        Node::Number(number) => Residue::rational(number),
        Node::Constant(constant) => drawn(1000 + *constant as u64, &[]),
        Node::Symbol(symbol) => symbol_at(*symbol, point),
        Node::Sum(terms) => terms
            .iter()
            .fold(Residue::ZERO, |sum, (operand, coefficient)| {
                sum.plus(value(*operand).times(Residue::rational(coefficient)))
            }),
        Node::Product(factors) => {
            factors
                .iter()
                .fold(Residue::ONE, |product, (operand, exponent)| {
                    let base = if *exponent < 0 {
                        inverse(*operand)
                    } else {
                        value(*operand)
                    };
                    product.times(base.power(u64::from(exponent.unsigned_abs())))
                })
        }
        Node::Apply(function, operands) => drawn(kind_of(*function), operands),
        Node::Tabulated {
            table,
            order,
            argument,
        } => drawn(
            kind_of_table(*table, *order),
            std::slice::from_ref(argument),
        ),
        Node::Integral {
            variable,
            integrand,
            lower,
            upper,
        } => drawn(
            1_000_000 + variable.index() as u64,
            &[*integrand, *lower, *upper],
        ),
    }
}

/// The inverse of a divisor. A division by zero is no number, least of all zero.
pub fn inverse(divisor: Residue, point: u64) -> Residue {
    if divisor.vanishes() {
        let other = drawn(DIVISION_BY_ZERO, point, [divisor].into_iter());
        return divisor.inverse().or_where_zero(other);
    }
    divisor.inverse()
}

/// The expressions among these that are 0 whatever their symbols are.
pub fn vanishing(graph: &Graph, ids: &[ExprId]) -> Vec<ExprId> {
    if ids.is_empty() {
        return Vec::new();
    }
    let values = [0, 1].map(|point| all_at(graph, ids, point));
    let is_zero = |id: &ExprId| {
        values
            .iter()
            .all(|values| values[id.index()] == Residue::ZERO)
    };
    ids.iter().copied().filter(is_zero).collect()
}

/// The values of all nodes that the roots need at a point, by position; others are 0.
pub fn all_at(graph: &Graph, roots: &[ExprId], point: u64) -> Vec<Residue> {
    let mut values = vec![Residue::ZERO; graph.len()];
    // A divisor may stand in many products.
    let mut inverses: FxHashMap<ExprId, Residue> = FxHashMap::default();
    for id in graph.reachable(roots) {
        let value = |operand: ExprId| values[operand.index()];
        let inverse = |divisor: ExprId| {
            let known = inverses.entry(divisor);
            *known.or_insert_with(|| inverse(value(divisor), point))
        };
        values[id.index()] = node_with(graph, id, point, value, inverse);
    }
    values
}

/// The values of the roots at a point, where what lies deeper than so many operations, and every function that is neither
/// a sum nor a product, stands for itself, like a symbol: what is equal so is equal.
pub fn near(graph: &Graph, roots: &[ExprId], depth: usize, point: u64) -> Vec<Residue> {
    let mut seen: FxHashSet<ExprId> = FxHashSet::default();
    let mut opened: Vec<ExprId> = Vec::new();
    let mut level = roots.to_vec();
    for _ in 0..depth {
        let is_new = |id: &ExprId| {
            !matches!(graph.node(*id), Node::Apply(..) | Node::Tabulated { .. }) && seen.insert(*id)
        };
        level.retain(is_new);
        opened.extend(&level);
        level = level.iter().flat_map(|id| graph.operands(*id)).collect();
    }
    // Operands come before their users.
    opened.sort_unstable();
    let mut values: FxHashMap<ExprId, Residue> = FxHashMap::default();
    let itself = |id: ExprId| noise(scramble(scramble(!point) ^ (id.index() as u64)));
    for id in opened {
        let value = node_at(graph, id, point, |operand| {
            let known = values.get(&operand).copied();
            known.unwrap_or_else(|| itself(operand))
        });
        values.insert(id, value);
    }
    let value = |id: &ExprId| values.get(id).copied().unwrap_or_else(|| itself(*id));
    roots.iter().map(value).collect()
}

/// Whether the fingerprint is that of zero.
pub fn is_zero(fingerprint: Fingerprint) -> bool {
    fingerprint == [Residue::ZERO; 2]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::graph::ratio;

    #[test]
    fn residues_are_a_field() {
        let third = Residue::rational(&ratio(-1, 3));
        assert_eq!(third.times(Residue::rational(&ratio(-3, 1))), Residue::ONE);
        assert_eq!(third.as_fraction(), Some((-1, 3)));
        for prime in PRIMES {
            let large = Rational::new(BigInt::from(1), BigInt::from(prime));
            assert!(!Residue::rational(&large).vanishes());
        }
        let powers: BTreeSet<Residue> = (-130..=130)
            .map(|power| Residue::rational(&ratio(2, 1).pow(power)))
            .collect();
        assert_eq!(powers.len(), 261);
        assert_eq!(
            Residue::rational(&ratio(7, 2)).plus(Residue::rational(&ratio(-7, 2))),
            Residue::ZERO
        );
    }
}
