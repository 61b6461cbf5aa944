//! Figs. 8 and 9: the disk asymmetry that closes a region, over the crack's depth.

use rotor_core::region::{self, RegionKind};
use rotor_core::rotor::Rotor;
use rotor_core::zero_unstable_point::zup_depth;

use super::{
    POSITIONS, absence, axis, changed, deepest, depth_axis, line, panel, spaced, with_own,
};
use crate::figure::{Annotation, Curve, Dash, Figure, Plot};

/// Points of a curve.
const POINTS: usize = 161;

/// The figure of a region.
pub(super) fn figure(rotor: &Rotor, kind: RegionKind) -> Figure {
    let positions = with_own(&POSITIONS, rotor.parameters().crack_position_ratio);
    let mut curves: Vec<Curve> = Vec::new();
    let mut annotations = Vec::new();
    for (index, &position) in positions.iter().enumerate() {
        let closing = |depth: f64| {
            let c = changed(rotor, |p| {
                p.crack_position_ratio = position;
                p.crack_depth_ratio = depth;
            })?;
            // Beyond ±1 no disk has it.
            region::zup_asymmetry(kind, &c)
                .ok()
                .filter(|asymmetry| asymmetry.abs() < 1.0)
        };
        let depths = spaced(0.0, deepest(rotor), POINTS);
        let points = depths
            .into_iter()
            .map(|depth| (depth, closing(depth)))
            .collect();
        curves.push(line(
            format!("l_c = {position} *L*"),
            index,
            Dash::Solid,
            points,
        ));
        let found = rotor
            .with(|p| p.crack_position_ratio = position)
            .ok()
            .and_then(|rotor| zup_depth(&rotor, kind).ok());
        let shown = found
            .into_iter()
            .flatten()
            .filter(|point| point.value <= deepest(rotor));
        annotations.extend(shown.filter_map(|point| {
            let label = format!("σ_{{ZUP}} = {:.4}", point.value);
            Some(Annotation {
                label,
                at: (point.value, closing(point.value)?),
            })
        }));
    }
    let mut panel = panel("", depth_axis(rotor), axis("Δ_d [–]"), curves);
    panel.annotations = annotations;
    panel.note = absence(kind, rotor);
    let (name, region, angle) = match kind {
        RegionKind::Simple | RegionKind::UpperSimple => ("figure-8", "SIR", "π/2"),
        RegionKind::Combination => ("figure-9", "CIR", "0"),
    };
    let number = name.trim_start_matches("figure-");
    Figure {
        name: name.to_owned(),
        caption: format!(
            "Figure {number}. Disk asymmetry that closes the {region} at φ = {angle} over the crack's depth, Eq. (32), \
             with the zero unstable points of the rotor's own asymmetry."
        ),
        plot: Plot::Panels(vec![panel]),
    }
}
