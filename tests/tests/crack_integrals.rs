//! The four integrals of Eq. (8), as the build tabulated them.
//!
//! `reference/crack_integrals.csv` has the smooth factors P = C/σ^p (p = 5/2, 7/2 for the lateral integral) and dP/dσ,
//! computed in 50 digits with the order of integration exchanged, after which the inner integral is closed.

use rotor_core::equations::{
    lateral_integral, opening_integral, sliding_integral, tearing_integral,
};
use rotor_tests::{number, relative_error, table};

/// Name, value with derivative, power p.
type Integral = (&'static str, fn(f64) -> (f64, [f64; 1]), f64);

const INTEGRALS: [Integral; 4] = [
    ("sliding", sliding_integral::gradient, 2.5),
    ("tearing", tearing_integral::gradient, 2.5),
    ("opening", opening_integral::gradient, 2.5),
    ("lateral", lateral_integral::gradient, 3.5),
];

#[test]
fn values_to_1e_13_and_derivatives_to_1e_11_for_every_depth() {
    let rows = table("crack_integrals.csv");
    assert_eq!(rows.len(), 42);
    for (name, integral, power) in INTEGRALS {
        let mut worst = (0.0_f64, 0.0_f64);
        for row in &rows {
            let sigma = number(row, "sigma");
            let (factor, slope) = (number(row, name), number(row, &format!("d_{name}")));
            let (value, [derivative]) = integral(sigma);
            let scale = sigma.powf(power);
            let expected = scale * (slope + power * factor / sigma);
            worst.0 = worst.0.max(relative_error(value, scale * factor));
            worst.1 = worst.1.max(relative_error(derivative, expected));
        }
        println!("{name}: value {:.1e}, derivative {:.1e}", worst.0, worst.1);
        assert!(worst.0 <= 1e-13 && worst.1 <= 1e-11, "{name}: {worst:?}");
    }
}

#[test]
fn values_agree_with_the_integrals_as_written() {
    type Pair = (fn(f64) -> f64, fn(f64) -> f64);
    let pairs: [Pair; 4] = [
        (sliding_integral, sliding_integral::value),
        (tearing_integral, tearing_integral::value),
        (opening_integral, opening_integral::value),
        (lateral_integral, lateral_integral::value),
    ];
    for (written, generated) in pairs {
        for sigma in [0.0003, 0.02, 0.2, 0.35, 0.7, 0.95] {
            let error = relative_error(generated(sigma), written(sigma));
            assert!(error <= 1e-12, "at {sigma}: {error:.1e}");
        }
    }
}
