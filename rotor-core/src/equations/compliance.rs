//! Crack compliance, Eq. (8): the geometry factors (E5), their integrals over the crack, and what they add to the shaft.

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::geometry))]
mod formulas {
    use crate::equations::geometry::*;
    use crate::equations::terms::*;
    use crate::input::RotorParameters;

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
}
