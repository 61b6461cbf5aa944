//! The numbers from which this library and the other tools compute, the same at every run.

use std::f64::consts::PI;

use rotor_core::input::RotorParameters;

use crate::column::Column;

/// Points that are read from memory: too many for any cache.
pub const STREAM: usize = 1 << 20;

/// Points that stay in the nearest cache.
pub const BLOCK: usize = 4096;

/// Points of which the 39 columns of the physical inputs, both widths and their gradients stay in the cache of one core.
pub const PHYSICAL: usize = 1024;

/// The dimensionless columns in the order of [`rotor_core::equations::Coefficients`], with the span of each: what rotors
/// like the paper's have.
pub const COLUMNS: [(&str, f64, f64); 8] = [
    ("beta", 1.2, 1.8),
    ("gamma", -0.95, -0.7),
    ("delta", 1.3, 1.8),
    ("epsilon_1", 0.05, 0.15),
    ("epsilon_12", 0.08, 0.2),
    ("epsilon_2", 0.05, 0.15),
    ("disk_asymmetry", 0.05, 0.3),
    ("crack_angle", 0.0, PI),
];

/// Numbers spread over a span: a Weyl sequence of a step of its own for each `column`, so that no two columns go together.
pub fn spread(column: usize, lower: f64, upper: f64, count: usize) -> Vec<f64> {
    let step = ((column + 2) as f64).sqrt().fract() + 0.017 * (column + 1) as f64;
    (0..count)
        .map(|row| lower + (upper - lower) * (step * (row + 1) as f64).fract())
        .collect()
}

/// All dimensionless columns.
pub fn columns(count: usize) -> Vec<Column> {
    let column = |(place, (_, lower, upper)): (usize, &(&str, f64, f64))| {
        Column::input(place, &spread(place, *lower, *upper, count))
    };
    COLUMNS.iter().enumerate().map(column).collect()
}

/// Depths of the crack for the rows of a grid, without the closed crack.
pub fn depths(count: usize) -> Vec<f64> {
    (0..count)
        .map(|row| 0.02 + 0.38 * row as f64 / count as f64)
        .collect()
}

/// Angles of the crack for the columns of a grid.
pub fn angles(count: usize) -> Vec<f64> {
    (0..count)
        .map(|column| PI * column as f64 / count as f64)
        .collect()
}

/// The rotor of which depth and angle are varied.
pub const ROTOR: RotorParameters = RotorParameters::PAPER;
