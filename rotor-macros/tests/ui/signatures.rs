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
    pub fn with_mistakes_inside(n: usize, x: f64) -> f64 {
        n[0] + n.first + unheard_of + x
    }

    #[generate(value)]
    pub unsafe fn not_safe(x: f64) -> f64 {
        x
    }

    #[generate(value)]
    pub async fn later(x: f64) -> f64 {
        x
    }

    #[generate(value)]
    pub fn other_shape(x: f64) -> (f64, f64) {
        x
    }

    #[generate(value)]
    pub fn other_length(x: f64) -> [f64; 3] {
        return [x, x];
    }

    pub struct Crack {
        pub beta: f64,
        pub mu: f64,
    }

    #[generate(value)]
    pub fn other_struct(x: f64) -> Crack {
        x * x
    }

    #[generate(value)]
    pub fn no_type(x: f64) {
        (x, [x, x])
    }

    #[generate(value)]
    pub fn unknown_fields(c: &Crack) -> Crack {
        let beta = c.betta + c.unheard_of;
        Crack { beta, my: c.mu, first: 1.0 }
    }

    #[generate(value)]
    pub fn incomplete(c: &Crack) -> Crack {
        Crack { beta: c.beta }
    }

    #[generate(value)]
    pub fn pass(c: Crack) -> Crack {
        c
    }

    #[generate(value)]
    pub fn updated(c: Crack) -> (f64, Crack) {
        (c.mu, Crack { beta: 1.0, ..c })
    }

    #[generate(value)]
    pub fn caller(c: &Pair) -> f64 {
        generic(c.first, c.second) + c.second
    }
}

fn main() {
    let _: f64 = formulas::caller::value(&Pair { first: 1.0, second: 2.0 });
}
