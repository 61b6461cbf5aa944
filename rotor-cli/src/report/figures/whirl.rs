//! Fig. 3: whirl frequencies of the rotor without crack and asymmetry, and where the regions start.

use rotor_core::equations::{self, Coefficients};
use rotor_core::jeffcott::exact::whirl_frequencies;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_plot::{Annotation, Axis, Curve, Dash, Figure, Plot};

use super::{axis, changed, line, panel, spaced};

/// Points of a curve.
const POINTS: usize = 201;
/// The speeds that the paper shows.
const FASTEST: f64 = 4.0;
/// The fastest speed shown where a region starts beyond those; one that starts later is not shown.
const FURTHEST: f64 = 12.0;

/// The figure.
pub(super) fn figure(rotor: &Rotor) -> Figure {
    let symmetric = changed(rotor, |p| {
        p.crack_depth_ratio = 0.0;
        p.disk_asymmetry = 0.0;
    });
    let (curves, annotations, fastest) = symmetric.map_or((Vec::new(), Vec::new(), FASTEST), |c| {
        let starts =
            RegionKind::ALL.map(|kind| Region::of(kind, &c).map(|region| region.start()).ok());
        let shown = starts.into_iter().flatten().map(|start| 1.25 * start);
        let fastest = shown
            .filter(|&speed| speed <= FURTHEST)
            .fold(FASTEST, f64::max);
        // Beyond the axis a start would stretch the other one.
        let starts = starts.map(|start| start.filter(|&start| start <= fastest));
        (whirls(&c, fastest), marks(&c, starts), fastest)
    });
    let x = Axis {
        range: Some((0.0, fastest)),
        ..axis("*Ω* / ω_{st} [–]")
    };
    let mut panel = panel("", x, axis("ω / ω_{st} [–]"), curves);
    panel.annotations = annotations;
    Figure {
        name: "figure-3".to_owned(),
        caption: "Figure 3. Whirl frequencies of the rotor without crack and asymmetry over its speed; the regions \
                  start where the lines cross ω_1 and ω_2. The starts marked are those without crack and asymmetry, and ω_{st} is that of the uncracked rotor."
            .to_owned(),
        plot: Plot::Panels(vec![panel]),
    }
}

/// The four whirl frequencies, and the lines that cross them where regions start.
fn whirls(c: &Coefficients, fastest: f64) -> Vec<Curve> {
    let speeds = spaced(0.0, fastest, POINTS);
    let whirls: Vec<_> = speeds
        .iter()
        .map(|&speed| whirl_frequencies(c, speed).ok())
        .collect();
    let mut curves = Vec::new();
    // The lines that cross them are dashed and dotted.
    let looks = [
        ("ω_1", Dash::Solid),
        ("ω_2", Dash::LongDashed),
        ("ω_3", Dash::DashDotted),
        ("ω_4", Dash::DashDotDotted),
    ];
    for (index, (label, dash)) in looks.into_iter().enumerate() {
        let at = |whirl: &Option<[f64; 4]>| whirl.and_then(|whirl| whirl.get(index).copied());
        let points = speeds
            .iter()
            .zip(&whirls)
            .map(|(&speed, whirl)| (speed, at(whirl)))
            .collect();
        curves.push(line(label, index, dash, points));
    }
    let synchronous = speeds.iter().map(|&speed| (speed, Some(speed))).collect();
    curves.push(line("ω = *Ω*", 4, Dash::Dashed, synchronous));
    let partner =
        |speed: f64, whirl: &Option<[f64; 4]>| whirl.map(|[_, second, ..]| 2.0 * speed - second);
    let combined = speeds
        .iter()
        .zip(&whirls)
        .map(|(&speed, whirl)| (speed, partner(speed, whirl)))
        .collect();
    curves.push(line("ω = 2*Ω* − ω_2", 5, Dash::Dotted, combined));
    curves
}

/// The starts of the regions, in the order of [`RegionKind::ALL`].
fn marks(c: &Coefficients, starts: [Option<f64>; 3]) -> Vec<Annotation> {
    let [simple, upper, combination] = starts;
    let places = [
        ("Ω_s", simple.map(|start| (start, start))),
        ("second Ω_s", upper.map(|start| (start, start))),
        (
            "Ω_c",
            combination.map(|start| (start, equations::cir_omega(c))),
        ),
    ];
    let mark = |(label, at): (&str, Option<(f64, f64)>)| {
        let at = at?;
        let label = format!("{label} = {:.4}", at.0);
        Some(Annotation { label, at })
    };
    places.into_iter().filter_map(mark).collect()
}
