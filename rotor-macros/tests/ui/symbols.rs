//! What can't be said about the names of a module.

#[rotor_macros::symbolic(names(x = "x"), latex(speed, omega = "\\omega", omega = "w", delta = "\\delta}"))]
mod formulas {
    pub fn product(omega: f64, speed: f64) -> f64 {
        omega * speed
    }
}

fn main() {}
