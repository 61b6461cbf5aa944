//! The paper's rotor: a disk of two unequal diametral inertias on a simply supported shaft with an open crack, its closed
//! forms and its exact algebra.

pub mod exact;
pub mod region;
pub mod rotor;
pub mod zup;
