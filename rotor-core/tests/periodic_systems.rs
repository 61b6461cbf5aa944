//! Hill's method and the monodromy matrix on systems other than the rotor, with known answers.

use approx::assert_relative_eq;
use nalgebra::DMatrix;
use rotor_core::error::{Error, SystemError};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::Model;
use rotor_core::periodic::{FourierMatrix, PeriodicSystem, hill, monodromy};

type TestResult = Result<(), Box<dyn std::error::Error>>;

/// y'' + (a − 2q cos 2t) y = 0.
fn mathieu(a: f64, q: f64) -> Result<PeriodicSystem, Error> {
    let number = |x| DMatrix::from_element(1, 1, x);
    let stiffness =
        FourierMatrix::constant(number(a)).with_harmonic(1, number(-2.0 * q), number(0.0));
    PeriodicSystem::new(2.0, number(1.0), number(0.0), stiffness)
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

/// y'' + (a − 2α² + 4mα cos 2t + 2α² cos 4t) y = 0, the equation of Whittaker and Hill.
fn whittaker_hill(m: f64, alpha: f64, a: f64) -> Result<PeriodicSystem, Error> {
    let number = |x| DMatrix::from_element(1, 1, x);
    let square = 2.0 * alpha * alpha;
    let stiffness = FourierMatrix::constant(number(a - square))
        .with_harmonic(1, number(4.0 * m * alpha), number(0.0))
        .with_harmonic(2, number(square), number(0.0));
    PeriodicSystem::new(2.0, number(1.0), number(0.0), stiffness)
}

#[test]
fn two_harmonics_change_stability_where_their_solutions_are_periodic() -> TestResult {
    // m, a and whether the equation becomes stable with growing a. Put in, exp(α cos 2t) solves it for m = 1 and a = 0,
    // exp(α cos 2t) cos t for m = 2 and a = 1 − 4α, exp(α cos 2t) sin t for m = 2 and a = 1 + 4α.
    for alpha in [0.1, 0.7, 2.0] {
        for (m, end, side) in [
            (1.0, 0.0, 1.0),
            (2.0, 1.0 - 4.0 * alpha, -1.0),
            (2.0, 1.0 + 4.0 * alpha, 1.0),
        ] {
            let stable = whittaker_hill(m, alpha, end + side * 1e-8)?;
            let unstable = whittaker_hill(m, alpha, end - side * 1e-8)?;
            for (way, quiet, growing) in [
                (
                    "Hill",
                    hill::growth_rate(&stable, 14)?,
                    hill::growth_rate(&unstable, 14)?,
                ),
                (
                    "monodromy",
                    monodromy::growth_rate(&stable, 1e-13)?,
                    monodromy::growth_rate(&unstable, 1e-13)?,
                ),
            ] {
                assert!(quiet.abs() < 1e-7, "{way} α={alpha} a={end}: {quiet:e}");
                assert!(growing > 1e-6, "{way} α={alpha} a={end}: {growing:e}");
            }
        }
    }
    Ok(())
}

/// Two coupled motions whose mass, damping and stiffness all have a first and a second harmonic, or of which the mass
/// does not vary.
fn two_harmonics(frequency: f64, mass_varies: bool) -> Result<PeriodicSystem, Error> {
    let two = |rows: [f64; 4]| DMatrix::from_row_slice(2, 2, &rows);
    let constant_mass = FourierMatrix::constant(two([1.0, 0.2, 0.2, 1.5]));
    let mass = if mass_varies {
        constant_mass
            .with_harmonic(1, two([0.1, 0.05, 0.05, 0.0]), two([0.0, 0.1, 0.1, 0.2]))
            .with_harmonic(2, two([0.1, 0.0, 0.0, -0.1]), two([0.05, 0.0, 0.0, 0.1]))
    } else {
        constant_mass
    };
    let damping = FourierMatrix::constant(two([0.02, -0.3, 0.3, 0.01]))
        .with_harmonic(1, two([0.0, 0.1, 0.0, 0.0]), two([0.05, 0.0, 0.0, 0.0]))
        .with_harmonic(2, two([0.0, 0.0, 0.1, 0.02]), two([0.0, 0.03, 0.0, 0.0]));
    let stiffness = FourierMatrix::constant(two([1.0, -0.3, -0.3, 2.0]))
        .with_harmonic(1, two([0.3, 0.0, 0.1, 0.2]), two([0.0, 0.2, 0.2, 0.0]))
        .with_harmonic(2, two([0.2, 0.1, 0.1, -0.3]), two([0.1, 0.0, 0.0, 0.4]));
    PeriodicSystem::new(frequency, mass, damping, stiffness)
}

#[test]
fn both_ways_agree_on_systems_with_two_harmonics() -> TestResult {
    let mut grow = 0;
    for mass_varies in [false, true] {
        for frequency in [0.9, 1.3, 1.7, 2.1, 2.6, 3.3] {
            let system = two_harmonics(frequency, mass_varies)?;
            let by_hill = hill::growth_rate(&system, 20)?;
            let by_monodromy = monodromy::growth_rate(&system, 1e-13)?;
            assert_relative_eq!(by_hill, by_monodromy, epsilon = 1e-9);
            grow += usize::from(by_hill > 1e-3);
        }
    }
    assert!((3..=12).contains(&grow), "{grow}");
    Ok(())
}

#[test]
fn half_the_frequency_makes_second_harmonics_of_first_ones() -> TestResult {
    // Mathieu's equation again, its period counted twice: only the second harmonic is there.
    let number = |x| DMatrix::from_element(1, 1, x);
    for (a, q) in [(1.0, 1.0), (-3.0, 5.0)] {
        let stiffness =
            FourierMatrix::constant(number(a)).with_harmonic(2, number(-2.0 * q), number(0.0));
        let twice = PeriodicSystem::new(1.0, number(1.0), number(0.0), stiffness)?;
        assert_eq!(twice.order(), 2);
        let once = hill::growth_rate(&mathieu(a, q)?, 20)?;
        for growth in [
            hill::growth_rate(&twice, 40)?,
            monodromy::growth_rate(&twice, 1e-13)?,
        ] {
            assert_relative_eq!(growth, once, epsilon = 1e-9);
        }
    }
    Ok(())
}

#[test]
fn the_damped_asymmetric_shaft_ends_where_its_closed_form_does() -> TestResult {
    // (k₁ − Ω²)(k₂ − Ω²) + c²Ω² = 0 with k = 0.9 and 1.1, c = 0.04.
    let growth = |speed: f64| -> Result<[f64; 2], Error> {
        let two = |rows: [f64; 4]| DMatrix::from_row_slice(2, 2, &rows);
        let system = PeriodicSystem::new(
            2.0 * speed,
            DMatrix::identity(2, 2),
            DMatrix::identity(2, 2) * 0.04,
            FourierMatrix::constant(DMatrix::identity(2, 2)).with_harmonic(
                1,
                two([-0.1, 0.0, 0.0, 0.1]),
                two([0.0, -0.1, -0.1, 0.0]),
            ),
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
    let square = |size| DMatrix::<f64>::identity(size, size);
    assert!(matches!(
        PeriodicSystem::new(1.0, square(2), square(3), square(2)),
        Err(Error::System(SystemError::Shape {
            matrix: "damping",
            rows: 3,
            columns: 3,
            expected: 2
        }))
    ));
    let uneven = FourierMatrix::constant(square(2)).with_harmonic(3, square(2), square(1));
    assert!(matches!(
        PeriodicSystem::new(1.0, square(2), square(2), uneven),
        Err(Error::System(SystemError::Shape {
            matrix: "stiffness",
            rows: 1,
            ..
        }))
    ));
    assert!(PeriodicSystem::new(0.0, square(2), square(2), square(2)).is_err());
    let singular = PeriodicSystem::new(1.0, square(2) * 0.0, square(2), square(2))?;
    for growth in [
        hill::growth_rate(&singular, 1),
        monodromy::growth_rate(&singular, 1e-9),
    ] {
        assert_eq!(
            growth,
            Err(Error::System(SystemError::SingularMass { time: 0.0 }))
        );
    }
    Ok(())
}
