//! The frequency equation Φ = 0, Eq. (22), in two forms, each well-conditioned where it is used.
//!
//! Φ(ω, Ω) is the determinant of the Hermitian matrix
//!
//! $$\begin{bmatrix} H & \gamma & b_{11} & b_{12} \\\\ \gamma & G & b_{12} & b_{22} \\\\
//!   \bar b_{11} & \bar b_{12} & \bar H & \gamma \\\\ \bar b_{12} & \bar b_{22} & \gamma & \bar G \end{bmatrix}$$
//!
//! with $b_{11} = e^{-2iφ}ε_1$, $b_{12} = e^{-2iφ}ε_{12}γ$, $b_{22} = e^{-2iφ}ε_2δ + Δ_d ω ϖ$, ϖ = 2Ω − ω.
//!
//! 1. [`phi_from_product`]: a polynomial in P = ωϖ and Ω², for the roots as a whole.
//! 2. [`Minors`]: by the identity of Desnanot and Jacobi, $D\,Φ = m_1 m_2 − |m_{12}|^2$ with a minor D of order two and
//!    three minors m of order three. Where two roots nearly meet, m₁ and m₂ are both small and each is known to
//!    rounding, so the difference keeps the digits that the expanded Eq. (22) cancels away.

use super::double_double::DoubleDouble;
use super::number::{Jet, Number, Polynomial, Size};
use crate::equations::{self, Coefficients};

/// One of the two displacements that a whirl consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Displacement {
    /// u, of the disk's centre.
    Transverse,
    /// v, the disk's tilt.
    Tilting,
}

impl Displacement {
    /// The larger one in a whirl at the frequency ω: there H u + γ v = 0 and γ u + G v = 0, so u² : v² = |G| : |H|.
    pub(super) fn dominant(c: &Coefficients, omega: f64, speed: f64) -> Self {
        let g = equations::tilting(omega, speed, c);
        let h = equations::transverse(omega);
        if g.abs() > h.abs() {
            Self::Transverse
        } else {
            Self::Tilting
        }
    }

    /// The other one.
    fn other(self) -> Self {
        match self {
            Self::Transverse => Self::Tilting,
            Self::Tilting => Self::Transverse,
        }
    }

    /// H or G, Eq. (23), at the frequency `omega`, with `reach` = βΩ − ω.
    fn diagonal<T: Number>(self, c: &Coefficients, omega: T, reach: T) -> T {
        match self {
            Self::Transverse => (omega * -1.0 + 1.0) * (omega + 1.0),
            Self::Tilting => omega * reach + c.delta,
        }
    }
}

/// The minors in $D\,Φ = m_1 m_2 − |m_{12}|^2$.
///
/// The identity holds for any row of A(ω) and any row of A(ϖ) to be kept; D is the minor of the other two. Keeping the
/// displacement that is dominant in each whirl makes D large and the m nearly linear, whatever the coupling γ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Minors<T> {
    /// m₁, zero on the branch ω of the symmetric part.
    pub(super) first: T,
    /// m₂, the same for ϖ.
    pub(super) second: T,
    /// |m₁₂|², never negative: what drives the two branches apart.
    pub(super) coupling_squared: T,
    /// D.
    pub(super) inner: T,
    /// The squared entry of B in D = (product of two diagonal entries) − (this).
    inner_coupling_squared: T,
}

impl<T: Number> Minors<T> {
    /// The minors at the frequency ϖ = `partner` and the speed `speed`, with the displacements `kept` of ω and of ϖ.
    ///
    /// ϖ is the variable because near β = 2 it is near 1 where ω is near 2Ω, and would have few digits as 2Ω − ω.
    pub(super) fn at(c: &Coefficients, kept: [Displacement; 2], partner: T, speed: T) -> Self {
        use Displacement::{Tilting, Transverse};
        let omega = speed * 2.0 - partner;
        // βΩ − ω and βΩ − ϖ, without a difference of large numbers.
        let reach = partner - speed * (2.0 - c.beta);
        let reach_bar = speed * c.beta - partner;
        let [i, j] = kept;
        let [i_other, j_other] = kept.map(Displacement::other);
        // The diagonal entries a (kept) and p (eliminated) of A(ω), and those of A(ϖ).
        let (a, p) = (
            i.diagonal(c, omega, reach),
            i_other.diagonal(c, omega, reach),
        );
        let (a_bar, p_bar) = (
            j.diagonal(c, partner, reach_bar),
            j_other.diagonal(c, partner, reach_bar),
        );

        let [sine, cosine] = sine_and_cosine_of_double(c.crack_angle);
        let disk = omega * partner * c.disk_asymmetry;
        let zero = disk * 0.0;
        // The entries of B as [real, imaginary] part.
        let entry = |row: Displacement, column: Displacement| {
            let (crack, inertia) = match (row, column) {
                (Transverse, Transverse) => (c.epsilon_1, zero),
                (Tilting, Tilting) => (c.epsilon_2 * c.delta, disk),
                _ => (c.epsilon_12 * c.gamma, zero),
            };
            [inertia + crack * cosine, zero + -crack * sine]
        };
        let (b, b_row, b_column, b_inner) = (
            entry(i, j),
            entry(i, j_other),
            entry(i_other, j),
            entry(i_other, j_other),
        );
        let inner_product = |x: [T; 2], y: [T; 2]| x[0] * y[0] + x[1] * y[1];

        let inner_coupling_squared = inner_product(b_inner, b_inner);
        let inner = p * p_bar - inner_coupling_squared;
        let gamma_squared = c.gamma * c.gamma;
        // m₁₂ = b D − γ(p̄ b_column + p b_row) + γ² b_inner + b_row b_column conj(b_inner).
        let b_product = [
            b_row[0] * b_column[0] - b_row[1] * b_column[1],
            b_row[0] * b_column[1] + b_row[1] * b_column[0],
        ];
        let through_inner = [
            b_product[0] * b_inner[0] + b_product[1] * b_inner[1],
            b_product[1] * b_inner[0] - b_product[0] * b_inner[1],
        ];
        let coupling: [T; 2] = std::array::from_fn(|part| {
            b[part] * inner - (p_bar * b_column[part] + p * b_row[part]) * c.gamma
                + b_inner[part] * gamma_squared
                + through_inner[part]
        });
        Self {
            first: p_bar * (a * p + -gamma_squared) - a * inner_coupling_squared
                + inner_product(b_inner, b_row) * (2.0 * c.gamma)
                - p * inner_product(b_row, b_row),
            second: p * (a_bar * p_bar + -gamma_squared) - a_bar * inner_coupling_squared
                + inner_product(b_inner, b_column) * (2.0 * c.gamma)
                - p_bar * inner_product(b_column, b_column),
            coupling_squared: inner_product(coupling, coupling),
            inner,
            inner_coupling_squared,
        }
    }
}

/// Whether D is more than what is left of two parts that cancel: where D is zero, D Φ says nothing of Φ.
fn is_sound(inner: f64, coupling_squared: f64) -> bool {
    inner.abs() > 0.1 * ((inner + coupling_squared).abs() + coupling_squared)
}

impl Minors<Jet> {
    /// Whether the zeros of D Φ here are those of Φ.
    pub(super) fn are_sound(&self) -> bool {
        is_sound(self.inner.value, self.inner_coupling_squared.value)
    }
}

/// sin 2φ and cos 2φ, also where 2φ overflows.
pub(crate) fn sine_and_cosine_of_double(angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [2.0 * sine * cosine, (cosine - sine) * (cosine + sine)]
}

/// cos 2φ in the digits of `T`, from whichever of sin φ and cos φ is the smaller: their rounding then is that of the angle.
fn cosine_of_double<T: Number>(angle: f64, number: impl Fn(f64) -> T) -> T {
    let (sine, cosine) = angle.sin_cos();
    if sine.abs() < cosine.abs() {
        number(sine) * number(sine) * -2.0 + 1.0
    } else {
        number(cosine) * number(cosine) * 2.0 + -1.0
    }
}

/// Φ from Ω² and the product P = ωϖ = Ω² − (ω − Ω)²: Eq. (22) as printed, in the products that are symmetric in ω and ϖ,
/// each a polynomial in P and Ω² because ω + ϖ = 2Ω. Holds where ω is not real, too.
///
/// Near β = 2 the combination region lies at a high speed, with ω near 2Ω and ϖ near 1. All four roots (ω − Ω)² are then
/// Ω² but for the last digits, while their P differ as much as the whirls do. There β enters as 2 − β, which a number
/// near 2 has with all digits.
pub(super) fn phi_from_product<T: Number>(c: &Coefficients, speed_squared: T, product: T) -> T {
    let number = |value: f64| product.constant(value);
    let [beta, delta, e1] = [c.beta, c.delta, c.epsilon_1].map(number);
    let gamma_squared = number(c.gamma) * number(c.gamma);
    let e12_gamma_squared = number(c.epsilon_12) * gamma_squared;
    let e2_delta = number(c.epsilon_2) * delta;
    let slack = beta * -1.0 + 2.0;

    let h_h_bar = (product + 1.0) * (product + 1.0) - speed_squared * 4.0;
    let g_sum = (product - slack * speed_squared + delta) * 2.0; // G + Ḡ
    let h_sum = (product - speed_squared * 2.0 + 1.0) * 2.0; // H + H̄
    let g_g_bar = product * (product - beta * slack * speed_squared) + delta * (g_sum - delta);
    // HḠ + H̄G and HG + H̄Ḡ.
    let either = delta * 2.0
        + (delta + 1.0) * (product * 2.0 - speed_squared * 4.0)
        + beta * speed_squared * 2.0;
    let crossed = either + product * (product - beta * speed_squared) * 2.0;
    let straight = either
        + slack * speed_squared * (speed_squared * 8.0 - product * 6.0)
        + product * (product * 2.0 - speed_squared * 4.0);
    let f_f_bar = h_h_bar * g_g_bar + gamma_squared * (gamma_squared - straight);

    let e12_gamma_squares = number(c.epsilon_12) * e12_gamma_squared; // (ε₁₂γ)²
    let sigma = e1 * e2_delta - e12_gamma_squares; // Σ₁
    let disk = product * number(c.disk_asymmetry);
    let against_disk =
        e12_gamma_squared * h_sum - e2_delta * h_h_bar + e1 * (sigma - gamma_squared); // Σ₁ε₁ − Θ₁
    f_f_bar - e1 * e1 * g_g_bar - e12_gamma_squares * crossed - e2_delta * e2_delta * h_h_bar
        + e12_gamma_squared * (e1 * g_sum + e2_delta * h_sum) * 2.0
        + disk * disk * (e1 * e1 - h_h_bar)
        + disk * against_disk * cosine_of_double(c.crack_angle, number) * 2.0
        + sigma * sigma
        - (e1 * e2_delta + e12_gamma_squares) * gamma_squared * 2.0
}

/// The coefficients of Φ in powers of P = ωϖ at a speed, lowest first; the last one is 1 − Δ_d².
pub(super) fn quartic_coefficients(c: &Coefficients, speed: f64) -> [DoubleDouble; 5] {
    let speed = DoubleDouble::from(speed);
    let speed_squared = Polynomial::of(speed * speed);
    phi_from_product(c, speed_squared, Polynomial::variable()).0
}

/// The coefficients of Φ(Ω, Ω) in powers of Ω², lowest first: its zeros are the ends of the simple regions.
pub(super) fn simple_coefficients(c: &Coefficients) -> [DoubleDouble; 5] {
    let variable = Polynomial::variable();
    phi_from_product(c, variable, variable).0
}

/// The sum of the sizes of all terms of Φ(Ω, Ω) at a squared speed.
pub(super) fn simple_size(c: &Coefficients, speed_squared: f64) -> f64 {
    phi_from_product(c, Size(speed_squared), Size(speed_squared)).0
}

#[cfg(test)]
mod tests {
    use nalgebra::{Complex, Matrix4};

    use super::*;

    /// Φ as the determinant of the Hermitian matrix of the module's text.
    fn phi_as_determinant(c: &Coefficients, omega: f64, speed: f64) -> f64 {
        let partner = 2.0 * speed - omega;
        let real = |x| Complex::new(x, 0.0);
        let turn = Complex::from_polar(1.0, -2.0 * c.crack_angle);
        let (b11, b12) = (turn * c.epsilon_1, turn * (c.epsilon_12 * c.gamma));
        let b22 = turn * (c.epsilon_2 * c.delta) + c.disk_asymmetry * omega * partner;
        let h = |w: f64| real(1.0 - w * w);
        let g = |w: f64| real(c.delta - w * w + c.beta * speed * w);
        let gamma = real(c.gamma);
        #[rustfmt::skip]
        let matrix = Matrix4::new(
            h(omega), gamma, b11, b12,
            gamma, g(omega), b12, b22,
            b11.conj(), b12.conj(), h(partner), gamma,
            b12.conj(), b22.conj(), gamma, g(partner),
        );
        matrix.determinant().re
    }

    /// Rotors at pseudo-random places of the ranges that occur, and a frequency and a speed for each.
    fn samples() -> impl Iterator<Item = (Coefficients, f64, f64)> {
        let mut state = 1_u64;
        let mut between = move |low: f64, high: f64| {
            // Knuth's linear congruential generator.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..500).map(move |_| {
            let c = Coefficients {
                beta: between(0.3, 2.0),
                gamma: between(-2.0, 2.0),
                delta: between(0.5, 6.0),
                epsilon_1: between(-0.4, 0.4),
                epsilon_12: between(-0.4, 0.4),
                epsilon_2: between(-0.4, 0.4),
                disk_asymmetry: between(-0.5, 0.5),
                crack_angle: between(-4.0, 4.0),
            };
            (c, between(0.1, 5.0), between(0.1, 3.0))
        })
    }

    #[test]
    fn all_forms_are_the_determinant() {
        for (c, omega, speed) in samples() {
            let expected = phi_as_determinant(&c, omega, speed);
            // Rounding of the determinant's largest product.
            let tolerance = 1e-12 * (1.0 + omega + speed).powi(8);
            let product = omega * (2.0 * speed - omega);
            let by_product = phi_from_product(&c, speed * speed, product);
            assert!(
                (by_product - expected).abs() < tolerance,
                "{c:?} {omega} {speed}"
            );
            let powers = quartic_coefficients(&c, speed).map(DoubleDouble::rounded);
            let by_powers = powers.iter().rev().fold(0.0, |sum, a| sum * product + a);
            assert!(
                (by_powers - expected).abs() < tolerance,
                "{c:?} {omega} {speed}"
            );
        }
    }

    #[test]
    fn the_quartic_starts_with_one_less_the_squared_asymmetry() {
        for (c, _, speed) in samples() {
            let leading = quartic_coefficients(&c, speed)[4].rounded();
            assert!((leading - (1.0 - c.disk_asymmetry.powi(2))).abs() < 1e-15);
        }
    }

    #[test]
    fn the_minors_obey_jacobis_identity_whichever_rows_are_kept() {
        use Displacement::{Tilting, Transverse};
        for (c, omega, speed) in samples() {
            let expected = phi_as_determinant(&c, omega, speed);
            for first in [Transverse, Tilting] {
                for second in [Transverse, Tilting] {
                    let minors = Minors::at(&c, [first, second], 2.0 * speed - omega, speed);
                    let product = minors.first * minors.second;
                    let found = product - minors.coupling_squared;
                    let size =
                        product.abs() + minors.coupling_squared + (minors.inner * expected).abs();
                    let tolerance =
                        1e-12 * (1.0 + omega + speed).powi(8) * (1.0 + minors.inner.abs())
                            + 1e-12 * size;
                    assert!(
                        (found - minors.inner * expected).abs() < tolerance,
                        "{c:?} {omega} {speed}"
                    );
                }
            }
        }
    }

    #[test]
    fn jets_carry_the_derivatives() {
        let step = 1e-5;
        for (c, x, y) in samples().take(50) {
            let phi = |x: f64, y: f64| phi_from_product(&c, y, x);
            let [jet_x, jet_y] = Jet::variables(x, y);
            let jet = phi_from_product(&c, jet_y, jet_x);
            let slope = |x: f64, y: f64| (phi(x + step, y) - phi(x - step, y)) / (2.0 * step);
            let size = 1e-4 * (1.0 + x + y).powi(4) * (1.0 + c.delta).powi(2);
            assert!((jet.value - phi(x, y)).abs() < 1e-12 * size * 1e4);
            assert!((jet.x - slope(x, y)).abs() < size);
            assert!((jet.y - (phi(x, y + step) - phi(x, y - step)) / (2.0 * step)).abs() < size);
            assert!(
                (jet.xx - (slope(x + step, y) - slope(x - step, y)) / (2.0 * step)).abs() < size
            );
            assert!(
                (jet.xy - (slope(x, y + step) - slope(x, y - step)) / (2.0 * step)).abs() < size
            );
        }
    }
}
