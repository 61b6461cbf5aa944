//! What can't be specialised.

#[rotor_macros::symbolic]
mod formulas {
    #[specialise]
    #[specialise(no_replacement)]
    #[specialise(wrong_parts, x = 1.0, gradient, "value")]
    #[specialise(no_parameter, z = 1.0)]
    #[specialise(no_name, 1.0 = x)]
    pub fn product(x: f64, y: f64) -> f64 {
        x * y
    }
}

fn main() {}
