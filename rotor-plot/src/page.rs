//! The page: plots in rows, the caption below.

use crate::PlotErrorKind;
use crate::axes::{Axes, BELOW};
use crate::figure::{Figure, Plot};
use crate::geometry::Rect;
use crate::label::{self, Fonts};
use crate::svg::{Anchor, Svg, Text};

/// Width of a page with one plot, and with two, in pixels.
const WIDTHS: (f64, f64) = (640.0, 900.0);
/// Height of a panel and of a map with their axes, without their legends, in pixels.
const HEIGHTS: (f64, f64) = (324.0, 392.0);
/// Width and height of a small map without its legend in pixels, and how many stand side by side.
const SMALL_MAP: ((f64, f64), usize) = ((432.0, 292.0), 3);
/// Space between small maps side by side in pixels.
const GUTTER: f64 = 16.0;
/// Space about the page, beside the caption, above a frame or its legend, and above the caption in pixels.
const SPACE: (f64, f64, f64, f64) = (8.0, 18.0, 7.0, 6.0);
/// Size of the caption's letters and the distance of its lines in pixels.
const CAPTION: (f64, f64) = (12.0, 17.0);
/// Greatest height of a page in pixels: as a PNG with two pixels for each it takes 200 MB of memory while it is drawn.
const MOST_HEIGHT: f64 = 10_000.0;

/// Plots of one size in rows.
struct Rows<'a> {
    plots: Vec<Axes<'a>>,
    columns: usize,
    /// Distance from column to column, and height.
    size: (f64, f64),
    plot_width: f64,
    page_width: f64,
}

/// Draws a figure as an SVG document.
pub(crate) fn draw(figure: &Figure) -> Result<String, PlotErrorKind> {
    let fonts = Fonts::embedded().map_err(|error| PlotErrorKind::Font(error.to_string()))?;
    let rows = lay_out(&figure.plot, &fonts)?;
    let mut svg = Svg::default();
    let mut top = SPACE.0;
    for row in rows.plots.chunks(rows.columns) {
        // Frames of a row are at one height.
        let legend = row
            .iter()
            .map(|plot| plot.legend.height())
            .fold(0.0, f64::max);
        let frame_top = top + legend + SPACE.2;
        top = frame_top + rows.size.1;
        for (column, plot) in row.iter().enumerate() {
            let left = SPACE.0 + rows.size.0 * column as f64;
            let frame = Rect {
                left: left + plot.beside.0,
                right: left + rows.plot_width - plot.beside.1,
                top: frame_top,
                bottom: top - BELOW,
            };
            plot.draw(&mut svg, &frame, &fonts);
        }
    }
    let width = rows.page_width - 2.0 * SPACE.1;
    let lines = label::wrap(&figure.caption, |line| {
        fonts.width(line, CAPTION.0) <= width
    });
    top += SPACE.3;
    for (index, line) in lines.iter().enumerate() {
        let at = (SPACE.1, top + CAPTION.1 * (index as f64 + 0.5));
        svg.text(&Text::new(line, at, CAPTION.0, Anchor::Start));
    }
    let height = (top + CAPTION.1 * lines.len() as f64 + SPACE.0).ceil();
    if height > MOST_HEIGHT {
        return Err(PlotErrorKind::TooHigh {
            height,
            most: MOST_HEIGHT,
        });
    }
    Ok(svg.document((rows.page_width, height), (&figure.name, &figure.caption)))
}

/// Lays out the plots of a figure.
fn lay_out<'a>(plot: &'a Plot, fonts: &Fonts) -> Result<Rows<'a>, PlotErrorKind> {
    match plot {
        Plot::Panels(panels) => {
            let page_width = if panels.len() == 1 {
                WIDTHS.0
            } else {
                WIDTHS.1
            };
            let columns = panels.len().max(1);
            let width = (page_width - 2.0 * SPACE.0) / columns as f64;
            let plots = panels
                .iter()
                .map(|panel| Axes::of_panel(panel, fonts, width));
            let plots = plots.collect::<Result<_, _>>()?;
            Ok(Rows {
                plots,
                columns,
                size: (width, HEIGHTS.0),
                plot_width: width,
                page_width,
            })
        }
        Plot::Map(map) => {
            let width = WIDTHS.0 - 2.0 * SPACE.0;
            let plots = vec![Axes::of_map(map, fonts, width)?];
            Ok(Rows {
                plots,
                columns: 1,
                size: (width, HEIGHTS.1),
                plot_width: width,
                page_width: WIDTHS.0,
            })
        }
        Plot::Maps(maps) => {
            let (size, most) = SMALL_MAP;
            let columns = maps.len().clamp(1, most);
            let plots = maps
                .iter()
                .map(|map| Axes::of_map(map, fonts, size.0 - GUTTER));
            let plots = plots.collect::<Result<_, _>>()?;
            let page_width = (size.0 * columns as f64 - GUTTER + 2.0 * SPACE.0).max(WIDTHS.0);
            Ok(Rows {
                plots,
                columns,
                size,
                plot_width: size.0 - GUTTER,
                page_width,
            })
        }
    }
}
