//! Floquet's method: the monodromy matrix by integration over one period, and its multipliers.
//!
//! The integrator is Gragg's modified midpoint rule with Richardson extrapolation (Bulirsch and Stoer): its error
//! expands in even powers of the step, so nine rules give order 18, which suits smooth systems and tight tolerances.
//!
//! A pendulum whose support shakes fast stays upright: y'' − (g − s cos νt) y = 0 does not grow where s is large enough, and does
//! without shaking:
//!
//! ```
//! use nalgebra::DMatrix;
//! use rotor_core::periodic::{FourierMatrix, PeriodicSystem, monodromy};
//!
//! let number = |x| DMatrix::from_element(1, 1, x);
//! let upright = |shaking: f64| {
//!     let stiffness = FourierMatrix::constant(number(-1.0)).with_harmonic(1, number(shaking), number(0.0));
//!     PeriodicSystem::new(20.0, number(1.0), number(0.0), stiffness)
//! };
//! // Without shaking it falls as e^t.
//! assert!((monodromy::growth_rate(&upright(0.0)?, 1e-12)? - 1.0).abs() < 1e-9);
//! assert!(monodromy::growth_rate(&upright(60.0)?, 1e-12)? < 1e-5);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use nalgebra::{Complex, DMatrix, Schur};

use super::system::{Accelerations, PeriodicSystem};
use crate::error::{Error, SystemError, require};

/// Substeps of the midpoint rules, extrapolated in this order.
const SUBSTEPS: [u32; 9] = [2, 4, 6, 8, 10, 12, 14, 16, 18];
/// A number that all of them divide: in these parts of a panel are the times of every rule.
const PARTS: u32 = 5040;
/// Rules after which a converged panel was easy, so that the next may be longer.
const EASY: usize = 7;
/// Cap on the number of panels in one period, failed ones included.
const PANELS: usize = 20_000;
/// Cap on QR sweeps for the multipliers.
const SWEEPS: usize = 1_000;

/// The greatest growth rate, max ln|multiplier| / period, in the inverse of the system's unit of time. Negative where
/// every motion decays; of an undamped stable system about ± `tolerance` is left.
///
/// `tolerance` bounds the error of each panel relative to the largest entry of the fundamental matrix, 1e-14 to 0.1.
/// The growth rate is right to about `tolerance` / period, and to its square root where two multipliers coincide, as
/// they do at the ends of a region.
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for the tolerance; [`SystemError::SingularMass`];
/// [`SystemError::NoConvergence`] where the period needs too many panels.
pub fn growth_rate(system: &PeriodicSystem, tolerance: f64) -> Result<f64, Error> {
    let greatest = multipliers(system, tolerance)?
        .iter()
        .map(|multiplier| multiplier.norm())
        .fold(0.0, f64::max);
    let growth = greatest.ln() / system.period();
    Ok(require(
        "the greatest growth rate",
        growth,
        true,
        "a finite number; the motion over one period must not vanish or overflow",
    )?)
}

/// The 2n Floquet multipliers of `system`, the eigenvalues of its [`monodromy_matrix`].
///
/// # Errors
///
/// As [`growth_rate`].
pub fn multipliers(system: &PeriodicSystem, tolerance: f64) -> Result<Vec<Complex<f64>>, Error> {
    let matrix = monodromy_matrix(system, tolerance)?;
    let schur = Schur::try_new(matrix, f64::EPSILON, SWEEPS).ok_or(SystemError::NoConvergence {
        what: "the Floquet multipliers",
        iterations: SWEEPS,
    })?;
    Ok(schur.complex_eigenvalues().iter().copied().collect())
}

/// The 2n × 2n matrix that takes [q; q̇] over one period 2π/frequency.
///
/// # Errors
///
/// As [`growth_rate`].
pub fn monodromy_matrix(system: &PeriodicSystem, tolerance: f64) -> Result<DMatrix<f64>, Error> {
    require(
        "tolerance",
        tolerance,
        (1e-14..=0.1).contains(&tolerance),
        "1e-14 to 0.1",
    )?;
    let size = 2 * system.degrees_of_freedom();
    let period = system.period();
    let accelerations = system.accelerations()?;
    let mut state = DMatrix::identity(size, size);
    let (mut time, mut panel) = (0.0, 0.125 * period);
    for _ in 0..PANELS {
        let left = period - time;
        let last = panel >= left * (1.0 - 1e-10);
        let length = if last { left } else { panel };
        let stretch = Panel::new(&accelerations, time, length);
        match extrapolated(stretch, &state, tolerance)? {
            Some((next, _)) if last => return Ok(next),
            Some((next, rules)) => {
                state = next;
                time += length;
                if rules < EASY {
                    panel *= 1.5;
                }
            }
            None => panel = 0.5 * length,
        }
    }
    Err(SystemError::NoConvergence {
        what: "the monodromy matrix",
        iterations: PANELS,
    }
    .into())
}

/// A stretch of time, and the accelerations at the times in it: most rules ask for times of the rules before them.
struct Panel<'a> {
    accelerations: &'a Accelerations<'a>,
    start: f64,
    length: f64,
    known: BTreeMap<u32, DMatrix<f64>>,
}

impl<'a> Panel<'a> {
    const fn new(accelerations: &'a Accelerations<'a>, start: f64, length: f64) -> Self {
        Self {
            accelerations,
            start,
            length,
            known: BTreeMap::new(),
        }
    }

    /// d/dt of [q; q̇] for each column of `state`, after so many of the panel's [`PARTS`].
    fn derivative(&mut self, state: &DMatrix<f64>, parts: u32) -> Result<DMatrix<f64>, Error> {
        let matrix = match self.known.entry(parts) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => {
                let time = self.start + self.length * (f64::from(parts) / f64::from(PARTS));
                place.insert(self.accelerations.at(time)?)
            }
        };
        let n = state.nrows() / 2;
        let mut result = DMatrix::zeros(2 * n, state.ncols());
        result.rows_mut(0, n).copy_from(&state.rows(n, n));
        matrix.mul_to(state, &mut result.rows_mut(n, n));
        Ok(result)
    }

    /// The state at the end by Gragg's rule with `substeps` (even) steps and smoothing at the end.
    fn midpoint(&mut self, state: &DMatrix<f64>, substeps: u32) -> Result<DMatrix<f64>, Error> {
        let step = self.length / f64::from(substeps);
        let parts = PARTS / substeps;
        let mut before = state.clone();
        let mut here = state + self.derivative(state, 0)? * step;
        for index in 1..substeps {
            let slope = self.derivative(&here, index * parts)?;
            let next = &before + slope * (2.0 * step);
            before = std::mem::replace(&mut here, next);
        }
        let slope = self.derivative(&here, PARTS)?;
        Ok((before + &here + slope * step) * 0.5)
    }
}

/// The state after one panel and the number of rules it took, or `None` if the last of them still differed.
fn extrapolated(
    mut panel: Panel<'_>,
    state: &DMatrix<f64>,
    tolerance: f64,
) -> Result<Option<(DMatrix<f64>, usize)>, Error> {
    // The last row of the triangle of extrapolations, the highest order at its end.
    let mut row: Vec<DMatrix<f64>> = Vec::with_capacity(SUBSTEPS.len());
    for (rule, &substeps) in SUBSTEPS.iter().enumerate() {
        let mut entry = panel.midpoint(state, substeps)?;
        for (column, coarser) in SUBSTEPS[..rule].iter().rev().enumerate() {
            let ratio = f64::from(substeps) / f64::from(*coarser);
            let better = &entry + (&entry - &row[column]) / (ratio * ratio - 1.0);
            row[column] = std::mem::replace(&mut entry, better);
        }
        // `row` now has this rule's orders but the last, which is `entry`.
        let settled = row
            .last()
            .is_some_and(|lower| (&entry - lower).amax() <= tolerance * entry.amax().max(1.0));
        row.push(entry);
        if settled {
            return Ok(row.pop().map(|best| (best, rule + 1)));
        }
    }
    Ok(None)
}
