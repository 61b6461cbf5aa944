//! Quantities of one rotor.

use crate::batch::one_rotor::OneRotor;
use crate::error::Error;
use crate::jeffcott::rotor::Rotor;
use crate::quantity::Quantity;

impl Quantity {
    /// Computes it for one rotor; see [`evaluate`] for several and [`evaluate_at`] for those at a speed.
    ///
    /// # Errors
    /// Why the rotor has no such quantity.
    pub fn evaluate(self, rotor: &Rotor) -> Result<f64, Error> {
        OneRotor::new(rotor).get(self, None)
    }
}

/// Computes several quantities of one rotor, in the order asked for. What they share (the crack's
/// compliance, the stiffness, the coefficients, the ends of a region) is computed once, and only if
/// one of them needs it.
pub fn evaluate(quantities: &[Quantity], rotor: &Rotor) -> Vec<Result<f64, Error>> {
    evaluate_at(quantities, rotor, None)
}

/// Computes several quantities of one rotor, as [`evaluate`] does, at a speed in units of the reference speed, for quantities that [need one](Quantity::needs_speed).
///
/// ```
/// use rotor_core::{jeffcott::rotor::Rotor, quantity::Quantity, study::evaluate_at};
/// let rotor = Rotor::default();
/// let [lower, upper] = [Quantity::SirExactLower, Quantity::SirExactUpper].map(|end| end.evaluate(&rotor));
/// let inside = 0.5 * (lower? + upper?);
/// let growth = evaluate_at(&[Quantity::GrowthRate], &rotor, Some(inside)).remove(0)?;
/// assert!(growth > 0.0);
/// # Ok::<(), rotor_core::error::Error>(())
/// ```
pub fn evaluate_at(
    quantities: &[Quantity],
    rotor: &Rotor,
    speed: Option<f64>,
) -> Vec<Result<f64, Error>> {
    let shared = OneRotor::new(rotor);
    quantities
        .iter()
        .map(|&quantity| shared.get(quantity, speed))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::RegionError;

    #[test]
    fn together_is_the_same_as_alone() {
        // It has all three regions.
        let rotor = Rotor::default().with(|p| p.disk_polar_inertia *= 0.5);
        let rotor = rotor.unwrap();
        let together = evaluate(&Quantity::ALL, &rotor);
        for (quantity, value) in Quantity::ALL.into_iter().zip(together) {
            assert_eq!(value, quantity.evaluate(&rotor), "{quantity}");
            assert_eq!(value.is_ok(), !quantity.needs_speed(), "{quantity}");
        }
    }

    #[test]
    fn one_missing_quantity_does_not_hide_the_others() {
        let rotor =
            Rotor::default().with(|p| p.disk_polar_inertia = 2.0 * p.disk_diametral_inertia);
        let rotor = rotor.unwrap();
        let [sir, cir] = &evaluate(&[Quantity::SirWidth, Quantity::CirWidth], &rotor)[..] else {
            panic!("two answers")
        };
        assert!(sir.is_ok());
        assert!(
            matches!(cir, Err(Error::Region(RegionError::InertiaRatio { .. }))),
            "{cir:?}"
        );
    }
}
