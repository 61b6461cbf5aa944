//! What attributes may name: fields and elements, also those that the formula does not depend on, under conditions.
#![allow(unreachable_pub, reason = "a formula is `pub` as in a library")]

/// The sides of a rectangle, a struct of another module.
#[derive(Clone, Copy, Debug)]
pub struct Sides {
    /// Width, m.
    pub width: f64,
    /// Height, m.
    pub height: f64,
}

#[rotor_macros::symbolic]
mod formulas {
    /// Coefficients.
    pub struct Coefficients {
        /// Used.
        pub beta: f64,
        /// Not used.
        pub mu: f64,
    }

    /// By a field that it does not use.
    #[generate(columns, gradient(c.beta, c.mu), hessian(c.beta, c.mu))]
    pub fn twice(c: &Coefficients) -> f64 {
        2.0 * c.beta
    }

    /// Its partial by that field.
    #[generate(value)]
    pub fn by_unused(c: &Coefficients) -> f64 {
        twice::d_c_beta(c) + twice::d_c_mu(c)
    }

    /// By what the source names, in the order of the parameters, whatever cancels.
    #[domain(y > 0.0)]
    #[generate(gradient)]
    pub fn order(x: f64, y: f64, _unused: f64) -> f64 {
        let same = y;
        same - y + 3.0 * x
    }

    /// No number at all.
    #[generate(gradient)]
    pub fn constant() -> f64 {
        1.0
    }

    /// With fields and elements replaced.
    #[specialise(flat, s.height = 2.0, generate(value, gradient(s.width)))]
    #[specialise(square, s.height = s.width, c.mu = 0.5 * c.beta, a[1] = a[0])]
    #[generate(value)]
    pub fn sum(s: &super::Sides, c: Coefficients, a: [f64; 2]) -> f64 {
        s.width * s.height.powi(2) + c.beta * c.mu.sin() + a[0] / (a[1] + 1.0)
    }

    /// Of a struct with one field of another value.
    #[generate(value)]
    pub fn raised(s: &super::Sides) -> f64 {
        area(&super::Sides {
            height: s.height + 1.0,
            ..*s
        })
    }

    /// Area, m².
    pub fn area(s: &super::Sides) -> f64 {
        s.width * s.height
    }

    /// Not compiled, nor is anything that is made from it.
    #[cfg(any())]
    #[specialise(special_elsewhere, n = 1.0)]
    #[generate(value)]
    pub fn elsewhere(x: nowhere::Number, n: f64) -> f64 {
        n * x.value
    }
}

use formulas::Coefficients;

const SIDES: Sides = Sides {
    width: 3.0,
    height: 4.0,
};

#[test]
fn a_field_that_is_not_used_has_a_column_and_a_partial() {
    let c = Coefficients { beta: 1.5, mu: 2.0 };
    assert_eq!(formulas::twice::gradient(&c), (3.0, [2.0, 0.0]));
    assert_eq!(formulas::by_unused::value(&c), 2.0);
    let inputs = formulas::twice::Columns {
        c_beta: &[1.0, 2.0],
        c_mu: &[0.0, 0.0],
    };
    let (mut value, mut by_beta, mut by_mu) = ([0.0; 2], [0.0; 2], [1.0; 2]);
    let outcome =
        formulas::twice::gradient_columns(&inputs, [&mut value, &mut by_beta, &mut by_mu]);
    assert_eq!(outcome, Ok(()));
    assert_eq!((value, by_beta, by_mu), ([2.0, 4.0], [2.0; 2], [0.0; 2]));
}

#[test]
fn partials_without_a_list_are_by_what_the_source_names() {
    assert_eq!(formulas::order::gradient(2.0, 1.0, 0.0), (6.0, [3.0, 0.0]));
    assert_eq!(formulas::constant::gradient(), (1.0, []));
}

#[test]
fn fields_and_elements_can_be_replaced() {
    let c = || Coefficients { beta: 1.5, mu: 2.0 };
    let flat = formulas::flat(&SIDES, c(), [1.0, 2.0]);
    let (value, by_width) = formulas::flat::gradient(&SIDES, c(), [1.0, 2.0]);
    assert!((value - flat).abs() < 1e-14 && by_width == [4.0]);
    assert!((flat - (12.0 + 1.5 * 2.0_f64.sin() + 1.0 / 3.0)).abs() < 1e-14);
    let square = formulas::square(&SIDES, c(), [1.0, 2.0]);
    assert!((square - (27.0 + 1.5 * 0.75_f64.sin() + 0.5)).abs() < 1e-14);
    assert!((formulas::square::value(&SIDES, c(), [1.0, 2.0]) - square).abs() < 1e-14);
}

#[test]
fn a_struct_takes_over_fields_of_another() {
    assert_eq!(formulas::raised::value(&SIDES), 15.0);
    assert_eq!(formulas::raised(&SIDES), 15.0);
}
