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

/// An entry of the legend: the title or a curve.
#[derive(Debug)]
struct Entry {
    label: String,
    look: Option<(Mark, usize)>,
    row: usize,
    /// Distance from the left edge of the frame in pixels.
    x: f64,
}

/// The title and the curves of a plot in rows.
#[derive(Debug)]
pub(crate) struct Legend(Vec<Entry>);

impl Legend {
    /// Puts the title and the curves into rows of a width in pixels. Curves with one label and one look share an entry.
    pub(crate) fn new(title: &str, curves: &[Curve], fonts: &Fonts, width: f64) -> Self {
        let bold = |line: &str| fonts.width_of(&label::parse(line, Shape::Bold), LETTERS);
        let titles = label::wrap(title, |line| bold(line) <= width);
        let title_width = titles.last().map_or(0.0, |line| bold(line) + SPACE.1);
        let mut row = titles.len().saturating_sub(1);
        let title_entry = |(row, label)| Entry {
            label,
            look: None,
            row,
            x: 0.0,
        };
        let mut entries: Vec<Entry> = titles.into_iter().enumerate().map(title_entry).collect();
        // Further rows begin below the first curve, if that leaves them room.
        let indent = if title_width < 0.5 * width {
            title_width
        } else {
            0.0
        };
        let mut x = title_width;
        for curve in curves {
            let look = Some((curve.mark, curve.colour));
            let known = entries
                .iter()
                .any(|entry| entry.label == curve.label && entry.look == look);
            if curve.label.is_empty() || known {
                continue;
            }
            let sample = marks::sample_width(curve.mark) + SPACE.0;
            let needed = sample + fonts.width(&curve.label, LETTERS);
            if x > indent && x + needed > width {
                (row, x) = (row + 1, indent);
            }
            entries.push(Entry {
                label: curve.label.clone(),
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
            let text = Text::new(&entry.label, at, LETTERS, Anchor::Start);
            svg.text(&Text {
                bold: entry.look.is_none(),
                ..text
            });
        }
    }
}
