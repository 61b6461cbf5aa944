//! The derivatives of elementary functions by their operands, each over what loses no digits and stays in the range of numbers:
//! that of the arc sine is 1/√((1 − x)(1 + x)), that of the hyperbolic tangent 1/cosh².

use super::{Slope, alone};
use crate::graph::{ExprId, Factors, Function, Graph, NamedConstant, Rational, ratio, whole};

/// The function's derivative by each of its operands; corners are passed on as a whole and have none here.
pub(super) fn of_function(
    graph: &mut Graph,
    id: ExprId,
    function: Function,
    operands: &[ExprId],
) -> Vec<Slope> {
    match *operands {
        // Steps have the slope 0.
        _ if function.is_step() => Vec::new(),
        [x] => of_one(graph, id, function, x),
        [x, y] => of_two(graph, id, function, [x, y]),
        [a, b, c] if function == Function::MulAdd => vec![
            (a, alone(b), whole(1)),
            (b, alone(a), whole(1)),
            (c, Factors::new(), whole(1)),
        ],
        [..] => Vec::new(),
    }
}

/// The derivative of a function of one number.
fn of_one(graph: &mut Graph, id: ExprId, function: Function, x: ExprId) -> Vec<Slope> {
    let of = |graph: &mut Graph, function: Function| graph.apply(function, vec![x]);
    let (factors, coefficient) = match function {
        Function::Sin => (alone(of(graph, Function::Cos)), whole(1)),
        Function::Cos => (alone(of(graph, Function::Sin)), whole(-1)),
        Function::Tan => {
            let (one, square) = (graph.one(), graph.power(id, 2));
            (alone(graph.add(one, square)), whole(1))
        }
        Function::Exp => (alone(id), whole(1)),
        Function::ExpM1 => (alone(of(graph, Function::Exp)), whole(1)),
        Function::Exp2 => {
            let scale = graph.constant(NamedConstant::Ln2);
            (Factors::from_slice(&[(id, 1), (scale, 1)]), whole(1))
        }
        Function::Sinh => (alone(of(graph, Function::Cosh)), whole(1)),
        Function::Cosh => (alone(of(graph, Function::Sinh)), whole(1)),
        Function::Erf | Function::Erfc => {
            let square = graph.power(x, 2);
            let opposite = graph.negate(square);
            let bell = graph.apply(Function::Exp, vec![opposite]);
            let pi = graph.constant(NamedConstant::Pi);
            let root = graph.sqrt(pi);
            let sign = if function == Function::Erf { 2 } else { -2 };
            (Factors::from_slice(&[(bell, 1), (root, -1)]), whole(sign))
        }
        Function::Sqrt => (Factors::from_slice(&[(id, -1)]), ratio(1, 2)),
        Function::Cbrt => (Factors::from_slice(&[(id, -2)]), ratio(1, 3)),
        Function::Acos => (divisors(graph, function, x), whole(-1)),
        _ => (divisors(graph, function, x), whole(1)),
    };
    if factors.is_empty() {
        return Vec::new();
    }
    vec![(x, factors, coefficient)]
}

/// What the derivative of a function divides by; nothing where it is no quotient.
fn divisors(graph: &mut Graph, function: Function, x: ExprId) -> Factors {
    let one = graph.one();
    let divisors: [(ExprId, i32); 2] = match function {
        Function::Tanh => {
            return Factors::from_slice(&[(graph.apply(Function::Cosh, vec![x]), -2)]);
        }
        Function::Log10 => [(x, -1), (graph.constant(NamedConstant::Ln10), -1)],
        Function::Log2 => [(x, -1), (graph.constant(NamedConstant::Ln2), -1)],
        Function::Atanh => around(graph, x).map(|side| (side, -1)),
        Function::Acosh => {
            let sides = [graph.subtract(x, one), graph.add(x, one)];
            sides.map(|side| (graph.sqrt(side), -1))
        }
        _ => {
            let divisor = match function {
                Function::Ln => x,
                Function::Ln1p => graph.add(one, x),
                Function::Atan => {
                    let square = graph.power(x, 2);
                    graph.add(one, square)
                }
                Function::Asinh => graph.apply(Function::Hypot, vec![x, one]),
                Function::Asin | Function::Acos => {
                    let [below, above] = around(graph, x);
                    let product = graph.multiply(below, above);
                    graph.sqrt(product)
                }
                _ => return Factors::new(),
            };
            return Factors::from_slice(&[(divisor, -1)]);
        }
    };
    Factors::from_slice(&divisors)
}

/// 1 − x and 1 + x
fn around(graph: &mut Graph, x: ExprId) -> [ExprId; 2] {
    let one = graph.one();
    [graph.subtract(one, x), graph.add(one, x)]
}

/// The derivatives of a function of two numbers.
fn of_two(graph: &mut Graph, id: ExprId, function: Function, [x, y]: [ExprId; 2]) -> Vec<Slope> {
    match function {
        Function::Atan2 => {
            let [of_abscissa, of_ordinate] = over_squares(graph, [y, x]);
            vec![
                (x, alone(of_abscissa), whole(1)),
                (y, alone(of_ordinate), whole(-1)),
            ]
        }
        // With u = x/(x² + y²) and v = y/(x² + y²), the parts of 1/(x + iy): its derivative is −1/(x + iy)².
        Function::OverSquares => {
            let [u, v] = over_squares(graph, [x, y]);
            let [of_u, of_v] = [u, v].map(|part| graph.power(part, 2));
            let difference = graph.subtract(of_v, of_u);
            let both = Factors::from_slice(&[(u, 1), (v, 1)]);
            vec![(x, alone(difference), whole(1)), (y, both, whole(-2))]
        }
        Function::Hypot => {
            let shares = [x, y].map(|part| (part, graph.divide(part, id)));
            let slopes = shares.map(|(part, share)| (part, alone(share), whole(1)));
            slopes.to_vec()
        }
        Function::Powf => vec![
            (x, alone(of_base(graph, [x, y])), whole(1)),
            (y, alone(of_exponent(graph, id, x)), whole(1)),
        ],
        _ => Vec::new(),
    }
}

/// Each of two numbers over the sum of their squares.
fn over_squares(graph: &mut Graph, [x, y]: [ExprId; 2]) -> [ExprId; 2] {
    [[x, y], [y, x]].map(|both| graph.apply(Function::OverSquares, both.as_slice()))
}

/// The size of a number up to which its inverse is infinite: the smallest power of which the inverse leaves the range.
fn largest_without_inverse() -> Rational {
    Rational::of_f64(f64::MIN_POSITIVE / 4.0).unwrap_or_default()
}

/// The derivative of a power by its base, y·x^(y − 1). That of x⁰ is 0, also at x = 0, where x^(y − 1) is infinite.
fn of_base(graph: &mut Graph, [x, y]: [ExprId; 2]) -> ExprId {
    let (zero, one) = (graph.integer(0), graph.one());
    let exponent = match graph.as_number(y).cloned() {
        Some(number) if number.is_zero() => return zero,
        Some(number) if number.is_one() => return one,
        // That of the square is twice the base, with no call.
        Some(number) if number == whole(2) => return graph.scale(x, number),
        Some(number) => graph.number(number - whole(1)),
        None => graph.subtract(y, one),
    };
    let power = graph.apply(Function::Powf, vec![x, exponent]);
    let slope = graph.multiply(y, power);
    if graph.as_number(y).is_some() {
        return slope;
    }
    let (size, limit) = (
        graph.apply(Function::Abs, vec![x]),
        graph.number(largest_without_inverse()),
    );
    let at_zero = graph.apply(Function::Select, vec![y, zero, zero, slope]);
    graph.apply(Function::AtMost, vec![size, limit, at_zero, slope])
}

/// The derivative of a power by its exponent, xʸ·ln x, which is 0 where the power is.
fn of_exponent(graph: &mut Graph, power: ExprId, x: ExprId) -> ExprId {
    let zero = graph.integer(0);
    let logarithm = graph.apply(Function::Ln, vec![x]);
    let slope = graph.multiply(power, logarithm);
    graph.apply(Function::Select, vec![power, zero, zero, slope])
}
