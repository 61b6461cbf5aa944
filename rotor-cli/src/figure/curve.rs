//! Curves: their colours, the part of them inside the frame, and their marks.

use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::canvas::{stroke, units};
use super::panel::{Drawing, Page};
use super::{Dash, Mark, Symbol};

/// The palette of Okabe and Ito, which people with any kind of colour vision can tell apart; yellow is left out, it is
/// too light for lines on white.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x00, 0x00, 0x00),
];

/// Width of a curve in pixels.
const LINE_WIDTH: f64 = 1.8;

/// The colour of an index.
pub(super) fn colour(index: usize) -> RGBColor {
    PALETTE.get(index % PALETTE.len()).copied().unwrap_or(BLACK)
}

/// The connected parts of a curve inside a window, cut at its edges. A point with gaps on both sides is a part of its
/// own.
pub(super) fn visible_parts(
    points: &[(f64, Option<f64>)],
    x: (f64, f64),
    y: (f64, f64),
) -> Vec<Vec<(f64, f64)>> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    // Whether the last part ends at `before`, so that the next segment continues it.
    let mut connected = false;
    for (index, &(here_x, here_y)) in points.iter().enumerate() {
        let here = here_y.map(|here_y| (here_x, here_y));
        match (before, here) {
            (Some(from), Some(to)) => {
                let clipped = clip(from, to, x, y);
                if let Some((start, end)) = clipped {
                    match parts.last_mut() {
                        Some(part) if connected => part.push(end),
                        _ => parts.push(vec![start, end]),
                    }
                }
                connected = clipped.is_some_and(|(_, end)| end == to);
            }
            (None, Some(to)) => {
                connected = false;
                let alone = points.get(index + 1).is_none_or(|next| next.1.is_none());
                if alone && inside(to, x, y) {
                    parts.push(vec![to]);
                }
            }
            (_, None) => connected = false,
        }
        before = here;
    }
    parts
}

/// The points inside a window.
pub(super) fn visible_points(
    points: &[(f64, Option<f64>)],
    x: (f64, f64),
    y: (f64, f64),
) -> Vec<(f64, f64)> {
    let existing = points.iter().filter_map(|&(x, y)| y.map(|y| (x, y)));
    existing.filter(|&point| inside(point, x, y)).collect()
}

/// Whether a point lies in a window or on its edge.
fn inside(point: (f64, f64), x: (f64, f64), y: (f64, f64)) -> bool {
    (x.0..=x.1).contains(&point.0) && (y.0..=y.1).contains(&point.1)
}

/// The part of a segment inside a window (Liang and Barsky's method).
fn clip(
    from: (f64, f64),
    to: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges = [
        (-dx, from.0 - x.0),
        (dx, x.1 - from.0),
        (-dy, from.1 - y.0),
        (dy, y.1 - from.1),
    ];
    for (outwards, room) in edges {
        if outwards == 0.0 && room < 0.0 {
            return None;
        }
        if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else if outwards > 0.0 {
            leave = leave.min(room / outwards);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

/// Draws a line through points of the page.
pub(super) fn line(
    page: &Page<'_>,
    points: Vec<(i32, i32)>,
    dash: Dash,
    colour: RGBColor,
) -> Result<(), Drawing> {
    if let [point] = points[..] {
        return page.draw(&Circle::new(point, units(LINE_WIDTH), colour.filled()));
    }
    let style = colour.stroke_width(stroke(LINE_WIDTH));
    match dash {
        Dash::Solid => page.draw(&PathElement::new(points, style)),
        Dash::Dashed => page.draw(&DashedPathElement::new(
            points,
            units(7.0),
            units(3.5),
            style,
        )),
        Dash::Dotted => page.draw(&DashedPathElement::new(
            points,
            units(1.8),
            units(2.6),
            style,
        )),
    }
}

/// Draws open symbols at points of the page.
pub(super) fn symbols(
    page: &Page<'_>,
    points: &[(i32, i32)],
    symbol: Symbol,
    colour: RGBColor,
) -> Result<(), Drawing> {
    let edge = colour.stroke_width(stroke(1.4));
    if symbol == Symbol::Circle {
        let radius = units(3.4);
        for style in [WHITE.filled(), edge] {
            for &point in points {
                page.draw(&Circle::new(point, radius, style))?;
            }
        }
        return Ok(());
    }
    for &point in points {
        page.draw(&Polygon::new(corners(symbol, point), WHITE.filled()))?;
    }
    for &point in points {
        let mut outline = corners(symbol, point);
        // The first side again, so that the last corner is joined like the others.
        outline.extend_from_within(..2.min(outline.len()));
        page.draw(&PathElement::new(outline, edge))?;
    }
    Ok(())
}

/// Corners of a symbol about a point; a circle has none.
fn corners(symbol: Symbol, (x, y): (i32, i32)) -> Vec<(i32, i32)> {
    let offsets: &[(f64, f64)] = match symbol {
        Symbol::Circle => &[],
        Symbol::Square => &[(-3.1, -3.1), (3.1, -3.1), (3.1, 3.1), (-3.1, 3.1)],
        Symbol::Triangle => &[(0.0, -4.2), (3.8, 2.6), (-3.8, 2.6)],
        Symbol::Diamond => &[(0.0, -4.4), (4.0, 0.0), (0.0, 4.4), (-4.0, 0.0)],
    };
    offsets
        .iter()
        .map(|&(dx, dy)| (x + units(dx), y + units(dy)))
        .collect()
}

/// Draws a mark as the legend shows it, from `x` to `x + width` at the height `y`.
pub(super) fn sample(
    page: &Page<'_>,
    (x, y): (i32, i32),
    width: i32,
    mark: Mark,
    colour: RGBColor,
) -> Result<(), Drawing> {
    match mark {
        Mark::Line(dash) => line(page, vec![(x, y), (x + width, y)], dash, colour),
        Mark::Points(symbol) => symbols(page, &[(x + width / 2, y)], symbol, colour),
    }
}
