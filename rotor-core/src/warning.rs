//! What is odd about a rotor though it can be computed: moments of inertia of no rigid body, and numbers that look as
//! if they were given in another unit.
//!
//! ```
//! use rotor_core::input::RotorParameters;
//! use rotor_core::warning::warnings;
//!
//! let in_millimetres = RotorParameters { shaft_length: 700.0, ..RotorParameters::PAPER };
//! let said: Vec<String> = warnings(&in_millimetres).map(|warning| warning.to_string()).collect();
//! assert_eq!(said, ["shaft_length is 700 m; is it in millimetres?"]);
//! ```

use thiserror::Error;

use crate::input::{INPUTS, NumericInput, RotorParameters};
use crate::text::shortest;

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
    /// A number that no machine has may be one in another unit.
    #[error("{} is {} {}", .input.name, shortest(*.value), question(.input.unit))]
    OtherUnit {
        /// The input.
        input: &'static NumericInput,
        /// Its value.
        value: f64,
    },
}

/// What is asked about a number that is too large for its unit.
fn question(unit: &str) -> String {
    match unit {
        "rad" => "rad, more than a turn; is it in degrees?".to_owned(),
        "m" => "m; is it in millimetres?".to_owned(),
        _ => format!("{unit}; is it in another unit?"),
    }
}

/// Every warning about a rotor of these inputs.
pub fn warnings(p: &RotorParameters) -> impl Iterator<Item = Warning> {
    let body = p.exceeds_rigid_body().then(|| Warning::TriangleInequality {
        disk_asymmetry: p.disk_asymmetry,
        beta: p.inertia_ratio(),
    });
    let bounded = INPUTS.iter().filter(|input| input.greatest.is_finite());
    let units = bounded.filter_map(|input| {
        let value = (input.get)(p);
        (value.abs() > input.greatest).then_some(Warning::OtherUnit { input, value })
    });
    body.into_iter().chain(units)
}

/// The inputs that make the moments of inertia those of no rigid body.
const INERTIAS: [&str; 3] = [
    "disk_asymmetry",
    "disk_diametral_inertia",
    "disk_polar_inertia",
];

/// Whether there can be a warning about this input.
#[must_use]
pub fn is_watched(input: &NumericInput) -> bool {
    input.greatest.is_finite() || INERTIAS.contains(&input.name)
}

/// Whether there is a warning about a rotor of these inputs.
#[must_use]
pub fn is_doubtful(p: &RotorParameters) -> bool {
    warnings(p).next().is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

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
                "shaft_length is 504.5 m; is it in millimetres?",
                "shaft_radius is 11.88 m; is it in millimetres?",
                "crack_angle is -90 rad, more than a turn; is it in degrees?",
            ]
        );
    }

    #[test]
    fn no_other_input_makes_a_rotor_doubtful() {
        assert_eq!(INPUTS.iter().filter(|input| is_watched(input)).count(), 6);
        for input in INPUTS.iter().filter(|input| !is_watched(input)) {
            let mut parameters = RotorParameters::PAPER;
            for value in [-1e9, -1.0, 0.0, 1.0, 1e9] {
                (input.set)(&mut parameters, value);
                assert!(!is_doubtful(&parameters), "{}", input.name);
            }
        }
    }
}
