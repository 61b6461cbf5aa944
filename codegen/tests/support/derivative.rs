//! Forward derivatives on a tape, rule by rule, as dual numbers have them: those of a function as it is written.

use super::tape::{Binary, Place, Step, Tape, Unary};

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
        Step::Select(comparison, [a, b, x, y]) => {
            let [dx, dy] = both(tape, [slopes[*x], slopes[*y]])?;
            Some(tape.push(Step::Select(*comparison, [*a, *b, dx, dy])))
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
    };
    Some(tape.binary(Binary::Multiply, factor, dx))
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
