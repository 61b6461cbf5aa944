//! Zero unstable points, Eq. (32): the asymmetry of the disk that closes a region.

pub use formulas::*;

#[rotor_macros::symbolic(with(
    crate::equations::frequency,
    crate::equations::start,
    crate::equations::width,
))]
mod formulas {
    use crate::equations::frequency::*;
    use crate::equations::start::*;
    use crate::equations::terms::*;
    use crate::equations::width::*;

    /// The disk asymmetry that closes a simple region of this start at $\phi = \pi/2$, Eq. (32).
    pub fn closing_asymmetry(speed: f64, c: &Coefficients) -> f64 {
        let g = tilting(speed, speed, c);
        let h = coupled_transverse(transverse(speed), g, c);
        crack_excitation(h, g, c) / (speed.powi(2) * h)
    }

    /// The disk asymmetry that closes the simple region at $\phi = \pi/2$, Eq. (32).
    #[generate(value, columns, chain)]
    pub fn sir_zup_asymmetry(c: &Coefficients) -> f64 {
        closing_asymmetry(sir_start(c), c)
    }

    /// The disk asymmetry that closes the second simple region at $\phi = \pi/2$, Eq. (32).
    #[generate(value, columns, chain)]
    pub fn upper_sir_zup_asymmetry(c: &Coefficients) -> f64 {
        closing_asymmetry(upper_sir_start(c), c)
    }

    /// The disk asymmetry that closes the combination region at $\phi = 0$, Eq. (32), as in [`cir_strength()`].
    #[generate(value, columns, chain)]
    pub fn cir_zup_asymmetry(c: &Coefficients) -> f64 {
        let (omega, omega_bar, speed) = (cir_omega(c), cir_partner(c), cir_start(c));
        let (h, h_bar) = (transverse(omega), transverse(omega_bar));
        let crack = coupled_crack_excitation(h, tilting(omega_bar, speed, c), c);
        let crack_bar = coupled_crack_excitation(h_bar, tilting(omega, speed, c), c);
        (crack_bar - crack) / (c.gamma * omega * omega_bar * (h - h_bar))
    }
}
