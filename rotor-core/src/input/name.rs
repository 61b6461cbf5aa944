//! All names of the inputs, and what was probably meant by a name that nothing has.

use super::INPUTS;

/// At most so many inputs are offered; a word that fits more of them says nothing.
const MOST_OFFERED: usize = 3;
/// A beginning of a name has at least so many letters; fewer begin too many names.
const SHORTEST_BEGINNING: usize = 3;

/// An input under all its names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct InputName {
    /// As in a table: `disk_mass`.
    pub name: &'static str,
    /// Its section in a rotor file.
    pub section: &'static str,
    /// Its key there.
    pub key: &'static str,
    /// Its symbol, empty where it has none.
    pub symbol: &'static str,
}

/// The inputs that are a choice and no number.
pub const CHOICES: [InputName; 2] = [
    InputName {
        name: "crack_model",
        section: "crack",
        key: "model",
        symbol: "",
    },
    InputName {
        name: "crack_edge",
        section: "crack",
        key: "edge",
        symbol: "",
    },
];

/// Every input, numbers and choices.
pub fn input_names() -> impl Iterator<Item = InputName> {
    let numbers = INPUTS.iter().map(|input| InputName {
        name: input.name,
        section: input.section,
        key: input.key,
        symbol: input.symbol,
    });
    numbers.chain(CHOICES)
}

/// The inputs that a name probably means, of one section only if given: by symbol, by key, by whole words of a name, by
/// spelling, by the beginning. The first of these that fits some input decides.
pub fn meant(found: &str, section: Option<&str>) -> Vec<InputName> {
    let inputs: Vec<InputName> = input_names()
        .filter(|input| section.is_none_or(|section| input.section == section))
        .collect();
    let flat = found.trim().to_lowercase().replace(['.', ' ', '-'], "_");
    if flat.is_empty() {
        return Vec::new();
    }
    let bare = |symbol: &str| symbol.replace('_', "");
    let spelt = inputs
        .iter()
        .flat_map(|input| [(input, input.name), (input, input.key)])
        .filter_map(|(input, name)| Some((distance(&flat, name)?, input)))
        .min_by_key(|(distance, _)| *distance);
    let stages: [&dyn Fn(&InputName) -> bool; 5] = [
        &|input| !input.symbol.is_empty() && bare(input.symbol) == bare(found.trim()),
        &|input| [input.name, input.key].contains(&flat.as_str()),
        &|input| {
            [input.name, input.key]
                .into_iter()
                .any(|name| shares_words(&flat, name))
        },
        &|input| spelt.is_some_and(|(_, nearest)| nearest == input),
        &|input| flat.len() >= SHORTEST_BEGINNING && input.key.starts_with(&flat),
    ];
    stages
        .iter()
        .map(|fits| {
            inputs
                .iter()
                .copied()
                .filter(|input| fits(input))
                .collect::<Vec<_>>()
        })
        .find(|fitting| (1..=MOST_OFFERED).contains(&fitting.len()))
        .unwrap_or_default()
}

/// Whether one of two names begins or ends with the other, at a `_`.
fn shares_words(found: &str, name: &str) -> bool {
    let (short, long) = if found.len() < name.len() {
        (found, name)
    } else {
        (name, found)
    };
    let rest = long.strip_prefix(short).map(|rest| rest.starts_with('_'));
    let start = long.strip_suffix(short).map(|start| start.ends_with('_'));
    rest == Some(true) || start == Some(true)
}

/// How many letters differ, where at most a third does; capitals do not count.
fn distance(found: &str, name: &str) -> Option<usize> {
    let distance = strsim::damerau_levenshtein(&found.to_lowercase(), &name.to_lowercase());
    (3 * distance <= name.chars().count().max(3)).then_some(distance)
}

/// The name nearest to a misspelt one, if one is near.
pub fn nearest<'a>(misspelt: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    names
        .filter_map(|name| Some((distance(misspelt, name)?, name)))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_found_by_every_name_that_they_have() {
        let cases = [
            ("crack_depth", None, vec!["crack_depth_ratio"]),
            ("depth_ratio", None, vec!["crack_depth_ratio"]),
            ("Crack.Angle", None, vec!["crack_angle"]),
            ("model", None, vec!["crack_model"]),
            ("E", None, vec!["shaft_youngs_modulus"]),
            ("m_d", None, vec!["disk_mass"]),
            ("md", None, vec!["disk_mass"]),
            (
                "position_ratio",
                None,
                vec!["disk_position_ratio", "crack_position_ratio"],
            ),
            ("disk_mas", None, vec!["disk_mass"]),
            ("depth", Some("crack"), vec!["crack_depth_ratio"]),
            ("len", Some("shaft"), vec!["shaft_length"]),
            ("radius_mm", Some("shaft"), vec!["shaft_radius"]),
            ("name", None, vec![]),
            ("note", None, vec![]),
            ("disk", None, vec![]),
            ("sir_width", None, vec![]),
            ("", None, vec![]),
        ];
        for (found, section, expected) in cases {
            let names: Vec<_> = meant(found, section)
                .iter()
                .map(|input| input.name)
                .collect();
            assert_eq!(names, expected, "{found}");
        }
    }

    #[test]
    fn capitals_are_no_mistake() {
        assert_eq!(
            nearest("SIR_WIDTH", ["sir_width", "cir_width"].into_iter()),
            Some("sir_width")
        );
    }
}
