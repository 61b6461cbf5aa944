//! Mistakes in calls of formulas of linked modules.
#![allow(dead_code)]

#[rotor_macros::symbolic(sizes = 1e-6..=1e6, domain(x > 0.0))]
mod shaft {
    pub fn stiffness(x: f64, y: f64) -> f64 {
        x * y
    }

    pub fn weight(x: f64) -> f64 {
        x
    }

    /// Its own mistake, which is reported here and nowhere else.
    pub fn broken(x: f64) -> f64 {
        x.sqr()
    }

    fn hidden(x: f64) -> f64 {
        x
    }
}

#[rotor_macros::symbolic(sizes = 1e-3..=1e3, domain(x <= 1.0))]
mod disk {
    pub fn weight(x: f64) -> f64 {
        2.0 * x
    }

    pub fn hidden(x: f64) -> f64 {
        x
    }
}

#[rotor_macros::symbolic(with(crate::shaft, crate::disk))]
mod width {
    use crate::disk;
    use crate::disk::*;
    use crate::shaft::*;

    pub fn misspelt(x: f64) -> f64 {
        stifness(x, x)
    }

    pub fn misspelt_by_path(x: f64) -> f64 {
        disk::wight(x)
    }

    pub fn too_few(x: f64) -> f64 {
        stiffness(x)
    }

    pub fn one_of_two(x: f64) -> f64 {
        weight(x)
    }

    pub fn told_apart(x: f64) -> f64 {
        crate::shaft::weight(x) + disk::weight(x) + hidden(x)
    }

    pub fn not_generated(x: f64) -> f64 {
        stiffness::d_x(x, x)
    }

    #[generate(value)]
    pub fn calls_broken(x: f64) -> f64 {
        broken(x)
    }

    pub fn elsewhere(x: f64) -> f64 {
        crate::other::weight(x)
    }
}

#[rotor_macros::symbolic(with("shaft", other::<f64>))]
mod paths {}

#[rotor_macros::symbolic]
mod asked {
    #[generate(d_z)]
    pub fn one(x: f64) -> f64 {
        x
    }

    #[generate(d_x)]
    pub fn two(x: f64) -> (f64, f64) {
        (x, x)
    }

    #[generate(d_x, budget(mul = 1))]
    pub fn three(x: f64) -> f64 {
        x
    }
}

mod other {
    pub fn weight(x: f64) -> f64 {
        x
    }
}

fn main() {}
