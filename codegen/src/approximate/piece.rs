//! One candidate piece of a fit: samples of the function, its Chebyshev series, its errors.

use super::chebyshev;
use super::piecewise::{FitError, MAXIMUM_DEGREE, horner};
use crate::parallel::on_all_cores;

/// Number of nodes of a draft.
const NODES: usize = MAXIMUM_DEGREE + 1;

/// Number of points of a piece: the roots of $T_{3n}$, which contain those of $T_n$.
const POINTS: usize = 3 * NODES;

/// From here on a series of all points shows the function's rounding noise, if it is smooth.
const NOISE_BEGINS: usize = 2 * NODES;

/// A coefficient is signal if it is above the noise by this factor.
const SIGNAL: f64 = 2.0;

/// Number of further points at which a piece is checked. They have no pattern in common with the nodes, so that a function
/// cannot be right at all of the nodes by a symmetry or period of its own.
const FREE_POINTS: u32 = 16;

/// Distance of the outermost check points from the ends of a piece, in half widths.
///
/// An end itself may be a removable singularity of the function, 0/0, and is never evaluated.
const END_DISTANCE: f64 = 1.0 / 65536.0;

/// An interval on which the function is known at few points only.
pub(super) struct Draft {
    lower: f64,
    upper: f64,
    /// Values at the roots of $T_{13}$.
    values: Vec<f64>,
}

impl Draft {
    /// Samples the function at 13 nodes.
    pub(super) fn sample<E: Send>(
        function: &mut Sampled<'_, E>,
        lower: f64,
        upper: f64,
    ) -> Result<Self, FitError<E>> {
        let nodes = chebyshev::roots(NODES).into_iter();
        let nodes: Vec<f64> = nodes.map(|t| at(lower, upper, t)).collect();
        Ok(Self {
            lower,
            upper,
            values: function.at(&nodes)?,
        })
    }

    /// What the last coefficients let expect: the errors of the value and of the derivative by x,
    /// both relative to the function.
    pub(super) fn expected_errors(&self) -> (f64, f64) {
        let series = chebyshev::coefficients(&self.values);
        let last = series
            .iter()
            .rev()
            .take(2)
            .fold(0.0, |sum, c| sum + c.abs());
        let magnitude = self
            .values
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        let value = if last == 0.0 { 0.0 } else { last / magnitude };
        (
            value,
            value * (MAXIMUM_DEGREE as f64).powi(2) * 2.0 / (self.upper - self.lower),
        )
    }

    /// Samples the points between the nodes and next to the ends.
    pub(super) fn complete<E: Send>(
        self,
        function: &mut Sampled<'_, E>,
    ) -> Result<Piece, FitError<E>> {
        let Self {
            lower,
            upper,
            values: known,
        } = self;
        let points = chebyshev::roots(POINTS);
        let ends = [END_DISTANCE - 1.0, 1.0 - END_DISTANCE];
        let further: Vec<f64> = ends.into_iter().chain(free_points(lower, upper)).collect();
        // Every third point is a node, whose value is known.
        let is_new = |(index, t): (usize, &f64)| (index % 3 != 1).then_some(*t);
        let new = points
            .iter()
            .enumerate()
            .filter_map(is_new)
            .chain(further.iter().copied());
        let new: Vec<f64> = new.map(|t| at(lower, upper, t)).collect();
        let mut new = function.at(&new)?.into_iter();
        let mut known = known.into_iter();
        let value = |index: usize| {
            if index % 3 == 1 {
                known.next()
            } else {
                new.next()
            }
        };
        let values: Vec<f64> = (0..POINTS).filter_map(value).collect();
        let series = chebyshev::coefficients(&values);
        let further = further.into_iter().zip(new);
        let mut samples: Vec<(f64, f64)> = points.into_iter().zip(values).chain(further).collect();
        for (t, _) in &mut samples {
            // The abscissa was rounded, so t is taken back from it as an evaluation will.
            *t = (at(lower, upper, *t) - 0.5 * (lower + upper)) * (2.0 / (upper - lower));
        }
        let noise = series
            .iter()
            .skip(NOISE_BEGINS)
            .fold(0.0_f64, |most, c| most.max(c.abs()));
        Ok(Piece {
            lower,
            upper,
            series,
            noise,
            samples,
        })
    }
}

/// What a derivative's error is made of.
pub(super) struct SlopeErrors {
    /// From the terms of the series that are left out: smaller on a smaller piece.
    pub(super) left_out: f64,
    /// From the function's rounding noise: larger on a smaller piece.
    pub(super) noise: f64,
}

/// An interval with all that is needed to judge a polynomial on it.
pub(super) struct Piece {
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// Chebyshev series through the roots of $T_{39}$.
    series: Vec<f64>,
    /// Level below which coefficients are noise. Where the function is singular and the series
    /// falls slowly it is the level that was reached.
    noise: f64,
    /// Pairs of $t$ and the function's value.
    samples: Vec<(f64, f64)>,
}

impl Piece {
    /// The series cut to a degree, in powers of $t$.
    ///
    /// Last coefficients that are noise are dropped: they would spoil the derivative.
    pub(super) fn powers(&self, degree: usize) -> Vec<f64> {
        let mut series: Vec<f64> = self.series.iter().copied().take(degree + 1).collect();
        if let Some(noise) = series.get_mut(self.significant(degree) + 1..) {
            noise.fill(0.0);
        }
        chebyshev::to_powers(&series)
    }

    /// The highest degree, up to the given one, whose coefficient is not noise.
    fn significant(&self, degree: usize) -> usize {
        let mut leading = self.series.iter().take(degree + 1);
        leading.rposition(|c| self.is_signal(*c)).unwrap_or(0)
    }

    fn is_signal(&self, coefficient: f64) -> bool {
        coefficient.abs() > SIGNAL * self.noise
    }

    /// Largest relative error of the series cut to a degree, over all samples, and its place.
    pub(super) fn worst(&self, degree: usize) -> (f64, f64) {
        let powers = self.powers(degree);
        let relative_error = |&(t, value): &(f64, f64)| {
            let error = (horner(&powers, t) - value).abs();
            let relative = if error == 0.0 {
                0.0
            } else {
                error / value.abs()
            };
            (relative, at(self.lower, self.upper, t))
        };
        let larger = |most: (f64, f64), next: (f64, f64)| if next.0 > most.0 { next } else { most };
        self.samples
            .iter()
            .map(relative_error)
            .fold((0.0, self.lower), larger)
    }

    /// Estimates of the error of the derivative of the series cut to a degree, by the terms left
    /// out and by the noise in those kept, both relative to the
    /// [scale](Self::smallest_slope_scale).
    ///
    /// $|T_k'| \le k^2$ bounds what each term left out would add. Noise is independent from term to
    /// term, so its squares add; the first term dropped as noise may hide as much of a signal.
    pub(super) fn slope_errors(&self, degree: usize, width: f64) -> SlopeErrors {
        let significant = self.significant(degree);
        let squares = || (0..self.series.len()).map(|k| (k * k) as f64);
        let left_out: f64 = (squares().zip(&self.series).skip(significant + 1))
            .filter(|(_, c)| self.is_signal(**c))
            .map(|(square, c)| square * c.abs())
            .sum();
        let kept: f64 = squares()
            .take(significant + 1)
            .map(|square| square * square)
            .sum();
        let hidden: f64 = squares()
            .skip(significant + 1)
            .take(1)
            .map(|square| SIGNAL * square)
            .sum();
        let scale = self.smallest_slope_scale(degree, width);
        let relative = |error: f64| if error == 0.0 { 0.0 } else { error / scale };
        SlopeErrors {
            left_out: relative(left_out),
            noise: relative(self.noise * (kept.sqrt() + hidden)),
        }
    }

    /// Smallest of $|f| \cdot w/W + |df/dt|$ over the samples, $W$ the `width` of the whole fit and
    /// $w$ half that of the piece.
    fn smallest_slope_scale(&self, degree: usize, width: f64) -> f64 {
        let powers = self.powers(degree);
        let slope: Vec<f64> = powers
            .iter()
            .enumerate()
            .skip(1)
            .map(|(power, a)| power as f64 * a)
            .collect();
        let share = 0.5 * (self.upper - self.lower) / width;
        let scale = |&(t, value): &(f64, f64)| value.abs() * share + horner(&slope, t).abs();
        self.samples.iter().map(scale).fold(f64::INFINITY, f64::min)
    }
}

/// Points of (−1, 1) without a pattern, the same for the same interval.
fn free_points(lower: f64, upper: f64) -> impl Iterator<Item = f64> {
    let start = lower.to_bits() ^ upper.to_bits().rotate_left(32);
    (1..=FREE_POINTS).map(move |count| {
        // The finaliser of splitmix64.
        let mut bits = start.wrapping_add(u64::from(count).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        (1.0 - END_DISTANCE) * (2.0 * unit - 1.0)
    })
}

/// The abscissa that belongs to $t$ on an interval.
fn at(lower: f64, upper: f64, t: f64) -> f64 {
    0.5 * (lower + upper) + 0.5 * (upper - lower) * t
}

/// A function that a fit may be made of: finite, and of one sign.
pub(super) struct Sampled<'f, E> {
    function: &'f (dyn Fn(f64) -> Result<f64, E> + Sync),
    /// The first point and the sign there.
    first: Option<(f64, f64)>,
}

impl<'f, E: Send> Sampled<'f, E> {
    pub(super) fn new(function: &'f (dyn Fn(f64) -> Result<f64, E> + Sync)) -> Self {
        Self {
            function,
            first: None,
        }
    }

    /// The function's values at the points.
    fn at(&mut self, points: &[f64]) -> Result<Vec<f64>, FitError<E>> {
        let values = on_all_cores(points, |x| (self.function)(*x));
        let values = points.iter().zip(values);
        values.map(|(x, value)| self.checked(*x, value)).collect()
    }

    fn checked(&mut self, x: f64, value: Result<f64, E>) -> Result<f64, FitError<E>> {
        let value = value.map_err(|source| FitError::Function { x, source })?;
        if !value.is_finite() {
            return Err(FitError::NotFinite { x, value });
        }
        let (first, sign) = *self.first.get_or_insert((x, value.signum()));
        if value == 0.0 {
            return Err(FitError::Zero { left: x, right: x });
        }
        if value.signum() != sign {
            let (left, right) = (x.min(first), x.max(first));
            return Err(FitError::Zero { left, right });
        }
        Ok(value)
    }
}
