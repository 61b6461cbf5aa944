//! The exact growth rate, from a quartic.
//!
//! In the frame that turns with the rotor the coefficients are constant: with ω = Ω + s, Φ(Ω + s, Ω) of Eq. (22) is a
//! real quartic in S = s², and likewise in the product P = ωϖ = Ω² − S, each with the leading coefficient 1 − Δ_d². The
//! motion is stable when all four roots S are real and not negative, and the growth rate is max |Im s|.
//!
//! The roots are taken in P: near β = 2 all S are Ω² but for their last digits, while the P are as far apart as the
//! whirls. Nearly meeting roots, which begin and end a combination region, lose half of the digits to whatever rounding
//! the coefficients have, wherever they meet. So the coefficients and the factors P² + aP + b of the quartic are
//! computed in 32 digits, after which the sign of a factor's discriminant tells real roots from complex ones, and a
//! growth rate keeps its digits down to the end of a region, where it starts as a square root.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, Matrix4, Schur};

use super::check_coefficients;
use super::double_double::DoubleDouble;
use super::frequency_equation::quartic_coefficients;
use crate::equations::{self, Coefficients};
use crate::error::{Error, SystemError, require};

/// Cap on the QR sweeps for the 4 × 4 companion matrix; 10 are common.
const SWEEPS: usize = 200;
/// Cap on Newton steps that polish one factor; 3 are common.
const POLISHING: usize = 60;
/// The last of them may be as long as this, in parts of the factor; longer ones are no convergence.
const POLISHED: f64 = 1e-9;
/// What 32 digits leave of a difference whose terms are 1: a smaller one counts as zero. It is some hundred roundings,
/// and the square root of a growth rate of 4e-15.
const ROUNDING: f64 = 1.0 / (1_u128 << 96) as f64;

/// The growth rate max |Im s| of the rotor at the speed Ω > 0, in units of the reference speed; exactly 0.0 where the
/// motion is stable (without damping it does not decay either).
///
/// # Errors
///
/// [`SystemError::OutOfRange`] for a speed that is not positive and finite, a coefficient that is not finite or
/// |Δ_d| ≥ 1; [`SystemError::NoConvergence`] if the eigenvalue iteration stops at its cap.
///
/// ```
/// use rotor_core::{equations::Coefficients, jeffcott::exact::growth_rate};
/// let rotor = Coefficients {
///     beta: 1.5, gamma: -0.5, delta: 1.6, disk_asymmetry: 0.2,
///     epsilon_1: 0.0, epsilon_12: 0.0, epsilon_2: 0.0, crack_angle: 0.0,
/// };
/// assert_eq!(growth_rate(&rotor, 0.93)?, 0.0);
/// assert!(growth_rate(&rotor, 0.94)? > 0.001); // inside the SIR from 0.93036 to 0.94205
/// # Ok::<(), rotor_core::error::Error>(())
/// ```
pub fn growth_rate(c: &Coefficients, speed: f64) -> Result<f64, Error> {
    let roots = squared_offsets(c, speed)?;
    let symmetric =
        c.epsilon_1 == 0.0 && c.epsilon_12 == 0.0 && c.epsilon_2 == 0.0 && c.disk_asymmetry == 0.0;
    if symmetric && equations::coupled_stiffness(c) > 0.0 {
        // Constant coefficients, no damping, positive stiffness: nothing grows, also where two frequencies coincide
        // and rounding would have to decide.
        return Ok(0.0);
    }
    Ok(roots.iter().map(growth_of).fold(0.0, f64::max))
}

/// |Im √S|; for a real S nothing is lost to rounding.
fn growth_of(root: &Complex<f64>) -> f64 {
    if root.im == 0.0 {
        return (-root.re).max(0.0).sqrt();
    }
    // |Im √S| = √((|S| − Re S)/2) without the difference where Re S > 0.
    let size = root.re.hypot(root.im);
    if root.re > 0.0 {
        root.im.abs() / (2.0 * (size + root.re)).sqrt()
    } else {
        (0.5 * (size - root.re)).sqrt()
    }
}

/// The four roots S = s² of the quartic at the speed Ω > 0: the rotor whirls at Ω ± √S, eight frequencies in four pairs.
/// Real roots have the imaginary part 0.0; complex ones come in conjugate pairs.
///
/// # Errors
///
/// As [`growth_rate`].
pub fn squared_offsets(c: &Coefficients, speed: f64) -> Result<[Complex<f64>; 4], Error> {
    check_coefficients(c)?;
    require("speed", speed, speed > 0.0, "a positive number")?;
    let [c0, c1, c2, c3, leading] = quartic_coefficients(c, speed);
    let monic = [c0, c1, c2, c3].map(|coefficient| coefficient / leading);
    let speed_squared = DoubleDouble::from(speed) * DoubleDouble::from(speed);
    let [first, second] = factors(&monic)?.map(|factor| offsets(factor, speed_squared));
    Ok([first[0], first[1], second[0], second[1]])
}

/// A real quadratic factor x² + ax + b of the quartic.
#[derive(Clone, Copy, Debug)]
struct Factor {
    a: DoubleDouble,
    b: DoubleDouble,
}

/// The two factors of the monic quartic, each of two roots that are nearer to each other than to the rest.
fn factors(monic: &[DoubleDouble; 4]) -> Result<[Factor; 2], Error> {
    let [first, second] = pairs(&companion_roots(&monic.map(DoubleDouble::rounded))?);
    Ok([polish(monic, first)?, polish(monic, second)?])
}

/// Eigenvalues of the companion matrix, scaled so that the largest root is about 1 and then balanced.
fn companion_roots(monic: &[f64; 4]) -> Result<[Complex<f64>; 4], Error> {
    let [b0, b1, b2, b3] = *monic;
    let scale = b3
        .abs()
        .max(b2.abs().sqrt())
        .max(b1.abs().cbrt())
        .max(b0.abs().sqrt().sqrt());
    require(
        "the quartic's coefficients",
        b0 + b1 + b2 + b3,
        scale.is_finite(),
        "finite numbers (is the speed too large?)",
    )?;
    if scale == 0.0 {
        return Ok([Complex::new(0.0, 0.0); 4]);
    }
    #[rustfmt::skip]
    let mut companion = Matrix4::new(
        -b3 / scale, -b2 / scale / scale, -b1 / scale / scale / scale, -b0 / scale / scale / scale / scale,
        1.0, 0.0, 0.0, 0.0,
        0.0, 1.0, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
    );
    balance_parlett_reinsch(&mut companion);
    let schur =
        Schur::try_new(companion, f64::EPSILON, SWEEPS).ok_or(SystemError::NoConvergence {
            what: "the roots of the quartic",
            iterations: SWEEPS,
        })?;
    let roots = schur.complex_eigenvalues() * Complex::new(scale, 0.0);
    Ok(roots.into())
}

/// The roots in two pairs: the nearest two, by the sizes of the roots, that may be the roots of a real factor, and the
/// others.
fn pairs(roots: &[Complex<f64>; 4]) -> [[Complex<f64>; 2]; 2] {
    let complex = roots.iter().filter(|root| root.im != 0.0).count();
    // A complex root pairs with its conjugate; where only two are complex, the real ones are a pair by that.
    let may_pair = |a: &Complex<f64>, b: &Complex<f64>| {
        complex == 0 || (a.im == 0.0) == (b.im == 0.0) && (a.im + b.im).abs() <= 1e-6 * a.im.abs()
    };
    let distance = |a: &Complex<f64>, b: &Complex<f64>| {
        if may_pair(a, b) {
            (a - b).norm() / (a.norm() + b.norm()).max(f64::MIN_POSITIVE)
        } else {
            f64::INFINITY
        }
    };
    let [r0, r1, r2, r3] = *roots;
    let splits = [
        [[r0, r1], [r2, r3]],
        [[r0, r2], [r1, r3]],
        [[r0, r3], [r1, r2]],
    ];
    let nearest = |split: &[[Complex<f64>; 2]; 2]| {
        let [first, second] = split.map(|[a, b]| distance(&a, &b));
        // A split with a forbidden pair is never the nearest.
        if first.max(second).is_finite() {
            first.min(second)
        } else {
            f64::INFINITY
        }
    };
    let mut best = splits[0];
    for split in &splits[1..] {
        if nearest(split) < nearest(&best) {
            best = *split;
        }
    }
    best
}

/// The factor with the two roots, by Bairstow's iteration: Newton's on the remainder of the division by it, in 32 digits,
/// with the slopes in 16.
fn polish(monic: &[DoubleDouble; 4], [first, second]: [Complex<f64>; 2]) -> Result<Factor, Error> {
    let [c0, c1, c2, c3] = *monic;
    let mut factor = Factor {
        a: DoubleDouble::from(-(first + second).re),
        b: DoubleDouble::from((first * second).re),
    };
    let mut last = f64::INFINITY;
    for _ in 0..POLISHING {
        let Factor { a, b } = factor;
        // The quotient x² + q₁x + q₀ and the remainder r₁x + r₀.
        let q1 = c3 - a;
        let q0 = c2 - b - a * q1;
        let r1 = (c1 - b * q1 - a * q0).rounded();
        let r0 = (c0 - b * q0).rounded();
        let (apart, turned) = ((b - q0).rounded(), (q1 - a).rounded());
        let [r1_by_a, r1_by_b] = [apart + a.rounded() * turned, -turned];
        let [r0_by_a, r0_by_b] = [b.rounded() * turned, apart];
        let determinant = r1_by_a * r0_by_b - r1_by_b * r0_by_a;
        let step_a = (r1 * r0_by_b - r1_by_b * r0) / determinant;
        let step_b = (r1_by_a * r0 - r1 * r0_by_a) / determinant;
        let size = a.rounded().abs().max(b.rounded().abs().sqrt());
        let length = (step_a / size).abs().max((step_b / size / size).abs());
        // Not a number where the factors have a root in common, or everything is zero.
        if length.is_nan() || length >= 0.9 * last {
            break;
        }
        factor = Factor {
            a: a + -step_a,
            b: b + -step_b,
        };
        last = length;
        if length == 0.0 {
            break;
        }
    }
    // The first step already is not a number at an exact multiple root, where the start is all there is.
    if last.is_finite() && last > POLISHED {
        return Err(SystemError::NoConvergence {
            what: "the roots of the quartic",
            iterations: POLISHING,
        }
        .into());
    }
    Ok(factor)
}

/// The two offsets S = Ω² − P of a factor.
fn offsets(Factor { a, b }: Factor, speed_squared: DoubleDouble) -> [Complex<f64>; 2] {
    let center = a * -0.5;
    let square = center * center;
    let discriminant = square - b;
    let offset = |product: DoubleDouble| {
        let offset = speed_squared - product;
        let size = (speed_squared + product.abs()).rounded();
        if offset.rounded().abs() <= ROUNDING * size {
            0.0
        } else {
            offset.rounded()
        }
    };
    let size = (square + b.abs()).rounded();
    if discriminant.rounded().abs() <= ROUNDING * size {
        return [Complex::new(offset(center), 0.0); 2];
    }
    let reach = discriminant.abs().sqrt();
    if discriminant.rounded() < 0.0 {
        let root = Complex::new(offset(center), reach.rounded());
        return [root, root.conj()];
    }
    // The root that is not a difference, and the other one from their product.
    let larger = if center.rounded() < 0.0 {
        center - reach
    } else {
        center + reach
    };
    [larger, b / larger].map(|product| Complex::new(offset(product), 0.0))
}
