//! A panel: its legend, its axes and its curves.

use std::fmt;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Canvas, pixels, units};
use super::frame::{self, Frame, Layout};
use super::text::{self, Fonts, Shape};
use super::{Curve, Mark, Panel, curve};

/// The page that everything is drawn on, in canvas units from its upper left corner.
pub(super) type Page<'a> = DrawingArea<Canvas<'a>, Shift>;
/// What drawing can fail with: writing text into memory, which does not fail.
pub(super) type Drawing = DrawingAreaErrorKind<fmt::Error>;

/// Height of a row of the legend in pixels.
const ROW: f64 = 19.0;
/// Size of the letters of the legend in pixels.
const LETTERS: f64 = 12.0;
/// Length of a line and of a symbol in the legend in pixels.
const SAMPLE: (f64, f64) = (26.0, 10.0);
/// Space after a sample and after an entry in pixels.
const SPACE: (f64, f64) = (6.0, 16.0);

/// A title or an entry of a legend.
struct Entry<'a> {
    label: &'a str,
    look: Option<(Mark, usize)>,
    row: usize,
    /// Distance from the left edge of the frame in pixels.
    x: f64,
}

/// The legend of a plot: it stands above the frame, so that it never covers a curve.
pub(super) struct Legend<'a> {
    entries: Vec<Entry<'a>>,
}

impl<'a> Legend<'a> {
    /// Flows the title and the entries into rows of a width in pixels.
    pub(super) fn new(title: &'a str, curves: &'a [Curve], fonts: &Fonts, width: f64) -> Self {
        let mut entries: Vec<Entry<'a>> = Vec::new();
        let mut seen: Vec<(&str, (Mark, usize))> = Vec::new();
        let (mut row, mut x) = (0, 0.0);
        // Further rows begin below the first entry, not below the title.
        let indent = if title.is_empty() {
            0.0
        } else {
            fonts.width(&text::parse(title, Shape::Bold), LETTERS) + SPACE.1
        };
        let mut add = |label: &'a str, look: Option<(Mark, usize)>| {
            let shape = if look.is_some() {
                Shape::Upright
            } else {
                Shape::Bold
            };
            let sample = look.map_or(0.0, |look| sample_width(look.0) + SPACE.0);
            let needed = sample + fonts.width(&text::parse(label, shape), LETTERS);
            if x > indent && x + needed > width {
                (row, x) = (row + 1, indent);
            }
            entries.push(Entry {
                label,
                look,
                row,
                x,
            });
            x += needed + SPACE.1;
        };
        if !title.is_empty() {
            add(title, None);
        }
        for curve in curves.iter().filter(|curve| !curve.label.is_empty()) {
            let entry = (curve.label.as_str(), (curve.mark, curve.colour));
            if !seen.contains(&entry) {
                seen.push(entry);
                add(entry.0, Some(entry.1));
            }
        }
        Self { entries }
    }

    /// Height in pixels.
    pub(super) fn height(&self) -> f64 {
        self.entries
            .iter()
            .map(|entry| ROW * (entry.row as f64 + 1.0))
            .fold(0.0, f64::max)
    }

    /// Draws the legend with its lower edge on the upper edge of a frame.
    pub(super) fn draw(&self, page: &Page<'_>, frame: &Frame<'_>) -> Result<(), Drawing> {
        let top = frame.top() - units(self.height() + 3.0);
        for entry in &self.entries {
            let mut at = (
                frame.left() + units(entry.x),
                top + units(ROW * (entry.row as f64 + 0.5)),
            );
            if let Some((mark, colour)) = entry.look {
                let width = sample_width(mark);
                curve::sample(page, at, units(width), mark, curve::colour(colour))?;
                at.0 += units(width + SPACE.0);
            }
            let style = if entry.look.is_some() {
                FontStyle::Normal
            } else {
                FontStyle::Bold
            };
            frame::write(page, entry.label, at, LETTERS, style)?;
        }
        Ok(())
    }
}

/// Width of a mark in the legend in pixels.
fn sample_width(mark: Mark) -> f64 {
    if matches!(mark, Mark::Line(_)) {
        SAMPLE.0
    } else {
        SAMPLE.1
    }
}

/// Draws a panel into a layout.
pub(super) fn draw(
    page: &Page<'_>,
    panel: &Panel,
    layout: &Layout,
    fonts: &Fonts,
) -> Result<(), Drawing> {
    let frame = frame::axes(page, (&panel.x, &panel.y), layout, true)?;
    curves(page, &frame, &panel.curves)?;
    frame.outline(page)?;
    frame::annotations(
        page,
        &frame,
        (&panel.curves, &panel.annotations),
        &[],
        fonts,
    )?;
    frame::note(page, &frame, &panel.note, fonts)?;
    Legend::new(&panel.title, &panel.curves, fonts, pixels(frame.width())).draw(page, &frame)
}

/// Draws curves into a frame.
pub(super) fn curves(page: &Page<'_>, frame: &Frame<'_>, curves: &[Curve]) -> Result<(), Drawing> {
    for curve in curves {
        let (x, y) = frame.window();
        let colour = curve::colour(curve.colour);
        match curve.mark {
            Mark::Line(dash) => {
                for part in curve::visible_parts(&curve.points, x, y) {
                    let points = part.into_iter().map(|point| frame.at(point)).collect();
                    curve::line(page, points, dash, colour)?;
                }
            }
            Mark::Points(symbol) => {
                let points = curve::visible_points(&curve.points, x, y);
                let points: Vec<_> = points.into_iter().map(|point| frame.at(point)).collect();
                curve::symbols(page, &points, symbol, colour)?;
            }
        }
    }
    Ok(())
}
