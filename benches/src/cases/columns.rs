//! Both widths from the dimensionless columns.

use rotor_core::equations::both_widths;

use super::{Bench, Outcome, REPEATS, REPEATS_ON_THREADS, columns_error, on_threads, processors};
use crate::column::Column;
use crate::inputs::{BLOCK, STREAM};

/// Both widths of a stretch of columns.
pub(super) fn widths(c: &[&[f64]; 8], sir: &mut [f64], cir: &mut [f64]) -> Outcome {
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

pub(super) fn widths_block(bench: &mut Bench) -> Outcome {
    bench.shaped(2, BLOCK);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    repeat_block(&bench.columns, 0, [sir, cir], REPEATS)
}

pub(super) fn widths_stream(bench: &mut Bench) -> Outcome {
    bench.shaped(2, STREAM);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    widths(&stretch(&bench.columns, 0, STREAM), sir, cir)
}

pub(super) fn widths_stream_threads(bench: &mut Bench) -> Outcome {
    bench.shaped(2, STREAM);
    let [sir, cir] = &mut bench.results[..] else {
        return Ok(());
    };
    let columns = &bench.columns;
    let share = STREAM.div_ceil(processors());
    let shares = sir.chunks_mut(share).zip(cir.chunks_mut(share));
    let parts = shares.enumerate().map(|(place, (sir, cir))| {
        let from = place * share;
        move || widths(&stretch(columns, from, from + sir.len()), sir, cir)
    });
    on_threads(parts)
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

pub(super) fn widths_one_thread(bench: &mut Bench) -> Outcome {
    let (columns, halves) = halves(bench);
    for (place, half) in halves.into_iter().enumerate() {
        repeat_block(columns, place * BLOCK, half, REPEATS_ON_THREADS)?;
    }
    Ok(())
}

pub(super) fn widths_two_threads(bench: &mut Bench) -> Outcome {
    let (columns, halves) = halves(bench);
    let parts = halves.into_iter().enumerate().map(|(place, half)| {
        move || repeat_block(columns, place * BLOCK, half, REPEATS_ON_THREADS)
    });
    on_threads(parts)
}
