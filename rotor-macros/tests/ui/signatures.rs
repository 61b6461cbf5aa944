//! What is no formula by its parameters.

pub struct Pair {
    pub first: f64,
    pub second: f64,
}

#[rotor_macros::symbolic]
mod formulas {
    use super::Pair;

    #[generate(value)]
    pub fn generic<T: Into<f64> + Copy>(x: f64, _y: T) -> f64 {
        x * x
    }

    #[generate(value)]
    pub fn of_a_tuple((x, y): (f64, f64)) -> f64 {
        x * y
    }

    #[generate(value)]
    pub fn of_whole_numbers(n: usize, x: &f64, xs: &[f64]) -> f64 {
        xs.len() as f64 + x * n as f64
    }

    #[generate(value)]
    pub fn caller(c: &Pair) -> f64 {
        generic(c.first, c.second) + c.second
    }
}

fn main() {
    let _: f64 = formulas::caller::value(&Pair { first: 1.0, second: 2.0 });
}
