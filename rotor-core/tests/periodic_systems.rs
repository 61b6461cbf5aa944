//! Hill's method and the monodromy matrix on systems other than the rotor, with known answers.

use std::error::Error;

use approx::assert_relative_eq;
use nalgebra::DMatrix;
use rotor_core::error::StabilityError;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::Model;
use rotor_core::periodic::{Harmonic, PeriodicSystem, hill, monodromy};

type TestResult = Result<(), Box<dyn Error>>;

/// y'' + (a − 2q cos 2t) y = 0.
fn mathieu(a: f64, q: f64) -> Result<PeriodicSystem, StabilityError> {
    let number = |x| DMatrix::from_element(1, 1, x);
    let stiffness = Harmonic {
        cosine: number(-2.0 * q),
        ..Harmonic::constant(number(a))
    };
    PeriodicSystem::new(
        2.0,
        Harmonic::constant(number(1.0)),
        Harmonic::constant(number(0.0)),
        stiffness,
    )
}

#[test]
fn mathieus_equation_changes_stability_at_its_characteristic_values() -> TestResult {
    // (q, value, 1 if it becomes stable with growing a, else −1), DLMF section 28.
    for (q, value, side) in [
        (1.0, -0.4551386041, 1.0),
        (1.0, -0.1102488170, -1.0),
        (1.0, 1.8591080725, 1.0),
        (1.0, 3.9170247730, -1.0),
        (1.0, 4.3713009827, 1.0),
        (5.0, -5.8000460209, 1.0),
        (5.0, -5.7900805986, -1.0),
        (5.0, 1.8581875415, 1.0),
        (5.0, 2.0994604455, -1.0),
        (5.0, 7.4491097395, 1.0),
    ] {
        let stable = mathieu(value + side * 1e-8, q)?;
        let unstable = mathieu(value - side * 1e-8, q)?;
        for (way, quiet, growing) in [
            (
                "Hill",
                hill::growth_rate(&stable, 12)?,
                hill::growth_rate(&unstable, 12)?,
            ),
            (
                "monodromy",
                monodromy::growth_rate(&stable, 1e-13)?,
                monodromy::growth_rate(&unstable, 1e-13)?,
            ),
        ] {
            assert!(quiet.abs() < 1e-9, "{way} q={q} a={value}: {quiet:e}");
            assert!(growing > 1e-5, "{way} q={q} a={value}: {growing:e}");
        }
    }
    Ok(())
}

#[test]
fn hills_method_converges_with_the_harmonics_on_mathieus_equation() -> TestResult {
    for (a, q) in [
        (1.0, 1.0),
        (4.0, 1.0),
        (-3.0, 5.0),
        (30.0, 5.0),
        (1.5, 20.0),
    ] {
        let system = mathieu(a, q)?;
        let floquet = monodromy::growth_rate(&system, 1e-13)?;
        assert_relative_eq!(hill::growth_rate(&system, 14)?, floquet, epsilon = 1e-9);
        assert_relative_eq!(hill::growth_rate(&system, 20)?, floquet, epsilon = 1e-9);
    }
    Ok(())
}

#[test]
fn the_damped_asymmetric_shaft_ends_where_its_closed_form_does() -> TestResult {
    // (k₁ − Ω²)(k₂ − Ω²) + c²Ω² = 0 with k = 0.9 and 1.1, c = 0.04.
    let growth = |speed: f64| -> Result<[f64; 2], StabilityError> {
        let two = |rows: [f64; 4]| DMatrix::from_row_slice(2, 2, &rows);
        let system = PeriodicSystem::new(
            2.0 * speed,
            Harmonic::constant(DMatrix::identity(2, 2)),
            Harmonic::constant(DMatrix::identity(2, 2) * 0.04),
            Harmonic {
                constant: DMatrix::identity(2, 2),
                cosine: two([-0.1, 0.0, 0.0, 0.1]),
                sine: two([0.0, -0.1, -0.1, 0.0]),
            },
        )?;
        Ok([
            hill::growth_rate(&system, 2)?,
            monodromy::growth_rate(&system, 1e-13)?,
        ])
    };
    for end in [0.9526515600, 1.0444400439] {
        for rate in growth(end)? {
            assert!(rate.abs() < 1e-9, "{end}: {rate:e}");
        }
    }
    for (speed, sign) in [(0.95, -1.0), (1.0, 1.0), (1.05, -1.0)] {
        let [by_hill, by_monodromy] = growth(speed)?;
        assert!(by_hill * sign > 0.0, "{speed}: {by_hill}");
        assert_relative_eq!(by_hill, by_monodromy, epsilon = 1e-11);
    }
    Ok(())
}

#[test]
fn periodic_systems_are_checked() -> TestResult {
    let system = Rotor::default().coefficients()?.system(1.0)?;
    for harmonics in [0, 1001, usize::MAX] {
        assert!(hill::growth_rate(&system, harmonics).is_err());
    }
    for tolerance in [0.0, 1e-17, f64::NAN] {
        assert!(monodromy::growth_rate(&system, tolerance).is_err());
    }
    let square = |size| Harmonic::constant(DMatrix::identity(size, size));
    assert!(matches!(
        PeriodicSystem::new(1.0, square(2), square(3), square(2)),
        Err(StabilityError::Shape {
            matrix: "damping",
            rows: 3,
            columns: 3,
            expected: 2
        })
    ));
    assert!(PeriodicSystem::new(0.0, square(2), square(2), square(2)).is_err());
    Ok(())
}
