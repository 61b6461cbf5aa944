//! Every instability region of the paper's rotor, none missed.
//!
//! At a speed the motion is stable where the four roots S of the quartic are real and positive. That changes with the speed
//! where two roots meet, at a zero of the discriminant, or where one is zero, at a zero of the last coefficient; the first
//! coefficient, 1 − Δ_d², is never zero. Both are polynomials in Ω² with whole coefficients, times a power of two, because
//! inputs are doubles. Their positive zeros are isolated by Descartes' rule of signs in whole numbers, and between neighbours
//! one speed is decided by the signs of whole numbers, so that no region is missed, however narrow, and none made up by
//! rounding.
//!
//! ```
//! use rotor_core::jeffcott::exact::regions::regions;
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! for region in regions(&Rotor::paper().coefficients()?)? {
//!     println!("unstable from {} to {}", region.lower, region.upper);
//! }
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

mod isolate;
mod surface;
#[cfg(test)]
mod tests;
mod whole;

use num_bigint::{BigInt, Sign};

use super::check_coefficients;
use crate::equations::{self, Coefficients};
use crate::error::{Error, SystemError};

use isolate::{Isolated, positive_roots};
use whole::{Dyadic, Whole};

/// A speed at which the motion changes, in units of the reference speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Boundary {
    pub(crate) speed: f64,
    /// Whether a root S is zero there, which begins or ends a simple region.
    pub(crate) is_simple: bool,
    /// Whether two roots S meet there, at a double root.
    pub(crate) is_meeting: bool,
}

/// How the motion is at all speeds between two neighbouring boundaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Verdict {
    /// Whether it neither grows nor decays.
    pub(crate) is_stable: bool,
    /// How many of the four roots S are not real: 0, 2 or 4.
    pub(crate) complex: usize,
}

/// All boundaries in ascending order, and one verdict more: before the first, between neighbours, beyond the last.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cells {
    pub(crate) boundaries: Vec<Boundary>,
    pub(crate) verdicts: Vec<Verdict>,
}

/// An interval of speeds in which the motion is unstable at every speed, and stable beside it, in units of the reference
/// speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnstableRange {
    /// Where it begins; 0 for a shaft that gives way at rest.
    pub lower: f64,
    /// Where it ends; infinite for one that has no end.
    pub upper: f64,
}

/// Every interval of speeds in which the motion is unstable, ascending. Regions that join are one interval, and those that
/// touch at one speed are too.
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for coefficients that are not finite or |Δ_d| ≥ 1; [`SystemError::Degenerate`] where two roots of
/// the quartic are one at every speed.
pub fn regions(c: &Coefficients) -> Result<Vec<UnstableRange>, Error> {
    Ok(cells(c, None)?
        .ranges(|verdict| !verdict.is_stable)
        .collect())
}

impl Cells {
    /// The intervals of speeds in which all verdicts are as wanted, neighbours joined, in ascending order.
    pub(super) fn ranges(
        self,
        is_wanted: impl Fn(&Verdict) -> bool,
    ) -> impl Iterator<Item = UnstableRange> {
        let starts =
            std::iter::once(0.0).chain(self.boundaries.iter().map(|boundary| boundary.speed));
        let ends = self.boundaries.iter().map(|boundary| boundary.speed);
        let ranges = starts.zip(ends.chain([f64::INFINITY]));
        let mut found: Vec<UnstableRange> = Vec::new();
        let mut was_wanted = false;
        for ((lower, upper), verdict) in ranges.zip(&self.verdicts) {
            let is_wanted = is_wanted(verdict);
            match found.last_mut() {
                _ if !is_wanted => {}
                Some(last) if was_wanted => last.upper = upper,
                _ => found.push(UnstableRange { lower, upper }),
            }
            was_wanted = is_wanted;
        }
        found.into_iter()
    }
}

/// The boundaries of a rotor's motion, and how it is between them; where two speeds are given, of those from the first to the
/// second and a little beyond.
pub(crate) fn cells(c: &Coefficients, within: Option<[f64; 2]>) -> Result<Cells, Error> {
    check_coefficients(c)?;
    let uniform = Cells {
        boundaries: Vec::new(),
        verdicts: vec![Verdict {
            is_stable: true,
            complex: 0,
        }],
    };
    let is_symmetric =
        c.epsilon_1 == 0.0 && c.epsilon_12 == 0.0 && c.epsilon_2 == 0.0 && c.disk_asymmetry == 0.0;
    if is_symmetric && equations::coupled_stiffness(c) > 0.0 {
        // Constant coefficients, no damping, positive stiffness: nothing grows.
        return Ok(uniform);
    }
    let quartic = Quartic(surface::quartic(c));
    let discriminant = quartic.discriminant();
    if discriminant.is_zero() {
        return Err(SystemError::Degenerate.into());
    }
    let octaves = within.map(|[lowest, highest]| {
        let exponent = |speed: f64| (2.0 * speed.log2()).floor() as i64;
        exponent(lowest)..exponent(highest) + 1
    });
    let roots = positive_roots(&discriminant.times(&quartic.last()), octaves);
    let samples: Vec<Sample> = between(&roots)
        .iter()
        .map(|speed| quartic.at(speed))
        .collect();
    let sides = roots.iter().zip(samples.windows(2));
    let boundaries = sides.map(|(root, sides)| {
        let is_simple = sides[0].last != sides[1].last;
        let is_meeting = sides[0].discriminant != sides[1].discriminant;
        // Both signs stay where two zeros are one.
        let is_double = !is_simple && !is_meeting;
        Boundary {
            speed: root.value.sqrt(),
            is_simple: is_simple || is_double,
            is_meeting: is_meeting || is_double,
        }
    });
    Ok(Cells {
        boundaries: boundaries.collect(),
        verdicts: samples.iter().map(|sample| sample.verdict).collect(),
    })
}

/// The speeds, ascending, at which a root S of the quartic is zero, a double one twice.
pub(super) fn simple_boundaries(c: &Coefficients) -> Vec<f64> {
    let roots = positive_roots(&Quartic(surface::quartic(c)).last(), None);
    let speeds = roots
        .iter()
        .flat_map(|root| std::iter::repeat_n(root.value.sqrt(), root.count));
    speeds.collect()
}

/// A squared speed before the first root, between neighbours and beyond the last.
fn between(roots: &[Isolated]) -> Vec<Dyadic> {
    let zero = Dyadic {
        mantissa: BigInt::ZERO,
        places: 0,
    };
    let beyond = roots.last().map_or_else(
        || Dyadic {
            mantissa: BigInt::from(1),
            places: 0,
        },
        |last| Dyadic {
            mantissa: &last.high.mantissa << 2,
            places: last.high.places,
        },
    );
    let lows = std::iter::once(&zero).chain(roots.iter().map(|root| &root.high));
    let highs = roots.iter().map(|root| &root.low).chain([&beyond]);
    let pairs = lows.zip(highs);
    let samples = pairs.map(|(low, high)| {
        if low.is_less(high) {
            Dyadic::between(low, high)
        } else {
            low.clone()
        }
    });
    samples.collect()
}

/// Coefficients of Φ in powers of P = ωϖ, lowest first, polynomials in Ω².
struct Quartic([Whole; 5]);

/// What the quartic is at a speed.
struct Sample {
    verdict: Verdict,
    discriminant: Sign,
    last: Sign,
}

impl Quartic {
    /// 27 times the discriminant.
    fn discriminant(&self) -> Whole {
        let [e, d, c, b, a] = &self.0;
        let ae = a.times(e);
        let (bd, cc) = (b.times(d), c.times(c));
        let first = ae.scaled(12).plus(&bd.scaled(-3)).plus(&cc);
        let squares = a.times(d).times(d).plus(&e.times(b).times(b));
        let second = ae
            .scaled(72)
            .plus(&bd.scaled(9))
            .plus(&cc.scaled(-2))
            .times(c);
        let second = second.plus(&squares.scaled(-27));
        let cube = first.times(&first).times(&first);
        cube.scaled(4).plus(&second.times(&second).scaled(-1))
    }

    /// Φ at P = Ω², where S is zero.
    fn last(&self) -> Whole {
        let raised = self.0.iter().enumerate();
        raised.fold(Whole::new(Vec::new()), |sum, (power, coefficient)| {
            sum.plus(&coefficient.raised(power))
        })
    }

    /// Decides a squared speed.
    fn at(&self, speed_squared: &Dyadic) -> Sample {
        // The coefficients have Ω⁴ at most.
        let [e, d, c, b, a] = &self
            .0
            .each_ref()
            .map(|coefficient| coefficient.at(speed_squared, 2));
        let (aa, bb, cc) = (a * a, b * b, c * c);
        let (ae, bd, ac) = (a * e, b * d, a * c);
        let first: BigInt = 12 * &ae - 3 * &bd + &cc;
        let second: BigInt = (72 * &ae + 9 * &bd - 2 * &cc) * c - 27 * (a * d * d + e * &bb);
        let discriminant: BigInt = 4 * &first * &first * &first - &second * &second;
        let discriminant = discriminant.sign();
        let spread: BigInt = 8 * &ac - 3 * &bb;
        let rest: BigInt = 64 * &aa * &ae - 16 * &aa * (&cc + &bd) + 16 * &ac * &bb - 3 * &bb * &bb;
        let complex = match discriminant {
            Sign::Minus => 2,
            _ if spread.sign() == Sign::Minus && rest.sign() == Sign::Minus => 0,
            _ => 4,
        };
        // All roots P that are real are below Ω² exactly where Φ and its derivatives by P are positive there.
        let powers = [e, d, c, b, a].map(BigInt::clone).into();
        let around = Whole::new(powers).around(speed_squared);
        let is_below = around
            .coefficients()
            .iter()
            .all(|value| value.sign() == Sign::Plus);
        Sample {
            verdict: Verdict {
                is_stable: complex == 0 && is_below,
                complex,
            },
            discriminant,
            last: around
                .coefficients()
                .first()
                .map_or(Sign::NoSign, BigInt::sign),
        }
    }
}
