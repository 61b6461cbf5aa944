//! Figs. 4, 6 and 7: widths of the regions over the crack angle.

use std::f64::consts::PI;

use rayon::prelude::*;
use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::confirm_ends;
use rotor_plot::{Axis, Curve, Dash, Figure, Mark, Panel, Plot, Symbol};

use super::{
    DEPTHS, OWN_SPEED, POSITIONS, absence, angle_axis, axis, changed, line, panel, spaced,
    width_at, width_symbol, with_own,
};

/// Points of a curve, so that every point by Floquet theory is one of them.
const ANGLES: usize = 12 * FLOQUET_INTERVALS + 1;
/// Points by Floquet theory, less one.
const FLOQUET_INTERVALS: usize = 16;

/// The panels of a figure, and what its name has behind its number.
pub(super) struct Shown {
    panels: &'static [(RegionKind, &'static str)],
    suffix: &'static str,
    /// And its caption.
    what: &'static str,
}

/// The regions of the paper.
pub(super) const PAPER: Shown = Shown {
    panels: &[
        (RegionKind::Simple, "(a) SIR"),
        (RegionKind::Combination, "(b) CIR"),
    ],
    suffix: "",
    what: "",
};
/// The upper simple region, which few rotors have: often so wide that beside the simple one nothing else would be seen.
pub(super) const UPPER: Shown = Shown {
    panels: &[(RegionKind::UpperSimple, "upper SIR")],
    suffix: "-upper",
    what: ", upper SIR",
};

impl Shown {
    fn figure(
        &self,
        number: u32,
        caption: String,
        rotor: &Rotor,
        curves: impl Fn(RegionKind) -> Vec<Curve>,
    ) -> Figure {
        let panels = self
            .panels
            .iter()
            .map(|&(kind, title)| width_panel(rotor, kind, title, curves(kind)));
        Figure {
            name: format!("figure-{number}{}", self.suffix),
            caption: format!("Figure {number}{}. {caption}", self.what),
            plot: Plot::Panels(panels.collect()),
        }
    }
}

/// Fig. 4: approximate, exact, and by Floquet theory.
pub(super) fn verified(rotor: &Rotor, shown: &Shown) -> Figure {
    let c = changed(rotor, |_| {});
    let caption = "Widths of the instability regions over the crack angle: the approximation of Eq. (31), the exact \
                   width, and Floquet theory by Hill's method.";
    shown.figure(4, caption.to_owned(), rotor, |kind| {
        c.as_ref().map_or_else(Vec::new, |c| three_ways(kind, c))
    })
}

/// Fig. 6: for several crack depths.
pub(super) fn over_depths(rotor: &Rotor, shown: &Shown) -> Figure {
    let depths = with_own(&DEPTHS, rotor.parameters().crack_depth_ratio);
    let variants = depths.into_iter().map(|depth| {
        let c = changed(rotor, |p| p.crack_depth_ratio = depth);
        (format!("σ = {depth}"), c)
    });
    over(rotor, shown, (6, "depth"), &variants.collect::<Vec<_>>())
}

/// Fig. 7: for several crack positions.
pub(super) fn over_positions(rotor: &Rotor, shown: &Shown) -> Figure {
    let positions = with_own(&POSITIONS, rotor.parameters().crack_position_ratio);
    let variants = positions.into_iter().map(|position| {
        let c = changed(rotor, |p| p.crack_position_ratio = position);
        (format!("l_c = {position} *L*"), c)
    });
    over(rotor, shown, (7, "position"), &variants.collect::<Vec<_>>())
}

/// A rotor with something changed: what, and its coefficients if it has any.
type Variant = (String, Option<Coefficients>);

fn over(rotor: &Rotor, shown: &Shown, (number, what): (u32, &str), variants: &[Variant]) -> Figure {
    let caption = format!("Effect of the crack's {what} upon the widths, Eq. (31). {OWN_SPEED}");
    shown.figure(number, caption, rotor, |kind| {
        variant_curves(kind, variants)
    })
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
        let region = Region::of(kind, &at(angle)).ok()?;
        region.exact_ends().ok().map(|ends| ends.width())
    };
    let hill = |angle: f64| {
        let c = at(angle);
        let exact = Region::of(kind, &c).ok()?.exact_ends().ok()?;
        confirm_ends(&c, exact).ok().map(|hill| hill.width())
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

fn variant_curves(kind: RegionKind, variants: &[Variant]) -> Vec<Curve> {
    let angles = spaced(0.0, PI, ANGLES);
    let curve = |(index, (label, c)): (usize, &Variant)| {
        let width = |angle| c.as_ref().and_then(|c| width_at(kind, c, angle));
        line(
            label,
            index,
            Dash::of(index),
            angles.iter().map(|&angle| (angle, width(angle))).collect(),
        )
    };
    variants.iter().enumerate().map(curve).collect()
}
