//! What is odd about a rotor though it can be computed: moments of inertia of no rigid body, and numbers that look as
//! if they were given in another unit.

use std::f64::consts::TAU;

use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;

use crate::table::shortest;

/// Above these a length or radius in m is more likely one in mm.
const LONGEST_SHAFT: f64 = 100.0;
const THICKEST_SHAFT: f64 = 2.0;

/// The doubts, each a sentence.
pub(crate) fn doubts(rotor: &Rotor) -> Vec<String> {
    let p = rotor.parameters();
    let units = [
        (
            "crack_angle",
            p.crack_angle,
            "rad, more than a turn; is it in degrees?",
            p.crack_angle.abs() > TAU,
        ),
        (
            "shaft_length",
            p.shaft_length,
            "m; is it in millimetres?",
            p.shaft_length > LONGEST_SHAFT,
        ),
        (
            "shaft_radius",
            p.shaft_radius,
            "m; is it in millimetres?",
            p.shaft_radius > THICKEST_SHAFT,
        ),
    ];
    let units = units
        .into_iter()
        .filter(|(.., doubtful)| *doubtful)
        .map(|(name, value, question, _)| format!("{name} is {} {question}", shortest(value)));
    let warnings = rotor.warnings();
    warnings
        .iter()
        .map(ToString::to_string)
        .chain(units)
        .collect()
}

/// The inputs that a doubt can be about.
pub(crate) const ABOUT: [&str; 6] = [
    "crack_angle",
    "disk_asymmetry",
    "disk_diametral_inertia",
    "disk_polar_inertia",
    "shaft_length",
    "shaft_radius",
];

/// Whether there would be a doubt about the rotor of these inputs.
pub(crate) fn is_doubtful(p: &RotorParameters) -> bool {
    p.exceeds_rigid_body()
        || p.crack_angle.abs() > TAU
        || p.shaft_length > LONGEST_SHAFT
        || p.shaft_radius > THICKEST_SHAFT
}

#[cfg(test)]
mod tests {
    use rotor_core::input::INPUTS;

    use super::*;

    #[test]
    fn other_units_are_suspected_and_the_papers_rotor_is_not() {
        assert_eq!(doubts(&Rotor::default()), Vec::<String>::new());
        assert!(!is_doubtful(&RotorParameters::PAPER));
        let other = Rotor::default()
            .with(|p| (p.crack_angle, p.shaft_length, p.shaft_radius) = (-90.0, 504.5, 11.88))
            .unwrap();
        assert!(is_doubtful(other.parameters()));
        assert_eq!(
            doubts(&other),
            [
                "crack_angle is -90 rad, more than a turn; is it in degrees?",
                "shaft_length is 504.5 m; is it in millimetres?",
                "shaft_radius is 11.88 m; is it in millimetres?",
            ]
        );
    }

    #[test]
    fn no_other_input_makes_a_rotor_doubtful() {
        for input in INPUTS.iter().filter(|input| !ABOUT.contains(&input.name)) {
            let mut parameters = RotorParameters::PAPER;
            for value in [-1e9, -1.0, 0.0, 1.0, 1e9] {
                (input.set)(&mut parameters, value);
                assert!(!is_doubtful(&parameters), "{}", input.name);
            }
        }
    }

    #[test]
    fn whoever_has_a_doubt_is_doubtful() {
        let changes: [fn(&mut RotorParameters); 5] = [
            |_| (),
            |p| p.crack_angle = 7.0,
            |p| p.shaft_length = 101.0,
            |p| p.shaft_radius = 2.5,
            |p| p.disk_asymmetry = -0.9,
        ];
        for change in changes {
            let rotor = Rotor::default().with(change).unwrap();
            let doubtful = is_doubtful(rotor.parameters());
            assert_eq!(doubtful, !doubts(&rotor).is_empty());
        }
    }
}
