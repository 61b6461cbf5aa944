//! Inputs of machines as there are: with others numbers may leave the range of doubles on the way to a quantity.

use std::ops::RangeInclusive;

use crate::input::NumericInput;

/// The values of an input that are allowed, and of a size with which nothing leaves the range of numbers on the way to a
/// quantity: from a tenth of a millimetre, or a gramme in a billion, to a thousand times what there is.
pub(super) struct Sizes {
    allowed: RangeInclusive<f64>,
    above: f64,
    below: f64,
    /// Whether zero is a size too.
    with_zero: bool,
}

impl Sizes {
    pub(super) fn of(input: &NumericInput) -> Self {
        const LARGEST: f64 = 1e12;
        let (above, below, with_zero) = match input.name {
            "crack_angle" | "shaft_poissons_ratio" => (0.0, f64::INFINITY, true),
            "crack_depth_ratio" | "disk_asymmetry" => (1e-9, f64::INFINITY, true),
            "disk_position_ratio" | "crack_position_ratio" => (1e-4, 1.0 - 1e-4, false),
            "disk_mass" | "disk_diametral_inertia" | "disk_polar_inertia" => {
                (1e-12, LARGEST, false)
            }
            _ => (1e-4, LARGEST, false),
        };
        Self {
            allowed: input.allowed.range(),
            above,
            below,
            with_zero,
        }
    }

    /// Without branches, so that a list is looked through in packs.
    #[inline]
    pub(super) fn contain(&self, value: f64) -> bool {
        let size = value.abs();
        let is_between = (size > self.above) & (size < self.below);
        let is_allowed = self.allowed.contains(&value);
        (is_between | ((size == 0.0) & self.with_zero)) & is_allowed
    }
}
