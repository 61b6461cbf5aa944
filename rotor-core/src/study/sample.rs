//! Random points by their index: distributions, and two ways to draw from them.
//!
//! A sample is a function of its index, its dimension and the seed alone. Any part of a sample of
//! $10^9$ can be drawn anywhere, without the part before it.

use crate::error::{Error, StudyError};

mod normal;
mod sobol;

pub(super) use normal::quantile;

/// How a variable is distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Between two ends, everywhere as likely.
    Uniform {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// The normal distribution.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// The logarithm is normally distributed.
    LogNormal {
        /// Median, that is, the exponential of the logarithm's mean.
        median: f64,
        /// Standard deviation of the logarithm.
        deviation: f64,
    },
}

impl Distribution {
    /// The value below which the share `share` of all draws lies, 0 < share < 1.
    pub(super) fn at(&self, share: f64) -> f64 {
        match *self {
            Self::Uniform { low, high } => low * (1.0 - share) + high * share,
            Self::Normal { mean, deviation } => mean + deviation * quantile(share),
            Self::LogNormal { median, deviation } => median * (deviation * quantile(share)).exp(),
        }
    }

    /// Refuses parameters that the distribution does not have.
    pub(super) fn check(&self, input: &'static str) -> Result<(), Error> {
        let refuse = |parameter, value, allowed| {
            Err(StudyError::Distribution {
                input,
                parameter,
                value,
                allowed,
            }
            .into())
        };
        match *self {
            Self::Uniform { low, .. } if !low.is_finite() => {
                refuse("the lower end", low, "a finite number")
            }
            Self::Uniform { low, high } if !(high.is_finite() && high >= low) => refuse(
                "the upper end",
                high,
                "a finite number not below the lower end",
            ),
            Self::Normal { mean, .. } if !mean.is_finite() => {
                refuse("the mean", mean, "a finite number")
            }
            Self::LogNormal { median, .. } if !(median.is_finite() && median > 0.0) => {
                refuse("the median", median, "a finite number > 0")
            }
            Self::Normal { deviation, .. } | Self::LogNormal { deviation, .. }
                if !(deviation.is_finite() && deviation >= 0.0) =>
            {
                refuse("the standard deviation", deviation, "a finite number >= 0")
            }
            _ => Ok(()),
        }
    }
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Independent pseudo-random numbers: SplitMix64 (Steele, Lea & Flood, 2014), whose n-th number
    /// needs n alone.
    Random {
        /// Another seed gives other numbers.
        seed: u64,
    },
    /// Sobol's sequence with the direction numbers of Joe & Kuo (2008), shifted by the seed: fills
    /// the space evenly, so that means converge nearly as 1/n.
    Sobol {
        /// Another seed shifts the sequence elsewhere.
        seed: u64,
    },
}

/// The increment of SplitMix64, $2^{64}$ over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The most variables that are drawn together; numbers of different dimensions never meet.
const DIMENSIONS: u64 = 16;

impl Sampling {
    /// The coordinate `dimension` of the point `index`, inside of (0, 1).
    pub(super) fn uniform(&self, index: u64, dimension: u32) -> f64 {
        let bits = match *self {
            Self::Random { seed } => {
                let counter = index
                    .wrapping_mul(DIMENSIONS)
                    .wrapping_add(u64::from(dimension));
                // The seed is scattered first, so that neighbouring seeds have no numbers in common.
                scatter(scatter(seed).wrapping_add(GOLDEN.wrapping_mul(counter.wrapping_add(1))))
            }
            Self::Sobol { seed } => {
                let shift =
                    scatter(seed.wrapping_add(GOLDEN.wrapping_mul(u64::from(dimension) + 1)));
                sobol::coordinate(index, dimension) ^ shift
            }
        };
        // 52 bits in the middle of their cell: neither 0 nor 1, at which a quantile is infinite.
        ((bits >> 12) as f64 + 0.5) * (-52_f64).exp2()
    }
}

/// The mixing function of SplitMix64.
const fn scatter(state: u64) -> u64 {
    let a = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let b = (a ^ (a >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    b ^ (b >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_splitmix64() {
        // The published sequence of the state 1234567.
        let first = |n: u64| scatter(1_234_567_u64.wrapping_add(GOLDEN.wrapping_mul(n)));
        assert_eq!(first(1), 6_457_827_717_110_365_317);
        assert_eq!(first(2), 3_203_168_211_198_807_973);
    }

    #[test]
    fn a_sample_has_the_moments_of_its_distribution() {
        let normal = Distribution::Normal {
            mean: 0.2,
            deviation: 0.01,
        };
        for (sampling, tolerance) in [
            (Sampling::Random { seed: 7 }, 4.0 / 300.0),
            (Sampling::Sobol { seed: 7 }, 1e-3),
        ] {
            for dimension in [0, 3, 11] {
                let count = 1 << 16;
                let draws: Vec<f64> = (0..count)
                    .map(|index| (normal.at(sampling.uniform(index, dimension)) - 0.2) / 0.01)
                    .collect();
                let mean = draws.iter().sum::<f64>() / count as f64;
                let square = draws.iter().map(|draw| draw * draw).sum::<f64>() / count as f64;
                assert!(mean.abs() < tolerance, "{sampling:?} {dimension}: {mean}");
                assert!(
                    (square - 1.0).abs() < 2.0 * tolerance,
                    "{sampling:?}: {square}"
                );
            }
        }
    }

    #[test]
    fn a_distribution_says_what_it_lacks() {
        let text =
            |distribution: Distribution| distribution.check("disk_mass").unwrap_err().to_string();
        let (mean, deviation) = (1.0, -0.1);
        assert_eq!(
            text(Distribution::Normal { mean, deviation }),
            "the distribution of disk_mass has the standard deviation = -0.1; it must be a finite number >= 0"
        );
        let (low, high) = (1.0, 0.5);
        assert!(text(Distribution::Uniform { low, high }).contains("not below the lower end"));
        let (median, deviation) = (0.0, 1.0);
        assert!(text(Distribution::LogNormal { median, deviation }).contains("the median"));
    }
}
