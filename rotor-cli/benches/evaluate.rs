//! What `rotor evaluate` takes, beside reading and writing the same columns alone.
//!
//! `cargo bench -p rotor-cli --bench evaluate`

use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::properties::WriterProperties;
use rotor_core::input::{INPUTS, RotorParameters};

type Outcome = Result<(), Box<dyn Error>>;

/// Rows of the table.
const ROWS: usize = 1 << 20;

/// Rows that are read, and written, at once.
const BATCH: usize = 1 << 15;

/// The results that are asked for.
const QUANTITIES: [&str; 2] = ["sir_width", "cir_width"];

/// A column within 5 % of a value.
fn spread(place: usize, value: f64) -> ArrayRef {
    let share = |row: usize| (row * (2 * place + 3) * 7919 % ROWS) as f64 / ROWS as f64;
    let number = |row| value * (0.95 + 0.1 * share(row));
    Arc::new(Float64Array::from_iter_values((0..ROWS).map(number)))
}

/// Writes a table of rotors around the paper's with a column for each input that is not 0 there.
fn write_table(path: &Path) -> Outcome {
    let inputs = INPUTS
        .iter()
        .map(|input| (input.name, (input.get)(&RotorParameters::PAPER)));
    let columns = inputs.filter(|(_, value)| *value != 0.0).enumerate();
    let columns = columns.map(|(place, (name, value))| (name, spread(place, value)));
    let batch = RecordBatch::try_from_iter(columns)?;
    write(path, &[batch])
}

fn write(path: &Path, batches: &[RecordBatch]) -> Outcome {
    let Some(first) = batches.first() else {
        return Ok(());
    };
    let properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .build();
    let file = File::create(path)?;
    let mut writer = ArrowWriter::try_new(file, first.schema(), Some(properties))?;
    for batch in batches {
        writer.write(batch)?;
    }
    writer.close()?;
    Ok(())
}

/// Reads all columns, and writes them again with as many as there are results.
fn read_and_write(table: &Path, copy: &Path) -> Outcome {
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(table)?)?;
    let mut copied = Vec::new();
    for batch in reader.with_batch_size(BATCH).build()? {
        let batch = batch?;
        let schema = batch.schema();
        let names = schema.fields().iter().map(|field| field.name().clone());
        let mut columns: Vec<_> = names.zip(batch.columns().iter().cloned()).collect();
        for (place, name) in QUANTITIES.iter().enumerate() {
            columns.push(((*name).to_owned(), Arc::clone(batch.column(place))));
        }
        copied.push(RecordBatch::try_from_iter(columns)?);
    }
    write(copy, &copied)
}

fn evaluate(table: &Path, results: &Path) -> Outcome {
    let status = Command::new(env!("CARGO_BIN_EXE_rotor"))
        .arg("evaluate")
        .arg(table)
        .args(["--quantities", &QUANTITIES.join(","), "-o"])
        .arg(results)
        .stdout(Stdio::null())
        .status()?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("rotor evaluate: {status}").into())
    }
}

/// Times work that may fail; its last failure is the answer.
fn timed(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    work: impl Fn() -> Outcome,
) -> Outcome {
    let mut outcome = Ok(());
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            if let Err(error) = work() {
                outcome = Err(error);
            }
        });
    });
    outcome
}

fn main() -> Outcome {
    let folder = tempfile::tempdir()?;
    let at = |name: &str| folder.path().join(name);
    let (table, copy, results) = (
        at("table.parquet"),
        at("copy.parquet"),
        at("results.parquet"),
    );
    write_table(&table)?;
    let criterion = Criterion::default()
        .sample_size(10)
        .measurement_time(Duration::from_secs(8));
    let mut criterion = criterion.configure_from_args();
    let mut group = criterion.benchmark_group("evaluate");
    group.throughput(Throughput::Elements(ROWS as u64));
    timed(&mut group, "reading and writing alone", || {
        read_and_write(&table, &copy)
    })?;
    timed(&mut group, "rotor evaluate", || evaluate(&table, &results))?;
    group.finish();
    criterion.final_summary();
    Ok(())
}
