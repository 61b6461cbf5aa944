//! Straight-line programs: what the source of a function computes, operation by operation, for evaluation in any kind of
//! number. It shares nothing with the generator, so that the two check each other.

use std::collections::HashMap;

/// Place of a result on its [`Tape`].
pub type Place = usize;

/// The functions of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    Negative,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Exp,
    Ln,
    Abs,
    Signum,
    Recip,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    ExpM1,
    Ln1p,
    Cbrt,
    Log10,
    Log2,
    Exp2,
    Floor,
    Ceil,
    Round,
    Trunc,
}

/// The operations on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
    Atan2,
    Hypot,
    Powf,
    Copysign,
    /// x/(x² + y²), the slope of an angle.
    OverSquares,
}

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Comparison {
    AtMost,
    Less,
    Equal,
    AtLeast,
    Greater,
}

impl Comparison {
    pub fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Self::AtMost => a <= b,
            Self::Less => a < b,
            Self::Equal => a == b,
            Self::AtLeast => a >= b,
            Self::Greater => a > b,
        }
    }
}

/// One operation on earlier results.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// A number that the caller gives.
    Input(usize),
    /// Digits as in the source; their exact value is meant.
    Literal(String),
    /// The bits of an `f64`.
    Bits(u64),
    /// A name of `std::f64::consts`.
    Constant(String),
    Unary(Unary, Place),
    Binary(Binary, Place, Place),
    Power(Place, i32),
    /// The first times the second plus the third, rounded once.
    MulAdd(Place, Place, Place),
    /// The third where the comparison of the first two holds, else the fourth.
    Select(Comparison, [Place; 4]),
    /// The same, but where the first two are equal it is either: the derivative of an `if` between the numbers that it compares.
    Beside(Comparison, [Place; 4]),
    /// The third where the smaller (or the larger) of the first two is the first, else the fourth: the derivative of the
    /// smaller and the larger of two. Of equals the smaller is the first, the larger the second; a NaN is neither.
    Chosen {
        larger: bool,
        of: [Place; 4],
    },
}

/// A kind of number.
pub trait Arithmetic: Clone {
    fn literal(digits: &str) -> Self;
    fn number(value: f64) -> Self;
    fn constant(name: &str) -> Self;
    fn unary(function: Unary, x: &Self) -> Self;
    fn binary(operation: Binary, x: &Self, y: &Self) -> Self;
    fn power(x: &Self, exponent: i32) -> Self;
    fn mul_add(x: &Self, y: &Self, z: &Self) -> Self;
    /// The third where the comparison holds for the first two, else the fourth.
    fn select(comparison: Comparison, of: [&Self; 4]) -> Self;
    /// The same, but of equals either.
    fn beside(comparison: Comparison, of: [&Self; 4]) -> Self;
    /// See [`Step::Chosen`].
    fn chosen(larger: bool, of: [&Self; 4]) -> Self;
}

/// Operations in order; equal ones are one.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    pub steps: Vec<Step>,
    index: HashMap<Step, Place>,
}

impl Tape {
    pub fn push(&mut self, step: Step) -> Place {
        if let Some(place) = self.index.get(&step) {
            return *place;
        }
        self.steps.push(step.clone());
        self.index.insert(step, self.steps.len() - 1);
        self.steps.len() - 1
    }

    pub fn literal(&mut self, digits: &str) -> Place {
        self.push(Step::Literal(digits.to_owned()))
    }

    pub fn unary(&mut self, function: Unary, x: Place) -> Place {
        self.push(Step::Unary(function, x))
    }

    pub fn binary(&mut self, operation: Binary, x: Place, y: Place) -> Place {
        self.push(Step::Binary(operation, x, y))
    }

    /// What a step works on.
    pub fn operands(step: &Step) -> Vec<Place> {
        match step {
            Step::Input(_) | Step::Literal(_) | Step::Bits(_) | Step::Constant(_) => Vec::new(),
            Step::Unary(_, x) | Step::Power(x, _) => vec![*x],
            Step::Binary(_, x, y) => vec![*x, *y],
            Step::MulAdd(x, y, z) => vec![*x, *y, *z],
            Step::Select(_, of) | Step::Beside(_, of) | Step::Chosen { of, .. } => of.to_vec(),
        }
    }

    /// Which steps the outputs need.
    pub fn needed(&self, outputs: &[Place]) -> Vec<bool> {
        let mut needed = vec![false; self.steps.len()];
        for output in outputs {
            needed[*output] = true;
        }
        for place in (0..self.steps.len()).rev() {
            if needed[place] {
                for operand in Self::operands(&self.steps[place]) {
                    needed[operand] = true;
                }
            }
        }
        needed
    }

    /// The result of another tape over these numbers.
    pub fn replay(&mut self, other: &Self, output: Place, arguments: &[Place]) -> Place {
        let needed = other.needed(&[output]);
        let mut images: Vec<Place> = Vec::new();
        for (step, needed) in other.steps.iter().zip(needed) {
            let image = |place: &Place| images[*place];
            let step = match step {
                _ if !needed => None,
                Step::Input(input) => {
                    images.push(arguments[*input]);
                    continue;
                }
                Step::Unary(function, x) => Some(Step::Unary(*function, image(x))),
                Step::Binary(operation, x, y) => Some(Step::Binary(*operation, image(x), image(y))),
                Step::Power(x, exponent) => Some(Step::Power(image(x), *exponent)),
                Step::MulAdd(x, y, z) => Some(Step::MulAdd(image(x), image(y), image(z))),
                Step::Select(comparison, of) => {
                    Some(Step::Select(*comparison, of.map(|place| image(&place))))
                }
                Step::Beside(comparison, of) => {
                    Some(Step::Beside(*comparison, of.map(|place| image(&place))))
                }
                Step::Chosen { larger, of } => Some(Step::Chosen {
                    larger: *larger,
                    of: of.map(|place| image(&place)),
                }),
                number => Some(number.clone()),
            };
            images.push(step.map_or(usize::MAX, |step| self.push(step)));
        }
        images[output]
    }

    /// The outputs for these inputs.
    pub fn evaluate<N: Arithmetic>(&self, outputs: &[Place], inputs: &[N]) -> Vec<N> {
        let needed = self.needed(outputs);
        let zero = N::number(0.0);
        let mut values: Vec<N> = Vec::with_capacity(self.steps.len());
        for (step, needed) in self.steps.iter().zip(needed) {
            let value = if needed {
                evaluate_step(step, &values, inputs)
            } else {
                zero.clone()
            };
            values.push(value);
        }
        outputs
            .iter()
            .map(|output| values[*output].clone())
            .collect()
    }
}

fn evaluate_step<N: Arithmetic>(step: &Step, values: &[N], inputs: &[N]) -> N {
    match step {
        Step::Input(input) => inputs[*input].clone(),
        Step::Literal(digits) => N::literal(digits),
        Step::Bits(bits) => N::number(f64::from_bits(*bits)),
        Step::Constant(name) => N::constant(name),
        Step::Unary(function, x) => N::unary(*function, &values[*x]),
        Step::Binary(operation, x, y) => N::binary(*operation, &values[*x], &values[*y]),
        Step::Power(x, exponent) => N::power(&values[*x], *exponent),
        Step::MulAdd(x, y, z) => N::mul_add(&values[*x], &values[*y], &values[*z]),
        Step::Select(comparison, of) => N::select(*comparison, of.map(|place| &values[place])),
        Step::Beside(comparison, of) => N::beside(*comparison, of.map(|place| &values[place])),
        Step::Chosen { larger, of } => N::chosen(*larger, of.map(|place| &values[place])),
    }
}

/// The nearest `f64` to a name of `std::f64::consts`.
pub fn constant_value(name: &str) -> f64 {
    match name {
        "PI" => std::f64::consts::PI,
        "FRAC_PI_2" => std::f64::consts::FRAC_PI_2,
        "SQRT_2" => std::f64::consts::SQRT_2,
        "E" => std::f64::consts::E,
        "LN_2" => std::f64::consts::LN_2,
        "LN_10" => std::f64::consts::LN_10,
        "EPSILON" => f64::EPSILON,
        other => panic!("unknown constant {other}"),
    }
}

/// Whether the first of two is the smaller (or the larger) one.
pub fn is_first(larger: bool, u: f64, v: f64) -> bool {
    v.is_nan() || if larger { u > v } else { u <= v }
}

impl Arithmetic for f64 {
    fn literal(digits: &str) -> Self {
        digits.parse().unwrap()
    }

    fn number(value: f64) -> Self {
        value
    }

    fn constant(name: &str) -> Self {
        constant_value(name)
    }

    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            Unary::Negative => -x,
            Unary::Sqrt => x.sqrt(),
            Unary::Sin => x.sin(),
            Unary::Cos => x.cos(),
            Unary::Tan => x.tan(),
            Unary::Exp => x.exp(),
            Unary::Ln => x.ln(),
            Unary::Abs => x.abs(),
            Unary::Signum => x.signum(),
            Unary::Recip => x.recip(),
            Unary::Asin => x.asin(),
            Unary::Acos => x.acos(),
            Unary::Atan => x.atan(),
            Unary::Sinh => x.sinh(),
            Unary::Cosh => x.cosh(),
            Unary::Tanh => x.tanh(),
            Unary::Asinh => x.asinh(),
            Unary::Acosh => x.acosh(),
            Unary::Atanh => x.atanh(),
            Unary::ExpM1 => x.exp_m1(),
            Unary::Ln1p => x.ln_1p(),
            Unary::Cbrt => x.cbrt(),
            Unary::Log10 => x.log10(),
            Unary::Log2 => x.log2(),
            Unary::Exp2 => x.exp2(),
            Unary::Floor => x.floor(),
            Unary::Ceil => x.ceil(),
            Unary::Round => x.round(),
            Unary::Trunc => x.trunc(),
        }
    }

    fn binary(operation: Binary, x: &Self, y: &Self) -> Self {
        match operation {
            Binary::Add => x + y,
            Binary::Subtract => x - y,
            Binary::Multiply => x * y,
            Binary::Divide => x / y,
            Binary::Min => x.min(*y),
            Binary::Max => x.max(*y),
            Binary::Atan2 => x.atan2(*y),
            Binary::Hypot => x.hypot(*y),
            Binary::Powf => x.powf(*y),
            Binary::Copysign => x.copysign(*y),
            Binary::OverSquares => {
                let length = x.hypot(*y);
                x / length / length
            }
        }
    }

    fn power(x: &Self, exponent: i32) -> Self {
        x.powi(exponent)
    }

    fn mul_add(x: &Self, y: &Self, z: &Self) -> Self {
        x.mul_add(*y, *z)
    }

    fn select(comparison: Comparison, [a, b, x, y]: [&Self; 4]) -> Self {
        if comparison.holds(*a, *b) { *x } else { *y }
    }

    fn beside(comparison: Comparison, of: [&Self; 4]) -> Self {
        Self::select(comparison, of)
    }

    fn chosen(larger: bool, [u, v, x, y]: [&Self; 4]) -> Self {
        if is_first(larger, *u, *v) { *x } else { *y }
    }
}
