//! Figures 3 to 9 of the paper, and the maps, for the rotor of the report.

mod coefficients;
mod maps;
mod whirl;
mod widths;
mod zero_unstable_points;

use rotor_core::equations::Coefficients;
use rotor_core::region::{self, RegionKind};
use rotor_core::rotor::{Rotor, RotorParameters};

use super::analysis::Analysis;
use crate::figure::{Axis, Curve, Dash, Figure, Mark, Panel, Ticks};

/// Crack depths of Fig. 6.
const DEPTHS: [f64; 4] = [0.1, 0.2, 0.25, 0.3];
/// Crack positions of Figs. 7 to 9.
const POSITIONS: [f64; 3] = [0.5, 0.4, 0.3];

/// All figures, in the order of the paper, the maps at the end.
pub(crate) fn figures(analysis: &Analysis) -> Vec<Figure> {
    let rotor = &analysis.named.rotor;
    let mut figures = vec![
        whirl::figure(rotor),
        widths::verified(rotor),
        coefficients::figure(rotor),
        widths::over_depths(rotor),
        widths::over_positions(rotor),
        zero_unstable_points::figure(rotor, RegionKind::Simple),
        zero_unstable_points::figure(rotor, RegionKind::Combination),
        maps::figure(rotor, RegionKind::Simple),
        maps::figure(rotor, RegionKind::Combination),
    ];
    for figure in &mut figures {
        figure
            .caption
            .push_str(&format!(" {}.", rotor_of(analysis)));
    }
    figures
}

/// The rotor and the model, as every caption names them.
fn rotor_of(analysis: &Analysis) -> String {
    let p = analysis.named.rotor.parameters();
    format!(
        "Rotor: {}, Δ_d = {}, σ = {}, l_c/*L* = {}, φ = {} where not stated otherwise; crack model {}, edge {}",
        analysis.named.name,
        p.disk_asymmetry,
        p.crack_depth_ratio,
        p.crack_position_ratio,
        p.crack_angle,
        p.crack_model,
        p.crack_edge
    )
}

/// The coefficients of the rotor with some inputs changed, none where it has none.
fn changed(rotor: &Rotor, change: impl FnOnce(&mut RotorParameters)) -> Option<Coefficients> {
    rotor.with(change).ok()?.coefficients().ok()
}

/// The approximate width at another crack angle.
fn width_at(kind: RegionKind, c: &Coefficients, angle: f64) -> Option<f64> {
    region::width(
        kind,
        &Coefficients {
            crack_angle: angle,
            ..*c
        },
    )
    .ok()
}

/// Evenly spaced values, both ends included.
fn spaced(from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|index| from + (to - from) * (index as f64 / last))
        .collect()
}

/// The deepest crack shown over the depth: the paper's 0.4, or more for a rotor with a deeper one.
fn deepest(rotor: &Rotor) -> f64 {
    (1.25 * rotor.parameters().crack_depth_ratio).clamp(0.4, 1.0)
}

fn axis(label: impl Into<String>) -> Axis {
    Axis {
        label: label.into(),
        range: None,
        ticks: Ticks::Decimal,
    }
}

fn angle_axis() -> Axis {
    Axis {
        label: "φ [rad]".to_owned(),
        range: Some((0.0, std::f64::consts::PI)),
        ticks: Ticks::FractionsOfPi,
    }
}

fn depth_axis(rotor: &Rotor) -> Axis {
    Axis {
        label: "σ = *a*/*R* [–]".to_owned(),
        range: Some((0.0, deepest(rotor))),
        ticks: Ticks::Decimal,
    }
}

fn line(
    label: impl Into<String>,
    colour: usize,
    dash: Dash,
    points: Vec<(f64, Option<f64>)>,
) -> Curve {
    Curve {
        label: label.into(),
        colour,
        mark: Mark::Line(dash),
        points,
    }
}

fn panel(title: &str, x: Axis, y: Axis, curves: Vec<Curve>) -> Panel {
    // A panel without a single value still shows its axes.
    let empty = curves
        .iter()
        .flat_map(|curve| &curve.points)
        .all(|(_, y)| y.is_none());
    let range = if empty { Some((0.0, 1.0)) } else { y.range };
    Panel {
        title: title.to_owned(),
        x,
        y: Axis { range, ..y },
        curves,
        annotations: Vec::new(),
    }
}

/// `λ_s` or `λ_c`, and the letter of its panel.
fn width_symbol(kind: RegionKind) -> &'static str {
    match kind {
        RegionKind::Simple | RegionKind::UpperSimple => "λ_s",
        RegionKind::Combination => "λ_c",
    }
}

/// The regions of the paper's figures with the titles of their panels.
const PANELS: [(RegionKind, &str); 2] = [
    (RegionKind::Simple, "(a) SIR"),
    (RegionKind::Combination, "(b) CIR"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Plot;
    use crate::rotor_file::NamedRotor;

    fn drawn(rotor: Rotor) -> Vec<Figure> {
        let named = NamedRotor {
            rotor,
            name: "a test".to_owned(),
        };
        figures(&Analysis::new(named).unwrap())
    }

    fn panels(figure: &Figure) -> &[Panel] {
        match &figure.plot {
            Plot::Panels(panels) => panels,
            Plot::Map(_) => panic!("{} is a map", figure.name),
        }
    }

    #[test]
    fn floquet_points_lie_on_the_exact_curve_and_near_the_approximate_one() {
        let figures = drawn(Rotor::default());
        for panel in panels(&figures[1]) {
            let [approximate, exact, hill] = panel.curves.as_slice() else {
                panic!("three curves")
            };
            assert!(hill.points.len() >= 13);
            for (angle, width) in &hill.points {
                let at = |curve: &Curve| {
                    curve
                        .points
                        .iter()
                        .find(|(other, _)| (other - angle).abs() < 1e-9)
                        .unwrap()
                        .1
                        .unwrap()
                };
                let width = width.unwrap();
                assert!(
                    (width / at(exact) - 1.0).abs() < 1e-7,
                    "{} {angle}",
                    panel.title
                );
                assert!(
                    (width / at(approximate) - 1.0).abs() < 0.06,
                    "{} {angle}",
                    panel.title
                );
            }
        }
    }

    #[test]
    fn the_points_of_figure_6_are_marked_where_the_paper_prints_them() {
        let figures = drawn(Rotor::default());
        for (figure, printed) in [(&figures[5], 0.231), (&figures[6], 0.265)] {
            let annotation = &panels(figure)[0].annotations[0];
            assert!(
                (annotation.at.0 - printed).abs() < 1e-3,
                "{}",
                annotation.label
            );
            assert!((annotation.at.1 - 0.2).abs() < 1e-9);
        }
    }

    #[test]
    fn every_caption_names_the_rotor_and_the_model() {
        for figure in drawn(Rotor::default()) {
            assert!(
                figure.caption.contains("a test") && figure.caption.contains("support-arm"),
                "{}",
                figure.name
            );
        }
    }

    #[test]
    fn rotors_without_a_region_or_a_crack_still_have_figures() {
        let no_combination = Rotor::default()
            .with(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia)
            .unwrap();
        let uncracked = Rotor::default()
            .with(|p| p.crack_depth_ratio = 0.0)
            .unwrap();
        let half = Rotor::default()
            .with(|p| p.disk_polar_inertia = 0.5 * p.disk_diametral_inertia)
            .unwrap();
        let midspan = Rotor::default()
            .with(|p| {
                p.disk_position_ratio = 0.5;
                p.crack_depth_ratio = 0.0;
                p.disk_asymmetry = 0.0;
            })
            .unwrap();
        let broken = Rotor::default()
            .with(|p| p.crack_depth_ratio = 1.0)
            .unwrap();
        for rotor in [no_combination, uncracked, half, midspan, broken] {
            for figure in drawn(rotor) {
                figure.svg().unwrap();
            }
        }
    }
}
