//! The exact ends of the combination region (CIR): speeds at which two roots S of the quartic meet.
//!
//! Three ways lead from the region's start to its ends, each where those before it find none.
//!
//! 1. With $D\,Φ = m_1 m_2 − |m_{12}|^2$ (source of `frequency_equation`) the point m₁ = m₂ = 0 lies inside the region,
//!    or is all of it where m₁₂ = 0 (the exact zero unstable point). The ends of m₁ m₂ = t²|m₁₂|² are followed in (ϖ, Ω)
//!    from t = 0 to 1, each stage by Newton's iteration. Narrow regions keep all their digits and cannot be missed,
//!    however large the asymmetries are that nearly cancel.
//! 2. A region so wide that it runs into another one, or whose roots meet below zero where ω is not real, is found by a
//!    search along Ω for the nearest speeds with complex roots. Roots that meet below zero leave the motion unstable on
//!    both sides: there the region passes into a simple one.
//! 3. What the search steps over is found among all ends, isolated in whole numbers.

use super::ends::Ends;
use super::frequency_equation::{Displacement, Minors, phi_from_product};
use super::number::Jet;
use super::quartic::squared_offsets;
use super::regions::{UnstableRange, cells};
use super::whirl::whirl_frequencies;
use crate::equations::Coefficients;
use crate::error::{Error, RegionError, require};
use crate::region::RegionKind;

/// Cap on Newton steps from one predicted point; 3 to 5 are common.
const NEWTON_STEPS: usize = 20;
/// The smallest stage of the growth before an end counts as lost.
const SMALLEST_STAGE: f64 = 1.0 / 256.0;
/// The search's step, as a part of the start.
const SEARCH_STEP: f64 = 1.0 / 256.0;
/// How many steps on each side of the start the search looks for a region.
const SEARCH_STEPS: i32 = 128;
/// Bisections of one step of the search before Newton's iteration.
const BISECTIONS: usize = 16;
/// Newton steps of this relative length or less that no longer get shorter are rounding.
const ROUNDING: f64 = 1e-11;

/// The exact ends of the combination region (CIR) that grows from `start`, the speed Ω_c of Eq. (16) at which
/// ω₁ + ω₂ = 2Ω, in units of the reference speed.
///
/// The ends are zeros of the discriminant of the quartic in S. Between them two roots are complex and the motion is
/// unstable; it is stable just outside unless another region joins there.
///
/// # Errors
///
/// [`SystemError::OutOfRange`](crate::error::SystemError::OutOfRange) for a `start` that is not positive and finite or coefficients that are not finite;
/// [`RegionError::StiffnessNotPositive`] where δ ≤ γ²; [`RegionError::NoExactEnds`] where β ≥ 2, or where
/// no such pair of ends exists near the start because the region has merged with others.
pub fn combination_ends(c: &Coefficients, start: f64) -> Result<Ends, Error> {
    require("start", start, start > 0.0, "a positive number")?;
    let [_, partner, ..] = whirl_frequencies(c, start)?;
    if c.beta >= 2.0 {
        let reason = "no whirl frequencies add up to twice the speed, as beta >= 2";
        return Err(RegionError::NoExactEnds {
            kind: RegionKind::Combination,
            reason,
        }
        .into());
    }
    let start = Point {
        x: partner,
        y: start,
    };
    // Followed too far, an end may come out on the axis of negative speeds, which mirrors that of positive ones.
    let are_positive = |ends: &[f64; 2]| ends.iter().all(|end| *end > 0.0);
    let found = by_coupling(c, start).filter(are_positive);
    if let Some([first, second]) = found.or_else(|| by_search(c, start.y)) {
        return Ok(Ends {
            lower: first.min(second),
            upper: first.max(second),
        });
    }
    by_isolation(c, start.y)?.ok_or_else(|| {
        RegionError::NoExactEnds {
            kind: RegionKind::Combination,
            reason: "no roots of the quartic meet near the start, or they do so only together with another region",
        }
        .into()
    })
}

/// A point in the plane of two unknowns: (ϖ, Ω) or (ωϖ, Ω²).
#[derive(Clone, Copy, Debug)]
struct Point {
    x: f64,
    y: f64,
}

impl Point {
    /// The point `factor` times `direction` further.
    fn along(self, direction: Self, factor: f64) -> Self {
        Self {
            x: self.x + factor * direction.x,
            y: self.y + factor * direction.y,
        }
    }

    /// The larger coordinate of the vector from `other`, each in parts of this point's. The speed may be a million times
    /// the frequency ϖ, and both are to be found to the last digit; an x near zero counts by its natural size.
    fn distance(self, other: Self) -> f64 {
        let size = self.x.abs() + self.y.abs().min(1.0);
        let by_x = (self.x - other.x) / size;
        let by_y = (self.y - other.y) / self.y;
        by_x.abs().max(by_y.abs())
    }
}

/// The solution (x, y) of two linear equations, each as [factor of x, factor of y, right side].
fn solve([a, b, p]: [f64; 3], [c, d, q]: [f64; 3]) -> Point {
    let determinant = a * d - b * c;
    Point {
        x: (p * d - b * q) / determinant,
        y: (a * q - p * c) / determinant,
    }
}

/// Newton's iteration from `start` with the steps `correction`, until they are at rounding. `None` if they grow.
fn newton(start: Point, correction: impl Fn(Point) -> Point) -> Option<Point> {
    let mut point = start;
    let mut last = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let next = point.along(correction(point), -1.0);
        let length = point.distance(next);
        if length <= 2.0 * f64::EPSILON {
            return Some(next);
        }
        // Not a number where the equations are singular.
        if length.is_nan() || length >= 0.9 * last {
            return (last < ROUNDING).then_some(point);
        }
        (point, last) = (next, length);
    }
    None
}

/// Follows `end(point, part)` from `start` (part 0) to part 1; `velocity` is its derivative by the part at 0.
fn follow(
    start: Point,
    mut velocity: Point,
    end: impl Fn(Point, f64) -> Option<Point>,
) -> Option<Point> {
    if velocity.x == 0.0 && velocity.y == 0.0 {
        return Some(start);
    }
    let (mut point, mut part, mut stage): (Point, f64, f64) = (start, 0.0, 1.0);
    while part < 1.0 {
        let next = (part + stage).min(1.0);
        let predicted = point.along(velocity, next - part);
        // A corrector that moves as far as half the prediction may have jumped to another solution.
        let trusted = |found: &Point| predicted.distance(*found) <= 0.5 * predicted.distance(point);
        match end(predicted, next).filter(trusted) {
            Some(found) => {
                let taken = next - part;
                velocity = Point {
                    x: (found.x - point.x) / taken,
                    y: (found.y - point.y) / taken,
                };
                (point, part, stage) = (found, next, 2.0 * stage);
            }
            None => stage *= 0.5,
        }
        if stage < SMALLEST_STAGE {
            return None;
        }
    }
    Some(point)
}

/// How an end leaves the point m₁ = m₂ = 0 per unit of coupling: with m₁, m₂ linear and m₁₂ constant, m₁ m₂ = |m₁₂|²
/// and its derivative by ϖ vanish at m₁ = |m₁₂| √(−∂m₁/∂m₂), m₂ = |m₁₂| √(−∂m₂/∂m₁).
fn departure(minors: &Minors<Jet>) -> Option<Point> {
    let Minors {
        first,
        second,
        coupling_squared,
        ..
    } = minors;
    let coupling = coupling_squared.value.sqrt();
    let ratio = -first.x / second.x;
    let velocity = solve(
        [first.x, first.y, coupling * ratio.sqrt()],
        [second.x, second.y, coupling / ratio.sqrt()],
    );
    (velocity.x.is_finite() && velocity.y.is_finite()).then_some(velocity)
}

/// The minors at (ϖ, Ω) with the dominant displacements of the two whirls at `start` kept.
fn minors_near(c: &Coefficients, start: Point) -> impl Fn(Point) -> Minors<Jet> {
    let kept =
        [2.0 * start.y - start.x, start.x].map(|omega| Displacement::dominant(c, omega, start.y));
    move |point| {
        let [partner, speed] = Jet::variables(point.x, point.y);
        Minors::at(c, kept, partner, speed)
    }
}

/// The first way: both ends' speeds.
fn by_coupling(c: &Coefficients, start: Point) -> Option<[f64; 2]> {
    let minors = minors_near(c, start);
    let center = newton(start, |point| {
        let Minors { first, second, .. } = minors(point);
        solve(
            [first.x, first.y, first.value],
            [second.x, second.y, second.value],
        )
    })?;
    let velocity = departure(&minors(center))?;
    let end = |predicted: Point, part: f64| {
        newton(predicted, |point| {
            let Minors {
                first,
                second,
                coupling_squared,
                ..
            } = minors(point);
            let gap = first * second - coupling_squared * (part * part);
            // Φ is even in s = Ω − ϖ, so its derivative by ϖ vanishes at s = 0 as well, where no two roots S meet:
            // the second equation is that derivative over s.
            let offset = point.x - point.y;
            let turning = gap.x / offset;
            solve(
                [gap.x, gap.y, gap.value],
                [
                    (gap.xx - turning) / offset,
                    (gap.xy + turning) / offset,
                    turning,
                ],
            )
        })
    };
    let ends = [1.0, -1.0].map(|side| {
        follow(
            center,
            Point {
                x: side * velocity.x,
                y: side * velocity.y,
            },
            end,
        )
    });
    let [first, second] = ends;
    // Where D vanishes as well no two roots need meet.
    let sound = |end: &Point| minors(*end).are_sound();
    Some([first.filter(sound)?.y, second.filter(sound)?.y])
}

/// The second way: both ends' speeds.
fn by_search(c: &Coefficients, start: f64) -> Option<[f64; 2]> {
    let step = start * SEARCH_STEP;
    let inside = (0..=SEARCH_STEPS)
        .flat_map(|count| {
            [
                start - f64::from(count) * step,
                start + f64::from(count) * step,
            ]
        })
        .find(|speed| complex_roots(c, *speed) > 0)?;
    Some([edge(c, inside, -step)?, edge(c, inside, step)?])
}

/// How many of the four roots S are not real.
fn complex_roots(c: &Coefficients, speed: f64) -> usize {
    squared_offsets(c, speed).map_or(0, |roots| {
        roots.iter().filter(|root| root.im != 0.0).count()
    })
}

/// The first speed from `inside` in steps of `step` at which the number of complex roots changes.
fn edge(c: &Coefficients, inside: f64, step: f64) -> Option<f64> {
    let count = complex_roots(c, inside);
    let steps = (1..=4 * SEARCH_STEPS).map(|index| inside + f64::from(index) * step);
    let mut outside = steps
        .take_while(|speed| *speed > 0.0)
        .find(|speed| complex_roots(c, *speed) != count)?;
    let mut inside = outside - step;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (inside + outside);
        if complex_roots(c, middle) == count {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    // More roots are complex on one side: there the pair that is about to meet is the one with the least imaginary part.
    let apart = if complex_roots(c, outside) > count {
        outside
    } else {
        inside
    };
    let roots = squared_offsets(c, apart).ok()?;
    let meeting = roots
        .iter()
        .filter(|root| root.im > 0.0)
        .min_by(|a, b| a.im.total_cmp(&b.im))?;
    let end = newton(
        Point {
            x: apart * apart - meeting.re,
            y: apart * apart,
        },
        |point| {
            let [product, speed_squared] = Jet::variables(point.x, point.y);
            let phi = phi_from_product(c, speed_squared, product);
            solve([phi.x, phi.y, phi.value], [phi.xx, phi.xy, phi.x])
        },
    )?;
    Some(end.y.sqrt()).filter(|speed| (speed - inside).abs() <= step.abs())
}

/// The third way: of all intervals in which roots S are complex the one whose middle is nearest to the start, within the reach
/// of the search.
fn by_isolation(c: &Coefficients, start: f64) -> Result<Option<Ends>, Error> {
    let distance = |ends: &Ends| (0.5 * (ends.lower + ends.upper) - start).abs();
    let reach = f64::from(SEARCH_STEPS) * SEARCH_STEP * start;
    // What is centred within reach begins above zero, and ends as far from its centre.
    let window = [start / 16.0, 2.0 * (start + reach)];
    let all = cells(c, Some(window))?.ranges(|verdict| verdict.complex > 0);
    let bounded = all.filter(|range| range.lower > 0.0 && range.upper.is_finite());
    let ends = bounded.map(|UnstableRange { lower, upper }| Ends { lower, upper });
    Ok(ends
        .filter(|ends| distance(ends) <= reach)
        .min_by(|a, b| distance(a).total_cmp(&distance(b))))
}
