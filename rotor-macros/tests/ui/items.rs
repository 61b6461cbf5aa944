//! Where the attribute can't stand.

#[rotor_macros::symbolic]
fn product(x: f64, y: f64) -> f64 {
    x * y
}

#[rotor_macros::symbolic]
mod names {
    use super::first;

    pub struct ColumnLengthError;

    pub fn gauss_table(x: f64) -> f64 {
        x
    }

    #[approximate(x = 0.0..=1.0, tolerance = 1e-3)]
    #[generate(value, columns)]
    pub fn gauss(x: f64) -> f64 {
        (x * x).exp()
    }

    pub mod gauss {}

    #[generate(value)]
    pub fn second(x: f64) -> f64 {
        x
    }

    #[cfg(any())]
    #[generate(value)]
    pub fn second(x: f64) -> f64 {
        2.0 * x
    }
}

pub fn first() {}

#[rotor_macros::symbolic]
mod formulas {
    #[generate(value)]
    pub fn of_self(self, x: f64) -> f64 {
        x * x
    }
}

fn main() {
    let _: f64 = product(1.0, 2.0);
}
