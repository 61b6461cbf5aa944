//! The methods that formulas may call, and what to write for those that they may not.

use crate::graph::Function;

/// Methods that stand for several operations: name and number of arguments.
const COMPOSED: [(&str, usize); 9] = [
    ("powi", 1),
    ("recip", 0),
    ("fract", 0),
    ("to_radians", 0),
    ("to_degrees", 0),
    ("sin_cos", 0),
    ("clamp", 2),
    ("copysign", 1),
    ("log", 1),
];

/// Other names of what is known, with the name here. None of them stands for other mathematics.
const ALIASES: [(&str, &str); 30] = [
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("arctan2", "atan2"),
    ("arcsinh", "asinh"),
    ("arccosh", "acosh"),
    ("arctanh", "atanh"),
    ("arsinh", "asinh"),
    ("arcosh", "acosh"),
    ("artanh", "atanh"),
    ("expm1", "exp_m1"),
    ("log1p", "ln_1p"),
    ("ln1p", "ln_1p"),
    ("log_2", "log2"),
    ("log_10", "log10"),
    ("exp_2", "exp2"),
    ("fabs", "abs"),
    ("fmin", "min"),
    ("fmax", "max"),
    ("fma", "mul_add"),
    ("sign", "signum"),
    ("sgn", "signum"),
    ("ceiling", "ceil"),
    ("truncate", "trunc"),
    ("radians", "to_radians"),
    ("degrees", "to_degrees"),
    ("sincos", "sin_cos"),
    ("pow", "powi` for a whole power, `powf"),
    ("inv", "recip"),
    ("reciprocal", "recip"),
];

/// Methods that people write and formulas don't have, with what to write instead.
const INSTEAD: [(&str, &str); 11] = [
    ("erf", "write `libm::erf(x)`, with the crate libm"),
    ("erfc", "write `libm::erfc(x)`, with the crate libm"),
    ("square", "write `x.powi(2)`"),
    ("sqr", "a square is `powi(2)`, a square root `sqrt()`"),
    ("cube", "write `x.powi(3)`"),
    ("sec", "write `x.cos().recip()`"),
    ("csc", "write `x.sin().recip()`"),
    ("cot", "write `x.tan().recip()`"),
    ("exp10", "write `10.0_f64.powf(x)`"),
    ("is_nan", "compare: `x != x` holds where x is no number"),
    (
        "rem_euclid",
        "write `x - y * (x / y).floor()`, for y above 0",
    ),
];

/// All methods with the number of their arguments, `powi` first.
pub(crate) fn all() -> impl Iterator<Item = (&'static str, usize)> {
    let (first, rest) = COMPOSED.split_at(1);
    let called = Function::called().map(|row| (row.method, row.arity - 1));
    let first = first.iter().copied();
    first.chain(called).chain(rest.iter().copied())
}

/// The function that a method is alone.
pub(crate) fn function(method: &str) -> Option<Function> {
    let mut called = Function::called();
    let row = called.find(|row| row.method == method)?;
    Some(row.function)
}

/// What to write instead of a method that there is not: another name of the same function, or all that there are. Names that
/// are only alike are often other mathematics.
pub(crate) fn hint(method: &str) -> String {
    let of = |names: &[(&'static str, &'static str)]| {
        let mut names = names.iter();
        names.find(|(name, _)| *name == method).map(|(_, to)| *to)
    };
    if let Some(instead) = of(&INSTEAD) {
        return instead.to_owned();
    }
    let mistyped = || {
        all()
            .map(|(name, _)| name)
            .find(|name| is_mistyped(method, name))
    };
    match of(&ALIASES).or_else(mistyped) {
        Some(name) => format!("did you mean `{name}`?"),
        None => {
            let names: Vec<&str> = all().map(|(name, _)| name).collect();
            format!("the methods are {}", names.join(", "))
        }
    }
}

/// Whether a word has the letters of a name, in another case, doubled, or two of them exchanged.
fn is_mistyped(word: &str, name: &str) -> bool {
    let letters = |text: &str| {
        let mut letters: Vec<char> = text.to_lowercase().chars().filter(|c| *c != '_').collect();
        letters.dedup();
        letters
    };
    let (word, name) = (letters(word), letters(name));
    if word.len() != name.len() {
        return false;
    }
    let apart: Vec<usize> = (0..word.len())
        .filter(|place| word[*place] != name[*place])
        .collect();
    match *apart.as_slice() {
        [] => true,
        [first, second] => {
            second == first + 1 && word[first] == name[second] && word[second] == name[first]
        }
        [..] => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_lead_to_no_other_mathematics() {
        let other = [
            "sinc",
            "sech",
            "coth",
            "asec",
            "acoth",
            "gamma",
            "ln_gamma",
            "sqrtpi",
            "cosm1",
            "logit",
            "expit",
            "sinpi",
            "rsqrt",
            "rootn",
            "softplus",
            "norm",
            "nrm",
            "sum",
            "mean",
            "frac_pi",
            "round_ties_even",
            "div_euclid",
            "next_up",
            "lerp",
            "hypot3",
            "exp1",
            "log3",
            "logb",
            "ldexp",
            "modulo",
        ];
        for method in other {
            let hint = hint(method);
            assert!(
                hint.starts_with("the methods are powi, sqrt,"),
                "{method}: {hint}"
            );
        }
        for (method, meant) in [
            ("SQRT", "sqrt"),
            ("sqtr", "sqrt"),
            ("floorr", "floor"),
            ("tahn", "tanh"),
            ("arctan2", "atan2"),
            ("log1p", "ln_1p"),
        ] {
            assert_eq!(hint(method), format!("did you mean `{meant}`?"));
        }
    }

    #[test]
    fn aliases_are_no_methods() {
        let names = ALIASES.iter().chain(&INSTEAD).map(|(name, _)| name);
        for name in names {
            assert!(all().all(|(known, _)| known != *name), "{name}");
        }
    }
}
