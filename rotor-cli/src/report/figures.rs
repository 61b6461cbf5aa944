//! Figures 3 to 9 of the paper, and the maps, for the rotor of the report.

mod coefficients;
mod maps;
mod whirl;
mod widths;
mod zero_unstable_points;

use rotor_core::equations::Coefficients;
use rotor_core::error::RegionError;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::text::{shortened, shortest};
use rotor_plot::{Axis, Curve, Dash, Figure, Mark, Panel, Plot, Ticks};

use super::analysis::Analysis;

/// Crack depths of Fig. 6.
const DEPTHS: [f64; 4] = [0.1, 0.2, 0.25, 0.3];
/// Crack positions of Figs. 7 to 9.
const POSITIONS: [f64; 3] = [0.5, 0.4, 0.3];
/// What captions say of the unit of speed where the crack changes from point to point.
const OWN_SPEED: &str = "Each width is in units of the reference speed ω_{st} of its own crack.";

/// The paper's values of an input and, if it is another, the rotor's own. The place of a value is its colour, in each
/// figure the same.
fn with_own(values: &[f64], own: f64) -> Vec<f64> {
    let mut values = values.to_vec();
    if !values.contains(&own) {
        values.push(own);
    }
    values
}

/// Longer names of files are shortened in a caption.
const LONGEST_NAME: usize = 40;

/// All figures, in the order of the paper, then the maps, and at the end those of the upper simple region of a rotor
/// that has it.
pub(crate) fn figures(analysis: &Analysis) -> Vec<Figure> {
    let rotor = &analysis.named.rotor;
    let mut figures = vec![
        whirl::figure(rotor),
        widths::verified(rotor, &widths::PAPER),
        coefficients::figure(rotor),
        widths::over_depths(rotor, &widths::PAPER),
        widths::over_positions(rotor, &widths::PAPER),
        zero_unstable_points::figure(rotor, RegionKind::Simple),
        zero_unstable_points::figure(rotor, RegionKind::Combination),
        maps::figure(rotor, RegionKind::Simple),
        maps::figure(rotor, RegionKind::Combination),
    ];
    if absence(RegionKind::UpperSimple, rotor).is_empty() {
        figures.extend([
            widths::verified(rotor, &widths::UPPER),
            widths::over_depths(rotor, &widths::UPPER),
            widths::over_positions(rotor, &widths::UPPER),
            zero_unstable_points::figure(rotor, RegionKind::UpperSimple),
        ]);
    }
    for figure in &mut figures {
        let rotor = rotor_of(analysis, &figure.plot);
        figure.caption.push_str(&format!(" {rotor}."));
    }
    figures
}

/// The rotor and the model, as every caption names them: without the inputs that the figure varies along an axis.
fn rotor_of(analysis: &Analysis, plot: &Plot) -> String {
    let p = analysis.named.rotor.parameters();
    let axes: String = match plot {
        Plot::Panels(panels) => panels.iter().map(|p| p.x.label.as_str()).collect(),
        Plot::Map(map) => [map.x.label.as_str(), map.y.label.as_str()].concat(),
        Plot::Maps(maps) => maps
            .iter()
            .flat_map(|map| [map.x.label.as_str(), map.y.label.as_str()])
            .collect(),
    };
    let inputs = [
        ("Δ_d", p.disk_asymmetry),
        ("σ", p.crack_depth_ratio),
        ("l_c/*L*", p.crack_position_ratio),
        ("φ", p.crack_angle),
    ];
    let inputs: Vec<_> = inputs
        .into_iter()
        .filter(|(symbol, _)| !axes.contains(symbol))
        .map(|(symbol, value)| format!("{symbol} = {}", number(value)))
        .collect();
    format!(
        "Rotor: {}, {} where not stated otherwise; crack model {}, edge {}",
        shortened(&analysis.named.name, LONGEST_NAME),
        inputs.join(", "),
        p.crack_model,
        p.crack_edge
    )
}

/// A number as it is typeset.
fn number(value: f64) -> String {
    shortest(value).replace('-', "−")
}

/// What a panel says where the rotor has no such region; empty where it has.
fn absence(kind: RegionKind, rotor: &Rotor) -> String {
    let Some(c) = changed(rotor, |_| {}) else {
        return String::new();
    };
    match Region::of(kind, &c) {
        Ok(_) => String::new(),
        Err(RegionError::InertiaRatio { beta, .. }) => {
            let region = match kind {
                RegionKind::Simple => "simple",
                RegionKind::UpperSimple => "second simple",
                RegionKind::Combination => "combination",
                other => other.name(),
            };
            format!(
                "no {region} region at β = {}",
                number((1e4 * beta).round() / 1e4)
            )
        }
        Err(why) => why.to_string(),
    }
}

/// The coefficients of the rotor with some inputs changed, none where it has none.
fn changed(rotor: &Rotor, change: impl FnOnce(&mut RotorParameters)) -> Option<Coefficients> {
    rotor.with(change).ok()?.coefficients().ok()
}

/// The approximate width at another crack angle.
fn width_at(kind: RegionKind, c: &Coefficients, angle: f64) -> Option<f64> {
    Region::of(
        kind,
        &Coefficients {
            crack_angle: angle,
            ..*c
        },
    )
    .and_then(|region| region.width())
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
        note: String::new(),
    }
}

/// `λ_s` or `λ_c`, and the letter of its panel.
fn width_symbol(kind: RegionKind) -> &'static str {
    match kind {
        RegionKind::Combination => "λ_c",
        _ => "λ_s",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotor_file::NamedRotor;
    use rotor_core::input::CrackModel;

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
            Plot::Map(_) | Plot::Maps(_) => panic!("{} is a map", figure.name),
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
    fn a_region_that_is_not_there_is_said_to_be_absent() {
        let figures = drawn(
            Rotor::default()
                .with(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia)
                .unwrap(),
        );
        let absent = "no combination region at β = 2";
        for index in [1, 3, 4] {
            let [simple, combination] = panels(&figures[index]) else {
                panic!("two panels")
            };
            assert_eq!(
                (simple.note.as_str(), combination.note.as_str()),
                ("", absent)
            );
        }
        assert_eq!(panels(&figures[5])[0].note, "");
        assert_eq!(panels(&figures[6])[0].note, absent);
        assert!(
            figures[1]
                .svg()
                .unwrap()
                .contains("no combination region at ")
        );
        let Plot::Map(map) = &figures[8].plot else {
            panic!("a map")
        };
        assert_eq!(map.note, absent);
    }

    #[test]
    fn the_second_simple_region_starts_in_figure_3() {
        let figures = drawn(
            Rotor::default()
                .with(|p| p.disk_polar_inertia = 0.8 * p.disk_diametral_inertia)
                .unwrap(),
        );
        let annotations = &panels(&figures[0])[0].annotations;
        let labels: Vec<_> = annotations.iter().map(|note| note.label.as_str()).collect();
        assert_eq!(labels.len(), 3, "{labels:?}");
        assert!(labels[1].starts_with("second Ω_s = 2.8"), "{labels:?}");
    }

    #[test]
    fn curves_of_the_rotors_own_crack_are_drawn_and_keep_the_colours() {
        let own = Rotor::default()
            .with(|p| (p.crack_depth_ratio, p.crack_position_ratio) = (0.15, 0.45))
            .unwrap();
        let figures = drawn(own);
        let looks = |index: usize| -> Vec<(String, usize)> {
            let curves = &panels(&figures[index])[0].curves;
            let looks = curves.iter();
            looks
                .map(|curve| (curve.label.clone(), curve.colour))
                .collect()
        };
        assert_eq!(looks(3)[4], ("σ = 0.15".to_owned(), 4));
        let expected = [(0.5, 0), (0.4, 1), (0.3, 2), (0.45, 3)]
            .map(|(position, colour)| (format!("l_c = {position} *L*"), colour));
        for index in [4, 5, 6] {
            assert_eq!(looks(index), expected, "{}", figures[index].name);
        }
    }

    #[test]
    fn axes_of_widths_begin_at_zero_and_those_of_coefficients_leave_out_poles() {
        let symmetric = Rotor::default()
            .with(|p| (p.crack_depth_ratio, p.disk_asymmetry) = (0.0, 0.0))
            .unwrap();
        let figures = drawn(symmetric);
        for index in [1, 3, 4] {
            for panel in panels(&figures[index]) {
                assert!(
                    panel
                        .y
                        .range
                        .is_some_and(|(low, high)| low == 0.0 && high > 0.0)
                );
            }
        }
        assert!(
            panels(&figures[2])
                .iter()
                .all(|panel| panel.y.range.is_none())
        );
        // With the disk near midspan a crack turns the coupling's sign as it deepens: ε₁₂ passes through infinity.
        let pole = Rotor::default()
            .with(|p| {
                (p.disk_position_ratio, p.crack_position_ratio) = (0.49, 0.45);
                p.crack_depth_ratio = 0.6;
            })
            .unwrap();
        let figures = drawn(pole);
        let (low, high) = panels(&figures[2])[1].y.range.unwrap();
        assert!(low < 0.0 && high > 0.0 && high - low < 20.0, "{low} {high}");
        let gaps = |curve: &Curve| curve.points.iter().filter(|(_, y)| y.is_none()).count();
        let curves = &panels(&figures[2])[1].curves;
        assert_eq!(curves.iter().map(gaps).collect::<Vec<_>>(), [0, 1, 0]);
    }

    #[test]
    fn captions_have_the_minus_of_typography() {
        let turned = Rotor::default().with(|p| p.disk_asymmetry = -0.5).unwrap();
        for figure in drawn(turned) {
            assert!(figure.caption.contains("Δ_d = −0.5"), "{}", figure.caption);
        }
    }

    #[test]
    fn captions_name_the_unit_of_speed_and_not_what_an_axis_varies() {
        let figures = drawn(Rotor::default());
        for index in [3, 4, 7, 8] {
            let caption = &figures[index].caption;
            assert!(caption.contains("of its own crack"), "{caption}");
            assert!(!caption.contains("φ = 0 where"), "{caption}");
        }
        assert!(figures[0].caption.contains("that of the uncracked rotor"));
        assert!(!figures[5].caption.contains("σ = 0.2"));
    }

    #[test]
    fn a_disk_of_negative_asymmetry_closes_the_regions_at_the_other_angle() {
        let turned = Rotor::default().with(|p| p.disk_asymmetry = -0.2).unwrap();
        let figures = drawn(turned);
        for (index, angle, depth) in [
            (5, "closes the SIR at φ = 0 over", 0.2316),
            (6, "closes the CIR at φ = π/2 over", 0.2647),
        ] {
            let figure = &figures[index];
            assert!(figure.caption.contains(angle), "{}", figure.caption);
            let at = panels(figure)[0].annotations[0].at;
            assert!(
                (at.0 - depth).abs() < 1e-3 && (at.1 + 0.2).abs() < 1e-9,
                "{at:?}"
            );
        }
        let Plot::Map(map) = &figures[7].plot else {
            panic!("a map")
        };
        let angles: Vec<f64> = map.annotations.iter().map(|note| note.at.0).collect();
        assert_eq!(
            angles,
            [0.0, std::f64::consts::PI],
            "closed at 0 is closed at π"
        );
    }

    #[test]
    fn the_upper_simple_region_has_its_figures() {
        // From β = 1 − Δ_d = 0.8 on, the region has no upper end at any speed that means something.
        let slender = Rotor::default()
            .with(|p| p.disk_polar_inertia = 0.75 * p.disk_diametral_inertia)
            .unwrap();
        let figures = drawn(slender);
        let names: Vec<_> = figures[9..]
            .iter()
            .map(|figure| figure.name.as_str())
            .collect();
        assert_eq!(
            names,
            [
                "figure-4-upper",
                "figure-6-upper",
                "figure-7-upper",
                "figure-8-upper"
            ]
        );
        for figure in &figures[9..] {
            let curves = &panels(figure)[0].curves;
            let exist = |curve: &Curve| curve.points.iter().any(|(_, y)| y.is_some());
            assert!(
                curves.iter().all(exist) && !curves.is_empty(),
                "{}",
                figure.name
            );
        }
        assert_eq!(drawn(Rotor::default()).len(), 9);
    }

    #[test]
    fn a_closed_region_and_a_missing_point_are_told() {
        let uncoupled = Rotor::default()
            .with(|p| (p.disk_position_ratio, p.crack_depth_ratio) = (0.5, 0.0))
            .unwrap();
        let figures = drawn(uncoupled);
        assert!(panels(&figures[1])[1].note.contains("region is closed"));
        let simply = Rotor::default()
            .with(|p| (p.crack_model, p.crack_position_ratio) = (CrackModel::SimplySupported, 0.01))
            .unwrap();
        assert!(
            drawn(simply)[6]
                .caption
                .contains("no zero unstable point in this range")
        );
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
