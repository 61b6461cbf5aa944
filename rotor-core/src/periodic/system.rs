//! Linear systems whose matrices carry one harmonic.

use nalgebra::{Complex, DMatrix};

use crate::error::{StabilityError, require};

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
