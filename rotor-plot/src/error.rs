//! Why a figure cannot be drawn.

/// Why a figure cannot be drawn, and which one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{figure}: {kind}")]
pub struct PlotError {
    /// Name of the figure.
    pub figure: String,
    /// What is wrong.
    pub kind: PlotErrorKind,
}

/// What is wrong with a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotErrorKind {
    /// There is no map in a list of maps.
    #[error("there is no map to draw")]
    NoMap,
    /// There are neither one nor two panels.
    #[error("{count} panels; a figure has 1 or 2")]
    PanelCount {
        /// Panels given.
        count: usize,
    },
    /// A number is not finite.
    #[error(
        "{what} has {quantity} = {value} at its point {index}; every value must be finite (a gap is None)"
    )]
    NotFinite {
        /// The curve, annotation or axis.
        what: String,
        /// `x`, `y`, `value` or `level`.
        quantity: &'static str,
        /// Which point, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// There is no point to take the range of an axis from.
    #[error("panel \"{panel}\" has no point to draw and no range for the axis \"{axis}\"")]
    Empty {
        /// Title of the panel.
        panel: String,
        /// Label of the axis.
        axis: String,
    },
    /// The range of an axis does not go upwards.
    #[error("axis \"{axis}\" from {low} to {high}; the range must be finite and go upwards")]
    Range {
        /// Label of the axis.
        axis: String,
        /// Start of the range.
        low: f64,
        /// End of the range.
        high: f64,
    },
    /// The range of a logarithmic axis begins at zero or below.
    #[error("axis \"{axis}\" from {low}; a logarithmic axis must begin above 0")]
    Logarithm {
        /// Label of the axis.
        axis: String,
        /// Start of the range.
        low: f64,
    },
    /// The values of a map do not fit its axes.
    #[error(
        "{values} values on a map of {columns} × {rows} points; at least 2 × 2, and one value per point"
    )]
    MapShape {
        /// Values given.
        values: usize,
        /// Values on the horizontal axis.
        columns: usize,
        /// Values on the vertical axis.
        rows: usize,
    },
    /// The values of an axis of a map do not increase.
    #[error("the map's {axis} values do not increase at index {index}")]
    MapAxis {
        /// `x` or `y`.
        axis: &'static str,
        /// Which value, from 0.
        index: usize,
    },
    /// The page would be too high for programs that show images.
    #[error(
        "the picture would be {height:.0} pixels high; at most {most:.0}. Give a shorter caption or fewer maps"
    )]
    TooHigh {
        /// Its height.
        height: f64,
        /// The greatest height.
        most: f64,
    },
    /// The embedded font cannot be read.
    #[error("the embedded font cannot be read: {0}")]
    Font(String),
    /// The SVG document cannot be turned into pixels.
    #[error("no PNG: {0}")]
    Png(String),
    /// The SVG document cannot be turned into a PDF document.
    #[error("no PDF: {0}")]
    Pdf(String),
    /// The numbers cannot be written as a table.
    #[error("the figure's table cannot be written: {0}")]
    Table(String),
}
