//! The cracked section (E4), and the loads on it in each model of the crack.

pub use formulas::*;

#[rotor_macros::symbolic(with(crate::equations::conventions))]
mod formulas {
    use crate::equations::terms::*;
    use crate::input::RotorParameters;

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

    /// The loads at the crack in the model `support-arm`: Eq. (6) with the lever arm $-l_c$ (E3).
    #[generate(value, columns, chain)]
    pub fn support_arm(p: &RotorParameters) -> SectionLoads {
        let (crack, disk) = (p.crack_position_ratio, p.disk_position_ratio);
        SectionLoads {
            moment_of_force: -crack * p.shaft_length,
            shear_of_force: 1.0,
            moment_of_couple: 1.0,
            shear_of_couple: 0.0,
            moment_of_left: -(crack + disk) * p.shaft_length,
            shear_of_left: 1.0,
            moment_of_right: (1.0 - disk - crack) * p.shaft_length,
            shear_of_right: 1.0,
        }
    }

    /// The loads at the crack in the model `midspan-arm`: Eq. (6) as printed, with the arm $L/2 - l_c$.
    #[generate(value, columns, chain)]
    pub fn midspan_arm(p: &RotorParameters) -> SectionLoads {
        let (arm, disk) = (0.5 - p.crack_position_ratio, p.disk_position_ratio);
        SectionLoads {
            moment_of_force: arm * p.shaft_length,
            shear_of_force: 1.0,
            moment_of_couple: 1.0,
            shear_of_couple: 0.0,
            moment_of_left: (arm - disk) * p.shaft_length,
            shear_of_left: 1.0,
            moment_of_right: (arm + (1.0 - disk)) * p.shaft_length,
            shear_of_right: 1.0,
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
            moment_of_left: p.crack_position_ratio * p.shaft_length,
            shear_of_left: 1.0,
            moment_of_right: 0.0,
            shear_of_right: 0.0,
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
            moment_of_left: 0.0,
            shear_of_left: 0.0,
            moment_of_right: (1.0 - p.crack_position_ratio) * p.shaft_length,
            shear_of_right: -1.0,
        }
    }
}
