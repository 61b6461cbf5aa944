//! A scan as a picture: curves over one axis, a map over two, small maps over more.
//!
//! Long axes are thinned out for the picture, which shows no more points than it has pixels; it is
//! computed on its own, whatever is written beside it.

use std::path::Path;

use rotor_core::input::RotorParameters;
use rotor_core::input::Variable;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{self, Plan, Scan};
use rotor_core::text::shortest;
use rotor_core::unit::TIMES_REFERENCE_SPEED;
use rotor_plot::{
    Axis, Curve, Dash, Figure, Format, Map, Mark, Panel, Plot, PlotError, Ticks, levels,
};

use crate::failure::Failure;
use crate::output::Destination;

/// Most values of a curve, of each axis of a map, and of each axis that small maps stand for.
const MOST: (usize, usize, usize) = (2001, 201, 4);
/// Most small maps.
const MOST_MAPS: usize = 36;
/// About so many contour lines.
const LEVELS: f64 = 10.0;

/// The format that a path's extension names.
///
/// # Errors
///
/// Where the extension names none.
fn format_of(path: &Path) -> Result<Format, Failure> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    let named = Format::ALL
        .into_iter()
        .find(|format| Some(format.extension()) == extension);
    named.ok_or_else(|| {
        let allowed = Format::ALL.map(|format| format!(".{}", format.extension()));
        Failure::input(format!(
            "--plot {}: the name must end with {}",
            path.display(),
            one_of(&allowed)
        ))
    })
}

/// Joins names with commas, the last with `or`.
fn one_of(names: &[String]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => names.concat(),
    }
}

/// A picture that has been drawn, not yet written.
pub(super) struct Drawn {
    bytes: Vec<u8>,
    destination: Destination,
    name: String,
}

impl Drawn {
    /// Makes the file appear.
    pub(super) fn write(mut self) -> Result<(), Failure> {
        std::io::Write::write_all(&mut self.destination, &self.bytes)
            .map_err(|source| Failure::stream("write", self.name.as_str(), source))?;
        self.destination.finish()
    }
}

/// Draws a plan.
///
/// # Errors
///
/// Where there is nothing that a picture could show, or the file cannot be written.
pub(super) fn draw(plan: &Plan, path: &Path, rotor: &str) -> Result<Drawn, Failure> {
    let format = format_of(path)?;
    let destination = Destination::open(path)?;
    let figure = figure(plan, rotor)?;
    let cannot = |error: PlotError| Failure::input(format!("--plot {}: {error}", path.display()));
    let bytes = figure.draw(format).map_err(cannot)?;
    let name = format!("`{}`", path.display());
    Ok(Drawn {
        bytes,
        destination,
        name,
    })
}

/// An axis of the scan as the picture has it: its values in rising order, each once.
#[derive(Clone)]
struct Shown {
    columns: Vec<Variable>,
    /// For each value those of all its columns.
    values: Vec<Vec<f64>>,
    /// Whether equal steps are equal ratios.
    logarithmic: bool,
}

impl Shown {
    fn new(axis: &study::Axis, most: usize) -> Self {
        let last = axis.len() - 1;
        let count = axis.len().min(most as u64);
        let pick = |k: u64| {
            if count == 1 {
                0
            } else {
                (u128::from(k) * u128::from(last) / u128::from(count - 1)) as u64
            }
        };
        let columns: Vec<_> = axis.variables().collect();
        let at = |index| {
            (0..columns.len())
                .map(|column| axis.value(column, index))
                .collect()
        };
        let mut values: Vec<Vec<f64>> = (0..count).map(pick).map(at).collect();
        values.sort_by(|a, b| a[0].total_cmp(&b[0]));
        values.dedup_by(|a, b| a[0] == b[0]);
        Self {
            columns,
            values,
            logarithmic: is_logarithmic(axis),
        }
    }

    fn axis(&self) -> Result<study::Axis, Failure> {
        let columns = self.columns.iter().enumerate().map(|(column, variable)| {
            let values = self.values.iter().map(|values| values[column]).collect();
            study::Axis::listed(*variable, values)
        });
        let columns = columns.collect::<Result<_, _>>();
        columns
            .and_then(study::Axis::linked)
            .map_err(super::of_scan)
    }

    fn first(&self) -> Vec<f64> {
        self.values.iter().map(|values| values[0]).collect()
    }

    /// `φ = 30°`.
    fn title(&self, index: usize) -> String {
        let variable = self.columns[0];
        let value = self.values[index][0];
        let value = if variable.unit() == "rad" {
            format!("{}°", shortest((value.to_degrees() * 1e6).round() / 1e6))
        } else {
            // Without the last digits, in which an evenly spaced value differs from the decimal number that is meant.
            shortest(format!("{value:.11e}").parse().unwrap_or(value))
        };
        format!(
            "{} = {}",
            markup(variable.symbol()),
            value.replace('-', "−")
        )
    }

    fn drawn_axis(&self) -> Axis {
        let variable = self.columns[0];
        if variable.unit() == "rad" {
            return Axis {
                label: markup(variable.symbol()),
                range: None,
                ticks: Ticks::Degrees,
            };
        }
        let ticks = if self.logarithmic {
            Ticks::Logarithmic
        } else {
            Ticks::Decimal
        };
        Axis {
            ticks,
            ..axis(&markup(variable.symbol()), variable.unit())
        }
    }
}

/// Whether the values of an axis grow by equal ratios, as far as its ends, its middle and a third tell.
fn is_logarithmic(axis: &study::Axis) -> bool {
    let last = axis.len() - 1;
    let (start, stop) = (axis.value(0, 0), axis.value(0, last));
    // Within a hundredth, ratios and differences can hardly be told apart.
    let far = start > 0.0 && stop > 0.0 && (stop / start).ln().abs() > 0.01;
    let even = |index: u64| {
        let value = start * (stop / start).powf(index as f64 / last as f64);
        (axis.value(0, index) / value - 1.0).abs() < 1e-9
    };
    last >= 2 && far && [last / 2, last.div_ceil(3)].into_iter().all(even)
}

fn axis(symbol: &str, unit: &str) -> Axis {
    Axis {
        label: labelled(symbol, unit),
        range: None,
        ticks: Ticks::Decimal,
    }
}

/// A symbol with its unit.
fn labelled(symbol: &str, unit: &str) -> String {
    match unit {
        "" => format!("{symbol} [–]"),
        TIMES_REFERENCE_SPEED => format!("{symbol} / ω_{{st}} [–]"),
        unit => format!("{symbol} [{unit}]"),
    }
}

/// A symbol in the markup of figures: all that follows `_` is the subscript.
fn markup(symbol: &str) -> String {
    match symbol.split_once('_') {
        Some((letter, subscript)) if !subscript.contains('/') => {
            format!("{letter}_{{{subscript}}}")
        }
        _ => symbol.to_owned(),
    }
}

/// The axes that the picture has, thinned out as its kind needs.
fn shown(long: &[&study::Axis], single: &[Shown]) -> Vec<Shown> {
    let (most_curve, most_map, most_maps) = MOST;
    let count = long.len();
    let most = |index: usize| match count {
        1 => most_curve,
        _ if index + 2 < count => most_maps,
        _ => most_map,
    };
    if long.is_empty() {
        return single.first().cloned().into_iter().collect();
    }
    let numbered = long.iter().enumerate();
    numbered
        .map(|(index, axis)| Shown::new(axis, most(index)))
        .collect()
}

fn figure(plan: &Plan, rotor: &str) -> Result<Figure, Failure> {
    let axes = plan.space().axes();
    if axes.iter().any(study::Axis::is_sampled) {
        return Err(Failure::input(
            "--plot: a sample has no order along which it could be drawn; reduce it to a histogram, or give ranges (--vary)",
        ));
    }
    let single = axes.iter().filter(|axis| axis.len() == 1);
    let single: Vec<_> = single.map(|axis| Shown::new(axis, 1)).collect();
    let long: Vec<_> = axes.iter().filter(|axis| axis.len() > 1).collect();
    let shown = shown(&long, &single);
    // Where no axis is long, the first is drawn as if it were.
    let fixed = &single[usize::from(long.is_empty()).min(single.len())..];
    let picture = Drawing { plan, shown, fixed };
    let plot = picture.plot()?;
    let quantities: Vec<_> = plan
        .quantities()
        .iter()
        .map(|quantity| quantity.description())
        .collect();
    let fixed: Vec<_> = fixed
        .iter()
        .map(|shown| format!(", {}", shown.title(0)))
        .collect();
    Ok(Figure {
        name: "scan".to_owned(),
        caption: format!(
            "{}. Rotor: {rotor}{}; crack model {}, edge {}. Hatched, or a gap: there is none.",
            quantities.join("; "),
            fixed.concat(),
            plan.base().crack_model,
            plan.base().crack_edge
        ),
        plot,
    })
}

/// What is drawn of a plan.
struct Drawing<'a> {
    plan: &'a Plan,
    shown: Vec<Shown>,
    /// Axes of one value.
    fixed: &'a [Shown],
}

impl Drawing<'_> {
    fn plot(&self) -> Result<Plot, Failure> {
        let values = self.values(self.plan.quantities())?;
        match &self.shown[..] {
            [] => Err(Failure::input("--plot: there is nothing to draw")),
            [axis] => self.curves(axis, &values),
            [outer @ .., y, x] => self.maps(outer, (x, y), &values),
        }
    }

    /// The quantities at all points that are shown, the last axis innermost.
    fn values(&self, quantities: &[Quantity]) -> Result<Vec<Vec<Option<f64>>>, Failure> {
        let base =
            Rotor::new(*self.plan.base()).map_err(|error| Failure::input(error.to_string()))?;
        let mut scan = Scan::of(&base);
        for shown in self.fixed.iter().chain(&self.shown) {
            scan = scan.vary(shown.axis()?);
        }
        for &quantity in quantities {
            scan = scan.quantity(quantity);
        }
        let plan = scan.plan().map_err(super::of_scan)?;
        let mut values = vec![Vec::new(); quantities.len()];
        for chunk in plan.chunks() {
            for (quantity, values) in values.iter_mut().enumerate() {
                values.extend(chunk.quantity(quantity).iter());
            }
        }
        Ok(values)
    }

    fn curves(&self, x: &Shown, values: &[Vec<Option<f64>>]) -> Result<Plot, Failure> {
        let mut panels: Vec<(&str, Panel)> = Vec::new();
        for (quantity, values) in self.plan.quantities().iter().zip(values) {
            let curve = Curve {
                label: markup(quantity.symbol()),
                colour: 0,
                mark: Mark::Line(Dash::Solid),
                points: x.first().into_iter().zip(values.iter().copied()).collect(),
            };
            match panels.iter_mut().find(|(unit, _)| *unit == quantity.unit()) {
                Some((unit, panel)) => {
                    let colour = panel.curves.len();
                    let mark = Mark::Line(Dash::of(colour));
                    let symbols = panel.curves.iter().map(|curve| curve.label.as_str());
                    let symbols: Vec<_> = symbols.chain([curve.label.as_str()]).collect();
                    panel.y.label = labelled(&symbols.join(", "), unit);
                    panel.curves.push(Curve {
                        colour,
                        mark,
                        ..curve
                    });
                }
                None => panels.push((quantity.unit(), self.panel(x, quantity.unit(), curve))),
            }
        }
        if panels.len() > 2 {
            let units: Vec<_> = panels
                .iter()
                .map(|(unit, _)| format!("\"{unit}\""))
                .collect();
            return Err(Failure::input(format!(
                "--plot: the quantities have {} units, {}; a picture of curves has room for two",
                panels.len(),
                units.join(", ")
            )));
        }
        Ok(Plot::Panels(
            panels.into_iter().map(|(_, panel)| panel).collect(),
        ))
    }

    fn panel(&self, x: &Shown, unit: &str, curve: Curve) -> Panel {
        // Without a single value the axes are still shown.
        let empty = curve.points.iter().all(|(_, y)| y.is_none());
        Panel {
            title: String::new(),
            x: x.drawn_axis(),
            y: Axis {
                range: empty.then_some((0.0, 1.0)),
                ..axis(&curve.label, unit)
            },
            curves: vec![curve],
            annotations: Vec::new(),
            note: if empty {
                "none exists".to_owned()
            } else {
                String::new()
            },
        }
    }

    fn maps(
        &self,
        outer: &[Shown],
        (x, y): (&Shown, &Shown),
        values: &[Vec<Option<f64>>],
    ) -> Result<Plot, Failure> {
        let cells = x.values.len() * y.values.len();
        let count = values
            .first()
            .map_or(0, |values| values.len() / cells.max(1));
        if count * values.len() > MOST_MAPS {
            return Err(Failure::input(format!(
                "--plot: {} small maps; a picture has room for {MOST_MAPS}. Give fewer quantities, or fewer axes",
                count * values.len()
            )));
        }
        let mut maps = Vec::new();
        for (&quantity, values) in self.plan.quantities().iter().zip(values) {
            let closing = self.closing(quantity)?;
            for (number, values) in values.chunks(cells).enumerate() {
                let closing = closing
                    .as_ref()
                    .and_then(|closing| closing.chunks(cells).nth(number));
                let title = titles(outer, number);
                maps.push(map(quantity, title, (x, y), values, closing));
            }
        }
        Ok(match maps.pop() {
            Some(map) if maps.is_empty() => Plot::Map(Box::new(map)),
            last => Plot::Maps(maps.into_iter().chain(last).collect()),
        })
    }

    /// By how much the disk's asymmetry exceeds, at each point, the one that closes the quantity's
    /// region: zero along the ZUP line. None for what is no width of a region.
    fn closing(&self, quantity: Quantity) -> Result<Option<Vec<Option<f64>>>, Failure> {
        let closing = match quantity {
            Quantity::SirWidth => Quantity::SirZupAsymmetry,
            Quantity::CirWidth => Quantity::CirZupAsymmetry,
            _ => return Ok(None),
        };
        let mut values = self.values(&[closing])?.pop().unwrap_or_default();
        for (point, value) in values.iter_mut().enumerate() {
            let asymmetry = self.asymmetry(point);
            *value = value.map(|closing| asymmetry.abs() - closing.abs());
        }
        Ok(Some(values))
    }

    /// The disk's asymmetry at a point.
    fn asymmetry(&self, point: usize) -> f64 {
        let mut parameters = *self.plan.base();
        let mut rest = point;
        for shown in self.shown.iter().rev() {
            let values = &shown.values[rest % shown.values.len()];
            rest /= shown.values.len();
            write(&mut parameters, &shown.columns, values);
        }
        for shown in self.fixed {
            write(&mut parameters, &shown.columns, &shown.values[0]);
        }
        parameters.disk_asymmetry
    }
}

/// Writes what is an input of a rotor.
fn write(parameters: &mut RotorParameters, columns: &[Variable], values: &[f64]) {
    for (variable, &value) in columns.iter().zip(values) {
        if let Variable::Input(input) = variable {
            (input.set)(parameters, value);
        }
    }
}

/// What the small map of a number stands for.
fn titles(outer: &[Shown], number: usize) -> String {
    let mut rest = number;
    let mut titles = Vec::new();
    for shown in outer.iter().rev() {
        titles.push(shown.title(rest % shown.values.len()));
        rest /= shown.values.len();
    }
    titles.reverse();
    titles.join(", ")
}

fn map(
    quantity: Quantity,
    title: String,
    (x, y): (&Shown, &Shown),
    values: &[Option<f64>],
    closing: Option<&[Option<f64>]>,
) -> Map {
    let empty = values.iter().all(Option::is_none);
    let mut map = Map {
        title,
        x: x.drawn_axis(),
        y: y.drawn_axis(),
        x_values: x.first(),
        y_values: y.first(),
        levels: levels(values, LEVELS),
        values: values.to_vec(),
        value_label: labelled(&markup(quantity.symbol()), quantity.unit()),
        curves: Vec::new(),
        annotations: Vec::new(),
        note: if empty {
            "none exists".to_owned()
        } else {
            String::new()
        },
    };
    if let Some(closing) = closing {
        let over = Map {
            values: closing.to_vec(),
            ..map.clone()
        };
        let points = over.level_line(0.0);
        if !points.is_empty() {
            map.curves.push(Curve {
                label: "ZUP".to_owned(),
                colour: 1,
                mark: Mark::Line(Dash::Dashed),
                points,
            });
        }
    }
    map
}
