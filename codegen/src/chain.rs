//! The chain of a module and of those that it links: which formulas give what other formulas take, from what nobody gives, the inputs, to every result.
//!
//! A formula takes part where its `#[generate(…)]` says `chain`; the module whose attribute says `symbolic(chain)` has the
//! chain. A struct that it takes comes from the formulas that give one;
//! where there are several they are alternatives, among which whoever runs the chain chooses. What no formula gives is an input.
//! Each number is a *column*; two formulas that give a result of one name give the same column.

use std::collections::BTreeMap;

use proc_macro2::Span;

use crate::diagnostics::Diagnostics;

/// A formula that takes part, as its module has it.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Where it stands, for messages.
    pub span: Span,
    /// What its column form takes, in order.
    pub takes: Vec<Taken>,
    /// The struct that it gives; none for a number or a tuple.
    pub structure: Option<String>,
    /// What it gives, in order.
    pub gives: Vec<Given>,
    /// Whether it has a column form.
    pub rows: bool,
    /// Its staged forms.
    pub staged: Vec<StagedMember>,
}

/// A number that a formula takes.
#[derive(Clone, Debug)]
pub struct Taken {
    /// The struct that it is a field of, by its last name.
    pub structure: Option<String>,
    /// The name of the field or of the parameter.
    pub name: String,
}

/// A number that a formula gives.
#[derive(Clone, Debug)]
pub struct Given {
    /// Its name.
    pub name: String,
    /// The place among the numbers taken, of one that is passed on as it is.
    pub passes: Option<usize>,
    /// The places of the numbers taken that it depends on.
    pub needs: Vec<usize>,
}

/// A staged form of a formula.
#[derive(Clone, Debug)]
pub struct StagedMember {
    /// The name of its module.
    pub module: String,
    /// The places, among the numbers taken, of those that run along the points.
    pub along: Vec<usize>,
}

/// Which column a number is: the struct that has it, if any, and its name.
type Key = (Option<String>, String);

/// A column of the chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name: that of a field, with its struct before it where two structs have one.
    pub name: String,
    /// The inputs that it depends on, bit 0 for the first column.
    pub inputs: u64,
}

/// A formula in its place.
#[derive(Clone, Debug)]
pub struct Link {
    /// The formula.
    pub member: Member,
    /// The columns that it takes.
    pub takes: Vec<usize>,
    /// The columns that it gives; one that it passes on is the one that it takes.
    pub gives: Vec<usize>,
    /// The inputs that what it computes depends on.
    pub inputs: u64,
}

impl Link {
    /// The columns that run along the points in a staged form.
    pub fn along(&self, form: &StagedMember) -> Vec<usize> {
        form.along.iter().map(|place| self.takes[*place]).collect()
    }

    /// Those that stand still in it.
    pub fn still(&self, form: &StagedMember) -> Vec<usize> {
        let places = (0..self.takes.len()).filter(|place| !form.along.contains(place));
        places.map(|place| self.takes[place]).collect()
    }

    /// Whether it computes a column, and does not only pass it on.
    pub fn gives_itself(&self, column: usize) -> bool {
        let mut results = self.gives.iter().zip(&self.member.gives);
        results.any(|(given, result)| *given == column && result.passes.is_none())
    }

    /// Its results but for those that are passed on, bit 0 for the first.
    pub fn wanted(&self) -> u64 {
        let results = self.member.gives.iter().enumerate();
        let own = results.filter(|(_, given)| given.passes.is_none());
        own.fold(0, |wanted, (place, _)| wanted | 1 << place)
    }
}

/// The chain of a module.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Inputs first, then what formulas give, each after what it depends on.
    pub columns: Vec<Column>,
    /// How many are inputs.
    pub inputs: usize,
    /// The formulas that give a struct, in an order in which they can be computed.
    pub stages: Vec<Link>,
    /// The formulas that give results.
    pub formulas: Vec<Link>,
}

/// The most inputs: there is a bit for each.
const MOST_INPUTS: usize = 64;

impl Chain {
    /// The chain of these formulas. `None` if there is none, which is reported.
    pub fn of(members: &[Member], diagnostics: &mut Diagnostics) -> Option<Self> {
        let mut building = Building::of(members);
        let inputs = building.columns.len();
        if inputs > MOST_INPUTS {
            let message = format!("the chain has {inputs} inputs, more than {MOST_INPUTS}");
            diagnostics.error_with_hint(members.first()?.span, message, "leave formulas out of it");
            return None;
        }
        let (mut stages, mut formulas) = (Vec::new(), Vec::new());
        let mut waiting: Vec<&Member> = members.iter().collect();
        while let Some(first) = waiting.first() {
            let Some(together) = building.ready(&waiting) else {
                let message = format!("`{}` takes what is made of what it gives", first.name);
                let hint = "leave one of the formulas on the way out of the chain";
                diagnostics.error_with_hint(first.span, message, hint);
                return None;
            };
            let is_ready = |member: &Member| together.contains(&member.name);
            let (ready, others): (Vec<_>, Vec<_>) =
                waiting.into_iter().partition(|member| is_ready(member));
            waiting = others;
            for member in ready {
                let link = building.link(member);
                let links = if member.structure.is_some() {
                    &mut stages
                } else {
                    &mut formulas
                };
                links.push(link);
            }
        }
        Some(Self {
            columns: building.named(),
            inputs,
            stages,
            formulas,
        })
    }
}

/// Columns as they are found.
struct Building {
    /// The structs that formulas give.
    given: Vec<String>,
    places: BTreeMap<Key, usize>,
    /// Each with the inputs that it depends on.
    columns: Vec<(Key, u64)>,
}

impl Building {
    /// The inputs: what no formula gives. Those of two structs that have one name are one.
    fn of(members: &[Member]) -> Self {
        let given = members.iter().filter_map(|member| member.structure.clone());
        let mut building = Self {
            given: given.collect(),
            places: BTreeMap::new(),
            columns: Vec::new(),
        };
        for taken in members.iter().flat_map(|member| &member.takes) {
            let key = building.key(taken);
            if key.0.is_none() {
                let place = building.add(key);
                // The places of more than there may be are reported.
                building.columns[place].1 = 1_u64.checked_shl(place as u32).unwrap_or_default();
            }
        }
        building
    }

    fn key(&self, taken: &Taken) -> Key {
        let structure = taken.structure.clone();
        let structure = structure.filter(|name| self.given.contains(name));
        (structure, taken.name.clone())
    }

    fn add(&mut self, key: Key) -> usize {
        let next = self.columns.len();
        let place = *self.places.entry(key.clone()).or_insert(next);
        if place == next {
            self.columns.push((key, 0));
        }
        place
    }

    /// The names of formulas that can be placed next: one, or all that give the same struct, so that what takes it depends on
    /// the inputs of each.
    fn ready(&self, waiting: &[&Member]) -> Option<Vec<String>> {
        let has_all = |member: &Member| {
            let mut keys = member.takes.iter().map(|taken| self.key(taken));
            keys.all(|key| self.places.contains_key(&key))
        };
        let together = |member: &Member| -> Vec<&Member> {
            let same = waiting.iter().copied().filter(|other| {
                let is_same_struct =
                    other.structure.is_some() && other.structure == member.structure;
                other.name == member.name || is_same_struct
            });
            same.collect()
        };
        let mut sets = waiting.iter().map(|member| together(member));
        let ready = sets.find(|set| set.iter().all(|member| has_all(member)))?;
        Some(
            ready
                .into_iter()
                .map(|member| member.name.clone())
                .collect(),
        )
    }

    fn link(&mut self, member: &Member) -> Link {
        let keys = member.takes.iter().map(|taken| self.key(taken));
        let takes: Vec<usize> = keys
            .filter_map(|key| self.places.get(&key).copied())
            .collect();
        // A number that is only passed on decides nothing.
        let own = member.gives.iter().filter(|given| given.passes.is_none());
        let needs = own.flat_map(|given| &given.needs);
        let needs = needs.filter_map(|place| takes.get(*place));
        let inputs = needs.fold(0, |inputs, place| inputs | self.columns[*place].1);
        let mut gives = Vec::new();
        for result in &member.gives {
            let key = (member.structure.clone(), result.name.clone());
            let passed = result.passes.and_then(|place| takes.get(place)).copied();
            let place = if let Some(passed) = passed {
                self.places.insert(key, passed);
                passed
            } else {
                let place = self.add(key);
                self.columns[place].1 |= inputs;
                place
            };
            gives.push(place);
        }
        Link {
            member: member.clone(),
            takes,
            gives,
            inputs,
        }
    }

    /// The columns with a name each.
    fn named(&self) -> Vec<Column> {
        let names: Vec<&str> = self
            .columns
            .iter()
            .map(|((_, name), _)| name.as_str())
            .collect();
        let columns = self.columns.iter().map(|((structure, name), inputs)| {
            let is_alone = names.iter().filter(|other| *other == name).count() == 1;
            let name = match structure {
                Some(structure) if !is_alone => format!("{structure}_{name}"),
                _ => name.clone(),
            };
            Column {
                name,
                inputs: *inputs,
            }
        });
        columns.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(of: &str) -> Taken {
        match of.split_once('.') {
            Some((structure, name)) => Taken {
                structure: Some(structure.to_owned()),
                name: name.to_owned(),
            },
            None => Taken {
                structure: None,
                name: of.to_owned(),
            },
        }
    }

    /// A formula that computes each of its results from all that it takes; one with an equals sign passes on what it takes there.
    fn member(name: &str, takes: &[&str], structure: Option<&str>, gives: &[&str]) -> Member {
        let given = |result: &&str| {
            let (name, passes) = match result.split_once('=') {
                Some((name, place)) => (name, place.parse().ok()),
                None => (*result, None),
            };
            Given {
                name: name.to_owned(),
                passes,
                needs: passes
                    .map_or_else(|| (0..takes.len()).collect(), |place: usize| vec![place]),
            }
        };
        Member {
            takes: takes.iter().map(|of| taken(of)).collect(),
            structure: structure.map(ToOwned::to_owned),
            gives: gives.iter().map(given).collect(),
            name: name.to_owned(),
            span: Span::call_site(),
            rows: true,
            staged: Vec::new(),
        }
    }

    fn chain(members: &[Member]) -> Result<Chain, String> {
        let mut diagnostics = Diagnostics::default();
        Chain::of(members, &mut diagnostics).ok_or_else(|| diagnostics.to_tokens().to_string())
    }

    fn inputs(chain: &Chain, name: &str) -> u64 {
        let column = chain.columns.iter().find(|column| column.name == name);
        column.expect("a column of that name").inputs
    }

    #[test]
    fn formulas_are_placed_after_what_they_take_from_and_know_their_inputs() {
        let found = chain(&[
            member("width", &["Beam.stiffness", "load"], None, &["width"]),
            member(
                "beam",
                &["p.length"],
                Some("Beam"),
                &["stiffness", "length=0"],
            ),
            member(
                "frequency",
                &["Beam.length", "Beam.stiffness"],
                None,
                &["frequency"],
            ),
        ])
        .unwrap();
        let names: Vec<&str> = found
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .collect();
        assert_eq!(names, ["load", "length", "stiffness", "width", "frequency"]);
        assert_eq!(found.inputs, 2);
        assert_eq!(found.stages[0].member.name, "beam");
        // What is passed on is the input itself, and no result of its own.
        assert_eq!(found.stages[0].gives, [2, 1]);
        assert_eq!(found.stages[0].wanted(), 0b01);
        assert_eq!(inputs(&found, "stiffness"), 0b10);
        assert_eq!(inputs(&found, "width"), 0b11);
        assert_eq!(inputs(&found, "frequency"), 0b10);
    }

    #[test]
    fn formulas_of_one_struct_are_alternatives_and_depend_on_the_inputs_of_all() {
        let found = chain(&[
            member("left", &["p.a"], Some("Loads"), &["moment"]),
            member("deflection", &["Loads.moment"], None, &["deflection"]),
            member("right", &["p.b"], Some("Loads"), &["moment"]),
        ])
        .unwrap();
        assert_eq!(found.stages.len(), 2);
        assert_eq!(inputs(&found, "deflection"), 0b11);
    }

    #[test]
    fn a_formula_that_takes_what_is_made_of_its_own_result_is_refused() {
        let refused = chain(&[
            member("first", &["B.y"], Some("A"), &["x"]),
            member("second", &["A.x"], Some("B"), &["y"]),
        ]);
        let message = refused.unwrap_err();
        assert!(
            message.contains("takes what is made of what it gives"),
            "{message}"
        );
    }

    #[test]
    fn a_name_of_two_structs_is_told_by_its_struct() {
        let found = chain(&[
            member("one", &["p.a"], Some("One"), &["x"]),
            member("two", &["One.x"], Some("Two"), &["x"]),
        ])
        .unwrap();
        let names: Vec<&str> = found
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .collect();
        assert_eq!(names, ["a", "One_x", "Two_x"]);
    }

    #[test]
    fn more_inputs_than_bits_are_refused() {
        let names: Vec<String> = (0..65).map(|place| format!("p.x_{place}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let message = chain(&[member("sum", &names, None, &["sum"])]).unwrap_err();
        assert!(
            message.contains("the chain has 65 inputs, more than 64"),
            "{message}"
        );
    }
}
