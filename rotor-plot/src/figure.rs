//! What a figure is: panels with curves, or maps.

use crate::geometry::Rect;
use crate::{PlotError, PlotErrorKind, check, contour, export, page, table};

/// A figure: what is drawn, its caption and its name.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Name of its files without their extension, such as `figure-4`; errors say it.
    pub name: String,
    /// Text below the plot.
    pub caption: String,
    /// What is drawn.
    pub plot: Plot,
}

/// What a figure shows.
#[derive(Debug, Clone)]
pub enum Plot {
    /// One panel, or two side by side.
    Panels(Vec<Panel>),
    /// A heat map with contours.
    Map(Box<Map>),
    /// Small maps in a grid, row after row.
    Maps(Vec<Map>),
}

/// Curves over one pair of axes.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Such as `(a)`; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Drawn in this order, later ones on top.
    pub curves: Vec<Curve>,
    /// Labelled points.
    pub annotations: Vec<Annotation>,
    /// Text in the middle of the plot, such as why nothing is drawn; may be empty.
    pub note: String,
}

/// An axis: its label with the unit, the range it shows and how its ticks are written.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Quantity and unit, such as `λ_s / ω_{st} [–]`.
    pub label: String,
    /// First and last value shown; `None` fits the data.
    pub range: Option<(f64, f64)>,
    /// How ticks are placed and written.
    pub ticks: Ticks,
}

/// How the ticks of an axis are placed and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ticks {
    /// Steps of 1, 2 or 5 times a power of ten.
    Decimal,
    /// A logarithmic axis, with ticks at 1, 2 and 5 times powers of ten as far as there is room.
    Logarithmic,
    /// An angle in rad, written in fractions of π.
    FractionsOfPi,
    /// An angle in rad, written in degrees.
    Degrees,
}

/// A curve or a set of points.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Entry of the legend; curves of the same label and look share one entry.
    pub label: String,
    /// Index into the palette of Okabe and Ito, which has 7 colours: the eighth curve has the first colour again.
    pub colour: usize,
    /// Line or symbols.
    pub mark: Mark,
    /// `(x, y)` in the units of the axes. Where the quantity does not exist `y` is `None`, and the curve has a gap.
    pub points: Vec<(f64, Option<f64>)>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Mark {
    /// A line through the points.
    Line(Dash),
    /// A symbol at each point.
    Points(Symbol),
    /// The area that each connected part of the points encloses, hatched. The direction and density of the hatching depend
    /// on the index of the colour, so that areas can be told apart in a print without colours.
    Area,
}

/// Pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// A dash and a dot in turn.
    DashDotted,
    /// Long dashes.
    LongDashed,
    /// A dash and two dots in turn.
    DashDotDotted,
}

impl Dash {
    /// All patterns, the plainest first.
    pub const ALL: [Self; 6] = [
        Self::Solid,
        Self::Dashed,
        Self::Dotted,
        Self::DashDotted,
        Self::LongDashed,
        Self::DashDotDotted,
    ];

    /// Picks the pattern for the curve of an index; the seventh curve has the first pattern again. Curves that differ in
    /// pattern can be told apart in a print without colours.
    ///
    /// ```
    /// use rotor_plot::Dash;
    ///
    /// assert_eq!([0, 1, 6].map(Dash::of), [Dash::Solid, Dash::Dashed, Dash::Solid]);
    /// ```
    #[must_use]
    pub fn of(index: usize) -> Self {
        let pattern = Self::ALL.get(index % Self::ALL.len());
        pattern.copied().unwrap_or(Self::Solid)
    }
}

/// Shape of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Symbol {
    /// ○
    Circle,
    /// □
    Square,
    /// △
    Triangle,
    /// ◇
    Diamond,
}

/// A point of a plot that has a label.
#[derive(Debug, Clone)]
pub struct Annotation {
    /// Such as `σ_{ZUP} = 0.2316`.
    pub label: String,
    /// `(x, y)` in the units of the axes.
    pub at: (f64, f64),
}

/// A quantity over two others, as colours with contour lines.
#[derive(Debug, Clone)]
pub struct Map {
    /// Tells one of several maps from the others, such as `σ = 0.1`; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Increasing values of the horizontal axis, at least two.
    pub x_values: Vec<f64>,
    /// Increasing values of the vertical axis, at least two.
    pub y_values: Vec<f64>,
    /// The quantity at `(x_values[i], y_values[j])` stands at `j * x_values.len() + i`; `None` where it does not exist.
    pub values: Vec<Option<f64>>,
    /// Label of the colour bar, with the unit.
    pub value_label: String,
    /// Values along which contour lines are drawn and labelled.
    pub levels: Vec<f64>,
    /// Curves drawn over the map.
    pub curves: Vec<Curve>,
    /// Labelled points.
    pub annotations: Vec<Annotation>,
    /// Text in the middle of the plot, such as why nothing is drawn; may be empty.
    pub note: String,
}

impl Map {
    /// Finds the lines along which the map has a value, as the points of one curve with gaps.
    #[must_use]
    pub fn level_line(&self, level: f64) -> Vec<(f64, Option<f64>)> {
        let (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
        let everywhere = Rect::new(least, least, most, most);
        let mut points = Vec::new();
        for line in contour::lines(self, level, &everywhere) {
            let end = line.last().map(|end| (end.0, None));
            points.extend(line.into_iter().map(|(x, y)| (x, Some(y))));
            points.extend(end);
        }
        points
    }
}

/// A format of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Scalable Vector Graphics, with text that can be searched and copied.
    Svg,
    /// Portable Network Graphics, with two pixels for each unit of the SVG document.
    Png,
    /// Portable Document Format, one page of the picture's size, at 96 units of the SVG document to the inch.
    Pdf,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];

    /// What the names of the format's files end with, after the dot.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }
}

impl Figure {
    /// Draws the figure in a format. Equal figures give equal bytes.
    ///
    /// # Errors
    /// As [`Figure::svg`], [`Figure::png`] and [`Figure::pdf`].
    pub fn draw(&self, format: Format) -> Result<Vec<u8>, PlotError> {
        match format {
            Format::Svg => self.svg().map(String::into_bytes),
            Format::Png => self.png(),
            Format::Pdf => self.pdf(),
        }
    }

    /// Draws the figure as an SVG document that refers to nothing outside it, with text that can be searched. It has no
    /// ids, so that several documents fit into one page.
    ///
    /// # Errors
    /// A figure that [`PlotErrorKind`](crate::PlotErrorKind) describes: no panel or too many, values that are not
    /// finite, nothing to draw.
    pub fn svg(&self) -> Result<String, PlotError> {
        check::check(&self.plot)
            .and_then(|()| page::draw(self))
            .map_err(|kind| self.error(kind))
    }

    /// Draws the figure as a PNG image, with the letters of the embedded fonts on every machine.
    ///
    /// # Errors
    /// As [`Figure::svg`], and when the image has no room in memory.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let svg = self.svg()?;
        export::png(&svg).map_err(|kind| self.error(kind))
    }

    /// Draws the figure as a PDF document of one page. Its letters are outlines: they look alike everywhere, but cannot be
    /// searched.
    ///
    /// # Errors
    /// As [`Figure::svg`], and when the document cannot be converted.
    pub fn pdf(&self) -> Result<Vec<u8>, PlotError> {
        let svg = self.svg()?;
        export::pdf(&svg).map_err(|kind| self.error(kind))
    }

    /// Writes what the figure shows as CSV in long form: one line a point, with `panel`, `curve` and a column for the
    /// label of each axis, units included. Numbers read back exactly; a gap is an empty cell.
    ///
    /// # Errors
    /// As [`Figure::svg`], and when the table cannot be written.
    pub fn csv(&self) -> Result<String, PlotError> {
        check::check(&self.plot)
            .and_then(|()| {
                table::write(&self.plot).map_err(|error| PlotErrorKind::Table(error.to_string()))
            })
            .map_err(|kind| self.error(kind))
    }

    /// Adds the figure's name to what is wrong with it.
    fn error(&self, kind: PlotErrorKind) -> PlotError {
        PlotError {
            figure: self.name.clone(),
            kind,
        }
    }
}
