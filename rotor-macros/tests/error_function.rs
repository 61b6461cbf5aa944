//! The error function and its complement, which the crate `libm` has: values with its bits, derivatives beside differences and
//! beside what is known of them, columns with the bits of the scalar forms.
#![allow(
    unreachable_pub,
    clippy::float_cmp,
    reason = "formulas are `pub` as in a library; numbers are compared bit by bit"
)]

#[rotor_macros::symbolic]
mod formulas {
    use libm::erfc;

    #[generate(value, gradient(x), hessian(x), columns)]
    pub fn error(x: f64) -> f64 {
        libm::erf(x)
    }

    #[generate(value, gradient(x), hessian(x), columns)]
    pub fn complement(x: f64) -> f64 {
        erfc(x)
    }

    /// The distribution function of the normal law.
    #[generate(value, gradient(x, mean, deviation), hessian(x, mean, deviation))]
    pub fn normal(x: f64, mean: f64, deviation: f64) -> f64 {
        0.5 * erfc((mean - x) / (deviation * std::f64::consts::SQRT_2))
    }
}

const NUMBERS: [f64; 19] = [
    0.0,
    0.3,
    -0.3,
    0.84,
    -0.85,
    1.0,
    -1.25,
    2.5,
    -2.9,
    5.9,
    6.5,
    -7.0,
    26.0,
    28.0,
    1e-9,
    -1e-300,
    1e200,
    f64::INFINITY,
    f64::NAN,
];

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn is_slope(slope: f64, function: impl Fn(f64) -> f64, x: f64) -> bool {
    let step = 2.0_f64.powi(-12) * x.abs().max(0.25);
    let at = |places: f64| function(x + places * step);
    // To the fourth order.
    let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    (slope - difference).abs() <= 1e-9 * difference.abs().max(1.0)
}

#[test]
fn values_are_those_of_the_crate() {
    use formulas::{complement, error};
    let (mut errors, mut complements) = ([0.0; 19], [0.0; 19]);
    error::columns(&error::Columns { x: &NUMBERS }, [&mut errors]).expect("columns of one length");
    complement::columns(&complement::Columns { x: &NUMBERS }, [&mut complements])
        .expect("columns of one length");
    for (row, x) in NUMBERS.into_iter().enumerate() {
        assert!(same(error::value(x), libm::erf(x)), "{x}");
        assert!(same(errors[row], libm::erf(x)), "{x}");
        assert!(same(complement::value(x), libm::erfc(x)), "{x}");
        assert!(same(complements[row], libm::erfc(x)), "{x}");
    }
}

#[test]
fn derivatives_are_those_of_the_bell() {
    use formulas::{complement, error, normal};
    for x in [0.3_f64, -0.84, 1.5, -2.9, 5.0] {
        let bell = std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp();
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
        let (_, [slope], [[curvature]]) = error::hessian(x);
        assert!(
            close(slope, bell) && close(curvature, -2.0 * x * bell),
            "{x}"
        );
        let (_, [slope], [[curvature]]) = complement::hessian(x);
        assert!(
            close(slope, -bell) && close(curvature, 2.0 * x * bell),
            "{x}"
        );
        assert!(is_slope(error::gradient(x).1[0], libm::erf, x));
        assert!(is_slope(complement::gradient(x).1[0], libm::erfc, x));
    }
    let at = [0.75, 0.25, 1.5];
    let (value, slopes, curvatures) = normal::hessian(at[0], at[1], at[2]);
    assert!((value - formulas::normal(at[0], at[1], at[2])).abs() < 1e-16);
    for by in 0..3 {
        let moved = |x: f64| {
            let mut at = at;
            at[by] = x;
            at
        };
        let of_value = |x: f64| {
            let [x, mean, deviation] = moved(x);
            formulas::normal(x, mean, deviation)
        };
        assert!(is_slope(slopes[by], of_value, at[by]));
        for (row, curvatures) in curvatures.iter().enumerate() {
            let of_slope = |x: f64| {
                let [x, mean, deviation] = moved(x);
                normal::gradient(x, mean, deviation).1[row]
            };
            assert!(is_slope(curvatures[by], of_slope, at[by]));
        }
    }
    // Far out the complement and its slope keep their digits.
    assert_eq!(complement::gradient(f64::INFINITY), (0.0, [0.0]));
    assert!(complement::gradient(26.0).0 > 5e-296 && complement::gradient(26.0).1[0] < 0.0);
}
