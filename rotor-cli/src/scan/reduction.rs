//! The grammar of `--reduce`.

use rotor_core::study::{Reduction, Statistic};

use super::vary::variable;
use crate::failure::Failure;

const KINDS: &str = "max, min, argmax, argmin, mean, count(0.05) or histogram(0,1,20), over one axis as \
                     max:crack.angle, over several as max:crack.angle+disk.mass, or over all";

/// The reductions of one `--reduce`.
///
/// # Errors
///
/// What is wrong, with the text that is, and what would be right.
pub(super) fn reductions(text: &str) -> Result<Vec<Reduction>, Failure> {
    let parts = outside_of_brackets(text).into_iter().map(one);
    parts
        .collect::<Result<_, _>>()
        .map_err(|why: String| Failure::input(format!("--reduce {text}: {why}")))
}

/// The parts between commas that are not in brackets.
fn outside_of_brackets(text: &str) -> Vec<&str> {
    let mut depth = 0_u32;
    text.split(|letter| {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        letter == ',' && depth == 0
    })
    .collect()
}

fn one(text: &str) -> Result<Reduction, String> {
    let text = text.trim();
    let (statistic, over) = match text.split_once(')') {
        Some((before, after)) => (
            with_parameters(text, before)?,
            after
                .strip_prefix(':')
                .or_else(|| after.is_empty().then_some("")),
        ),
        None => match text.split_once(':') {
            Some((name, over)) => (named(name)?, Some(over).filter(|over| !over.is_empty())),
            None => (named(text)?, Some("")),
        },
    };
    let over = over.ok_or_else(|| format!("\"{text}\" is no reduction; wanted is {KINDS}"))?;
    let mut reduction = Reduction::new(statistic);
    for name in over.split('+').filter(|_| !over.is_empty()) {
        reduction = reduction.over(variable(name)?);
    }
    Ok(reduction)
}

fn named(name: &str) -> Result<Statistic, String> {
    match name.trim() {
        "max" => Ok(Statistic::Maximum),
        "min" => Ok(Statistic::Minimum),
        "argmax" => Ok(Statistic::ArgMaximum),
        "argmin" => Ok(Statistic::ArgMinimum),
        "mean" => Ok(Statistic::Mean),
        "count" => Err("count wants a threshold, as count(0.05)".to_owned()),
        "histogram" => Err("histogram wants its ends and bins, as histogram(0,1,20)".to_owned()),
        other => Err(format!(
            "there is no reduction \"{other}\"; wanted is {KINDS}"
        )),
    }
}

/// A statistic with parameters, of which `before` has all but the closing bracket.
fn with_parameters(text: &str, before: &str) -> Result<Statistic, String> {
    let (name, parameters) = before
        .split_once('(')
        .ok_or_else(|| format!("\"{text}\" closes a bracket that it does not open"))?;
    let parameters: Vec<&str> = parameters.split(',').map(str::trim).collect();
    let number = |text: &str| {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| format!("\"{text}\" is no finite number"))
    };
    match (name.trim(), &parameters[..]) {
        ("count", [threshold]) => Ok(Statistic::CountAbove(number(threshold)?)),
        ("histogram", [low, high, bins]) => Ok(Statistic::Histogram {
            low: number(low)?,
            high: number(high)?,
            bins: bins
                .parse()
                .map_err(|_| format!("\"{bins}\" is no number of bins"))?,
        }),
        _ => Err(format!("\"{text}\" is no reduction; wanted is {KINDS}")),
    }
}
