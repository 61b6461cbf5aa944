//! The tables of a report.

use std::f64::consts::PI;

use rotor_core::input::INPUTS;
use rotor_core::jeffcott::exact::Ends;
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::model::SurveyedRegion;
use rotor_core::quantity::Quantity;
use rotor_core::reason;
use rotor_core::text::{shortest, significant};

use super::analysis::Analysis;
use crate::table::{Cell, Table};
use crate::zup;

/// Digits of a dimensionless result, and of one in rad/s or rpm.
const DIGITS: usize = 10;
const SPEED_DIGITS: usize = 7;

/// All tables, in the order of the report.
pub(crate) fn tables(analysis: &Analysis) -> Vec<Table> {
    let mut tables = vec![inputs(analysis), coefficients(analysis)];
    let regions = analysis.survey.regions.iter();
    tables.extend(regions.map(|(kind, region)| match region {
        Ok(found) => region_table(analysis, *kind, found),
        Err(why) => Table {
            title: region_title(*kind),
            headings: vec![""],
            rows: Vec::new(),
            notes: vec![format!("None: {why}.")],
        },
    }));
    tables.extend(
        analysis
            .survey
            .unstable_from
            .map(|lower| open_table(analysis, lower)),
    );
    tables.push(zup::table(&analysis.named.rotor));
    tables
}

/// The instability that has no upper end.
fn open_table(analysis: &Analysis, lower: f64) -> Table {
    Table {
        title: "Instability that reaches to infinite speed (simple, where |Δ_d| > |β − 1|)"
            .to_owned(),
        headings: vec!["", "× ω_st", "rad/s", "rpm"],
        rows: vec![speeds(analysis, "unstable from Ω = … upwards", lower)],
        notes: vec!["From there on every speed is unstable.".to_owned()],
    }
}

/// Which exact ends of a region bound no stable speed, because every speed from `unstable_from` on is unstable.
fn no_boundary(ends: &Ends, unstable_from: f64) -> Option<&'static str> {
    let inside = |end: f64| end > unstable_from;
    match (inside(ends.lower), inside(ends.upper)) {
        (true, true) => Some("Its exact ends are no boundary of stability"),
        (false, true) => Some("Its exact upper end is no boundary of stability"),
        (_, false) => None,
    }
}

fn inputs(analysis: &Analysis) -> Table {
    let parameters = analysis.named.rotor.parameters();
    let mut rows: Vec<_> = INPUTS
        .iter()
        .map(|input| {
            vec![
                Cell::text(input.name),
                Cell::Symbol(input.symbol),
                Cell::Number(shortest((input.get)(parameters))),
                Cell::text(input.unit),
                Cell::text(input.description),
            ]
        })
        .collect();
    let choice = |name: &str, value: &str, what: &str| {
        vec![
            Cell::text(name),
            Cell::empty(),
            Cell::Number(value.to_owned()),
            Cell::empty(),
            Cell::text(what),
        ]
    };
    rows.push(choice(
        "crack_model",
        parameters.crack_model.name(),
        "how the crack enters the flexibility",
    ));
    rows.push(choice(
        "crack_edge",
        parameters.crack_edge.name(),
        "how much of the crack's edge a moment opens",
    ));
    Table {
        title: "Inputs".to_owned(),
        headings: vec!["name", "symbol", "value", "unit", ""],
        rows,
        notes: vec![],
    }
}

fn coefficients(analysis: &Analysis) -> Table {
    let (crack, c) = (&analysis.compliance, &analysis.coefficients);
    let values = [
        (Quantity::C11, crack.c11),
        (Quantity::C22, crack.c22),
        (Quantity::C33, crack.c33),
        (Quantity::C44, crack.c44),
        (Quantity::ReferenceSpeed, analysis.reference_speed),
        (Quantity::Beta, c.beta),
        (Quantity::Gamma, c.gamma),
        (Quantity::Delta, c.delta),
        (Quantity::Epsilon1, c.epsilon_1),
        (Quantity::Epsilon12, c.epsilon_12),
        (Quantity::Epsilon2, c.epsilon_2),
    ];
    let rows = values
        .into_iter()
        .map(|(quantity, value)| {
            vec![
                Cell::text(quantity.name()),
                Cell::Symbol(quantity.symbol()),
                Cell::number(value, DIGITS),
                Cell::text(quantity.unit()),
            ]
        })
        .collect();
    Table {
        title: "Crack compliance, reference speed and dimensionless coefficients, Eqs. (8) to (12)"
            .to_owned(),
        headings: vec!["name", "symbol", "value", "unit"],
        rows,
        notes: vec![format!(
            "The reference speed is {} rpm.",
            significant(rpm(analysis.reference_speed), SPEED_DIGITS)
        )],
    }
}

fn region_title(kind: RegionKind) -> String {
    let description = kind.description();
    let mut letters = description.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string())
        .unwrap_or_default();
    let condition = match kind {
        RegionKind::Simple => "SIR, from ω₂ = Ω",
        RegionKind::UpperSimple => "second SIR, from ω₁ = Ω",
        RegionKind::Combination => "CIR, from ω₁ + ω₂ = 2Ω",
        other => other.name(),
    };
    format!("{first}{} ({condition})", letters.as_str())
}

fn region_table(analysis: &Analysis, kind: RegionKind, region: &SurveyedRegion) -> Table {
    let equation = if kind == RegionKind::Combination {
        "Eq. (16)"
    } else {
        "Eq. (15)"
    };
    let mut rows = vec![speeds(
        analysis,
        &format!("start, {equation}"),
        region.start,
    )];
    let mut notes = Vec::new();
    match &region.width {
        Ok(width) => rows.push(speeds(analysis, "approximate width, Eq. (31)", *width)),
        Err(why) => notes.push(format!("No approximate width: {why}.")),
    }
    match &region.exact {
        Ok(ends) => {
            rows.push(speeds(analysis, "exact lower end", ends.lower));
            rows.push(speeds(analysis, "exact upper end", ends.upper));
            rows.push(speeds(analysis, "exact width", ends.width()));
            let lower = analysis.survey.unstable_from.unwrap_or(f64::INFINITY);
            notes.extend(no_boundary(ends, lower).map(|what| {
                let lower = significant(lower, DIGITS);
                format!("{what}: from {lower} × ω_st upwards every speed is unstable.")
            }));
        }
        Err(why) => notes.push(format!("No exact ends: {why}.")),
    }
    match &region.hill {
        Ok(hill) => rows.push(speeds(
            analysis,
            "width by Hill's method, Eq. (40)",
            hill.width(),
        )),
        Err(why) => {
            let why = reason::of_boundary(why);
            notes.push(format!("No width by Hill's method: {why}."));
        }
    }
    let differences = [
        (
            "Eq. (31) is off the exact width by",
            region.approximation_difference(),
        ),
        (
            "Hill's method is off the exact width by",
            region.hill_difference(),
        ),
    ];
    notes.extend(
        differences
            .into_iter()
            .filter_map(|(what, value)| value.map(|value| format!("{what} {}.", percent(value)))),
    );
    Table {
        title: region_title(kind),
        headings: vec!["", "× ω_st", "rad/s", "rpm"],
        rows,
        notes,
    }
}

fn speeds(analysis: &Analysis, what: &str, relative: f64) -> Vec<Cell> {
    let speed = relative * analysis.reference_speed;
    vec![
        Cell::text(what),
        Cell::number(relative, DIGITS),
        Cell::number(speed, SPEED_DIGITS),
        Cell::number(rpm(speed), SPEED_DIGITS),
    ]
}

/// A speed of rad/s in turns a minute.
fn rpm(speed: f64) -> f64 {
    speed * 30.0 / PI
}

/// A relative difference; what is only rounding is told as a bound.
fn percent(value: f64) -> String {
    if value.abs() < 1e-8 {
        return "less than 1e-6 %".to_owned();
    }
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{} %", significant(100.0 * value, 3))
}
