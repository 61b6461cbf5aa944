//! The legend: the title of a plot and a sample of each curve, above the frame, so that they never cover a curve.

use crate::figure::{Curve, Mark};
use crate::geometry::Point;
use crate::label::{self, Fonts, Shape};
use crate::marks;
use crate::svg::{Anchor, Svg, Text};

/// Height of a row in pixels.
const ROW: f64 = 19.0;
/// Size of the letters in pixels.
const LETTERS: f64 = 12.0;
/// Space after a sample and after an entry in pixels.
const SPACE: (f64, f64) = (6.0, 16.0);

/// A title or a curve.
#[derive(Debug)]
struct Entry<'a> {
    label: &'a str,
    look: Option<(Mark, usize)>,
    row: usize,
    /// Distance from the left edge of the frame in pixels.
    x: f64,
}

/// The title and the curves of a plot in rows.
#[derive(Debug)]
pub(crate) struct Legend<'a>(Vec<Entry<'a>>);

impl<'a> Legend<'a> {
    /// Flows the title and the curves into rows of a width in pixels; curves that look alike are one entry.
    pub(crate) fn new(title: &'a str, curves: &'a [Curve], fonts: &Fonts, width: f64) -> Self {
        let looks = curves
            .iter()
            .map(|curve| (curve.label.as_str(), Some((curve.mark, curve.colour))));
        let title_width = fonts.width_of(&label::parse(title, Shape::Bold), LETTERS);
        // Further rows begin below the first curve, not below the title.
        let indent = if title.is_empty() {
            0.0
        } else {
            title_width + SPACE.1
        };
        let mut entries: Vec<Entry<'a>> = Vec::new();
        let (mut row, mut x) = (0, 0.0);
        for (label, look) in std::iter::once((title, None)).chain(looks) {
            let known = entries
                .iter()
                .any(|entry| (entry.label, entry.look) == (label, look));
            if label.is_empty() || known {
                continue;
            }
            let needed = look.map_or(title_width, |look| {
                marks::sample_width(look.0) + SPACE.0 + fonts.width(label, LETTERS)
            });
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
        }
        Self(entries)
    }

    /// Height in pixels.
    pub(crate) fn height(&self) -> f64 {
        self.0
            .last()
            .map_or(0.0, |last| ROW * (last.row as f64 + 1.0))
    }

    /// Draws the legend above the upper left corner of a frame.
    pub(crate) fn draw(&self, svg: &mut Svg, (left, top): Point) {
        let top = top - self.height() - 3.0;
        for entry in &self.0 {
            let mut at = (left + entry.x, top + ROW * (entry.row as f64 + 0.5));
            if let Some((mark, colour)) = entry.look {
                marks::sample(svg, at, mark, colour);
                at.0 += marks::sample_width(mark) + SPACE.0;
            }
            let text = Text::new(entry.label, at, LETTERS, Anchor::Start);
            svg.text(&Text {
                bold: entry.look.is_none(),
                ..text
            });
        }
    }
}
