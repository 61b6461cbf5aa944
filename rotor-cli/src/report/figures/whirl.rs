//! Fig. 3: whirl frequencies of the rotor without crack and asymmetry, and where the regions start.

use rotor_core::equations;
use rotor_core::region::{self, RegionKind};
use rotor_core::rotor::Rotor;
use rotor_core::stability::whirl_frequencies;

use super::{axis, changed, line, panel, spaced};
use crate::figure::{Annotation, Axis, Curve, Dash, Figure, Plot};

/// Points of a curve.
const POINTS: usize = 201;
/// The speeds that the paper shows.
const FASTEST: f64 = 4.0;

/// The figure.
pub(super) fn figure(rotor: &Rotor) -> Figure {
    let mut curves: Vec<Curve> = Vec::new();
    let mut annotations = Vec::new();
    let mut fastest = FASTEST;
    let symmetric = changed(rotor, |p| {
        p.crack_depth_ratio = 0.0;
        p.disk_asymmetry = 0.0;
    });
    if let Some(c) = symmetric {
        let combination = region::start(RegionKind::Combination, &c).ok();
        fastest = combination.map_or(FASTEST, |start| FASTEST.max(1.25 * start));
        let speeds = spaced(0.0, fastest, POINTS);
        let whirls: Vec<_> = speeds
            .iter()
            .map(|&speed| whirl_frequencies(&c, speed).ok())
            .collect();
        for (index, label) in ["ω_1", "ω_2", "ω_3", "ω_4"].into_iter().enumerate() {
            let at = |whirl: &Option<[f64; 4]>| whirl.and_then(|whirl| whirl.get(index).copied());
            let points = speeds
                .iter()
                .zip(&whirls)
                .map(|(&speed, whirl)| (speed, at(whirl)))
                .collect();
            curves.push(line(label, index, Dash::Solid, points));
        }
        let synchronous = speeds.iter().map(|&speed| (speed, Some(speed))).collect();
        curves.push(line("ω = *Ω*", 4, Dash::Dashed, synchronous));
        let partner = |speed: f64, whirl: &Option<[f64; 4]>| {
            whirl.map(|[_, second, ..]| 2.0 * speed - second)
        };
        let combined = speeds
            .iter()
            .zip(&whirls)
            .map(|(&speed, whirl)| (speed, partner(speed, whirl)))
            .collect();
        curves.push(line("ω = 2*Ω* − ω_2", 5, Dash::Dotted, combined));
        if let Ok(start) = region::start(RegionKind::Simple, &c) {
            annotations.push(Annotation {
                label: format!("Ω_s = {start:.4}"),
                at: (start, start),
            });
        }
        if let Some(start) = combination {
            let at = (start, equations::cir_omega(&c));
            annotations.push(Annotation {
                label: format!("Ω_c = {start:.4}"),
                at,
            });
        }
    }
    let x = Axis {
        range: Some((0.0, fastest)),
        ..axis("*Ω* / ω_{st} [–]")
    };
    let mut panel = panel("", x, axis("ω / ω_{st} [–]"), curves);
    panel.annotations = annotations;
    Figure {
        name: "figure-3".to_owned(),
        caption: "Figure 3. Whirl frequencies of the rotor without crack and asymmetry over its speed; the regions \
                  start where the lines cross ω_1 and ω_2."
            .to_owned(),
        plot: Plot::Panels(vec![panel]),
    }
}
