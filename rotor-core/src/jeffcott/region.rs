//! Unstable regions: where they start, how wide they are, how fast they grow, what closes them.
//!
//! The numbers come from [`equations`]; this module knows which regions exist and
//! says why one does not.

#[cfg(test)]
mod tests;

use std::fmt;

use thiserror::Error;

use crate::equations::{self, Coefficients};
use crate::error::StabilityError;
use crate::input::INPUTS;
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::rotor::{LoadCase, NoCoefficients, Rotor};

/// The unstable regions a rotor can have on isotropic rigid supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RegionKind {
    /// The simple region (SIR) where $\omega_2 = \Omega$, Eq. (15).
    Simple,
    /// The second simple region, where $\omega_1 = \Omega$; only for $\beta < 1$ (E9).
    UpperSimple,
    /// The combination region (CIR) where $\omega_1 + \omega_2 = 2\Omega$, Eq. (16); only for
    /// $\beta < 2$.
    Combination,
}

impl RegionKind {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Simple, Self::UpperSimple, Self::Combination];

    /// The name in texts, such as `simple instability region`.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Simple => "simple instability region",
            Self::UpperSimple => "upper simple instability region",
            Self::Combination => "combination instability region",
        }
    }

    /// The short name in the names of quantities: `sir`, `upper_sir`, `cir`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Simple => "sir",
            Self::UpperSimple => "upper_sir",
            Self::Combination => "cir",
        }
    }

    /// What keeps the whirl frequencies from the region's condition where $\beta$ is too large.
    const fn why_none(self) -> &'static str {
        match self {
            Self::Simple | Self::UpperSimple => "the forward whirl is faster than the rotor",
            Self::Combination => "the forward whirl is faster than twice the rotor",
        }
    }

    /// The region exists only for $\beta$ below this.
    pub(crate) const fn inertia_ratio_limit(self) -> Option<f64> {
        match self {
            Self::Simple => None,
            Self::UpperSimple => Some(1.0),
            Self::Combination => Some(2.0),
        }
    }
}

impl fmt::Display for RegionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Why a rotor has no such region, or the region no such quantity.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoRegion {
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
    StiffnessNotPositive {
        /// $\delta$.
        delta: f64,
        /// $\gamma$.
        gamma: f64,
        /// $\delta - \gamma^2$.
        value: f64,
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
    #[error("{quantity} of the {} comes out as {value}; it must be a finite number", .kind.description())]
    NotFinite {
        /// The region asked for.
        kind: RegionKind,
        /// The quantity.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

/// Why a width has no gradient.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoGradient {
    /// The rotor has no coefficients in double precision.
    #[error(transparent)]
    Coefficients(#[from] NoCoefficients),
    /// It has no such region.
    #[error(transparent)]
    Region(#[from] NoRegion),
    /// The gradient of this width is not generated.
    #[error(
        "the width of the upper simple instability region has no gradient here; those of the simple and of the combination region have one"
    )]
    UpperSimple,
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
}

/// Start of the region on the axis of speeds, in units of the reference speed, Eqs. (15), (16).
///
/// # Errors
/// Where the region does not exist.
pub fn start(kind: RegionKind, c: &Coefficients) -> Result<f64, NoRegion> {
    require_region(kind, c)?;
    let start = match kind {
        RegionKind::Simple => equations::sir_start::value(c),
        RegionKind::UpperSimple => equations::upper_sir_start::value(c),
        RegionKind::Combination => equations::cir_start::value(c),
    };
    require_finite(kind, "start", start)
}

/// Width $\lambda$ of the region, in units of the reference speed, Eq. (31).
///
/// A combination region at $\gamma = 0$ has the width 0: without coupling there is no combination of
/// the two motions.
///
/// # Errors
/// Where the region does not exist.
pub fn width(kind: RegionKind, c: &Coefficients) -> Result<f64, NoRegion> {
    start(kind, c)?;
    if uncoupled(kind, c) {
        return Ok(0.0);
    }
    require_growth(kind, c)?;
    let width = match kind {
        RegionKind::Simple => equations::sir_width::value(c),
        RegionKind::UpperSimple => equations::upper_sir_width::value(c),
        RegionKind::Combination => equations::cir_width::value(c),
    };
    require_finite(kind, "width", width)
}

/// Width $\lambda$ of the simple or the combination region, Eq. (31), in units of the reference speed, and its partials
/// by the twelve numeric inputs in the order of [`INPUTS`], each in units of the reference speed per unit of the input.
///
/// # Errors
/// Where the rotor has no coefficients or no such region; for the upper simple region, which has no gradient here; and
/// where the width is zero: there it has a corner, and no gradient.
pub fn width_gradient(kind: RegionKind, rotor: &Rotor) -> Result<(f64, [f64; 12]), NoGradient> {
    width(kind, &rotor.coefficients()?)?;
    let p = rotor.parameters();
    let edge_factor = p.crack_edge.factor();
    let gradient = match rotor.load_case() {
        LoadCase::SupportArm => equations::widths_support_arm::gradient,
        LoadCase::MidspanArm => equations::widths_midspan_arm::gradient,
        LoadCase::SimplySupportedLeft => equations::widths_simply_supported_left::gradient,
        LoadCase::SimplySupportedRight => equations::widths_simply_supported_right::gradient,
    };
    let ((simple, combination), [by_simple, by_combination]) = gradient(p, edge_factor);
    let (width, mut partials) = match kind {
        RegionKind::Simple => (simple, by_simple),
        RegionKind::Combination => (combination, by_combination),
        RegionKind::UpperSimple => return Err(NoGradient::UpperSimple),
    };
    let width = require_finite(kind, "width", width)?;
    if p.crack_depth_ratio == 0.0 && width > 0.0 {
        // The compliances of Eq. (8) start as sigma^2.5 and sigma^3.5, and an open region's width is smooth in them: the
        // partial by the depth is zero. The generated chain rule has 0/0 there, from the slope of the root of sigma.
        for (input, partial) in INPUTS.iter().zip(&mut partials) {
            if input.name == "crack_depth_ratio" {
                *partial = 0.0;
            }
        }
    }
    let mut named = INPUTS.iter().zip(partials);
    match named.find(|(_, partial)| !partial.is_finite()) {
        None => Ok((width, partials)),
        Some((input, value)) => Err(NoGradient::Corner {
            kind,
            input: input.name,
            value,
        }),
    }
}

/// Growth rate $\kappa$, in units of the reference speed, at the detuning
/// $\vartheta = \Omega - \Omega_{s(c)}$ from the start, Eq. (29); zero outside the region.
///
/// # Errors
/// Where the region does not exist, or the detuning is not finite.
pub fn growth_rate(kind: RegionKind, c: &Coefficients, detuning: f64) -> Result<f64, NoRegion> {
    start(kind, c)?;
    require_finite(kind, "detuning", detuning)?;
    if uncoupled(kind, c) {
        return Ok(0.0);
    }
    require_growth(kind, c)?;
    let growth = match kind {
        RegionKind::Simple => equations::sir_growth::value(detuning, c),
        RegionKind::UpperSimple => equations::upper_sir_growth::value(detuning, c),
        RegionKind::Combination => equations::cir_growth::value(detuning, c),
    };
    require_finite(kind, "growth rate", growth)
}

/// The disk asymmetry $\Delta_d$ that closes the region, Eq. (32), as it comes, also where no disk
/// has it: at $\phi = \pi/2$ for a simple region, at $\phi = 0$ for a combination region.
///
/// # Errors
/// Where the region does not exist, or where at $\gamma = 0$ the disk's asymmetry takes no part in it: always in
/// a combination region, in a simple one where that of the transverse motion is meant.
pub fn zup_asymmetry(kind: RegionKind, c: &Coefficients) -> Result<f64, NoRegion> {
    start(kind, c)?;
    if uncoupled(kind, c) {
        return Err(NoRegion::Uncoupled { kind });
    }
    let asymmetry = match kind {
        RegionKind::Simple => equations::sir_zup_asymmetry::value(c),
        RegionKind::UpperSimple => equations::upper_sir_zup_asymmetry::value(c),
        RegionKind::Combination => equations::cir_zup_asymmetry::value(c),
    };
    if c.gamma == 0.0 && !asymmetry.is_finite() {
        return Err(NoRegion::Uncoupled { kind });
    }
    require_finite(kind, "closing disk asymmetry", asymmetry)
}

/// Why the exact ends of a region could not be given.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoEnds {
    /// The rotor has no such region.
    #[error(transparent)]
    Region(#[from] NoRegion),
    /// The region has no two ends, or they were not found.
    #[error(transparent)]
    Stability(#[from] StabilityError),
}

/// The exact ends of the region, without the approximation of Eqs. (24) to (31), in units of the
/// reference speed.
///
/// Simple regions can overlap: where $|\Delta_d| > |\beta - 1|$ one that reaches to infinite speed may
/// hold the other inside it. The simple region's ends are therefore the neighbouring ones that its
/// approximate ends $\Omega_s \pm \lambda_s/2$ approximate best, and the upper simple region has the rest. Where Eq. (31)
/// gives no width, because the two regions start at the same speed, they are the ones nearest to that speed.
///
/// # Errors
/// Where the region does not exist or has no upper end.
pub fn exact_ends(kind: RegionKind, c: &Coefficients) -> Result<Ends, NoEnds> {
    let start = start(kind, c)?;
    if kind == RegionKind::Combination {
        return Ok(exact::combination_ends(c, start)?);
    }
    let ends = exact::simple_region_ends(c)?;
    let simple = simple_pair(&ends, c)?;
    if kind == RegionKind::Simple {
        return Ok(simple);
    }
    let mut rest = ends
        .iter()
        .copied()
        .filter(|&end| end != simple.lower && end != simple.upper);
    match (rest.next(), rest.next()) {
        (Some(lower), Some(upper)) => Ok(Ends { lower, upper }),
        (Some(lower), None) => Err(StabilityError::Unbounded { lower }.into()),
        (None, _) => Err(StabilityError::NoRegion {
            kind: "upper simple",
            reason: "its lower end is beyond every finite speed",
        }
        .into()),
    }
}

/// The neighbouring ends with no stable speed between them that are nearest to the approximate ends.
fn simple_pair(ends: &[f64], c: &Coefficients) -> Result<Ends, NoEnds> {
    let start = start(RegionKind::Simple, c)?;
    // At a double start Eq. (31) is 0/0; the exact ends are there all the same.
    let half_width = 0.5 * width(RegionKind::Simple, c).unwrap_or(0.0);
    let distance = |ends: &Ends| {
        (ends.lower - (start - half_width)).abs() + (ends.upper - (start + half_width)).abs()
    };
    let mut nearest: Option<Ends> = None;
    for (index, pair) in ends.windows(2).enumerate() {
        let [lower, upper] = *pair else { continue };
        // Between the second and the third end an even number of stiffnesses is negative: stable
        // unless two regions overlap there.
        let unstable = index % 2 == 0 || exact::growth_rate(c, 0.5 * (lower + upper))? > 0.0;
        let pair = Ends { lower, upper };
        if unstable
            && nearest
                .as_ref()
                .is_none_or(|best| distance(&pair) < distance(best))
        {
            nearest = Some(pair);
        }
    }
    nearest.ok_or(NoEnds::Stability(StabilityError::NoRegion {
        kind: "simple",
        reason: "no two speeds solve Phi = 0",
    }))
}

/// Whether no combination region can be excited because $\gamma = 0$ and with it every coupling.
fn uncoupled(kind: RegionKind, c: &Coefficients) -> bool {
    kind == RegionKind::Combination && c.gamma == 0.0
}

fn require_region(kind: RegionKind, c: &Coefficients) -> Result<(), NoRegion> {
    for (quantity, value) in [
        ("beta", c.beta),
        ("gamma", c.gamma),
        ("delta", c.delta),
        ("epsilon_1", c.epsilon_1),
        ("epsilon_12", c.epsilon_12),
        ("epsilon_2", c.epsilon_2),
        ("disk_asymmetry", c.disk_asymmetry),
        ("crack_angle", c.crack_angle),
    ] {
        require_finite(kind, quantity, value)?;
    }
    let value = equations::coupled_stiffness(c);
    if value <= 0.0 {
        return Err(NoRegion::StiffnessNotPositive {
            delta: c.delta,
            gamma: c.gamma,
            value,
        });
    }
    match kind.inertia_ratio_limit() {
        Some(limit) if c.beta >= limit => Err(NoRegion::InertiaRatio {
            kind,
            beta: c.beta,
            limit,
        }),
        _ => Ok(()),
    }
}

fn require_growth(kind: RegionKind, c: &Coefficients) -> Result<(), NoRegion> {
    let (omega, speed, strength) = match kind {
        RegionKind::Simple | RegionKind::UpperSimple => {
            let speed = start(kind, c)?;
            (speed, speed, equations::sir_strength(speed, c))
        }
        RegionKind::Combination => {
            let speed = equations::cir_start::value(c);
            let omega = equations::cir_omega::value(c);
            (omega, speed, equations::cir_strength(omega, speed, c))
        }
    };
    let value = equations::peak_growth_squared(omega, speed, strength, c);
    if value < 0.0 {
        Err(NoRegion::GrowthImaginary { kind, value })
    } else {
        Ok(())
    }
}

fn require_finite(kind: RegionKind, quantity: &'static str, value: f64) -> Result<f64, NoRegion> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(NoRegion::NotFinite {
            kind,
            quantity,
            value,
        })
    }
}
