//! `rotor zup`: which crack closes an instability region.

use std::fmt::Display;

use rotor_core::error::Error;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::jeffcott::zup::{ZeroUnstablePoint, zup_angle, zup_depth, zup_position};
use rotor_core::text::significant;

use crate::command_line::ZupArguments;
use crate::failure::{Failure, Outcome};
use crate::output;
use crate::rotor_file::{self, NamedRotor};
use crate::table::{Cell, Table, wrapped};

/// Prints the zero unstable points.
///
/// # Errors
///
/// Where the rotor cannot be read.
pub(crate) fn run(arguments: &ZupArguments) -> Result<Outcome, Failure> {
    let named = rotor_file::load(arguments.file.as_deref())?;
    for warning in named.rotor.warnings() {
        output::remark(&format!("warning: {warning}"));
    }
    output::print(&format!(
        "{}\n{}",
        wrapped(&heading(&named), ""),
        table(&named.rotor).plain()
    ))?;
    Ok(Outcome::Passed)
}

/// The rotor and the model that everything below is computed with.
pub(crate) fn heading(named: &NamedRotor) -> String {
    let parameters = named.rotor.parameters();
    format!(
        "Rotor: {}; crack model {}, edge {}",
        named.name, parameters.crack_model, parameters.crack_edge
    )
}

/// The regions as the table calls them; few rotors have the upper simple one.
const REGIONS: [(RegionKind, &str); 3] = [
    (RegionKind::Simple, "SIR"),
    (RegionKind::UpperSimple, "upper SIR"),
    (RegionKind::Combination, "CIR"),
];

/// The zero unstable points of every region.
pub(crate) fn table(rotor: &Rotor) -> Table {
    let mut rows = Vec::new();
    for (kind, short) in REGIONS {
        if kind != RegionKind::UpperSimple || rotor.region(kind).is_ok() {
            rows.extend(region_rows(rotor, kind, short));
        }
    }
    Table {
        title:
            "Zero unstable points (ZUP), Eq. (32): what closes a region, everything else as given"
                .to_owned(),
        headings: vec!["region", "closed by", "symbol", "value", "at crack angle"],
        rows,
        notes: notes(rotor),
    }
}

/// For which rotor the rows hold.
fn notes(rotor: &Rotor) -> Vec<String> {
    let p = rotor.parameters();
    let mut notes = vec![format!(
        "The depths hold for the rotor's asymmetry {} and position l_c/L = {}, the positions for its depth {}.",
        p.disk_asymmetry, p.crack_position_ratio, p.crack_depth_ratio
    )];
    if p.crack_depth_ratio == 0.0 && p.disk_asymmetry != 0.0 {
        notes.push(
            "Without a crack its position closes nothing, and a symmetric disk has no region."
                .to_owned(),
        );
    }
    notes
}

fn region_rows(rotor: &Rotor, kind: RegionKind, short: &str) -> Vec<Vec<Cell>> {
    let asymmetry = rotor
        .coefficients()
        .map_err(|error| error.to_string())
        .and_then(|c| {
            let asymmetry = Region::of(kind, &c)
                .and_then(|region| region.zup_asymmetry())
                .map_err(|error| error.to_string())?;
            let closing = rotor_core::equations::Coefficients {
                disk_asymmetry: asymmetry,
                ..c
            };
            let angle = zup_angle(kind, &closing).map_err(|error| error.to_string())?;
            Ok((asymmetry, angle))
        });
    let mut rows = Vec::new();
    match asymmetry {
        Ok((value, angle)) => {
            let what = if value.abs() < 1.0 {
                "disk asymmetry"
            } else {
                "disk asymmetry (no disk has it)"
            };
            let mut found = row(short, what, "Δ_d,ZUP", value, angle);
            if value == 0.0
                && let Some(angle) = found.last_mut()
            {
                // Nothing is left that could be turned against the other.
                *angle = Cell::text("every angle");
            }
            rows.push(found);
        }
        Err(why) => rows.push(none(short, "disk asymmetry", "Δ_d,ZUP", &why)),
    }
    rows.extend(points(
        short,
        "crack depth",
        "σ_ZUP",
        zup_depth(rotor, kind),
    ));
    rows.extend(if excited(rotor) {
        points(short, "crack position", "l_c/L", zup_position(rotor, kind))
    } else {
        let why = "every position: with neither crack nor asymmetry the region is closed";
        vec![none(short, "crack position", "l_c/L", &why)]
    });
    rows
}

/// Whether anything excites the rotor; if not, no region is open wherever the crack would be.
fn excited(rotor: &Rotor) -> bool {
    let parameters = rotor.parameters();
    parameters.disk_asymmetry != 0.0 || parameters.crack_depth_ratio != 0.0
}

fn points(
    short: &str,
    what: &str,
    symbol: &'static str,
    found: Result<Vec<ZeroUnstablePoint>, Error>,
) -> Vec<Vec<Cell>> {
    match found {
        Ok(points) if points.is_empty() => vec![none(short, what, symbol, &"none in range")],
        Ok(points) => points
            .iter()
            .map(|point| row(short, what, symbol, point.value, point.crack_angle))
            .collect(),
        Err(why) => vec![none(short, what, symbol, &why)],
    }
}

fn row(short: &str, what: &str, symbol: &'static str, value: f64, angle: f64) -> Vec<Cell> {
    let angle = if angle == 0.0 {
        "φ = 0".to_owned()
    } else {
        format!("φ = π/2 = {}", significant(angle, 6))
    };
    vec![
        Cell::text(short),
        Cell::text(what),
        Cell::Symbol(symbol),
        Cell::number(value, 10),
        Cell::text(angle),
    ]
}

fn none(short: &str, what: &str, symbol: &'static str, why: &impl Display) -> Vec<Cell> {
    vec![
        Cell::text(short),
        Cell::text(what),
        Cell::Symbol(symbol),
        Cell::text("–"),
        Cell::text(why.to_string()),
    ]
}
