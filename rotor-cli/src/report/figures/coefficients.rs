//! Fig. 5: stiffness coefficients over the crack's depth.

use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_plot::{Axis, Curve, Dash, Figure, Plot};

use super::{axis, changed, deepest, depth_axis, line, panel, spaced};

/// Points of a curve.
const POINTS: usize = 121;

/// A coefficient's label and where it stands.
type Coefficient = (&'static str, fn(&Coefficients) -> f64);

const CONSTANT: [Coefficient; 2] = [("|γ|", |c| c.gamma.abs()), ("δ", |c| c.delta)];
const VARYING: [Coefficient; 3] = [
    ("ε_1", |c| c.epsilon_1),
    ("ε_{12}", |c| c.epsilon_12),
    ("ε_2", |c| c.epsilon_2),
];

/// Values this much above the median of all are those of a pole; and what is shown of them, over the median.
const POLE: f64 = 100.0;
const SHOWN: f64 = 10.0;

/// The range of an axis that cuts off the poles of curves, where a coefficient passes through infinity; none without.
fn within_poles(curves: &[Curve]) -> Option<(f64, f64)> {
    let mut values: Vec<f64> = curves
        .iter()
        .flat_map(|curve| &curve.points)
        .filter_map(|(_, y)| *y)
        .collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    values.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let median = values.get(values.len() / 2)?.abs();
    let limit = SHOWN * median;
    (median > 0.0 && least.abs().max(most.abs()) > POLE * median)
        .then(|| (least.max(-limit).min(0.0), most.min(limit).max(0.0)))
}

/// Puts a gap where a curve leaves the range at one end and comes back at the other.
fn break_at_poles(curve: &mut Curve, (low, high): (f64, f64)) {
    let mut broken = Vec::with_capacity(curve.points.len());
    let mut before: Option<(f64, f64)> = None;
    for &(x, y) in &curve.points {
        if let (Some((from_x, from)), Some(to)) = (before, y)
            && from.min(to) < low
            && from.max(to) > high
        {
            broken.push((0.5 * (from_x + x), None));
        }
        broken.push((x, y));
        before = y.map(|y| (x, y));
    }
    curve.points = broken;
}

/// The figure.
pub(super) fn figure(rotor: &Rotor) -> Figure {
    let cases: Vec<_> = spaced(0.0, deepest(rotor), POINTS)
        .into_iter()
        .map(|depth| (depth, changed(rotor, |p| p.crack_depth_ratio = depth)))
        .collect();
    let curves = |coefficients: &[Coefficient]| -> Vec<Curve> {
        let points = |get: fn(&Coefficients) -> f64| {
            cases
                .iter()
                .map(|(depth, c)| (*depth, c.as_ref().map(get)))
                .collect()
        };
        coefficients
            .iter()
            .enumerate()
            .map(|(index, (label, get))| line(*label, index, Dash::of(index), points(*get)))
            .collect()
    };
    let clipped = |title: &str, label: &str, mut curves: Vec<Curve>| {
        let range = within_poles(&curves);
        if let Some(range) = range {
            for curve in &mut curves {
                break_at_poles(curve, range);
            }
        }
        let y = Axis {
            range,
            ..axis(label)
        };
        panel(title, depth_axis(rotor), y, curves)
    };
    let constant = clipped("(a)", "|γ|, δ [–]", curves(&CONSTANT));
    let varying = clipped("(b)", "ε_1, ε_{12}, ε_2 [–]", curves(&VARYING));
    Figure {
        name: "figure-5".to_owned(),
        caption: "Figure 5. Stiffness coefficients over the crack's depth: (a) constant, (b) varying over a turn."
            .to_owned(),
        plot: Plot::Panels(vec![constant, varying]),
    }
}
