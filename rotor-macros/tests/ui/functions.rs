//! Functions and choices that are no part of a formula, each with what to write instead.

#[rotor_macros::symbolic]
mod formulas {
    pub fn methods(x: f64) -> f64 {
        x.tahn() + x.arctan() + x.sinc() + f64::atan2(x) + f64::sin()
    }

    pub fn functions(x: f64) -> f64 {
        atan2(x, 1.0) + tanh(x)
    }

    pub fn zeros(x: f64) -> f64 {
        x / 0.0 + 1.0 / -(0.0)
    }

    pub fn sinc(x: f64) -> f64 {
        sin(x) / x
    }

    pub fn conditions(x: f64) -> f64 {
        let without = if x > 0.0 { x };
        let of_a_number = if x { 1.0 } else { 2.0 };
        let as_number = (x > 0.0) * 2.0;
        let bound = if let y = x { y } else { 0.0 };
        let joined = if x > 0.0 && x { 1.0 } else { 2.0 };
        let other = if x > 0.0 { x } else { (x, x) };
        without + of_a_number + as_number + bound + joined + other
    }

    pub fn patterns(x: f64) -> f64 {
        match x {
            0.0 => 1.0,
            1.0..=2.0 => x,
            _ => 2.0,
        }
    }

    pub fn of_crates(x: f64) -> f64 {
        x.erf() + libm::erf(x, x) + libm::tgamma(x) + libm::erfc([x])
    }

    pub fn numbers(x: f64) -> f64 {
        const COUNT: usize = 3;
        let single = x as f32;
        x * f64::INFINITY + COUNT as f64 + single as f64
    }
}

fn main() {}
