//! The equations of motion of the paper's rotor, Eqs. (11) and (12).

use nalgebra::DMatrix;

use super::Model;
use crate::equations::Coefficients;
use crate::error::{Error, require};
use crate::jeffcott::exact::{self, Ends, check_coefficients, sine_and_cosine_of_double};
use crate::periodic::boundary::{self, Boundary};
use crate::periodic::{FourierMatrix, PeriodicSystem};

impl Model for Coefficients {
    /// The rotor in the fixed frame at the speed Ω > 0, Eqs. (11) and (12) with q = [x, y, θ_y, θ_x], dimensionless: times in
    /// units of the inverse reference speed.
    ///
    /// Two things differ from the print: m̂_s has the entries (3,4) and (4,3), not one row, and the crack's angle is
    /// resolved, cos 2(Ωt + φ) = cos 2φ cos 2Ωt − sin 2φ sin 2Ωt.
    ///
    /// # Errors
    ///
    /// [`SystemError::OutOfRange`](crate::error::SystemError::OutOfRange) for a speed that is not positive and finite, a coefficient that is not finite or
    /// |Δ_d| ≥ 1.
    fn system(&self, speed: f64) -> Result<PeriodicSystem, Error> {
        let c = self;
        check_coefficients(c)?;
        require("speed", speed, speed > 0.0, "a positive number")?;
        let square = |rows: &[f64; 16]| DMatrix::from_row_slice(4, 4, rows);
        let (d, g) = (c.disk_asymmetry, c.beta * speed);
        #[rustfmt::skip]
        let (mass_cosine, mass_sine, gyroscopic) = (
            square(&[0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0,  -d, 0.0,
                     0.0, 0.0, 0.0,   d]),
            square(&[0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0, 0.0,   d,
                     0.0, 0.0,   d, 0.0]),
            square(&[0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0, 0.0, 0.0,
                     0.0, 0.0, 0.0,  -g,
                     0.0, 0.0,   g, 0.0]),
        );
        let (gamma, delta) = (c.gamma, c.delta);
        let (e1, e12, e2) = (c.epsilon_1, c.epsilon_12 * gamma, c.epsilon_2 * delta);
        #[rustfmt::skip]
        let (shaft, crack_cosine, crack_sine) = (
            square(&[  1.0,    0.0,    0.0, gamma,
                       0.0,    1.0, -gamma,   0.0,
                       0.0, -gamma,  delta,   0.0,
                     gamma,    0.0,    0.0, delta]),
            square(&[ e1, 0.0, 0.0, e12,
                     0.0, -e1, e12, 0.0,
                     0.0, e12, -e2, 0.0,
                     e12, 0.0, 0.0,  e2]),
            square(&[0.0,  -e1, e12,  0.0,
                     -e1,  0.0, 0.0, -e12,
                     e12,  0.0, 0.0,   e2,
                     0.0, -e12,  e2,  0.0]),
        );
        let [sine, cosine] = sine_and_cosine_of_double(c.crack_angle);
        let frequency = 2.0 * speed;
        PeriodicSystem::new(
            frequency,
            FourierMatrix::constant(DMatrix::identity(4, 4)).with_harmonic(
                1,
                mass_cosine.clone(),
                mass_sine.clone(),
            ),
            // d/dt of the varying mass.
            FourierMatrix::constant(gyroscopic).with_harmonic(
                1,
                mass_sine * frequency,
                mass_cosine * -frequency,
            ),
            FourierMatrix::constant(shaft).with_harmonic(
                1,
                &crack_cosine * cosine + &crack_sine * sine,
                crack_sine * cosine - crack_cosine * sine,
            ),
        )
    }

    /// One: the supports are isotropic, and in the frame that turns with the rotor nothing varies.
    fn harmonics(&self) -> usize {
        1
    }
}

/// The ends of an instability region by Hill's method, near to the exact ones.
///
/// # Errors
///
/// As [`boundary::confirm`].
pub fn confirm_ends(c: &Coefficients, exact: Ends) -> Result<Boundary, Error> {
    boundary::confirm(
        |speed| c.growth_rate(speed),
        exact.lower..=exact.upper,
        |speed| exact::growth_rate(c, speed),
    )
}
