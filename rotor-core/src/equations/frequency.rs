//! Frequency equations, Eqs. (13) and (22) to (25), and their terms.

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::conventions))]
mod formulas {
    use crate::equations::terms::*;

    /// $H = 1 - \omega^2$, Eq. (23).
    pub fn transverse(omega: f64) -> f64 {
        1.0 - omega.powi(2)
    }

    /// $G = \delta - \omega^2 + \beta\Omega\omega$, Eq. (23).
    pub fn tilting(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        c.delta - omega.powi(2) + c.beta * speed * omega
    }

    /// Whirl frequency equation of the symmetric, uncracked rotor, Eq. (13): zero at the whirl frequencies.
    #[generate(value, gradient(omega, speed), hessian(omega, speed), d_omega, d_speed)]
    pub fn f_n(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        transverse(omega) * tilting(omega, speed, c) - c.gamma.powi(2)
    }

    /// Frequency equation, Eq. (22) term by term (E7): zero at the frequencies $\omega$, $2\Omega - \omega$ of the motion.
    #[rustfmt::skip]
    #[generate(value, gradient(omega, speed), hessian(omega, speed), columns, stage(speed))]
    #[specialise(phi_on_sir, omega = speed, generate(value, gradient(speed)))]
    pub fn phi(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let omega_bar = 2.0 * speed - omega;
        let h = transverse(omega);
        let h_bar = transverse(omega_bar);
        let g = tilting(omega, speed, c);
        let g_bar = tilting(omega_bar, speed, c);
        let gamma_2 = c.gamma.powi(2);
        let cos_2phi = 1.0 - 2.0 * c.crack_angle.sin().powi(2);
        let inertia = c.disk_asymmetry * omega * omega_bar;
        f_n(omega, speed, c) * f_n(omega_bar, speed, c)
            - c.epsilon_1.powi(2) * g * g_bar
            - c.epsilon_12.powi(2) * gamma_2 * (h * g_bar + h_bar * g)
            - (c.epsilon_2 * c.delta).powi(2) * h * h_bar
            + 2.0 * c.epsilon_1 * c.epsilon_12 * gamma_2 * (g + g_bar)
            + 2.0 * c.epsilon_12 * c.epsilon_2 * gamma_2 * c.delta * (h + h_bar)
            - 2.0 * (c.epsilon_1 * c.epsilon_2 * c.delta + c.epsilon_12.powi(2) * gamma_2) * gamma_2
            - inertia.powi(2) * h * h_bar
            - 2.0 * inertia * theta_1(omega, speed, c) * cos_2phi
            + sigma_1(c).powi(2)
            + sigma_2(omega, speed, c).powi(2)
            + 2.0 * sigma_2(omega, speed, c) * sigma_1(c) * cos_2phi
    }

    /// $\Theta_1$, the crack's part of the excitation, Eq. (25c).
    #[generate(value)]
    pub fn theta_1(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let (h, h_bar) = (transverse(omega), transverse(2.0 * speed - omega));
        let gamma_2 = c.gamma.powi(2);
        c.epsilon_1 * gamma_2 - c.epsilon_12 * gamma_2 * (h + h_bar)
            + c.epsilon_2 * c.delta * h * h_bar
    }

    /// $\Theta_2$, the disk's part of the excitation, Eq. (25d).
    #[generate(value)]
    pub fn theta_2(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let omega_bar = 2.0 * speed - omega;
        c.disk_asymmetry * omega * omega_bar * transverse(omega) * transverse(omega_bar)
    }

    /// $a^2 + b^2 + 2ab\cos 2\phi$ of two excitations (Eqs. 25a, 25b) as squares: it keeps its digits where they cancel.
    pub fn resultant_squared(a: f64, b: f64, angle: f64) -> f64 {
        ((a + b) * angle.cos()).powi(2) + ((a - b) * angle.sin()).powi(2)
    }

    /// $\Gamma$, Eq. (25a).
    #[generate(value)]
    pub fn gamma_excitation(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let (crack, disk) = (theta_1(omega, speed, c), theta_2(omega, speed, c));
        resultant_squared(crack, disk, c.crack_angle)
    }

    /// $\Sigma_1$ (E8).
    #[generate(value)]
    pub fn sigma_1(c: &Coefficients) -> f64 {
        c.epsilon_1 * c.epsilon_2 * c.delta - (c.epsilon_12 * c.gamma).powi(2)
    }

    /// $\Sigma_2$ (E8).
    #[generate(value)]
    pub fn sigma_2(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        c.disk_asymmetry * c.epsilon_1 * omega * (2.0 * speed - omega)
    }

    /// $\Psi$, the term of fourth order, Eq. (25b).
    #[generate(value)]
    pub fn psi(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        resultant_squared(sigma_1(c), sigma_2(omega, speed, c), c.crack_angle)
    }
}
