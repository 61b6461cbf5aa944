//! What can't be specialised.

#[rotor_macros::symbolic]
mod formulas {
    #[specialise]
    #[specialise(no_replacement)]
    #[specialise(wrong_parts, x = 1.0, gradient, "value")]
    #[specialise(no_parameter, z = 1.0)]
    #[specialise(no_name, 1.0 = x)]
    #[specialise(twice, x = 1.0, x = 2.0)]
    #[specialise(product, x = 1.0)]
    #[specialise(special, x = 1.0)]
    #[specialise(special, y = 1.0)]
    #[specialise(unknown_replacement, x = zz)]
    #[specialise(no_element, x[0] = 1.0)]
    pub fn product(x: f64, y: f64) -> f64 {
        x * y
    }

    pub struct Crack {
        pub beta: f64,
        pub mu: f64,
    }

    #[specialise(no_field, c.betta = 1.0)]
    #[specialise(whole_and_part, c = d, c.beta = 1.0)]
    #[specialise(no_such_element, a[2] = 1.0)]
    pub fn of_parts(c: &Crack, d: &Crack, a: [f64; 2]) -> f64 {
        c.beta * d.mu * a[0]
    }
}

fn main() {}
