//! Figures of a report: one or two plots side by side, or one heat map, as SVG, PNG and CSV.
//!
//! This module and its children are the only place that knows the plotting crate (`plotters`). It gives coordinates,
//! axes, dashes and elements; [`canvas`] is the back end that turns them into SVG, because the crate's own one rounds
//! to whole pixels and knows no subscripts. All labels are written in the markup that [`text`] describes:
//! `λ_s`, `ε_{12}`, `*l*_c/*L*`.

mod canvas;
mod curve;
mod frame;
mod map;
mod panel;
mod picture;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod ticks;

/// A figure of a report.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    /// Stem of the file names, as `figure-4`; errors name it.
    pub(crate) name: String,
    /// Text below the plot, in the markup of [`text`]: what is shown, of which rotor, with which model.
    pub(crate) caption: String,
    /// What is drawn.
    pub(crate) plot: Plot,
}

/// What a figure shows.
#[derive(Debug, Clone)]
pub(crate) enum Plot {
    /// One panel, or two side by side.
    Panels(Vec<Panel>),
    /// A heat map with contours.
    Map(Box<Map>),
    /// Small maps in a grid, row after row.
    Maps(Vec<Map>),
}

/// Curves over one pair of axes.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    /// As `(a)`; may be empty.
    pub(crate) title: String,
    /// Horizontal axis.
    pub(crate) x: Axis,
    /// Vertical axis.
    pub(crate) y: Axis,
    /// Drawn in this order, later ones on top.
    pub(crate) curves: Vec<Curve>,
    /// Labelled points.
    pub(crate) annotations: Vec<Annotation>,
    /// Said in the middle of the plot, as why nothing is drawn; may be empty.
    pub(crate) note: String,
}

/// An axis: its label with the unit, the range it shows and how its ticks are written.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    /// Quantity and unit, as `λ_s / ω_{st} [–]`.
    pub(crate) label: String,
    /// First and last value shown; `None` fits the data.
    pub(crate) range: Option<(f64, f64)>,
    /// How ticks are placed and written.
    pub(crate) ticks: Ticks,
}

/// How the ticks of an axis are placed and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ticks {
    /// Steps of 1, 2 or 5 times a power of ten.
    Decimal,
    /// An angle in rad, written in fractions of π.
    FractionsOfPi,
    /// An angle in rad, written in degrees.
    Degrees,
}

/// A curve or a set of points.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    /// Entry of the legend; curves of the same label and look share one entry.
    pub(crate) label: String,
    /// Index into the palette of Okabe and Ito (7 colours, then from the start again).
    pub(crate) colour: usize,
    /// Line or symbols.
    pub(crate) mark: Mark,
    /// `(x, y)` in the units of the axes. The curve breaks where `y` is `None`, where the quantity does not exist.
    pub(crate) points: Vec<(f64, Option<f64>)>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// A line through the points.
    Line(Dash),
    /// A symbol at each point.
    Points(Symbol),
}

/// Pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dash {
    /// Unbroken.
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
}

/// Shape of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Symbol {
    /// ○
    Circle,
    /// □
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "no figure of the report has one yet")
    )]
    Square,
    /// △
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "no figure of the report has one yet")
    )]
    Triangle,
    /// ◇
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "no figure of the report has one yet")
    )]
    Diamond,
}

/// A labelled point of a plot, as a zero unstable point.
#[derive(Debug, Clone)]
pub(crate) struct Annotation {
    /// As `σ_{ZUP} = 0.2316`.
    pub(crate) label: String,
    /// `(x, y)` in the units of the axes.
    pub(crate) at: (f64, f64),
}

/// A quantity over two others, as colours with contour lines.
#[derive(Debug, Clone)]
pub(crate) struct Map {
    /// As `σ = 0.1`, of one of several maps; may be empty.
    pub(crate) title: String,
    /// Horizontal axis.
    pub(crate) x: Axis,
    /// Vertical axis.
    pub(crate) y: Axis,
    /// Increasing values of the horizontal axis, at least two.
    pub(crate) x_values: Vec<f64>,
    /// Increasing values of the vertical axis, at least two.
    pub(crate) y_values: Vec<f64>,
    /// The quantity at `(x_values[i], y_values[j])` stands at `j * x_values.len() + i`; `None` where it does not exist.
    pub(crate) values: Vec<Option<f64>>,
    /// Label of the colour bar, with the unit.
    pub(crate) value_label: String,
    /// Values along which contour lines are drawn and labelled.
    pub(crate) levels: Vec<f64>,
    /// Curves drawn over the map.
    pub(crate) curves: Vec<Curve>,
    /// Labelled points.
    pub(crate) annotations: Vec<Annotation>,
    /// Said in the middle of the plot, as why nothing is drawn; may be empty.
    pub(crate) note: String,
}

impl Map {
    /// The line along which the map has a value, as the points of one curve with gaps.
    pub(crate) fn level_line(&self, level: f64) -> Vec<(f64, Option<f64>)> {
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        let segments = map::contour(self, level, (everywhere, everywhere));
        let points = segments
            .into_iter()
            .map(|(from, to)| [(from.0, Some(from.1)), (to.0, Some(to.1)), (to.0, None)]);
        points.flatten().collect()
    }
}

/// Why a figure could not be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FigureError {
    /// No map at all.
    #[error("{figure}: there is no map to draw")]
    NoMap {
        /// Name of the figure.
        figure: String,
    },
    /// Neither one nor two panels.
    #[error("{figure}: {count} panels; a figure has 1 or 2")]
    PanelCount {
        /// Name of the figure.
        figure: String,
        /// Panels given.
        count: usize,
    },
    /// A number that is not finite.
    #[error(
        "{figure}: {what} has {quantity} = {value} at its point {index}; every value must be finite (a gap is None)"
    )]
    NotFinite {
        /// Name of the figure.
        figure: String,
        /// The curve, annotation or axis.
        what: String,
        /// `x`, `y` or the like.
        quantity: &'static str,
        /// Which point, from 0.
        index: usize,
        /// The value met.
        value: f64,
    },
    /// No point to take the range of an axis from.
    #[error(
        "{figure}: panel \"{panel}\" has no point to draw and no range for the axis \"{axis}\""
    )]
    Empty {
        /// Name of the figure.
        figure: String,
        /// Title of the panel.
        panel: String,
        /// Label of the axis.
        axis: String,
    },
    /// A range that does not go upwards.
    #[error(
        "{figure}: axis \"{axis}\" from {low} to {high}; the range must be finite and go upwards"
    )]
    Range {
        /// Name of the figure.
        figure: String,
        /// Label of the axis.
        axis: String,
        /// Start of the range.
        low: f64,
        /// End of the range.
        high: f64,
    },
    /// The values of a map do not fit its axes.
    #[error(
        "{figure}: {values} values on a map of {columns} × {rows} points; at least 2 × 2, and one value per point"
    )]
    MapShape {
        /// Name of the figure.
        figure: String,
        /// Values given.
        values: usize,
        /// Values on the horizontal axis.
        columns: usize,
        /// Values on the vertical axis.
        rows: usize,
    },
    /// The values of an axis of a map do not increase.
    #[error("{figure}: the map's {axis} values do not increase at index {index}")]
    MapAxis {
        /// Name of the figure.
        figure: String,
        /// `x` or `y`.
        axis: &'static str,
        /// Which value, from 0.
        index: usize,
    },
    /// The embedded font cannot be read.
    #[error("the embedded font cannot be read")]
    Font(#[from] ttf_parser::FaceParsingError),
    /// The plotting crate failed.
    #[error("{figure}: drawing failed: {message}")]
    Draw {
        /// Name of the figure.
        figure: String,
        /// What it said.
        message: String,
    },
    /// The SVG could not be turned into pixels.
    #[error("{figure}: no PNG: {message}")]
    Raster {
        /// Name of the figure.
        figure: String,
        /// What the rasteriser said.
        message: String,
    },
    /// The table could not be written.
    #[error("the figure's table cannot be written")]
    Table(#[from] csv::Error),
}

impl Figure {
    /// The figure as a self-contained SVG document with live text. It holds no ids, so several fit into one page; the
    /// same figure gives the same bytes.
    ///
    /// # Errors
    /// A figure that [`FigureError`] describes: no panel or too many, values that are not finite, nothing to draw.
    pub(crate) fn svg(&self) -> Result<String, FigureError> {
        self.check()?;
        picture::draw(self, canvas::Lettering::Live)
    }

    /// The figure as a PNG image with two pixels for each unit of the SVG. Its letters are outlines of the embedded
    /// fonts: no font of the machine is asked for.
    ///
    /// # Errors
    /// As [`Figure::svg`], and when the rasteriser fails.
    pub(crate) fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.check()?;
        let svg = picture::draw(self, canvas::Lettering::Outlined)?;
        picture::rasterise(self, &svg)
    }

    /// What the figure shows, as CSV in long form: one line a point, with `panel`, `curve` and a column for the label of
    /// each axis, units included. Numbers read back exactly; a gap is an empty cell.
    ///
    /// # Errors
    /// As [`Figure::svg`], and when the table cannot be written.
    pub(crate) fn csv(&self) -> Result<String, FigureError> {
        self.check()?;
        table::write(self)
    }

    /// Refuses what cannot be drawn.
    fn check(&self) -> Result<(), FigureError> {
        match &self.plot {
            Plot::Panels(panels) => {
                if panels.is_empty() || panels.len() > 2 {
                    return Err(FigureError::PanelCount {
                        figure: self.name.clone(),
                        count: panels.len(),
                    });
                }
                panels
                    .iter()
                    .try_for_each(|panel| self.check_drawn(&panel.curves, &panel.annotations))
            }
            Plot::Map(map) => self.check_map(map),
            Plot::Maps(maps) if maps.is_empty() => Err(FigureError::NoMap {
                figure: self.name.clone(),
            }),
            Plot::Maps(maps) => maps.iter().try_for_each(|map| self.check_map(map)),
        }
    }

    /// Every number of curves and annotations is finite.
    fn check_drawn(&self, curves: &[Curve], annotations: &[Annotation]) -> Result<(), FigureError> {
        for curve in curves {
            let what = || format!("the curve \"{}\"", curve.label);
            for (index, (x, y)) in curve.points.iter().enumerate() {
                self.check_finite(&what, "x", index, *x)?;
                self.check_finite(&what, "y", index, y.unwrap_or(0.0))?;
            }
        }
        for annotation in annotations {
            let what = || format!("the annotation \"{}\"", annotation.label);
            self.check_finite(&what, "x", 0, annotation.at.0)?;
            self.check_finite(&what, "y", 0, annotation.at.1)?;
        }
        Ok(())
    }

    /// A map has a value for each point of an increasing grid.
    fn check_map(&self, map: &Map) -> Result<(), FigureError> {
        let (columns, rows, values) = (map.x_values.len(), map.y_values.len(), map.values.len());
        if columns < 2 || rows < 2 || Some(values) != columns.checked_mul(rows) {
            return Err(FigureError::MapShape {
                figure: self.name.clone(),
                values,
                columns,
                rows,
            });
        }
        for (axis, of_axis) in [("x", &map.x_values), ("y", &map.y_values)] {
            for (index, value) in of_axis.iter().enumerate() {
                self.check_finite(&|| "the map's axis".to_owned(), axis, index, *value)?;
            }
            if let Some(index) = of_axis
                .iter()
                .zip(of_axis.iter().skip(1))
                .position(|(a, b)| a >= b)
            {
                return Err(FigureError::MapAxis {
                    figure: self.name.clone(),
                    axis,
                    index: index + 1,
                });
            }
        }
        let what = || format!("the map of \"{}\"", map.value_label);
        for (index, value) in map.values.iter().enumerate() {
            self.check_finite(&what, "value", index, value.unwrap_or(0.0))?;
        }
        for (index, level) in map.levels.iter().enumerate() {
            self.check_finite(&what, "level", index, *level)?;
        }
        self.check_drawn(&map.curves, &map.annotations)
    }

    /// The value is finite.
    fn check_finite(
        &self,
        what: &dyn Fn() -> String,
        quantity: &'static str,
        index: usize,
        value: f64,
    ) -> Result<(), FigureError> {
        if value.is_finite() {
            return Ok(());
        }
        Err(FigureError::NotFinite {
            figure: self.name.clone(),
            what: what(),
            quantity,
            index,
            value,
        })
    }
}
