//! Widths and growth rates, Eqs. (29) to (31).

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::frequency, crate::equations::start))]
mod formulas {
    use crate::equations::frequency::*;
    use crate::equations::start::*;
    use crate::equations::terms::*;

    /// $\Theta_1/H$ at the start of a simple region, where $HG = \gamma^2$: Eq. (25c) without the division, which would be 0/0
    /// where displacement and tilt are uncoupled. Only the product $\epsilon_{12}\gamma$ is needed, which then is finite.
    pub fn crack_excitation(h: f64, g: f64, c: &Coefficients) -> f64 {
        c.epsilon_1 * g - 2.0 * (c.epsilon_12 * c.gamma) * c.gamma + c.epsilon_2 * c.delta * h
    }

    /// $\gamma\Theta_1/\bar H$ at the start of the combination region, likewise; `g` belongs to the partner frequency.
    pub fn coupled_crack_excitation(h: f64, g: f64, c: &Coefficients) -> f64 {
        c.gamma * (c.epsilon_1 * g + c.epsilon_2 * c.delta * h)
            - (c.epsilon_12 * c.gamma) * (c.gamma.powi(2) + h * g)
    }

    /// $H$ at a whirl frequency, from both its definition and $HG = \gamma^2$: $(\gamma^2 + H^2)/(G + H)$. Where the
    /// frequency is near 1, $1-\omega^2$ has few digits left, and $\gamma^2/G$ has them all; elsewhere it is the other way round.
    pub fn coupled_transverse(h: f64, g: f64, c: &Coefficients) -> f64 {
        (c.gamma.powi(2) + h.powi(2)) / (g + h)
    }

    /// $-\Gamma/(H\bar H)$ at the start of a simple region, where $\omega = \varpi = \Omega$.
    pub fn sir_strength(speed: f64, c: &Coefficients) -> f64 {
        let g = tilting(speed, speed, c);
        let h = coupled_transverse(transverse(speed), g, c);
        let disk = c.disk_asymmetry * speed.powi(2) * h;
        -resultant_squared(crack_excitation(h, g, c), disk, c.crack_angle)
    }

    /// $-\Gamma/(H\bar H)$ at the start of the combination region.
    ///
    /// With $\Theta = \bar H \theta$ and $\bar H\bar G = \gamma^2$ it is $-|\gamma\theta|^2/(H\bar G)$, or $-|\gamma\bar\theta|^2/(\bar H G)$. Each form loses
    /// its digits where the other keeps them; their parts have one sign, and the quotient of the sums has all digits.
    pub fn cir_strength(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let omega_bar = 2.0 * speed - omega;
        let (h, h_bar) = (transverse(omega), transverse(omega_bar));
        let (g, g_bar) = (tilting(omega, speed, c), tilting(omega_bar, speed, c));
        let inertia = c.gamma * c.disk_asymmetry * omega * omega_bar;
        let crack = coupled_crack_excitation(h, g_bar, c);
        let crack_bar = coupled_crack_excitation(h_bar, g, c);
        let excitation = resultant_squared(crack, inertia * h, c.crack_angle);
        let excitation_bar = resultant_squared(crack_bar, inertia * h_bar, c.crack_angle);
        -(excitation + excitation_bar) / (h * g_bar + h_bar * g)
    }

    /// First term of Eq. (29): $\kappa_0^2 = (-\Gamma/H\bar H)/(\partial_\omega f_n \partial_\omega\bar f_n)$.
    pub fn peak_growth_squared(omega: f64, speed: f64, strength: f64, c: &Coefficients) -> f64 {
        // The partner frequency is 2Ω − ω, so its derivative by ω changes sign.
        let partner_slope = -f_n::d_omega(2.0 * speed - omega, speed, c);
        strength / (f_n::d_omega(omega, speed, c) * partner_slope)
    }

    /// The difference of slopes in Eq. (31), $\partial_\Omega\bar f_n/\partial_\omega\bar f_n - \partial_\Omega f_n/\partial_\omega f_n$.
    pub fn slope_difference(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        let omega_bar = 2.0 * speed - omega;
        let d_omega_bar = f_n::d_omega(omega_bar, speed, c);
        let partner = (2.0 * d_omega_bar + f_n::d_speed(omega_bar, speed, c)) / -d_omega_bar;
        partner - f_n::d_speed(omega, speed, c) / f_n::d_omega(omega, speed, c)
    }

    /// Width of an unstable region, Eq. (31).
    pub fn width(omega: f64, speed: f64, strength: f64, c: &Coefficients) -> f64 {
        4.0 * peak_growth_squared(omega, speed, strength, c).sqrt()
            / slope_difference(omega, speed, c).abs()
    }

    /// Growth rate $\kappa$ at the detuning $\vartheta$ from the start, Eq. (29); zero outside the region.
    pub fn growth(omega: f64, speed: f64, strength: f64, detuning: f64, c: &Coefficients) -> f64 {
        let slope = slope_difference(omega, speed, c);
        (peak_growth_squared(omega, speed, strength, c) - (0.5 * slope * detuning).powi(2))
            .max(0.0)
            .sqrt()
    }

    /// Width $\lambda_s$ of the simple region, Eq. (31) at $\Omega_s$.
    #[generate(value, gradient, columns, chain)]
    pub fn sir_width(c: &Coefficients) -> f64 {
        let speed = sir_start(c);
        width(speed, speed, sir_strength(speed, c), c)
    }

    /// Width of the second simple region, for $\beta < 1$.
    #[generate(value, columns, chain)]
    pub fn upper_sir_width(c: &Coefficients) -> f64 {
        let speed = upper_sir_start(c);
        width(speed, speed, sir_strength(speed, c), c)
    }

    /// Width $\lambda_c$ of the combination region, Eq. (31) at $\Omega_c$; for $\beta < 2$ and $\gamma \ne 0$.
    #[generate(value, gradient, columns, chain)]
    pub fn cir_width(c: &Coefficients) -> f64 {
        let (omega, speed) = (cir_omega(c), cir_start(c));
        width(omega, speed, cir_strength(omega, speed, c), c)
    }

    /// Both widths, $\lambda_s$ and $\lambda_c$, in stages along what a scan varies.
    #[generate(columns, chain(sir_width, cir_width), stage(c.crack_angle), stage(c.disk_asymmetry), stage(c.beta, c.gamma, c.delta, c.epsilon_1, c.epsilon_12, c.epsilon_2))]
    pub fn both_widths(c: &Coefficients) -> (f64, f64) {
        (sir_width(c), cir_width(c))
    }

    /// The squares of both widths, of which a scan takes maxima: one root is left of many.
    #[generate(chain(sir_width_squared, cir_width_squared), stage(c.crack_angle))]
    pub fn both_widths_squared(c: &Coefficients) -> (f64, f64) {
        (sir_width(c).powi(2), cir_width(c).powi(2))
    }

    /// Growth rate in the simple region at the detuning $\vartheta = \Omega - \Omega_s$, Eq. (29).
    #[generate(value)]
    pub fn sir_growth(detuning: f64, c: &Coefficients) -> f64 {
        let speed = sir_start(c);
        growth(speed, speed, sir_strength(speed, c), detuning, c)
    }

    /// Growth rate in the combination region at the detuning $\vartheta = \Omega - \Omega_c$, Eq. (29).
    #[generate(value)]
    pub fn cir_growth(detuning: f64, c: &Coefficients) -> f64 {
        let (omega, speed) = (cir_omega(c), cir_start(c));
        growth(omega, speed, cir_strength(omega, speed, c), detuning, c)
    }

    /// Growth rate in the second simple region at the detuning $\vartheta$, Eq. (29).
    #[generate(value)]
    pub fn upper_sir_growth(detuning: f64, c: &Coefficients) -> f64 {
        let speed = upper_sir_start(c);
        growth(speed, speed, sir_strength(speed, c), detuning, c)
    }
}
