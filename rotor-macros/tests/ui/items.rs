//! Where the attribute can't stand.

#[rotor_macros::symbolic]
fn product(x: f64, y: f64) -> f64 {
    x * y
}

#[rotor_macros::symbolic]
mod formulas {
    #[generate(value)]
    pub fn of_self(self, x: f64) -> f64 {
        x * x
    }
}

fn main() {}
