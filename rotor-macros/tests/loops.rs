//! Loops, assignments and whole numbers: values with the bits of the function as written, derivatives beside differences,
//! columns with the bits of the scalar forms.
#![allow(
    unreachable_pub,
    clippy::needless_range_loop,
    clippy::assign_op_pattern,
    clippy::manual_memcpy,
    clippy::unnecessary_cast,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_lossless,
    clippy::float_cmp,
    clippy::reversed_empty_ranges,
    reason = "formulas are `pub` as in a library, and say what people say; numbers are compared bit by bit"
)]

#[rotor_macros::symbolic]
mod formulas {
    const N: usize = 4;
    const WEIGHTS: [f64; N] = [0.5, -1.25, 2.0, 0.125];

    /// A polynomial by Horner's rule.
    #[generate(value, gradient(x), hessian(x), columns)]
    pub fn horner(x: f64) -> f64 {
        let mut p = 0.0;
        for weight in WEIGHTS.iter().rev() {
            p = p * x + weight;
        }
        p
    }

    /// The series of the exponential.
    #[generate(value, gradient(x), hessian(x), columns)]
    pub fn series(x: f64) -> f64 {
        let mut term = 1.0;
        let mut sum = term;
        for k in 1..=12 {
            term *= x / k as f64;
            sum += term;
        }
        sum
    }

    /// Newton's iteration for a square root.
    #[generate(value, gradient(x), columns)]
    pub fn newton(x: f64) -> f64 {
        let mut y = 0.5 * (1.0 + x);
        for _ in 0..N {
            y = 0.5 * (y + x / y);
        }
        y
    }

    /// Steps of a pendulum, each by the last one's values.
    #[generate(value, gradient(angle, speed), hessian(angle, speed), columns)]
    pub fn pendulum(angle: f64, speed: f64) -> (f64, f64) {
        let (mut q, mut p) = (angle, speed);
        for step in 0..3 {
            let dt = 0.125 / (step + 1) as f64;
            p -= dt * q.sin();
            q += dt * p;
        }
        (q, p)
    }

    /// What is changed in branches, one within another.
    #[generate(value, gradient(x, y), columns)]
    pub fn branches(x: f64, y: f64) -> f64 {
        let mut a = x * y;
        let mut b = y;
        if x > 0.5 {
            a += x.sqrt();
            if y > x {
                b *= 2.0;
                a -= b;
            }
        } else if y < 0.0 {
            let a = x;
            b = a - 1.0;
        } else {
            (a, b) = (b, a);
        }
        match x < y {
            true => a /= 2.0,
            false => {
                b = -b;
            }
        }
        a + 3.0 * b
    }

    /// Whole numbers: what of them decides is known, and not looked at where it does not hold.
    #[generate(value, gradient(x), columns)]
    pub fn whole(x: f64) -> f64 {
        const LAST: usize = N - 1;
        let table = [x, x * x, 1.0 / x, 2.0 - x];
        let mut odd = 0;
        let mut result = 0.0;
        for i in 0..N {
            let before = if i > 0 { table[i - 1] } else { 1.0 };
            if i % 2 == 1 && i < 4 {
                odd += i;
                result += before * table[i].powi(i as i32 - 2);
            } else {
                match i {
                    0 | 1 => result -= before,
                    place if i == LAST - 1 => result += f64::from(place as i32),
                    _ => result *= before,
                }
            }
        }
        result + odd as f64 * table[LAST]
    }

    /// Loops within loops, over arrays that they fill.
    #[generate(value, gradient(x, y), columns)]
    pub fn filled(x: f64, y: f64) -> f64 {
        let mut product = [[0.0; 2]; 2];
        let left = [[x, y], [1.0, x]];
        let right = [[y, 2.0], [x, -y]];
        for i in 0..2 {
            for j in 0..2 {
                for k in 0..2 {
                    product[i][j] += left[i][k] * right[k][j];
                }
            }
        }
        let mut trace = 0.0;
        for (i, row) in product.iter().enumerate() {
            trace += row[i] / (1.0 + row[1 - i] * row[1 - i]);
        }
        trace
    }

    /// A sum that keeps what rounding takes.
    #[generate(value, columns)]
    pub fn kahan(x: f64, y: f64) -> f64 {
        let mut sum = 0.0;
        let mut carry = 0.0;
        for term in [x, y, x * y, 1.0, y * y] {
            let corrected = term - carry;
            let next = sum + corrected;
            carry = (next - sum) - corrected;
            sum = next;
        }
        sum
    }

    /// Blocks, shadowed names and what a loop does not see.
    #[generate(value, gradient(x), columns)]
    pub fn scopes(x: f64) -> f64 {
        let mut y = x;
        {
            let x = y * 2.0;
            y += x;
            let y = 100.0;
            let _unused = x + y;
        }
        for y in [1.0, 2.0] {
            let x = y + x;
            let _unused = x;
        }
        let z = {
            y = y * y;
            y + 1.0
        };
        for _ in N..N {
            y = 0.0;
        }
        z - y / 3.0 + x
    }

    /// A variable that is read while it is added to.
    #[generate(value, gradient(x))]
    pub fn prefixes(x: f64) -> f64 {
        let mut sum = x;
        let mut all = 0.0;
        for k in 1..4 {
            sum += x.sin() / k as f64;
            all += sum * sum;
            sum -= 0.25;
        }
        all
    }
}

const NUMBERS: [f64; 13] = [
    0.3, -0.3, 0.75, 1.0, -1.0, 2.5, -2.5, 17.25, 1e-9, 1e-20, 1e100, -1e5, 0.0,
];

fn same(a: f64, b: f64) -> bool {
    // Of zeros the sign is free, and what is no number in the function as written.
    (a + 0.0).to_bits() == (b + 0.0).to_bits() || b.is_nan()
}

/// Whether a derivative is what differences of a function make of it.
fn is_slope(slope: f64, function: impl Fn(f64) -> f64, x: f64) -> bool {
    let step = 2.0_f64.powi(-12) * x.abs().max(0.25);
    let at = |places: f64| function(x + places * step);
    // To the fourth order.
    let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    let size = at(0.0).abs().max(difference.abs()).max(1.0);
    (slope - difference).abs() <= 1e-9 * size
}

/// Compares a function of one number with its forms.
macro_rules! of_one {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            use formulas::$name::{Columns, columns, gradient, value};
            let mut results = vec![0.0; NUMBERS.len()];
            columns(&Columns { x: &NUMBERS }, [&mut results]).expect("columns of one length");
            for (x, result) in NUMBERS.into_iter().zip(results) {
                let written = formulas::$name(x);
                let close = (value(x) - written).abs() <= 1e-15 * written.abs();
                assert!(same(value(x), written) || close, "{x}: {}, {written}", value(x));
                assert!(result.to_bits() == value(x).to_bits() || value(x).is_nan(), "{x}: {result}");
            }
            for x in [0.3, 0.75, 1.5] {
                let (_, [slope]) = gradient(x);
                assert!(is_slope(slope, formulas::$name, x), "{x}: {slope}");
            }
        }
    )*};
}

of_one!(horner series newton whole scopes);

/// Compares a function of two numbers with its forms.
macro_rules! of_two {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            use formulas::$name::{Columns, columns, gradient, value};
            let pairs = || NUMBERS.iter().flat_map(|x| NUMBERS.iter().map(move |y| (*x, *y)));
            let (x, y): (Vec<f64>, Vec<f64>) = pairs().unzip();
            let mut results = vec![0.0; x.len()];
            columns(&Columns { x: &x, y: &y }, [&mut results]).expect("columns of one length");
            for ((x, y), result) in pairs().zip(results) {
                let written = formulas::$name(x, y);
                let close = (value(x, y) - written).abs() <= 1e-14 * written.abs();
                assert!(same(value(x, y), written) || close, "{x}, {y}: {}, {written}", value(x, y));
                assert!(result.to_bits() == value(x, y).to_bits() || value(x, y).is_nan(), "{x}, {y}: {result}");
            }
            for (x, y) in [(0.3, -0.75), (0.3, 0.8), (1.25, 0.75), (0.75, 1.25)] {
                let (_, slopes) = gradient(x, y);
                assert!(is_slope(slopes[0], |x| formulas::$name(x, y), x), "{x}, {y}: {slopes:?}");
                assert!(is_slope(slopes[1], |y| formulas::$name(x, y), y), "{x}, {y}: {slopes:?}");
            }
        }
    )*};
}

of_two!(branches filled);

#[test]
fn second_derivatives_go_through_loops() {
    use formulas::{horner, pendulum, series};
    for x in [0.3, 0.75, -1.5] {
        assert!(is_slope(
            horner::hessian(x).2[0][0],
            |x| horner::gradient(x).1[0],
            x
        ));
        assert!(is_slope(
            series::hessian(x).2[0][0],
            |x| series::gradient(x).1[0],
            x
        ));
    }
    let (q, p) = (0.5, -1.25);
    let (value, slopes, curvatures) = pendulum::hessian(q, p);
    let written = formulas::pendulum(q, p);
    assert!((value.0 - written.0).abs() < 1e-15 && (value.1 - written.1).abs() < 1e-15);
    let of = |result: usize, q: f64, p: f64| {
        let (first, second) = formulas::pendulum(q, p);
        [first, second][result]
    };
    for result in 0..2 {
        assert!(is_slope(slopes[result][0], |q| of(result, q, p), q));
        assert!(is_slope(slopes[result][1], |p| of(result, q, p), p));
        for by in 0..2 {
            let slope = |q: f64, p: f64| pendulum::gradient(q, p).1[result][by];
            assert!(is_slope(curvatures[result][by][0], |q| slope(q, p), q));
            assert!(is_slope(curvatures[result][by][1], |p| slope(q, p), p));
        }
    }
}

#[test]
fn a_sum_against_rounding_stays_one_in_a_loop() {
    // The carry keeps what a plain sum loses.
    let (x, y) = (1e16, -0.75);
    let plain = x + y + x * y + 1.0 + y * y;
    assert_ne!(formulas::kahan(x, y), plain);
    for x in NUMBERS {
        for y in NUMBERS {
            let written = formulas::kahan(x, y);
            assert!(same(formulas::kahan::value(x, y), written), "{x}, {y}");
        }
    }
}

#[test]
fn what_is_read_between_two_additions_is_the_sum_so_far() {
    for x in NUMBERS {
        let (written, found) = (formulas::prefixes(x), formulas::prefixes::value(x));
        assert!(
            (found - written).abs() <= 1e-15 * written.abs(),
            "{x}: {found}, {written}"
        );
    }
    let (_, [slope]) = formulas::prefixes::gradient(0.75);
    assert!(is_slope(slope, formulas::prefixes, 0.75));
}
