//! The greatest widths over the angle, of which no column is kept.

use lanes::{Consumer, Level, Pack, Simd, fold};
use rotor_core::equations::both_widths_squared::along_crack_angle as squares_along_angle;

use super::{Bench, Outcome, coefficients, columns_error, tables};
use crate::inputs;

/// The greatest of each result, none of which is negative.
struct Greatest;

impl Consumer<2> for Greatest {
    type Lanes<S: Simd> = [Pack<S>; 2];
    type Output = [f64; 2];

    #[inline(always)]
    fn begin<S: Simd>(&self, simd: S) -> [Pack<S>; 2] {
        [Pack::splat(simd, 0.0); 2]
    }

    #[inline(always)]
    fn take<S: Simd>(
        &mut self,
        lanes: &mut [Pack<S>; 2],
        _: usize,
        _: usize,
        results: &[Pack<S>; 2],
    ) {
        for (greatest, result) in lanes.iter_mut().zip(results) {
            // Beyond the last row a pack repeats rows that are there.
            *greatest = greatest.max(*result);
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, lanes: [Pack<S>; 2]) -> [f64; 2] {
        lanes.map(|pack| pack.as_slice().iter().copied().fold(0.0, f64::max))
    }
}

/// Depths of the whole maximum over those of the one beside other tools.
pub(super) const DEPTHS_OF_WHOLE: usize = 50;

/// Angles whose tables stay in the nearest cache while the rows pass.
const ANGLES: usize = 1024;

pub(super) fn max_over_phi(bench: &mut Bench) -> Outcome {
    greatest_widths(bench, bench.sizes.max_rows)
}

pub(super) fn max_over_phi_whole(bench: &mut Bench) -> Outcome {
    greatest_widths(bench, DEPTHS_OF_WHOLE * bench.sizes.max_rows)
}

fn greatest_widths(bench: &mut Bench, max_rows: usize) -> Outcome {
    use squares_along_angle::{Along, FIXED, Points, TABLES, fixed};
    let max_angles = bench.sizes.max_angles;
    bench.shaped(2, max_rows);
    let tables = tables::<Along, TABLES>(&inputs::angles(max_angles))?;
    let rows = coefficients(&inputs::depths(max_rows))?;
    let rows: Vec<[f64; FIXED]> = rows.iter().map(fixed).collect();
    for result in &mut bench.results {
        result.fill(0.0);
    }
    for from in (0..max_angles).step_by(ANGLES) {
        let to = max_angles.min(from + ANGLES);
        let tables = tables.each_ref().map(|table| &table[from..to]);
        for (place, row) in rows.iter().enumerate() {
            let greatest =
                fold::<Points, _, FIXED, TABLES, 2>(Level::best(), row, tables, &mut Greatest)
                    .map_err(columns_error)?;
            for (result, greatest) in bench.results.iter_mut().zip(greatest) {
                result[place] = greatest.max(result[place]);
            }
        }
    }
    for result in bench.results.iter_mut().flat_map(|column| &mut **column) {
        *result = result.sqrt();
    }
    Ok(())
}
