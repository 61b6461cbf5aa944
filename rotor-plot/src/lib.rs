//! Draws figures for reports and papers, curves, hatched areas and maps of colours, as SVG, PNG and PDF.
//!
//! Describe the figure as plain data, a [`Figure`], and call [`Figure::svg`], [`Figure::png`] or [`Figure::pdf`] for the
//! document, or [`Figure::csv`] for the numbers in it:
//!
//! ```
//! use rotor_plot::{Axis, Curve, Dash, Figure, Mark, Panel, Plot, PlotError, Ticks};
//!
//! let axis = |label: &str| Axis { label: label.to_owned(), range: None, ticks: Ticks::Decimal };
//! let figure = Figure {
//!     name: "parabola".to_owned(),
//!     caption: "A parabola, λ_s = σ^{2}, with a gap.".to_owned(),
//!     plot: Plot::Panels(vec![Panel {
//!         title: "(a)".to_owned(),
//!         x: axis("crack depth ratio σ [–]"),
//!         y: axis("width λ_s [–]"),
//!         curves: vec![Curve {
//!             label: "λ_s".to_owned(),
//!             colour: 0,
//!             mark: Mark::Line(Dash::Solid),
//!             points: (0..9).map(f64::from).map(|x| (x, (x != 4.0).then_some(x * x))).collect(),
//!         }],
//!         annotations: Vec::new(),
//!         note: String::new(),
//!     }]),
//! };
//! let svg = figure.svg()?;
//! assert!(svg.starts_with("<svg") && svg.contains("crack depth ratio"));
//! assert!(figure.png()?.starts_with(b"\x89PNG"));
//! assert!(figure.pdf()?.starts_with(b"%PDF"));
//! # Ok::<(), PlotError>(())
//! ```
//!
//! A figure shows one or two panels of curves side by side ([`Panel`]), a map of colours with contour lines ([`Map`]), or
//! small maps in rows, with a caption below. The documents come back as text or bytes: no file is read or written, the fonts
//! are embedded, and equal figures give equal bytes. A figure that cannot be drawn is a [`PlotError`], which says what is
//! wrong with it.
//!
//! # Labels
//!
//! All texts are written in a small markup. A single letter before `_` is a symbol, and what follows is its subscript:
//! letters and digits (`λ_s`) or anything in braces (`ε_{12}`); `^{…}` is a superscript. Symbols and Greek letters are
//! set in italics, and so is what stands between two `*`: `*l*_c/*L*`.

mod annotate;
mod axes;
mod check;
mod contour;
mod error;
mod export;
mod figure;
mod geometry;
mod heat;
mod label;
mod legend;
mod marks;
mod page;
mod scale;
mod svg;
mod table;
#[cfg(test)]
mod tests;

pub use error::{PlotError, PlotErrorKind};
pub use figure::{
    Annotation, Axis, Curve, Dash, Figure, Format, Map, Mark, Panel, Plot, Symbol, Ticks,
};
pub use heat::levels;
