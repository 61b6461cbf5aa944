//! Chemistry: equations of state, rates, potentials, solutions.

pub use formulas::*;

/// This module's own source text, which is what the tools compared read.
pub const SOURCE: &str = include_str!("chemistry.rs");

#[rotor_macros::symbolic(sizes = 1e-9..=1e9)]
mod formulas {
    /// The gas constant, J/(mol K).
    const GAS: f64 = 8.314_462_618_153_24;

    /// Pressure of a gas, Pa, of the molar volume `v` in m³/mol at the temperature `t` in K; `a` in Pa m⁶/mol², `b` in
    /// m³/mol.
    ///
    /// van der Waals, thesis, Leiden 1873.
    #[domain(t > 0.0, v > 0.0, a > 0.0, b > 0.0)]
    #[generate(value, gradient)]
    pub fn van_der_waals(t: f64, v: f64, a: f64, b: f64) -> f64 {
        GAS * t / (v - b) - a / v.powi(2)
    }

    /// Pressure of a fluid, Pa, of the molar volume `v` in m³/mol at the temperature `t` in K, with critical temperature
    /// `tc` in K and pressure `pc` in Pa, and the acentric factor `w`.
    ///
    /// Peng, Robinson, *A New Two-Constant Equation of State*, 1976.
    #[domain(t > 0.0, v > 0.0, tc > 0.0, pc > 0.0)]
    #[generate(value, gradient)]
    pub fn peng_robinson(t: f64, v: f64, tc: f64, pc: f64, w: f64) -> f64 {
        let a = 0.45724 * (GAS * tc).powi(2) / pc;
        let b = 0.0778 * GAS * tc / pc;
        let kappa = 0.37464 + 1.54226 * w - 0.26992 * w.powi(2);
        let alpha = (1.0 + kappa * (1.0 - (t / tc).sqrt())).powi(2);
        GAS * t / (v - b) - a * alpha / (v * (v + b) + b * (v - b))
    }

    /// Rate of a reaction with an enzyme under mixed inhibition, mol/(L s): `s` substrate and `i` inhibitor in mol/L, `top`
    /// the greatest rate, `km` Michaelis' constant, `kc` and `ku` constants of the competitive and uncompetitive inhibition.
    ///
    /// Michaelis, Menten, 1913; Cornish-Bowden, *Fundamentals of Enzyme Kinetics*, section 7.2.
    #[domain(s > 0.0, i > 0.0, top > 0.0, km > 0.0, kc > 0.0, ku > 0.0)]
    #[generate(value, gradient)]
    pub fn mixed_inhibition(s: f64, i: f64, top: f64, km: f64, kc: f64, ku: f64) -> f64 {
        top * s / (km * (1.0 + i / kc) + s * (1.0 + i / ku))
    }

    /// Constant of a reaction of second order at the temperature `t` in K, in the units of `factor`; `energy` in J/mol.
    ///
    /// Arrhenius, 1889, with the root of collision theory (Atkins, de Paula, *Physical Chemistry*, section 18A).
    #[domain(t > 0.0, factor > 0.0, energy > 0.0)]
    #[generate(value, gradient)]
    pub fn arrhenius(t: f64, factor: f64, energy: f64) -> f64 {
        factor * (t / 298.15).sqrt() * (-energy / (GAS * t)).exp()
    }

    /// Energy of two atoms at the distance `r`, in the units of `depth`.
    ///
    /// Lennard-Jones, 1924; the 12-6 form.
    #[domain(r > 0.0, depth > 0.0, size > 0.0)]
    #[generate(value, gradient)]
    pub fn lennard_jones(r: f64, depth: f64, size: f64) -> f64 {
        4.0 * depth * ((size / r).powi(12) - (size / r).powi(6))
    }

    /// Energy of a molecule of two atoms at the distance `r`, in the units of `depth`; `a` is the inverse width of the well.
    ///
    /// Morse, *Diatomic Molecules According to the Wave Mechanics*, 1929.
    #[domain(r > 0.0, depth > 0.0, a > 0.0, rest > 0.0)]
    #[generate(value, gradient)]
    pub fn morse(r: f64, depth: f64, a: f64, rest: f64) -> f64 {
        depth * (1.0 - (-a * (r - rest)).exp()).powi(2)
    }

    /// Natural logarithm of the mean activity coefficient of a salt with charges `z` at the ionic strength `i` in mol/L: `a`
    /// the constant of the solvent, `b` its inverse length times the ions' size.
    ///
    /// Debye, Hückel, 1923, with Davies' linear term `c`.
    #[domain(i > 0.0, a > 0.0, b > 0.0)]
    #[generate(value, gradient)]
    pub fn debye_hueckel(i: f64, z: [f64; 2], a: f64, b: f64, c: f64) -> f64 {
        z[0] * z[1] * a * (i.sqrt() / (1.0 + b * i.sqrt()) - c * i)
    }

    /// Vapour pressure at the temperature `t` in °C, in the units of the coefficients.
    ///
    /// Antoine, 1888.
    #[generate(value, gradient)]
    pub fn antoine(t: f64, a: f64, b: f64, c: f64) -> f64 {
        (std::f64::consts::LN_10 * (a - b / (c + t))).exp()
    }
}
