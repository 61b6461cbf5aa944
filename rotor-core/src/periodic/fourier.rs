//! Matrices that repeat: a mean and any number of harmonics.

use nalgebra::{Complex, DMatrix};

/// A matrix that varies with the angle ϑ as A₀ + Σ (Aₖ cos kϑ + Bₖ sin kϑ).
///
/// ```
/// use nalgebra::DMatrix;
/// use rotor_core::periodic::FourierMatrix;
///
/// let number = |x| DMatrix::from_element(1, 1, x);
/// // 3 − 2 cos ϑ + sin 4ϑ
/// let matrix = FourierMatrix::constant(number(3.0))
///     .with_harmonic(1, number(-2.0), number(0.0))
///     .with_harmonic(4, number(0.0), number(1.0));
/// assert_eq!(matrix.order(), 4);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FourierMatrix {
    constant: DMatrix<f64>,
    harmonics: Vec<Harmonic>,
}

/// What varies k times while the angle goes round once.
#[derive(Clone, Debug, PartialEq)]
struct Harmonic {
    /// k.
    order: usize,
    /// The amplitude of cos kϑ.
    cosine: DMatrix<f64>,
    /// The amplitude of sin kϑ.
    sine: DMatrix<f64>,
}

impl Harmonic {
    fn is_zero(&self) -> bool {
        self.cosine.iter().chain(&self.sine).all(|&x| x == 0.0)
    }
}

impl FourierMatrix {
    /// A matrix that does not vary.
    #[must_use]
    pub const fn constant(matrix: DMatrix<f64>) -> Self {
        Self {
            constant: matrix,
            harmonics: Vec::new(),
        }
    }

    /// The matrix plus cosine · cos kϑ + sine · sin kϑ, k being the `order`. An order that is there already adds to it; that
    /// of order 0 adds the cosine's amplitude to the mean.
    ///
    /// Whether all amplitudes have one square shape is checked where a [`PeriodicSystem`](super::PeriodicSystem) is made.
    #[must_use]
    pub fn with_harmonic(mut self, order: usize, cosine: DMatrix<f64>, sine: DMatrix<f64>) -> Self {
        self.harmonics.push(Harmonic {
            order,
            cosine,
            sine,
        });
        self
    }

    /// The order of the highest harmonic that is not zero; 0 of a matrix that does not vary.
    #[must_use]
    pub fn order(&self) -> usize {
        let harmonics = self.harmonics.iter();
        let varying = harmonics.filter(|harmonic| !harmonic.is_zero());
        varying.map(|harmonic| harmonic.order).max().unwrap_or(0)
    }

    /// The number of rows of the mean.
    pub(super) fn size(&self) -> usize {
        self.constant.nrows()
    }

    /// The mean and all amplitudes.
    pub(super) fn amplitudes(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        let harmonics = self.harmonics.iter();
        let varying = harmonics.flat_map(|harmonic| [&harmonic.cosine, &harmonic.sine]);
        std::iter::once(&self.constant).chain(varying)
    }

    /// The matrix with its mean and its amplitudes changed by a linear map, where each has an image.
    pub(super) fn mapped(
        &self,
        map: impl Fn(&DMatrix<f64>) -> Option<DMatrix<f64>>,
    ) -> Option<Self> {
        let mut mapped = Self::constant(map(&self.constant)?);
        for harmonic in &self.harmonics {
            mapped =
                mapped.with_harmonic(harmonic.order, map(&harmonic.cosine)?, map(&harmonic.sine)?);
        }
        Some(mapped)
    }

    /// The matrix at the angle ϑ.
    pub(super) fn at(&self, angle: f64) -> DMatrix<f64> {
        let mut matrix = self.constant.clone();
        for harmonic in &self.harmonics {
            let (sine, cosine) = (harmonic.order as f64 * angle).sin_cos();
            let amplitudes = harmonic.cosine.iter().zip(&harmonic.sine);
            for (entry, (along_cosine, along_sine)) in matrix.iter_mut().zip(amplitudes) {
                *entry = *entry + along_cosine * cosine + along_sine * sine;
            }
        }
        matrix
    }

    /// The complex Fourier coefficients of e^{ikϑ} for k from −`order` to `order`, which may be less or more than the
    /// matrix has.
    pub(super) fn coefficients(&self, order: usize) -> Vec<DMatrix<Complex<f64>>> {
        let size = self.size();
        let mut coefficients = vec![DMatrix::zeros(size, size); 2 * order + 1];
        coefficients[order] += self.constant.map(|x| Complex::new(x, 0.0));
        for harmonic in &self.harmonics {
            if harmonic.order <= order {
                let up = harmonic
                    .cosine
                    .zip_map(&harmonic.sine, |c, s| Complex::new(0.5 * c, -0.5 * s));
                coefficients[order - harmonic.order] += up.map(|x| x.conj());
                coefficients[order + harmonic.order] += up;
            }
        }
        coefficients
    }
}

impl From<DMatrix<f64>> for FourierMatrix {
    /// A matrix that does not vary.
    fn from(matrix: DMatrix<f64>) -> Self {
        Self::constant(matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(x: f64) -> DMatrix<f64> {
        DMatrix::from_element(1, 1, x)
    }

    #[test]
    fn a_matrix_is_the_sum_of_its_fourier_coefficients() {
        let matrix = FourierMatrix::constant(number(3.0))
            .with_harmonic(3, number(0.5), number(-4.0))
            .with_harmonic(0, number(2.0), number(7.0))
            .with_harmonic(1, number(-2.0), number(1.0))
            .with_harmonic(3, number(0.25), number(0.0));
        for angle in [0.0, 0.3, -2.0, 5.0] {
            let coefficients = matrix.coefficients(4);
            let sum: Complex<f64> = (-4..=4)
                .zip(&coefficients)
                .map(|(k, c)| c[(0, 0)] * Complex::from_polar(1.0, f64::from(k) * angle))
                .sum();
            let by_hand = 5.0 - 2.0 * angle.cos() + angle.sin() + 0.75 * (3.0 * angle).cos()
                - 4.0 * (3.0 * angle).sin();
            assert!((sum.re - by_hand).abs() < 1e-14 && sum.im.abs() < 1e-14);
            assert!((matrix.at(angle)[(0, 0)] - by_hand).abs() < 1e-14);
        }
    }

    #[test]
    fn a_harmonic_of_zeros_is_none() {
        let matrix =
            FourierMatrix::constant(number(1.0)).with_harmonic(2, number(0.0), number(0.0));
        assert_eq!(matrix.order(), 0);
        assert_eq!(matrix.with_harmonic(1, number(0.0), number(1.0)).order(), 1);
    }
}
