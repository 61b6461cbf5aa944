//! Parametric instability of a rotor with an asymmetric disk and a transverse shaft crack.
pub mod equations;
