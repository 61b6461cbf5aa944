//! Every closed form of the paper, each written once, as plain Rust under the generator. E1 to E13 are the
//! [corrections](crate::corrections) to the printed text.
//!
//! A file for each subject, in the order in which a rotor passes; each links those whose formulas it calls.
//!
//! A formula is a function, and the generated forms stand in a module of its name:
//!
//! ```
//! use rotor_core::equations;
//! use rotor_core::jeffcott::rotor::Rotor;
//!
//! let c = Rotor::paper().coefficients()?;
//! let (width, by_coefficients) = equations::sir_width::gradient(&c);
//! assert!((width - equations::sir_width(&c)).abs() < 1e-14);
//! println!("the width changes by {:?} per unit of each coefficient", by_coefficients);
//! # Ok::<(), rotor_core::error::Error>(())
//! ```

mod compliance;
mod frequency;
mod geometry;
mod physical;
mod shaft;
mod start;
mod terms;
mod width;
mod zup;

pub use compliance::*;
pub use frequency::*;
pub use geometry::*;
pub use linked::*;
pub use physical::*;
pub use shaft::*;
pub use start::*;
pub use terms::*;
pub use width::*;
pub use zup::*;

/// The files of the formulas, each with its path below the crate's source, for tools that show a formula as it is written.
pub const SOURCES: [(&str, &str); 9] = [
    ("equations.rs", include_str!("equations.rs")),
    (
        "equations/geometry.rs",
        include_str!("equations/geometry.rs"),
    ),
    (
        "equations/compliance.rs",
        include_str!("equations/compliance.rs"),
    ),
    ("equations/shaft.rs", include_str!("equations/shaft.rs")),
    (
        "equations/frequency.rs",
        include_str!("equations/frequency.rs"),
    ),
    ("equations/start.rs", include_str!("equations/start.rs")),
    ("equations/width.rs", include_str!("equations/width.rs")),
    ("equations/zup.rs", include_str!("equations/zup.rs")),
    (
        "equations/physical.rs",
        include_str!("equations/physical.rs"),
    ),
];

/// What holds for all formulas.
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
    moment_of_left = "M_A",
    shear_of_left = "V_A",
    moment_of_right = "M_B",
    shear_of_right = "V_B",
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
mod conventions {}

/// The chain of all formulas.
#[rotor_macros::symbolic(chain, with(compliance, geometry, shaft, start, width, zup, physical))]
mod linked {
    use super::terms::*;
}
