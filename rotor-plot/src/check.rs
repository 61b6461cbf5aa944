//! Looks for what cannot be drawn, before anything is drawn.

use crate::PlotErrorKind;
use crate::figure::{Annotation, Curve, Map, Plot};

/// Refuses what cannot be drawn.
pub(crate) fn check(plot: &Plot) -> Result<(), PlotErrorKind> {
    match plot {
        Plot::Panels(panels) if panels.is_empty() || panels.len() > 2 => {
            Err(PlotErrorKind::PanelCount {
                count: panels.len(),
            })
        }
        Plot::Panels(panels) => panels
            .iter()
            .try_for_each(|panel| check_drawn(&panel.curves, &panel.annotations)),
        Plot::Map(map) => check_map(map),
        Plot::Maps(maps) if maps.is_empty() => Err(PlotErrorKind::NoMap),
        Plot::Maps(maps) => maps.iter().try_for_each(check_map),
    }
}

/// Refuses numbers of curves and annotations that are not finite.
fn check_drawn(curves: &[Curve], annotations: &[Annotation]) -> Result<(), PlotErrorKind> {
    for curve in curves {
        let what = || format!("the curve \"{}\"", curve.label);
        for (index, (x, y)) in curve.points.iter().enumerate() {
            check_finite(&what, "x", index, *x)?;
            check_finite(&what, "y", index, y.unwrap_or(0.0))?;
        }
    }
    for annotation in annotations {
        let what = || format!("the annotation \"{}\"", annotation.label);
        check_finite(&what, "x", 0, annotation.at.0)?;
        check_finite(&what, "y", 0, annotation.at.1)?;
    }
    Ok(())
}

/// Refuses a map unless its grid increases and each of its points has a finite value or none.
fn check_map(map: &Map) -> Result<(), PlotErrorKind> {
    let (columns, rows, values) = (map.x_values.len(), map.y_values.len(), map.values.len());
    if columns < 2 || rows < 2 || Some(values) != columns.checked_mul(rows) {
        return Err(PlotErrorKind::MapShape {
            values,
            columns,
            rows,
        });
    }
    for (axis, of_axis) in [("x", &map.x_values), ("y", &map.y_values)] {
        for (index, value) in of_axis.iter().enumerate() {
            check_finite(&|| "the map's axis".to_owned(), axis, index, *value)?;
        }
        let falls = of_axis
            .iter()
            .zip(of_axis.iter().skip(1))
            .position(|(a, b)| a >= b);
        if let Some(index) = falls {
            return Err(PlotErrorKind::MapAxis {
                axis,
                index: index + 1,
            });
        }
    }
    let what = || format!("the map of \"{}\"", map.value_label);
    for (index, value) in map.values.iter().enumerate() {
        check_finite(&what, "value", index, value.unwrap_or(0.0))?;
    }
    for (index, level) in map.levels.iter().enumerate() {
        check_finite(&what, "level", index, *level)?;
    }
    check_drawn(&map.curves, &map.annotations)
}

/// Refuses a value that is not finite.
fn check_finite(
    what: &dyn Fn() -> String,
    quantity: &'static str,
    index: usize,
    value: f64,
) -> Result<(), PlotErrorKind> {
    if value.is_finite() {
        return Ok(());
    }
    Err(PlotErrorKind::NotFinite {
        what: what(),
        quantity,
        index,
        value,
    })
}
