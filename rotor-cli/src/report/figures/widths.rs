//! Figs. 4, 6 and 7: widths of the regions over the crack angle.

use std::f64::consts::PI;

use rayon::prelude::*;
use rotor_core::equations::Coefficients;
use rotor_core::region::{self, RegionKind};
use rotor_core::rotor::Rotor;

use super::{
    DEPTHS, OWN_SPEED, PANELS, POSITIONS, absence, angle_axis, axis, changed, line, panel, spaced,
    width_at, width_symbol, with_own,
};
use crate::figure::{Axis, Curve, Dash, Figure, Mark, Panel, Plot, Symbol};
use crate::report::hill;

/// Points of a curve, so that every point by Floquet theory is one of them.
const ANGLES: usize = 12 * FLOQUET_INTERVALS + 1;
/// Points by Floquet theory, less one.
const FLOQUET_INTERVALS: usize = 16;

/// Fig. 4: approximate, exact, and by Floquet theory.
pub(super) fn verified(rotor: &Rotor) -> Figure {
    let c = changed(rotor, |_| {});
    let panels = PANELS.map(|(kind, title)| {
        let curves = c.as_ref().map_or_else(Vec::new, |c| {
            let mut curves = three_ways(kind, c);
            if kind == RegionKind::Simple {
                curves.extend(upper(three_ways(RegionKind::UpperSimple, c), 3));
            }
            curves
        });
        width_panel(rotor, kind, title, curves)
    });
    figure(
        "figure-4",
        "Figure 4. Widths of the instability regions over the crack angle: the approximation of Eq. (31), the exact \
         width, and Floquet theory by Hill's method.",
        panels,
    )
}

/// Fig. 6: for several crack depths.
pub(super) fn over_depths(rotor: &Rotor) -> Figure {
    let variants: Vec<_> = with_own(&DEPTHS, rotor.parameters().crack_depth_ratio)
        .into_iter()
        .map(|depth| {
            (
                format!("σ = {depth}"),
                changed(rotor, |p| p.crack_depth_ratio = depth),
            )
        })
        .collect();
    figure(
        "figure-6",
        &format!("Figure 6. Effect of the crack's depth upon the widths, Eq. (31). {OWN_SPEED}"),
        PANELS.map(|(kind, title)| {
            let mut curves = variant_curves(kind, &variants);
            if kind == RegionKind::Simple {
                let dashed = upper(variant_curves(RegionKind::UpperSimple, &variants), 0);
                curves.extend(dashed.into_iter().map(|curve| Curve {
                    mark: Mark::Line(Dash::Dashed),
                    ..curve
                }));
            }
            width_panel(rotor, kind, title, curves)
        }),
    )
}

/// Fig. 7: for several crack positions.
pub(super) fn over_positions(rotor: &Rotor) -> Figure {
    let variants: Vec<_> = with_own(&POSITIONS, rotor.parameters().crack_position_ratio)
        .into_iter()
        .map(|position| {
            (
                format!("l_c = {position} *L*"),
                changed(rotor, |p| p.crack_position_ratio = position),
            )
        })
        .collect();
    figure(
        "figure-7",
        &format!("Figure 7. Effect of the crack's position upon the widths, Eq. (31). {OWN_SPEED}"),
        PANELS.map(|(kind, title)| {
            let mut curves = variant_curves(kind, &variants);
            if kind == RegionKind::Simple {
                let dashed = upper(variant_curves(RegionKind::UpperSimple, &variants), 0);
                curves.extend(dashed.into_iter().map(|curve| Curve {
                    mark: Mark::Line(Dash::Dashed),
                    ..curve
                }));
            }
            width_panel(rotor, kind, title, curves)
        }),
    )
}

/// The curves of the upper simple region as they stand beside those of the simple one, so many colours on: none where
/// the rotor has none.
fn upper(curves: Vec<Curve>, colours_on: usize) -> Vec<Curve> {
    let exists = |curve: &Curve| curve.points.iter().any(|(_, y)| y.is_some());
    curves
        .into_iter()
        .filter(exists)
        .map(|curve| Curve {
            label: format!("{}, upper SIR", curve.label),
            colour: curve.colour + colours_on,
            ..curve
        })
        .collect()
}

fn figure(name: &str, caption: &str, panels: [Panel; 2]) -> Figure {
    Figure {
        name: name.to_owned(),
        caption: caption.to_owned(),
        plot: Plot::Panels(panels.into()),
    }
}

fn width_panel(rotor: &Rotor, kind: RegionKind, title: &str, curves: Vec<Curve>) -> Panel {
    let y = axis(format!("{} / ω_{{st}} [–]", width_symbol(kind)));
    let most = curves
        .iter()
        .flat_map(|curve| &curve.points)
        .filter_map(|(_, y)| *y)
        .fold(0.0, f64::max);
    let drawn = curves
        .iter()
        .any(|curve| curve.points.iter().any(|(_, y)| y.is_some()));
    // From zero, so that a region that closes is seen to close.
    let range = Some((0.0, if most > 0.0 { 1.05 * most } else { 0.1 }));
    let note = match absence(kind, rotor) {
        absence if absence.is_empty() && drawn && most == 0.0 => {
            "the region is closed: its width is 0 at every angle".to_owned()
        }
        absence => absence,
    };
    let curves = if absence(kind, rotor).is_empty() {
        curves
    } else {
        Vec::new()
    };
    Panel {
        note,
        ..panel(title, angle_axis(), Axis { range, ..y }, curves)
    }
}

fn three_ways(kind: RegionKind, c: &Coefficients) -> Vec<Curve> {
    let angles = spaced(0.0, PI, ANGLES);
    let at = |angle: f64| Coefficients {
        crack_angle: angle,
        ..*c
    };
    let exact = |angle: f64| {
        region::exact_ends(kind, &at(angle))
            .ok()
            .map(|ends| ends.width())
    };
    let hill = |angle: f64| {
        let c = at(angle);
        let exact = region::exact_ends(kind, &c).ok()?;
        hill::ends_near(&c, exact)
            .ok()
            .map(|hill| hill.ends.width())
    };
    let floquet: Vec<_> = angles
        .par_iter()
        .step_by(12)
        .map(|&angle| (angle, hill(angle)))
        .collect();
    vec![
        line(
            "Eq. (31)",
            0,
            Dash::Solid,
            angles
                .iter()
                .map(|&angle| (angle, width_at(kind, c, angle)))
                .collect(),
        ),
        line(
            "exact",
            1,
            Dash::Dashed,
            angles.iter().map(|&angle| (angle, exact(angle))).collect(),
        ),
        Curve {
            label: "Floquet".to_owned(),
            colour: 2,
            mark: Mark::Points(Symbol::Circle),
            points: floquet,
        },
    ]
}

fn variant_curves(kind: RegionKind, variants: &[(String, Option<Coefficients>)]) -> Vec<Curve> {
    let angles = spaced(0.0, PI, ANGLES);
    let curve = |(index, (label, c)): (usize, &(String, Option<Coefficients>))| {
        let width = |angle| c.as_ref().and_then(|c| width_at(kind, c, angle));
        line(
            label,
            index,
            Dash::Solid,
            angles.iter().map(|&angle| (angle, width(angle))).collect(),
        )
    };
    variants.iter().enumerate().map(curve).collect()
}
