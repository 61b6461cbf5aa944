//! SVG text: the one place where numbers are rounded, attributes written and foreign text escaped.

use std::fmt::Write;

use crate::geometry::{Point, Rect};
use crate::label::{self, Level, Run, Shape};

/// Colour of letters.
pub(crate) const INK: &str = "#222222";
/// Colour of axes.
pub(crate) const AXIS: &str = "#555555";
/// Colour of the page.
pub(crate) const WHITE: &str = "#ffffff";

/// Writes a number with at most two decimals: nobody sees a hundredth of a pixel.
pub(crate) fn number(value: f64) -> String {
    // Adding zero turns −0 into 0.
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}

/// Attributes of a line.
pub(crate) fn stroke(colour: &str, width: f64) -> String {
    let width = number(width);
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"")
}

/// Attributes of an area. Nothing is transparent: the conversion to PDF lists transparencies in an order that changes
/// from run to run.
pub(crate) fn fill(colour: &str) -> String {
    format!("fill=\"{colour}\"")
}

/// The data of a `<path>`. Shapes that look alike are put into one path.
#[derive(Debug, Default)]
pub(crate) struct Path(String);

impl Path {
    /// Creates the path of one rectangle.
    pub(crate) fn of_rectangle(rect: &Rect) -> Self {
        let mut path = Self::default();
        path.rectangle(rect);
        path
    }

    /// Appends a line through points.
    pub(crate) fn line(&mut self, points: &[Point]) {
        for (index, &(x, y)) in points.iter().enumerate() {
            let command = if index == 0 { 'M' } else { 'L' };
            self.0
                .push_str(&format!("{command}{} {}", number(x), number(y)));
        }
    }

    /// Appends a polygon.
    pub(crate) fn polygon(&mut self, corners: &[Point]) {
        self.line(corners);
        self.0.push('z');
    }

    /// Appends a rectangle. Its coordinates are absolute, so that neighbours write the edge that they share in the same
    /// digits and no gap opens between them.
    pub(crate) fn rectangle(&mut self, rect: &Rect) {
        let [left, top, right, bottom] = [rect.left, rect.top, rect.right, rect.bottom].map(number);
        self.0
            .push_str(&format!("M{left} {top}H{right}V{bottom}H{left}z"));
    }

    /// Appends a circle.
    pub(crate) fn circle(&mut self, (x, y): Point, radius: f64) {
        let (left, y, r, d) = (
            number(x - radius),
            number(y),
            number(radius),
            number(2.0 * radius),
        );
        self.0.push_str(&format!(
            "M{left} {y}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z"
        ));
    }
}

/// Which point of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text with its place: the anchor, half way up the capitals.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Text<'a> {
    pub(crate) label: &'a str,
    pub(crate) at: Point,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) bold: bool,
    /// Whether the text runs upwards.
    pub(crate) upwards: bool,
}

impl<'a> Text<'a> {
    /// Creates a horizontal text in upright letters.
    pub(crate) fn new(label: &'a str, at: Point, size: f64, anchor: Anchor) -> Self {
        Self {
            label,
            at,
            size,
            anchor,
            bold: false,
            upwards: false,
        }
    }
}

/// Height of half a capital of the embedded font, relative to its size.
const HALF_CAPITAL: f64 = 0.36;

/// The elements of a document so far.
#[derive(Debug, Default)]
pub(crate) struct Svg(String);

impl Svg {
    /// Appends a path, if there is anything in it.
    pub(crate) fn path(&mut self, path: &Path, attributes: &str) {
        if !path.0.is_empty() {
            self.0
                .push_str(&format!("<path {attributes} d=\"{}\"/>\n", path.0));
        }
    }

    /// Appends a horizontal text in upright letters.
    pub(crate) fn write(&mut self, label: &str, at: Point, size: f64, anchor: Anchor) {
        self.text(&Text::new(label, at, size, anchor));
    }

    /// Appends a text, if there is any letter in it.
    pub(crate) fn text(&mut self, text: &Text<'_>) {
        if text.label.is_empty() {
            return;
        }
        let half = HALF_CAPITAL * text.size;
        let (x, y) = text.at;
        let (x, y) = if text.upwards {
            (x + half, y)
        } else {
            (x, y + half)
        };
        let (x, y) = (number(x), number(y));
        self.0.push_str(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\"",
            number(text.size)
        ));
        self.0.push_str(&format!(" fill=\"{INK}\""));
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.0.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.0.push_str(" text-anchor=\"end\""),
        }
        if text.upwards {
            self.0
                .push_str(&format!(" transform=\"rotate(-90 {x} {y})\""));
        }
        self.0.push('>');
        let base = if text.bold {
            Shape::Bold
        } else {
            Shape::Upright
        };
        let mut level = Level::Base;
        for run in label::parse(text.label, base) {
            self.run(&run, level, text.size);
            level = run.level;
        }
        self.0.push_str("</text>\n");
    }

    /// Appends one run; `before` is the level of the run before it. Scripts are moved by `dy` and what follows is moved back,
    /// because not every program knows `baseline-shift`.
    fn run(&mut self, run: &Run, before: Level, size: f64) {
        let mut attributes = String::new();
        if run.level != before {
            let dy = (run.level.drop() - before.drop()) * size;
            attributes.push_str(&format!(" dy=\"{}\"", number(dy)));
        }
        if run.level != Level::Base {
            attributes.push_str(&format!(" font-size=\"{}\"", number(run.level.size(size))));
        }
        match run.shape {
            Shape::Upright => {}
            Shape::Italic => attributes.push_str(" font-style=\"italic\""),
            Shape::Bold => attributes.push_str(" font-weight=\"bold\""),
        }
        let text = escaped(&run.text);
        if attributes.is_empty() {
            self.0.push_str(&text);
        } else {
            self.0
                .push_str(&format!("<tspan{attributes}>{text}</tspan>"));
        }
    }

    /// Writes the document: its size, its title and description for readers who cannot see it, a white ground, and the
    /// elements.
    pub(crate) fn document(
        self,
        (width, height): (f64, f64),
        (title, description): (&str, &str),
    ) -> String {
        let (width, height) = (number(width), number(height));
        let mut svg = String::with_capacity(self.0.len() + 1_000);
        // Writing to a String does not fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" \
             font-family=\"'{}', Verdana, 'Segoe UI', sans-serif\">\n\
             <title>{}</title>\n<desc>{}</desc>\n\
             <path fill=\"{WHITE}\" d=\"M0 0H{width}V{height}H0z\"/>\n{}</svg>\n",
            label::FAMILY,
            escaped(&label::plain(title)),
            escaped(&label::plain(description)),
            self.0
        );
        svg
    }
}

/// Replaces the characters that XML keeps for itself.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            // XML 1.0 has no place for other control characters, nor for these two.
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ if letter.is_control() => escaped.push('\u{fffd}'),
            _ => escaped.push(letter),
        }
    }
    escaped
}
