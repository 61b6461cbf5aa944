//! Modules that link each other in a circle, and one that is none.
#![allow(dead_code)]

#[rotor_macros::symbolic(with(crate::two))]
mod one {
    pub fn f(x: f64) -> f64 {
        crate::two::g(x)
    }
}

#[rotor_macros::symbolic(with(crate::three))]
mod two {
    pub fn g(x: f64) -> f64 {
        crate::three::h(x)
    }
}

#[rotor_macros::symbolic(with(crate::one))]
mod three {
    pub fn h(x: f64) -> f64 {
        crate::one::f(x)
    }
}

#[rotor_macros::symbolic(with(crate::plain))]
mod four {
    pub fn f(x: f64) -> f64 {
        x
    }
}

mod plain {}

fn main() {}
