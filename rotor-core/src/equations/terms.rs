//! The groups of quantities that the equations take and give, named as in the paper.

/// The eight dimensionless numbers that decide stability: Eq. (12), the disk's asymmetry and the crack's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Coefficients {
    /// Inertia ratio $\beta = I_p/I_d$.
    pub beta: f64,
    /// Time-invariant coupling stiffness $\gamma$.
    pub gamma: f64,
    /// Time-invariant tilting stiffness $\delta$.
    pub delta: f64,
    /// Relative amplitude $\epsilon_1$ of the time-varying transverse stiffness.
    pub epsilon_1: f64,
    /// Relative amplitude $\epsilon_{12}$ of the time-varying coupling stiffness.
    pub epsilon_12: f64,
    /// Relative amplitude $\epsilon_2$ of the time-varying tilting stiffness.
    pub epsilon_2: f64,
    /// Relative inertia asymmetry $\Delta_d$ of the disk.
    pub disk_asymmetry: f64,
    /// Angle $\phi$ between the crack and the disk's major axis, rad.
    pub crack_angle: f64,
}

/// Additional compliance of the crack, Eq. (8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackCompliance {
    /// Shear along the crack's depth, m/N.
    pub c11: f64,
    /// Shear along the crack's edge, m/N.
    pub c22: f64,
    /// Bending that opens the whole edge, rad/(N m).
    pub c33: f64,
    /// Bending that opens one half of the edge, rad/(N m).
    pub c44: f64,
}

/// Moment and shear at the crack's section: from a unit force and from a unit couple at the disk, and from a unit reaction of
/// either support. A force has the reactions $1 - l_d/L$ and $l_d/L$, a couple $-1/L$ and $1/L$; near a support both bend the
/// shaft alike, and only loads by reactions keep their digits in differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionLoads {
    /// Bending moment from the unit force, m.
    pub moment_of_force: f64,
    /// Shear from the unit force, dimensionless.
    pub shear_of_force: f64,
    /// Bending moment from the unit couple, dimensionless.
    pub moment_of_couple: f64,
    /// Shear from the unit couple, 1/m.
    pub shear_of_couple: f64,
    /// Bending moment from the reaction of the left support, m.
    pub moment_of_left: f64,
    /// Shear from the reaction of the left support, dimensionless.
    pub shear_of_left: f64,
    /// Bending moment from the reaction of the right support, m.
    pub moment_of_right: f64,
    /// Shear from the reaction of the right support, dimensionless.
    pub shear_of_right: f64,
}

/// Flexibility of the uncracked shaft at the disk, Eq. (7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaftFlexibility {
    /// Deflection of the unit force, m/N.
    pub f11: f64,
    /// Slope of the unit force, rad/N.
    pub f14: f64,
    /// Slope of the unit couple, rad/(N m).
    pub f44: f64,
    /// $f_{11}f_{44} - f_{14}^2$, 1/N²; of its own, for the difference loses digits near a support.
    pub determinant: f64,
    /// $(L-l_d)^3/(3EIL^2)$, rad/(N m): with the next one what is left of products of loads and flexibilities.
    pub of_left: f64,
    /// $l_d^3/(3EIL^2)$, rad/(N m).
    pub of_right: f64,
}

/// Flexibility of the cracked shaft in the axes that turn with it, Eqs. (5), (6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackedFlexibility {
    /// $a_{11}$, m/N.
    pub a11: f64,
    /// $a_{14}$, rad/N.
    pub a14: f64,
    /// $a_{22}$, m/N.
    pub a22: f64,
    /// $a_{23}$, rad/N.
    pub a23: f64,
    /// $a_{33}$, rad/(N m).
    pub a33: f64,
    /// $a_{44}$, rad/(N m).
    pub a44: f64,
}

/// Mean stiffness of the cracked shaft and its variation over a turn, Eq. (10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// $k_{tt}$, N/m.
    pub k_tt: f64,
    /// $k_{tm}$, N.
    pub k_tm: f64,
    /// $k_{mm}$, N m.
    pub k_mm: f64,
    /// $\Delta k_{tt}$, N/m.
    pub delta_k_tt: f64,
    /// $\Delta k_{tm}$, N.
    pub delta_k_tm: f64,
    /// $\Delta k_{mm}$, N m.
    pub delta_k_mm: f64,
}
