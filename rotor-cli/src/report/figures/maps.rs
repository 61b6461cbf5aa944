//! The width of a region over the crack's angle and depth, as a map with its zero unstable points.

use std::f64::consts::{FRAC_PI_2, PI};

use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::jeffcott::zup::zup_depth;
use rotor_plot::{Annotation, Figure, Map, Plot, levels};

use super::{
    OWN_SPEED, absence, angle_axis, changed, deepest, depth_axis, spaced, width_at, width_symbol,
};

/// Values of each axis.
const POINTS: usize = 97;
/// At most about so many contour lines.
const LEVELS: f64 = 12.0;

/// The map of a region.
pub(super) fn figure(rotor: &Rotor, kind: RegionKind) -> Figure {
    let angles = spaced(0.0, PI, POINTS);
    let depths = spaced(0.0, deepest(rotor), POINTS);
    let mut values = Vec::with_capacity(angles.len() * depths.len());
    for &depth in &depths {
        let c = changed(rotor, |p| p.crack_depth_ratio = depth);
        values.extend(
            angles
                .iter()
                .map(|&angle| c.as_ref().and_then(|c| width_at(kind, c, angle))),
        );
    }
    let points = zup_depth(rotor, kind).unwrap_or_default();
    // The width is the same at φ and φ + π: a point at 0 is one at π, too.
    let annotations = points
        .iter()
        .filter(|point| point.value <= deepest(rotor))
        .flat_map(|point| {
            let angles: &[f64] = if point.crack_angle == 0.0 {
                &[0.0, PI]
            } else {
                &[FRAC_PI_2]
            };
            angles.iter().map(|&angle| Annotation {
                label: format!("ZUP, σ = {:.4}", point.value),
                at: (angle, point.value),
            })
        })
        .collect();
    let (name, region) = match kind {
        RegionKind::Combination => ("map-cir", "CIR"),
        _ => ("map-sir", "SIR"),
    };
    let symbol = width_symbol(kind);
    Figure {
        name: name.to_owned(),
        caption: format!(
            "Width {symbol} of the {region} over the crack's angle and depth, Eq. (31). {OWN_SPEED}"
        ),
        plot: Plot::Map(Box::new(Map {
            title: String::new(),
            x: angle_axis(),
            y: depth_axis(rotor),
            x_values: angles,
            y_values: depths,
            levels: levels(&values, LEVELS),
            values,
            value_label: format!("{symbol} / ω_{{st}} [–]"),
            curves: Vec::new(),
            annotations,
            note: absence(kind, rotor),
        })),
    }
}
