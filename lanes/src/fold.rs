//! The loop that hands the results of a kernel to a reduction.
#![allow(
    clippy::needless_range_loop,
    reason = "iterators over arrays are not always inlined, see the loops of `store`"
)]

use fearless_simd::Simd;

use crate::kernel::{Kernel, LONGEST, LengthError, check, lengthened, slices, splats, stretch};
use crate::level::{self, Body, Level};
use crate::pack::Pack;

/// Takes the results of a kernel pack by pack, so that a reduction needs no columns of results.
pub trait Consumer<const RESULTS: usize> {
    /// What it keeps from one pack to the next.
    type Lanes<S: Simd>;
    /// What comes of all rows.
    type Output;

    /// Creates what it keeps, before the first row.
    fn begin<S: Simd>(&self, simd: S) -> Self::Lanes<S>;

    /// Takes the results of `rows` rows from `first` on. Where these are fewer than a pack holds, the last row is repeated in
    /// the rest of the pack.
    fn take<S: Simd>(
        &mut self,
        lanes: &mut Self::Lanes<S>,
        first: usize,
        rows: usize,
        results: &[Pack<S>; RESULTS],
    );

    /// Computes the output of what it has kept, after the last row.
    fn end<S: Simd>(&self, lanes: Self::Lanes<S>) -> Self::Output;
}

/// Evaluates a kernel for every row and hands the results to a consumer. Results that it does not look at are not computed.
///
/// ```
/// use lanes::{Consumer, Kernel, Level, LengthError, Pack, Simd, fold};
///
/// struct Square;
///
/// impl Kernel<0, 1, 1> for Square {
///     #[inline(always)]
///     fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 1] {
///         [x * x]
///     }
/// }
///
/// struct Largest;
///
/// impl Consumer<1> for Largest {
///     type Lanes<S: Simd> = Pack<S>;
///     type Output = f64;
///
///     fn begin<S: Simd>(&self, simd: S) -> Pack<S> {
///         Pack::splat(simd, f64::NEG_INFINITY)
///     }
///
///     // A last row that is repeated changes no maximum, so that the number of rows does not matter here.
///     fn take<S: Simd>(&mut self, largest: &mut Pack<S>, _: usize, _: usize, [square]: &[Pack<S>; 1]) {
///         *largest = largest.max(*square);
///     }
///
///     fn end<S: Simd>(&self, largest: Pack<S>) -> f64 {
///         largest.as_slice().iter().copied().fold(f64::NEG_INFINITY, f64::max)
///     }
/// }
///
/// let largest = fold::<Square, _, 0, 1, 1>(Level::best(), &[], [&[1.0, -3.0, 2.0]], &mut Largest)?;
/// assert_eq!(largest, 9.0);
/// # Ok::<(), LengthError>(())
/// ```
///
/// # Errors
/// Columns of different lengths.
pub fn fold<K, C, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
    level: Level,
    fixed: &[f64; FIXED],
    along: [&[f64]; ALONG],
    consumer: &mut C,
) -> Result<C::Output, LengthError>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
    C: Consumer<RESULTS>,
{
    let rows = along.first().map_or(0, |column| column.len());
    check(along.iter().map(|column| column.len()).enumerate(), rows)?;
    let fold = Fold::<'_, K, C, FIXED, ALONG, RESULTS> {
        rows,
        fixed,
        along,
        consumer,
        kernel: std::marker::PhantomData,
    };
    Ok(level::run(level, fold))
}

/// The loop of [`fold`].
struct Fold<'a, K, C, const FIXED: usize, const ALONG: usize, const RESULTS: usize> {
    rows: usize,
    fixed: &'a [f64; FIXED],
    along: [&'a [f64]; ALONG],
    consumer: &'a mut C,
    kernel: std::marker::PhantomData<K>,
}

impl<K, C, const FIXED: usize, const ALONG: usize, const RESULTS: usize> Body
    for Fold<'_, K, C, FIXED, ALONG, RESULTS>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
    C: Consumer<RESULTS>,
{
    type Output = C::Output;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> C::Output {
        let length = Pack::<S>::LENGTH;
        let whole = self.rows - self.rows % length;
        let mut rest = [[0.0; LONGEST]; ALONG];
        if whole < self.rows {
            rest = lengthened(&self.along, whole);
        }
        // Whole packs, then the pack with the last rows, in one loop: as in `Store` the kernel is called at one place only.
        let parts = [
            (self.along, whole, 0, length),
            (slices(&rest), length, whole, self.rows - whole),
        ];
        let count = 1 + usize::from(whole < self.rows);
        let fixed = splats(simd, self.fixed);
        let consumer = self.consumer;
        let mut lanes = consumer.begin(simd);
        for (along, rows, first, here) in &parts[..count] {
            let (first, here) = (*first, *here);
            K::for_each_pack(
                simd,
                fixed,
                stretch(along, 0, *rows),
                #[inline(always)]
                |row, results| consumer.take(&mut lanes, first + row, here, &results),
            );
        }
        consumer.end(lanes)
    }
}
