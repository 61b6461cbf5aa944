//! The frequency equation Φ = 0, Eq. (22), in three forms, each well-conditioned where it is used.
//!
//! Φ(ω, Ω) is the determinant of the Hermitian matrix
//!
//! $$\begin{bmatrix} H & \gamma & b_{11} & b_{12} \\\\ \gamma & G & b_{12} & b_{22} \\\\
//!   \bar b_{11} & \bar b_{12} & \bar H & \gamma \\\\ \bar b_{12} & \bar b_{22} & \gamma & \bar G \end{bmatrix}$$
//!
//! with $b_{11} = e^{-2iφ}ε_1$, $b_{12} = e^{-2iφ}ε_{12}γ$, $b_{22} = e^{-2iφ}ε_2δ + Δ_d ω ϖ$, ϖ = 2Ω − ω.
//!
//! 1. [`phi_from_squares`]: a polynomial in S = (ω − Ω)² and Ω², for the roots as a whole.
//! 2. [`static_determinant`]: S = 0, where the matrix is real in the rotor's frame: one root passes zero at a SIR's end.
//! 3. [`Minors`]: by the identity of Desnanot and Jacobi, $D\,Φ = m_1 m_2 − |m_{12}|^2$ with a minor D of order two and
//!    three minors m of order three. Where two roots nearly meet, m₁ and m₂ are both small and each is known to
//!    rounding, so the difference keeps the digits that the expanded Eq. (22) cancels away.

use std::ops::{Add, Mul, Sub};

use nalgebra::Complex;

use crate::equations::Coefficients;

/// What a closed form needs of its numbers, so that it stands once for values and for derivatives.
pub(super) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
}

impl Number for f64 {}
impl Number for Complex<f64> {}

/// A value with its derivatives by two variables x and y: both first ones, ∂²/∂x² and ∂²/∂x∂y. The variables are ω and
/// Ω for [`Minors`], S and Ω² for [`phi_from_squares`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Jet {
    pub(super) value: f64,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) xx: f64,
    pub(super) xy: f64,
}

impl Jet {
    /// The variables themselves.
    pub(super) fn variables(x: f64, y: f64) -> [Self; 2] {
        [
            Self {
                value: x,
                x: 1.0,
                ..Self::default()
            },
            Self {
                value: y,
                y: 1.0,
                ..Self::default()
            },
        ]
    }
}

impl Number for Jet {}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            x: self.x + other.x,
            y: self.y + other.y,
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
        }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            value: a.value * b.value,
            x: a.x * b.value + a.value * b.x,
            y: a.y * b.value + a.value * b.y,
            xx: a.xx * b.value + 2.0 * a.x * b.x + a.value * b.xx,
            xy: a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy,
        }
    }
}

impl Add<f64> for Jet {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            x: self.x * factor,
            y: self.y * factor,
            xx: self.xx * factor,
            xy: self.xy * factor,
        }
    }
}

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
        let g = c.delta + omega * (c.beta * speed - omega);
        let h = (1.0 - omega) * (1.0 + omega);
        if g.abs() > h.abs() {
            Self::Transverse
        } else {
            Self::Tilting
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
    /// The minors at the frequency `omega` and the speed `speed`, with the displacements `kept` of ω and of ϖ.
    pub(super) fn at(c: &Coefficients, kept: [Displacement; 2], omega: T, speed: T) -> Self {
        use Displacement::{Tilting, Transverse};
        let partner = speed * 2.0 - omega;
        let diagonal = |displacement: Displacement, w: T| match displacement {
            Transverse => (w * -1.0 + 1.0) * (w + 1.0),
            Tilting => w * (speed * c.beta - w) + c.delta,
        };
        let [i, j] = kept;
        let [i_other, j_other] = kept.map(|displacement| match displacement {
            Transverse => Tilting,
            Tilting => Transverse,
        });
        // The diagonal entries a (kept) and p (eliminated) of A(ω), and those of A(ϖ).
        let (a, p) = (diagonal(i, omega), diagonal(i_other, omega));
        let (a_bar, p_bar) = (diagonal(j, partner), diagonal(j_other, partner));

        let (sine, cosine) = (2.0 * c.crack_angle).sin_cos();
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

/// Φ at the real frequency `omega`, from the minors; `None` where D itself cancels and would spoil it.
pub(super) fn phi_from_minors(c: &Coefficients, omega: f64, speed: f64) -> Option<f64> {
    let partner = 2.0 * speed - omega;
    let kept = [omega, partner].map(|w| Displacement::dominant(c, w, speed));
    let minors = Minors::at(c, kept, omega, speed);
    let sound = is_sound(minors.inner, minors.inner_coupling_squared);
    sound.then(|| (minors.first * minors.second - minors.coupling_squared) / minors.inner)
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

/// Φ(Ω, Ω), as the determinant of the static stiffness in the rotor's frame,
/// $p_+ p_- − \sin^2 2φ\,\mathrm{tr}(\mathrm{adj}P_+ E\,\mathrm{adj}P_- E) + \sin^4 2φ\,(\det E)^2$.
///
/// Where a SIR is narrow because the disk and the crack work against each other, sin 2φ is small and the first product,
/// whose factors vanish one after the other, stands alone.
pub(super) fn static_determinant(c: &Coefficients, speed: f64) -> f64 {
    let (sine, cosine) = (2.0 * c.crack_angle).sin_cos();
    let square = speed * speed;
    let block = |sign: f64| {
        let crack = sign * cosine;
        [
            (1.0 - speed) * (1.0 + speed) + crack * c.epsilon_1,
            c.gamma * (1.0 + crack * c.epsilon_12),
            c.delta * (1.0 + crack * c.epsilon_2)
                + (c.beta - 1.0 + sign * c.disk_asymmetry) * square,
        ]
    };
    let determinant = |[a, b, d]: [f64; 3]| a * d - b * b;
    let (plus, minus) = (block(1.0), block(-1.0));
    let crack = [c.epsilon_1, c.epsilon_12 * c.gamma, c.epsilon_2 * c.delta];
    // adj(P) E as [row][column].
    let adjugate_times_crack = |[a, b, d]: [f64; 3]| {
        let [e, k, t] = crack;
        [
            [d * e - b * k, d * k - b * t],
            [a * k - b * e, a * t - b * k],
        ]
    };
    let [[x11, x12], [x21, x22]] = adjugate_times_crack(plus);
    let [[y11, y12], [y21, y22]] = adjugate_times_crack(minus);
    let trace = x11 * y11 + x12 * y21 + x21 * y12 + x22 * y22;
    let sine_squared = sine * sine;
    let crack_part = sine_squared * determinant(crack);
    determinant(plus) * determinant(minus) - sine_squared * trace + crack_part * crack_part
}

/// Φ from Ω² and S = (ω − Ω)²: Eq. (22) as printed, in the products that are symmetric in ω, ϖ = Ω ± s.
///
/// With h = 1 − Ω² − S and g = δ + (β − 1)Ω² − S the parts are H = h − 2Ωs and G = g + (β − 2)Ωs, so every such product
/// is a polynomial in S and Ω². Holds for a negative S, where ω is not real, too.
pub(super) fn phi_from_squares<T: Number>(
    c: &Coefficients,
    speed_squared: T,
    offset_squared: T,
) -> T {
    let tilt = c.beta - 2.0;
    let gamma_squared = c.gamma * c.gamma;
    let (e1, e12, e2_delta) = (c.epsilon_1, c.epsilon_12, c.epsilon_2 * c.delta);
    let odd = speed_squared * offset_squared; // Ω²S
    let h = (speed_squared + offset_squared) * -1.0 + 1.0;
    let g = speed_squared * (c.beta - 1.0) - offset_squared + c.delta;
    let omegas = speed_squared - offset_squared; // ωϖ

    let h_h_bar = h * h - odd * 4.0;
    let g_g_bar = g * g - odd * (tilt * tilt);
    let h_g_bar_twice = h * g * 2.0 + odd * (4.0 * tilt); // H Ḡ + H̄ G
    let even_part = h * g - odd * (2.0 * tilt) + -gamma_squared;
    let odd_part = h * tilt - g * 2.0;
    let f_f_bar = even_part * even_part - odd * odd_part * odd_part;

    let sigma = e1 * e2_delta - e12 * e12 * gamma_squared; // Σ₁
    let disk = omegas * c.disk_asymmetry;
    let against_disk =
        h * (2.0 * e12 * gamma_squared) - h_h_bar * e2_delta + e1 * (sigma - gamma_squared);
    f_f_bar
        - g_g_bar * (e1 * e1)
        - h_g_bar_twice * (e12 * e12 * gamma_squared)
        - h_h_bar * (e2_delta * e2_delta)
        + g * (4.0 * e1 * e12 * gamma_squared)
        + h * (4.0 * e12 * e2_delta * gamma_squared)
        + disk * disk * (h_h_bar * -1.0 + e1 * e1)
        + disk * against_disk * (2.0 * (2.0 * c.crack_angle).cos())
        + (sigma * sigma - 2.0 * (e1 * e2_delta + e12 * e12 * gamma_squared) * gamma_squared)
}

/// A polynomial in S of degree 4 at most, lowest power first. Products must not exceed that degree.
#[derive(Clone, Copy, Debug)]
struct Polynomial([f64; 5]);

impl Number for Polynomial {}

impl Add for Polynomial {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|power| self.0[power] + other.0[power]))
    }
}

impl Sub for Polynomial {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|power| self.0[power] - other.0[power]))
    }
}

impl Mul for Polynomial {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(std::array::from_fn(|power| {
            (0..=power)
                .map(|low| self.0[low] * other.0[power - low])
                .sum()
        }))
    }
}

impl Add<f64> for Polynomial {
    type Output = Self;
    fn add(mut self, other: f64) -> Self {
        self.0[0] += other;
        self
    }
}

impl Mul<f64> for Polynomial {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }
}

/// The coefficients of Φ(Ω + s, Ω) in powers of S = s², lowest first; the last one is 1 − Δ_d².
pub(super) fn quartic_coefficients(c: &Coefficients, speed: f64) -> [f64; 5] {
    let speed_squared = Polynomial([speed * speed, 0.0, 0.0, 0.0, 0.0]);
    let offset_squared = Polynomial([0.0, 1.0, 0.0, 0.0, 0.0]);
    let Polynomial([_, first, second, third, fourth]) =
        phi_from_squares(c, speed_squared, offset_squared);
    // The constant one has the digits that decide where a SIR ends.
    [static_determinant(c, speed), first, second, third, fourth]
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix4;

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
        let mut with_minors = 0;
        for (c, omega, speed) in samples() {
            let expected = phi_as_determinant(&c, omega, speed);
            // Rounding of the determinant's largest product.
            let tolerance = 1e-12 * (1.0 + omega + speed).powi(8);
            let offset_squared = (omega - speed).powi(2);
            let by_squares = phi_from_squares(&c, speed * speed, offset_squared);
            assert!(
                (by_squares - expected).abs() < tolerance,
                "{c:?} {omega} {speed}"
            );
            let powers = quartic_coefficients(&c, speed);
            let by_powers = powers
                .iter()
                .rev()
                .fold(0.0, |sum, a| sum * offset_squared + a);
            assert!(
                (by_powers - expected).abs() < tolerance,
                "{c:?} {omega} {speed}"
            );
            if let Some(by_minors) = phi_from_minors(&c, omega, speed) {
                with_minors += 1;
                assert!(
                    (by_minors - expected).abs() < tolerance,
                    "{c:?} {omega} {speed}"
                );
            }
            let at_rest = static_determinant(&c, speed);
            let expected = phi_as_determinant(&c, speed, speed);
            assert!((at_rest - expected).abs() < tolerance, "{c:?} {speed}");
        }
        assert!(with_minors > 400, "{with_minors}");
    }

    #[test]
    fn the_quartic_starts_with_one_less_the_squared_asymmetry() {
        for (c, _, speed) in samples() {
            let leading = quartic_coefficients(&c, speed)[4];
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
                    let minors = Minors::at(&c, [first, second], omega, speed);
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
            let phi = |x: f64, y: f64| phi_from_squares(&c, y, x);
            let [jet_x, jet_y] = Jet::variables(x, y);
            let jet = phi_from_squares(&c, jet_y, jet_x);
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
