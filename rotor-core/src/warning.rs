//! What is odd about a rotor though it can be computed: moments of inertia of no rigid body, and numbers that look as
//! if they were given in another unit.

use std::f64::consts::TAU;

use thiserror::Error;

use crate::input::RotorParameters;
use crate::text::shortest;

/// A longer shaft, in m, is more likely one in mm: the shafts of the largest turbines have 70 m.
const LONGEST_SHAFT: f64 = 100.0;
/// A thicker shaft, in m, is more likely one in mm: the radii of the largest are about 1 m.
const THICKEST_SHAFT: f64 = 2.0;

/// Something a valid rotor should not have, which does not keep it from being computed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Warning {
    /// $2|\Delta_d| > \beta$ breaks the triangle inequality of the moments of inertia.
    #[error(
        "disk_asymmetry is {disk_asymmetry}, but a rigid body with beta = {beta} has at most \
         beta / 2 = {limit}: its moments of inertia would break the triangle inequality",
        limit = .beta / 2.0
    )]
    TriangleInequality {
        /// $\Delta_d$.
        disk_asymmetry: f64,
        /// $\beta = I_p/I_d$.
        beta: f64,
    },
    /// An angle of more than a turn may be one in degrees.
    #[error("{input} is {} rad, more than a turn; is it in degrees?", shortest(*.value))]
    Degrees {
        /// The input.
        input: &'static str,
        /// Its value, rad.
        value: f64,
    },
    /// A length that no shaft has may be one in millimetres.
    #[error("{input} is {} m; is it in millimetres?", shortest(*.value))]
    Millimetres {
        /// The input.
        input: &'static str,
        /// Its value, m.
        value: f64,
    },
}

/// Every warning about a rotor of these inputs.
pub fn warnings(p: &RotorParameters) -> impl Iterator<Item = Warning> {
    let millimetres = |input, value, most| {
        (value > most).then_some(Warning::Millimetres { input, value })
    };
    let warnings = [
        p.exceeds_rigid_body().then(|| Warning::TriangleInequality {
            disk_asymmetry: p.disk_asymmetry,
            beta: p.inertia_ratio(),
        }),
        (p.crack_angle.abs() > TAU).then_some(Warning::Degrees {
            input: "crack_angle",
            value: p.crack_angle,
        }),
        millimetres("shaft_length", p.shaft_length, LONGEST_SHAFT),
        millimetres("shaft_radius", p.shaft_radius, THICKEST_SHAFT),
    ];
    warnings.into_iter().flatten()
}

/// The inputs that a warning can be about.
pub const INPUTS_IN_DOUBT: [&str; 6] = [
    "crack_angle",
    "disk_asymmetry",
    "disk_diametral_inertia",
    "disk_polar_inertia",
    "shaft_length",
    "shaft_radius",
];

/// Whether there is a warning about a rotor of these inputs.
#[must_use]
pub fn is_doubtful(p: &RotorParameters) -> bool {
    warnings(p).next().is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::INPUTS;

    fn told(p: &RotorParameters) -> Vec<String> {
        warnings(p).map(|warning| warning.to_string()).collect()
    }

    #[test]
    fn other_units_are_suspected_and_the_papers_rotor_is_not() {
        assert_eq!(told(&RotorParameters::PAPER), Vec::<String>::new());
        assert!(!is_doubtful(&RotorParameters::PAPER));
        let other = RotorParameters {
            crack_angle: -90.0,
            shaft_length: 504.5,
            shaft_radius: 11.88,
            ..RotorParameters::PAPER
        };
        assert!(is_doubtful(&other));
        assert_eq!(
            told(&other),
            [
                "crack_angle is -90 rad, more than a turn; is it in degrees?",
                "shaft_length is 504.5 m; is it in millimetres?",
                "shaft_radius is 11.88 m; is it in millimetres?",
            ]
        );
    }

    #[test]
    fn no_other_input_makes_a_rotor_doubtful() {
        let certain = |name| !INPUTS_IN_DOUBT.contains(&name);
        for input in INPUTS.iter().filter(|input| certain(input.name)) {
            let mut parameters = RotorParameters::PAPER;
            for value in [-1e9, -1.0, 0.0, 1.0, 1e9] {
                (input.set)(&mut parameters, value);
                assert!(!is_doubtful(&parameters), "{}", input.name);
            }
        }
    }
}
