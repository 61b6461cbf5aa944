//! Random modules over the whole language, with the numbers and forms that a generator is most likely to get wrong.

use super::program::{Binding, Helper, INPUTS, Kind, Let, Node, Output, Program, Shape};

/// A small generator of random numbers (splitmix64): the same numbers for the same seed, everywhere.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number below that one.
    pub fn below(&mut self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    /// True that often of a hundred times.
    pub fn percent(&mut self, often: usize) -> bool {
        self.below(100) < often
    }

    /// From 0 to 1, with 53 digits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    pub fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }

    /// One of these as often as their weights say.
    fn weighted(&mut self, weights: &[usize]) -> usize {
        let mut left = self.below(weights.iter().sum());
        for (position, weight) in weights.iter().enumerate() {
            if left < *weight {
                return position;
            }
            left -= weight;
        }
        0
    }
}

const PLAIN: [&str; 12] = [
    "1.0", "2.0", "0.5", "3.0", "4.0", "0.25", "0.1", "0.3", "1.5e-1", "2f64", "7.0", "0.0",
];
/// Numbers that are no literals of `f64`.
const CAST: [&str; 3] = ["(2 as f64)", "(3_i32 as f64)", "f64::EPSILON"];
const NAMED: [&str; 6] = ["PI", "E", "LN_2", "SQRT_2", "FRAC_PI_2", "K"];
const HOSTILE: [&str; 17] = [
    "2305843009213693951.0",
    "2305843009213693952.0",
    "2305843009213693953.0",
    "1e300",
    "1e-300",
    "5e-324",
    "1e-310",
    "1e170",
    "1e-170",
    "9007199254740993.0",
    "1152921504606846977.0",
    "0.333333333333333333333",
    "1e16",
    "1e-16",
    "1.7976931348623157e308",
    "2.2250738585072014e-308",
    "123456789012345678901234567890.0",
];
const FUNCTIONS: [&str; 10] = [
    "sqrt", "sin", "cos", "tan", "exp", "ln", "abs", "recip", "sqrt", "signum",
];
const FUNCTIONS_OF_ONE: [&str; 22] = [
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "exp_m1",
    "ln_1p",
    "cbrt",
    "log10",
    "log2",
    "exp2",
    "floor",
    "ceil",
    "round",
    "trunc",
    "fract",
    "to_radians",
    "to_degrees",
];
const FUNCTIONS_OF_TWO: [&str; 5] = ["log", "atan2", "hypot", "powf", "copysign"];
const COMPARISONS: [&str; 6] = ["<", "<=", ">", ">=", "==", "!="];
const LARGE_POWERS: [i32; 11] = [7, 8, 10, 16, 17, 31, 64, 100, 1000, -17, -100];

/// What an expression may use.
struct Scope {
    names: Vec<String>,
    helpers: Vec<Shape>,
}

/// A random module.
pub fn program(random: &mut Random) -> Program {
    let mut helpers: Vec<Helper> = Vec::new();
    for _ in 0..random.weighted(&[5, 3, 2]) {
        let shapes: Vec<Shape> = helpers.iter().map(|helper| helper.shape).collect();
        helpers.push(helper(random, shapes));
    }
    let mut names: Vec<String> = Vec::new();
    for _ in 0..1 + random.weighted(&[3, 5, 3, 1]) {
        names.push(random.one_of(&INPUTS).to_owned());
    }
    let mut scope = Scope {
        names,
        helpers: helpers.iter().map(|helper| helper.shape).collect(),
    };
    let mut lets = Vec::new();
    for position in 0..random.weighted(&[3, 4, 3, 1]) {
        let bound = binding(random, &scope, format!("t{position}"));
        scope.names.extend(bound.names());
        lets.push(bound);
    }
    let output = match random.weighted(&[12, 1, 1, 1]) {
        0 => Output::Number,
        1 => Output::Tuple,
        2 => Output::Array,
        _ => Output::Struct,
    };
    let results = if output == Output::Number { 1 } else { 2 };
    let results = (0..results)
        .map(|_| expression(random, &scope, 3))
        .collect();
    let domain = if random.percent(30) {
        let comparisons = [">", ">", ">=", "<", "<=", "!="];
        vec![(random.below(INPUTS.len()), random.one_of(&comparisons))]
    } else {
        Vec::new()
    };
    Program {
        helpers,
        lets,
        results,
        output,
        domain,
    }
}

fn helper(random: &mut Random, helpers: Vec<Shape>) -> Helper {
    let shape = random.one_of(&[Shape::Numbers, Shape::Array, Shape::Struct]);
    let mut scope = Scope {
        names: shape.names().map(str::to_owned).to_vec(),
        helpers,
    };
    let mut lets = Vec::new();
    if random.percent(30) {
        let node = expression(random, &scope, 2);
        scope.names.push("t".to_owned());
        lets.push(Let {
            name: "t".to_owned(),
            binding: Binding::Number,
            nodes: vec![node],
        });
    }
    let result = expression(random, &scope, 2);
    Helper {
        shape,
        lets,
        result,
    }
}

fn binding(random: &mut Random, scope: &Scope, name: String) -> Let {
    let all = [
        Binding::Number,
        Binding::Tuple,
        Binding::Array,
        Binding::Struct,
        Binding::Rest,
    ];
    let binding = all[random.weighted(&[8, 1, 1, 1, 1])];
    let count = match binding {
        Binding::Number | Binding::Rest => 1,
        _ => 2,
    };
    let nodes = (0..count).map(|_| {
        // Named products and sums are treated apart.
        let (a, b) = (expression(random, scope, 1), expression(random, scope, 1));
        match random.below(3) {
            0 => product(a, b),
            1 => sum(random.percent(50), a, b),
            _ => a,
        }
    });
    let nodes = nodes.collect();
    Let {
        name,
        binding,
        nodes,
    }
}

fn product(a: Node, b: Node) -> Node {
    Node::new(Kind::Product, vec![a, b])
}

fn quotient(a: Node, b: Node) -> Node {
    Node::new(Kind::Quotient, vec![a, b])
}

fn sum(minus: bool, a: Node, b: Node) -> Node {
    Node::new(Kind::Sum(vec![false, minus]), vec![a, b])
}

fn power(a: Node, exponent: i32) -> Node {
    Node::new(Kind::Power(exponent), vec![a])
}

fn method(name: &'static str, parts: Vec<Node>) -> Node {
    Node::new(Kind::Method(name), parts)
}

fn leaf(random: &mut Random, scope: &Scope) -> Node {
    if random.percent(75) {
        return Node::name(&random.one_of(&scope.names));
    }
    match random.weighted(&[10, 2, 2, 3, 1]) {
        0 => Node::literal(random.one_of(&PLAIN)),
        1 => Node::name(random.one_of(&NAMED)),
        2 => Node::literal(random.one_of(&HOSTILE)),
        4 => Node::literal(random.one_of(&CAST)),
        _ => near_power_of_two(random),
    }
}

/// 2^k or a number beside it, or its inverse.
fn near_power_of_two(random: &mut Random) -> Node {
    let exponent = random.below(71);
    if random.percent(25) {
        return Node::literal(&format!("{:e}", 2.0_f64.powi(-(exponent as i32))));
    }
    let number = (1_i128 << exponent) + random.below(3) as i128 - 1;
    Node::literal(&format!("{number}.0"))
}

fn expression(random: &mut Random, scope: &Scope, depth: usize) -> Node {
    if depth == 0 || random.percent(12) {
        return leaf(random, scope);
    }
    let part = |random: &mut Random| expression(random, scope, depth - 1);
    match random.weighted(&[10, 8, 6, 1, 4, 6, 3, 2, 3, 1, 8, 5, 3, 4]) {
        0 => {
            let count = 2 + random.below(2);
            let minus = (0..count).map(|_| random.percent(50)).collect();
            let parts = (0..count).map(|_| part(random)).collect();
            Node::new(Kind::Sum(minus), parts)
        }
        1 => product(part(random), part(random)),
        2 => quotient(part(random), part(random)),
        3 => Node::new(Kind::Negative, vec![part(random)]),
        4 => {
            let exponent = if random.percent(6) {
                random.one_of(&LARGE_POWERS)
            } else {
                random.below(8) as i32 - 3
            };
            power(part(random), exponent)
        }
        5 => method(random.one_of(&FUNCTIONS), vec![part(random)]),
        6 => {
            let name = random.one_of(&["min", "max"]);
            method(name, vec![part(random), part(random)])
        }
        7 => method("mul_add", vec![part(random), part(random), part(random)]),
        8 => call(random, scope, depth),
        9 => {
            let bound = part(random);
            let names = scope
                .names
                .iter()
                .cloned()
                .chain(["b".to_owned()])
                .collect();
            let inner = Scope {
                names,
                helpers: scope.helpers.clone(),
            };
            let result = expression(random, &inner, depth - 1);
            Node::new(Kind::Block("b".to_owned()), vec![bound, result])
        }
        10 => disguised(random, part),
        11 => {
            let (name, parts) = (random.one_of(&FUNCTIONS_OF_ONE), vec![part(random)]);
            function(random, name, parts)
        }
        12 if random.percent(15) => method("clamp", vec![part(random), part(random), part(random)]),
        12 => {
            let name = random.one_of(&FUNCTIONS_OF_TWO);
            let parts = vec![part(random), part(random)];
            function(random, name, parts)
        }
        _ => choice(random, part),
    }
}

/// A call of a function as a method or by its path.
fn function(random: &mut Random, name: &'static str, parts: Vec<Node>) -> Node {
    if random.percent(25) {
        return Node::new(Kind::Function(name), parts);
    }
    method(name, parts)
}

/// An `if`; some are between the numbers that they compare, some have two conditions.
fn choice(random: &mut Random, part: impl Fn(&mut Random) -> Node) -> Node {
    let comparison = random.one_of(&COMPARISONS);
    let (a, b) = (part(random), part(random));
    if random.percent(20) {
        let mut taken = vec![a.clone(), b.clone()];
        if random.percent(50) {
            taken.reverse();
        }
        let parts = [a, b].into_iter().chain(taken).collect();
        return Node::new(Kind::If(comparison, None), parts);
    }
    let (x, y) = (part(random), part(random));
    if random.percent(30) {
        let joined = (random.one_of(&["&&", "||"]), random.one_of(&COMPARISONS));
        let parts = vec![a, b, part(random), part(random), x, y];
        return Node::new(Kind::If(comparison, Some(joined)), parts);
    }
    Node::new(Kind::If(comparison, None), vec![a, b, x, y])
}

fn call(random: &mut Random, scope: &Scope, depth: usize) -> Node {
    let parts = vec![
        expression(random, scope, depth - 1),
        expression(random, scope, depth - 1),
    ];
    if scope.helpers.is_empty() {
        return Node::new(Kind::Quotient, parts);
    }
    let helper = random.below(scope.helpers.len());
    let ends = scope.helpers[helper].partials();
    let partial = match random.weighted(&[5, 3, 1]) {
        0 => None,
        1 => Some(format!("d_{}", random.one_of(&ends))),
        _ => Some(format!(
            "d_{}_{}",
            random.one_of(&ends),
            random.one_of(&ends)
        )),
    };
    Node::new(Kind::Call(helper, partial), parts)
}

/// What is 0, or equal to something simple, without looking like it; and chains in which a form's order counts.
fn disguised(random: &mut Random, part: impl Fn(&mut Random) -> Node) -> Node {
    let (a, b, c, d) = (part(random), part(random), part(random), part(random));
    let one = || Node::literal("1.0");
    let twice = |a: Node, b: Node| product(product(Node::literal("2.0"), a), b);
    let square = |a: &Node| power(a.clone(), 2);
    match random.below(23) {
        0 => {
            let parts = vec![
                square(&sum(false, a.clone(), b.clone())),
                square(&a),
                twice(a, b.clone()),
                square(&b),
            ];
            Node::new(Kind::Sum(vec![false, true, true, true]), parts)
        }
        1 => quotient(product(a, b.clone()), b),
        2 => quotient(quotient(a, b), quotient(c, d)),
        3 => quotient(quotient(quotient(a, b), c), d),
        4 => quotient(a, quotient(b, quotient(c, d))),
        5 => method("sqrt", vec![product(a.clone(), a)]),
        6 => {
            let difference = sum(true, a.clone(), b.clone());
            let product_of = product(difference, sum(false, a.clone(), b.clone()));
            sum(true, product_of, sum(true, square(&a), square(&b)))
        }
        7 => method("exp", vec![method("ln", vec![a])]),
        8 => quotient(one(), quotient(one(), a)),
        9 => sum(true, sum(false, a.clone(), b), a),
        10 => sum(true, quotient(a, b), quotient(c, d)),
        11 => sum(true, quotient(one(), a), quotient(one(), b)),
        12 => {
            let (sine, cosine) = (method("sin", vec![a.clone()]), method("cos", vec![a]));
            sum(false, square(&sine), square(&cosine))
        }
        13 => method("max", vec![method("min", vec![a, b]), c]),
        14 => method(
            "min",
            vec![method("abs", vec![a]), method("max", vec![b, c])],
        ),
        15 => quotient(a.clone(), sum(false, a, b)),
        16 => method("sqrt", vec![sum(false, square(&a), square(&b))]),
        17 => sum(true, product(a.clone(), b.clone()), product(b, a)),
        // In a prime field of 2^61 - 1 these are 0, a, and a over 0.
        19 => sum(
            true,
            product(a.clone(), Node::literal("2305843009213693952.0")),
            a,
        ),
        20 => sum(false, a, product(Node::literal("2305843009213693951.0"), b)),
        21 => quotient(a, sum(false, b, Node::literal("2305843009213693951.0"))),
        18 => quotient(sum(true, square(&a), square(&b)), sum(true, a, b)),
        _ => product(
            method("sqrt", vec![a.clone()]),
            method("sqrt", vec![quotient(b, a)]),
        ),
    }
}
