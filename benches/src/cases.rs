//! What is timed: a function for each, by the names that the tables use.
//!
//! A case is prepared once and then run as often as it is timed. It leaves its results where [`Bench::results`] finds them,
//! so that another tool's can be held against them.

use std::thread;

use lanes::{ALL, Consumer, Kernel, Level, Pack, Simd, fold, store, stream};
use rotor_core::equations::both_widths::along_crack_angle as widths_along_angle;
use rotor_core::equations::both_widths_squared::along_crack_angle as squares_along_angle;
use rotor_core::equations::{Coefficients, both_widths, widths_support_arm};
use rotor_core::input::INPUTS;
use rotor_core::quantity::Quantity;
use rotor_core::study::table::{self, TableError};

use crate::column::{Column, FIRST_INPUT};
use crate::inputs::{self, BLOCK, PHYSICAL, ROTOR, STREAM};

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
    /// There is no input or no table of that name.
    #[error(transparent)]
    Table(#[from] TableError),
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

/// The same for what runs on threads, so that their start is not what is timed.
const REPEATS_ON_THREADS: usize = 512;

/// All cases.
pub const CASES: [Case; 10] = [
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
        run: grid_sigma_phi,
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
        run: max_over_phi,
    },
    Case {
        name: "max_over_phi_whole",
        about: "the same for fifty times as many depths, 100 000 of them, which the others would take minutes for",
        points: |sizes| DEPTHS_OF_WHOLE * sizes.max_rows * sizes.max_angles,
        run: max_over_phi_whole,
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
}

impl Bench {
    /// Prepares all cases.
    pub fn new(sizes: Sizes) -> Self {
        Self {
            sizes,
            columns: inputs::columns(STREAM),
            physical: physical_columns(),
            results: Vec::new(),
        }
    }

    /// The results of the last run, a column each.
    pub fn results(&self) -> &[Column] {
        &self.results
    }

    /// Results of this many columns and rows, whose memory is kept from run to run.
    fn shaped(&mut self, columns: usize, rows: usize) {
        if self.results.len() != columns
            || self.results.first().is_none_or(|first| first.len() != rows)
        {
            self.results = (0..columns)
                .map(|place| Column::zeros(rows, place))
                .collect();
        }
    }
}

/// Both widths of a stretch of columns.
fn widths(c: &[&[f64]; 8], sir: &mut [f64], cir: &mut [f64]) -> Outcome {
    let [
        beta,
        gamma,
        delta,
        epsilon_1,
        epsilon_12,
        epsilon_2,
        disk_asymmetry,
        crack_angle,
    ] = *c;
    let inputs = both_widths::Columns {
        c_beta: beta,
        c_gamma: gamma,
        c_delta: delta,
        c_epsilon_1: epsilon_1,
        c_epsilon_12: epsilon_12,
        c_epsilon_2: epsilon_2,
        c_disk_asymmetry: disk_asymmetry,
        c_crack_angle: crack_angle,
    };
    both_widths::columns(&inputs, [sir, cir]).map_err(columns_error)
}

fn columns_error(error: impl std::fmt::Display) -> CaseError {
    CaseError::Columns(error.to_string())
}

/// The rows `from..to` of the dimensionless columns.
fn stretch(columns: &[Column], from: usize, to: usize) -> [&[f64]; 8] {
    std::array::from_fn(|column| &columns[column][from..to])
}

/// One block, so many times.
fn repeat_block(
    columns: &[Column],
    from: usize,
    results: [&mut [f64]; 2],
    repeats: usize,
) -> Outcome {
    let [sir, cir] = results;
    let block = stretch(columns, from, from + BLOCK);
    for _ in 0..repeats {
        widths(std::hint::black_box(&block), sir, cir)?;
    }
    Ok(())
}

fn widths_block(bench: &mut Bench) -> Outcome {
    bench.shaped(2, BLOCK);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    repeat_block(&bench.columns, 0, [sir, cir], REPEATS)
}

fn widths_stream(bench: &mut Bench) -> Outcome {
    bench.shaped(2, STREAM);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    widths(&stretch(&bench.columns, 0, STREAM), sir, cir)
}

/// The two halves of `widths_two_threads`: each a block of inputs and its results.
fn halves(bench: &mut Bench) -> (&[Column], Vec<[&mut [f64]; 2]>) {
    bench.shaped(4, BLOCK);
    let mut results = bench.results.iter_mut().map(|result| &mut **result);
    let mut halves = Vec::new();
    while let (Some(sir), Some(cir)) = (results.next(), results.next()) {
        halves.push([sir, cir]);
    }
    (&bench.columns, halves)
}

fn widths_one_thread(bench: &mut Bench) -> Outcome {
    let (columns, halves) = halves(bench);
    for (place, half) in halves.into_iter().enumerate() {
        repeat_block(columns, place * BLOCK, half, REPEATS_ON_THREADS)?;
    }
    Ok(())
}

fn widths_two_threads(bench: &mut Bench) -> Outcome {
    let (columns, halves) = halves(bench);
    thread::scope(|scope| {
        let threads: Vec<_> = halves
            .into_iter()
            .enumerate()
            .map(|(place, half)| {
                scope.spawn(move || repeat_block(columns, place * BLOCK, half, REPEATS_ON_THREADS))
            })
            .collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().unwrap_or(Err(CaseError::Thread)))
    })
}

/// The coefficients of [`ROTOR`] with other crack depths, a row each.
fn coefficients(depths: &[f64]) -> Result<Vec<Coefficients>, CaseError> {
    const ASKED: [Quantity; 6] = [
        Quantity::Beta,
        Quantity::Gamma,
        Quantity::Delta,
        Quantity::Epsilon1,
        Quantity::Epsilon12,
        Quantity::Epsilon2,
    ];
    let column = INPUTS
        .iter()
        .find(|input| input.name == "crack_depth_ratio")
        .map(|input| table::Column {
            input,
            values: depths,
        });
    let found = table::evaluate(&ROTOR, column.as_slice(), &ASKED)?;
    let row = |(row, depth): (usize, &f64)| {
        let number = |quantity| found.column(quantity).get(row);
        let [beta, gamma, delta, epsilon_1, epsilon_12, epsilon_2] = std::array::from_fn(number);
        let c = || {
            Some(Coefficients {
                beta: beta?,
                gamma: gamma?,
                delta: delta?,
                epsilon_1: epsilon_1?,
                epsilon_12: epsilon_12?,
                epsilon_2: epsilon_2?,
                disk_asymmetry: ROTOR.disk_asymmetry,
                crack_angle: ROTOR.crack_angle,
            })
        };
        c().ok_or(CaseError::Rotor { depth: *depth })
    };
    depths.iter().enumerate().map(row).collect()
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

fn grid_sigma_phi(bench: &mut Bench) -> Outcome {
    use widths_along_angle::{Along, FIXED, Points, TABLES, fixed};
    let size = bench.sizes.grid;
    bench.shaped(2, size * size);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    let tables = tables::<Along, TABLES>(&inputs::angles(size))?;
    let rows = coefficients(&inputs::depths(size))?;
    let results = sir.chunks_mut(size).zip(cir.chunks_mut(size));
    let lines = rows
        .iter()
        .map(fixed)
        .zip(results.map(|(sir, cir)| [sir, cir]));
    let tables = tables.each_ref().map(|table| &**table);
    stream::<Points, ALL, FIXED, TABLES, 2>(Level::best(), tables, lines).map_err(columns_error)
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
const DEPTHS_OF_WHOLE: usize = 50;

/// Angles whose tables stay in the nearest cache while the rows pass.
const ANGLES: usize = 1024;

fn max_over_phi(bench: &mut Bench) -> Outcome {
    greatest_widths(bench, bench.sizes.max_rows)
}

fn max_over_phi_whole(bench: &mut Bench) -> Outcome {
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

/// The twelve inputs of rotors around the paper's, within 5 % of each, in the order of [`rotor_core::input::INPUTS`]; then
/// the factor of a half-open edge for every row.
fn physical_columns() -> Vec<Column> {
    let p = ROTOR;
    let around = [
        p.disk_mass,
        p.disk_diametral_inertia,
        p.disk_polar_inertia,
        p.disk_asymmetry,
        p.disk_position_ratio,
        p.shaft_length,
        p.shaft_radius,
        p.shaft_youngs_modulus,
        p.shaft_poissons_ratio,
        p.crack_depth_ratio,
        p.crack_position_ratio,
        0.8,
    ];
    let column = |(place, value): (usize, f64)| {
        Column::input(
            place,
            &inputs::spread(place, 0.95 * value, 1.05 * value, PHYSICAL),
        )
    };
    let edge_factor = Column::input(around.len(), &[32.0; PHYSICAL]);
    let varied = around.into_iter().enumerate().map(column);
    varied.chain([edge_factor]).collect()
}

/// The physical columns as the generated form takes them.
fn physical_inputs(columns: &[Column]) -> widths_support_arm::Columns<'_> {
    widths_support_arm::Columns {
        p_disk_mass: &columns[0],
        p_disk_diametral_inertia: &columns[1],
        p_disk_polar_inertia: &columns[2],
        p_disk_asymmetry: &columns[3],
        p_disk_position_ratio: &columns[4],
        p_shaft_length: &columns[5],
        p_shaft_radius: &columns[6],
        p_shaft_youngs_modulus: &columns[7],
        p_shaft_poissons_ratio: &columns[8],
        p_crack_depth_ratio: &columns[9],
        p_crack_position_ratio: &columns[10],
        p_crack_angle: &columns[11],
        edge_factor: &columns[12],
    }
}

fn physical_values(bench: &mut Bench) -> Outcome {
    bench.shaped(2, PHYSICAL);
    let inputs = physical_inputs(&bench.physical);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    widths_support_arm::columns(&inputs, [sir, cir]).map_err(columns_error)
}

fn physical_gradients(bench: &mut Bench) -> Outcome {
    bench.shaped(26, PHYSICAL);
    let inputs = physical_inputs(&bench.physical);
    let results: Vec<&mut [f64]> = bench
        .results
        .iter_mut()
        .map(|result| &mut **result)
        .collect();
    let Ok(results) = results.try_into() else {
        return Ok(());
    };
    widths_support_arm::gradient_columns(&inputs, results).map_err(columns_error)
}
