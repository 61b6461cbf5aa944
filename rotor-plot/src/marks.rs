//! Lines, symbols and areas, in a frame and as samples in a legend.

use crate::figure::{Curve, Dash, Mark, Symbol};
use crate::geometry::{Point, Rect, clip_polygon, hatch, visible_parts};
use crate::svg::{Path, Svg, WHITE, fill, stroke};

/// The palette of Okabe and Ito, whose colours people with any kind of colour vision can tell apart, without its yellow,
/// which is too light for lines on white.
const PALETTE: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000",
];

/// Width of a curve in pixels.
const LINE_WIDTH: f64 = 1.8;
/// Width of the white lines beside a curve on a map in pixels.
const HALO_WIDTH: f64 = 3.4;
/// Length of a line and of a symbol in a legend in pixels: a line shows its whole pattern.
const SAMPLE: (f64, f64) = (34.0, 10.0);

/// Picks the colour of an index.
fn colour(index: usize) -> &'static str {
    PALETTE
        .get(index % PALETTE.len())
        .copied()
        .unwrap_or("#000000")
}

/// Lengths of the strokes and gaps of a pattern in pixels.
fn dashes(dash: Dash) -> &'static str {
    match dash {
        Dash::Solid => "",
        Dash::Dashed => "7 3.5",
        Dash::Dotted => "1.8 2.6",
        Dash::DashDotted => "8 2.8 1.8 2.8",
        Dash::LongDashed => "13 4",
        Dash::DashDotDotted => "8 2.4 1.8 2.4 1.8 2.4",
    }
}

/// Draws the part of a curve inside a frame; `points` are its points on the page. Over a map a wider white line is drawn
/// below each line.
pub(crate) fn draw(
    svg: &mut Svg,
    curve: &Curve,
    points: &[(f64, Option<f64>)],
    frame: &Rect,
    on_map: bool,
) {
    match curve.mark {
        Mark::Line(dash) => {
            let parts = visible_parts(points, frame);
            if on_map {
                let mut halo = Path::default();
                parts.iter().for_each(|part| halo.line(part));
                svg.path(&halo, &stroke(WHITE, HALO_WIDTH));
            }
            line(svg, &parts, dash, colour(curve.colour));
        }
        Mark::Points(symbol) => {
            let existing = points.iter().filter_map(|&(x, y)| y.map(|y| (x, y)));
            let inside: Vec<_> = existing.filter(|&point| frame.holds(point)).collect();
            symbols(svg, &inside, symbol, colour(curve.colour));
        }
        Mark::Area => {
            for part in points.split(|point| point.1.is_none()) {
                let outline: Vec<_> = part
                    .iter()
                    .filter_map(|&(x, y)| y.map(|y| (x, y)))
                    .collect();
                area(svg, &clip_polygon(&outline, frame), curve.colour);
            }
        }
    }
}

/// Width of a mark in a legend in pixels.
pub(crate) fn sample_width(mark: Mark) -> f64 {
    if matches!(mark, Mark::Points(_)) {
        SAMPLE.1
    } else {
        SAMPLE.0
    }
}

/// Draws a mark as the legend shows it, with its left end at a point.
pub(crate) fn sample(svg: &mut Svg, (x, y): Point, mark: Mark, index: usize) {
    let width = sample_width(mark);
    match mark {
        Mark::Line(dash) => line(svg, &[vec![(x, y), (x + width, y)]], dash, colour(index)),
        Mark::Points(symbol) => symbols(svg, &[(x + 0.5 * width, y)], symbol, colour(index)),
        Mark::Area => {
            let swatch = Rect::around((x + 0.5 * width, y), (width, 11.0));
            area(svg, &swatch.corners(), index);
        }
    }
}

/// Draws the parts of a line.
fn line(svg: &mut Svg, parts: &[Vec<Point>], dash: Dash, colour: &str) {
    let (mut path, mut dots) = (Path::default(), Path::default());
    for part in parts {
        if let [point] = part[..] {
            dots.circle(point, LINE_WIDTH);
        } else {
            path.line(part);
        }
    }
    let mut attributes = stroke(colour, LINE_WIDTH);
    if dash != Dash::Solid {
        attributes.push_str(&format!(" stroke-dasharray=\"{}\"", dashes(dash)));
    }
    svg.path(&path, &attributes);
    svg.path(&dots, &fill(colour));
}

/// Draws open symbols at points of the page.
fn symbols(svg: &mut Svg, points: &[Point], symbol: Symbol, colour: &str) {
    let corners: &[Point] = match symbol {
        Symbol::Circle => &[],
        Symbol::Square => &[(-3.1, -3.1), (3.1, -3.1), (3.1, 3.1), (-3.1, 3.1)],
        Symbol::Triangle => &[(0.0, -4.2), (3.8, 2.6), (-3.8, 2.6)],
        Symbol::Diamond => &[(0.0, -4.4), (4.0, 0.0), (0.0, 4.4), (-4.0, 0.0)],
    };
    let mut path = Path::default();
    for &(x, y) in points {
        if corners.is_empty() {
            path.circle((x, y), 3.4);
        } else {
            let outline: Vec<_> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
            path.polygon(&outline);
        }
    }
    svg.path(&path, &fill(WHITE));
    svg.path(&path, &stroke(colour, 1.4));
}

/// Draws a hatched area; what is below it shows between the lines. Areas of neighbouring indices are hatched in different
/// directions, and every other pair more densely.
fn area(svg: &mut Svg, outline: &[Point], index: usize) {
    let (mut inside, mut lines) = (Path::default(), Path::default());
    if outline.is_empty() {
        return;
    }
    inside.polygon(outline);
    let spacing = if index % 4 < 2 { 6.0 } else { 3.5 };
    for segment in hatch(outline, spacing, index.is_multiple_of(2)) {
        lines.line(&segment);
    }
    svg.path(&lines, &stroke(colour(index), 0.8));
    svg.path(&inside, &stroke(colour(index), 1.2));
}
