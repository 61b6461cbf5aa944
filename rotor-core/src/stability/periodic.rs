//! Linear systems whose matrices carry one harmonic.

use nalgebra::{Complex, DMatrix};

use super::error::{StabilityError, check_coefficients, require};
use super::frequency_equation::sine_and_cosine_of_double;
use crate::equations::Coefficients;

/// A square matrix that varies as constant + cosine · cos ϑ + sine · sin ϑ, with ϑ = frequency × time.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonic {
    /// The mean.
    pub constant: DMatrix<f64>,
    /// The amplitude of cos ϑ.
    pub cosine: DMatrix<f64>,
    /// The amplitude of sin ϑ.
    pub sine: DMatrix<f64>,
}

impl Harmonic {
    /// A matrix that does not vary.
    #[must_use]
    pub fn constant(matrix: DMatrix<f64>) -> Self {
        let zero = DMatrix::zeros(matrix.nrows(), matrix.ncols());
        Self {
            constant: matrix,
            cosine: zero.clone(),
            sine: zero,
        }
    }

    /// The matrix at the angle ϑ.
    #[must_use]
    pub(super) fn at(&self, angle: f64) -> DMatrix<f64> {
        let (sine, cosine) = angle.sin_cos();
        &self.constant + &self.cosine * cosine + &self.sine * sine
    }

    /// The complex Fourier coefficients of e^{−iϑ}, 1 and e^{iϑ}.
    pub(super) fn fourier(&self) -> [DMatrix<Complex<f64>>; 3] {
        let up = self.cosine.zip_map(&self.sine, |cosine, sine| {
            Complex::new(0.5 * cosine, -0.5 * sine)
        });
        [
            up.map(|x| x.conj()),
            self.constant.map(|x| Complex::new(x, 0.0)),
            up,
        ]
    }
}

/// M(t) q̈ + C(t) q̇ + K(t) q = 0 with n degrees of freedom, all three matrices with the same angular frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicSystem {
    frequency: f64,
    mass: Harmonic,
    damping: Harmonic,
    stiffness: Harmonic,
}

impl PeriodicSystem {
    /// A system of n × n matrices that vary with the angular `frequency` > 0; `damping` has the gyroscopic terms too.
    ///
    /// # Errors
    ///
    /// [`StabilityError::OutOfRange`] for a frequency that is not positive and finite or a matrix with a number that is
    /// not finite, [`StabilityError::Shape`] where the matrices do not have one square shape.
    pub fn new(
        frequency: f64,
        mass: Harmonic,
        damping: Harmonic,
        stiffness: Harmonic,
    ) -> Result<Self, StabilityError> {
        require("frequency", frequency, frequency > 0.0, "a positive number")?;
        let expected = mass.constant.nrows().max(1);
        for (name, harmonic) in [
            ("mass", &mass),
            ("damping", &damping),
            ("stiffness", &stiffness),
        ] {
            for matrix in [&harmonic.constant, &harmonic.cosine, &harmonic.sine] {
                let (rows, columns) = matrix.shape();
                if rows != expected || columns != expected {
                    return Err(StabilityError::Shape {
                        matrix: name,
                        rows,
                        columns,
                        expected,
                    });
                }
                if let Some(bad) = matrix.iter().find(|x| !x.is_finite()) {
                    require("a matrix entry", *bad, false, "a finite number")?;
                }
            }
        }
        Ok(Self {
            frequency,
            mass,
            damping,
            stiffness,
        })
    }

    /// The rotor in the fixed frame at the speed Ω > 0, Eqs. (11) and (12) with q = [x, y, θ_y, θ_x], dimensionless.
    ///
    /// Two things differ from the print: m̂_s has the entries (3,4) and (4,3), not one row, and the crack's angle is
    /// resolved, cos 2(Ωt + φ) = cos 2φ cos 2Ωt − sin 2φ sin 2Ωt.
    ///
    /// # Errors
    ///
    /// [`StabilityError::OutOfRange`] for a speed that is not positive and finite, a coefficient that is not finite or
    /// |Δ_d| ≥ 1.
    pub fn rotor(c: &Coefficients, speed: f64) -> Result<Self, StabilityError> {
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
        Self::new(
            frequency,
            Harmonic {
                constant: DMatrix::identity(4, 4),
                cosine: mass_cosine.clone(),
                sine: mass_sine.clone(),
            },
            // d/dt of the varying mass.
            Harmonic {
                constant: gyroscopic,
                cosine: mass_sine * frequency,
                sine: mass_cosine * -frequency,
            },
            Harmonic {
                constant: shaft,
                cosine: &crack_cosine * cosine + &crack_sine * sine,
                sine: crack_sine * cosine - crack_cosine * sine,
            },
        )
    }

    /// The angular frequency of the matrices.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// The period 2π/frequency of the matrices.
    #[must_use]
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.frequency
    }

    /// The number of degrees of freedom n.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.mass.constant.nrows()
    }

    /// M, C and K.
    pub(super) fn matrices(&self) -> [&Harmonic; 3] {
        [&self.mass, &self.damping, &self.stiffness]
    }

    /// [−M⁻¹K, −M⁻¹C] at a time: the lower half (n × 2n) of the state matrix of [q; q̇].
    pub(super) fn acceleration_matrix(&self, time: f64) -> Result<DMatrix<f64>, StabilityError> {
        let n = self.degrees_of_freedom();
        let angle = self.frequency * time;
        let mut forces = DMatrix::zeros(n, 2 * n);
        forces
            .columns_mut(0, n)
            .copy_from(&self.stiffness.at(angle));
        forces.columns_mut(n, n).copy_from(&self.damping.at(angle));
        forces.neg_mut();
        self.mass
            .at(angle)
            .lu()
            .solve(&forces)
            .ok_or(StabilityError::SingularMass { time })
    }
}
