//! Units of quantities that have no SI unit of their own.

/// The unit of speeds, widths and growth rates: the reference speed $\omega_{st}$ of the rotor that they are of.
pub const TIMES_REFERENCE_SPEED: &str = "× reference speed";
