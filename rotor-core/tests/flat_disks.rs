//! The ways to the growth rate against each other where β is near 2: the combination region is at a high speed there.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use nalgebra::{DMatrix, DVector};
use rotor_core::equations::Coefficients;
use rotor_core::jeffcott::exact::{combination_ends, growth_rate};
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::Model;
use rotor_core::periodic::{hill, monodromy};

type TestResult = Result<(), Box<dyn Error>>;

/// The greatest real part of the exponents in the frame that turns with the rotor, where the coefficients are constant:
/// M z'' + C z' + K z = 0 for the real and imaginary parts of u e^{iΩt}, v e^{iΩt}.
fn growth_in_the_rotors_frame(c: &Coefficients, speed: f64) -> Result<f64, Box<dyn Error>> {
    let (sine, cosine) = (2.0 * c.crack_angle).sin_cos();
    let (e1, e12, e2) = (c.epsilon_1, c.epsilon_12 * c.gamma, c.epsilon_2 * c.delta);
    let (square, asymmetry) = (speed * speed, c.disk_asymmetry);
    // Order of the displacements: Re u, Re v, Im u, Im v.
    let four = |rows: [f64; 16]| DMatrix::from_row_slice(4, 4, &rows);
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![
        1.0,
        1.0 + asymmetry,
        1.0,
        1.0 - asymmetry,
    ]));
    let (turn_u, turn_v) = (2.0 * speed, (2.0 - c.beta) * speed);
    #[rustfmt::skip]
    let (gyroscopic, stiffness) = (
        four([0.0, 0.0, turn_u, 0.0,
              0.0, 0.0, 0.0, turn_v,
              -turn_u, 0.0, 0.0, 0.0,
              0.0, -turn_v, 0.0, 0.0]),
        four([1.0 - square + e1 * cosine, c.gamma + e12 * cosine, -e1 * sine, -e12 * sine,
              c.gamma + e12 * cosine, c.delta + (c.beta - 1.0 + asymmetry) * square + e2 * cosine, -e12 * sine, -e2 * sine,
              -e1 * sine, -e12 * sine, 1.0 - square - e1 * cosine, c.gamma - e12 * cosine,
              -e12 * sine, -e2 * sine, c.gamma - e12 * cosine, c.delta + (c.beta - 1.0 - asymmetry) * square - e2 * cosine]),
    );
    let inverse = mass.try_inverse().ok_or("a disk with no inertia")?;
    let mut state = DMatrix::zeros(8, 8);
    state.view_mut((0, 4), (4, 4)).fill_with_identity();
    state
        .view_mut((4, 0), (4, 4))
        .copy_from(&(-&inverse * stiffness));
    state
        .view_mut((4, 4), (4, 4))
        .copy_from(&(-&inverse * gyroscopic));
    let exponents = state.complex_eigenvalues();
    Ok(exponents.iter().map(|x| x.re).fold(0.0, f64::max))
}

#[test]
fn the_growth_rates_of_flat_disks_agree() -> TestResult {
    let mut worst = [0.0_f64; 3];
    for beta in [1.5, 1.9, 1.98, 1.993, 1.999, 1.9999] {
        for angle in [0.0, 0.4, FRAC_PI_2] {
            let c = Coefficients {
                beta,
                crack_angle: angle,
                ..Rotor::default().coefficients()?
            };
            let start = Region::of(RegionKind::Combination, &c)?.start();
            let ends = combination_ends(&c, start)?;
            // Between the ends the growth is an arch; beside them the motion is stable.
            for part in [-0.7, -0.2, 0.1, 0.3, 0.5, 0.7, 0.9, 1.2, 1.7] {
                let speed = ends.lower + part * ends.width();
                let exact = growth_rate(&c, speed)?;
                assert_eq!(exact > 0.0, (0.0..=1.0).contains(&part), "{beta} {part}");
                let system = c.system(speed)?;
                let others = [
                    hill::growth_rate(&system, 1)?,
                    growth_in_the_rotors_frame(&c, speed)?,
                    // One period is short: its multipliers are near 1, which takes their digits.
                    if speed < 300.0 {
                        monodromy::growth_rate(&system, 1e-13)?
                    } else {
                        exact
                    },
                ];
                // Eigenvalues keep the digits of the matrix's norm over what parts them: the speed over growth rates. The
                // matrix of the rotor's frame is not balanced, its norm is the speed's square.
                let lost = f64::EPSILON * speed.powi(2);
                let allowed = [1e-12 + 10.0 * lost, 1e-10 + speed * lost, 1e-10];
                for (way, (other, allowed)) in others.into_iter().zip(allowed).enumerate() {
                    let error = (other - exact).abs();
                    worst[way] = worst[way].max(error / allowed);
                    assert!(
                        error < allowed,
                        "way {way}: {error:e}, {beta} {angle} {part}"
                    );
                }
            }
        }
    }
    println!("parts of what is allowed: {worst:?}");
    Ok(())
}
