//! Every closed form of the paper, each written once.

/// The eight dimensionless numbers that decide stability, Eq. (12) with the disk's asymmetry and the crack's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Inertia ratio β = I_p/I_d.
    pub beta: f64,
    /// Coupling stiffness γ.
    pub gamma: f64,
    /// Tilting stiffness δ.
    pub delta: f64,
    /// Relative amplitude ε₁ of the time-varying transverse stiffness.
    pub epsilon_1: f64,
    /// Relative amplitude ε₁₂ of the time-varying coupling stiffness.
    pub epsilon_12: f64,
    /// Relative amplitude ε₂ of the time-varying tilting stiffness.
    pub epsilon_2: f64,
    /// Relative inertia asymmetry Δ_d of the disk.
    pub disk_asymmetry: f64,
    /// Angle φ between the crack and the disk's major axis, rad.
    pub crack_angle: f64,
}
