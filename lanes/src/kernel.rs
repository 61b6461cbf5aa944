//! The loops that run a kernel over the rows of columns.
//!
//! They reach columns by an index: adapters of iterators and arrays are functions of their own, which the compiler does not
//! always inline where it compiles a crate in several parts.
#![allow(
    clippy::needless_range_loop,
    reason = "iterators over arrays are not always inlined, see above"
)]

use fearless_simd::Simd;
use thiserror::Error;

use crate::level::{self, Body, Level};
use crate::pack::Pack;

/// A formula over packs of rows: `RESULTS` numbers of each row, from `FIXED` numbers that all rows share and `ALONG` numbers
/// of the row itself.
pub trait Kernel<const FIXED: usize, const ALONG: usize, const RESULTS: usize> {
    /// Computes the results of the rows in a pack.
    fn evaluate<S: Simd>(
        simd: S,
        fixed: [Pack<S>; FIXED],
        along: [Pack<S>; ALONG],
    ) -> [Pack<S>; RESULTS];

    /// Computes the results of pack after pack of columns, which have one length, a multiple of a pack's; `take` gets the first
    /// row of each pack and its results, those of [`evaluate`](Self::evaluate). A long body does it in parts, see
    /// [`Groups`](crate::Groups).
    #[inline(always)]
    fn for_each_pack<S: Simd>(
        simd: S,
        fixed: [Pack<S>; FIXED],
        along: [&[f64]; ALONG],
        mut take: impl FnMut(usize, [Pack<S>; RESULTS]),
    ) {
        let rows = along.first().map_or(0, |column| column.len());
        let mut row = 0;
        while row < rows {
            take(row, Self::evaluate(simd, fixed, packs(simd, &along, row)));
            row += Pack::<S>::LENGTH;
        }
    }
}

/// How many numbers the longest pack holds: that of AVX-512.
pub const LONGEST: usize = 8;

/// Asks [`store`] for all results of a kernel.
pub const ALL: u64 = u64::MAX;

/// Whether the result at a position is asked for: bit 0 of `wanted` stands for the first.
const fn is_wanted(wanted: u64, position: usize) -> bool {
    wanted >> position & 1 == 1
}

/// Says that a column is not as long as the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("column {column} has {length} rows; it must have {expected}, as the first one has")]
pub struct LengthError {
    /// Which column it is, from 0: the inputs are counted first, then the results.
    pub column: usize,
    /// Its length.
    pub length: usize,
    /// The length of the first column.
    pub expected: usize,
}

/// Says by name that a column is not as long as the results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("column {column} has {length} rows; it must have {expected}, as the results have")]
pub struct ColumnLengthError {
    /// The column's name.
    pub column: &'static str,
    /// Its length.
    pub length: usize,
    /// The length of the first result.
    pub expected: usize,
}

impl ColumnLengthError {
    /// Gives the column of an error the name that `columns` has at its place.
    pub fn of(error: LengthError, columns: &[&'static str]) -> Self {
        let LengthError {
            column,
            length,
            expected,
        } = error;
        let column = columns.get(column).copied().unwrap_or_default();
        Self {
            column,
            length,
            expected,
        }
    }
}

/// Refuses a column that is not of the expected length.
pub(crate) fn check<'a>(
    lengths: impl Iterator<Item = (usize, usize)> + 'a,
    expected: usize,
) -> Result<(), LengthError> {
    for (column, length) in lengths {
        if length != expected {
            return Err(LengthError {
                column,
                length,
                expected,
            });
        }
    }
    Ok(())
}

// The functions from here to `slices_mut` do not know the kernel, so that they are compiled once for each number of columns.

/// Counts the rows: none where no result is asked for.
fn rows_of<const ALONG: usize, const RESULTS: usize>(
    wanted: u64,
    along: &[&[f64]; ALONG],
    results: &[&mut [f64]; RESULTS],
) -> Result<usize, LengthError> {
    let lengths = results.iter().map(|column| column.len()).enumerate();
    let mut lengths = lengths.filter(|(position, _)| is_wanted(wanted, *position));
    let Some((_, rows)) = lengths.next() else {
        return Ok(0);
    };
    check(along.iter().map(|column| column.len()).enumerate(), rows)?;
    let places = lengths.map(|(position, length)| (ALONG + position, length));
    check(places, rows)?;
    Ok(rows)
}

/// Copies the rows from `first` on, which are fewer than a pack holds, and repeats the last one until the pack is full.
#[inline(never)]
pub(crate) fn lengthened<const COLUMNS: usize>(
    columns: &[&[f64]; COLUMNS],
    first: usize,
) -> [[f64; LONGEST]; COLUMNS] {
    columns.map(|column| {
        let last = column.len().saturating_sub(1);
        std::array::from_fn(|row| {
            let number = column.get((first + row).min(last));
            number.copied().unwrap_or(0.0)
        })
    })
}

/// Copies the first rows of the results that are asked for to their columns.
#[inline(never)]
fn shortened<const RESULTS: usize>(
    wanted: u64,
    results: [&mut [f64]; RESULTS],
    lengthened: &[[f64; LONGEST]; RESULTS],
    rows: usize,
) {
    for (position, (column, lengthened)) in results.into_iter().zip(lengthened).enumerate() {
        if is_wanted(wanted, position) {
            column.copy_from_slice(&lengthened[..rows]);
        }
    }
}

pub(crate) fn slices<const COLUMNS: usize>(
    columns: &[[f64; LONGEST]; COLUMNS],
) -> [&[f64]; COLUMNS] {
    columns.each_ref().map(|column| column.as_slice())
}

fn slices_mut<const COLUMNS: usize>(
    columns: &mut [[f64; LONGEST]; COLUMNS],
) -> [&mut [f64]; COLUMNS] {
    columns.each_mut().map(|column| column.as_mut_slice())
}

/// Evaluates a kernel for every row and writes the results to columns.
///
/// `WANTED` says which results are asked for, a bit each, the lowest for the first ([`ALL`] for all of them). The others are
/// not computed; their slices are left as they are and may be empty.
///
/// ```
/// use lanes::{Kernel, Level, LengthError, Pack, Simd, store};
///
/// /// Sum and difference of a number of the row and one that all rows share.
/// struct SumAndDifference;
///
/// impl Kernel<1, 1, 2> for SumAndDifference {
///     #[inline(always)]
///     fn evaluate<S: Simd>(_: S, [shared]: [Pack<S>; 1], [x]: [Pack<S>; 1]) -> [Pack<S>; 2] {
///         [x + shared, x - shared]
///     }
/// }
///
/// const DIFFERENCE: u64 = 0b10;
/// let mut differences = [0.0; 3];
/// let results = [&mut [][..], &mut differences];
/// store::<SumAndDifference, DIFFERENCE, 1, 1, 2>(Level::best(), &[1.0], [&[5.0, 6.0, 7.0]], results)?;
/// assert_eq!(differences, [4.0, 5.0, 6.0]);
/// # Ok::<(), LengthError>(())
/// ```
///
/// # Errors
/// Columns of different lengths.
pub fn store<K, const WANTED: u64, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
    level: Level,
    fixed: &[f64; FIXED],
    along: [&[f64]; ALONG],
    results: [&mut [f64]; RESULTS],
) -> Result<(), LengthError>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    let store = Store::<'_, K, WANTED, FIXED, ALONG, RESULTS>::new(fixed, along, results)?;
    match store.rows {
        0 => {}
        1..LONGEST => store.run_lengthened(level),
        _ => level::run(level, store),
    }
    Ok(())
}

/// Evaluates a kernel for one row. The results have the bits that [`store`] gives that row.
pub fn once<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize>(
    fixed: &[f64; FIXED],
    along: &[f64; ALONG],
) -> [f64; RESULTS]
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    let kernel = std::marker::PhantomData::<K>;
    let row = Row {
        fixed,
        along,
        kernel,
    };
    // Wider packs would make one row no faster, and its bits do not depend on them.
    level::baseline(row)
}

/// The evaluation of one row, whose numbers are repeated in all rows of a pack.
struct Row<'a, K, const FIXED: usize, const ALONG: usize, const RESULTS: usize> {
    fixed: &'a [f64; FIXED],
    along: &'a [f64; ALONG],
    kernel: std::marker::PhantomData<K>,
}

impl<K, const FIXED: usize, const ALONG: usize, const RESULTS: usize> Body
    for Row<'_, K, FIXED, ALONG, RESULTS>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    type Output = [f64; RESULTS];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [f64; RESULTS] {
        let results = K::evaluate(simd, splats(simd, self.fixed), splats(simd, self.along));
        let mut numbers = [f64::NAN; RESULTS];
        for place in 0..RESULTS {
            numbers[place] = results[place].first();
        }
        numbers
    }
}

/// Evaluates a kernel that has no shared numbers for every row, on the [best level](Level::best), and writes all results.
///
/// # Errors
/// Columns of different lengths.
pub fn rows<K, const ALONG: usize, const RESULTS: usize>(
    along: [&[f64]; ALONG],
    results: [&mut [f64]; RESULTS],
) -> Result<(), LengthError>
where
    K: Kernel<0, ALONG, RESULTS>,
{
    store::<K, ALL, 0, ALONG, RESULTS>(Level::best(), &[], along, results)
}

/// The loop of [`store`].
struct Store<'a, K, const WANTED: u64, const FIXED: usize, const ALONG: usize, const RESULTS: usize>
{
    rows: usize,
    fixed: &'a [f64; FIXED],
    along: [&'a [f64]; ALONG],
    results: [&'a mut [f64]; RESULTS],
    kernel: std::marker::PhantomData<K>,
}

impl<'a, K, const WANTED: u64, const FIXED: usize, const ALONG: usize, const RESULTS: usize>
    Store<'a, K, WANTED, FIXED, ALONG, RESULTS>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    /// Creates the loop after a look at the columns' lengths.
    fn new(
        fixed: &'a [f64; FIXED],
        along: [&'a [f64]; ALONG],
        results: [&'a mut [f64]; RESULTS],
    ) -> Result<Self, LengthError> {
        Ok(Self {
            rows: rows_of(WANTED, &along, &results)?,
            fixed,
            along,
            results,
            kernel: std::marker::PhantomData,
        })
    }

    /// Evaluates rows that are too few for a pack: in copies of the columns in which the last row is repeated.
    fn run_lengthened(self, level: Level) {
        let along = lengthened(&self.along, 0);
        let mut results = [[0.0; LONGEST]; RESULTS];
        let lengthened = Store::<'_, K, WANTED, FIXED, ALONG, RESULTS> {
            rows: LONGEST,
            fixed: self.fixed,
            along: slices(&along),
            results: slices_mut(&mut results),
            kernel: self.kernel,
        };
        level::run(level, lengthened);
        shortened(WANTED, self.results, &results, self.rows);
    }

    /// Evaluates all rows, of which there are enough for a pack.
    #[inline(always)]
    fn write<S: Simd>(self, simd: S) {
        let fixed = splats(simd, self.fixed);
        let length = Pack::<S>::LENGTH;
        let mut results = self.results;
        // Whole packs, then the last one, which overlaps with the one before it: in the rows of both they write the same
        // numbers. One loop for both, so that there is one call of the kernel: each would be a copy of what may be thousands of
        // instructions.
        let whole = self.rows - self.rows % length;
        let stretches = [(0, whole), (self.rows - length, self.rows)];
        let count = 1 + usize::from(whole < self.rows);
        for (first, end) in &stretches[..count] {
            let (first, end) = (*first, *end);
            let along = stretch(&self.along, first, end);
            K::for_each_pack(
                simd,
                fixed,
                along,
                #[inline(always)]
                |row, values| {
                    let row = first + row;
                    for position in 0..RESULTS {
                        if is_wanted(WANTED, position) {
                            values[position].store(&mut results[position][row..row + length]);
                        }
                    }
                },
            );
        }
    }
}

impl<K, const WANTED: u64, const FIXED: usize, const ALONG: usize, const RESULTS: usize> Body
    for Store<'_, K, WANTED, FIXED, ALONG, RESULTS>
where
    K: Kernel<FIXED, ALONG, RESULTS>,
{
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        self.write(simd);
    }
}

/// Makes a pack of each number, which stands in all its rows.
#[inline(always)]
pub(crate) fn splats<S: Simd, const FIXED: usize>(
    simd: S,
    fixed: &[f64; FIXED],
) -> [Pack<S>; FIXED] {
    let mut packs = [Pack::splat(simd, 0.0); FIXED];
    for place in 0..FIXED {
        packs[place] = Pack::splat(simd, fixed[place]);
    }
    packs
}

/// The rows of columns from `first` to `end`. As all are of one length then, a loop over their rows looks once whether it is within.
#[inline(always)]
pub(crate) fn stretch<'a, const ALONG: usize>(
    along: &[&'a [f64]; ALONG],
    first: usize,
    end: usize,
) -> [&'a [f64]; ALONG] {
    let mut cut = *along;
    for column in 0..ALONG {
        cut[column] = &along[column][first..end];
    }
    cut
}

/// Loads a pack of each column, from `row` on.
#[inline(always)]
pub(crate) fn packs<S: Simd, const ALONG: usize>(
    simd: S,
    along: &[&[f64]; ALONG],
    row: usize,
) -> [Pack<S>; ALONG] {
    let mut packs = [Pack::splat(simd, 0.0); ALONG];
    for column in 0..ALONG {
        packs[column] = Pack::load(simd, &along[column][row..row + Pack::<S>::LENGTH]);
    }
    packs
}
