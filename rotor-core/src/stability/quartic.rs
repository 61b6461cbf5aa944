//! The exact growth rate, from the quartic in S.
//!
//! In the frame that turns with the rotor the coefficients are constant: with ω = Ω + s, Φ(Ω + s, Ω) of Eq. (22) is a
//! real quartic in S = s² with the leading coefficient 1 − Δ_d². The motion is stable when all four roots are real and
//! not negative, and the growth rate is max |Im s|.
//!
//! Real or complex is not decided by a tolerance. A well separated pair is told by the sign of the discriminant of its
//! 2 × 2 block in the Schur form. A pair that nearly meets is told by the sign of Φ at the extremum between the two,
//! computed from the minors (see the source of `frequency_equation`), where it keeps its digits: the growth rate is
//! then right down to the end of a region, where it starts as a square root. A root that passes zero has the sign of
//! the constant coefficient, which has its own well-conditioned form.

use nalgebra::{Complex, Matrix4, Schur};

use super::error::{StabilityError, check_coefficients, require};
use super::frequency_equation::{phi_from_minors, phi_from_squares, quartic_coefficients};
use crate::equations::Coefficients;

/// Cap on the QR sweeps for the 4 × 4 companion matrix; 10 are common.
const SWEEPS: usize = 200;
/// Cap on Newton steps that polish one root.
const POLISHING: usize = 12;

/// The growth rate max |Im s| of the rotor at the speed Ω > 0, in units of the reference speed; exactly 0.0 where the
/// motion is stable (without damping it does not decay either).
///
/// # Errors
///
/// [`StabilityError::OutOfRange`] for a speed that is not positive and finite, a coefficient that is not finite or
/// |Δ_d| ≥ 1; [`StabilityError::NoConvergence`] if the eigenvalue iteration stops at its cap.
///
/// ```
/// use rotor_core::{equations::Coefficients, stability::growth_rate};
/// let rotor = Coefficients {
///     beta: 1.5, gamma: -0.5, delta: 1.6, disk_asymmetry: 0.2,
///     epsilon_1: 0.0, epsilon_12: 0.0, epsilon_2: 0.0, crack_angle: 0.0,
/// };
/// assert_eq!(growth_rate(&rotor, 0.93)?, 0.0);
/// assert!(growth_rate(&rotor, 0.94)? > 0.001); // inside the SIR from 0.93036 to 0.94205
/// # Ok::<(), rotor_core::stability::StabilityError>(())
/// ```
pub fn growth_rate(c: &Coefficients, speed: f64) -> Result<f64, StabilityError> {
    let roots = squared_offsets(c, speed)?;
    let symmetric =
        c.epsilon_1 == 0.0 && c.epsilon_12 == 0.0 && c.epsilon_2 == 0.0 && c.disk_asymmetry == 0.0;
    if symmetric && c.delta > c.gamma * c.gamma {
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
pub fn squared_offsets(c: &Coefficients, speed: f64) -> Result<[Complex<f64>; 4], StabilityError> {
    check_coefficients(c)?;
    require("speed", speed, speed > 0.0, "a positive number")?;
    let coefficients = quartic_coefficients(c, speed);
    let mut roots = companion_roots(&coefficients)?;
    // Expanding Φ into powers of S costs digits that its products keep; only the slope is taken from the expansion. At
    // S = 0 the constant coefficient has its own, better form.
    let product_form = |offset_squared: Complex<f64>| {
        phi_from_squares(c, Complex::new(speed * speed, 0.0), offset_squared)
    };
    let correction = product_form(Complex::new(0.0, 0.0)) * -1.0 + coefficients[0];
    for root in &mut roots {
        *root = polish(*root, |x| {
            (product_form(x) + correction, horner(&coefficients, x).1)
        });
    }
    settle_close_pairs(c, speed, &coefficients, &mut roots);
    Ok(roots)
}

/// Eigenvalues of the companion matrix, scaled so that the largest root is about 1.
fn companion_roots(coefficients: &[f64; 5]) -> Result<[Complex<f64>; 4], StabilityError> {
    let [a0, a1, a2, a3, a4] = *coefficients;
    let [b0, b1, b2, b3] = [a0 / a4, a1 / a4, a2 / a4, a3 / a4];
    let scale = b3
        .abs()
        .max(b2.abs().sqrt())
        .max(b1.abs().cbrt())
        .max(b0.abs().sqrt().sqrt());
    require(
        "the quartic's coefficients",
        scale,
        true,
        "finite numbers (is the speed too large?)",
    )?;
    if scale == 0.0 {
        return Ok([Complex::new(0.0, 0.0); 4]);
    }
    let square = scale * scale;
    #[rustfmt::skip]
    let companion = Matrix4::new(
        -b3 / scale, -b2 / square, -b1 / (square * scale), -b0 / (square * square),
        1.0, 0.0, 0.0, 0.0,
        0.0, 1.0, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
    );
    let schur =
        Schur::try_new(companion, f64::EPSILON, SWEEPS).ok_or(StabilityError::NoConvergence {
            what: "the roots of the quartic",
            iterations: SWEEPS,
        })?;
    let roots = schur.complex_eigenvalues() * Complex::new(scale, 0.0);
    Ok(roots.into())
}

/// Value and derivative of a polynomial.
fn horner(coefficients: &[f64; 5], x: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    let zero = Complex::new(0.0, 0.0);
    coefficients
        .iter()
        .rev()
        .fold((zero, zero), |(value, slope), a| {
            (value * x + *a, slope * x + value)
        })
}

/// Newton's iteration on `(value, slope)` while its steps get smaller. Real roots stay exactly real.
fn polish(
    start: Complex<f64>,
    value_and_slope: impl Fn(Complex<f64>) -> (Complex<f64>, Complex<f64>),
) -> Complex<f64> {
    let mut root = start;
    let mut last = f64::INFINITY;
    for _ in 0..POLISHING {
        let (value, slope) = value_and_slope(root);
        let step = value / slope;
        let size = step.norm();
        // At a vanishing slope the step is not a number.
        if size.is_nan() || size >= 0.5 * last {
            break;
        }
        root -= step;
        last = size;
    }
    root
}

/// Recomputes each pair of roots that nearly meets at a positive S from the quartic shifted to the extremum between
/// them, with the value there from the minors.
fn settle_close_pairs(
    c: &Coefficients,
    speed: f64,
    coefficients: &[f64; 5],
    roots: &mut [Complex<f64>; 4],
) {
    for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        let (first, second) = (roots[i], roots[j]);
        if let Some(pair) = close_pair(c, speed, coefficients, first, second) {
            [roots[i], roots[j]] = pair;
        }
    }
}

/// The two roots as ± around their extremum, if they are near enough for the parabola there to tell them.
fn close_pair(
    c: &Coefficients,
    speed: f64,
    coefficients: &[f64; 5],
    first: Complex<f64>,
    second: Complex<f64>,
) -> Option<[Complex<f64>; 2]> {
    let middle = 0.5 * (first.re + second.re);
    let apart = (first - second).norm();
    if middle <= 0.0 || apart > 0.1 * middle {
        return None;
    }
    let center = extremum(coefficients, middle)?;
    let mut local = shifted(coefficients, center);
    local[0] = phi_from_minors(c, speed + center.max(0.0).sqrt(), speed)?;
    let [_, _, b2, b3, b4] = local;
    let reach_squared = -local[0] / b2;
    let reach = reach_squared.abs().sqrt();
    let parabola = (center - middle).abs() <= apart.max(1e-6 * middle)
        && b3.abs() * reach < 0.1 * b2.abs()
        && b4.abs() * reach * reach < 0.1 * b2.abs();
    if !parabola {
        return None;
    }
    let offset = if reach_squared >= 0.0 {
        Complex::new(reach, 0.0)
    } else {
        Complex::new(0.0, reach)
    };
    if reach == 0.0 {
        return Some([Complex::new(center, 0.0); 2]);
    }
    // b₁ is rounding noise here and would only move the centre.
    local[1] = 0.0;
    let local_polynomial = |t| horner(&local, t);
    let upper = polish(offset, local_polynomial);
    let lower = if offset.im == 0.0 {
        polish(-offset, local_polynomial)
    } else {
        upper.conj()
    };
    Some([upper + center, lower + center])
}

/// The extremum of the polynomial near `start`, by Newton's iteration on its derivative.
fn extremum(coefficients: &[f64; 5], start: f64) -> Option<f64> {
    let mut center = start;
    for _ in 0..POLISHING {
        let [_, b1, b2, _, _] = shifted(coefficients, center);
        let step = b1 / (2.0 * b2);
        center -= step;
        if step.abs() <= 1e-13 * center.abs() {
            return Some(center);
        }
    }
    None
}

/// The coefficients of p(center + t) in powers of t.
fn shifted(coefficients: &[f64; 5], center: f64) -> [f64; 5] {
    let [mut a0, mut a1, mut a2, mut a3, a4] = *coefficients;
    // Repeated synthetic division.
    a3 += center * a4;
    a2 += center * a3;
    a1 += center * a2;
    a0 += center * a1;
    a3 += center * a4;
    a2 += center * a3;
    a1 += center * a2;
    a3 += center * a4;
    a2 += center * a3;
    a3 += center * a4;
    [a0, a1, a2, a3, a4]
}
