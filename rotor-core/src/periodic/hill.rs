//! Hill's method, Eqs. (33)–(40): the exponents of a periodic system from one constant eigenproblem.
//!
//! With q = e^{μt} Σ q_k e^{ikνt}, |k| ≤ h, and λ_k = μ + ikν, the harmonic k of the equation of motion reads
//! Σ_l (λ_l² M_{k−l} + λ_l C_{k−l} + K_{k−l}) q_l = 0, where the indices of the matrices, from −K to K for matrices with
//! K harmonics, are those of their Fourier coefficients: a matrix of blocks with K bands on each side of its diagonal. (E11: in Eq. (40) the factor k of λ_k must be that of the harmonic that the matrix multiplies, l here.)
//! It is quadratic in μ and becomes a standard eigenproblem of twice the size.
//!
//! **Which eigenvalues count.** The untruncated problem has each exponent again as μ + imν for every whole m, with the
//! eigenvector shifted by m harmonics. Truncation damages those copies whose eigenvectors reach the outermost
//! harmonics: the equations it drops are those for h < |k| ≤ h + K, and their residual is the outermost q_k times coupling
//! matrices.
//! So the sound copies are the central ones, not those with an imaginary part in a certain strip (the dominant
//! harmonic of a fast whirl is far from the strip at a low speed). The centre Σ k|q_k|² / Σ|q_k|² moves by one from
//! copy to copy, hence each exponent has a copy with a centre within ±1/2, and only those are kept.
//!
//! Mathieu's equation y'' + (a − 2q cos 2t) y = 0 grows by about q/2 in the middle of its first region, a = 1:
//!
//! ```
//! use nalgebra::DMatrix;
//! use rotor_core::periodic::{FourierMatrix, PeriodicSystem, hill};
//!
//! let number = |x| DMatrix::from_element(1, 1, x);
//! let q = 0.1;
//! let stiffness = FourierMatrix::constant(number(1.0)).with_harmonic(1, number(-2.0 * q), number(0.0));
//! let system = PeriodicSystem::new(2.0, number(1.0), number(0.0), stiffness)?;
//! let growth = hill::growth_rate(&system, 8)?;
//! assert!((growth - 0.5 * q).abs() < 1e-3);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::system::PeriodicSystem;
use crate::error::{Error, SystemError, require};

/// How far from 0 the centre of a kept copy may lie: one half, and room for what truncation moves.
const CENTRAL: f64 = 0.6;

/// The largest entry of an eigenvector that is not scaled down. In a chain of equal eigenvalues each entry may be 1/epsilon times
/// the one before; from this size on a few more leave the squares of entries within the range of doubles.
const LARGEST: f64 = 1e100;

/// More than any system needs: the matrix of a rotor with four degrees of freedom then takes 4 GB.
const MOST_HARMONICS: usize = 1000;

/// The greatest real part of the exponents of `system` with `harmonics` on each side of zero, in the inverse of the
/// system's unit of time. Negative where every motion decays; of an undamped stable system rounding leaves about
/// ±1e-13.
///
/// A rotor on isotropic supports needs one harmonic; with none it would lose the instability. Other systems: no less than
/// their [order](PeriodicSystem::order), and more until the answer stays. The work grows with the cube of
/// n (2·harmonics + 1).
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for zero harmonics or more than 1000, [`SystemError::SingularMass`],
/// [`SystemError::NoConvergence`] if the Schur decomposition stops at its cap.
pub fn growth_rate(system: &PeriodicSystem, harmonics: usize) -> Result<f64, Error> {
    let growth = central_exponents(system, harmonics)?
        .iter()
        .map(|exponent| exponent.re)
        .fold(f64::NEG_INFINITY, f64::max);
    Ok(require(
        "the greatest real part of the central exponents",
        growth,
        true,
        "a finite number; use more harmonics",
    )?)
}

/// The exponents μ with central eigenvectors, in no particular order; at resonance an exponent may appear with two of
/// its copies, which differ by the system's frequency in the imaginary part.
///
/// # Errors
///
/// As [`growth_rate`].
pub fn central_exponents(
    system: &PeriodicSystem,
    harmonics: usize,
) -> Result<Vec<Complex<f64>>, Error> {
    require(
        "the number of harmonics",
        harmonics as f64,
        (1..=MOST_HARMONICS).contains(&harmonics),
        "1 to 1000",
    )?;
    let companion = companion_matrix(system, harmonics)?;
    let size = companion.nrows();
    let cap = 100 * size;
    let schur = Schur::try_new(companion, f64::EPSILON, cap).ok_or(SystemError::NoConvergence {
        what: "the Schur form of Hill's matrix",
        iterations: cap,
    })?;
    let (unitary, triangular) = schur.unpack();
    let displacements = unitary.rows(0, size / 2);
    let mut exponents = Vec::with_capacity(2 * system.degrees_of_freedom());
    for index in 0..size {
        let vector =
            displacements.columns(0, index + 1) * triangular_eigenvector(&triangular, index);
        if center(&vector, harmonics).abs() <= CENTRAL {
            exponents.push(triangular[(index, index)]);
        }
    }
    Ok(exponents)
}

/// The companion form [[0, ωI], [−P₂⁻¹P₀/ω, −P₂⁻¹P₁]] of (μ²P₂ + μP₁ + P₀) q = 0, Eq. (40), in (q, μq/ω).
///
/// ω is the power of two next to √‖P₂⁻¹P₀‖. All blocks have its size then: the Schur decomposition loses digits of the
/// matrix's norm, which is ω² without it.
fn companion_matrix(
    system: &PeriodicSystem,
    harmonics: usize,
) -> Result<DMatrix<Complex<f64>>, Error> {
    let n = system.degrees_of_freedom();
    let blocks = 2 * harmonics + 1;
    let half = n * blocks;
    let order = system.order().min(2 * harmonics);
    let [mass, damping, stiffness] = system.matrices().map(|matrix| matrix.coefficients(order));
    let mut quadratic = DMatrix::zeros(half, half);
    // −P₀ and −P₁ side by side.
    let mut lower = DMatrix::zeros(half, 2 * half);
    for column in 0..blocks {
        let rate = Complex::new(0.0, (column as f64 - harmonics as f64) * system.frequency());
        for row in column.saturating_sub(order)..blocks.min(column + order + 1) {
            let index = row + order - column;
            let (m, c, k) = (&mass[index], &damping[index], &stiffness[index]);
            let (at_row, at_column) = (n * row, n * column);
            quadratic.view_mut((at_row, at_column), (n, n)).copy_from(m);
            let constant = m * (-rate * rate) - c * rate - k;
            lower
                .view_mut((at_row, at_column), (n, n))
                .copy_from(&constant);
            let linear = m * (rate * -2.0) - c;
            lower
                .view_mut((at_row, half + at_column), (n, n))
                .copy_from(&linear);
        }
    }
    let solved = quadratic
        .lu()
        .solve(&lower)
        .ok_or(SystemError::SingularMass { time: 0.0 })?;
    let square = solved
        .columns(0, half)
        .iter()
        .map(|entry| entry.norm())
        .fold(0.0, f64::max);
    // Without stiffness there is nothing to balance.
    let scale = if square > 0.0 {
        (0.5 * square.log2()).round().exp2()
    } else {
        1.0
    };
    let mut companion = DMatrix::zeros(2 * half, 2 * half);
    companion
        .view_mut((0, half), (half, half))
        .fill_diagonal(Complex::new(scale, 0.0));
    companion.rows_mut(half, half).copy_from(&solved);
    companion
        .view_mut((half, 0), (half, half))
        .iter_mut()
        .for_each(|entry| *entry /= scale);
    Ok(companion)
}

/// The eigenvector of the upper triangular matrix for its diagonal entry `index`, of length `index + 1`, by back
/// substitution.
fn triangular_eigenvector(
    triangular: &DMatrix<Complex<f64>>,
    index: usize,
) -> DVector<Complex<f64>> {
    let eigenvalue = triangular[(index, index)];
    // A repeated eigenvalue is parted by rounding's size, as is usual: the vector stays one of the nearby matrix.
    let smallest = f64::EPSILON * (1.0 + eigenvalue.norm());
    let mut vector = DVector::zeros(index + 1);
    vector[index] = Complex::new(1.0, 0.0);
    for row in (0..index).rev() {
        let known = (row + 1..=index).fold(Complex::new(0.0, 0.0), |sum, column| {
            sum + triangular[(row, column)] * vector[column]
        });
        let difference = eigenvalue - triangular[(row, row)];
        let divisor = if difference.norm() < smallest {
            Complex::new(smallest, 0.0)
        } else {
            difference
        };
        vector[row] = known / divisor;
        let size = vector[row].norm();
        if size > LARGEST {
            vector /= Complex::new(size, 0.0);
        }
    }
    vector
}

/// The mean harmonic of an eigenvector, weighted with |q_k|².
fn center(vector: &DVector<Complex<f64>>, harmonics: usize) -> f64 {
    let degrees_of_freedom = vector.len() / (2 * harmonics + 1);
    let (mut weight, mut moment) = (0.0, 0.0);
    for (position, entry) in vector.iter().enumerate() {
        let harmonic = (position / degrees_of_freedom) as f64 - harmonics as f64;
        weight += entry.norm_sqr();
        moment += harmonic * entry.norm_sqr();
    }
    moment / weight
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_chain_of_equal_eigenvalues_does_not_overflow() {
        const LENGTH: usize = 40;
        let is_chained = |row: usize, column: usize| row == column || row + 1 == column;
        let chain = DMatrix::from_fn(LENGTH, LENGTH, |row, column| {
            Complex::new(f64::from(is_chained(row, column)), 0.0)
        });
        // It has one eigenvector, the first unit vector.
        let vector = triangular_eigenvector(&chain, LENGTH - 1);
        let first = vector[0].norm();
        let rest = vector.rows(1, LENGTH - 1).norm();
        assert!(first.is_finite() && rest <= 1e-15 * first, "{first} {rest}");
    }
}
