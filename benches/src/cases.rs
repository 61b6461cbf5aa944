//! What is timed: a function for each, by the names that the tables use.
//!
//! A case is prepared once and then run as often as it is timed. It leaves its results where [`Bench::results`] finds them,
//! so that another tool's can be held against them.

mod columns;
mod near;
mod physical;
mod scans;

use std::thread;

use lanes::{ALL, Kernel, Level, store};
use rotor_core::study::Collected;

use crate::column::{Column, FIRST_INPUT};
use crate::inputs::{self, BLOCK, PHYSICAL, STREAM};
use columns::{
    widths, widths_block, widths_one_thread, widths_stream, widths_stream_threads,
    widths_two_threads,
};
pub use near::{NearError, near_columns, near_grid};
use physical::{physical_columns, physical_gradients, physical_values};

/// A case that could not be prepared or run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// A column is not as long as the results.
    #[error("{0}")]
    Columns(String),
    /// A row's rotor has no coefficients.
    #[error("the rotor with the crack depth {depth} has no coefficients")]
    Rotor {
        /// The depth over the radius.
        depth: f64,
    },
    /// There is no such scan or table, or it did not run.
    #[error(transparent)]
    Study(#[from] rotor_core::error::Error),
    /// There is no input of that name.
    #[error("there is no input {name}")]
    Input {
        /// The name.
        name: &'static str,
    },
    /// A thread ended before its work was done.
    #[error("a thread stopped")]
    Thread,
}

/// What a case answers.
pub type Outcome = Result<(), CaseError>;

/// A kind of computation that is timed.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its name in the tables.
    pub name: &'static str,
    /// What it computes.
    pub about: &'static str,
    /// The points of one run.
    pub points: fn(&Sizes) -> usize,
    /// One run.
    pub run: fn(&mut Bench) -> Outcome,
}

/// How often a block is repeated in one run, so that a run can be timed.
pub const REPEATS: usize = 32;

/// How often a block is repeated on threads in one run, so that their start is not what is timed.
const REPEATS_ON_THREADS: usize = 512;

/// All cases.
pub const CASES: [Case; 12] = [
    Case {
        name: "widths_block",
        about: "both widths from the 8 dimensionless columns, blocks of 4096 points",
        points: |_| BLOCK * REPEATS,
        run: widths_block,
    },
    Case {
        name: "widths_stream",
        about: "both widths from the 8 dimensionless columns, 2^20 points from memory",
        points: |_| STREAM,
        run: widths_stream,
    },
    Case {
        name: "widths_stream_threads",
        about: "the same on all processors",
        points: |_| STREAM,
        run: widths_stream_threads,
    },
    Case {
        name: "widths_one_thread",
        about: "the blocks of `widths_two_threads`, one after the other",
        points: |_| 2 * BLOCK * REPEATS_ON_THREADS,
        run: widths_one_thread,
    },
    Case {
        name: "widths_two_threads",
        about: "both widths, blocks of 4096 points, on two threads",
        points: |_| 2 * BLOCK * REPEATS_ON_THREADS,
        run: widths_two_threads,
    },
    Case {
        name: "grid_sigma_phi",
        about: "both widths over a grid of crack depth and angle of the paper's rotor",
        points: |sizes| sizes.grid * sizes.grid,
        run: scans::grid_sigma_phi,
    },
    Case {
        name: "grid_sigma_phi_threads",
        about: "the same on all processors",
        points: |sizes| sizes.grid * sizes.grid,
        run: scans::grid_sigma_phi_threads,
    },
    Case {
        name: "grid_fill",
        about: "the memory of the grid filled with a constant",
        points: |sizes| sizes.grid * sizes.grid,
        run: grid_fill,
    },
    Case {
        name: "max_over_phi",
        about: "the greatest widths over the angle for each crack depth",
        points: |sizes| sizes.max_rows * sizes.max_angles,
        run: scans::max_over_phi,
    },
    Case {
        name: "max_over_phi_whole",
        about: "the same for fifty times as many depths, 100 000 of them, which the others would take minutes for",
        points: |sizes| scans::DEPTHS_OF_WHOLE * sizes.max_rows * sizes.max_angles,
        run: scans::max_over_phi_whole,
    },
    Case {
        name: "physical_values",
        about: "both widths from the physical rotor, columns",
        points: |_| PHYSICAL,
        run: physical_values,
    },
    Case {
        name: "physical_gradients",
        about: "both widths with their gradients by all 12 inputs, columns",
        points: |_| PHYSICAL,
        run: physical_gradients,
    },
];

/// The sizes of the larger cases.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Rows and columns of the grid.
    pub grid: usize,
    /// Depths of the maximum.
    pub max_rows: usize,
    /// Angles of the maximum.
    pub max_angles: usize,
}

/// Inputs and results of all cases.
#[derive(Debug)]
pub struct Bench {
    /// The sizes.
    pub sizes: Sizes,
    columns: Vec<Column>,
    physical: Vec<Column>,
    results: Vec<Column>,
    /// What a scan has collected, and whether the last run did.
    collected: Collected,
    is_collected: bool,
}

impl Bench {
    /// Prepares all cases.
    pub fn new(sizes: Sizes) -> Self {
        Self {
            sizes,
            columns: inputs::columns(STREAM),
            physical: physical_columns(),
            results: Vec::new(),
            collected: Collected::new(),
            is_collected: false,
        }
    }

    /// The results of the last run, a column each.
    pub fn results(&self) -> Vec<&[f64]> {
        if self.is_collected {
            let columns =
                (0..self.collected.quantities().len()).map(|place| self.collected.column(place));
            return columns.filter_map(|column| column.complete()).collect();
        }
        self.results.iter().map(|column| &**column).collect()
    }

    /// Results of this many columns and rows, whose memory is kept from run to run.
    fn shaped(&mut self, columns: usize, rows: usize) {
        self.is_collected = false;
        if self.results.len() != columns
            || self.results.first().is_none_or(|first| first.len() != rows)
        {
            self.results = (0..columns)
                .map(|place| Column::zeros(rows, place))
                .collect();
        }
    }
}

fn columns_error(error: impl std::fmt::Display) -> CaseError {
    CaseError::Columns(error.to_string())
}

/// How many threads can run at once.
fn processors() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Each part on a thread of its own; a single one on this thread.
fn on_threads<F: FnOnce() -> Outcome + Send>(
    mut parts: impl ExactSizeIterator<Item = F>,
) -> Outcome {
    if parts.len() == 1 {
        return parts.next().map_or(Ok(()), |part| part());
    }
    thread::scope(|scope| {
        let threads: Vec<_> = parts.map(|part| scope.spawn(part)).collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().unwrap_or(Err(CaseError::Thread)))
    })
}

/// What the angles alone decide, a list for each of their tables.
fn tables<A, const TABLES: usize>(angles: &[f64]) -> Result<[Column; TABLES], CaseError>
where
    A: Kernel<0, 1, TABLES>,
{
    let table = |place| Column::zeros(angles.len(), FIRST_INPUT + place);
    let mut tables: [Column; TABLES] = std::array::from_fn(table);
    let slices = tables.each_mut().map(|table| &mut **table);
    store::<A, ALL, 0, 1, TABLES>(Level::best(), &[], [angles], slices).map_err(columns_error)?;
    Ok(tables)
}

fn grid_fill(bench: &mut Bench) -> Outcome {
    let size = bench.sizes.grid;
    bench.shaped(2, size * size);
    let constant = std::hint::black_box(1.0);
    for column in &mut bench.results {
        column.fill(constant);
    }
    Ok(())
}
