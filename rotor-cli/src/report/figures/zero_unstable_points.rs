//! Figs. 8 and 9: the disk asymmetry that closes a region, over the crack's depth.

use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::jeffcott::zup::{ZeroUnstablePoint, zup_depth};
use rotor_plot::{Annotation, Dash, Figure, Plot};

use super::{
    POSITIONS, absence, axis, changed, deepest, depth_axis, line, panel, spaced, with_own,
};

/// Points of a curve.
const POINTS: usize = 161;

/// The figure of a region: over the crack's depth, the asymmetry that closes it at the angle at which the rotor's own
/// sign of asymmetry does.
pub(super) fn figure(rotor: &Rotor, kind: RegionKind) -> Figure {
    let own = rotor.parameters().disk_asymmetry;
    // A disk of the opposite asymmetry is the same disk turned by a quarter: it closes the region at the other angle.
    let sign = if own < 0.0 { -1.0 } else { 1.0 };
    let (number, suffix, region, angles) = match kind {
        RegionKind::UpperSimple => (8, "-upper", "upper SIR", ["π/2", "0"]),
        RegionKind::Combination => (9, "", "CIR", ["0", "π/2"]),
        _ => (8, "", "SIR", ["π/2", "0"]),
    };
    let [angle, other] = if own < 0.0 {
        [angles[1], angles[0]]
    } else {
        angles
    };
    let positions = with_own(&POSITIONS, rotor.parameters().crack_position_ratio);
    let (mut curves, mut annotations) = (Vec::new(), Vec::new());
    for (index, &position) in positions.iter().enumerate() {
        let closing = |depth: f64| closing(rotor, kind, position, depth).map(|found| sign * found);
        let along = spaced(0.0, deepest(rotor), POINTS)
            .into_iter()
            .map(|depth| (depth, closing(depth)))
            .collect();
        let label = format!("l_c = {position} *L*");
        curves.push(line(label, index, Dash::of(index), along));
        annotations.extend(shown(rotor, kind, position).iter().filter_map(|point| {
            let at = (point.value, closing(point.value)?);
            let mut label = format!("σ = {:.4}", point.value);
            if at.1 * own < 0.0 {
                label.push_str(&format!(" at φ = {other}"));
            }
            Some(Annotation { label, at })
        }));
    }
    let absence = absence(kind, rotor);
    let marked = match (absence.is_empty(), annotations.is_empty()) {
        (false, _) => "",
        (true, true) => " The rotor's own asymmetry has no zero unstable point in this range.",
        (true, false) => " The points are the zero unstable points of the rotor's own asymmetry.",
    };
    let curves = if absence.is_empty() {
        curves
    } else {
        Vec::new()
    };
    let mut panel = panel("", depth_axis(rotor), axis("Δ_d [–]"), curves);
    panel.annotations = annotations;
    panel.note = absence;
    Figure {
        name: format!("figure-{number}{suffix}"),
        caption: format!(
            "Figure {number}. Disk asymmetry that closes the {region} at φ = {angle} over the crack's depth, Eq. (32); \
             at φ = {other} the opposite one closes it.{marked}"
        ),
        plot: Plot::Panels(vec![panel]),
    }
}

/// The closing asymmetry of Eq. (32) for a crack; none where no disk has it.
fn closing(rotor: &Rotor, kind: RegionKind, position: f64, depth: f64) -> Option<f64> {
    let c = changed(rotor, |p| {
        p.crack_position_ratio = position;
        p.crack_depth_ratio = depth;
    })?;
    Region::of(kind, &c)
        .and_then(|region| region.zup_asymmetry())
        .ok()
        .filter(|asymmetry| asymmetry.abs() < 1.0)
}

/// The zero unstable points at a position of the crack, as far as the figure reaches.
fn shown(rotor: &Rotor, kind: RegionKind, position: f64) -> Vec<ZeroUnstablePoint> {
    let mut points = rotor
        .with(|p| p.crack_position_ratio = position)
        .ok()
        .and_then(|rotor| zup_depth(&rotor, kind).ok())
        .unwrap_or_default();
    points.retain(|point| point.value <= deepest(rotor));
    points
}
