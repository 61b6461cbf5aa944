//! The page: plots side by side, the caption below, the document around them, and its pixels.

use std::fmt::Write;

use plotters::prelude::*;

use super::canvas::{Canvas, Lettering, units};
use super::frame::{self, Layout};
use super::panel::{self, Drawing, Legend, Page};
use super::text::{self, Fonts, Shape};
use super::ticks::Ends;
use super::{Figure, FigureError, Map, Panel, Plot, map};

/// Width of a page with one plot, and with two, in pixels.
const WIDTHS: (f64, f64) = (640.0, 900.0);
/// Height of a plot without its legend in pixels.
const HEIGHT: f64 = 330.0;
/// Height of a map without its legend in pixels.
const MAP_HEIGHT: f64 = 400.0;
/// Width and height of a small map without its legend in pixels, and how many stand side by side.
const SMALL_MAP: ((f64, f64), usize) = ((420.0, 300.0), 3);
/// Space about the page, and on the right of a frame, where the last tick's label reaches out.
const SPACE: (f64, f64) = (8.0, 18.0);
/// Size of the caption's letters and the distance of its lines in pixels.
const CAPTION: (f64, f64) = (12.0, 17.0);
/// Pixels of the PNG per pixel of the SVG.
const MAGNIFICATION: f32 = 2.0;

/// Draws a figure as an SVG document.
pub(super) fn draw(figure: &Figure, lettering: Lettering) -> Result<String, FigureError> {
    let fonts = Fonts::embedded()?;
    let (layouts, width) = match &figure.plot {
        Plot::Panels(panels) => panel_layouts(figure, panels, &fonts)?,
        Plot::Map(map) => {
            let place = ((SPACE.0, SPACE.0), (WIDTHS.0 - 2.0 * SPACE.0, MAP_HEIGHT));
            (vec![map::layout(figure, map, &fonts, place)?], WIDTHS.0)
        }
        Plot::Maps(maps) => map_layouts(figure, maps, &fonts)?,
    };
    let bottom = layouts
        .iter()
        .map(|layout| layout.at.1 + layout.size.1)
        .fold(0.0, f64::max);
    let lines = wrap(&figure.caption, &fonts, width - 2.0 * SPACE.1);
    let height = bottom + 10.0 + CAPTION.1 * lines.len() as f64 + SPACE.0;
    let mut body = String::new();
    let canvas = Canvas::new(&mut body, &fonts, lettering, (units(width), units(height)));
    let page = canvas.into_drawing_area();
    contents(&page, figure, &layouts, &fonts, (&lines, bottom + 10.0)).map_err(|error| {
        FigureError::Draw {
            figure: figure.name.clone(),
            message: error.to_string(),
        }
    })?;
    drop(page);
    Ok(document(figure, &body, (width, height)))
}

/// Draws everything on the page.
fn contents(
    page: &Page<'_>,
    figure: &Figure,
    layouts: &[Layout],
    fonts: &Fonts,
    (lines, top): (&[String], f64),
) -> Result<(), Drawing> {
    page.fill(&WHITE)?;
    match &figure.plot {
        Plot::Panels(panels) => {
            for (panel, layout) in panels.iter().zip(layouts) {
                panel::draw(page, panel, layout, fonts)?;
            }
        }
        Plot::Map(map) => {
            for layout in layouts {
                map::draw(page, map, layout, fonts)?;
            }
        }
        Plot::Maps(maps) => {
            for (map, layout) in maps.iter().zip(layouts) {
                map::draw(page, map, layout, fonts)?;
            }
        }
    }
    for (index, line) in lines.iter().enumerate() {
        let at = (
            units(SPACE.1),
            units(top + CAPTION.1 * (index as f64 + 0.5)),
        );
        frame::write(page, line, at, CAPTION.0, FontStyle::Normal)?;
    }
    page.present()
}

/// Places panels side by side, with their frames at one height.
fn panel_layouts(
    figure: &Figure,
    panels: &[Panel],
    fonts: &Fonts,
) -> Result<(Vec<Layout>, f64), FigureError> {
    let width = if panels.len() == 1 {
        WIDTHS.0
    } else {
        WIDTHS.1
    };
    let place = (width - 2.0 * SPACE.0) / panels.len() as f64;
    let mut layouts = Vec::new();
    let mut legend = 0.0_f64;
    for (index, panel) in panels.iter().enumerate() {
        let points = || panel.curves.iter().flat_map(|curve| &curve.points);
        let notes = || panel.annotations.iter().map(|note| note.at);
        let of_x = points()
            .filter(|point| point.1.is_some())
            .map(|point| point.0);
        let of_y = points().filter_map(|point| point.1);
        let (of_x, of_y) = (
            of_x.chain(notes().map(|at| at.0)),
            of_y.chain(notes().map(|at| at.1)),
        );
        let x = frame::scale(figure, &panel.title, &panel.x, of_x, (Ends::Kept, 6.0))?;
        let y = frame::scale(figure, &panel.title, &panel.y, of_y, (Ends::Rounded, 6.0))?;
        let left = Layout::beside(&y, fonts);
        let at = (SPACE.0 + place * index as f64, SPACE.0);
        let layout = Layout {
            at,
            size: (place, HEIGHT),
            margin: (0.0, SPACE.1),
            x,
            y,
            left,
        };
        let rows = Legend::new(&panel.title, &panel.curves, fonts, layout.frame_width());
        legend = legend.max(rows.height());
        layouts.push(layout);
    }
    for layout in &mut layouts {
        layout.margin.0 = legend + 6.0;
        layout.size.1 = HEIGHT + legend;
    }
    Ok((layouts, width))
}

/// Places small maps in rows, those of a row with their frames at one height.
fn map_layouts(
    figure: &Figure,
    maps: &[Map],
    fonts: &Fonts,
) -> Result<(Vec<Layout>, f64), FigureError> {
    let (size, most) = SMALL_MAP;
    let columns = maps.len().clamp(1, most);
    let mut layouts = Vec::new();
    let mut top = SPACE.0;
    for row in maps.chunks(columns) {
        let first = layouts.len();
        for (column, map) in row.iter().enumerate() {
            let at = (SPACE.0 + size.0 * column as f64, top);
            layouts.push(map::layout(figure, map, fonts, (at, size))?);
        }
        let in_row = layouts.get_mut(first..).unwrap_or_default();
        let legend = in_row
            .iter()
            .map(|layout| layout.margin.0)
            .fold(0.0, f64::max);
        for layout in in_row {
            layout.size.1 += legend - layout.margin.0;
            layout.margin.0 = legend;
            top = top.max(layout.at.1 + layout.size.1);
        }
    }
    let width = (size.0 * columns as f64 + 2.0 * SPACE.0).max(WIDTHS.0);
    Ok((layouts, width))
}

/// Breaks a text into lines of a width in pixels, at its spaces but not at those about an `=`.
fn wrap(caption: &str, fonts: &Fonts, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let caption = caption.replace(" = ", "\u{a0}=\u{a0}");
    for word in caption
        .split([' ', '\n', '\t'])
        .filter(|word| !word.is_empty())
    {
        let fits = |line: &String| {
            let longer = text::parse(&format!("{line} {word}"), Shape::Upright);
            fonts.width(&longer, CAPTION.0) <= width
        };
        match lines.last_mut() {
            Some(line) if fits(line) => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The SVG document about a body.
fn document(figure: &Figure, body: &str, (width, height): (f64, f64)) -> String {
    let mut svg = String::with_capacity(body.len() + 1_000);
    // Writing to a String does not fail.
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" \
         font-family=\"'DejaVu Sans', Verdana, 'Segoe UI', sans-serif\" aria-label=\""
    );
    text::escape(&mut svg, &text::plain(&figure.caption));
    svg.push_str("\">\n");
    svg.push_str(body);
    svg.push_str("</svg>\n");
    svg
}

/// Turns an SVG document with outlined letters into a PNG image.
pub(super) fn rasterise(figure: &Figure, svg: &str) -> Result<Vec<u8>, FigureError> {
    let failed = |message: String| FigureError::Raster {
        figure: figure.name.clone(),
        message,
    };
    let tree = resvg::usvg::Tree::from_str(svg, &resvg::usvg::Options::default())
        .map_err(|error| failed(error.to_string()))?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(MAGNIFICATION)
        .ok_or_else(|| failed("the image has no size".to_owned()))?;
    let mut pixels = resvg::tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| failed("the image is too large".to_owned()))?;
    let magnified = resvg::tiny_skia::Transform::from_scale(MAGNIFICATION, MAGNIFICATION);
    resvg::render(&tree, magnified, &mut pixels.as_mut());
    pixels
        .encode_png()
        .map_err(|error| failed(error.to_string()))
}
