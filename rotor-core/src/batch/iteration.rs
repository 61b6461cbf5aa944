//! Quantities that are found by iteration, as kernels: row by row within a pack, NaN where there is none.

use lanes::{Kernel, LONGEST, Pack, Simd};

use crate::equations::chain::coefficients_of_numbers;
use crate::jeffcott::exact;
use crate::jeffcott::region::{Region, RegionKind};

/// The exact ends of a region, the lower and the upper, from its number and the coefficients.
pub(super) struct Ends;

impl Kernel<1, 8, 2> for Ends {
    #[inline(always)]
    fn evaluate<S: Simd>(simd: S, [region]: [Pack<S>; 1], along: [Pack<S>; 8]) -> [Pack<S>; 2] {
        let [
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            asymmetry,
            angle,
        ] = along;
        let along = [
            region, beta, gamma, delta, epsilon_1, epsilon_12, epsilon_2, asymmetry, angle,
        ];
        by_rows(simd, along, ends)
    }
}

/// The number of a region, for [`Ends`].
pub(super) fn number_of(region: RegionKind) -> f64 {
    let place = RegionKind::ALL.iter().position(|kind| *kind == region);
    place.map_or(f64::NAN, |place| place as f64)
}

fn ends([region, numbers @ ..]: &[f64; 9]) -> [f64; 2] {
    let found = RegionKind::ALL
        .get(*region as usize)
        .and_then(|kind| Region::of(*kind, &coefficients_of_numbers(numbers)).ok())
        .and_then(|region| region.exact_ends().ok());
    found.map_or([f64::NAN; 2], |ends| [ends.lower, ends.upper])
}

/// The growth rate from the coefficients and the speed.
pub(super) struct GrowthRate;

impl Kernel<0, 9, 1> for GrowthRate {
    #[inline(always)]
    fn evaluate<S: Simd>(simd: S, _: [Pack<S>; 0], along: [Pack<S>; 9]) -> [Pack<S>; 1] {
        by_rows(simd, along, growth_rate)
    }
}

fn growth_rate([numbers @ .., speed]: &[f64; 9]) -> [f64; 1] {
    [exact::growth_rate(&coefficients_of_numbers(numbers), *speed).unwrap_or(f64::NAN)]
}

/// A function of the numbers of a row, for each row of a pack. Rows that repeat the one before, as those beyond the end of a
/// column do, repeat its results.
#[inline(always)]
fn by_rows<S: Simd, const ALONG: usize, const RESULTS: usize>(
    simd: S,
    along: [Pack<S>; ALONG],
    function: fn(&[f64; ALONG]) -> [f64; RESULTS],
) -> [Pack<S>; RESULTS] {
    let numbers = |row: usize| along.each_ref().map(|pack| pack.as_slice()[row]);
    let mut results = [[f64::NAN; LONGEST]; RESULTS];
    let mut last: Option<([f64; ALONG], [f64; RESULTS])> = None;
    for row in 0..Pack::<S>::LENGTH {
        let numbers = numbers(row);
        let found = match last {
            Some((known, found)) if known == numbers => found,
            _ => function(&numbers),
        };
        for (results, found) in results.iter_mut().zip(found) {
            results[row] = found;
        }
        last = Some((numbers, found));
    }
    results.map(|results| Pack::load(simd, &results[..Pack::<S>::LENGTH]))
}
