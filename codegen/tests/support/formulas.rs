//! Random modules of formulas.

use proptest::prelude::*;

/// A random expression.
#[derive(Clone, Debug)]
pub enum Random {
    Name(usize),
    Literal(usize),
    Sum(Vec<(bool, Random)>),
    Product(Box<Random>, Box<Random>),
    Quotient(Box<Random>, Box<Random>),
    Negative(Box<Random>),
    Power(Box<Random>, i32),
    Function(usize, Box<Random>),
    Extreme(bool, Box<Random>, Box<Random>),
    MulAdd(Box<Random>, Box<Random>, Box<Random>),
    Helper(Box<Random>, Box<Random>),
    Block(Box<Random>, Box<Random>),
}

/// Numbers of a formula, with the constants of the module and of the standard library.
const LITERALS: [&str; 14] = [
    "1.0",
    "2.0",
    "0.5",
    "3.0",
    "4.0",
    "0.25",
    "0.0",
    "1.5e-1",
    "2f64",
    "10.0",
    "K",
    "std::f64::consts::PI",
    "SQRT_2",
    "LN_2",
];
const FUNCTIONS: [&str; 8] = ["sqrt", "sin", "cos", "tan", "exp", "ln", "abs", "recip"];
/// The numbers that the formula takes.
pub const INPUTS: [&str; 6] = ["x", "y", "a[0]", "a[1]", "s.p", "s.q"];

pub fn expression() -> impl Strategy<Value = Random> {
    let leaf = prop_oneof![4 => (0..12_usize).prop_map(Random::Name), 1 => (0..LITERALS.len()).prop_map(Random::Literal)];
    leaf.prop_recursive(5, 28, 3, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        prop_oneof![
            5 => prop::collection::vec((any::<bool>(), inner.clone()), 2..4).prop_map(Random::Sum),
            5 => (boxed.clone(), boxed.clone()).prop_map(|(a, b)| Random::Product(a, b)),
            2 => (boxed.clone(), boxed.clone()).prop_map(|(a, b)| Random::Quotient(a, b)),
            1 => boxed.clone().prop_map(Random::Negative),
            2 => (boxed.clone(), -3..=4_i32).prop_map(|(a, n)| Random::Power(a, n)),
            3 => (0..FUNCTIONS.len(), boxed.clone()).prop_map(|(f, a)| Random::Function(f, a)),
            1 => (any::<bool>(), boxed.clone(), boxed.clone()).prop_map(|(m, a, b)| Random::Extreme(m, a, b)),
            1 => (boxed.clone(), boxed.clone(), boxed.clone()).prop_map(|(a, b, c)| Random::MulAdd(a, b, c)),
            1 => (boxed.clone(), boxed.clone()).prop_map(|(a, b)| Random::Helper(a, b)),
            1 => (boxed.clone(), boxed).prop_map(|(a, b)| Random::Block(a, b)),
        ]
    })
}

impl Random {
    /// As Rust, over these names; a helper is called only where there is one.
    pub fn rust(&self, names: &[&str], helper: Option<&str>) -> String {
        let r = |inner: &Random| inner.rust(names, helper);
        match self {
            Self::Name(index) => names[index % names.len()].to_owned(),
            Self::Literal(index) => LITERALS[*index].to_owned(),
            Self::Sum(terms) => {
                let mut text = String::new();
                for (position, (minus, term)) in terms.iter().enumerate() {
                    let sign = match (position, minus) {
                        (0, _) => "",
                        (_, true) => " - ",
                        (_, false) => " + ",
                    };
                    text += &format!("{sign}({})", r(term));
                }
                text
            }
            Self::Product(a, b) => format!("({}) * ({})", r(a), r(b)),
            Self::Quotient(a, b) => {
                format!("({}) / ({})", r(a), other_than_zero(r(b)))
            }
            Self::Negative(a) => format!("-({})", r(a)),
            Self::Power(a, exponent) => format!("({}).powi({exponent})", r(a)),
            Self::Function(function, a) => format!("({}).{}()", r(a), FUNCTIONS[*function]),
            Self::Extreme(larger, a, b) => format!(
                "({}).{}({})",
                r(a),
                if *larger { "max" } else { "min" },
                r(b)
            ),
            Self::MulAdd(a, b, c) => format!("({}).mul_add({}, {})", r(a), r(b), r(c)),
            Self::Helper(a, b) => match helper {
                Some(helper) => format!("{helper}({}, {})", r(a), r(b)),
                None => format!("({}) - ({})", r(a), r(b)),
            },
            Self::Block(a, b) => format!("{{ let t = {}; ({}) * t }}", r(a), r(b)),
        }
    }
}

/// The expression, or 1 where it is the literal 0, by which a division is refused.
fn other_than_zero(expression: String) -> String {
    if expression.trim_matches(['-', '(', ')']) == "0.0" {
        "1.0".to_owned()
    } else {
        expression
    }
}

/// The shape of a formula's result.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    Number,
    Tuple,
    Array,
    Struct,
}

/// A random module with the function `formula` and what it calls.
#[derive(Clone)]
pub struct RandomModule {
    pub parts: Vec<Random>,
    pub shape: Shape,
}

pub fn random_module() -> impl Strategy<Value = RandomModule> {
    let shape = prop_oneof![2 => Just(Shape::Number), 1 => Just(Shape::Tuple), 1 => Just(Shape::Array), 1 => Just(Shape::Struct)];
    (prop::collection::vec(expression(), 6), shape)
        .prop_map(|(parts, shape)| RandomModule { parts, shape })
}

impl std::fmt::Debug for RandomModule {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.source())
    }
}

impl RandomModule {
    pub fn source(&self) -> String {
        let part = |position: usize, names: &[&str], helper: Option<&str>| {
            self.parts[position].rust(names, helper)
        };
        let helper = part(0, &["u", "v"], None);
        let first = part(1, &["x", "y", "s.p"], Some("helper"));
        let (second, third) = (
            part(2, &["a[0]", "x", "first"], Some("helper")),
            part(3, &["a[1]", "s.q", "y"], None),
        );
        let all = [
            "x", "y", "a[0]", "a[1]", "s.p", "s.q", "first", "second", "third", "pair.0",
            "list[1]", "made.p",
        ];
        let (one, two) = (
            part(4, &all, Some("helper")),
            part(5, &all[6..], Some("helper")),
        );
        let (ty, result) = match self.shape {
            Shape::Number => ("f64", format!("({one}) + 0.5 * ({two})")),
            Shape::Tuple => ("(f64, f64)", format!("({one}, {two})")),
            Shape::Array => ("[f64; 2]", format!("[{one}, {two}]")),
            Shape::Struct => ("S", format!("S {{ p: {one}, q: {two} }}")),
        };
        format!(
            "mod random {{
                use std::f64::consts::{{LN_2, SQRT_2}};
                const K: f64 = 2.0 * 0.375;
                pub struct S {{ pub p: f64, pub q: f64 }}
                fn helper(u: f64, v: f64) -> f64 {{ {helper} }}
                #[generate(value, gradient, hessian, columns)]
                pub fn formula(x: f64, y: f64, a: [f64; 2], s: &S) -> {ty} {{
                    let first = {first};
                    let (second, third): (f64, f64) = ({second}, {third});
                    let pair = (first + third, second);
                    let list = [second, x - third];
                    let made = S {{ p: pair.0 * y, q: first }};
                    {result}
                }}
            }}"
        )
    }
}
