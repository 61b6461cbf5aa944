//! Roots of a function of one variable between sampled sign changes.

/// A value of the function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// The variable.
    pub(crate) x: f64,
    /// The function.
    pub(crate) y: f64,
}

/// Where the function is zero, or comes near to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// The variable.
    pub(crate) x: f64,
    /// Whether the function goes through zero there, far below what it is at the samples beside: poles and jumps change the sign
    /// too, and between samples of one sign the function may come near to zero only.
    pub(crate) is_crossing: bool,
}

/// What is left of a sample at a root in the last digits of the variable, where samples are much farther apart than these.
const LEFT: f64 = 1e-3;
/// Steps towards the least value between samples of one sign: each takes 0.38 of the distance away.
const DIPS: usize = 80;

/// The roots between neighbouring samples of opposite sign, refined to the last digits, the samples that are roots
/// themselves, and between three samples of one sign of which the middle one is nearest to zero two roots, or the place where
/// the function is nearest to it. `None` is a gap: no root is looked for next to it.
pub(crate) fn sign_changes(
    samples: &[Option<Sample>],
    f: impl Fn(f64) -> Option<f64>,
) -> Vec<Found> {
    let of_samples = samples.iter().flatten().filter(|sample| sample.y == 0.0);
    let mut roots: Vec<Found> = of_samples
        .map(|sample| Found {
            x: sample.x,
            is_crossing: true,
        })
        .collect();
    for pair in samples.windows(2) {
        if let [Some(left), Some(right)] = *pair
            && left.y.signum() != right.y.signum()
            && left.y != 0.0
            && right.y != 0.0
        {
            roots.extend(crossing(left, right, &f));
        }
    }
    for triple in samples.windows(3) {
        if let [Some(left), Some(middle), Some(right)] = *triple
            && left.y * middle.y > 0.0
            && right.y * middle.y > 0.0
            && middle.y.abs() < left.y.abs()
            && middle.y.abs() <= right.y.abs()
        {
            roots.extend(dip([left, middle, right], &f).into_iter().flatten());
        }
    }
    roots.sort_by(|a, b| a.x.total_cmp(&b.x));
    roots
}

/// The root in a bracket.
fn crossing(left: Sample, right: Sample, f: impl Fn(f64) -> Option<f64>) -> Option<Found> {
    let Sample { x, y } = refine(left, right, f)?;
    let is_crossing = y.abs() <= LEFT * left.y.abs().max(right.y.abs());
    Some(Found { x, is_crossing })
}

/// Two roots beside the least value between three samples of one sign, or its place where that is of the same sign; by golden
/// sections.
fn dip([left, middle, right]: [Sample; 3], f: impl Fn(f64) -> Option<f64>) -> Option<Vec<Found>> {
    let section = 1.5 - 1.25_f64.sqrt();
    let (mut low, mut least, mut high) = (left, middle, right);
    for _ in 0..DIPS {
        let is_upper = high.x - least.x > least.x - low.x;
        let towards = if is_upper { high } else { low };
        let x = least.x + section * (towards.x - least.x);
        if x == least.x || x == towards.x {
            break;
        }
        let next = Sample { x, y: f(x)? };
        if next.y == 0.0 || (next.y < 0.0) != (middle.y < 0.0) {
            let beside = [crossing(low, next, &f), crossing(next, high, &f)];
            return Some(beside.into_iter().flatten().collect());
        }
        let is_less = next.y.abs() < least.y.abs();
        (low, least, high) = match (is_less, is_upper) {
            (true, true) => (least, next, high),
            (true, false) => (low, next, least),
            (false, true) => (low, least, next),
            (false, false) => (next, least, high),
        };
    }
    Some(vec![Found {
        x: least.x,
        is_crossing: false,
    }])
}

/// The root in a bracket by the method of Oliveira and Takahashi, An enhancement of the bisection method
/// average performance preserving minmax optimality (2021): the regula falsi, truncated towards the
/// midpoint and projected so that it never needs more steps than bisection.
fn refine(left: Sample, right: Sample, f: impl Fn(f64) -> Option<f64>) -> Option<Sample> {
    let (mut a, mut b) = (left, right);
    let tolerance = 2.0 * f64::EPSILON * right.x.abs().max(left.x.abs());
    let steps = ((right.x - left.x) / tolerance).log2().ceil().max(0.0) + 1.0;
    let mut reach = tolerance * steps.exp2();
    let truncation = 0.2 / (right.x - left.x);
    while b.x - a.x > 2.0 * tolerance {
        let middle = 0.5 * (a.x + b.x);
        let falsi = (b.y * a.x - a.y * b.x) / (b.y - a.y);
        let towards = (middle - falsi).signum();
        let shift = truncation * (b.x - a.x).powi(2);
        let truncated = if shift <= (middle - falsi).abs() {
            falsi + towards * shift
        } else {
            middle
        };
        let radius = reach - 0.5 * (b.x - a.x);
        let x = if (truncated - middle).abs() <= radius {
            truncated
        } else {
            middle - towards * radius.max(0.0)
        };
        let next = Sample { x, y: f(x)? };
        if next.y == 0.0 {
            return Some(next);
        }
        if (next.y < 0.0) == (a.y < 0.0) {
            a = next;
        } else {
            b = next;
        }
        reach *= 0.5;
    }
    Some(if a.y.abs() <= b.y.abs() { a } else { b })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64) -> Option<f64>, cells: i32) -> Vec<Option<Sample>> {
        (0..=cells)
            .map(|i| f64::from(i) / f64::from(cells))
            .map(|x| f(x).map(|y| Sample { x, y }))
            .collect()
    }

    fn crossings(samples: &[Option<Sample>], f: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
        let found = sign_changes(samples, f).into_iter();
        found
            .filter(|found| found.is_crossing)
            .map(|found| found.x)
            .collect()
    }

    #[test]
    fn every_root_to_the_last_digits() {
        let f = |x: f64| Some((9.0 * x).cos());
        let roots = crossings(&sampled(f, 16), f);
        let expected = [1.0, 3.0, 5.0].map(|k| k * std::f64::consts::FRAC_PI_2 / 9.0);
        assert_eq!(roots.len(), 3);
        for (root, expected) in roots.into_iter().zip(expected) {
            assert!(
                (root - expected).abs() <= 4.0 * f64::EPSILON * expected,
                "{root} {expected}"
            );
        }
    }

    #[test]
    fn a_sample_that_is_a_root_is_found_once() {
        let f = |x: f64| Some(x - 0.5);
        assert_eq!(crossings(&sampled(f, 4), f), [0.5]);
    }

    #[test]
    fn no_root_is_looked_for_next_to_a_gap() {
        let f = |x: f64| (!(0.3..=0.7).contains(&x)).then_some(x - 0.5);
        assert_eq!(crossings(&sampled(f, 10), f), [0.0; 0]);
    }

    #[test]
    fn a_bracket_takes_hardly_more_steps_than_bisection() {
        // Flat at the root: the regula falsi alone would need thousands of steps.
        let steps = std::cell::Cell::new(0);
        let f = |x: f64| Some((x - 0.3).powi(9));
        let counted = |x| {
            steps.set(steps.get() + 1);
            f(x)
        };
        let roots = crossings(&sampled(f, 2), counted);
        assert_eq!(roots.len(), 1);
        assert!((roots[0] - 0.3).abs() < 1e-12, "{roots:?}");
        assert!(steps.get() <= 56, "{} steps", steps.get());
    }

    #[test]
    fn two_roots_between_samples_and_a_place_where_there_are_none() {
        for apart in [1e-3, 1e-6] {
            let f = |x: f64| Some((x - 0.3).powi(2) - apart * apart);
            let roots = crossings(&sampled(f, 8), f);
            assert_eq!(roots.len(), 2, "{roots:?}");
            for (root, expected) in roots.into_iter().zip([0.3 - apart, 0.3 + apart]) {
                assert!(
                    (root - expected).abs() < 1e-9 * apart + 1e-16 / apart,
                    "{root}"
                );
            }
        }
        let f = |x: f64| Some((x - 0.3).powi(2) + 1e-20);
        let found = sign_changes(&sampled(f, 8), f);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].x - 0.3).abs() < 1e-7 && !found[0].is_crossing);
    }

    #[test]
    fn a_pole_is_no_crossing() {
        let f = |x: f64| Some(1.0 / (x - 0.3));
        assert_eq!(crossings(&sampled(f, 8), f), [0.0; 0]);
    }
}
