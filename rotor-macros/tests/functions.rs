//! The elementary functions and choices of the language: values with the bits of the standard library, derivatives beside
//! differences, columns with the bits of the scalar forms on every level of instructions.
#![allow(
    unreachable_pub,
    clippy::manual_clamp,
    clippy::float_cmp,
    clippy::unnecessary_cast,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::eq_op,
    reason = "formulas are `pub` as in a library, and say what people say; numbers are compared bit by bit"
)]

use lanes::{ALL, Level, store};

/// Numbers at which functions are compared: of everyday, at their edges and at those of the range.
const NUMBERS: [f64; 30] = [
    0.0,
    -0.0,
    0.3,
    -0.3,
    0.75,
    -0.75,
    1.0,
    -1.0,
    0.999_999_9,
    1.000_000_1,
    -0.999_999_9,
    2.5,
    -2.5,
    0.5,
    -1.5,
    17.25,
    -17.25,
    1e-9,
    -1e-20,
    300.0,
    -300.0,
    720.0,
    1e17,
    -1e17,
    1e200,
    1e-310,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Whether a derivative is what differences of a function make of it.
fn is_slope(slope: f64, function: impl Fn(f64) -> f64, x: f64) -> bool {
    let step = 2.0_f64.powi(-14) * x.abs().max(0.25);
    let at = |places: f64| function(x + places * step);
    // To the fourth order.
    let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    let size = function(x).abs().max(difference.abs()).max(1e-3);
    (slope - difference).abs() <= 1e-9 * size.max(1.0)
}

/// A module of formulas, each a function of one number, and a test of each.
macro_rules! of_one_number {
    ($($name:ident at $x:expr, $other:expr;)*) => {
        #[rotor_macros::symbolic]
        mod of_one {
            $(
                /// The function of its name.
                #[generate(value, gradient(x), hessian(x), columns)]
                pub fn $name(x: f64) -> f64 {
                    x.$name()
                }
            )*
        }

        #[rotor_macros::symbolic]
        mod by_path {
            $(
                /// The function of its name.
                #[generate(value)]
                pub fn $name(x: f64) -> f64 {
                    f64::$name(x)
                }
            )*
        }

        $(
            #[test]
            fn $name() {
                use of_one::$name::{Columns, Rows, columns, gradient, hessian, value};
                for x in NUMBERS {
                    assert!(same(value(x), x.$name()), "{x}: {}", value(x));
                    assert!(same(by_path::$name::value(x), x.$name()), "{x}");
                }
                for x in [$x, $other] {
                    let (value, [slope]) = gradient(x);
                    assert!(same(value, x.$name()));
                    assert!(is_slope(slope, f64::$name, x), "{x}: {slope}");
                    let (_, [again], [[curvature]]) = hessian(x);
                    assert!((again - slope).abs() <= 1e-14 * slope.abs());
                    assert!(is_slope(curvature, |x| gradient(x).1[0], x), "{x}: {curvature}");
                }
                let mut results = vec![0.0; NUMBERS.len()];
                columns(&Columns { x: &NUMBERS }, [&mut results]).expect("columns of one length");
                for level in Level::available() {
                    let mut of_level = vec![0.0; NUMBERS.len()];
                    store::<Rows, ALL, 0, 1, 1>(level, &[], [&NUMBERS], [&mut of_level])
                        .expect("columns of one length");
                    for ((x, result), of_level) in NUMBERS.iter().zip(&results).zip(&of_level) {
                        assert!(same(*result, x.$name()), "{x}: {result}");
                        assert!(same(*of_level, *result), "{x} on {level:?}: {of_level}");
                    }
                }
            }
        )*
    };
}

of_one_number! {
    asin at 0.3, -0.9;
    acos at 0.3, -0.9;
    atan at 0.3, -5.5;
    sinh at 0.3, -5.5;
    cosh at 0.3, -5.5;
    tanh at 0.3, -2.5;
    asinh at 0.3, -5.5;
    acosh at 1.5, 7.5;
    atanh at 0.3, -0.9;
    exp_m1 at 0.3, -2.5;
    ln_1p at 0.3, -0.5;
    cbrt at 0.3, -5.5;
    log10 at 0.3, 5.5;
    log2 at 0.3, 5.5;
    exp2 at 0.3, -2.5;
    floor at 0.3, -2.75;
    ceil at 0.3, -2.75;
    round at 0.3, -2.75;
    trunc at 0.3, -2.75;
    fract at 0.3, -2.75;
    to_radians at 0.3, -2.75;
    to_degrees at 0.3, -2.75;
}

/// A module of formulas, each a function of two numbers, and a test of each.
macro_rules! of_two_numbers {
    ($($name:ident at $x:expr, $y:expr;)*) => {
        #[rotor_macros::symbolic]
        mod of_two {
            $(
                /// The function of its name.
                #[generate(value, gradient(x, y), hessian(x, y), columns)]
                pub fn $name(x: f64, y: f64) -> f64 {
                    x.$name(y)
                }
            )*
        }

        $(
            #[test]
            fn $name() {
                use of_two::$name::{Columns, columns, gradient, hessian, value};
                let pairs = || NUMBERS.iter().flat_map(|x| NUMBERS.iter().map(move |y| (*x, *y)));
                for (x, y) in pairs() {
                    assert!(same(value(x, y), x.$name(y)), "{x}, {y}: {}", value(x, y));
                }
                let (x, y) = ($x, $y);
                let (_, slopes) = gradient(x, y);
                assert!(is_slope(slopes[0], |x| x.$name(y), x), "{slopes:?}");
                assert!(is_slope(slopes[1], |y| x.$name(y), y), "{slopes:?}");
                let (_, _, curvatures) = hessian(x, y);
                for (row, curvatures) in curvatures.iter().enumerate() {
                    assert!(is_slope(curvatures[0], |x| gradient(x, y).1[row], x), "{curvatures:?}");
                    assert!(is_slope(curvatures[1], |y| gradient(x, y).1[row], y), "{curvatures:?}");
                }
                let (first, second): (Vec<f64>, Vec<f64>) = pairs().unzip();
                let mut results = vec![0.0; first.len()];
                columns(&Columns { x: &first, y: &second }, [&mut results])
                    .expect("columns of one length");
                for ((x, y), result) in pairs().zip(&results) {
                    assert!(same(*result, value(x, y)), "{x}, {y}: {result}");
                }
            }
        )*
    };
}

of_two_numbers! {
    atan2 at 0.75, -1.25;
    hypot at 0.75, -1.25;
    powf at 0.75, 1.25;
    copysign at 0.75, -1.25;
    log at 0.75, 2.25;
}

#[rotor_macros::symbolic]
mod choices {
    /// The Huber loss.
    #[generate(value, gradient(x), hessian(x), columns)]
    pub fn huber(x: f64) -> f64 {
        const EDGE: f64 = 3_i32 as f64 / 2.0;
        if x.abs() <= EDGE {
            0.5 * x * x
        } else {
            EDGE * (x.abs() - 0.5 * EDGE)
        }
    }

    /// A root and a logarithm beside what they are not taken of.
    #[generate(value, gradient(x, y), hessian(x, y), columns)]
    pub fn guarded(x: f64, y: f64) -> f64 {
        if x > 0.0 && !(y <= 0.0) {
            x.sqrt() * y.ln()
        } else if x == 0.0 || y != y {
            y
        } else {
            2.0 * x + y.exp_m1()
        }
    }

    /// Arms of conditions.
    #[generate(value, gradient(x, y), columns)]
    pub fn arms(x: f64, y: f64) -> f64 {
        match (x < y, y >= 1.0) {
            (true, true) => x * y,
            (true, false) => x - y,
            (false, _) => match y {
                z if z < 0.0 => -z * x,
                z => z + x,
            },
        }
    }

    /// Several numbers of one choice.
    #[generate(value, gradient(x), columns)]
    pub fn pair(x: f64) -> (f64, f64) {
        let (s, c) = x.sin_cos();
        let is_right = c > 0.0;
        if is_right { (s, c) } else { (-s, x / 2.0) }
    }

    /// A number between bounds.
    #[generate(value, gradient(x, low, high), columns)]
    pub fn bounded(x: f64, low: f64, high: f64) -> f64 {
        x.clamp(low, high)
    }

    /// Numbers that are no literals of their type.
    #[generate(value)]
    pub fn numbers(x: f64) -> (f64, f64, f64, f64) {
        (
            x + f64::EPSILON,
            -2 as f64 * x,
            x * std::f64::consts::EULER_GAMMA * std::f64::consts::LOG2_10,
            f64::min(x, f64::MAX),
        )
    }
}

/// Compares a form over columns with the function as written and with the scalar form, at all pairs of numbers.
macro_rules! same_in_columns {
    ($name:ident) => {{
        use choices::$name::{Columns, columns, value};
        let pairs = || {
            NUMBERS
                .iter()
                .flat_map(|x| NUMBERS.iter().map(move |y| (*x, *y)))
        };
        let (x, y): (Vec<f64>, Vec<f64>) = pairs().unzip();
        let mut results = vec![0.0; x.len()];
        columns(&Columns { x: &x, y: &y }, [&mut results]).expect("columns of one length");
        for ((x, y), result) in pairs().zip(results) {
            let written = choices::$name(x, y);
            // Of zeros the sign is free.
            assert!(
                same(value(x, y) + 0.0, written + 0.0),
                "{x}, {y}: {}",
                value(x, y)
            );
            assert!(same(result, value(x, y)), "{x}, {y}: {result}");
        }
    }};
}

#[test]
fn a_choice_has_the_value_of_the_branch_that_is_taken() {
    same_in_columns!(guarded);
    same_in_columns!(arms);
    let mut results = vec![0.0; NUMBERS.len()];
    choices::huber::columns(&choices::huber::Columns { x: &NUMBERS }, [&mut results])
        .expect("columns of one length");
    for (x, result) in NUMBERS.into_iter().zip(results) {
        assert!(same(choices::huber::value(x), choices::huber(x)), "{x}");
        assert!(same(result, choices::huber(x)), "{x}: {result}");
        assert_eq!(choices::pair::value(0.5), choices::pair(0.5));
    }
}

#[test]
fn what_is_not_taken_has_no_part_in_a_derivative() {
    use choices::{guarded, huber};
    assert_eq!(huber::gradient(-1.0), (0.5, [-1.0]));
    assert_eq!(huber::hessian(-4.0), (4.875, [-1.5], [[0.0]]));
    // The root of a negative number and the logarithm of 0 are infinite or no numbers beside what is taken.
    assert_eq!(guarded::gradient(-4.0, 0.0), (-8.0, [2.0, 1.0]));
    assert_eq!(guarded::gradient(0.0, 3.0), (3.0, [0.0, 1.0]));
    assert_eq!(guarded::gradient(0.0, -3.0), (-3.0, [0.0, 1.0]));
    let (_, slopes, curvatures) = guarded::hessian(4.0, 1.0);
    assert_eq!(
        (slopes, curvatures),
        ([0.0, 2.0], [[0.0, 0.25], [0.25, -2.0]])
    );
    assert_eq!(choices::arms::gradient(1.0, 2.0), (2.0, [2.0, 1.0]));
    assert_eq!(choices::arms::gradient(1.0, -2.0), (2.0, [2.0, -1.0]));
}

#[test]
fn clamp_is_that_of_the_standard_library() {
    use choices::bounded::{gradient, value};
    for x in NUMBERS {
        assert!(same(value(x, -0.5, 2.0), x.clamp(-0.5, 2.0)), "{x}");
    }
    assert_eq!(gradient(-1.0, -0.5, 2.0), (-0.5, [0.0, 1.0, 0.0]));
    assert_eq!(gradient(1.0, -0.5, 2.0), (1.0, [1.0, 0.0, 0.0]));
    assert_eq!(gradient(3.0, -0.5, 2.0), (2.0, [0.0, 0.0, 1.0]));
    // At a bound it is seen from where x is a little larger.
    assert_eq!(gradient(-0.5, -0.5, 2.0), (-0.5, [1.0, 0.0, 0.0]));
    assert_eq!(gradient(2.0, -0.5, 2.0), (2.0, [0.0, 0.0, 1.0]));
}

#[test]
fn other_numbers_are_what_rust_makes_of_them() {
    assert_eq!(choices::numbers::value(1.5), choices::numbers(1.5));
}

#[test]
fn derivatives_keep_their_digits_and_their_range() {
    use of_one::{acosh, asin, asinh, atanh, cbrt, tanh};
    // 1/√((1 − x)(1 + x)) where 1 − x² has half of the digits.
    let x = 1.0 - 2.0_f64.powi(-40);
    let near_one = 2.0_f64.powi(-40) * (1.0 + x);
    let close = |found: f64, right: f64| (found - right).abs() <= 4.0 * f64::EPSILON * right.abs();
    assert!(close(asin::gradient(x).1[0], near_one.sqrt().recip()));
    assert!(close(atanh::gradient(x).1[0], near_one.recip()));
    // 1/cosh² where 1 − tanh² is 0, and neither overflows.
    assert!(close(tanh::gradient(30.0).1[0], 30.0_f64.cosh().powi(-2)));
    assert!(tanh::gradient(30.0).1[0] > 3e-26 && tanh::gradient(800.0).1[0] == 0.0);
    assert!(close(asinh::gradient(1e200).1[0], 1e-200));
    assert!(close(acosh::gradient(1e200).1[0], 1e-200));
    assert_eq!(cbrt::gradient(0.0).1[0], f64::INFINITY);
    use of_two::{atan2, hypot, powf};
    let (_, slopes) = hypot::gradient(3e200, 4e200);
    assert!(close(slopes[0], 0.6) && close(slopes[1], 0.8), "{slopes:?}");
    let (_, slopes) = atan2::gradient(3e200, 4e200);
    assert!(
        close(slopes[0], 1.6e-201) && close(slopes[1], -1.2e-201),
        "{slopes:?}"
    );
    assert_eq!(powf::gradient(0.0, 0.0).1[0], 0.0);
    assert_eq!(powf::gradient(0.0, 3.0), (0.0, [0.0, 0.0]));
    assert_eq!(powf::gradient(0.0, 0.5), (0.0, [f64::INFINITY, 0.0]));
    assert_eq!(powf::gradient(-2.0, 3.0).1[0], 12.0);
}
