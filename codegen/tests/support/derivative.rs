//! Forward derivatives on a tape, rule by rule, as dual numbers have them: those of a function as it is written.

use super::tape::{Binary, Comparison, Place, Step, Tape, Unary};

/// Appends the derivatives of all places by an input that moves as `seeds` say; None where there is none, whatever the
/// numbers are.
pub fn derivative(tape: &mut Tape, outputs: &[Place], by: &Step) -> Vec<Option<Place>> {
    let needed = tape.needed(outputs);
    let mut slopes: Vec<Option<Place>> = vec![None; needed.len()];
    for place in 0..needed.len() {
        if needed[place] {
            let step = tape.steps[place].clone();
            slopes[place] = if step == *by {
                Some(tape.literal("1.0"))
            } else {
                slope(tape, &step, place, &slopes)
            };
        }
    }
    outputs.iter().map(|output| slopes[*output]).collect()
}

fn slope(tape: &mut Tape, step: &Step, value: Place, slopes: &[Option<Place>]) -> Option<Place> {
    match step {
        Step::Input(_) | Step::Literal(_) | Step::Bits(_) | Step::Constant(_) => None,
        Step::Unary(function, x) => {
            let dx = slopes[*x]?;
            unary(tape, *function, *x, value, dx)
        }
        Step::Binary(operation, x, y) => {
            binary(tape, *operation, [*x, *y], value, [slopes[*x], slopes[*y]])
        }
        Step::Power(x, exponent) => {
            let dx = slopes[*x]?;
            power(tape, *x, *exponent, dx)
        }
        Step::MulAdd(x, y, z) => {
            let product = product(tape, [*x, *y], [slopes[*x], slopes[*y]]);
            sum(tape, product, slopes[*z])
        }
        // Of the two numbers that are compared it is the smaller or the larger, with a corner where they meet.
        Step::Select(comparison, [a, b, x, y])
            if *comparison != Comparison::Equal && ([a, b] == [x, y] || [a, b] == [y, x]) =>
        {
            let [dx, dy] = both(tape, [slopes[*x], slopes[*y]])?;
            Some(tape.push(Step::Beside(*comparison, [*a, *b, dx, dy])))
        }
        Step::Select(comparison, [a, b, x, y]) => {
            let [dx, dy] = both(tape, [slopes[*x], slopes[*y]])?;
            Some(tape.push(Step::Select(*comparison, [*a, *b, dx, dy])))
        }
        Step::Beside(comparison, [a, b, x, y]) => {
            let [dx, dy] = both(tape, [slopes[*x], slopes[*y]])?;
            Some(tape.push(Step::Beside(*comparison, [*a, *b, dx, dy])))
        }
        Step::Chosen { larger, of } => {
            let [u, v, x, y] = *of;
            chosen(tape, *larger, [u, v], [slopes[x], slopes[y]])
        }
    }
}

fn both(tape: &mut Tape, slopes: [Option<Place>; 2]) -> Option<[Place; 2]> {
    if slopes == [None, None] {
        return None;
    }
    let zero = tape.literal("0.0");
    Some(slopes.map(|slope| slope.unwrap_or(zero)))
}

fn chosen(
    tape: &mut Tape,
    larger: bool,
    [u, v]: [Place; 2],
    slopes: [Option<Place>; 2],
) -> Option<Place> {
    let [du, dv] = both(tape, slopes)?;
    let of = [u, v, du, dv];
    Some(tape.push(Step::Chosen { larger, of }))
}

fn sum(tape: &mut Tape, a: Option<Place>, b: Option<Place>) -> Option<Place> {
    match (a, b) {
        (Some(a), Some(b)) => Some(tape.binary(Binary::Add, a, b)),
        (one, other) => one.or(other),
    }
}

fn product(tape: &mut Tape, [x, y]: [Place; 2], [dx, dy]: [Option<Place>; 2]) -> Option<Place> {
    let first = dx.map(|dx| tape.binary(Binary::Multiply, dx, y));
    let second = dy.map(|dy| tape.binary(Binary::Multiply, x, dy));
    sum(tape, first, second)
}

fn unary(tape: &mut Tape, function: Unary, x: Place, value: Place, dx: Place) -> Option<Place> {
    let factor = match function {
        Unary::Negative => return Some(tape.unary(Unary::Negative, dx)),
        Unary::Signum => return None,
        Unary::Ln => return Some(tape.binary(Binary::Divide, dx, x)),
        Unary::Sqrt => {
            let two = tape.literal("2.0");
            let twice = tape.binary(Binary::Multiply, two, value);
            return Some(tape.binary(Binary::Divide, dx, twice));
        }
        Unary::Recip => {
            let once = tape.binary(Binary::Multiply, dx, value);
            let twice = tape.binary(Binary::Multiply, once, value);
            return Some(tape.unary(Unary::Negative, twice));
        }
        Unary::Sin => tape.unary(Unary::Cos, x),
        Unary::Cos => {
            let sine = tape.unary(Unary::Sin, x);
            tape.unary(Unary::Negative, sine)
        }
        Unary::Tan => {
            let one = tape.literal("1.0");
            let square = tape.binary(Binary::Multiply, value, value);
            tape.binary(Binary::Add, one, square)
        }
        Unary::Exp => value,
        Unary::Abs => tape.unary(Unary::Signum, x),
        Unary::Floor | Unary::Ceil | Unary::Round | Unary::Trunc => return None,
        Unary::Sinh => tape.unary(Unary::Cosh, x),
        Unary::Cosh => tape.unary(Unary::Sinh, x),
        Unary::ExpM1 => tape.unary(Unary::Exp, x),
        Unary::Exp2 => {
            let scale = tape.push(Step::Constant("LN_2".to_owned()));
            tape.binary(Binary::Multiply, value, scale)
        }
        _ => return Some(quotient_rule(tape, function, x, value, dx)),
    };
    Some(tape.binary(Binary::Multiply, factor, dx))
}

/// The derivatives that divide, each by what keeps the digits.
fn quotient_rule(tape: &mut Tape, function: Unary, x: Place, value: Place, dx: Place) -> Place {
    let one = tape.literal("1.0");
    let (below, above) = (
        tape.binary(Binary::Subtract, one, x),
        tape.binary(Binary::Add, one, x),
    );
    let divisor = match function {
        Unary::Asin | Unary::Acos => {
            let product = tape.binary(Binary::Multiply, below, above);
            tape.unary(Unary::Sqrt, product)
        }
        Unary::Atanh => tape.binary(Binary::Multiply, below, above),
        Unary::Atan => {
            let square = tape.binary(Binary::Multiply, x, x);
            tape.binary(Binary::Add, one, square)
        }
        Unary::Tanh => {
            let cosh = tape.unary(Unary::Cosh, x);
            tape.binary(Binary::Multiply, cosh, cosh)
        }
        Unary::Asinh => tape.binary(Binary::Hypot, one, x),
        Unary::Acosh => {
            let less = tape.binary(Binary::Subtract, x, one);
            let roots = [less, above].map(|of| tape.unary(Unary::Sqrt, of));
            tape.binary(Binary::Multiply, roots[0], roots[1])
        }
        Unary::Ln1p => above,
        Unary::Cbrt => {
            let square = tape.binary(Binary::Multiply, value, value);
            let three = tape.literal("3.0");
            tape.binary(Binary::Multiply, three, square)
        }
        Unary::Log10 | Unary::Log2 => {
            let name = if function == Unary::Log2 {
                "LN_2"
            } else {
                "LN_10"
            };
            let scale = tape.push(Step::Constant(name.to_owned()));
            tape.binary(Binary::Multiply, x, scale)
        }
        other => panic!("no rule for {other:?}"),
    };
    let slope = tape.binary(Binary::Divide, dx, divisor);
    if function == Unary::Acos {
        tape.unary(Unary::Negative, slope)
    } else {
        slope
    }
}

/// The derivative of 1/(x + iy) is −1/(x + iy)².
fn of_over_squares(
    tape: &mut Tape,
    [x, y]: [Place; 2],
    value: Place,
    [dx, dy]: [Option<Place>; 2],
) -> Option<Place> {
    let other = tape.binary(Binary::OverSquares, y, x);
    let first = dx.map(|dx| {
        let [of, of_other] = [value, other].map(|part| tape.binary(Binary::Multiply, part, part));
        let slope = tape.binary(Binary::Subtract, of_other, of);
        tape.binary(Binary::Multiply, slope, dx)
    });
    let second = dy.map(|dy| {
        let minus_two = tape.literal("-2.0");
        let both = tape.binary(Binary::Multiply, value, other);
        let slope = tape.binary(Binary::Multiply, minus_two, both);
        tape.binary(Binary::Multiply, slope, dy)
    });
    sum(tape, first, second)
}

/// The derivatives of functions of two numbers.
fn of_two(
    tape: &mut Tape,
    operation: Binary,
    [x, y]: [Place; 2],
    value: Place,
    [dx, dy]: [Option<Place>; 2],
) -> Option<Place> {
    let zero = tape.literal("0.0");
    let over = |tape: &mut Tape, part: Place, length: Place, change: Place| {
        let share = tape.binary(Binary::Divide, part, length);
        tape.binary(Binary::Multiply, share, change)
    };
    match operation {
        Binary::Hypot => {
            let first = dx.map(|dx| over(tape, x, value, dx));
            let second = dy.map(|dy| over(tape, y, value, dy));
            sum(tape, first, second)
        }
        Binary::Atan2 => {
            let first = dx.map(|dx| {
                let slope = tape.binary(Binary::OverSquares, y, x);
                tape.binary(Binary::Multiply, slope, dx)
            });
            let second = dy.map(|dy| {
                let slope = tape.binary(Binary::OverSquares, x, y);
                let part = tape.binary(Binary::Multiply, slope, dy);
                tape.unary(Unary::Negative, part)
            });
            sum(tape, first, second)
        }
        Binary::OverSquares => of_over_squares(tape, [x, y], value, [dx, dy]),
        Binary::Powf => {
            let first = dx.map(|dx| {
                let one = tape.literal("1.0");
                let less = tape.binary(Binary::Subtract, y, one);
                let power = tape.binary(Binary::Powf, x, less);
                let slope = tape.binary(Binary::Multiply, y, power);
                // That of x⁰ is 0 also where 1/x is infinite; elsewhere it changes with the exponent.
                let of = [y, zero, zero, slope];
                let at_zero = tape.push(Step::Select(Comparison::Equal, of));
                let size = tape.unary(Unary::Abs, x);
                let limit = tape.push(Step::Bits((f64::MIN_POSITIVE / 4.0).to_bits()));
                let of = [size, limit, at_zero, slope];
                let slope = tape.push(Step::Select(Comparison::AtMost, of));
                tape.binary(Binary::Multiply, slope, dx)
            });
            let second = dy.map(|dy| {
                let log = tape.unary(Unary::Ln, x);
                let slope = tape.binary(Binary::Multiply, value, log);
                let of = [value, zero, zero, slope];
                let at_zero = tape.push(Step::Select(Comparison::Equal, of));
                tape.binary(Binary::Multiply, at_zero, dy)
            });
            sum(tape, first, second)
        }
        _ => {
            // The sign of the second, times the derivative of the size of the first.
            let dx = dx?;
            let one = tape.literal("1.0");
            let (sign, side) = (
                tape.binary(Binary::Copysign, one, y),
                tape.unary(Unary::Signum, x),
            );
            let both = tape.binary(Binary::Multiply, sign, side);
            Some(tape.binary(Binary::Multiply, both, dx))
        }
    }
}

fn binary(
    tape: &mut Tape,
    operation: Binary,
    [x, y]: [Place; 2],
    value: Place,
    slopes: [Option<Place>; 2],
) -> Option<Place> {
    let [dx, dy] = slopes;
    match operation {
        Binary::Add => sum(tape, dx, dy),
        Binary::Subtract => match (dx, dy) {
            (Some(dx), Some(dy)) => Some(tape.binary(Binary::Subtract, dx, dy)),
            (Some(dx), None) => Some(dx),
            (None, dy) => dy.map(|dy| tape.unary(Unary::Negative, dy)),
        },
        Binary::Multiply => product(tape, [x, y], slopes),
        Binary::Divide => {
            let part = dy.map(|dy| tape.binary(Binary::Multiply, value, dy));
            let above = match (dx, part) {
                (Some(dx), Some(part)) => tape.binary(Binary::Subtract, dx, part),
                (Some(dx), None) => dx,
                (None, part) => {
                    let part = part?;
                    tape.unary(Unary::Negative, part)
                }
            };
            Some(tape.binary(Binary::Divide, above, y))
        }
        Binary::Min | Binary::Max => chosen(tape, operation == Binary::Max, [x, y], slopes),
        _ => of_two(tape, operation, [x, y], value, slopes),
    }
}

fn power(tape: &mut Tape, x: Place, exponent: i32, dx: Place) -> Option<Place> {
    let factor = match exponent {
        0 => return None,
        1 => return Some(dx),
        2 => x,
        _ => tape.push(Step::Power(x, exponent - 1)),
    };
    let count = tape.literal(&format!("{exponent}.0"));
    let factor = tape.binary(Binary::Multiply, count, factor);
    Some(tape.binary(Binary::Multiply, factor, dx))
}
