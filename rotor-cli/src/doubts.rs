//! What is odd about a rotor though it can be computed: moments of inertia of no rigid body, and numbers that look as
//! if they were given in another unit.

use std::f64::consts::TAU;

use rotor_core::rotor::Rotor;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_units_are_suspected_and_the_papers_rotor_is_not() {
        assert_eq!(doubts(&Rotor::default()), Vec::<String>::new());
        let other = Rotor::default()
            .with(|p| (p.crack_angle, p.shaft_length, p.shaft_radius) = (-90.0, 504.5, 11.88))
            .unwrap();
        assert_eq!(
            doubts(&other),
            [
                "crack_angle is -90 rad, more than a turn; is it in degrees?",
                "shaft_length is 504.5 m; is it in millimetres?",
                "shaft_radius is 11.88 m; is it in millimetres?",
            ]
        );
    }
}
