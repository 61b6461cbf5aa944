//! Every closed form of the paper, each written once, as plain Rust under the generator. E1 to E13 are the
//! [corrections](crate::corrections) to the printed text.

mod terms;

pub use formulas::*;
pub use terms::*;

/// This module's own source text, for tools that show a formula as it is written.
pub const SOURCE: &str = include_str!("equations.rs");

// Forms need be right for SI units and ratios of everyday, far beyond any machine, and for what a rotor can be.
#[rotor_macros::symbolic(sizes = 1e-9..=1e6, domain(
    c.beta >= 0.0, c.beta <= 2.0, c.disk_asymmetry >= -1.0, c.disk_asymmetry <= 1.0, p.disk_asymmetry >= -1.0,
    p.disk_asymmetry <= 1.0, p.disk_position_ratio <= 1.0, p.shaft_poissons_ratio >= -1.0,
    p.shaft_poissons_ratio <= 0.5, p.shaft_youngs_modulus >= 1e6, p.shaft_youngs_modulus <= 1e13,
    p.crack_depth_ratio <= 1.0, p.crack_position_ratio <= 1.0, edge_factor >= 1.0, edge_factor <= 2.0,
), latex(
    speed = "\\Omega", omega_bar = "\\varpi",
    detuning = "\\vartheta", disk_mass = "m_d",
    disk_diametral_inertia = "I_d", disk_polar_inertia = "I_p",
    disk_asymmetry = "\\Delta_d", disk_position_ratio = "\\frac{l_d}{L}",
    shaft_length = "L", shaft_radius = "R",
    shaft_youngs_modulus = "E", shaft_poissons_ratio = "\\nu",
    crack_depth_ratio = "\\sigma", crack_position_ratio = "\\frac{l_c}{L}",
    crack_angle = "\\phi", mu = "\\bar{\\mu}",
    xi = "\\bar{\\xi}",
    mode_one_lateral = "F_1",
    mode_one_opening = "F_2",
    mode_two = "F_{II}",
    mode_three = "F_{III}",
    edge_half_width = "\\bar{b}",
    strip_height = "\\bar{h}",
    strip_depth = "\\bar{a}",
    moment_of_force = "M_F",
    shear_of_force = "V_F",
    moment_of_couple = "M_M",
    shear_of_couple = "V_M",
    delta_k_tt = "\\Delta k_{tt}",
    delta_k_tm = "\\Delta k_{tm}",
    delta_k_mm = "\\Delta k_{mm}",
    reference_speed = "\\omega_{st}",
    h = "H",
    h_bar = "\\bar{H}",
    g = "G",
    g_bar = "\\bar{G}",
    transverse = "H",
    tilting = "G",
    d_omega_bar = "\\bar{f}_n'",
    cos_2phi = "c_{2\\phi}",
    phi = "\\Phi",
    phi_on_sir = "\\Phi_s",
    theta_1 = "\\Theta_1",
    theta_2 = "\\Theta_2",
    gamma_excitation = "\\Gamma",
    sigma_1 = "\\Sigma_1",
    sigma_2 = "\\Sigma_2",
    psi = "\\Psi",
    sir_start_squared = "\\Omega_s^2",
    sir_start = "\\Omega_s",
    upper_sir_start = "\\Omega_{s,2}",
    cir_start = "\\Omega_c",
    cir_omega = "\\omega_1",
    peak_growth_squared = "\\kappa_0^2",
    width = "\\lambda",
    sir_width = "\\lambda_s",
    upper_sir_width = "\\lambda_{s,2}",
    cir_width = "\\lambda_c",
    growth = "\\kappa",
    sir_growth = "\\kappa_s",
    cir_growth = "\\kappa_c",
    sir_zup_asymmetry = "\\Delta_{d,s}",
    cir_zup_asymmetry = "\\Delta_{d,c}",
))]
mod formulas {
    use super::terms::*;
    use crate::input::RotorParameters;
    // ---- Crack compliance, Eq. (8) --------------------------------------------------------------
    /// Tada's root $\sqrt{\tan l / l}$ with $l = \pi\alpha/2$, shared by $F_1$, $F_2$ and $F_{III}$ (E5).
    pub fn tada_root(alpha: f64) -> f64 {
        let l = std::f64::consts::FRAC_PI_2 * alpha;
        (l.tan() / l).sqrt()
    }

    /// Geometry factor $F_1$ of mode I, bending across the edge (E5); $\alpha = \xi/h$.
    pub fn mode_one_lateral(alpha: f64) -> f64 {
        let l = std::f64::consts::FRAC_PI_2 * alpha;
        tada_root(alpha) * (0.752 + 2.02 * alpha + 0.37 * (1.0 - l.sin()).powi(3)) / l.cos()
    }

    /// Geometry factor $F_2$ of mode I, bending along the depth (E5); $\alpha = \xi/h$.
    pub fn mode_one_opening(alpha: f64) -> f64 {
        let l = std::f64::consts::FRAC_PI_2 * alpha;
        tada_root(alpha) * (0.923 + 0.199 * (1.0 - l.sin()).powi(4)) / l.cos()
    }

    /// Geometry factor $F_{II}$ of the sliding mode (E5); $\alpha = \xi/h$.
    pub fn mode_two(alpha: f64) -> f64 {
        (1.122 - 0.561 * alpha + 0.085 * alpha.powi(2) + 0.18 * alpha.powi(3))
            / (1.0 - alpha).sqrt()
    }

    /// Geometry factor $F_{III}$ of the tearing mode (E5); $\alpha = \xi/h$.
    pub fn mode_three(alpha: f64) -> f64 {
        tada_root(alpha)
    }

    /// Half the crack's edge over the radius, $\bar b = \sqrt{1-(1-\sigma)^2}$ (E4).
    pub fn edge_half_width(sigma: f64) -> f64 {
        (sigma * (2.0 - sigma)).sqrt()
    }

    /// Height $h/R = 2\sqrt{1-\bar\mu^2}$ of the strip at the half width $\bar\mu$ (E4).
    pub fn strip_height(mu: f64) -> f64 {
        2.0 * (1.0 - mu.powi(2)).sqrt()
    }

    /// Depth $\bar a = \sqrt{1-\bar\mu^2} - (1-\sigma)$ of the crack in that strip (E4), without a difference near 1.
    pub fn strip_depth(mu: f64, sigma: f64) -> f64 {
        sigma - mu.powi(2) / (1.0 + (1.0 - mu.powi(2)).sqrt())
    }

    /// The double integral of Eq. (8a), $\iint \bar\xi F_{II}^2$.
    #[approximate(sigma = 0.0..=1.0, factor = sigma.powi(2) * sigma.sqrt(), tolerance = 1e-13)]
    #[generate(value, gradient)]
    pub fn sliding_integral(sigma: f64) -> f64 {
        integral(
            |mu| {
                integral(
                    |xi| xi * mode_two(xi / strip_height(mu)).powi(2),
                    0.0..strip_depth(mu, sigma),
                )
            },
            0.0..edge_half_width(sigma),
        )
    }

    /// The double integral of Eq. (8b), $\iint \bar\xi F_{III}^2$.
    #[approximate(sigma = 0.0..=1.0, factor = sigma.powi(2) * sigma.sqrt(), tolerance = 1e-13)]
    #[generate(value, gradient)]
    pub fn tearing_integral(sigma: f64) -> f64 {
        integral(
            |mu| {
                integral(
                    |xi| xi * mode_three(xi / strip_height(mu)).powi(2),
                    0.0..strip_depth(mu, sigma),
                )
            },
            0.0..edge_half_width(sigma),
        )
    }

    /// The double integral of Eq. (8c), $\iint \bar\xi (1-\bar\mu^2) F_2^2$.
    #[approximate(sigma = 0.0..=1.0, factor = sigma.powi(2) * sigma.sqrt(), tolerance = 1e-13)]
    #[generate(value, gradient)]
    pub fn opening_integral(sigma: f64) -> f64 {
        integral(
            |mu| {
                (1.0 - mu.powi(2))
                    * integral(
                        |xi| xi * mode_one_opening(xi / strip_height(mu)).powi(2),
                        0.0..strip_depth(mu, sigma),
                    )
            },
            0.0..edge_half_width(sigma),
        )
    }

    /// The double integral of Eq. (8d), $\iint \bar\xi \bar\mu^2 F_1^2$.
    #[approximate(sigma = 0.0..=1.0, factor = sigma.powi(3) * sigma.sqrt(), tolerance = 1e-13)]
    #[generate(value, gradient)]
    pub fn lateral_integral(sigma: f64) -> f64 {
        integral(
            |mu| {
                mu.powi(2)
                    * integral(
                        |xi| xi * mode_one_lateral(xi / strip_height(mu)).powi(2),
                        0.0..strip_depth(mu, sigma),
                    )
            },
            0.0..edge_half_width(sigma),
        )
    }

    /// Crack compliance, Eq. (8). `edge_factor` is 32 where one half of the edge opens, 64 where both do (E6).
    #[generate(value, columns, chain)]
    pub fn crack_compliance(p: &RotorParameters, edge_factor: f64) -> CrackCompliance {
        let plane_strain = (1.0 - p.shaft_poissons_ratio.powi(2))
            / (std::f64::consts::PI * p.shaft_youngs_modulus * p.shaft_radius);
        let bending = plane_strain / p.shaft_radius.powi(2);
        CrackCompliance {
            c11: 4.0 * plane_strain * sliding_integral(p.crack_depth_ratio),
            c22: 4.0 * plane_strain * tearing_integral(p.crack_depth_ratio),
            c33: 64.0 * bending * opening_integral(p.crack_depth_ratio),
            c44: edge_factor * bending * lateral_integral(p.crack_depth_ratio),
        }
    }

    // ---- Flexibility and stiffness, Eqs. (5) to (10) --------------------------------------------
    /// Flexibility of the uncracked, simply supported shaft at the disk, Eq. (7).
    #[generate(value)]
    pub fn shaft_flexibility(p: &RotorParameters) -> ShaftFlexibility {
        let left = p.disk_position_ratio;
        let right = 1.0 - left;
        let bending_stiffness =
            p.shaft_youngs_modulus * std::f64::consts::FRAC_PI_4 * p.shaft_radius.powi(4);
        let scale = p.shaft_length / (3.0 * bending_stiffness);
        ShaftFlexibility {
            f11: scale * p.shaft_length.powi(2) * (left * right).powi(2),
            f14: scale * p.shaft_length * left * right * (right - left),
            f44: scale * (left.powi(3) + right.powi(3)),
            determinant: (scale * p.shaft_length).powi(2) * (left * right).powi(3),
        }
    }

    /// The loads at the crack in the model `support-arm`: Eq. (6) with the lever arm $-l_c$ (E3).
    #[generate(value, columns, chain)]
    pub fn support_arm(p: &RotorParameters) -> SectionLoads {
        SectionLoads {
            moment_of_force: -p.crack_position_ratio * p.shaft_length,
            shear_of_force: 1.0,
            moment_of_couple: 1.0,
            shear_of_couple: 0.0,
        }
    }

    /// The loads at the crack in the model `midspan-arm`: Eq. (6) as printed, with the arm $L/2 - l_c$.
    #[generate(value, columns, chain)]
    pub fn midspan_arm(p: &RotorParameters) -> SectionLoads {
        SectionLoads {
            moment_of_force: (0.5 - p.crack_position_ratio) * p.shaft_length,
            shear_of_force: 1.0,
            moment_of_couple: 1.0,
            shear_of_couple: 0.0,
        }
    }

    /// The loads at a crack left of the disk in the model `simply-supported`: statics of the beam.
    #[generate(value, columns, chain)]
    pub fn simply_supported_left(p: &RotorParameters) -> SectionLoads {
        let right = 1.0 - p.disk_position_ratio;
        SectionLoads {
            moment_of_force: right * p.crack_position_ratio * p.shaft_length,
            shear_of_force: right,
            moment_of_couple: -p.crack_position_ratio,
            shear_of_couple: -1.0 / p.shaft_length,
        }
    }

    /// The loads at a crack right of the disk in the model `simply-supported`: statics of the beam.
    #[generate(value, columns, chain)]
    pub fn simply_supported_right(p: &RotorParameters) -> SectionLoads {
        let left = p.disk_position_ratio;
        SectionLoads {
            moment_of_force: left * (1.0 - p.crack_position_ratio) * p.shaft_length,
            shear_of_force: -left,
            moment_of_couple: 1.0 - p.crack_position_ratio,
            shear_of_couple: -1.0 / p.shaft_length,
        }
    }

    /// Flexibility of the cracked shaft, Eq. (6), for the loads of any crack model.
    #[generate(value)]
    pub fn cracked_flexibility(
        f: &ShaftFlexibility,
        c: &CrackCompliance,
        s: &SectionLoads,
    ) -> CrackedFlexibility {
        let shear_coupling = s.shear_of_force * s.shear_of_couple;
        let moment_coupling = s.moment_of_force * s.moment_of_couple;
        CrackedFlexibility {
            a11: f.f11 + c.c11 * s.shear_of_force.powi(2) + c.c44 * s.moment_of_force.powi(2),
            a14: f.f14 + c.c11 * shear_coupling + c.c44 * moment_coupling,
            a22: f.f11 + c.c22 * s.shear_of_force.powi(2) + c.c33 * s.moment_of_force.powi(2),
            a23: -(f.f14 + c.c22 * shear_coupling + c.c33 * moment_coupling),
            a33: f.f44 + c.c22 * s.shear_of_couple.powi(2) + c.c33 * s.moment_of_couple.powi(2),
            a44: f.f44 + c.c11 * s.shear_of_couple.powi(2) + c.c44 * s.moment_of_couple.powi(2),
        }
    }

    /// Determinant $a_{11}a_{44} - a_{14}^2$ of a plane of Eq. (6) from the crack's compliances in it, each term ≥ 0.
    pub fn flexibility_determinant(
        f: &ShaftFlexibility,
        s: &SectionLoads,
        shear: f64,
        bending: f64,
    ) -> f64 {
        let by_moment = f.f44 * s.moment_of_force.powi(2)
            - 2.0 * f.f14 * s.moment_of_force * s.moment_of_couple
            + f.f11 * s.moment_of_couple.powi(2);
        let by_shear = f.f44 * s.shear_of_force.powi(2)
            - 2.0 * f.f14 * s.shear_of_force * s.shear_of_couple
            + f.f11 * s.shear_of_couple.powi(2);
        let crossed = s.moment_of_force * s.shear_of_couple - s.moment_of_couple * s.shear_of_force;
        f.determinant + bending * by_moment + shear * by_shear + shear * bending * crossed.powi(2)
    }

    /// Stiffness of the cracked shaft, Eq. (10).
    ///
    /// As $A_1^{-1} - A_2^{-1} = A_1^{-1}(A_2 - A_1)A_2^{-1}$ with the crack's own $A_2 - A_1$, a shallow one keeps all digits.
    #[generate(value, columns, chain)]
    pub fn stiffness(p: &RotorParameters, s: &SectionLoads, c: &CrackCompliance) -> Stiffness {
        let f = shaft_flexibility(p);
        let a = cracked_flexibility(&f, c, s);
        let half_inverse_1 = 0.5 / flexibility_determinant(&f, s, c.c11, c.c44);
        let half_inverse_2 = 0.5 / flexibility_determinant(&f, s, c.c22, c.c33);

        // adj(F) applied to the moments and to the shears, and the loads' cross product.
        let moment_t = f.f44 * s.moment_of_force - f.f14 * s.moment_of_couple;
        let moment_m = f.f11 * s.moment_of_couple - f.f14 * s.moment_of_force;
        let shear_t = f.f44 * s.shear_of_force - f.f14 * s.shear_of_couple;
        let shear_m = f.f11 * s.shear_of_couple - f.f14 * s.shear_of_force;
        let crossed = s.moment_of_force * s.shear_of_couple - s.moment_of_couple * s.shear_of_force;
        // adj(A) applied to the same, in each plane.
        let moment_t_1 = moment_t + c.c11 * crossed * s.shear_of_couple;
        let moment_m_1 = moment_m - c.c11 * crossed * s.shear_of_force;
        let moment_t_2 = moment_t + c.c22 * crossed * s.shear_of_couple;
        let moment_m_2 = moment_m - c.c22 * crossed * s.shear_of_force;
        let shear_t_1 = shear_t - c.c44 * crossed * s.moment_of_couple;
        let shear_m_1 = shear_m + c.c44 * crossed * s.moment_of_force;
        let shear_t_2 = shear_t - c.c33 * crossed * s.moment_of_couple;
        let shear_m_2 = shear_m + c.c33 * crossed * s.moment_of_force;

        let by_bending = 2.0 * half_inverse_1 * half_inverse_2 * (c.c33 - c.c44);
        let by_shear = 2.0 * half_inverse_1 * half_inverse_2 * (c.c22 - c.c11);
        Stiffness {
            k_tt: half_inverse_1 * a.a44 + half_inverse_2 * a.a33,
            k_tm: half_inverse_2 * a.a23 - half_inverse_1 * a.a14,
            k_mm: half_inverse_1 * a.a11 + half_inverse_2 * a.a22,
            delta_k_tt: by_bending * moment_t_1 * moment_t_2 + by_shear * shear_t_1 * shear_t_2,
            delta_k_tm: by_bending * moment_t_1 * moment_m_2 + by_shear * shear_t_1 * shear_m_2,
            delta_k_mm: by_bending * moment_m_1 * moment_m_2 + by_shear * shear_m_1 * shear_m_2,
        }
    }

    /// Reference speed $\omega_{st} = \sqrt{k_{tt}/m_d}$, rad/s.
    #[generate(value, columns, chain)]
    pub fn reference_speed(p: &RotorParameters, k: &Stiffness) -> f64 {
        (k.k_tt / p.disk_mass).sqrt()
    }

    /// The dimensionless numbers of Eq. (12).
    #[generate(value, columns, chain)]
    pub fn coefficients(p: &RotorParameters, k: &Stiffness) -> Coefficients {
        Coefficients {
            beta: p.disk_polar_inertia / p.disk_diametral_inertia,
            gamma: k.k_tm / k.k_tt * (p.disk_mass / p.disk_diametral_inertia).sqrt(),
            delta: k.k_mm / k.k_tt * (p.disk_mass / p.disk_diametral_inertia),
            epsilon_1: k.delta_k_tt / k.k_tt,
            epsilon_12: k.delta_k_tm / k.k_tm,
            epsilon_2: k.delta_k_mm / k.k_mm,
            disk_asymmetry: p.disk_asymmetry,
            crack_angle: p.crack_angle,
        }
    }

    // ---- Frequency equations, Eqs. (13) and (22) to (25) -----------------------------------------
    /// $H = 1 - \omega^2$, Eq. (23).
    pub fn transverse(omega: f64) -> f64 {
        1.0 - omega.powi(2)
    }

    /// $G = \delta - \omega^2 + \beta\Omega\omega$, Eq. (23).
    pub fn tilting(omega: f64, speed: f64, c: &Coefficients) -> f64 {
        c.delta - omega.powi(2) + c.beta * speed * omega
    }

    /// Whirl frequency equation of the symmetric, uncracked rotor, Eq. (13): zero at the whirl frequencies.
    #[generate(value, gradient(omega, speed), hessian(omega, speed))]
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

    // ---- Starts of the regions, Eqs. (15), (16) ---------------------------------------------------
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

    /// Square of the start of the simple region, Eq. (15) in the form of E9, good for every $0 < \beta \le 2$.
    pub fn sir_start_squared(c: &Coefficients) -> f64 {
        let q = c.beta - 1.0 - c.delta;
        2.0 * coupled_stiffness(c) / (sir_radicand(c).sqrt() - q)
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

    /// Whirl frequency $\omega_1$ at $\Omega_c$ without a root finder, from $\omega_1 + \omega_2 = 2\Omega_c$ and
    /// $\omega_1\omega_2 = (\beta + \sqrt{\beta^2 + 8(2-\beta)C})/(2(2-\beta))$.
    #[generate(value)]
    pub fn cir_omega(c: &Coefficients) -> f64 {
        let product = (c.beta + cir_root(c)) / (2.0 * (2.0 - c.beta));
        let start = cir_start(c);
        start + (start.powi(2) - product).sqrt()
    }

    // ---- Widths, growth and zero unstable points, Eqs. (29) to (32) -------------------------------
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
    /// With $\Theta = \bar H\,\theta$ and $\bar H\bar G = \gamma^2$ it is $-|\gamma\theta|^2/(H\bar G)$, or $-|\gamma\bar\theta|^2/(\bar H G)$. Each form loses
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

    /// First term of Eq. (29): $\kappa_0^2 = (-\Gamma/H\bar H)/(\partial_\omega f_n\,\partial_\omega\bar f_n)$.
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
        let (omega, speed) = (cir_omega(c), cir_start(c));
        let omega_bar = 2.0 * speed - omega;
        let (h, h_bar) = (transverse(omega), transverse(omega_bar));
        let crack = coupled_crack_excitation(h, tilting(omega_bar, speed, c), c);
        let crack_bar = coupled_crack_excitation(h_bar, tilting(omega, speed, c), c);
        (crack_bar - crack) / (c.gamma * omega * omega_bar * (h - h_bar))
    }

    // ---- Both widths straight from the physical rotor ----------------------------------------------
    /// Both widths, $\lambda_s$ and $\lambda_c$, of a rotor with a crack of this compliance, loaded as in `s`; in stages along it.
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, c.c11 >= 0.0, c.c22 >= 0.0, c.c33 >= 0.0, c.c44 >= 0.0)]
    #[generate(chain(sir_width, cir_width), stage(c.c11, c.c22, c.c33, c.c44))]
    pub fn widths(p: &RotorParameters, s: &SectionLoads, c: &CrackCompliance) -> (f64, f64) {
        both_widths(&coefficients(p, &stiffness(p, s, c)))
    }

    /// Both widths in the model of [`support_arm()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(value, gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle), columns)]
    pub fn widths_support_arm(p: &RotorParameters, edge_factor: f64) -> (f64, f64) {
        let c = crack_compliance(p, edge_factor);
        widths(p, &support_arm(p), &c)
    }

    /// Both widths in the model of [`midspan_arm()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(value, gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle), columns)]
    pub fn widths_midspan_arm(p: &RotorParameters, edge_factor: f64) -> (f64, f64) {
        let c = crack_compliance(p, edge_factor);
        widths(p, &midspan_arm(p), &c)
    }

    /// Both widths in the model of [`simply_supported_left()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(value, gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle), columns)]
    pub fn widths_simply_supported_left(p: &RotorParameters, edge_factor: f64) -> (f64, f64) {
        let c = crack_compliance(p, edge_factor);
        widths(p, &simply_supported_left(p), &c)
    }

    /// Both widths in the model of [`simply_supported_right()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(value, gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle), columns)]
    pub fn widths_simply_supported_right(p: &RotorParameters, edge_factor: f64) -> (f64, f64) {
        let c = crack_compliance(p, edge_factor);
        widths(p, &simply_supported_right(p), &c)
    }
}
