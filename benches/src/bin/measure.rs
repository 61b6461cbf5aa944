//! Runs the cases as they are asked for on standard input, so that another program can take turns with this one.
//!
//! `run CASE` answers with the seconds of one run; `write CASE FILE` runs it and writes its results, a column after the
//! other, as little-endian doubles; `inputs FOLDER` writes what the other tools compute from; `near FORM ROTORS ANGLES FILE`
//! computes the rotors and angles of two files as `columns` or as a `grid`. The arguments are the sizes: of the grid, of
//! the depths and angles of the maximum.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command speaks through them"
)]

use std::error::Error;
use std::fs;
use std::io::{BufRead, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use rotor_benches::cases::{Bench, CASES, Case, Sizes, near_columns, near_grid};
use rotor_benches::inputs;
use rotor_core::equations::{
    lateral_integral, opening_integral, sliding_integral, tearing_integral,
};
use rotor_core::input::INPUTS;

fn main() -> ExitCode {
    let sizes: Vec<usize> = std::env::args()
        .skip(1)
        .filter_map(|size| size.parse().ok())
        .collect();
    let &[grid, max_rows, max_angles] = &sizes[..] else {
        eprintln!("measure: name the sizes of the grid, of the depths and of the angles");
        return ExitCode::from(2);
    };
    let sizes = Sizes {
        grid,
        max_rows,
        max_angles,
    };
    match answer(sizes) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("measure: {error}");
            ExitCode::FAILURE
        }
    }
}

fn answer(sizes: Sizes) -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(sizes);
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["run", name] => {
                let start = Instant::now();
                (case(name)?.run)(&mut bench)?;
                println!("{:e}", start.elapsed().as_secs_f64());
            }
            ["write", name, file] => {
                (case(name)?.run)(&mut bench)?;
                write(Path::new(file), &bench.results())?;
                println!("{}", bench.results().len());
            }
            ["points", name] => println!("{}", (case(name)?.points)(&sizes)),
            ["inputs", folder] => {
                write_inputs(Path::new(folder), sizes)?;
                println!("done");
            }
            ["near", form, rotors, angles, file] => {
                let rotors = read(Path::new(rotors), COEFFICIENTS)?;
                let angles = read(Path::new(angles), 1)?.concat();
                let widths = match form {
                    "grid" => near_grid(&rotors, &angles)?,
                    _ => near_columns(&rotors, &angles)?,
                };
                write(Path::new(file), &widths)?;
                println!("done");
            }
            _ => return Err(format!("there is no command `{line}`").into()),
        }
        std::io::stdout().flush()?;
    }
    Ok(())
}

fn case(name: &str) -> Result<&'static Case, String> {
    let known = CASES.iter().find(|case| case.name == name);
    known.ok_or_else(|| format!("there is no case `{name}`"))
}

/// The coefficients of a rotor but the angle of its crack.
const COEFFICIENTS: usize = 7;

/// Reads a number of columns from a file of little-endian doubles.
fn read(file: &Path, columns: usize) -> std::io::Result<Vec<Vec<f64>>> {
    let bytes = fs::read(file)?;
    let (numbers, _) = bytes.as_chunks::<{ size_of::<f64>() }>();
    let numbers: Vec<f64> = numbers.iter().copied().map(f64::from_le_bytes).collect();
    let rows = (numbers.len() / columns).max(1);
    Ok(numbers.chunks(rows).map(<[f64]>::to_vec).collect())
}

fn write(file: &Path, columns: &[impl AsRef<[f64]>]) -> std::io::Result<()> {
    let bytes: Vec<u8> = columns
        .iter()
        .flat_map(AsRef::as_ref)
        .flat_map(|number| number.to_le_bytes())
        .collect();
    fs::write(file, bytes)
}

/// The dimensionless columns, and for both grids the depths, the four integrals of the crack at each, and the angles.
fn write_inputs(folder: &Path, sizes: Sizes) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    let rotor: serde_json::Map<String, serde_json::Value> = INPUTS
        .iter()
        .map(|input| (input.name.to_owned(), (input.get)(&inputs::ROTOR).into()))
        .collect();
    fs::write(
        folder.join("rotor.json"),
        serde_json::Value::Object(rotor).to_string(),
    )?;
    write(
        &folder.join("columns.f64"),
        &inputs::columns(inputs::STREAM),
    )?;
    for (name, rows, columns) in [
        ("grid", sizes.grid, sizes.grid),
        ("max", sizes.max_rows, sizes.max_angles),
    ] {
        let depths = inputs::depths(rows);
        let at =
            |integral: fn(f64) -> f64| depths.iter().copied().map(integral).collect::<Vec<f64>>();
        let integrals = [
            at(sliding_integral::value),
            at(tearing_integral::value),
            at(opening_integral::value),
            at(lateral_integral::value),
        ];
        write(
            &folder.join(format!("{name}_depths.f64")),
            std::slice::from_ref(&depths),
        )?;
        write(&folder.join(format!("{name}_integrals.f64")), &integrals)?;
        write(
            &folder.join(format!("{name}_angles.f64")),
            &[inputs::angles(columns)],
        )?;
    }
    Ok(())
}
