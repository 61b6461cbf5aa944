//! Piecewise polynomials to a stated relative tolerance.
//!
//! [`fit`] bisects the interval until a Chebyshev series of degree 12 or less meets the tolerance
//! on every piece, so pieces grow small only where the function asks for it, for example towards
//! an end with a logarithm. All pieces then get the smallest common degree: the generated code
//! finds a piece by counting breakpoints and evaluates one row of coefficients, without a branch.

use super::piece::{Draft, Piece, Sampled};

/// Highest degree of a piece.
///
/// Higher degrees save few pieces, and a piece costs memory only, a degree time at every
/// evaluation.
pub(super) const MAXIMUM_DEGREE: usize = 12;

/// The most pieces of one fit.
const MAXIMUM_PIECES: usize = 64;

/// Pieces are not bisected below this share of the interval, 2^−30.
///
/// On narrower ones the points of a piece are few numbers apart: a jump could hide between two.
const SMALLEST_SHARE: f64 = 1.0 / 1_073_741_824.0;

/// How many times worse than the function itself its derivative may be.
const DERIVATIVE_FACTOR: f64 = 100.0;

/// Why a function has no fit to the stated tolerance.
///
/// `E` is the function's own error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError<E> {
    /// The interval is empty, infinite or not a number.
    #[error("a fit needs finite bounds with lower < upper, they are {lower} and {upper}")]
    Interval {
        /// Lower bound as given.
        lower: f64,
        /// Upper bound as given.
        upper: f64,
    },
    /// The tolerance is not positive.
    #[error("the relative tolerance of a fit must be positive, it is {tolerance}")]
    Tolerance {
        /// Tolerance as given.
        tolerance: f64,
    },
    /// The function itself failed.
    #[error("the function fails at {x}")]
    Function {
        /// Where it failed.
        x: f64,
        /// The function's error.
        source: E,
    },
    /// The function is infinite or not a number.
    #[error("the function must be finite, it is {value} at {x}")]
    NotFinite {
        /// Where it is not finite.
        x: f64,
        /// Its value there.
        value: f64,
    },
    /// The function is 0 at some point, or changes its sign.
    #[error(
        "the function vanishes or changes its sign between {left} and {right}: no relative tolerance holds at a zero, \
         and a pole has no fit"
    )]
    Zero {
        /// A point on one side, or the zero itself.
        left: f64,
        /// A point on the other side, or the zero itself.
        right: f64,
    },
    /// The largest number or the smallest width of pieces does not meet the tolerance.
    #[error(
        "at {pieces} pieces the relative error is still {achieved:.1e} at {x}, {tolerance:.1e} \
         is asked for"
    )]
    NotMet {
        /// Largest relative error on the piece that fails.
        achieved: f64,
        /// Where that error is.
        x: f64,
        /// Relative error asked for.
        tolerance: f64,
        /// Number of pieces when it was given up.
        pieces: usize,
    },
    /// There the function is met, its derivative is not.
    #[error(
        "at {pieces} pieces the relative error of the derivative is still {achieved:.1e} between \
         {lower} and {upper}, {tolerance:.1e} is allowed"
    )]
    DerivativeNotMet {
        /// Estimate of the error reached, relative to |f'| and |f| over the interval's width.
        achieved: f64,
        /// Lower end of the piece that fails.
        lower: f64,
        /// Upper end of the piece that fails.
        upper: f64,
        /// What is allowed: 100 times the fit's tolerance.
        tolerance: f64,
        /// Number of pieces when it was given up.
        pieces: usize,
    },
}

/// A polynomial on each of several adjacent intervals.
///
/// On piece $i$, between breakpoints $b_i$ and $b_{i+1}$, the value is
/// $\sum_k a_{ik} t^k$ with $t = (x - (b_i + b_{i+1})/2) \cdot 2/(b_{i+1} - b_i)$,
/// which runs from −1 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct PiecewisePolynomial {
    /// Ascending, one more than pieces; at least two.
    breakpoints: Vec<f64>,
    /// One row per piece, all of the same length of at least two.
    coefficients: Vec<Vec<f64>>,
    tolerance: f64,
    largest_error: f64,
    derivative_error: f64,
    derivative_order: usize,
}

impl PiecewisePolynomial {
    /// Ends of the pieces, ascending: lower bound of the first, …, upper bound of the last.
    pub fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    /// Coefficients of $t^0, t^1, …$ of each piece; all rows have the same length.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        &self.coefficients
    }

    /// Degree of all pieces.
    pub fn degree(&self) -> usize {
        self.coefficients.first().map_or(0, |row| row.len() - 1)
    }

    /// Relative tolerance that the fit was asked for.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Largest relative error of the fit over all points at which the function was evaluated.
    pub fn largest_error(&self) -> f64 {
        self.largest_error
    }

    /// Largest estimate over the pieces of the error of the fit's first derivative, relative to the
    /// sum of $|f'|$ and of $|f|$ over the width of the interval.
    ///
    /// It counts the terms left out and the function's own rounding noise, which the series shows
    /// in its last terms. It is an estimate, good to a small factor, not a bound.
    pub fn derivative_error(&self) -> f64 {
        self.derivative_error
    }

    /// Which derivative of the fit this is: 0 for the fit itself.
    pub fn derivative_order(&self) -> usize {
        self.derivative_order
    }

    /// Value at `x`, by Horner's rule.
    ///
    /// At a breakpoint the piece above it holds. Outside the interval the outer piece is continued,
    /// to no stated accuracy. The emitted function has the same bits.
    pub fn evaluate(&self, x: f64) -> f64 {
        let inner = &self.breakpoints[1..self.breakpoints.len() - 1];
        let piece = inner.iter().filter(|&&breakpoint| x >= breakpoint).count();
        let t = (x - self.center(piece)) * self.scale(piece);
        horner(&self.coefficients[piece], t)
    }

    /// The exact derivative of the polynomials with respect to `x`.
    ///
    /// The error of the first is estimated by [`derivative_error`](Self::derivative_error). That of
    /// a further one is larger by up to $2n^2/w$ on a piece of width $w$ and degree $n$ (Markov's
    /// inequality).
    #[must_use]
    pub fn derivative(&self) -> Self {
        let row = |(piece, coefficients): (usize, &Vec<f64>)| {
            let scale = self.scale(piece);
            let raised = coefficients.iter().enumerate().skip(1);
            let mut row: Vec<f64> = raised.map(|(power, a)| power as f64 * a * scale).collect();
            row.resize(row.len().max(2), 0.0);
            row
        };
        Self {
            breakpoints: self.breakpoints.clone(),
            coefficients: self.coefficients.iter().enumerate().map(row).collect(),
            derivative_order: self.derivative_order + 1,
            ..*self
        }
    }

    /// A polynomial that was not fitted, for tests of what is done with one.
    #[cfg(test)]
    pub(crate) fn with_rows(breakpoints: Vec<f64>, coefficients: Vec<Vec<f64>>) -> Self {
        Self {
            breakpoints,
            coefficients,
            tolerance: 1e-13,
            largest_error: 2e-14,
            derivative_error: 3e-12,
            derivative_order: 0,
        }
    }

    /// Middle of a piece.
    pub(crate) fn center(&self, piece: usize) -> f64 {
        0.5 * (self.breakpoints[piece] + self.breakpoints[piece + 1])
    }

    /// Factor from `x` to `t` on a piece.
    pub(crate) fn scale(&self, piece: usize) -> f64 {
        2.0 / (self.breakpoints[piece + 1] - self.breakpoints[piece])
    }
}

/// Value of $\sum_k a_k t^k$.
pub(super) fn horner(coefficients: &[f64], t: f64) -> f64 {
    // The last coefficient starts the sum, as in the emitted code: 0·t would make NaN of infinity.
    let mut descending = coefficients.iter().rev();
    let first = descending.next().copied().unwrap_or(0.0);
    descending.fold(first, |value, coefficient| value * t + coefficient)
}

/// Piecewise polynomial that is within `tolerance` of `function`, relatively, from `lower` to
/// `upper`.
///
/// Breakpoints are dyadic fractions of the interval. The degree, 12 at most, is the same on all
/// pieces and the smallest that meets the tolerance there. The error is measured, with the value
/// that the fit's own evaluation gives, at 57 points of each piece: three for each coefficient,
/// one next to either end, and 16 without a pattern. What lies between them is not seen, such as a
/// peak a millionth of the interval wide. The bounds themselves are never evaluated, so a function
/// may be 0/0 there. The error is relative to the function at the same point, so the function may
/// not change its sign.
///
/// The derivative of the fit is held, too: what the terms left out add to it is at most 100 times
/// `tolerance`, relative to the sum of $|f'|$ and of $|f|$ over the width of the interval. What the
/// function's own rounding noise adds cannot be mended and is only reported, see
/// [`derivative_error`](PiecewisePolynomial::derivative_error).
///
/// # Errors
///
/// See [`FitError`]: an unusable interval or tolerance, a function that fails, is not finite or has a zero, or a tolerance that is not met with 64 pieces, or on one of $2^{-30}$ of the interval, with the
/// error achieved and where.
pub fn fit<E: Send>(
    function: &(dyn Fn(f64) -> Result<f64, E> + Sync),
    lower: f64,
    upper: f64,
    tolerance: f64,
) -> Result<PiecewisePolynomial, FitError<E>> {
    if !(lower < upper && (upper - lower).is_finite()) {
        return Err(FitError::Interval { lower, upper });
    }
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(FitError::Tolerance { tolerance });
    }
    let target = Target {
        tolerance,
        width: upper - lower,
    };
    let function = &mut Sampled::new(function);
    // Depth first and left to right: `pending` is a stack with the leftmost interval on top.
    let mut pieces: Vec<Piece> = Vec::new();
    let mut pending = vec![(lower, upper)];
    while let Some((left, right)) = pending.pop() {
        let count = pieces.len() + pending.len() + 1;
        let middle = left + 0.5 * (right - left);
        let is_divisible =
            count < MAXIMUM_PIECES && right - left > SMALLEST_SHARE * (upper - lower);
        let draft = Draft::sample(function, left, right)?;
        if is_divisible && !target.is_in_reach(&draft) {
            pending.extend([(middle, right), (left, middle)]);
            continue;
        }
        let piece = draft.complete(function)?;
        if target.is_met(&piece, MAXIMUM_DEGREE) {
            pieces.push(piece);
        } else if is_divisible {
            pending.extend([(middle, right), (left, middle)]);
        } else {
            return Err(target.missed(&piece, count));
        }
    }
    Ok(target.with_common_degree(&pieces))
}

/// What every piece must meet.
struct Target {
    tolerance: f64,
    /// Width of the whole interval.
    width: f64,
}

impl Target {
    /// Whether it is worth while to sample the piece in full.
    ///
    /// The error of an interpolant is about its last coefficients. A piece that misses by more than
    /// the factor 8 here is bisected without a further look.
    fn is_in_reach(&self, draft: &Draft) -> bool {
        let (value, slope) = draft.expected_errors();
        value <= 8.0 * self.tolerance
            && slope * self.width <= 8.0 * DERIVATIVE_FACTOR * self.tolerance
    }

    /// Whether the piece is good enough with a degree.
    ///
    /// A derivative whose error is mostly the function's own noise would be worse on smaller
    /// pieces: it is taken as it is, and reported.
    fn is_met(&self, piece: &Piece, degree: usize) -> bool {
        if piece.worst(degree).0 > self.tolerance {
            return false;
        }
        let slope = piece.slope_errors(degree, self.width);
        slope.left_out <= slope.noise.max(DERIVATIVE_FACTOR * self.tolerance)
    }

    fn missed<E>(&self, piece: &Piece, pieces: usize) -> FitError<E> {
        let (achieved, x) = piece.worst(MAXIMUM_DEGREE);
        if achieved > self.tolerance {
            return FitError::NotMet {
                achieved,
                x,
                tolerance: self.tolerance,
                pieces,
            };
        }
        FitError::DerivativeNotMet {
            achieved: piece.slope_errors(MAXIMUM_DEGREE, self.width).left_out,
            lower: piece.lower,
            upper: piece.upper,
            tolerance: DERIVATIVE_FACTOR * self.tolerance,
            pieces,
        }
    }

    /// The pieces, all with the smallest degree at which every one meets the target.
    fn with_common_degree(&self, pieces: &[Piece]) -> PiecewisePolynomial {
        let degree = (1..MAXIMUM_DEGREE)
            .find(|&degree| pieces.iter().all(|piece| self.is_met(piece, degree)))
            .unwrap_or(MAXIMUM_DEGREE);
        let begin = pieces.first().map(|piece| piece.lower);
        let ends = pieces.iter().map(|piece| piece.upper);
        let largest =
            |errors: &dyn Fn(&Piece) -> f64| pieces.iter().map(errors).fold(0.0, f64::max);
        PiecewisePolynomial {
            breakpoints: begin.into_iter().chain(ends).collect(),
            coefficients: pieces.iter().map(|piece| piece.powers(degree)).collect(),
            tolerance: self.tolerance,
            largest_error: largest(&|piece| piece.worst(degree).0),
            derivative_error: largest(&|piece| {
                let errors = piece.slope_errors(degree, self.width);
                errors.left_out + errors.noise
            }),
            derivative_order: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    type Fit = Result<PiecewisePolynomial, FitError<Infallible>>;

    fn fit_of(function: impl Fn(f64) -> f64 + Sync, lower: f64, upper: f64, tolerance: f64) -> Fit {
        fit(&|x| Ok(function(x)), lower, upper, tolerance)
    }

    /// Largest relative difference at 2001 points, the ends among them.
    fn largest_difference(
        fit: &PiecewisePolynomial,
        function: impl Fn(f64) -> f64,
        (lower, upper): (f64, f64),
    ) -> f64 {
        let point = |index: i32| lower + (upper - lower) * f64::from(index) / 2000.0;
        (0..=2000)
            .map(|index| (fit.evaluate(point(index)) / function(point(index)) - 1.0).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_polynomial_needs_one_piece_of_its_degree() {
        let fit = fit_of(|x| x * x * x - 0.25, 1.0, 2.0, 1e-14).unwrap();
        assert_eq!(
            (fit.breakpoints(), fit.degree()),
            ([1.0, 2.0].as_slice(), 3)
        );
        assert!((fit.evaluate(1.7) - 4.663).abs() < 2e-15);
        assert!((fit.derivative().evaluate(1.7) - 8.67).abs() < 1e-13);
        let constant = fit_of(|_| 3.0, 1.0, 2.0, 1e-14).unwrap();
        assert_eq!(
            (constant.evaluate(1.1), constant.derivative().evaluate(1.1)),
            (3.0, 0.0)
        );
    }

    #[test]
    fn value_and_derivatives_meet_their_tolerances() {
        let fit = fit_of(f64::exp, -1.0, 3.0, 1e-13).unwrap();
        assert!(largest_difference(&fit, f64::exp, (-1.0, 3.0)) <= 1e-13);
        let first = fit.derivative();
        assert!(largest_difference(&first, f64::exp, (-1.0, 3.0)) <= 1e-11);
        assert!(largest_difference(&first.derivative(), f64::exp, (-1.0, 3.0)) <= 1e-9);
        assert_eq!((fit.derivative_order(), first.derivative_order()), (0, 1));
        assert_eq!(first.degree(), fit.degree() - 1);
    }

    #[test]
    fn a_looser_tolerance_costs_less() {
        let cost = |tolerance| {
            let fit = fit_of(|x| 1.0 / (0.2 + x), 0.0, 1.0, tolerance).unwrap();
            assert!(fit.largest_error() <= tolerance);
            fit.coefficients().len() * (fit.degree() + 1)
        };
        assert!(cost(1e-4) < cost(1e-8) && cost(1e-8) < cost(1e-12));
    }

    #[test]
    fn pieces_are_graded_towards_a_logarithm() {
        let function = |x: f64| 1.0 + x.powi(4) * x.max(f64::MIN_POSITIVE).ln();
        let fit = fit_of(function, 0.0, 1.0, 1e-13).unwrap();
        assert!(largest_difference(&fit, function, (0.0, 1.0)) <= 1e-13);
        let breakpoints = fit.breakpoints();
        assert!(breakpoints[1] < 0.02 && breakpoints[breakpoints.len() - 2] >= 0.5);
        // Dyadic: whole multiples of a power of two.
        assert!(
            breakpoints.iter().all(|b| (b * 65536.0).fract() == 0.0),
            "{breakpoints:?}"
        );
    }

    #[test]
    fn ends_may_be_removable_singularities() {
        let fit = fit_of(|x| x.sin() / x, 0.0, 1.0, 1e-14).unwrap();
        assert!((fit.evaluate(0.0) - 1.0).abs() <= 1e-14);
    }

    #[test]
    fn outside_the_outer_piece_is_continued() {
        let fit = fit_of(|x| 1.0 + x, 0.0, 1.0, 1e-12).unwrap();
        assert!(
            (fit.evaluate(-0.5) - 0.5).abs() < 1e-14 && (fit.evaluate(1.5) - 2.5).abs() < 1e-14
        );
        assert!(fit.evaluate(f64::NAN).is_nan());
    }

    #[test]
    fn what_cannot_be_fitted_is_said() {
        let jump = fit_of(|x| if x < 0.3 { 1.0 } else { 2.0 }, 0.0, 1.0, 1e-10);
        assert!(
            matches!(jump, Err(FitError::NotMet { achieved, x, .. })
                if achieved > 0.1 && (x - 0.3).abs() < 1e-9),
            "{jump:?}"
        );
        // The value converges towards the root's end, the derivative is infinite there.
        let root = fit_of(|x| 1.0 + x.sqrt(), 0.0, 1.0, 1e-6);
        assert!(
            matches!(root, Err(FitError::DerivativeNotMet { lower: 0.0, .. })),
            "{root:?}"
        );
        let pole = fit_of(|x| 1.0 / (x - 0.5), 0.0, 1.0, 1e-6);
        assert!(
            matches!(pole, Err(FitError::NotFinite { x: 0.5, .. })),
            "{pole:?}"
        );
        let failing = fit(&|_| Err("no value"), 0.0, 1.0, 1e-6);
        assert!(matches!(
            failing,
            Err(FitError::Function {
                source: "no value",
                ..
            })
        ));
        for (lower, upper) in [(-1.0, 1.0), (-1.0, 1.5), (-0.1, 2.0)] {
            for tolerance in [1e-3, 1e-14] {
                let crossing = fit_of(f64::sin, lower, upper, tolerance);
                assert!(
                    matches!(crossing, Err(FitError::Zero { left, right }) if left <= 0.0 && right >= 0.0),
                    "{crossing:?}"
                );
            }
        }
        for (lower, upper) in [
            (1.0, 1.0),
            (1.0, 0.0),
            (0.0, f64::INFINITY),
            (f64::NAN, 1.0),
        ] {
            assert!(matches!(
                fit_of(f64::exp, lower, upper, 1e-6),
                Err(FitError::Interval { .. })
            ));
        }
        assert!(matches!(
            fit_of(f64::exp, 0.0, 1.0, -1.0),
            Err(FitError::Tolerance { .. })
        ));
    }

    #[test]
    fn a_wave_through_all_nodes_is_seen() {
        // T₃₉ is 0 at all 39 nodes, and the factor in front of it next to the ends.
        let wave = |x: f64| 1.0 + 0.1 * (1.0 - x * x) * (39.0 * x.acos()).cos();
        let fit = fit_of(wave, -1.0, 1.0, 1e-3).unwrap();
        assert!(fit.coefficients().len() > 1);
        assert!(largest_difference(&fit, wave, (-1.0, 1.0)) <= 1e-3);
    }

    #[test]
    fn noise_does_not_make_pieces_smaller() {
        // Sine of a large argument is noise of 1e-13 here: the derivative suffers, the fit is kept.
        let fit = fit_of(|x| x.exp() + 1e-13 * (1e9 * x).sin(), 0.0, 1.0, 1e-12).unwrap();
        assert!(fit.coefficients().len() <= 2, "{:?}", fit.breakpoints());
        let error = largest_difference(&fit.derivative(), f64::exp, (0.0, 1.0));
        assert!(
            error <= 3.0 * fit.derivative_error(),
            "{error:e} {:e}",
            fit.derivative_error()
        );
    }
}
