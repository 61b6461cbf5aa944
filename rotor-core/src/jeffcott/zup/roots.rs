//! Roots of a function of one variable between sampled sign changes.

/// A value of the function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// The variable.
    pub(crate) x: f64,
    /// The function.
    pub(crate) y: f64,
}

/// The roots between neighbouring samples of opposite sign, refined to the last digits, and the samples
/// that are roots themselves. `None` is a gap: no root is looked for next to it. Poles and jumps change
/// the sign too; the caller must check what comes out.
pub(crate) fn sign_changes(samples: &[Option<Sample>], f: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
    let mut roots: Vec<f64> = samples
        .iter()
        .flatten()
        .filter(|sample| sample.y == 0.0)
        .map(|sample| sample.x)
        .collect();
    for pair in samples.windows(2) {
        if let [Some(left), Some(right)] = *pair
            && left.y.signum() != right.y.signum()
            && left.y != 0.0
            && right.y != 0.0
        {
            roots.extend(refine(left, right, &f));
        }
    }
    roots.sort_by(f64::total_cmp);
    roots
}

/// The root in a bracket by the method of Oliveira and Takahashi, An enhancement of the bisection method
/// average performance preserving minmax optimality (2021): the regula falsi, truncated towards the
/// midpoint and projected so that it never needs more steps than bisection.
fn refine(left: Sample, right: Sample, f: impl Fn(f64) -> Option<f64>) -> Option<f64> {
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
            return Some(x);
        }
        if (next.y < 0.0) == (a.y < 0.0) {
            a = next;
        } else {
            b = next;
        }
        reach *= 0.5;
    }
    Some(if a.y.abs() <= b.y.abs() { a.x } else { b.x })
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

    #[test]
    fn every_root_to_the_last_digits() {
        let f = |x: f64| Some((9.0 * x).cos());
        let roots = sign_changes(&sampled(f, 16), f);
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
        assert_eq!(sign_changes(&sampled(f, 4), f), [0.5]);
    }

    #[test]
    fn no_root_is_looked_for_next_to_a_gap() {
        let f = |x: f64| (!(0.3..=0.7).contains(&x)).then_some(x - 0.5);
        assert_eq!(sign_changes(&sampled(f, 10), f), [0.0; 0]);
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
        let roots = sign_changes(&sampled(f, 2), counted);
        assert_eq!(roots.len(), 1);
        assert!((roots[0] - 0.3).abs() < 1e-12, "{roots:?}");
        assert!(steps.get() <= 56, "{} steps", steps.get());
    }
}
