//! Linear systems of second order whose matrices repeat.

use nalgebra::DMatrix;

use super::fourier::FourierMatrix;
use crate::error::{Error, SystemError, require};

/// M(t) q̈ + C(t) q̇ + K(t) q = 0 with n degrees of freedom, all three matrices with the same angular frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicSystem {
    frequency: f64,
    mass: FourierMatrix,
    damping: FourierMatrix,
    stiffness: FourierMatrix,
}

impl PeriodicSystem {
    /// A system of n × n matrices that vary with the angular `frequency` > 0 and its multiples; `damping` has the
    /// gyroscopic terms too. A matrix that does not vary is given as it is.
    ///
    /// # Errors
    ///
    /// [`SystemError::OutOfRange`] for a frequency that is not positive and finite or a matrix with a number that is
    /// not finite, [`SystemError::Shape`] where the matrices do not have one square shape.
    pub fn new(
        frequency: f64,
        mass: impl Into<FourierMatrix>,
        damping: impl Into<FourierMatrix>,
        stiffness: impl Into<FourierMatrix>,
    ) -> Result<Self, Error> {
        require("frequency", frequency, frequency > 0.0, "a positive number")?;
        let system = Self {
            frequency,
            mass: mass.into(),
            damping: damping.into(),
            stiffness: stiffness.into(),
        };
        let expected = system.degrees_of_freedom().max(1);
        for (name, matrix) in [
            ("mass", &system.mass),
            ("damping", &system.damping),
            ("stiffness", &system.stiffness),
        ] {
            for amplitude in matrix.amplitudes() {
                let (rows, columns) = amplitude.shape();
                if rows != expected || columns != expected {
                    return Err(SystemError::Shape {
                        matrix: name,
                        rows,
                        columns,
                        expected,
                    }
                    .into());
                }
                if let Some(bad) = amplitude.iter().find(|x| !x.is_finite()) {
                    require("a matrix entry", *bad, false, "a finite number")?;
                }
            }
        }
        Ok(system)
    }

    /// The angular frequency of the matrices.
    #[must_use]
    pub const fn frequency(&self) -> f64 {
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
        self.mass.size()
    }

    /// The order of the highest harmonic of the three matrices.
    #[must_use]
    pub fn order(&self) -> usize {
        let [mass, damping, stiffness] = self.matrices().map(FourierMatrix::order);
        mass.max(damping).max(stiffness)
    }

    /// M, C and K.
    pub(super) const fn matrices(&self) -> [&FourierMatrix; 3] {
        [&self.mass, &self.damping, &self.stiffness]
    }

    /// What gives the accelerations.
    ///
    /// # Errors
    ///
    /// [`SystemError::SingularMass`] where the mass does not vary and cannot be inverted.
    pub(super) fn accelerations(&self) -> Result<Accelerations<'_>, Error> {
        if self.mass.order() > 0 {
            return Ok(Accelerations::VaryingMass(self));
        }
        let mass = self.mass.at(0.0).lu();
        let over_mass = |matrix: &FourierMatrix| {
            matrix
                .mapped(|amplitude| mass.solve(amplitude))
                .ok_or(SystemError::SingularMass { time: 0.0 })
        };
        Ok(Accelerations::SteadyMass {
            frequency: self.frequency,
            damping: over_mass(&self.damping)?,
            stiffness: over_mass(&self.stiffness)?,
        })
    }
}

/// The accelerations of a system, as a matrix times [q; q̇].
pub(super) enum Accelerations<'a> {
    /// Where the mass does not vary it is factored once, and M⁻¹C and M⁻¹K have the harmonics of C and K.
    SteadyMass {
        /// The angular frequency of the matrices.
        frequency: f64,
        /// M⁻¹C.
        damping: FourierMatrix,
        /// M⁻¹K.
        stiffness: FourierMatrix,
    },
    /// Where it varies it is factored at every time.
    VaryingMass(&'a PeriodicSystem),
}

impl Accelerations<'_> {
    /// [−M⁻¹K, −M⁻¹C] at a time: the lower half (n × 2n) of the state matrix of [q; q̇].
    ///
    /// # Errors
    ///
    /// [`SystemError::SingularMass`] at this time.
    pub(super) fn at(&self, time: f64) -> Result<DMatrix<f64>, Error> {
        let (frequency, damping, stiffness) = match self {
            Self::SteadyMass {
                frequency,
                damping,
                stiffness,
            } => (*frequency, damping, stiffness),
            Self::VaryingMass(system) => (system.frequency, &system.damping, &system.stiffness),
        };
        let (n, angle) = (stiffness.size(), frequency * time);
        let mut matrix = DMatrix::zeros(n, 2 * n);
        matrix.columns_mut(0, n).copy_from(&stiffness.at(angle));
        matrix.columns_mut(n, n).copy_from(&damping.at(angle));
        matrix.neg_mut();
        if let Self::VaryingMass(system) = self
            && !system.mass.at(angle).lu().solve_mut(&mut matrix)
        {
            return Err(SystemError::SingularMass { time }.into());
        }
        Ok(matrix)
    }
}
