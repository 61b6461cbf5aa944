//! Adaptive Gauss–Legendre quadrature.
//!
//! A panel is integrated with a low and a high order; three times the distance of the two is its
//! error estimate. The high order is the one that is used, so that the estimate belongs to a worse
//! rule than the answer: it errs on the safe side. While the estimates add up to more than is allowed,
//! the panel with the largest one is bisected. So panels are graded by themselves towards an end
//! at which the integrand behaves as $\sqrt y$ or $y^3 \log y$, and panels whose share of the
//! total does not matter are left alone. The ends themselves are never abscissae.

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use gauss_quad::legendre::GaussLegendre;

/// Order of the rule that only serves the error estimate: 11.
const LOW_ORDER: NonZeroUsize = NonZeroUsize::MIN.saturating_add(10);

/// Order of the rule whose value is used: 15.
const HIGH_ORDER: NonZeroUsize = NonZeroUsize::MIN.saturating_add(14);

/// The most panels of one integral: work is bounded by this times the two orders.
///
/// $y^{-1/2}$ at an end, the worst that is meant to pass, needs about a hundred.
const MAXIMUM_PANELS: usize = 256;

/// What the distance of the two orders is multiplied by to be an estimate of the error.
///
/// At an end like $y^{-1/2}$ the error falls only as the order grows: that of the higher one is
/// 11/4 of the distance.
const CAUTION: f64 = 3.0;

/// Rounding alone keeps two rules this far apart, so no smaller tolerance can be asked for.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Nodes in (−1, 1) and weights of one order.
type Rule = Vec<(f64, f64)>;

/// The low and the high rule, computed once.
static RULES: LazyLock<[Rule; 2]> = LazyLock::new(|| {
    [LOW_ORDER, HIGH_ORDER].map(|order| GaussLegendre::new(order).into_node_weight_pairs().to_vec())
});

/// Why an integral has no value to the stated tolerance.
///
/// `E` is the integrand's own error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QuadratureError<E> {
    /// A bound is infinite or not a number.
    #[error("the bounds of an integral must be finite, they are {lower} and {upper}")]
    Bounds {
        /// Lower bound as given.
        lower: f64,
        /// Upper bound as given.
        upper: f64,
    },
    /// The tolerance is not positive.
    #[error("the relative tolerance of an integral must be positive, it is {tolerance}")]
    Tolerance {
        /// Tolerance as given.
        tolerance: f64,
    },
    /// The integrand itself failed.
    #[error("the integrand fails at {abscissa}")]
    Integrand {
        /// Where it failed.
        abscissa: f64,
        /// The integrand's error.
        source: E,
    },
    /// The integrand is infinite or not a number.
    #[error("the integrand must be finite, it is {value} at {abscissa}")]
    NotFinite {
        /// Where it is not finite.
        abscissa: f64,
        /// Its value there.
        value: f64,
    },
    /// The integrand is 0 wherever it was looked at.
    #[error(
        "the integrand is 0 at all points between {lower} and {upper} where it was looked at; integrate over the part \
         where it is not"
    )]
    Vanishes {
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },
    /// The work is used up before the tolerance is met.
    #[error(
        "the integral from {lower} to {upper} reaches a relative error of {achieved:.1e} with \
         {panels} panels, {tolerance:.1e} is asked for; the worst panel begins at {abscissa}"
    )]
    NotConverged {
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
        /// Estimate of the relative error reached.
        achieved: f64,
        /// Relative error asked for.
        tolerance: f64,
        /// Number of panels.
        panels: usize,
        /// Lower end of the panel with the largest error.
        abscissa: f64,
    },
}

/// Integral of `integrand` from `lower` to `upper`.
///
/// The error is at most `relative_tolerance` times the integral of the integrand's magnitude, as
/// far as the difference of two Gauss–Legendre orders on every panel can tell; for an integrand of
/// one sign that is the relative error. A tolerance below 8 units of rounding (1.8e-15) is taken
/// as that. `upper` may lie below `lower`. The bounds themselves are never abscissae.
///
/// The integrand may again be an integral.
///
/// # Errors
///
/// See [`QuadratureError`]: unusable bounds or tolerance, an integrand that fails or is not
/// finite, one that is 0 at all points of the first look, or a tolerance that is not met with 256 panels.
///
/// What lies between the points of the first look, 39 of them, is not seen: a peak that is narrower than a hundredth of
/// the interval needs bounds of its own.
pub fn integrate<E>(
    integrand: &mut dyn FnMut(f64) -> Result<f64, E>,
    lower: f64,
    upper: f64,
    relative_tolerance: f64,
) -> Result<f64, QuadratureError<E>> {
    if !(lower.is_finite() && upper.is_finite() && (upper - lower).is_finite()) {
        return Err(QuadratureError::Bounds { lower, upper });
    }
    if relative_tolerance.is_nan() || relative_tolerance <= 0.0 {
        return Err(QuadratureError::Tolerance {
            tolerance: relative_tolerance,
        });
    }
    let tolerance = relative_tolerance.max(ROUNDING);
    let whole = Panel::new(integrand, lower, upper)?;
    if whole.vanishes && lower != upper {
        return Err(QuadratureError::Vanishes { lower, upper });
    }
    let mut panels = vec![whole];
    loop {
        let count = panels.len();
        let error: f64 = panels.iter().map(|panel| panel.error).sum();
        let magnitude: f64 = panels.iter().map(|panel| panel.magnitude).sum();
        if error <= tolerance * magnitude {
            return Ok(compensated_sum(panels.iter().map(|panel| panel.value)));
        }
        let Some(worst) = panels
            .iter_mut()
            .max_by(|left, right| left.error.total_cmp(&right.error))
        else {
            return Ok(0.0);
        };
        let abscissa = worst.lower;
        let middle = worst.lower + 0.5 * (worst.upper - worst.lower);
        let divisible = middle != worst.lower && middle != worst.upper;
        if !divisible || count == MAXIMUM_PANELS {
            return Err(QuadratureError::NotConverged {
                lower,
                upper,
                achieved: error / magnitude,
                tolerance,
                panels: count,
                abscissa,
            });
        }
        let right = Panel::new(integrand, middle, worst.upper)?;
        *worst = Panel::new(integrand, worst.lower, middle)?;
        panels.push(right);
    }
}

/// One part of the interval of integration.
struct Panel {
    lower: f64,
    upper: f64,
    /// Integral by the high order.
    value: f64,
    /// Integral of the magnitude, by the high order.
    magnitude: f64,
    /// Estimate of the error of `value`.
    error: f64,
    /// Whether the integrand is 0 at all nodes of both orders.
    vanishes: bool,
}

impl Panel {
    fn new<E>(
        integrand: &mut dyn FnMut(f64) -> Result<f64, E>,
        lower: f64,
        upper: f64,
    ) -> Result<Self, QuadratureError<E>> {
        let [low, high] = &*RULES;
        let (coarse, coarse_magnitude) = apply(low, integrand, lower, upper)?;
        let (value, magnitude) = apply(high, integrand, lower, upper)?;
        Ok(Self {
            lower,
            upper,
            value,
            magnitude,
            error: CAUTION * (value - coarse).abs(),
            vanishes: magnitude == 0.0 && coarse_magnitude == 0.0,
        })
    }
}

/// Integral of the integrand and of its magnitude over one panel by one rule.
fn apply<E>(
    rule: &Rule,
    integrand: &mut dyn FnMut(f64) -> Result<f64, E>,
    lower: f64,
    upper: f64,
) -> Result<(f64, f64), QuadratureError<E>> {
    let half = 0.5 * (upper - lower);
    let middle = lower + half;
    let mut sum = CompensatedSum::default();
    let mut magnitude = 0.0;
    for &(node, weight) in rule {
        let abscissa = middle + half * node;
        let value = integrand(abscissa)
            .map_err(|source| QuadratureError::Integrand { abscissa, source })?;
        if !value.is_finite() {
            return Err(QuadratureError::NotFinite { abscissa, value });
        }
        sum.add(weight * value);
        magnitude += weight * value.abs();
    }
    Ok((half * sum.total(), half.abs() * magnitude))
}

/// Sum that keeps what rounding drops (Neumaier, 1974).
#[derive(Default)]
struct CompensatedSum {
    sum: f64,
    dropped: f64,
}

impl CompensatedSum {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.dropped += if self.sum.abs() >= term.abs() {
            (self.sum - sum) + term
        } else {
            (term - sum) + self.sum
        };
        self.sum = sum;
    }

    fn total(&self) -> f64 {
        self.sum + self.dropped
    }
}

/// Compensated sum of all terms.
fn compensated_sum(terms: impl Iterator<Item = f64>) -> f64 {
    let mut sum = CompensatedSum::default();
    terms.for_each(|term| sum.add(term));
    sum.total()
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Integral of a function that cannot fail, and the number of its evaluations.
    fn counted(
        function: impl Fn(f64) -> f64,
        lower: f64,
        upper: f64,
        tolerance: f64,
    ) -> (Result<f64, QuadratureError<Infallible>>, usize) {
        let mut evaluations = 0;
        let value = integrate(
            &mut |x| {
                evaluations += 1;
                Ok(function(x))
            },
            lower,
            upper,
            tolerance,
        );
        (value, evaluations)
    }

    /// Asserts value, relative error and the number of evaluations at most.
    #[track_caller]
    fn assert_integral(
        function: impl Fn(f64) -> f64,
        (lower, upper): (f64, f64),
        expected: f64,
        relative_error: f64,
        most_evaluations: usize,
    ) {
        let (value, evaluations) = counted(function, lower, upper, 1e-15);
        let value = value.unwrap();
        let error = ((value - expected) / expected).abs();
        assert!(
            error <= relative_error,
            "{value} instead of {expected}: {error:e}"
        );
        assert!(evaluations <= most_evaluations, "{evaluations} evaluations");
    }

    #[test]
    fn smooth_integrands_to_rounding() {
        let e = std::f64::consts::E;
        assert_integral(f64::exp, (0.0, 1.0), e - 1.0, 3e-16, 26);
        assert_integral(f64::exp, (1.0, 0.0), 1.0 - e, 3e-16, 26);
        assert_integral(
            |x| 1.0 / (1.0 + x * x),
            (0.0, 1.0),
            std::f64::consts::FRAC_PI_4,
            3e-16,
            78,
        );
        // A narrow peak: pi/50 less the two tails.
        let peak = (50.0_f64 * 0.7).atan() / 50.0 + (50.0_f64 * 0.3).atan() / 50.0;
        let narrow = |x: f64| 1.0 / (1.0 + (50.0 * (x - 0.3)).powi(2));
        assert_integral(narrow, (0.0, 1.0), peak, 1e-15, 1000);
    }

    #[test]
    fn algebraic_and_logarithmic_ends() {
        assert_integral(f64::sqrt, (0.0, 1.0), 2.0 / 3.0, 1e-15, 1400);
        assert_integral(|x| (1.0 - x).sqrt(), (0.0, 1.0), 2.0 / 3.0, 1e-15, 1400);
        assert_integral(|x| x.powi(3) * x.ln(), (0.0, 1.0), -1.0 / 16.0, 1e-15, 400);
        assert_integral(|x| 1.0 / x.sqrt(), (0.0, 4.0), 4.0, 2e-15, 5600);
    }

    #[test]
    fn an_integral_of_an_integral() {
        // ∫₀¹ dx ∫₀^√(1−x²) 2√(1−x²−y²) dy = π/3, a quarter of a ball.
        let mut inner = |x: f64| {
            let end = (1.0 - x * x).sqrt();
            integrate::<Infallible>(
                &mut |y| Ok(2.0 * (end * end - y * y).sqrt()),
                0.0,
                end,
                1e-13,
            )
        };
        let volume = integrate(&mut inner, 0.0, 1.0, 1e-12).unwrap();
        approx_eq(volume, std::f64::consts::FRAC_PI_3, 1e-12);
    }

    #[track_caller]
    fn approx_eq(value: f64, expected: f64, tolerance: f64) {
        assert!(
            ((value - expected) / expected).abs() <= tolerance,
            "{value} {expected}"
        );
    }

    #[test]
    fn the_estimate_never_claims_more_than_is_reached() {
        for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
            for power in [-0.5, 0.25, 0.5, 1.5, 3.5] {
                let value = counted(|x| x.powf(power), 0.0, 1.0, tolerance).0.unwrap();
                approx_eq(value, 1.0 / (power + 1.0), tolerance);
            }
        }
    }

    #[test]
    fn nothing_to_integrate_is_zero() {
        assert_eq!(counted(f64::exp, 0.5, 0.5, 1e-15).0, Ok(0.0));
    }

    #[test]
    fn an_integrand_that_is_zero_wherever_it_is_looked_at_is_refused() {
        let bell = |x: f64| (-x * x).exp();
        let wide = counted(bell, 0.0, 1e30, 1e-10).0;
        assert_eq!(
            wide,
            Err(QuadratureError::Vanishes {
                lower: 0.0,
                upper: 1e30
            })
        );
        let narrow = counted(bell, 0.0, 1e3, 1e-14).0.unwrap();
        approx_eq(narrow, std::f64::consts::PI.sqrt() / 2.0, 1e-14);
    }

    #[test]
    fn what_cannot_be_integrated_is_said() {
        let pole = counted(|x| 1.0 / x, 0.0, 1.0, 1e-10).0;
        assert!(
            matches!(pole, Err(QuadratureError::NotConverged { panels: 256, .. })),
            "{pole:?}"
        );
        let middle = counted(|x| 1.0 / (x - 0.5), 0.0, 1.0, 1e-10).0;
        assert_eq!(
            middle,
            Err(QuadratureError::NotFinite {
                abscissa: 0.5,
                value: f64::INFINITY
            })
        );
        let failing = integrate(&mut |_| Err("no value"), 0.0, 1.0, 1e-10);
        assert!(
            matches!(failing, Err(QuadratureError::Integrand { abscissa, source: "no value" })
                if 0.0 < abscissa && abscissa < 1.0)
        );
        let bounds = counted(f64::exp, 0.0, f64::INFINITY, 1e-10).0;
        assert!(matches!(bounds, Err(QuadratureError::Bounds { .. })));
        let tolerance = counted(f64::exp, 0.0, 1.0, 0.0).0;
        assert!(matches!(tolerance, Err(QuadratureError::Tolerance { .. })));
    }
}
