//! Scans of the paper's rotor over crack depth and angle, as users run them.

use rotor_core::input::NumericInput;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{Axis, Control, Plan, Reduction, Scan, Statistic};

use super::{Bench, CaseError, Outcome, processors};
use crate::inputs::{self, ROTOR};

/// The input of a name.
fn input(name: &'static str) -> Result<&'static NumericInput, CaseError> {
    NumericInput::find(name).ok_or(CaseError::Input { name })
}

/// A scan of both widths over so many depths and angles.
fn scan(depths: usize, angles: usize) -> Result<Scan, CaseError> {
    let rotor = Rotor::new(ROTOR).map_err(|_| CaseError::Rotor {
        depth: ROTOR.crack_depth_ratio,
    })?;
    let depths = Axis::listed(input("crack_depth_ratio")?, inputs::depths(depths))?;
    let angles = Axis::listed(input("crack_angle")?, inputs::angles(angles))?;
    let scan = Scan::of(&rotor).vary(depths).vary(angles);
    Ok(scan
        .quantity(Quantity::SirWidth)
        .quantity(Quantity::CirWidth))
}

/// On so many threads.
fn on(threads: usize) -> Control<'static> {
    Control {
        threads: Some(threads),
        ..Control::default()
    }
}

pub(super) fn grid_sigma_phi(bench: &mut Bench) -> Outcome {
    collected(bench, 1)
}

pub(super) fn grid_sigma_phi_threads(bench: &mut Bench) -> Outcome {
    collected(bench, processors())
}

/// Both widths over the whole grid, into memory that is kept from run to run.
fn collected(bench: &mut Bench, threads: usize) -> Outcome {
    let size = bench.sizes.grid;
    let plan: Plan = scan(size, size)?.plan()?;
    bench.is_collected = true;
    Ok(plan.collect_into(&mut bench.collected, &on(threads))?)
}

/// Depths of the whole maximum over those of the one beside other tools.
pub(super) const DEPTHS_OF_WHOLE: usize = 50;

pub(super) fn max_over_phi(bench: &mut Bench) -> Outcome {
    greatest(bench, bench.sizes.max_rows)
}

pub(super) fn max_over_phi_whole(bench: &mut Bench) -> Outcome {
    greatest(bench, DEPTHS_OF_WHOLE * bench.sizes.max_rows)
}

/// The greatest widths over the angle, for each of so many depths.
fn greatest(bench: &mut Bench, depths: usize) -> Outcome {
    let reduction = Reduction::new(Statistic::Maximum).over(input("crack_angle")?);
    let plan = scan(depths, bench.sizes.max_angles)?
        .reduce(reduction)
        .plan()?;
    let report = plan.reduce(&on(1))?;
    bench.shaped(2, depths);
    for (quantity, result) in bench.results.iter_mut().enumerate() {
        let found = report.reduced.first();
        for (depth, result) in result.iter_mut().enumerate() {
            let greatest = found.and_then(|found| found.value(quantity, depth as u64));
            *result = greatest.ok_or(CaseError::Rotor {
                depth: depth as f64,
            })?;
        }
    }
    Ok(())
}
