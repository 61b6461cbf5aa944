//! Fig. 5: stiffness coefficients over the crack's depth.

use rotor_core::equations::Coefficients;
use rotor_core::rotor::Rotor;

use super::{axis, changed, deepest, depth_axis, line, panel, spaced};
use crate::figure::{Curve, Dash, Figure, Plot};

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
            .map(|(index, (label, get))| line(*label, index, Dash::Solid, points(*get)))
            .collect()
    };
    let constant = panel(
        "(a)",
        depth_axis(rotor),
        axis("|γ|, δ [–]"),
        curves(&CONSTANT),
    );
    let varying = panel(
        "(b)",
        depth_axis(rotor),
        axis("ε_1, ε_{12}, ε_2 [–]"),
        curves(&VARYING),
    );
    Figure {
        name: "figure-5".to_owned(),
        caption: "Figure 5. Stiffness coefficients over the crack's depth: (a) constant, (b) varying over a turn."
            .to_owned(),
        plot: Plot::Panels(vec![constant, varying]),
    }
}
