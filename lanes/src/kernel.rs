//! Generated bodies and the loops over them.
//!
//! Loops here count columns: the adapters of iterators and of arrays are functions of their own, which are not always put
//! into the body where a crate is compiled in several parts.
#![allow(
    clippy::needless_range_loop,
    reason = "iterators over arrays are not always inlined, see above"
)]

use fearless_simd::Simd;
use thiserror::Error;

use crate::level::{self, Body, Level};
use crate::pack::Pack;

/// A generated body: `RESULTS` numbers of a row, from `FIXED` numbers that all rows share and `ALONG` of its own.
pub trait Kernel<const FIXED: usize, const ALONG: usize, const RESULTS: usize> {
    /// The results of a pack of rows.
    fn evaluate<S: Simd>(
        simd: S,
        fixed: [Pack<S>; FIXED],
        along: [Pack<S>; ALONG],
    ) -> [Pack<S>; RESULTS];
}

/// The longest pack of all levels.
pub const LONGEST: usize = 8;

/// All results of a kernel are wanted.
pub const ALL: u64 = u64::MAX;

/// Whether the result at a position is among those wanted: bit 0 is the first.
const fn is_wanted(wanted: u64, position: usize) -> bool {
    wanted >> position & 1 == 1
}

/// A column that is not as long as the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("column {column} has {length} rows; it must have {expected}, as the first one has")]
pub struct LengthError {
    /// Its place: the columns along the rows, then the results.
    pub column: usize,
    /// Its length.
    pub length: usize,
    /// The length of the first column.
    pub expected: usize,
}

/// A column that is not as long as the results: [`LengthError`] with the column's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("column {column} has {length} rows; it must have {expected}, as the results have")]
pub struct ColumnLengthError {
    /// The column.
    pub column: &'static str,
    /// Its length.
    pub length: usize,
    /// The length of the first result.
    pub expected: usize,
}

impl ColumnLengthError {
    /// The error with the name that the column at its place has.
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

fn check<'a>(
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

// What follows is the same for all kernels, and is compiled once for each number of columns.

/// How many rows there are: none where no result is wanted.
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

/// The rows from `first` on, fewer than a pack may have; the last number stands in those after it.
#[inline(never)]
fn lengthened<const COLUMNS: usize>(
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

/// Copies the first rows of those results that are wanted to where they belong.
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

fn slices<const COLUMNS: usize>(columns: &[[f64; LONGEST]; COLUMNS]) -> [&[f64]; COLUMNS] {
    columns.each_ref().map(|column| column.as_slice())
}

fn slices_mut<const COLUMNS: usize>(
    columns: &mut [[f64; LONGEST]; COLUMNS],
) -> [&mut [f64]; COLUMNS] {
    columns.each_mut().map(|column| column.as_mut_slice())
}

/// Evaluates a kernel for every row and writes the results.
///
/// `WANTED` says which results are asked for, a bit each ([`ALL`] for all of them); those that are not are left alone and
/// not computed, and their slices may be empty. There is nothing to do where `RESULTS` is 0 or no result is wanted.
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

/// Evaluates a kernel for one row: the results that [`store`] gives for it, without columns around them.
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
    // One row gains nothing by wider packs, and has the same bits in each.
    level::baseline(row)
}

/// One row, in all rows of a pack.
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

/// Evaluates a kernel that has no fixed numbers for every row, on the [best level](Level::best), and writes all results.
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
    /// Creates the loop over columns of one length, over no rows where no result is wanted.
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

    /// Evaluates fewer rows than a pack may have, in columns that are lengthened by their last number.
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

    /// All rows, which are as many as a pack has at least.
    #[inline(always)]
    fn write<S: Simd>(self, simd: S) {
        let fixed = splats(simd, self.fixed);
        let length = Pack::<S>::LENGTH;
        let last = self.rows.saturating_sub(length);
        let mut row = 0;
        loop {
            // Evaluated at one place only: the body may be thousands of instructions.
            let values = K::evaluate(simd, fixed, packs(simd, &self.along, row));
            for position in 0..RESULTS {
                if is_wanted(WANTED, position) {
                    values[position].store(&mut self.results[position][row..row + length]);
                }
            }
            if row >= last {
                break;
            }
            // The last pack may overlap with the one before: both write the same.
            row = (row + length).min(last);
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

/// Every number in all rows of a pack.
#[inline(always)]
fn splats<S: Simd, const FIXED: usize>(simd: S, fixed: &[f64; FIXED]) -> [Pack<S>; FIXED] {
    let mut packs = [Pack::splat(simd, 0.0); FIXED];
    for place in 0..FIXED {
        packs[place] = Pack::splat(simd, fixed[place]);
    }
    packs
}

/// The numbers of the rows from `row` on, of each column.
#[inline(always)]
fn packs<S: Simd, const ALONG: usize>(
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

/// What takes the results of a kernel where they arise, without an output array.
pub trait Consumer<const RESULTS: usize> {
    /// What it keeps while it runs, in packs.
    type Lanes<S: Simd>;
    /// What it gives in the end.
    type Output;

    /// Before the first row.
    fn begin<S: Simd>(&self, simd: S) -> Self::Lanes<S>;

    /// Takes the results of `rows` rows from `first` on; the packs hold more where these are the last.
    fn take<S: Simd>(
        &mut self,
        lanes: &mut Self::Lanes<S>,
        first: usize,
        rows: usize,
        results: &[Pack<S>; RESULTS],
    );

    /// After the last row.
    fn end<S: Simd>(&self, lanes: Self::Lanes<S>) -> Self::Output;
}

/// Evaluates a kernel for every row and lets a consumer take the results; those that it does not look at are not computed.
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
        let packs_of_rest = (self.rows - whole).min(1) * length;
        // Whole packs, then the last one; evaluated at one place only, as in `Store`.
        let parts = [
            (self.along, whole, 0, length),
            (slices(&rest), packs_of_rest, whole, self.rows - whole),
        ];
        let fixed = splats(simd, self.fixed);
        let mut lanes = self.consumer.begin(simd);
        for (mut along, rows, first, here) in parts {
            for column in 0..ALONG {
                along[column] = &along[column][..rows];
            }
            let mut row = 0;
            while row + length <= rows {
                let results = K::evaluate(simd, fixed, packs(simd, &along, row));
                self.consumer.take(&mut lanes, first + row, here, &results);
                row += length;
            }
        }
        self.consumer.end(lanes)
    }
}
