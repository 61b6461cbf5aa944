//! The grammar of `--sample`: inputs and their distributions.

use rotor_core::input::Variable;
use rotor_core::study::{Axis, Distribution, Sampling};

use super::vary::{number, variable};
use crate::failure::Failure;

const EXAMPLE: &str =
    "disk.asymmetry=normal(0.2,0.01), uniform(low,high) or lognormal(median,deviation)";

/// The axis of all `--sample` together.
///
/// # Errors
///
/// What is wrong, with the text that is, and what would be right.
pub(super) fn axis(texts: &[String], count: u64, sampling: Sampling) -> Result<Axis, Failure> {
    let mut inputs = Vec::new();
    for text in texts {
        inputs.push(one(text).map_err(|why| Failure::input(format!("--sample {text}: {why}")))?);
    }
    Axis::sampled(&inputs, count, sampling)
        .map_err(|error| Failure::input(format!("--sample: {error}")))
}

fn one(text: &str) -> Result<(Variable, Distribution), String> {
    let wanted = |what: &str| format!("{what}; a distribution is wanted, as {EXAMPLE}");
    let (name, distribution) = text
        .split_once('=')
        .ok_or_else(|| wanted(&format!("\"{text}\" has no `=`")))?;
    let variable = variable(name)?;
    let (kind, rest) = distribution
        .trim()
        .strip_suffix(')')
        .and_then(|text| text.split_once('('))
        .ok_or_else(|| wanted(&format!("\"{distribution}\" is no distribution")))?;
    let parameters: Vec<_> = rest.split(',').collect();
    let [first, second] = parameters[..] else {
        return Err(wanted(&format!(
            "\"{distribution}\" does not have 2 parameters"
        )));
    };
    let (first, of_unit) = (number(variable, first)?, || number(variable, second));
    let distribution = match kind.trim() {
        "normal" => Distribution::Normal {
            mean: first,
            deviation: of_unit()?,
        },
        "uniform" => Distribution::Uniform {
            low: first,
            high: of_unit()?,
        },
        "lognormal" => Distribution::LogNormal {
            median: first,
            deviation: second.trim().parse().map_err(|_| {
                format!("\"{second}\" is no number; the deviation of the logarithm has no unit")
            })?,
        },
        other => return Err(wanted(&format!("there is no distribution \"{other}\""))),
    };
    Ok((variable, distribution))
}
