//! Starts of the regions, Eqs. (15) and (16).

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::conventions))]
mod formulas {
    use crate::equations::terms::*;

    /// $C = \delta - \gamma^2$, the determinant of the mean stiffness in dimensionless form.
    pub fn coupled_stiffness(c: &Coefficients) -> f64 {
        c.delta - c.gamma.powi(2)
    }

    /// $q^2 + 4(\beta-1)C$ with $q = \beta-1-\delta$, the radicand of Eq. (15), which for $\beta < 1$ is
    /// $(\beta-1+\delta)^2 + 4(1-\beta)\gamma^2$: here as a sum of positive terms on both sides of 1, so that nothing
    /// cancels where two whirl frequencies come close.
    pub fn sir_radicand(c: &Coefficients) -> f64 {
        let x = c.beta - 1.0;
        (c.delta - x.abs()).powi(2)
            + 2.0 * ((x.abs() + x) * coupled_stiffness(c) + (x.abs() - x) * c.gamma.powi(2))
    }

    /// Square of the start of the simple region, Eq. (15) in the form of E9, good for every $0 < \beta \le 2$. With $w$ for the
    /// root it is $2C/(w-q)$, and where $q > 0$, for disks of $\beta > 1 + \delta$, also $(w+q+2C)/(w+q+2\delta)$. From both it follows
    /// as $2C/(w+|q|)$ times 1 and what is beyond it for $q > 0$, a product of sums in which nothing cancels.
    pub fn sir_start_squared(c: &Coefficients) -> f64 {
        let (q, twice) = (c.beta - 1.0 - c.delta, 2.0 * coupled_stiffness(c));
        let sum = sir_radicand(c).sqrt() + q.abs();
        let beyond = (q.abs() + q) * (sum + twice) / (twice * (sum + 2.0 * c.delta));
        twice / sum * (1.0 + beyond)
    }

    /// Start $\Omega_s$ of the simple region, where $\omega_2 = \Omega$, Eq. (15).
    #[generate(value, columns, chain)]
    pub fn sir_start(c: &Coefficients) -> f64 {
        sir_start_squared(c).sqrt()
    }

    /// Start of the second simple region, where $\omega_1 = \Omega$; it exists for $\beta < 1$ (E9).
    #[generate(value, columns, chain)]
    pub fn upper_sir_start(c: &Coefficients) -> f64 {
        let q = c.beta - 1.0 - c.delta;
        ((sir_radicand(c).sqrt() - q) / (2.0 * (1.0 - c.beta))).sqrt()
    }

    /// $\sqrt{\beta^2 + 8(2-\beta)C}$, the root within Eq. (16).
    pub fn cir_root(c: &Coefficients) -> f64 {
        (c.beta.powi(2) + 8.0 * (2.0 - c.beta) * coupled_stiffness(c)).sqrt()
    }

    /// Start $\Omega_c$ of the combination region, where $\omega_1 + \omega_2 = 2\Omega$, Eq. (16); for $\beta < 2$.
    #[generate(value, columns, chain)]
    pub fn cir_start(c: &Coefficients) -> f64 {
        let slack = 2.0 - c.beta;
        let sum = c.beta.powi(2) + 4.0 * slack * (1.0 + c.delta) + (4.0 - c.beta) * cir_root(c);
        (sum / 8.0).sqrt() / slack
    }

    /// $\omega_1\omega_2 = (\beta + \sqrt{\beta^2 + 8(2-\beta)C})/(2(2-\beta))$ at $\Omega_c$.
    pub fn cir_product(c: &Coefficients) -> f64 {
        (c.beta + cir_root(c)) / (2.0 * (2.0 - c.beta))
    }

    /// Whirl frequency $\omega_1$ at $\Omega_c$ without a root finder, from $\omega_1 + \omega_2 = 2\Omega_c$ and their product.
    #[generate(value)]
    pub fn cir_omega(c: &Coefficients) -> f64 {
        let start = cir_start(c);
        start + (start.powi(2) - cir_product(c)).sqrt()
    }

    /// Whirl frequency $\omega_2$ at $\Omega_c$ from the product, because near $\beta = 2$, where $\omega_1$ is nearly
    /// $2\Omega_c$, the difference has few digits.
    pub fn cir_partner(c: &Coefficients) -> f64 {
        cir_product(c) / cir_omega(c)
    }
}
