//! Zero unstable points (ZUP): the crack angle, depth and position that close a region, Eq. (32).
//!
//! ```
//! use rotor_core::jeffcott::region::RegionKind;
//! use rotor_core::jeffcott::rotor::Rotor;
//! use rotor_core::jeffcott::zup::zup_depth;
//!
//! // The crack that closes the simple region of the paper's rotor, and the angle that it has to have.
//! let rotor = Rotor::paper();
//! let closing = zup_depth(&rotor, RegionKind::Simple)?;
//! let [point] = closing[..] else { panic!("one depth") };
//! let cracked = rotor.with(|p| {
//!     p.crack_depth_ratio = point.value;
//!     p.crack_angle = point.crack_angle;
//! })?;
//! assert!(cracked.region(RegionKind::Simple)?.width()? < 1e-9);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

mod roots;
#[cfg(test)]
mod tests;

use std::f64::consts::FRAC_PI_2;

use crate::equations::{self, Coefficients};
use crate::error::{Error, RegionError};
use crate::input::RotorParameters;
use crate::jeffcott::region::{Region, RegionKind};
use crate::jeffcott::rotor::Rotor;

use roots::Sample;

/// A point at which a region is closed: its width, Eq. (31), is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ZeroUnstablePoint {
    /// The crack's depth ratio or position ratio, whichever was asked for.
    pub value: f64,
    /// The crack's angle $\phi$ at which the region closes there, rad: $\pi/2$ or 0.
    pub crack_angle: f64,
}

/// The crack angle at which the region is narrowest, and closed if the disk's asymmetry is that of
/// Eq. (32): $\pi/2$ where the crack and the disk excite alike ($\Theta_1\Theta_2 > 0$), 0 where they
/// oppose each other (Section 4.2). Where one of them is zero every angle gives the same width, and
/// the answer is $\pi/2$.
///
/// # Errors
/// Where the region does not exist.
pub fn zup_angle(kind: RegionKind, c: &Coefficients) -> Result<f64, RegionError> {
    let region = Region::of(kind, c)?;
    // The closing asymmetry is that of Eq. (32) at pi/2 in a simple region, at 0 in a combination region, and keeps its
    // sign where displacement and tilt are nearly uncoupled. The raw excitations lose theirs there, as H or its partner
    // goes to zero.
    let closing = match region.zup_asymmetry() {
        Ok(closing) => closing,
        Err(RegionError::Uncoupled { .. }) => return Ok(FRAC_PI_2),
        Err(reason) => return Err(reason),
    };
    let product = closing * c.disk_asymmetry;
    let at_zero = match kind {
        RegionKind::Simple | RegionKind::UpperSimple => product < 0.0,
        RegionKind::Combination => product > 0.0,
    };
    Ok(if at_zero { 0.0 } else { FRAC_PI_2 })
}

/// The crack angles $\phi \in [0, \pi)$ that close the region of this rotor: none, or the one of [`zup_angle`] where the
/// excitations of crack and disk are equally large, $|\Theta_1| = |\Theta_2|$ in Eq. (25), to within their rounding. The
/// rotor's own angle does not matter.
///
/// # Errors
/// Where the region does not exist, and where it is closed at every angle because nothing excites it.
pub fn zup_crack_angle(rotor: &Rotor, kind: RegionKind) -> Result<Vec<ZeroUnstablePoint>, Error> {
    let c = rotor.coefficients()?;
    let angle = zup_angle(kind, &c)?;
    let region = Region::of(kind, &c)?;
    let closing = match region.zup_asymmetry() {
        Ok(closing) => closing,
        // The disk takes no part: only a region that is closed at every angle is closed at one.
        Err(RegionError::Uncoupled { .. }) if region.width()? == 0.0 => {
            return Err(RegionError::ClosedEverywhere { kind }.into());
        }
        Err(RegionError::Uncoupled { .. }) => return Ok(vec![]),
        Err(reason) => return Err(reason.into()),
    };
    if closing == 0.0 && c.disk_asymmetry == 0.0 {
        return Err(RegionError::ClosedEverywhere { kind }.into());
    }
    let apart = (closing.abs() - c.disk_asymmetry.abs()).abs();
    let closed = apart <= closing_rounding(kind, &c);
    Ok(if closed {
        vec![ZeroUnstablePoint {
            value: angle,
            crack_angle: angle,
        }]
    } else {
        vec![]
    })
}

/// A bound on the rounding error of the closing asymmetry, Eq. (32): that of each term of its numerator and denominator,
/// with the rounding of the frequencies in them, which are right to some ten roundings each.
fn closing_rounding(kind: RegionKind, c: &Coefficients) -> f64 {
    let (omega, speed, excess) = match kind {
        RegionKind::Simple => {
            let speed = equations::sir_start::value(c);
            (speed, speed, 1.0)
        }
        RegionKind::UpperSimple => {
            let speed = equations::upper_sir_start::value(c);
            (speed, speed, 1.0)
        }
        RegionKind::Combination => (
            equations::cir_omega::value(c),
            equations::cir_start::value(c),
            2.0,
        ),
    };
    let partner = 2.0 * speed - omega;
    // The sizes of the terms of H and G, and what is left of them.
    let sizes = |omega: f64| {
        let h = 1.0 + omega * omega;
        let g = c.delta + omega * omega + c.beta * speed * omega;
        [h, g]
    };
    let [h_size, g_size] = sizes(omega);
    let [h_bar_size, g_bar_size] = sizes(partner);
    let (h_most, g_most) = (h_size.max(h_bar_size), g_size.max(g_bar_size));
    let numerator = c.epsilon_1.abs() * g_most
        + c.epsilon_12.abs() * (c.gamma.powi(2) + h_most * g_most)
        + (c.epsilon_2 * c.delta).abs() * h_most
        + c.disk_asymmetry.abs() * omega * partner * h_most;
    let (h, h_bar) = (equations::transverse(omega), equations::transverse(partner));
    let left = if kind == RegionKind::Combination {
        h - h_bar
    } else {
        equations::coupled_transverse(h, equations::tilting(omega, speed, c), c)
    };
    CLOSING_ROUNDINGS * excess * f64::EPSILON * numerator / (omega * partner * left).abs()
}

/// The depths $\sigma \in (0, 1]$ of the rotor's crack at which the region closes at the crack angle
/// returned with each, in rising order; empty where there is none. The rotor's own depth and angle do
/// not matter. The search has 128 cells, and finds two such depths within one of them where the closing asymmetry comes nearer to
/// the disk's there than at the cell's ends.
///
/// # Errors
/// Where the region exists at no depth.
pub fn zup_depth(rotor: &Rotor, kind: RegionKind) -> Result<Vec<ZeroUnstablePoint>, Error> {
    let grid: Vec<f64> = (0..=DEPTHS)
        .map(|i| f64::from(i) / f64::from(DEPTHS))
        .collect();
    search(rotor, kind, &grid, |p, depth| p.crack_depth_ratio = depth)
}

/// The positions $l_c/L \in (0, 1)$ of the rotor's crack at which the region closes at the crack
/// angle returned with each, in rising order; empty where there is none. The rotor's own position and
/// angle do not matter. The search has the resolution of [`zup_depth`].
///
/// # Errors
/// Where the region exists at no position, and where without crack and asymmetry it is closed at all of them.
pub fn zup_position(rotor: &Rotor, kind: RegionKind) -> Result<Vec<ZeroUnstablePoint>, Error> {
    let disk = rotor.parameters().disk_position_ratio;
    let mut grid: Vec<f64> = (1..POSITIONS)
        .map(|i| f64::from(i) / f64::from(POSITIONS))
        .collect();
    // Near these the closing asymmetry may change within a part of the disk's distance from a support: the supports, midspan,
    // the disk and its mirror image, and where the crack's moment from a support's reaction is zero.
    for special in [0.0, 1.0, 0.5, disk, 1.0 - disk, 0.5 - disk, 1.5 - disk] {
        let steps = (1..=HALVINGS).map(|count| 0.5_f64.powi(count));
        grid.extend(steps.flat_map(|step| [special - step, special + step]));
        grid.push(special);
    }
    // The loads of a simply supported beam jump where the crack passes the disk.
    grid.push(disk.next_down());
    grid.retain(|&position| position > 0.0 && position < 1.0);
    grid.sort_by(f64::total_cmp);
    grid.dedup();
    search(rotor, kind, &grid, |p, position| {
        p.crack_position_ratio = position
    })
}

/// Cells of the search in depth and in position.
const DEPTHS: i32 = 128;
const POSITIONS: i32 = 128;
/// How near to a special position samples are: 2⁻³⁰ of the shaft's length, each twice as near as the one before.
const HALVINGS: i32 = 30;
/// Roundings of each term of the closing asymmetry: ten in each frequency, and its operations.
const CLOSING_ROUNDINGS: f64 = 32.0;

fn search(
    rotor: &Rotor,
    kind: RegionKind,
    grid: &[f64],
    set: impl Fn(&mut RotorParameters, f64),
) -> Result<Vec<ZeroUnstablePoint>, Error> {
    let at = |value: f64| -> Result<(Coefficients, f64), Error> {
        let c = rotor.with(|p| set(p, value))?.coefficients()?;
        let asymmetry = Region::of(kind, &c)?.zup_asymmetry()?;
        Ok((c, asymmetry))
    };
    let asymmetry = rotor.parameters().disk_asymmetry.abs();
    let mut samples = Vec::with_capacity(grid.len());
    let mut first_reason = None;
    for &value in grid {
        match at(value) {
            Ok((c, closing)) => samples.push(Some((value, weight(kind, &c), closing))),
            Err(reason) => {
                first_reason.get_or_insert(reason);
                samples.push(None);
            }
        }
    }
    if let (true, Some(reason)) = (samples.iter().all(Option::is_none), first_reason) {
        return Err(reason);
    }
    let no_excitation = |&(_, _, closing): &(f64, f64, f64)| closing == 0.0;
    if asymmetry == 0.0 && samples.iter().flatten().all(no_excitation) {
        return Err(RegionError::ClosedEverywhere { kind }.into());
    }
    let mut points = Vec::new();
    let signed = if asymmetry == 0.0 {
        vec![0.0]
    } else {
        vec![asymmetry, -asymmetry]
    };
    for target in signed {
        let residual = |value: f64| {
            at(value)
                .ok()
                .map(|(c, closing)| weight(kind, &c) * (closing - target))
        };
        let sampled = with_gaps(&samples, target);
        for roots::Found {
            x: value,
            is_crossing,
        } in roots::sign_changes(&sampled, residual)
        {
            let Ok((c, closing)) = at(value) else {
                continue;
            };
            let touches = || (closing - target).abs() <= closing_rounding(kind, &c);
            if value > 0.0 && (is_crossing || touches()) {
                points.push(ZeroUnstablePoint {
                    value,
                    crack_angle: zup_angle(kind, &c)?,
                });
            }
        }
    }
    points.sort_by(|a, b| a.value.total_cmp(&b.value));
    Ok(points)
}

/// What is to be zero at the samples, each of them the variable, its weight and the closing asymmetry, with a gap between
/// neighbouring doubles: no root is between these, but there may be a jump.
fn with_gaps(samples: &[Option<(f64, f64, f64)>], target: f64) -> Vec<Option<Sample>> {
    let mut gapped: Vec<Option<Sample>> = Vec::with_capacity(samples.len());
    for sample in samples {
        let sample = sample.map(|(x, weight, closing)| Sample {
            x,
            y: weight * (closing - target),
        });
        if let (Some(Some(before)), Some(next)) = (gapped.last(), sample)
            && before.x.next_up() == next.x
        {
            gapped.push(None);
        }
        gapped.push(sample);
    }
    gapped
}

/// What makes the closing asymmetry continuous: that of a combination region has a pole where
/// $\gamma$ changes its sign. A simple region's never changes sign through infinity.
fn weight(kind: RegionKind, c: &Coefficients) -> f64 {
    match kind {
        RegionKind::Simple | RegionKind::UpperSimple => 1.0,
        RegionKind::Combination => c.gamma,
    }
}
