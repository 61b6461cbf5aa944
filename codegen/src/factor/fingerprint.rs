//! Values at random points of a prime field, by which equal expressions are told.
//!
//! Rational operations are done in the field with p = 2⁶¹ − 1; any other function of an operand gets a value drawn by
//! the operand's fingerprint, so that it equals just itself. Two polynomials of degree d that differ agree at both points
//! with a probability of at most (d/p)² (Schwartz and Zippel), 1e-30 for the degrees of formulas. The points are fixed,
//! so that the same formulas always give the same code.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use crate::graph::{ExprId, Function, Graph, Node, Rational, SymbolId};

/// The prime 2⁶¹ − 1.
const PRIME: u64 = (1 << 61) - 1;

/// An element of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Residue(u64);

impl Residue {
    /// 0
    pub const ZERO: Self = Self(0);
    /// 1
    pub const ONE: Self = Self(1);

    /// The residue of a rational number; one whose denominator the prime divides counts as 0.
    pub fn rational(value: &Rational) -> Self {
        // Most constants of formulas are whole and small, and an inverse takes a hundred products.
        if let Some(small) = value.to_i64().and_then(Self::small) {
            return small;
        }
        Self::whole(&value.numerator()).times(Self::whole(&value.denominator()).inverse())
    }

    fn small(value: i64) -> Option<Self> {
        let size = Some(value.unsigned_abs()).filter(|size| *size < PRIME)?;
        let residue = Self(size);
        Some(if value < 0 {
            residue.negative()
        } else {
            residue
        })
    }

    fn whole(value: &BigInt) -> Self {
        if let Some(small) = value.to_i64().and_then(Self::small) {
            return small;
        }
        let modulus = BigInt::from(PRIME);
        let reduced = ((value % &modulus) + &modulus) % &modulus;
        Self(reduced.to_u64().unwrap_or(0))
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= PRIME { sum - PRIME } else { sum })
    }

    /// The negative.
    pub fn negative(self) -> Self {
        Self(if self.0 == 0 { 0 } else { PRIME - self.0 })
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        // 2⁶¹ is 1 in the field: the bits from there on are added to those below.
        let wide = u128::from(self.0) * u128::from(other.0);
        let (low, high) = ((wide as u64) & PRIME, (wide >> 61) as u64);
        Self(low).plus(Self(high))
    }

    /// The power.
    pub fn power(self, exponent: u64) -> Self {
        let (mut result, mut base, mut rest) = (Self::ONE, self, exponent);
        while rest > 0 {
            if rest % 2 == 1 {
                result = result.times(base);
            }
            base = base.times(base);
            rest /= 2;
        }
        result
    }

    /// The inverse; that of 0 is 0.
    pub fn inverse(self) -> Self {
        self.power(PRIME - 2)
    }

    /// The inverses of many, of which only one is worked out: the others are products.
    pub fn inverses(residues: &[Self]) -> Vec<Self> {
        let mut product = Self::ONE;
        let mut inverses = Vec::with_capacity(residues.len());
        for residue in residues {
            inverses.push(product);
            if *residue != Self::ZERO {
                product = product.times(*residue);
            }
        }
        let mut of_rest = product.inverse();
        for (inverse, residue) in inverses.iter_mut().zip(residues).rev() {
            if *residue == Self::ZERO {
                *inverse = Self::ZERO;
            } else {
                *inverse = inverse.times(of_rest);
                of_rest = of_rest.times(*residue);
            }
        }
        inverses
    }

    /// The fraction with the smallest parts whose residue this is, if any has parts up to 64.
    pub fn as_fraction(self) -> Option<(i64, i64)> {
        (1..=64_i64).find_map(|denominator| {
            let scaled = self.times(Self(denominator.unsigned_abs()));
            let size = scaled.0.min(PRIME - scaled.0);
            let numerator = i64::try_from(size).ok().filter(|size| *size <= 64)?;
            Some((
                if scaled.0 == size {
                    numerator
                } else {
                    -numerator
                },
                denominator,
            ))
        })
    }
}

/// Deterministic noise (the finaliser of splitmix64).
fn scramble(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (z ^ (z >> 31)) % PRIME
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
    Residue(scramble(scramble(point) ^ (symbol.index() as u64)))
}

/// The value of a function that is no sum or product, drawn by its kind and its operands.
pub fn drawn(kind: u64, point: u64, operands: impl Iterator<Item = Residue>) -> Residue {
    let start =
        scramble(kind.wrapping_mul(0x0001_0000_0001) ^ point.wrapping_mul(0xD6E8_FEB8_6659_FD93));
    Residue(operands.fold(start, |seed, operand| scramble(seed ^ operand.0)))
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
                    let base = match value(*operand) {
                        // A division by zero is no number, least of all zero.
                        Residue::ZERO if *exponent < 0 => drawn(3_000_000, &[]),
                        divisor if *exponent < 0 => divisor.inverse(),
                        factor => factor,
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

/// The values of all nodes that the roots need at a point, by position; others are 0.
pub fn all_at(graph: &Graph, roots: &[ExprId], point: u64) -> Vec<Residue> {
    let mut values = vec![Residue::ZERO; graph.len()];
    for id in graph.reachable(roots) {
        let value = node_at(graph, id, point, |operand| values[operand.index()]);
        values[id.index()] = value;
    }
    values
}

/// The values of the roots at a point, where what lies deeper than so many operations, and every function that is neither
/// a sum nor a product, stands for itself, like a symbol: what is equal so is equal.
pub fn near(graph: &Graph, roots: &[ExprId], depth: usize, point: u64) -> Vec<Residue> {
    let mut opened: BTreeSet<ExprId> = BTreeSet::new();
    let mut level: BTreeSet<ExprId> = roots.iter().copied().collect();
    for _ in 0..depth {
        let inner = level.iter().filter(|id| !opened.contains(id)).copied();
        let inner: Vec<ExprId> = inner
            .filter(|id| !matches!(graph.node(*id), Node::Apply(..) | Node::Tabulated { .. }))
            .collect();
        opened.extend(&inner);
        level = inner.iter().flat_map(|id| graph.operands(*id)).collect();
    }
    let mut values: BTreeMap<ExprId, Residue> = BTreeMap::new();
    let itself = |id: ExprId| Residue(scramble(scramble(!point) ^ (id.index() as u64)));
    for id in opened {
        let value = node_at(graph, id, point, |operand| {
            values.get(&operand).copied().unwrap_or(itself(operand))
        });
        values.insert(id, value);
    }
    let value = |id: &ExprId| values.get(id).copied().unwrap_or(itself(*id));
    roots.iter().map(value).collect()
}

/// Whether the fingerprint is that of zero.
pub fn is_zero(fingerprint: Fingerprint) -> bool {
    fingerprint == [Residue::ZERO; 2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::ratio;

    #[test]
    fn residues_are_a_field() {
        let third = Residue::rational(&ratio(-1, 3));
        assert_eq!(third.times(Residue::rational(&ratio(-3, 1))), Residue::ONE);
        assert_eq!(third.as_fraction(), Some((-1, 3)));
        assert_eq!(
            Residue::rational(&ratio(7, 2)).plus(Residue::rational(&ratio(-7, 2))),
            Residue::ZERO
        );
    }
}
