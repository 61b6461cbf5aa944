//! The widths straight from the physical rotor, through its crack's compliance, its stiffness and its coefficients.

pub use formulas::*;

#[rotor_macros::symbolic(with(
    crate::equations::geometry,
    crate::equations::compliance,
    crate::equations::shaft,
    crate::equations::width,
))]
mod formulas {
    use crate::equations::compliance::*;
    use crate::equations::geometry::*;
    use crate::equations::shaft::*;
    use crate::equations::terms::*;
    use crate::equations::width::*;
    use crate::input::RotorParameters;

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

    /// The width $\lambda_s$ of the upper simple region in the model of [`support_arm()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle))]
    pub fn upper_width_support_arm(p: &RotorParameters, edge_factor: f64) -> f64 {
        let c = crack_compliance(p, edge_factor);
        upper_sir_width(&coefficients(p, &stiffness(p, &support_arm(p), &c)))
    }

    /// The width $\lambda_s$ of the upper simple region in the model of [`midspan_arm()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle))]
    pub fn upper_width_midspan_arm(p: &RotorParameters, edge_factor: f64) -> f64 {
        let c = crack_compliance(p, edge_factor);
        upper_sir_width(&coefficients(p, &stiffness(p, &midspan_arm(p), &c)))
    }

    /// The width $\lambda_s$ of the upper simple region in the model of [`simply_supported_left()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle))]
    pub fn upper_width_simply_supported_left(p: &RotorParameters, edge_factor: f64) -> f64 {
        let c = crack_compliance(p, edge_factor);
        upper_sir_width(&coefficients(
            p,
            &stiffness(p, &simply_supported_left(p), &c),
        ))
    }

    /// The width $\lambda_s$ of the upper simple region in the model of [`simply_supported_right()`].
    #[domain(p.disk_mass > 0.0, p.disk_diametral_inertia > 0.0, p.disk_polar_inertia > 0.0, p.disk_position_ratio > 0.0, p.shaft_length > 0.0, p.shaft_radius > 0.0, p.shaft_youngs_modulus > 0.0, p.crack_depth_ratio >= 0.0, p.crack_position_ratio > 0.0, edge_factor > 0.0)]
    #[generate(gradient(p.disk_mass, p.disk_diametral_inertia, p.disk_polar_inertia, p.disk_asymmetry, p.disk_position_ratio, p.shaft_length, p.shaft_radius, p.shaft_youngs_modulus, p.shaft_poissons_ratio, p.crack_depth_ratio, p.crack_position_ratio, p.crack_angle))]
    pub fn upper_width_simply_supported_right(p: &RotorParameters, edge_factor: f64) -> f64 {
        let c = crack_compliance(p, edge_factor);
        upper_sir_width(&coefficients(
            p,
            &stiffness(p, &simply_supported_right(p), &c),
        ))
    }
}
