//! Unstable regions: where they start, how wide they are, how fast they grow, what closes them.
//!
//! The numbers come from [`equations`]; this module knows which regions exist and says why one does not.
//!
//! ```
//! use rotor_core::jeffcott::region::RegionKind;
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! let rotor = Rotor::paper().with(|p| p.crack_depth_ratio = 0.1)?;
//! let simple = rotor.region(RegionKind::Simple)?;
//! let (start, width, ends) = (simple.start(), simple.width()?, simple.exact_ends()?);
//! // Eq. (31) approximates the exact width, Eq. (15) the middle.
//! assert!((ends.width() - width).abs() < 0.05 * width);
//! assert!(ends.lower < start && start < ends.upper);
//! // Growth is fastest near the start, and there is none outside.
//! assert!(simple.growth_rate(0.0)? > 0.0);
//! assert_eq!(simple.growth_rate(width)?, 0.0);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

#[cfg(test)]
mod tests;

use crate::equations::{self, Coefficients};
use crate::error::{Error, RegionError};
use crate::input::INPUTS;
use crate::jeffcott::exact::{self, Ends};
use crate::jeffcott::rotor::{LoadCase, Rotor};

pub use crate::region::RegionKind;

/// An instability region that exists for a rotor's coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    kind: RegionKind,
    coefficients: Coefficients,
    start: f64,
}

impl Region {
    /// Finds the region of a rotor with these coefficients.
    ///
    /// # Errors
    /// Where the region does not exist.
    pub fn of(kind: RegionKind, coefficients: &Coefficients) -> Result<Self, RegionError> {
        require_region(kind, coefficients)?;
        let start = match kind {
            RegionKind::Simple => equations::sir_start::value(coefficients),
            RegionKind::UpperSimple => equations::upper_sir_start::value(coefficients),
            RegionKind::Combination => equations::cir_start::value(coefficients),
        };
        Ok(Self {
            kind,
            coefficients: *coefficients,
            start: require_finite(kind, "start", start)?,
        })
    }

    /// Its kind.
    pub const fn kind(&self) -> RegionKind {
        self.kind
    }

    /// Where it starts on the axis of speeds, in units of the reference speed, Eqs. (15), (16).
    pub const fn start(&self) -> f64 {
        self.start
    }

    /// Width $\lambda$, in units of the reference speed, Eq. (31).
    ///
    /// A combination region at $\gamma = 0$ has the width 0: without coupling there is no combination of
    /// the two motions.
    ///
    /// # Errors
    /// Where Eq. (29) gives no growth rate at the start, or the width is not finite.
    pub fn width(&self) -> Result<f64, RegionError> {
        if self.is_uncoupled() {
            return Ok(0.0);
        }
        self.require_growth()?;
        let c = &self.coefficients;
        let width = match self.kind {
            RegionKind::Simple => equations::sir_width::value(c),
            RegionKind::UpperSimple => equations::upper_sir_width::value(c),
            RegionKind::Combination => equations::cir_width::value(c),
        };
        require_finite(self.kind, "width", width)
    }

    /// Growth rate $\kappa$, in units of the reference speed, at the detuning
    /// $\vartheta = \Omega - \Omega_{s(c)}$ from the start, Eq. (29); zero outside the region.
    ///
    /// # Errors
    /// Where the detuning is not finite, or Eq. (29) gives no growth rate at the start.
    pub fn growth_rate(&self, detuning: f64) -> Result<f64, RegionError> {
        require_finite(self.kind, "detuning", detuning)?;
        if self.is_uncoupled() {
            return Ok(0.0);
        }
        self.require_growth()?;
        let c = &self.coefficients;
        let growth = match self.kind {
            RegionKind::Simple => equations::sir_growth::value(detuning, c),
            RegionKind::UpperSimple => equations::upper_sir_growth::value(detuning, c),
            RegionKind::Combination => equations::cir_growth::value(detuning, c),
        };
        require_finite(self.kind, "growth rate", growth)
    }

    /// The disk asymmetry $\Delta_d$ that closes the region, Eq. (32), as it comes, also where no disk
    /// has it: at $\phi = \pi/2$ for a simple region, at $\phi = 0$ for a combination region.
    ///
    /// # Errors
    /// Where at $\gamma = 0$ the disk's asymmetry takes no part in it: always in a combination region, in a simple one where
    /// that of the transverse motion is meant.
    pub fn zup_asymmetry(&self) -> Result<f64, RegionError> {
        let (kind, c) = (self.kind, &self.coefficients);
        if self.is_uncoupled() {
            return Err(RegionError::Uncoupled { kind });
        }
        let asymmetry = match kind {
            RegionKind::Simple => equations::sir_zup_asymmetry::value(c),
            RegionKind::UpperSimple => equations::upper_sir_zup_asymmetry::value(c),
            RegionKind::Combination => equations::cir_zup_asymmetry::value(c),
        };
        if c.gamma == 0.0 && !asymmetry.is_finite() {
            return Err(RegionError::Uncoupled { kind });
        }
        require_finite(kind, "closing disk asymmetry", asymmetry)
    }

    /// The exact ends, without the approximation of Eqs. (24) to (31), in units of the reference speed.
    ///
    /// Between the ends of a region every speed is unstable; [`regions`](exact::regions::regions) has every interval in which
    /// that is so, joined where they touch.
    ///
    /// Simple regions can overlap: where $|\Delta_d| > |\beta - 1|$ one that reaches to infinite speed may
    /// hold the other inside it. The simple region's ends are therefore the neighbouring ones that its
    /// approximate ends $\Omega_s \pm \lambda_s/2$ approximate best, and the upper simple region has the rest. Where Eq. (31)
    /// gives no width, because the two regions start at the same speed, they are the ones nearest to that speed.
    ///
    /// # Errors
    /// Where the region has no upper end, or its ends are not found.
    pub fn exact_ends(&self) -> Result<Ends, Error> {
        let c = &self.coefficients;
        if self.kind == RegionKind::Combination {
            return exact::combination_ends(c, self.start);
        }
        let ends = exact::simple_region_ends(c)?;
        let place = simple_pair(&ends, c)?;
        let (before, rest) = ends.split_at(place);
        let (simple, behind) = rest.split_at(2);
        if self.kind == RegionKind::Simple
            && let [lower, upper] = *simple
        {
            return Ok(Ends { lower, upper });
        }
        match *[before, behind].concat() {
            [lower, upper, ..] => Ok(Ends { lower, upper }),
            [lower] => Err(RegionError::Unbounded { lower }.into()),
            [] => Err(RegionError::NoExactEnds {
                kind: self.kind,
                reason: "its lower end is beyond every finite speed",
            }
            .into()),
        }
    }

    /// Whether it cannot be excited because $\gamma = 0$ and with it every coupling.
    fn is_uncoupled(&self) -> bool {
        self.kind == RegionKind::Combination && self.coefficients.gamma == 0.0
    }

    fn require_growth(&self) -> Result<(), RegionError> {
        let (kind, c) = (self.kind, &self.coefficients);
        let (omega, speed, strength) = match kind {
            RegionKind::Simple | RegionKind::UpperSimple => {
                let speed = self.start;
                (speed, speed, equations::sir_strength(speed, c))
            }
            RegionKind::Combination => {
                let speed = self.start;
                let omega = equations::cir_omega::value(c);
                (omega, speed, equations::cir_strength(omega, speed, c))
            }
        };
        let value = equations::peak_growth_squared(omega, speed, strength, c);
        if value < 0.0 {
            Err(RegionError::GrowthImaginary { kind, value })
        } else {
            Ok(())
        }
    }
}

impl Rotor {
    /// Finds an instability region of the rotor.
    ///
    /// # Errors
    /// Where the rotor has no coefficients in double precision, or no such region.
    pub fn region(&self, kind: RegionKind) -> Result<Region, Error> {
        Ok(Region::of(kind, &self.coefficients()?)?)
    }

    /// Width $\lambda$ of a region, Eq. (31), in units of the reference speed, and its partials by the twelve numeric inputs in
    /// the order of [`INPUTS`], each in units of the reference speed per unit of the input.
    ///
    /// # Errors
    /// Where the rotor has no coefficients or no such region, and where the width is zero: there it has a corner, and no gradient.
    pub fn width_gradient(&self, kind: RegionKind) -> Result<(f64, [f64; 12]), Error> {
        let width = self.region(kind)?.width()?;
        let p = self.parameters();
        let (edge_factor, case) = (p.crack_edge.factor(), self.load_case());
        let mut partials = match kind {
            RegionKind::UpperSimple => {
                let gradient = match case {
                    LoadCase::SupportArm => equations::upper_width_support_arm::gradient,
                    LoadCase::MidspanArm => equations::upper_width_midspan_arm::gradient,
                    LoadCase::SimplySupportedLeft => {
                        equations::upper_width_simply_supported_left::gradient
                    }
                    LoadCase::SimplySupportedRight => {
                        equations::upper_width_simply_supported_right::gradient
                    }
                };
                gradient(p, edge_factor).1
            }
            RegionKind::Simple | RegionKind::Combination => {
                let gradient = match case {
                    LoadCase::SupportArm => equations::widths_support_arm::gradient,
                    LoadCase::MidspanArm => equations::widths_midspan_arm::gradient,
                    LoadCase::SimplySupportedLeft => {
                        equations::widths_simply_supported_left::gradient
                    }
                    LoadCase::SimplySupportedRight => {
                        equations::widths_simply_supported_right::gradient
                    }
                };
                let [by_simple, by_combination] = gradient(p, edge_factor).1;
                if kind == RegionKind::Simple {
                    by_simple
                } else {
                    by_combination
                }
            }
        };
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
            Some((input, value)) => Err(RegionError::Corner {
                kind,
                input: input.name,
                value,
            }
            .into()),
        }
    }
}

/// The place of the first of the neighbouring ends with no stable speed between them that are nearest to the approximate ends.
fn simple_pair(ends: &[f64], c: &Coefficients) -> Result<usize, Error> {
    let region = Region::of(RegionKind::Simple, c)?;
    let start = region.start();
    // At a double start Eq. (31) is 0/0; the exact ends are there all the same.
    let half_width = 0.5 * region.width().unwrap_or(0.0);
    let mut nearest: Option<(usize, f64)> = None;
    for (place, pair) in ends.windows(2).enumerate() {
        let [lower, upper] = *pair else { continue };
        // Between the second and the third end an even number of stiffnesses is negative: stable unless two regions overlap
        // there. A combination region may lie there as well, with stable speeds beside it.
        let unstable = place % 2 == 0 || are_all_unstable(c, lower, upper)?;
        let distance = (lower - (start - half_width)).abs() + (upper - (start + half_width)).abs();
        if unstable && nearest.is_none_or(|(_, least)| distance < least) {
            nearest = Some((place, distance));
        }
    }
    let none = RegionError::NoExactEnds {
        kind: RegionKind::Simple,
        reason: "no two speeds solve Phi = 0",
    };
    Ok(nearest.ok_or(none)?.0)
}

/// Where between two ends the motion is looked at before whole numbers decide.
const PARTS_BETWEEN: [f64; 5] = [0.5, 1e-6, 1.0 - 1e-6, 0.25, 0.75];

/// Whether the motion is unstable at every speed between two ends.
fn are_all_unstable(c: &Coefficients, lower: f64, upper: f64) -> Result<bool, Error> {
    // Some speeds, those near the ends among them, are the quick way to a no.
    for part in PARTS_BETWEEN {
        if exact::growth_rate(c, lower + part * (upper - lower))? == 0.0 {
            return Ok(false);
        }
    }
    // The ends are those of regions but for their last digit.
    let [lowest, highest] = [
        lower * (1.0 + 4.0 * f64::EPSILON),
        upper * (1.0 - 4.0 * f64::EPSILON),
    ];
    let regions = exact::regions::regions(c)?;
    let mut holds = regions
        .iter()
        .map(|range| range.lower <= lowest && highest <= range.upper);
    Ok(holds.any(|holds| holds))
}

fn require_region(kind: RegionKind, c: &Coefficients) -> Result<(), RegionError> {
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
        return Err(RegionError::MeanStiffnessNotPositive {
            delta: c.delta,
            gamma: c.gamma,
            value,
        });
    }
    match kind.inertia_ratio_limit() {
        Some(limit) if c.beta >= limit => Err(RegionError::InertiaRatio {
            kind,
            beta: c.beta,
            limit,
        }),
        _ => Ok(()),
    }
}

fn require_finite(
    kind: RegionKind,
    quantity: &'static str,
    value: f64,
) -> Result<f64, RegionError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(RegionError::NotFinite {
            kind,
            quantity,
            value,
        })
    }
}
