//! Instability regions that a rotor does not have.

use thiserror::Error;

use crate::region::RegionKind;

/// Why a rotor has no such instability region, or the region no such quantity.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RegionError {
    /// The whirl frequencies never meet the region's condition at this inertia ratio.
    #[error(
        "there is no {} at beta = {beta}; beta must be < {limit}: from there on {} at every speed",
        .kind.description(), .kind.why_none()
    )]
    InertiaRatio {
        /// The region asked for.
        kind: RegionKind,
        /// $\beta$.
        beta: f64,
        /// The region exists below this.
        limit: f64,
    },
    /// $C = \delta - \gamma^2$ is the determinant of the mean stiffness; a shaft has it positive.
    #[error(
        "delta - gamma² = {value} with delta = {delta}, gamma = {gamma}; it must be > 0, as it is \
         for every shaft that resists bending"
    )]
    MeanStiffnessNotPositive {
        /// $\delta$.
        delta: f64,
        /// $\gamma$.
        gamma: f64,
        /// $\delta - \gamma^2$.
        value: f64,
    },
    /// The stiffness matrix in the rotor's frame is not positive definite: the shaft gives way at rest.
    #[error(
        "the stiffness is not positive definite: delta - gamma^2 = {reserve} with epsilon_1 = {epsilon_1}, epsilon_12 = {epsilon_12}, epsilon_2 = {epsilon_2}"
    )]
    StiffnessNotPositive {
        /// $\delta - \gamma^2$, which must be positive.
        reserve: f64,
        /// $\epsilon_1$.
        epsilon_1: f64,
        /// $\epsilon_{12}$.
        epsilon_12: f64,
        /// $\epsilon_2$.
        epsilon_2: f64,
    },
    /// The growth rate at the start would be imaginary: the coupling stabilises.
    #[error(
        "the square of the peak growth rate of the {}, Eq. (29), is {value}; it must be >= 0", .kind.description()
    )]
    GrowthImaginary {
        /// The region asked for.
        kind: RegionKind,
        /// The negative radicand.
        value: f64,
    },
    /// $\gamma = 0$: displacement and tilt are uncoupled, so no disk asymmetry takes part.
    #[error(
        "the {} has no closing disk asymmetry at gamma = 0: displacement and tilt are uncoupled, \
         its width is the same for every disk", .kind.description()
    )]
    Uncoupled {
        /// The region asked for.
        kind: RegionKind,
    },
    /// A number leaves the range of double precision.
    #[error("{quantity} of the {} comes out as {value} in double precision; it must be a finite number", .kind.description())]
    NotFinite {
        /// The region asked for.
        kind: RegionKind,
        /// The quantity.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
    /// The width is zero, where it has a corner: it grows to all sides.
    #[error("the partial by {input} of the width of the {} is {value}; it must be a finite number, which it is where the width is not zero", .kind.description())]
    Corner {
        /// The region asked for.
        kind: RegionKind,
        /// The input.
        input: &'static str,
        /// What came out.
        value: f64,
    },
    /// Neither crack nor disk excites the region, so that every value of what was asked for closes it.
    #[error(
        "the {} is closed everywhere: neither the crack nor the disk's asymmetry excites it", .kind.description()
    )]
    ClosedEverywhere {
        /// The region asked for.
        kind: RegionKind,
    },
    /// The exact ends of the region were not found. Its start and its approximate width may be there.
    #[error("no exact ends of the {} were found: {reason}", .kind.description())]
    NoExactEnds {
        /// The region asked for.
        kind: RegionKind,
        /// What rules them out.
        reason: &'static str,
    },
    /// The region reaches to infinite speed.
    #[error(
        "the simple instability region from speed {lower} upwards has no upper end (the disk's asymmetry exceeds |beta - 1|)"
    )]
    Unbounded {
        /// Its lower end, in units of the reference speed.
        lower: f64,
    },
}
