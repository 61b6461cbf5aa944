//! The formulas. Everything else that is used of them is generated.
//!
//! Read this file from top to bottom: each formula shows one more word of the language.

pub use equation::*;

/// Formulas stand in one module, so that they can call each other. The module is plain Rust and stays as it is written:
/// the compiler and the editor check it like any other. `latex(…)` says how names are typeset where the rule for names
/// does not do.
#[rotor_macros::symbolic(sizes = 1e-9..=1e9, latex(
    odd_period_pi = "D_{b,2}",
    even_period_pi = "D_{a,0}",
    odd_period_two_pi = "D_{b,1}",
    even_period_two_pi = "D_{a,1}",
))]
mod equation {
    /// Determinant of the tridiagonal matrix with the diagonal `d` and off-diagonal products `q²`, but `first` in the first
    /// place: Hill's determinant of order seven.
    ///
    /// A formula is `let` bindings and an expression over `f64`; numbers may come as arrays and as fields of structs.
    /// Nothing is asked of this one: it is there to be called, and takes part in what is generated from its callers.
    pub fn tridiagonal(d: [f64; 7], first: f64, q: f64) -> f64 {
        let q_2 = q.powi(2);
        let k_2 = d[0] * d[1] - first;
        let k_3 = d[2] * k_2 - q_2 * d[0];
        let k_4 = d[3] * k_3 - q_2 * k_2;
        let k_5 = d[4] * k_4 - q_2 * k_3;
        let k_6 = d[5] * k_5 - q_2 * k_4;
        d[6] * k_6 - q_2 * k_5
    }

    /// Zero at $a_0(q)$, $a_2(q)$, …: even solutions of period π.
    ///
    /// `generate` asks for code. `gradient(a, q)` makes `even_period_pi::gradient(a, q) -> (f64, [f64; 2])`, the value
    /// with its two partials, each operation done once for all three. `columns` makes the same over slices,
    /// `even_period_pi::gradient_columns`. `budget` stops the build should the code ever take more operations.
    #[generate(gradient(a, q), columns, budget(operations = 60, div = 0))]
    pub fn even_period_pi(a: f64, q: f64) -> f64 {
        tridiagonal(
            [
                a,
                a - 4.0,
                a - 16.0,
                a - 36.0,
                a - 64.0,
                a - 100.0,
                a - 144.0,
            ],
            2.0 * q.powi(2),
            q,
        )
    }

    /// Zero at $b_2(q)$, …: odd solutions of period π.
    #[generate(gradient(a, q), columns)]
    pub fn odd_period_pi(a: f64, q: f64) -> f64 {
        tridiagonal(
            [
                a - 4.0,
                a - 16.0,
                a - 36.0,
                a - 64.0,
                a - 100.0,
                a - 144.0,
                a - 196.0,
            ],
            q.powi(2),
            q,
        )
    }

    /// Zero at $a_1(q)$, …: even solutions of period 2π.
    #[generate(gradient(a, q), columns)]
    pub fn even_period_two_pi(a: f64, q: f64) -> f64 {
        tridiagonal(
            [
                a - 1.0 - q,
                a - 9.0,
                a - 25.0,
                a - 49.0,
                a - 81.0,
                a - 121.0,
                a - 169.0,
            ],
            q.powi(2),
            q,
        )
    }

    /// Zero at $b_1(q)$, …: odd solutions of period 2π, the even ones half a turn later.
    #[generate(gradient(a, q), columns)]
    pub fn odd_period_two_pi(a: f64, q: f64) -> f64 {
        even_period_two_pi(a, -q)
    }

    /// Slope $\mathrm{d}a_0/\mathrm{d}q$ of the boundary through `(a, q)`.
    ///
    /// A partial of another formula is asked for by name, `f::d_x`, and is then a function like any other.
    #[generate(value)]
    pub fn even_period_pi_slope(a: f64, q: f64) -> f64 {
        -even_period_pi::d_q(a, q) / even_period_pi::d_a(a, q)
    }

    /// $\frac{1}{\pi}\int_0^\pi \sqrt{1 - r\cos 2t} \mathrm{d}t$, an elliptic integral.
    ///
    /// A costly function of one number is tabulated when the crate is built, to the given tolerance on the given
    /// interval. One that is an integral is written as its integrand and bounds.
    #[approximate(r = 0.0..=0.95, tolerance = 1e-13)]
    #[generate(value, gradient(r))]
    pub fn mean_root(r: f64) -> f64 {
        integral(
            |t| (1.0 - r * (2.0 * t).cos()).sqrt(),
            0.0..std::f64::consts::PI,
        ) / std::f64::consts::PI
    }

    /// Oscillations per 2π far above the boundaries, where the stiffness varies slowly (WKB): the characteristic exponent.
    ///
    /// `domain` says what signs the inputs have. Rewriting relies on it: here $\sqrt{a}\sqrt{a}$ is $a$.
    #[domain(a > 0.0, q >= 0.0)]
    #[generate(value, gradient(a, q))]
    pub fn slow_exponent(a: f64, q: f64) -> f64 {
        a.sqrt() * mean_root(2.0 * q / a)
    }
}
