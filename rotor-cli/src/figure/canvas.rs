//! The back end of the plotting crate that writes SVG: in fractions of a pixel, with subscripts.

use std::fmt::{self, Write};

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontStyle, FontTransform,
};

use super::text::{self, Fonts, Placement, Run, Shape};

/// Canvas units in a pixel. The plotting crate counts in whole units, which would make curves ragged if they were pixels.
const UNITS_PER_PIXEL: f64 = 32.0;

/// Canvas units of a length in pixels.
pub(super) fn units(pixels: f64) -> i32 {
    // `as` saturates; lengths on a page are far from that.
    (pixels * UNITS_PER_PIXEL).round() as i32
}

/// Pixels of a length in canvas units.
pub(super) fn pixels(units: i32) -> f64 {
    f64::from(units) / UNITS_PER_PIXEL
}

/// Width of a stroke in canvas units.
pub(super) fn stroke(pixels: f64) -> u32 {
    units(pixels).unsigned_abs()
}

/// What letters become.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lettering {
    /// `<text>`, which can be searched and copied.
    Live,
    /// Outlines of the embedded fonts, which look the same everywhere.
    Outlined,
}

/// Writes the body of an SVG document.
pub(super) struct Canvas<'a> {
    body: &'a mut String,
    fonts: &'a Fonts,
    lettering: Lettering,
    size: (u32, u32),
    /// Attributes of the path that is being written. Shapes of the same attributes go on in the same path, which
    /// makes dashes and the cells of a map an order of magnitude shorter.
    open_path: Option<String>,
}

impl<'a> Canvas<'a> {
    /// A canvas of `width` × `height` canvas units that appends to `body`.
    pub(super) fn new(
        body: &'a mut String,
        fonts: &'a Fonts,
        lettering: Lettering,
        (width, height): (i32, i32),
    ) -> Self {
        let size = (width.unsigned_abs(), height.unsigned_abs());
        Self {
            body,
            fonts,
            lettering,
            size,
            open_path: None,
        }
    }

    /// Ends the path that is being written.
    fn close_path(&mut self) {
        if self.open_path.take().is_some() {
            self.body.push_str("\"/>\n");
        }
    }

    /// Goes on with the path of these attributes, or starts one.
    fn path_with(&mut self, attributes: String) {
        if self.open_path.as_ref() == Some(&attributes) {
            return;
        }
        self.close_path();
        self.body.push_str("<path");
        self.body.push_str(&attributes);
        self.body.push_str(" d=\"");
        self.open_path = Some(attributes);
    }

    /// A text as an element.
    fn lettered(&mut self, runs: &[Run], place: Placement, fill: &str) -> fmt::Result {
        if self.lettering == Lettering::Live {
            return text::element(self.body, runs, place, fill);
        }
        write!(self.body, "<path{fill}")?;
        if place.turn != 0 {
            let (x, y) = place.at;
            write!(
                self.body,
                " transform=\"rotate({} {x:.2} {y:.2})\"",
                place.turn
            )?;
        }
        self.body.push_str(" d=\"");
        self.fonts.outline(self.body, runs, place)?;
        self.body.write_str("\"/>\n")
    }

    /// Path data through points.
    fn points(&mut self, points: impl IntoIterator<Item = BackendCoord>) -> fmt::Result {
        for (index, (x, y)) in points.into_iter().enumerate() {
            let command = if index == 0 { 'M' } else { 'L' };
            write!(self.body, "{command}{:.2} {:.2}", pixels(x), pixels(y))?;
        }
        Ok(())
    }
}

/// Attribute of a colour: `name` is `fill` or `stroke`.
fn colour(name: &str, colour: BackendColor) -> String {
    let (red, green, blue) = colour.rgb;
    let mut attribute = format!(" {name}=\"#{red:02x}{green:02x}{blue:02x}\"");
    if colour.alpha < 1.0 {
        attribute.push_str(&format!(" {name}-opacity=\"{:.2}\"", colour.alpha));
    }
    attribute
}

/// Attributes of a line.
fn line_attributes<S: BackendStyle>(style: &S) -> String {
    let width = f64::from(style.stroke_width()) / UNITS_PER_PIXEL;
    format!(
        " fill=\"none\"{} stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"",
        colour("stroke", style.color())
    )
}

/// Runs of a text in the style's shape.
fn runs<T: BackendTextStyle>(text: &str, style: &T) -> Vec<Run> {
    let base = if matches!(style.style(), FontStyle::Bold) {
        Shape::Bold
    } else {
        Shape::Upright
    };
    text::parse(text, base)
}

/// Place of a text on its baseline.
fn placement<T: BackendTextStyle>(style: &T, at: BackendCoord) -> Placement {
    let size = style.size() / UNITS_PER_PIXEL;
    let turn = match style.transform() {
        FontTransform::None => 0,
        FontTransform::Rotate90 => 90,
        FontTransform::Rotate180 => 180,
        FontTransform::Rotate270 => 270,
    };
    let before = match style.anchor().h_pos {
        HPos::Left => 0.0,
        HPos::Center => 0.5,
        HPos::Right => 1.0,
    };
    // Heights of DejaVu Sans: capitals 0.73, with their accents 0.76 and what hangs below the baseline 0.24.
    let below = size
        * match style.anchor().v_pos {
            VPos::Top => 0.76,
            VPos::Center => 0.36,
            VPos::Bottom => -0.24,
        };
    let shift = match turn {
        0 => (0.0, below),
        90 => (-below, 0.0),
        180 => (0.0, -below),
        _ => (below, 0.0),
    };
    Placement {
        at: (pixels(at.0) + shift.0, pixels(at.1) + shift.1),
        before,
        turn,
        size,
    }
}

impl DrawingBackend for Canvas<'_> {
    type ErrorType = fmt::Error;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<fmt::Error>> {
        Ok(())
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.close_path();
        Ok(())
    }

    fn draw_pixel(
        &mut self,
        at: BackendCoord,
        colour: BackendColor,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &colour, true)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        // Neighbouring cells of a map would show their seams if their edges were smoothed.
        self.path_with(if fill {
            format!(
                "{} shape-rendering=\"crispEdges\"",
                colour("fill", style.color())
            )
        } else {
            line_attributes(style)
        });
        // Absolute coordinates: neighbours write the edge that they share in the same digits, and no
        // gap opens between them.
        let ((x, y), (right, bottom)) = (upper_left, bottom_right);
        let (x, y, right, bottom) = (pixels(x), pixels(y), pixels(right), pixels(bottom));
        write!(self.body, "M{x:.2} {y:.2}H{right:.2}V{bottom:.2}H{x:.2}z")
            .map_err(DrawingErrorKind::DrawingError)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.path_with(line_attributes(style));
        self.points(path).map_err(DrawingErrorKind::DrawingError)
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.path_with(if fill {
            colour("fill", style.color())
        } else {
            line_attributes(style)
        });
        let radius = f64::from(radius) / UNITS_PER_PIXEL;
        let diameter = 2.0 * radius;
        write!(
            self.body,
            "M{:.2} {:.2}a{radius:.2} {radius:.2} 0 1 0 {diameter:.2} 0a{radius:.2} {radius:.2} 0 1 0 -{diameter:.2} 0z",
            pixels(x) - radius,
            pixels(y)
        )
        .map_err(DrawingErrorKind::DrawingError)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vertices: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.path_with(colour("fill", style.color()));
        self.points(vertices)
            .map_err(DrawingErrorKind::DrawingError)?;
        self.body.push('z');
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &T,
        at: BackendCoord,
    ) -> Result<(), DrawingErrorKind<fmt::Error>> {
        self.close_path();
        self.lettered(
            &runs(text, style),
            placement(style, at),
            &colour("fill", style.color()),
        )
        .map_err(DrawingErrorKind::DrawingError)
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<fmt::Error>> {
        let size = style.size() / UNITS_PER_PIXEL;
        Ok((
            stroke(self.fonts.width(&runs(text, style), size)),
            stroke(size),
        ))
    }
}
