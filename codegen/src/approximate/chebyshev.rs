//! Chebyshev interpolation on [−1, 1].
//!
//! The interpolant through the roots of $T_n$ is within a small factor of the best polynomial of
//! its degree, and its coefficients show how many of them are needed. The roots of $T_{3n}$
//! contain those of $T_n$, one in three: the other two are where an interpolant is checked.

use std::f64::consts::PI;

/// The roots of $T_n$, ascending.
pub(super) fn roots(count: usize) -> Vec<f64> {
    // The sine of an odd argument: symmetric to the bit, and 0 in the middle where n is odd.
    (0..count)
        .map(|index| {
            let distance = 2.0 * index as f64 + 1.0 - count as f64;
            (PI * distance / (2.0 * count as f64)).sin()
        })
        .collect()
}

/// Coefficients $c_0 … c_{n-1}$ of $\sum_k c_k T_k(t)$, which takes the `values` at `roots(n)`.
pub(super) fn coefficients(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let angle = PI / (2.0 * count as f64);
    // The mean is taken out first, so that what is rounded is the variation only.
    let mean = values.iter().sum::<f64>() / count as f64;
    let mut coefficients: Vec<f64> = (0..count)
        .map(|degree| {
            let sum: f64 = (values.iter().enumerate())
                .map(|(index, value)| {
                    // T_k(cos θ) = cos kθ; roots ascend, so θ descends. Whole quarter turns are
                    // taken out of the angle in integers.
                    let steps = degree * (2 * (count - 1 - index) + 1) % (4 * count);
                    (value - mean) * (angle * steps as f64).cos()
                })
                .sum();
            2.0 * sum / count as f64
        })
        .collect();
    if let Some(constant) = coefficients.first_mut() {
        *constant = 0.5 * *constant + mean;
    }
    coefficients
}

/// Rewrites a Chebyshev series in powers of $t$: $\sum_k c_k T_k(t) = \sum_k a_k t^k$.
///
/// The powers are well conditioned here since the $c_k$ of an accepted piece fall faster than the
/// integer coefficients of $T_k$ grow, about $2.4^k$.
pub(super) fn to_powers(chebyshev: &[f64]) -> Vec<f64> {
    let count = chebyshev.len();
    let mut powers = vec![0.0; count];
    // T_0 = 1, T_1 = t, T_{k+1} = 2t T_k − T_{k−1}: integers, exact in floating point.
    let mut previous = vec![0.0; count];
    let mut current = vec![0.0; count];
    if let Some(constant) = current.first_mut() {
        *constant = 1.0;
    }
    for (degree, coefficient) in chebyshev.iter().enumerate() {
        for (power, term) in powers.iter_mut().zip(&current) {
            *power += coefficient * term;
        }
        let factor = if degree == 0 { 1.0 } else { 2.0 };
        let shifted = std::iter::once(0.0).chain(current.iter().map(|term| factor * term));
        let next = shifted
            .zip(&previous)
            .map(|(raised, lower)| raised - lower)
            .collect();
        previous = std::mem::replace(&mut current, next);
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_root_in_three_is_a_node() {
        let fine = roots(39);
        for (index, node) in roots(13).into_iter().enumerate() {
            assert!((fine[3 * index + 1] - node).abs() < 2e-16);
        }
        assert_eq!(fine[19], 0.0);
        assert!(fine.is_sorted() && fine[0] > -1.0 && fine[38] < 1.0);
    }

    #[test]
    fn a_polynomial_is_found_again() {
        let polynomial = |t: f64| 3.0 - t + 0.5 * t.powi(2) + 7.0 * t.powi(5);
        let values: Vec<f64> = roots(8).into_iter().map(polynomial).collect();
        let powers = to_powers(&coefficients(&values));
        for (found, expected) in powers.iter().zip([3.0, -1.0, 0.5, 0.0, 0.0, 7.0, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
    }

    #[test]
    fn the_powers_of_a_chebyshev_polynomial() {
        assert_eq!(
            to_powers(&[0.0, 0.0, 0.0, 0.0, 1.0]),
            [1.0, 0.0, -8.0, 0.0, 8.0]
        );
        assert_eq!(to_powers(&[2.0, 1.0, 0.0, 1.0]), [2.0, -2.0, 0.0, 4.0]);
        assert_eq!(to_powers(&[4.0]), [4.0]);
    }
}
