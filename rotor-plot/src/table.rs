//! The numbers of a figure as CSV.

use std::io;

use crate::figure::{Annotation, Axis, Curve, Map, Plot};
use crate::label::plain;

/// Writes everything that a figure shows.
pub(crate) fn write(plot: &Plot) -> Result<String, csv::Error> {
    let mut table = csv::Writer::from_writer(Vec::new());
    match plot {
        Plot::Panels(panels) => {
            // Each quantity has its own column; the other panels leave it empty.
            let quantities = headings(panels.iter().flat_map(|panel| [&panel.x, &panel.y]));
            let fixed = ["panel".to_owned(), "curve".to_owned()];
            table.write_record(fixed.iter().chain(&quantities))?;
            for panel in panels {
                let title = plain(&panel.title);
                let own = [plain(&panel.x.label), plain(&panel.y.label)];
                drawn(&panel.curves, &panel.annotations, |curve, x, y| {
                    let cells = quantities.iter().map(|quantity| match &own {
                        [first, _] if first == quantity => x,
                        [_, second] if second == quantity => y,
                        _ => "",
                    });
                    table.write_record([title.as_str(), curve].into_iter().chain(cells))
                })?;
            }
        }
        Plot::Map(map) => {
            let (x, y) = (plain(&map.x.label), plain(&map.y.label));
            table.write_record(["curve", &x, &y, &plain(&map.value_label)])?;
            map_rows(map, |row| table.write_record(row))?;
        }
        Plot::Maps(maps) => {
            let x = headings(maps.iter().map(|map| &map.x)).join(" | ");
            let y = headings(maps.iter().map(|map| &map.y)).join(" | ");
            table.write_record(["map", "curve", &x, &y, "value"])?;
            for map in maps {
                let title = plain(&map.title);
                map_rows(map, |[curve, x, y, value]| {
                    table.write_record([&title, curve, x, y, value])
                })?;
            }
        }
    }
    let bytes = table
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))?;
    String::from_utf8(bytes).map_err(|error| csv::Error::from(io::Error::other(error)))
}

/// Hands every row of a map to `line`: the map's own points, then those of its curves.
fn map_rows(
    map: &Map,
    mut line: impl FnMut([&str; 4]) -> Result<(), csv::Error>,
) -> Result<(), csv::Error> {
    for (y, row) in map
        .y_values
        .iter()
        .zip(map.values.chunks(map.x_values.len()))
    {
        for (x, value) in map.x_values.iter().zip(row) {
            line(["map", &number(*x), &number(*y), &cell(*value)])?;
        }
    }
    drawn(&map.curves, &map.annotations, |curve, x, y| {
        line([curve, x, y, ""])
    })
}

/// Hands every point of curves and annotations to `line`: its label, x and y.
fn drawn(
    curves: &[Curve],
    annotations: &[Annotation],
    mut line: impl FnMut(&str, &str, &str) -> Result<(), csv::Error>,
) -> Result<(), csv::Error> {
    for curve in curves {
        let label = plain(&curve.label);
        for (x, y) in &curve.points {
            line(&label, &number(*x), &cell(*y))?;
        }
    }
    for annotation in annotations {
        line(
            &plain(&annotation.label),
            &number(annotation.at.0),
            &number(annotation.at.1),
        )?;
    }
    Ok(())
}

/// The labels of axes, each once.
fn headings<'a>(axes: impl Iterator<Item = &'a Axis>) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for label in axes.map(|axis| plain(&axis.label)) {
        if !labels.contains(&label) {
            labels.push(label);
        }
    }
    labels
}

/// A number in the shortest form that reads back exactly.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A number, or nothing.
fn cell(value: Option<f64>) -> String {
    value.map(number).unwrap_or_default()
}
