//! One pair of axes: their scales, the space that their labels need, and all that is drawn inside.

use crate::annotate::{self, Around};
use crate::figure::{Annotation, Axis, Curve, Map, Panel};
use crate::geometry::{Point, Rect, distance, visible_parts};
use crate::heat::{self, Heat};
use crate::label::Fonts;
use crate::legend::Legend;
use crate::scale::{Ends, Scale};
use crate::svg::{AXIS, Anchor, Path, Svg, Text, WHITE, fill, stroke};
use crate::{PlotErrorKind, Ticks, marks};

/// Size of the letters at ticks in pixels.
pub(crate) const TICK_LETTERS: f64 = 11.5;
/// Size of the letters of axis labels and notes in pixels.
pub(crate) const AXIS_LETTERS: f64 = 13.0;
/// Length of a tick in pixels; its label stands twice as far from the axis.
pub(crate) const TICK: f64 = 4.0;
/// Space below a frame in pixels, for ticks and their labels and the label of the axis.
pub(crate) const BELOW: f64 = 2.0 * TICK + TICK_LETTERS + AXIS_LETTERS + 12.0;
/// Colour of the grid.
const GRID: &str = "#e6e6e6";
/// Most steps between the ticks of an axis.
const STEPS: f64 = 6.0;
/// Least space between the labels of two ticks in pixels.
const APART: f64 = 9.0;
/// Least space on the right of a frame in pixels.
const RIGHT: f64 = 18.0;

/// The first and the last value of an axis.
type Span = (f64, f64);

/// What is drawn between a pair of axes: a panel, or a map.
pub(crate) struct Content<'a> {
    title: &'a str,
    x: &'a Axis,
    y: &'a Axis,
    curves: &'a [Curve],
    annotations: &'a [Annotation],
    note: &'a str,
    map: Option<&'a Map>,
}

impl<'a> From<&'a Panel> for Content<'a> {
    fn from(panel: &'a Panel) -> Self {
        Self {
            title: &panel.title,
            x: &panel.x,
            y: &panel.y,
            curves: &panel.curves,
            annotations: &panel.annotations,
            note: &panel.note,
            map: None,
        }
    }
}

impl<'a> From<&'a Map> for Content<'a> {
    fn from(map: &'a Map) -> Self {
        Self {
            title: &map.title,
            x: &map.x,
            y: &map.y,
            curves: &map.curves,
            annotations: &map.annotations,
            note: &map.note,
            map: Some(map),
        }
    }
}

/// A pair of axes and what is drawn between them.
pub(crate) struct Axes<'a> {
    content: Content<'a>,
    x: Scale,
    y: Scale,
    /// The scale of the colours, for a map that has a value anywhere.
    colours: Option<Scale>,
    /// Space on the left and on the right of the frame in pixels.
    pub(crate) beside: (f64, f64),
    /// The title and the samples of the curves.
    pub(crate) legend: Legend,
}

impl<'a> Axes<'a> {
    /// Lays out a plot in a width that is given in pixels.
    pub(crate) fn new(
        content: Content<'a>,
        fonts: &Fonts,
        width: f64,
    ) -> Result<Self, PlotErrorKind> {
        let Content { title, curves, .. } = content;
        let (x, y) = content.ranges()?;
        let ends = match (content.map, content.y.range) {
            (None, None) => Ends::Rounded,
            _ => Ends::Kept,
        };
        let y = Scale::new(y.0, y.1, content.y.ticks, ends, STEPS);
        let colours = content.map.and_then(heat::scale);
        let bar = |scale| heat::BAR.0 + heat::BAR.1 + width_beside(scale, fonts);
        let right = colours.as_ref().map_or(RIGHT, bar);
        let (x, beside) = fitted(x, content.x, (width_beside(&y, fonts), right), width, fonts);
        let legend = Legend::new(title, curves, fonts, width - beside.0 - beside.1);
        Ok(Self {
            content,
            x,
            y,
            colours,
            beside,
            legend,
        })
    }

    /// Draws everything inside a frame, and the axes around it.
    pub(crate) fn draw(&self, svg: &mut Svg, frame: &Rect, fonts: &Fonts) {
        let curves = self.content.curves.iter();
        let on_page: Vec<_> = curves
            .clone()
            .map(|curve| self.on_page(curve, frame))
            .collect();
        let along = along(&on_page, frame);
        let notes = self.notes(frame);
        let mut labels = Vec::new();
        if let Some(map) = self.content.map {
            let notes = notes.iter().map(|note| note.1);
            let clear: Vec<_> = along.iter().copied().chain(notes).collect();
            labels = Heat {
                map,
                axes: self,
                frame,
                fonts,
            }
            .draw(svg, self.colours.as_ref(), &clear);
        } else {
            self.grid(svg, frame);
        }
        self.ticks(svg, frame);
        for (curve, points) in curves.zip(&on_page) {
            marks::draw(svg, curve, points, frame, self.content.map.is_some());
        }
        svg.path(&Path::of_rectangle(frame), &stroke(AXIS, 1.0));
        let around = Around {
            frame,
            curves: &along,
            labels: &labels,
        };
        annotate::draw(svg, &notes, &around, fonts);
        self.note(svg, frame, fonts);
        self.legend.draw(svg, (frame.left, frame.top));
    }

    /// Writes the note in the middle of a frame, clear of hatching.
    fn note(&self, svg: &mut Svg, frame: &Rect, fonts: &Fonts) {
        let note = self.content.note;
        if !note.is_empty() {
            let size = (fonts.width(note, AXIS_LETTERS) + 12.0, AXIS_LETTERS + 10.0);
            let ground = Rect::around(frame.centre(), size);
            svg.path(&Path::of_rectangle(&ground), &fill(WHITE));
            svg.write(note, frame.centre(), AXIS_LETTERS, Anchor::Middle);
        }
    }

    /// Where a point of the plot lies on the page.
    pub(crate) fn at(&self, (x, y): Point, frame: &Rect) -> Point {
        (
            frame.left + self.x.share(x) * (frame.right - frame.left),
            frame.bottom - self.y.share(y) * (frame.bottom - frame.top),
        )
    }

    /// The ranges of the axes; `top` is the lower end of the vertical one.
    pub(crate) fn window(&self) -> Rect {
        Rect::new(self.x.low, self.y.low, self.x.high, self.y.high)
    }

    /// The points of a curve on the page.
    fn on_page(&self, curve: &Curve, frame: &Rect) -> Vec<(f64, Option<f64>)> {
        let place = |&(x, y): &(f64, Option<f64>)| {
            let (at, height) = self.at((x, y.unwrap_or(0.0)), frame);
            (at, y.map(|_| height))
        };
        curve.points.iter().map(place).collect()
    }

    /// The annotations inside the ranges, and where their points lie on the page.
    fn notes(&self, frame: &Rect) -> Vec<(&str, Point)> {
        let window = self.window();
        let shown = self
            .content
            .annotations
            .iter()
            .filter(|note| window.holds(note.at));
        shown
            .map(|note| (note.label.as_str(), self.at(note.at, frame)))
            .collect()
    }

    /// Draws the grid.
    fn grid(&self, svg: &mut Svg, frame: &Rect) {
        let mut grid = Path::default();
        for &tick in &self.x.ticks {
            let (x, _) = self.at((tick, self.y.low), frame);
            grid.line(&[(x, frame.top), (x, frame.bottom)]);
        }
        for &tick in &self.y.ticks {
            let (_, y) = self.at((self.x.low, tick), frame);
            grid.line(&[(frame.left, y), (frame.right, y)]);
        }
        svg.path(&grid, &stroke(GRID, 1.0));
    }

    /// Draws ticks with their labels, and the labels of the axes.
    fn ticks(&self, svg: &mut Svg, frame: &Rect) {
        let mut ticks = Path::default();
        let below = frame.bottom + 2.0 * TICK + 0.5 * TICK_LETTERS;
        for &tick in &self.x.ticks {
            let (x, _) = self.at((tick, self.y.low), frame);
            ticks.line(&[(x, frame.bottom), (x, frame.bottom + TICK)]);
            svg.write(
                &self.x.write(tick),
                (x, below),
                TICK_LETTERS,
                Anchor::Middle,
            );
        }
        for &tick in &self.y.ticks {
            let (_, y) = self.at((self.x.low, tick), frame);
            ticks.line(&[(frame.left - TICK, y), (frame.left, y)]);
            let at = (frame.left - 2.0 * TICK, y);
            svg.write(&self.y.write(tick), at, TICK_LETTERS, Anchor::End);
        }
        svg.path(&ticks, &stroke(AXIS, 1.0));
        let (x, y) = frame.centre();
        let at = (x, frame.bottom + BELOW - 6.0 - 0.5 * AXIS_LETTERS);
        svg.write(&self.content.x.label, at, AXIS_LETTERS, Anchor::Middle);
        let at = (frame.left - self.beside.0 + 0.5 * AXIS_LETTERS + 2.0, y);
        let label = Text::new(&self.content.y.label, at, AXIS_LETTERS, Anchor::Middle);
        svg.text(&Text {
            upwards: true,
            ..label
        });
    }
}

impl Content<'_> {
    /// The ranges of the axes.
    fn ranges(&self) -> Result<(Span, Span), PlotErrorKind> {
        if let Some(map) = self.map {
            let of = |axis, values: &[f64]| range("", axis, values.iter().copied());
            return Ok((of(self.x, &map.x_values)?, of(self.y, &map.y_values)?));
        }
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        let points = points.filter_map(|&(x, y)| y.map(|y| (x, y)));
        let points = points.chain(self.annotations.iter().map(|note| note.at));
        let x = range(self.title, self.x, points.clone().map(|point| point.0))?;
        Ok((x, range(self.title, self.y, points.map(|point| point.1))?))
    }
}

/// Space that a vertical axis needs on its side of a frame in pixels.
fn width_beside(scale: &Scale, fonts: &Fonts) -> f64 {
    let widths = scale
        .ticks
        .iter()
        .map(|&tick| fonts.width(&scale.write(tick), TICK_LETTERS));
    widths.fold(0.0, f64::max) + 2.0 * TICK + AXIS_LETTERS + 10.0
}

/// The scale of a horizontal axis with as many ticks as have room for their labels, and the spaces beside the frame,
/// widened where the first or the last label reaches out.
fn fitted(
    (low, high): (f64, f64),
    axis: &Axis,
    (mut left, mut right): (f64, f64),
    width: f64,
    fonts: &Fonts,
) -> (Scale, (f64, f64)) {
    let inside = width - left - right;
    let new = |steps| Scale::new(low, high, axis.ticks, Ends::Kept, steps);
    let place = |scale: &Scale, tick: f64| {
        let half = 0.5 * fonts.width(&scale.write(tick), TICK_LETTERS);
        (inside * scale.share(tick), half)
    };
    let mut steps = STEPS;
    loop {
        let scale = new(steps);
        let labels: Vec<_> = scale
            .ticks
            .iter()
            .map(|&tick| place(&scale, tick))
            .collect();
        let apart = |pair: &[(f64, f64)]| matches!(pair, [a, b] if b.0 - a.0 >= a.1 + b.1 + APART);
        // One tick alone does not tell the scale.
        steps -= 1.0;
        if labels.windows(2).all(apart) || steps < 1.0 || new(steps).ticks.len() < 2 {
            left = labels
                .first()
                .map_or(left, |(at, half)| left.max(half - at));
            right = labels
                .last()
                .map_or(right, |(at, half)| right.max(half - (inside - at)));
            return (scale, (left, right));
        }
    }
}

/// The range of an axis: the one that is given, or that of the data.
fn range(
    panel: &str,
    axis: &Axis,
    data: impl Iterator<Item = f64>,
) -> Result<(f64, f64), PlotErrorKind> {
    let label = || axis.label.clone();
    let (low, high) = match axis.range {
        Some((low, high)) if low < high => (low, high),
        Some((low, high)) => {
            return Err(PlotErrorKind::Range {
                axis: label(),
                low,
                high,
            });
        }
        None => {
            let wider = |range: Option<(f64, f64)>, value: f64| {
                let (low, high) = range.unwrap_or((value, value));
                Some((low.min(value), high.max(value)))
            };
            data.fold(None, wider).ok_or_else(|| PlotErrorKind::Empty {
                panel: panel.to_owned(),
                axis: label(),
            })?
        }
    };
    if !(high - low).is_finite() {
        return Err(PlotErrorKind::Range {
            axis: label(),
            low,
            high,
        });
    }
    if axis.ticks == Ticks::Logarithmic && low <= 0.0 {
        return Err(PlotErrorKind::Logarithm { axis: label(), low });
    }
    // A single value is in the middle of its axis.
    let around = match high - low {
        span if span > 1e-300 => 0.0,
        _ if low == 0.0 => 0.1,
        _ => (0.1 * low.abs()).max(1e-300),
    };
    // A logarithmic axis stays above zero.
    let least = if low - around > 0.0 || axis.ticks != Ticks::Logarithmic {
        low - around
    } else {
        low
    };
    Ok((least, high + around))
}

/// Points every few pixels along the curves on the page.
fn along(curves: &[Vec<(f64, Option<f64>)>], frame: &Rect) -> Vec<Point> {
    let mut points = Vec::new();
    for part in curves.iter().flat_map(|curve| visible_parts(curve, frame)) {
        for (&from, &to) in part.iter().zip(part.iter().skip(1)) {
            let steps = (distance(from, to) / 4.0).ceil().max(1.0);
            let at = |k: i32| f64::from(k) / steps;
            let point = |t: f64| (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1));
            points.extend((0..=steps as i32).map(at).map(point));
        }
    }
    points
}
