//! The page: plots in rows, the caption below.

use crate::PlotErrorKind;
use crate::axes::{Axes, BELOW, Content};
use crate::figure::{Figure, Plot};
use crate::geometry::Rect;
use crate::label::{self, Fonts};
use crate::svg::{Anchor, Svg};

/// Width of a page with one plot, and with two, in pixels.
const WIDTHS: (f64, f64) = (640.0, 900.0);
/// Height of a panel and of a map with their axes, without their legends, in pixels.
const HEIGHTS: (f64, f64) = (324.0, 392.0);
/// Width and height of a small map without its legend in pixels, and how many stand side by side.
const SMALL_MAP: ((f64, f64), usize) = ((416.0, 292.0), 3);
/// Space between plots side by side in pixels.
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
    plot_size: (f64, f64),
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
        top = frame_top + rows.plot_size.1;
        for (column, plot) in row.iter().enumerate() {
            let left = SPACE.0 + (rows.plot_size.0 + GUTTER) * column as f64;
            let right = left + rows.plot_size.0 - plot.beside.1;
            let frame = Rect::new(left + plot.beside.0, frame_top, right, top - BELOW);
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
        svg.write(line, at, CAPTION.0, Anchor::Start);
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
    let (contents, columns, plot_size): (Vec<Content<'a>>, usize, (f64, f64)) = match plot {
        Plot::Panels(panels) => {
            let columns = panels.len().max(1);
            let page = if columns == 1 { WIDTHS.0 } else { WIDTHS.1 };
            let width = (page - 2.0 * SPACE.0 + GUTTER) / columns as f64 - GUTTER;
            (
                panels.iter().map(Content::from).collect(),
                columns,
                (width, HEIGHTS.0),
            )
        }
        Plot::Map(map) => (
            vec![Content::from(&**map)],
            1,
            (WIDTHS.0 - 2.0 * SPACE.0, HEIGHTS.1),
        ),
        Plot::Maps(maps) => {
            let (size, most) = SMALL_MAP;
            (
                maps.iter().map(Content::from).collect(),
                maps.len().clamp(1, most),
                size,
            )
        }
    };
    let plots = contents
        .into_iter()
        .map(|content| Axes::new(content, fonts, plot_size.0));
    let plots = plots.collect::<Result<_, _>>()?;
    let width = (plot_size.0 + GUTTER) * columns as f64 - GUTTER + 2.0 * SPACE.0;
    Ok(Rows {
        plots,
        columns,
        plot_size,
        page_width: width.max(WIDTHS.0),
    })
}
