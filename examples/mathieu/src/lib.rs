//! Where Mathieu's equation $y'' + (a - 2q\cos 2t) y = 0$ becomes unstable: a tutorial of the macro
//! [`symbolic`](rotor_macros::symbolic).
//!
//! 1. [`formulas`] holds the mathematics, and nothing else: four determinants, a slope, an integral.
//! 2. This file uses what was generated: [`Boundary::at`] follows a boundary by Newton's method on a determinant and its
//!    gradient, [`residuals`] evaluates many points at once.
//! 3. `tests/` holds both against published values and finite differences.
//!
//! `cargo doc -p mathieu --open` lists the generated functions beside the formulas, each with its count of operations.

pub mod formulas;

use formulas::{
    ColumnLengthError, even_period_pi, even_period_two_pi, odd_period_pi, odd_period_two_pi,
};

/// A curve $a(q)$ on which Mathieu's equation has a periodic solution; the equation is unstable between $b_n$ and $a_n$.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// $a_0$
    A0,
    /// $b_1$
    B1,
    /// $a_1$
    A1,
    /// $b_2$
    B2,
    /// $a_2$
    A2,
}

impl Boundary {
    /// All of them, from below.
    pub const ALL: [Self; 5] = [Self::A0, Self::B1, Self::A1, Self::B2, Self::A2];

    /// The curve's $a$ at $q = 0$: the square of the number of half waves in π.
    fn start(self) -> f64 {
        match self {
            Self::A0 => 0.0,
            Self::B1 | Self::A1 => 1.0,
            Self::B2 | Self::A2 => 4.0,
        }
    }

    /// The determinant that is zero on the curve, with its partials by $a$ and $q$.
    pub fn determinant(self, a: f64, q: f64) -> (f64, [f64; 2]) {
        match self {
            Self::A0 | Self::A2 => even_period_pi::gradient(a, q),
            Self::B1 => odd_period_two_pi::gradient(a, q),
            Self::A1 => even_period_two_pi::gradient(a, q),
            Self::B2 => odd_period_pi::gradient(a, q),
        }
    }

    /// The curve's $a$ at $q$, followed from $q = 0$: each step goes along the slope $-D_q/D_a$ and then to the curve by
    /// Newton's method. For $|q| \le 5$ the determinant of order seven leaves 1e-10.
    ///
    /// None where Newton's method does not settle, as for a `q` that is not finite.
    pub fn at(self, q: f64) -> Option<f64> {
        const LARGEST_STEP: f64 = 0.25;
        const MOST_STEPS: f64 = 1000.0;
        let steps = (q.abs() / LARGEST_STEP).ceil();
        if steps.is_nan() || steps > MOST_STEPS {
            return None;
        }
        let mut a = self.start();
        for step in 1..=steps as u32 {
            let before = q * f64::from(step - 1) / steps;
            let (_, [by_a, by_q]) = self.determinant(a, before);
            a -= by_q / by_a * (q / steps);
            a = self.newton(a, q * f64::from(step) / steps)?;
        }
        Some(a)
    }

    fn newton(self, mut a: f64, q: f64) -> Option<f64> {
        const MOST_ITERATIONS: usize = 30;
        for _ in 0..MOST_ITERATIONS {
            let (determinant, [by_a, _]) = self.determinant(a, q);
            let change = determinant / by_a;
            a -= change;
            if change.abs() <= 1e-13 * a.abs().max(1.0) {
                return Some(a);
            }
        }
        None
    }
}

/// The determinant of $a_0$ and $a_2$ at many points at once, and how steeply the curve through each rises: the slices are
/// as long as `a`.
///
/// # Errors
/// `q` is not as long as `a`.
pub fn residuals(a: &[f64], q: &[f64]) -> Result<(Vec<f64>, Vec<f64>), ColumnLengthError> {
    let (mut value, mut by_a, mut by_q) =
        (vec![0.0; a.len()], vec![0.0; a.len()], vec![0.0; a.len()]);
    let columns = even_period_pi::Columns { a, q };
    even_period_pi::gradient_columns(&columns, [&mut value, &mut by_a, &mut by_q])?;
    let slopes = by_a
        .iter()
        .zip(&by_q)
        .map(|(by_a, by_q)| -by_q / by_a)
        .collect();
    Ok((value, slopes))
}
