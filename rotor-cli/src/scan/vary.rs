//! The grammar of `--vary`: inputs, or the speed, and their values.

use std::path::Path;

use rotor_core::error::Error;
use rotor_core::input::Variable;
use rotor_core::input::name::nearest;
use rotor_core::input::{INPUTS, RotorParameters};
use rotor_core::study::Axis;
use rotor_core::unit::TIMES_REFERENCE_SPEED;

use crate::failure::Failure;

/// An axis from the text of one `--vary`.
///
/// # Errors
///
/// What is wrong, with the text that is, and what would be right.
pub(super) fn axis(text: &str) -> Result<Axis, Failure> {
    let complain = |why: String| Failure::input(format!("--vary {text}: {why}"));
    let axes = linked(text)
        .and_then(|inputs| {
            let axes = inputs
                .iter()
                .map(|(variable, values)| one(*variable, values));
            axes.collect::<Result<Vec<_>, _>>()
        })
        .map_err(complain)?;
    Axis::linked(axes).map_err(|error| complain(error.to_string()))
}

/// The inputs and their values: a comma before `name=` begins another input, any other comma
/// belongs to a list.
fn linked(text: &str) -> Result<Vec<(Variable, String)>, String> {
    let mut inputs: Vec<(Variable, String)> = Vec::new();
    for part in text.split(',') {
        match (part.split_once('='), inputs.last_mut()) {
            (Some((name, values)), _) => inputs.push((variable(name)?, values.trim().to_owned())),
            (None, Some((_, values))) => {
                values.push(',');
                values.push_str(part);
            }
            (None, None) => {
                return Err(format!(
                    "\"{part}\" has no `=`; an input or the speed and its values are wanted, as crack.angle=0deg:180deg:91"
                ));
            }
        }
    }
    Ok(inputs)
}

/// What is called so.
pub(super) fn variable(name: &str) -> Result<Variable, String> {
    let name = name.trim();
    Variable::find(name).ok_or_else(|| {
        let flat = name.replace(['.', ' ', '-'], "_");
        let inputs = INPUTS.iter().map(|input| input.name);
        let names = inputs.chain([Variable::Speed.name()]);
        // What is only the beginning of a name is no misspelling of it.
        let begun = names
            .clone()
            .find(|known| !flat.is_empty() && known.starts_with(&flat));
        match nearest(&flat, names).or(begun).and_then(Variable::find) {
            Some(near) => format!(
                "there is no input \"{name}\"; did you mean {}?",
                near.dotted_name()
            ),
            None => {
                let names: Vec<_> = super::variable_names();
                format!(
                    "there is no input \"{name}\"; the inputs are {}",
                    names.join(", ")
                )
            }
        }
    })
}

/// The axis of one variable.
fn one(variable: Variable, values: &str) -> Result<Axis, String> {
    let words = |error: Error| format!("\"{values}\": {error}");
    if let Some((path, column)) = file_and_column(values) {
        return from_file(variable, path, column);
    }
    if !values.contains(':') {
        let listed = values.split(',').map(|value| number(variable, value));
        return Axis::listed(variable, listed.collect::<Result<_, _>>()?).map_err(words);
    }
    let example = format!("as {}={}", variable.dotted_name(), example(variable));
    let parts: Vec<_> = values.split(':').map(str::trim).collect();
    let (start, stop, count, logarithmic) = match parts[..] {
        [start, stop, count] => (start, stop, count, false),
        [start, stop, count, "log"] => (start, stop, count, true),
        [_, _, _, other] => {
            return Err(format!(
                "\"{values}\" ends with \"{other}\"; after the count only `log` can stand"
            ));
        }
        _ => {
            return Err(format!(
                "\"{values}\" is no range; start:stop:count or start:stop:count:log is wanted, {example}"
            ));
        }
    };
    let ends = (number(variable, start)?, number(variable, stop)?);
    let count = super::point_count(count)
        .map_err(|why| format!("\"{values}\": the count {why}, {example}"))?;
    if logarithmic {
        Axis::logarithmic(variable, ends, count).map_err(words)
    } else {
        Axis::linear(variable, ends, count).map_err(words)
    }
}

/// Values that are allowed, as an example of a range.
fn example(variable: Variable) -> String {
    let input = match variable {
        Variable::Input(input) => input,
        Variable::Speed => return "0.5:2:301".to_owned(),
    };
    match input.unit {
        "rad" => "0deg:180deg:91".to_owned(),
        "" => "0.1:0.4:31".to_owned(),
        _ => {
            let usual = (input.get)(&RotorParameters::PAPER);
            format!("{usual:?}:{:?}:11", 2.0 * usual)
        }
    }
}

/// A number with `deg`, `rad` or `%`.
pub(super) fn number(variable: Variable, text: &str) -> Result<f64, String> {
    let text = text.trim();
    let (digits, factor) = if let Some(digits) = text.strip_suffix("deg").or(text.strip_suffix('°'))
    {
        (digits, Some(std::f64::consts::PI / 180.0))
    } else if let Some(digits) = text.strip_suffix("rad") {
        (digits, Some(1.0))
    } else if let Some(digits) = text.strip_suffix('%') {
        (digits, None)
    } else {
        return plain(variable, text, text);
    };
    let value = plain(variable, digits.trim_end(), text)?;
    match (factor, variable.unit()) {
        (Some(factor), "rad") => Ok(value * factor),
        (None, "" | TIMES_REFERENCE_SPEED) => Ok(value / 100.0),
        (Some(_), unit) => Err(format!(
            "\"{text}\" is an angle, but {} is in {}",
            variable.name(),
            named(unit)
        )),
        (None, unit) => Err(format!(
            "\"{text}\" is a ratio, but {} is in {unit}",
            variable.name()
        )),
    }
}

fn named(unit: &str) -> &str {
    if unit.is_empty() { "no unit" } else { unit }
}

fn plain(variable: Variable, digits: &str, text: &str) -> Result<f64, String> {
    let wanted = match variable.allowed().to_string().as_str() {
        "finite" => "a finite number".to_owned(),
        allowed => format!("a number {allowed}"),
    };
    if text.is_empty() {
        return Err(format!(
            "a value of {} is empty; {wanted} is wanted",
            variable.name()
        ));
    }
    // `nan` and `inf` would be read as floats.
    let has_letters = digits
        .chars()
        .any(|letter| letter.is_alphabetic() && !matches!(letter, 'e' | 'E'));
    match digits.parse::<f64>() {
        Ok(value) if !has_letters && value.is_finite() => Ok(value),
        _ => Err(format!(
            "\"{text}\" is no finite number; for {} {wanted} is wanted",
            variable.name()
        )),
    }
}

/// `table.csv:column` or `table.csv`.
fn file_and_column(values: &str) -> Option<(&str, Option<&str>)> {
    let end = values.to_ascii_lowercase().rfind(".csv")? + ".csv".len();
    match values.get(end..)? {
        "" => Some((values, None)),
        rest => Some((values.get(..end)?, Some(rest.strip_prefix(':')?))),
    }
}

/// An axis from a column of a CSV file, by default the one that is called like the variable.
fn from_file(variable: Variable, path: &str, column: Option<&str>) -> Result<Axis, String> {
    let cannot = |why: String| format!("cannot read `{path}`: {why}");
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(Path::new(path))
        .map_err(|error| cannot(of_system(error)))?;
    let headings = reader
        .headers()
        .map_err(|error| cannot(of_system(error)))?
        .clone();
    let found = headings.iter().position(|heading| {
        let heading = heading.trim_start_matches('\u{feff}');
        column.map_or_else(
            || Variable::find(heading) == Some(variable),
            |column| heading == column,
        )
    });
    let place = found.ok_or_else(|| {
        let headings: Vec<_> = headings.iter().collect();
        let column = column.unwrap_or(variable.name());
        format!(
            "`{path}` has no column \"{column}\"; it has {}",
            headings.join(", ")
        )
    })?;
    let mut values = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| cannot(of_system(error)))?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell = record.get(place).unwrap_or_default();
        let value = number(variable, cell).map_err(|why| format!("`{path}` line {line}: {why}"))?;
        values.push(value);
    }
    Axis::listed(variable, values).map_err(|error| format!("`{path}`: {error}"))
}

/// The system's words for an error of the CSV reader, without its own preface.
fn of_system(error: csv::Error) -> String {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error.to_string(),
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => {
            let line = pos.map_or(0, |position| position.line());
            format!("line {line} has {len} fields, the header has {expected_len}")
        }
        csv::ErrorKind::Utf8 { pos, .. } => {
            let line = pos.map_or(0, |position| position.line());
            format!("line {line} is not UTF-8")
        }
        other => format!("{other:?}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn no_text_is_too_strange_to_be_answered(text in "[a-z_.:=,0-9%+()eE° -]{0,40}") {
            // A file of that name would be a column; there is none.
            let _ = axis(&text);
            let _ = super::super::reduction::reductions(&text);
            let _ = axis(&format!("crack.angle={text}"));
            let _ = super::super::reduction::reductions(&format!("max:{text}"));
        }

        #[test]
        fn a_list_is_read_back_exactly(values in proptest::collection::vec(-1e9..1e9_f64, 1..9)) {
            let text: Vec<_> = values.iter().map(|value| format!("{value:?}")).collect();
            let axis = axis(&format!("crack.angle={}", text.join(","))).unwrap();
            let found: Vec<_> = (0..axis.len()).map(|index| axis.value(0, index)).collect();
            prop_assert_eq!(found, values);
        }

        #[test]
        fn a_range_has_its_ends_its_count_and_its_order(
            start in -1e3..1e3_f64, stop in -1e3..1e3_f64, count in 2..5000_u64
        ) {
            let axis = axis(&format!("crack.angle={start:?}:{stop:?}:{count}")).unwrap();
            prop_assert_eq!((axis.len(), axis.value(0, 0), axis.value(0, count - 1)), (count, start, stop));
            let values: Vec<_> = (0..count).map(|index| axis.value(0, index)).collect();
            let ordered = |pair: &[f64]| (pair[0] <= pair[1]) == (start <= stop) || pair[0] == pair[1];
            prop_assert!(values.windows(2).all(ordered));
        }

        #[test]
        fn degrees_and_ratios_are_the_numbers_that_they_mean(value in -720.0..720.0_f64) {
            let angle = axis(&format!("crack.angle={value:?}deg")).unwrap();
            prop_assert!((angle.value(0, 0) - value.to_radians()).abs() <= 1e-12);
            let share = value.abs() / 7.2;
            let depth = axis(&format!("crack.depth_ratio={share:?}%")).unwrap();
            prop_assert_eq!(depth.value(0, 0), share / 100.0);
        }
    }
}
