//! Flexibility and stiffness of the cracked shaft, Eqs. (5) to (10), and the dimensionless numbers of Eq. (12).

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::conventions))]
mod formulas {
    use crate::equations::terms::*;
    use crate::input::RotorParameters;

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
            of_left: scale * right.powi(3),
            of_right: scale * left.powi(3),
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

    /// $M_F V_M - M_M V_F$, the loads' cross product.
    pub fn crossed_loads(p: &RotorParameters, s: &SectionLoads) -> f64 {
        (s.moment_of_left * s.shear_of_right - s.moment_of_right * s.shear_of_left) / p.shaft_length
    }

    /// Determinant $a_{11}a_{44} - a_{14}^2$ of a plane of Eq. (6) from the crack's compliances in it, each term ≥ 0.
    pub fn flexibility_determinant(
        p: &RotorParameters,
        f: &ShaftFlexibility,
        s: &SectionLoads,
        shear: f64,
        bending: f64,
    ) -> f64 {
        let by_moment =
            f.of_left * s.moment_of_left.powi(2) + f.of_right * s.moment_of_right.powi(2);
        let by_shear = f.of_left * s.shear_of_left.powi(2) + f.of_right * s.shear_of_right.powi(2);
        f.determinant
            + bending * by_moment
            + shear * by_shear
            + shear * bending * crossed_loads(p, s).powi(2)
    }

    /// Stiffness of the cracked shaft, Eq. (10).
    ///
    /// As $A_1^{-1} - A_2^{-1} = A_1^{-1}(A_2 - A_1)A_2^{-1}$ with the crack's own $A_2 - A_1$, a shallow one keeps all digits.
    #[generate(value, columns, chain)]
    pub fn stiffness(p: &RotorParameters, s: &SectionLoads, c: &CrackCompliance) -> Stiffness {
        let f = shaft_flexibility(p);
        let a = cracked_flexibility(&f, c, s);
        let half_inverse_1 = 0.5 / flexibility_determinant(p, &f, s, c.c11, c.c44);
        let half_inverse_2 = 0.5 / flexibility_determinant(p, &f, s, c.c22, c.c33);

        // adj(F) applied to the moments and to the shears, f44 M_F − f14 M_M and f11 M_M − f14 M_F, by reactions, and the loads'
        // cross product.
        let left = f.of_left * p.disk_position_ratio * p.shaft_length;
        let right = f.of_right * (1.0 - p.disk_position_ratio) * p.shaft_length;
        let moment_t = f.of_left * s.moment_of_left + f.of_right * s.moment_of_right;
        let moment_m = right * s.moment_of_right - left * s.moment_of_left;
        let shear_t = f.of_left * s.shear_of_left + f.of_right * s.shear_of_right;
        let shear_m = right * s.shear_of_right - left * s.shear_of_left;
        let crossed = crossed_loads(p, s);
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
}
