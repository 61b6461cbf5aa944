//! The table of rules.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::Signed;

use super::exponentials::product_of_exponentials;
use super::fractions::{
    cancelling_fractions, inverse_root, nested_absolute_fraction, nested_fraction, root_of_quotient,
};
use super::signs::{
    absolute_of_known_sign, absolute_of_product, even_power_of_absolute, number_by_sign,
    power_of_sign, root_bounds_operand, sign_by_size, sign_of_known_sign, sign_of_product,
};
use super::{Rule, applied, product};
use smallvec::smallvec;

use crate::graph::{ExprId, Factors, Function, Graph, Node, Rational, whole};

/// All rules, in the order in which they are tried.
#[rustfmt::skip]
pub const RULES: &[Rule] = &[
    Rule { name: "root of a power",        pattern: "(x.powi(2) * y).sqrt()",                 result: "x.abs() * y.sqrt()",                    given: "",                   apply: root_of_power },
    Rule { name: "root of a known square", pattern: "(x.powi(2) * y).sqrt()",                 result: "x * y.sqrt()",                          given: "x >= 0.0",           apply: root_of_power },
    Rule { name: "root of a multiple",     pattern: "(4.0 * x).sqrt()",                       result: "2.0 * x.sqrt()",                        given: "",                   apply: root_of_multiple },
    Rule { name: "power of a root",        pattern: "x.sqrt().powi(3)",                       result: "x * x.sqrt()",                          given: "",                   apply: power_of_root },
    Rule { name: "root over its square",   pattern: "x.sqrt() / x",                           result: "1.0 / x.sqrt()",                        given: "",                   apply: root_and_power },
    Rule { name: "square over its root",   pattern: "x / x.sqrt()",                           result: "x.sqrt()",                              given: "",                   apply: root_and_power },
    Rule { name: "product over its root",  pattern: "2.0 * x.powi(2) * y / (x * y).sqrt()",   result: "2.0 * x * (x * y).sqrt()",              given: "",                   apply: product_and_root },
    Rule { name: "square of a sign",       pattern: "x.signum().powi(2) * y",                 result: "y",                                     given: "",                   apply: power_of_sign },
    Rule { name: "number by its sign",     pattern: "x.powi(3) * x.signum()",                 result: "x.powi(2) * x.abs()",                   given: "",                   apply: number_by_sign },
    Rule { name: "size by its sign",       pattern: "x.abs() * x.signum() * y",               result: "x * y",                                 given: "",                   apply: sign_by_size },
    Rule { name: "size over its number",   pattern: "y * x.abs() / x",                        result: "y * x.signum()",                        given: "",                   apply: sign_by_size },
    Rule { name: "number over its size",   pattern: "x.powi(3) / x.abs()",                    result: "x.powi(2) * x.signum()",                given: "",                   apply: sign_by_size },
    Rule { name: "sign of a multiple",     pattern: "(-4.0 * x).signum()",                    result: "-x.signum()",                           given: "",                   apply: sign_of_product },
    Rule { name: "sign of a power",        pattern: "(x.powi(2) * y.powi(3)).signum()",       result: "y.signum()",                            given: "",                   apply: sign_of_product },
    Rule { name: "sign of a known sign",   pattern: "(x * y).signum()",                       result: "-x.signum()",                           given: "y < 0.0",            apply: sign_of_product },
    Rule { name: "sign of a positive",     pattern: "(x + y).signum()",                       result: "1.0",                                   given: "x > 0.0, y >= 0.0",  apply: sign_of_known_sign },
    Rule { name: "sign of a negative",     pattern: "(x + y).signum()",                       result: "-1.0",                                  given: "x < 0.0, y <= 0.0",  apply: sign_of_known_sign },
    Rule { name: "size beside its root",   pattern: "x.abs() * x.sqrt()",                     result: "x * x.sqrt()",                          given: "",                   apply: root_bounds_operand },
    Rule { name: "sign beside its root",   pattern: "x.signum() / (x * y).sqrt()",            result: "1.0 / (x * y).sqrt()",                  given: "y > 0.0",            apply: root_bounds_operand },
    Rule { name: "fractions that cancel",  pattern: "1.0 / z - x.powi(2) / ((x.powi(2) + y) * z)", result: "y / ((x.powi(2) + y) * z)",        given: "",                   apply: cancelling_fractions },
    Rule { name: "fractions of a constant difference", pattern: "1.0 / z - (2.0 * x + y).powi(2) / (4.0 * (x.powi(2) + x * y + y.powi(2)) * z)", result: "0.75 * y.powi(2) / ((x.powi(2) + x * y + y.powi(2)) * z)", given: "", apply: cancelling_fractions },
    Rule { name: "inverse root",           pattern: "1.0 / (x / y).sqrt()",                   result: "(y / x).sqrt()",                        given: "",                   apply: inverse_root },
    Rule { name: "nested fraction",        pattern: "1.0 / (x / y - z / w)",                  result: "y * w / (x * w - y * z)",               given: "",                   apply: nested_fraction },
    Rule { name: "nested absolute fraction", pattern: "1.0 / (x / y - z / w).abs()",          result: "y.abs() * w.abs() / (x * w - y * z).abs()", given: "",               apply: nested_absolute_fraction },
    Rule { name: "even power of a size",   pattern: "x.abs().powi(2)",                        result: "x.powi(2)",                             given: "",                   apply: even_power_of_absolute },
    Rule { name: "size of a known sign",   pattern: "(x * y).abs()",                          result: "-x * y.abs()",                          given: "x <= 0.0",           apply: absolute_of_product },
    Rule { name: "size of a positive",     pattern: "(x + y).abs()",                          result: "x + y",                                 given: "x > 0.0, y >= 0.0",  apply: absolute_of_known_sign },
    Rule { name: "size of a negative",     pattern: "(x + y).abs()",                          result: "-(x + y)",                              given: "x < 0.0, y <= 0.0",  apply: absolute_of_known_sign },
    Rule { name: "size of a multiple",     pattern: "(-2.0 * x).abs()",                       result: "2.0 * x.abs()",                         given: "",                   apply: absolute_of_product },
    Rule { name: "size of a power",        pattern: "(x.powi(2) * y).abs()",                  result: "x.powi(2) * y.abs()",                   given: "",                   apply: absolute_of_product },
    Rule { name: "even cosine",            pattern: "(-2.0 * x).cos()",                       result: "(2.0 * x).cos()",                       given: "",                   apply: even_function },
    Rule { name: "cosine of a size",       pattern: "x.abs().cos()",                          result: "x.cos()",                               given: "",                   apply: even_function },
    Rule { name: "odd sine",               pattern: "(-2.0 * x).sin()",                       result: "-(2.0 * x).sin()",                      given: "",                   apply: odd_function },
    Rule { name: "odd tangent",            pattern: "(-2.0 * x).tan()",                       result: "-(2.0 * x).tan()",                      given: "",                   apply: odd_function },
    Rule { name: "sine and cosine",        pattern: "3.0 * x.sin().powi(2) + 3.0 * x.cos().powi(2) + y", result: "3.0 + y",                    given: "",                   apply: sine_and_cosine },
    Rule { name: "logarithm of exp",       pattern: "x.exp().ln()",                           result: "x",                                     given: "",                   apply: inverse_functions },
    Rule { name: "exp of a logarithm",     pattern: "x.ln().exp()",                           result: "x",                                     given: "",                   apply: inverse_functions },
    Rule { name: "smaller of equals",      pattern: "x.min(x)",                               result: "x",                                     given: "",                   apply: one_of_equals },
    Rule { name: "larger of equals",       pattern: "x.max(x)",                               result: "x",                                     given: "",                   apply: one_of_equals },
    Rule { name: "smaller by sign",        pattern: "x.min(y)",                               result: "y",                                     given: "x >= 0.0, y <= 0.0", apply: extreme_by_sign },
    Rule { name: "larger by sign",         pattern: "x.max(0.0)",                             result: "x",                                     given: "x >= 0.0",           apply: extreme_by_sign },
    Rule { name: "value at zero",          pattern: "0.0_f64.exp() + 0.0_f64.sin() + 0.0_f64.cos() + 1.0_f64.ln()", result: "2.0",             given: "",                   apply: value_at_number },
];

/// Rules that save operations but may lose range, or cost some; each is one of the ways among which the cheapest is chosen.
#[rustfmt::skip]
pub const TRIED: &[Rule] = &[
    Rule { name: "root of a quotient",     pattern: "(x / y).sqrt() / y",                     result: "(x * y).sqrt() / (y.abs() * y)",        given: "",                   apply: root_of_quotient },
    Rule { name: "product of exps",        pattern: "x.exp() * y.exp() * z",                  result: "(x + y).exp() * z",                     given: "",                   apply: product_of_exponentials },
];

/// A rational multiple of a product, taken apart.
pub(crate) fn parts(graph: &Graph, id: ExprId) -> (Rational, Factors) {
    match graph.node(id) {
        Node::Number(value) => (value.clone(), Factors::new()),
        Node::Sum(terms) if terms.len() == 1 => {
            let (coefficient, factors) = parts(graph, terms[0].0);
            (&terms[0].1 * coefficient, factors)
        }
        Node::Product(factors) => (Rational::ONE, factors.clone()),
        _ => (Rational::ONE, smallvec![(id, 1)]),
    }
}

/// The operand of an elementary function of one operand.
pub(super) fn operand_of(graph: &Graph, id: ExprId, function: Function) -> Option<ExprId> {
    match graph.node(id) {
        Node::Apply(known, operands) if *known == function => operands.first().copied(),
        _ => None,
    }
}

/// The factors of a product, where one at least is one of these functions of something: most products have none, and are long
/// where they are derivatives along a chain.
pub(super) fn factors_with(graph: &Graph, id: ExprId, functions: &[Function]) -> Option<Factors> {
    let Node::Product(factors) = graph.node(id) else {
        return None;
    };
    let is_wanted = |(factor, _): &(ExprId, i32)| match graph.node(*factor) {
        Node::Apply(function, _) => functions.contains(function),
        _ => false,
    };
    factors.iter().any(is_wanted).then(|| factors.clone())
}

pub(super) fn scaled(
    graph: &mut Graph,
    coefficient: Rational,
    factors: impl IntoIterator<Item = (ExprId, i32)>,
) -> ExprId {
    let id = product(graph, factors);
    graph.scale(id, coefficient)
}

fn root_of_power(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let (coefficient, factors) = parts(graph, operand_of(graph, id, Function::Sqrt)?);
    if factors.iter().all(|(_, exponent)| exponent.abs() < 2) {
        return None;
    }
    let mut outside = Vec::new();
    let mut inside = Vec::new();
    for (factor, exponent) in factors {
        let half = exponent / 2;
        if half != 0 {
            outside.push((applied(graph, Function::Abs, factor), half));
        }
        inside.push((factor, exponent % 2));
    }
    let radicand = scaled(graph, coefficient, inside);
    outside.push((applied(graph, Function::Sqrt, radicand), 1));
    Some(product(graph, outside))
}

/// The rational root of a rational square.
pub(super) fn exact_root(value: &Rational) -> Option<Rational> {
    let root = |whole: BigInt| Some(whole.sqrt()).filter(|root| root * root == whole);
    if value.is_negative() {
        return None;
    }
    Some(Rational::new(
        root(value.numerator())?,
        root(value.denominator())?,
    ))
}

fn root_of_multiple(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let operand = operand_of(graph, id, Function::Sqrt)?;
    let (coefficient, factors) = parts(graph, operand);
    let root = exact_root(&coefficient).filter(|root| !root.is_one())?;
    let radicand = product(graph, factors);
    let inner = if radicand == graph.one() {
        radicand
    } else {
        applied(graph, Function::Sqrt, radicand)
    };
    Some(graph.scale(inner, root))
}

fn power_of_root(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sqrt])?;
    let mut changed = Vec::new();
    for (factor, exponent) in &factors {
        match operand_of(graph, *factor, Function::Sqrt).filter(|_| exponent.abs() > 1) {
            Some(radicand) => changed.extend([(radicand, exponent / 2), (*factor, exponent % 2)]),
            None => changed.push((*factor, *exponent)),
        }
    }
    (changed.len() > factors.len()).then(|| product(graph, changed))
}

/// x·x^(−1/2) and x^(−1)·x^(1/2): the root alone.
fn root_and_power(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sqrt])?;
    let powers: BTreeMap<ExprId, i32> = factors.iter().copied().collect();
    for (root, exponent) in &factors {
        let Some(radicand) = operand_of(graph, *root, Function::Sqrt) else {
            continue;
        };
        let Some(power) = powers.get(&radicand) else {
            continue;
        };
        if power.signum() != exponent.signum() && exponent.abs() == 1 {
            let mut changed = factors.clone();
            changed.extend([(radicand, -power.signum()), (*root, 2 * power.signum())]);
            // The factors √x^(±2) and x^(∓1) cancel; they are given so that one constructor does the bookkeeping.
            return Some(product(graph, changed));
        }
    }
    None
}

/// xy/√(xy), where the factors of a radicand stand beside its root and not as one: the root alone.
fn product_and_root(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let factors = factors_with(graph, id, &[Function::Sqrt])?;
    let powers: BTreeMap<ExprId, i32> = factors.iter().copied().collect();
    for (root, exponent) in &factors {
        let Some(radicand) = operand_of(graph, *root, Function::Sqrt) else {
            continue;
        };
        let (coefficient, inner) = parts(graph, radicand);
        let covered = |(factor, power): &(ExprId, i32)| {
            let beside = powers.get(factor).copied().unwrap_or(0) * -exponent.signum();
            *power > 0 && beside >= *power
        };
        if exponent.abs() == 1 && inner.len() > 1 && inner.iter().all(covered) {
            let mut changed = factors.clone();
            let taken = inner
                .iter()
                .map(|(factor, power)| (*factor, power * exponent));
            changed.extend(taken);
            changed.push((*root, -2 * exponent));
            let product = product(graph, changed);
            // √R/R is √R over its product and its coefficient.
            return Some(graph.scale(product, coefficient.pow(*exponent)));
        }
    }
    None
}

fn even_function(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let operand = operand_of(graph, id, Function::Cos)?;
    if let Some(inner) = operand_of(graph, operand, Function::Abs) {
        return Some(applied(graph, Function::Cos, inner));
    }
    let positive = negated_if_negative(graph, operand)?;
    Some(applied(graph, Function::Cos, positive))
}

fn odd_function(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let function = [Function::Sin, Function::Tan]
        .into_iter()
        .find(|f| operand_of(graph, id, *f).is_some())?;
    let operand = operand_of(graph, id, function)?;
    let positive = negated_if_negative(graph, operand)?;
    let value = applied(graph, function, positive);
    Some(graph.negate(value))
}

/// The negative of a sum that begins with a negative term.
fn negated_if_negative(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    match graph.node(id) {
        Node::Sum(terms)
            if terms
                .first()
                .is_some_and(|(_, coefficient)| coefficient.is_negative()) =>
        {
            // Term by term: the negative of a sum as a whole would begin with a negative term again.
            let terms: Vec<_> = terms
                .iter()
                .map(|(operand, coefficient)| (*operand, -coefficient))
                .collect();
            Some(graph.sum(terms))
        }
        _ => None,
    }
}

fn sine_and_cosine(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Sum(terms) = graph.node(id).clone() else {
        return None;
    };
    let squared = |graph: &Graph, id: ExprId, function: Function| match graph.node(id) {
        Node::Product(factors) => match factors.as_slice() {
            [(factor, 2)] => operand_of(graph, *factor, function),
            _ => None,
        },
        _ => None,
    };
    for (sine, coefficient) in &terms {
        let Some(angle) = squared(graph, *sine, Function::Sin) else {
            continue;
        };
        let partner = terms.iter().find(|(term, other)| {
            other == coefficient && squared(graph, *term, Function::Cos) == Some(angle)
        });
        if let Some((cosine, _)) = partner {
            let (sine, cosine, one) = (*sine, *cosine, graph.one());
            let mut changed: Vec<_> = terms
                .iter()
                .filter(|(term, _)| *term != sine && *term != cosine)
                .cloned()
                .collect();
            changed.push((one, coefficient.clone()));
            return Some(graph.sum(changed));
        }
    }
    None
}

fn inverse_functions(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let outer = [(Function::Exp, Function::Ln), (Function::Ln, Function::Exp)];
    outer
        .into_iter()
        .find_map(|(outer, inner)| operand_of(graph, operand_of(graph, id, outer)?, inner))
}

fn one_of_equals(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    match graph.node(id) {
        Node::Apply(Function::Min | Function::Max, operands) if operands[0] == operands[1] => {
            Some(operands[0])
        }
        Node::Apply(Function::Select, operands)
            if operands[0] == operands[1] || operands[2] == operands[3] =>
        {
            Some(operands[2])
        }
        _ => None,
    }
}

fn extreme_by_sign(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Apply(function, operands) = graph.node(id) else {
        return None;
    };
    let [a, b, ..] = *operands.as_slice() else {
        return None;
    };
    let not_below =
        |x: ExprId, y: ExprId| graph.sign(x).is_not_negative() && graph.sign(y).is_not_positive();
    let larger_first = match function {
        Function::Min => false,
        Function::Max => true,
        Function::Select => {
            // Two that are never equal.
            let apart = |x, y| not_below(x, y) && !(graph.sign(x).zero && graph.sign(y).zero);
            return (apart(a, b) || apart(b, a)).then_some(operands[3]);
        }
        _ => return None,
    };
    if not_below(a, b) {
        Some(if larger_first { a } else { b })
    } else if not_below(b, a) {
        Some(if larger_first { b } else { a })
    } else {
        None
    }
}

/// Functions of a number whose value is rational, applied wherever they stand in the node's operands' place.
fn value_at_number(graph: &mut Graph, id: ExprId) -> Option<ExprId> {
    let Node::Apply(function, operands) = graph.node(id).clone() else {
        return None;
    };
    let value = graph.as_number(*operands.first()?)?.clone();
    let result = match function {
        Function::Exp if value.is_zero() => whole(1),
        Function::Cos if value.is_zero() => whole(1),
        Function::Sin | Function::Tan if value.is_zero() => whole(0),
        Function::Ln if value.is_one() => whole(0),
        Function::Sqrt if value.is_zero() => whole(0),
        Function::Sqrt => exact_root(&value)?,
        Function::Abs => value.abs(),
        Function::Sign | Function::Side if value.is_negative() => whole(-1),
        Function::Sign | Function::Side => whole(1),
        Function::Min | Function::Max => {
            let other = graph.as_number(operands[1])?.clone();
            if function == Function::Min {
                value.min(other)
            } else {
                value.max(other)
            }
        }
        _ => return None,
    };
    Some(graph.number(result))
}
