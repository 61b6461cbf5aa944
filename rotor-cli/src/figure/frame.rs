//! The frame of a plot: axes with ticks, grid and labels, and the labelled points inside.

use plotters::coord::cartesian::Cartesian2d;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{Canvas, stroke, units};
use super::panel::{Drawing, Page};
use super::text::{self, Fonts, Shape};
use super::ticks::{Ends, Scale};
use super::{Annotation, Axis, Curve, Figure, FigureError, curve};

/// Size of the ticks' letters in pixels.
pub(super) const TICK_LETTERS: f64 = 11.5;
/// Size of the axis labels' letters in pixels.
pub(super) const AXIS_LETTERS: f64 = 13.0;
/// Size of the annotations' letters in pixels.
const NOTE_LETTERS: f64 = 11.5;
/// Length of a tick in pixels; its label stands twice as far from the axis.
pub(super) const TICK: f64 = 4.0;
/// Colours of letters, of axes and of the grid.
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const AXIS: RGBColor = RGBColor(0x55, 0x55, 0x55);
const GRID: RGBColor = RGBColor(0xe6, 0xe6, 0xe6);

/// Where a plot stands on the page, in pixels, and the scales of its axes.
pub(super) struct Layout {
    /// Left and upper edge of the place.
    pub(super) at: (f64, f64),
    /// Width and height of the place.
    pub(super) size: (f64, f64),
    /// Space above and on the right of the frame.
    pub(super) margin: (f64, f64),
    /// Scale of the horizontal axis.
    pub(super) x: Scale,
    /// Scale of the vertical axis.
    pub(super) y: Scale,
    /// Space on the left of the frame, for the ticks' labels and the axis' label.
    pub(super) left: f64,
}

impl Layout {
    /// Space that a vertical axis needs on its side of the frame, in pixels.
    pub(super) fn beside(scale: &Scale, fonts: &Fonts) -> f64 {
        let widths = scale
            .ticks
            .iter()
            .map(|&tick| tick_width(fonts, &scale.write(tick)));
        widths.fold(0.0, f64::max) + 2.0 * TICK + AXIS_LETTERS + 10.0
    }

    /// Width of the frame in pixels.
    pub(super) fn frame_width(&self) -> f64 {
        self.size.0 - self.left - self.margin.1
    }
}

/// Width of a tick's label in pixels.
fn tick_width(fonts: &Fonts, label: &str) -> f64 {
    fonts.width(&text::parse(label, Shape::Upright), TICK_LETTERS)
}

/// Coordinates of a plot.
type Coordinates = Cartesian2d<Scale, Scale>;

/// The inside of the axes.
pub(super) struct Frame<'a> {
    plotting: DrawingArea<Canvas<'a>, Coordinates>,
    window: ((f64, f64), (f64, f64)),
}

impl Frame<'_> {
    /// Where a point of the plot lies on the page.
    pub(super) fn at(&self, point: (f64, f64)) -> (i32, i32) {
        self.plotting.map_coordinate(&point)
    }

    /// The ranges of the axes.
    pub(super) fn window(&self) -> ((f64, f64), (f64, f64)) {
        self.window
    }

    /// Left edge in canvas units.
    pub(super) fn left(&self) -> i32 {
        self.at((self.window.0.0, self.window.1.0)).0
    }

    /// Upper edge in canvas units.
    pub(super) fn top(&self) -> i32 {
        self.at((self.window.0.0, self.window.1.1)).1
    }

    /// Right edge in canvas units.
    pub(super) fn right(&self) -> i32 {
        self.at((self.window.0.1, self.window.1.0)).0
    }

    /// Lower edge in canvas units.
    pub(super) fn bottom(&self) -> i32 {
        self.at((self.window.0.0, self.window.1.0)).1
    }

    /// Width in canvas units.
    pub(super) fn width(&self) -> i32 {
        self.right() - self.left()
    }

    /// How many of a space's two corners lie outside.
    fn outside(&self, space: &Space) -> usize {
        let (left, top, right, bottom) = (self.left(), self.top(), self.right(), self.bottom());
        let inside = Space {
            left,
            top,
            right,
            bottom,
        };
        let corners = [(space.left, space.top), (space.right, space.bottom)];
        corners
            .into_iter()
            .filter(|&corner| !inside.holds(corner))
            .count()
    }

    /// Draws the outline.
    pub(super) fn outline(&self, page: &Page<'_>) -> Result<(), Drawing> {
        let corners = [(self.left(), self.top()), (self.right(), self.bottom())];
        page.draw(&Rectangle::new(corners, AXIS.stroke_width(stroke(1.0))))
    }
}

/// The scale of an axis: its own range, or one that fits the data.
pub(super) fn scale(
    figure: &Figure,
    panel: &str,
    axis: &Axis,
    data: impl Iterator<Item = f64>,
    (ends, count): (Ends, f64),
) -> Result<Scale, FigureError> {
    let refused = |low, high| FigureError::Range {
        figure: figure.name.clone(),
        axis: axis.label.clone(),
        low,
        high,
    };
    if let Some((low, high)) = axis.range {
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(refused(low, high));
        }
        return Ok(Scale::new(low, high, axis.ticks, Ends::Kept, count));
    }
    let range = data.fold(None, |range: Option<(f64, f64)>, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((low.min(value), high.max(value)))
    });
    let (low, high) = range.ok_or_else(|| FigureError::Empty {
        figure: figure.name.clone(),
        panel: panel.to_owned(),
        axis: axis.label.clone(),
    })?;
    if !(high - low).is_finite() {
        return Err(refused(low, high));
    }
    // A single value stands in the middle.
    let around = match high - low {
        span if span > 1e-300 => 0.0,
        _ if low == 0.0 => 0.1,
        _ => (0.1 * low.abs()).max(1e-300),
    };
    Ok(Scale::new(
        low - around,
        high + around,
        axis.ticks,
        ends,
        count,
    ))
}

/// Draws axes with ticks and labels, and the grid if asked for.
pub(super) fn axes<'a>(
    page: &Page<'a>,
    (x, y): (&Axis, &Axis),
    layout: &Layout,
    grid: bool,
) -> Result<Frame<'a>, Drawing> {
    let place = page.clone().shrink(
        (units(layout.at.0), units(layout.at.1)),
        (units(layout.size.0), units(layout.size.1)),
    );
    let mut chart = ChartBuilder::on(&place)
        .margin_top(units(layout.margin.0))
        .margin_right(units(layout.margin.1))
        .x_label_area_size(units(2.0 * TICK + TICK_LETTERS + AXIS_LETTERS + 12.0))
        .y_label_area_size(units(layout.left))
        .build_cartesian_2d(layout.x.clone(), layout.y.clone())?;
    let letters = |size: f64| TextStyle::from(("sans-serif", units(size)).into_font()).color(&INK);
    let (x_tick, y_tick) = (|v: &f64| layout.x.write(*v), |v: &f64| layout.y.write(*v));
    let mut mesh = chart.configure_mesh();
    mesh.bold_line_style(GRID.stroke_width(stroke(1.0)))
        .light_line_style(TRANSPARENT)
        .axis_style(AXIS.stroke_width(stroke(1.0)))
        .set_all_tick_mark_size(units(TICK))
        .label_style(letters(TICK_LETTERS))
        .axis_desc_style(letters(AXIS_LETTERS))
        .x_label_formatter(&x_tick)
        .y_label_formatter(&y_tick)
        .x_desc(x.label.as_str())
        .y_desc(y.label.as_str());
    if !grid {
        mesh.disable_mesh();
    }
    mesh.draw()?;
    let window = ((layout.x.low, layout.x.high), (layout.y.low, layout.y.high));
    Ok(Frame {
        plotting: chart.plotting_area().clone(),
        window,
    })
}

/// Writes a text with its left end at a point, centred on its height.
pub(super) fn write(
    page: &Page<'_>,
    label: &str,
    at: (i32, i32),
    size: f64,
    style: FontStyle,
) -> Result<(), Drawing> {
    let font = ("sans-serif", units(size), style).into_font();
    let style = TextStyle::from(font)
        .color(&INK)
        .pos(Pos::new(HPos::Left, VPos::Center));
    page.draw_text(label, &style, at)
}

/// Writes a note in the middle of a frame.
pub(super) fn note(
    page: &Page<'_>,
    frame: &Frame<'_>,
    note: &str,
    fonts: &Fonts,
) -> Result<(), Drawing> {
    if note.is_empty() {
        return Ok(());
    }
    let width = fonts.width(&text::parse(note, Shape::Upright), AXIS_LETTERS);
    let middle = (frame.left() + frame.right()) / 2 - units(0.5 * width);
    let at = (middle, (frame.top() + frame.bottom()) / 2);
    write(page, note, at, AXIS_LETTERS, FontStyle::Normal)
}

/// A rectangle on the page in canvas units.
#[derive(Debug, Clone, Copy)]
struct Space {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
}

impl Space {
    /// Whether a point lies inside.
    fn holds(&self, (x, y): (i32, i32)) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    /// The point inside that is nearest to another one.
    fn nearest(&self, (x, y): (i32, i32)) -> (i32, i32) {
        (
            x.clamp(self.left, self.right),
            y.clamp(self.top, self.bottom),
        )
    }

    /// Square of the distance from a point to the nearest point inside.
    fn distance(&self, (x, y): (i32, i32)) -> i64 {
        let nearest = self.nearest((x, y));
        let (dx, dy) = (x - nearest.0, y - nearest.1);
        i64::from(dx).pow(2) + i64::from(dy).pow(2)
    }

    /// Whether two spaces overlap.
    fn meets(&self, other: &Self) -> bool {
        self.left <= other.right
            && other.left <= self.right
            && self.top <= other.bottom
            && other.top <= self.bottom
    }
}

/// Draws labelled points; each label stands where it covers least near its point. No label covers
/// the points of the page in `keep_clear` if there is any other place.
pub(super) fn annotations(
    page: &Page<'_>,
    frame: &Frame<'_>,
    (curves, annotations): (&[Curve], &[Annotation]),
    keep_clear: &[(i32, i32)],
    fonts: &Fonts,
) -> Result<(), Drawing> {
    let (x, y) = frame.window();
    let shown = |at: (f64, f64)| (x.0..=x.1).contains(&at.0) && (y.0..=y.1).contains(&at.1);
    let notes: Vec<_> = annotations
        .iter()
        .filter(|note| shown(note.at))
        .map(|note| (note.label.as_str(), frame.at(note.at)))
        .collect();
    let along = along_curves(frame, curves);
    let points: Vec<_> = notes.iter().map(|note| note.1).collect();
    let mut placed: Vec<Space> = Vec::new();
    for (label, at) in notes {
        let width = fonts.width(&text::parse(label, Shape::Upright), NOTE_LETTERS);
        let cost = |space: &Space| {
            let covered = along.iter().filter(|&&point| space.holds(point)).count();
            // Nearer to another point, the label would seem to be that point's.
            let astray = points
                .iter()
                .any(|&other| space.distance(other) < space.distance(at));
            let over = points
                .iter()
                .chain(keep_clear)
                .filter(|&&other| space.holds(other))
                .count()
                + placed.iter().filter(|other| space.meets(other)).count();
            let crossed = along
                .iter()
                .filter(|&&point| crosses(point, at, space.nearest(at)))
                .count();
            covered
                + 3 * crossed
                + 60 * usize::from(astray)
                + 1_000 * over
                + 10_000 * frame.outside(space)
        };
        let Some(space) = around(at, units(width)).into_iter().min_by_key(cost) else {
            continue;
        };
        let nearest = space.nearest(at);
        if space.distance(at) > i64::from(units(12.0)).pow(2) {
            for style in [
                WHITE.stroke_width(stroke(2.4)),
                AXIS.stroke_width(stroke(0.9)),
            ] {
                page.draw(&PathElement::new(vec![at, nearest], style))?;
            }
        }
        let corners = [(space.left, space.top), (space.right, space.bottom)];
        page.draw(&Rectangle::new(corners, WHITE.mix(0.82).filled()))?;
        let middle = (space.left + units(3.0), (space.top + space.bottom) / 2);
        write(page, label, middle, NOTE_LETTERS, FontStyle::Normal)?;
        placed.push(space);
    }
    for (style, radius) in [(WHITE.filled(), 4.6), (INK.filled(), 3.4)] {
        for &at in &points {
            page.draw(&Circle::new(at, units(radius), style))?;
        }
    }
    Ok(())
}

/// Whether a point of a curve lies on the line from an annotated point to its label, away from the annotated point.
fn crosses(point: (i32, i32), from: (i32, i32), to: (i32, i32)) -> bool {
    let along = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let away = (f64::from(point.0 - from.0), f64::from(point.1 - from.1));
    let length = along.0.hypot(along.1);
    if length < f64::from(units(12.0)) {
        return false;
    }
    let forward = (along.0 * away.0 + along.1 * away.1) / length;
    let aside = (along.0 * away.1 - along.1 * away.0).abs() / length;
    (f64::from(units(6.0))..length).contains(&forward) && aside < f64::from(units(3.0))
}

/// Distances of a label from its point in pixels.
const DISTANCES: [f64; 6] = [7.0, 20.0, 38.0, 60.0, 90.0, 130.0];

/// The places for a label of a width about a point, the nearest first.
fn around((x, y): (i32, i32), width: i32) -> Vec<Space> {
    let (width, height) = (width + units(6.0), units(NOTE_LETTERS + 6.0));
    let beside = |distance: i32, length: i32| [distance, -distance - length];
    let mut spaces = Vec::new();
    for (index, aside) in DISTANCES.map(units).into_iter().enumerate() {
        for (other, above) in DISTANCES.map(units).into_iter().enumerate() {
            for left in beside(aside, width) {
                // Above first.
                let tops = beside(above, height).into_iter().rev();
                spaces.extend(tops.map(|top| (2 * (index + other), left, top)));
            }
        }
        // A little after the places at a corner that are as near.
        spaces.extend(beside(aside, width).map(|left| (4 * index + 1, left, -height / 2)));
        spaces.extend(beside(aside, height).map(|top| (4 * index + 1, -width / 2, top)));
    }
    spaces.sort_by_key(|(far, ..)| *far);
    spaces
        .into_iter()
        .map(|(_, left, top)| Space {
            left: x + left,
            top: y + top,
            right: x + left + width,
            bottom: y + top + height,
        })
        .collect()
}

/// Points every few pixels along the curves on the page.
pub(super) fn along_curves(frame: &Frame<'_>, curves: &[Curve]) -> Vec<(i32, i32)> {
    let (x, y) = frame.window();
    let mut points = Vec::new();
    for part in curves
        .iter()
        .flat_map(|curve| curve::visible_parts(&curve.points, x, y))
    {
        let part: Vec<_> = part.into_iter().map(|point| frame.at(point)).collect();
        for (from, to) in part.iter().zip(part.iter().skip(1)) {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let steps = (dx.abs().max(dy.abs()) / units(4.0)).clamp(1, 1_000);
            points.extend((0..=steps).map(|k| (from.0 + dx * k / steps, from.1 + dy * k / steps)));
        }
    }
    points
}
