//! The axes of a scan: what varies, and through which values.

use crate::input::Variable;

use super::sample::{Distribution, Sampling};
use crate::error::{Error, StudyError};

/// One axis: one variable that runs through values, or several that run together.
///
/// The values are known by their index. Those of a range or a sample are computed from it, so that
/// an axis of $10^9$ values takes no memory and any part of it can be made alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    columns: Vec<Column>,
    length: u64,
}

/// What one variable does along an axis.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    variable: Variable,
    values: Values,
}

/// Values by their index.
#[derive(Clone, Debug, PartialEq)]
enum Values {
    Listed(Vec<f64>),
    Linear {
        start: f64,
        stop: f64,
    },
    Logarithmic {
        start: f64,
        stop: f64,
    },
    Sampled {
        distribution: Distribution,
        sampling: Sampling,
        /// Which coordinate of the sampled point this input is.
        dimension: u32,
    },
}

impl Axis {
    /// Values that are listed, in any order, as often as they are.
    ///
    /// # Errors
    /// Where there is none, or the variable does not allow one.
    pub fn listed(variable: impl Into<Variable>, values: Vec<f64>) -> Result<Self, Error> {
        let variable = variable.into();
        for (index, &value) in (0..).zip(&values) {
            require_allowed(variable, index, value)?;
        }
        let length = values.len() as u64;
        Self::new(variable, Values::Listed(values), length)
    }

    /// `count` evenly spaced values from `start` to `stop`, both included; downwards where `stop` is
    /// below.
    ///
    /// # Errors
    /// Where `count` is 0, or 1 with two different ends; where the variable does not allow an end.
    pub fn linear(
        variable: impl Into<Variable>,
        (start, stop): (f64, f64),
        count: u64,
    ) -> Result<Self, Error> {
        let variable = variable.into();
        require_ends(variable, (start, stop), count)?;
        Self::new(variable, Values::Linear { start, stop }, count)
    }

    /// `count` values from `start` to `stop`, both included, with a constant ratio between
    /// neighbours.
    ///
    /// # Errors
    /// As [`Axis::linear`], and where an end is not above zero.
    pub fn logarithmic(
        variable: impl Into<Variable>,
        (start, stop): (f64, f64),
        count: u64,
    ) -> Result<Self, Error> {
        let variable = variable.into();
        require_ends(variable, (start, stop), count)?;
        if !(start > 0.0 && stop > 0.0) {
            let input = variable.name();
            return Err(StudyError::NoLogarithm { input, start, stop }.into());
        }
        Self::new(variable, Values::Logarithmic { start, stop }, count)
    }

    /// `count` points drawn at random: each variable from its own distribution, independently.
    ///
    /// A value may be drawn that its variable does not allow, as a negative mass from a wide normal
    /// distribution. That point is no rotor and has no quantities; it is counted as such. At a speed that is not allowed
    /// there is no growth rate, and what the rotor has at any speed is as it is.
    ///
    /// # Errors
    /// Where nothing is drawn, a variable is drawn twice, or a distribution's parameters are none.
    pub fn sampled(
        variables: &[(impl Into<Variable> + Copy, Distribution)],
        count: u64,
        sampling: Sampling,
    ) -> Result<Self, Error> {
        let columns = (0..)
            .zip(variables)
            .map(|(dimension, &(variable, distribution))| {
                let variable = variable.into();
                distribution.check(variable.name())?;
                let values = Values::Sampled {
                    distribution,
                    sampling,
                    dimension,
                };
                Self::new(variable, values, count)
            });
        Self::linked(columns.collect::<Result<_, _>>()?)
    }

    /// Several axes of the same length that run together, as one.
    ///
    /// # Errors
    /// Where there is none, their lengths differ, or two vary the same variable.
    pub fn linked(axes: Vec<Self>) -> Result<Self, Error> {
        let mut linked: Option<Self> = None;
        for axis in axes {
            let Some(linked) = &mut linked else {
                linked = Some(axis);
                continue;
            };
            if linked.length != axis.length {
                return Err(StudyError::LinkedLengths {
                    first: linked.name(),
                    first_length: linked.length,
                    other: axis.name(),
                    other_length: axis.length,
                }
                .into());
            }
            if let Some(twice) = axis.variables().find(|variable| linked.varies(*variable)) {
                let input = twice.name();
                return Err(StudyError::VariedTwice { input }.into());
            }
            linked.columns.extend(axis.columns);
        }
        linked.ok_or_else(|| StudyError::NoAxis.into())
    }

    fn new(variable: Variable, values: Values, length: u64) -> Result<Self, Error> {
        if length == 0 {
            let input = variable.name();
            return Err(StudyError::EmptyAxis { input }.into());
        }
        Ok(Self {
            columns: vec![Column { variable, values }],
            length,
        })
    }

    /// How many values it has, at least one.
    #[expect(clippy::len_without_is_empty, reason = "an axis is never empty")]
    pub const fn len(&self) -> u64 {
        self.length
    }

    /// What varies along it.
    pub fn variables(&self) -> impl ExactSizeIterator<Item = Variable> {
        self.columns.iter().map(|column| column.variable)
    }

    /// All that its values depend on, in one line: two axes with the same description have the same
    /// values.
    pub fn describe(&self) -> String {
        let values = self
            .columns
            .iter()
            .map(|column| format!("{:?}", column.values));
        format!("{} {}", self.length, values.collect::<Vec<_>>().join(" "))
    }

    /// The name of its first variable, which errors call it by.
    pub(super) fn name(&self) -> &'static str {
        self.columns
            .first()
            .map_or("", |column| column.variable.name())
    }

    /// Whether this varies along it.
    pub fn varies(&self, variable: impl Into<Variable>) -> bool {
        let variable = variable.into();
        self.variables().any(|other| other == variable)
    }

    /// Whether its values are drawn, and so may be outside what their variable allows.
    pub fn is_sampled(&self) -> bool {
        self.columns
            .iter()
            .any(|column| matches!(column.values, Values::Sampled { .. }))
    }

    /// The value of its variable number `column` at an index below [`Axis::len`].
    pub fn value(&self, column: usize, index: u64) -> f64 {
        let mut value = [f64::NAN];
        self.fill(column, index, &mut value);
        value[0]
    }

    /// The values of its variable number `column` from the index `first` on. What lies beyond the end
    /// of the axis is left as it is.
    pub fn fill(&self, column: usize, first: u64, values: &mut [f64]) {
        let Some(column) = self.columns.get(column) else {
            return;
        };
        let last = self.length - 1;
        match &column.values {
            Values::Listed(listed) => {
                let from =
                    usize::try_from(first).map_or(listed.len(), |first| first.min(listed.len()));
                for (value, &listed) in values.iter_mut().zip(&listed[from..]) {
                    *value = listed;
                }
            }
            &Values::Linear { start, stop } => {
                for (index, value) in (first..=last).zip(values) {
                    *value = between(start, stop, index, last);
                }
            }
            &Values::Logarithmic { start, stop } => {
                let (low, high) = (start.min(stop), start.max(stop));
                for (index, value) in (first..=last).zip(values) {
                    *value = match index {
                        0 => start,
                        _ if index == last => stop,
                        _ => between(start.ln(), stop.ln(), index, last)
                            .exp()
                            .clamp(low, high),
                    };
                }
            }
            Values::Sampled {
                distribution,
                sampling,
                dimension,
            } => {
                for (index, value) in (first..=last).zip(values) {
                    *value = distribution.at(sampling.uniform(index, *dimension));
                }
            }
        }
    }
}

/// The value at `index` of 0 to `last` on the way from `start` to `stop`. Never outside of the two,
/// and exact at both.
fn between(start: f64, stop: f64, index: u64, last: u64) -> f64 {
    if last == 0 {
        return start;
    }
    let share = index as f64 / last as f64;
    // The difference of the ends could overflow; the weighted sum cannot.
    let value = start * (1.0 - share) + stop * share;
    value.clamp(start.min(stop), start.max(stop))
}

fn require_ends(variable: Variable, (start, stop): (f64, f64), count: u64) -> Result<(), Error> {
    require_allowed(variable, 0, start)?;
    require_allowed(variable, count.saturating_sub(1), stop)?;
    if count == 1 && start != stop {
        let input = variable.name();
        return Err(StudyError::OneValueForTwoEnds { input, start, stop }.into());
    }
    Ok(())
}

fn require_allowed(variable: Variable, index: u64, value: f64) -> Result<(), Error> {
    if variable.allowed().contains(value) {
        Ok(())
    } else {
        Err(StudyError::NotAllowed {
            variable,
            index,
            value,
        }
        .into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn input(name: &str) -> Variable {
        Variable::find(name).unwrap()
    }

    fn all(axis: &Axis) -> Vec<f64> {
        let mut values = vec![f64::NAN; usize::try_from(axis.len()).unwrap()];
        axis.fill(0, 0, &mut values);
        values
    }

    #[test]
    fn ranges_have_both_ends_exactly_and_run_either_way() {
        let up = Axis::linear(input("crack.depth_ratio"), (0.0, 0.4), 401).unwrap();
        assert_eq!((up.value(0, 0), up.value(0, 400)), (0.0, 0.4));
        assert_eq!(up.value(0, 100), 0.1);
        let down = Axis::linear(input("crack.depth_ratio"), (0.4, 0.0), 3).unwrap();
        assert_eq!(all(&down), [0.4, 0.2, 0.0]);
        let decades = Axis::logarithmic(input("disk.mass"), (0.1, 1000.0), 5).unwrap();
        let expected = [0.1, 1.0, 10.0, 100.0, 1000.0];
        for (value, expected) in all(&decades).into_iter().zip(expected) {
            assert!((value / expected - 1.0).abs() < 1e-14, "{value}");
        }
        let all_positive = Axis::linear(input("disk.mass"), (1e-300, f64::MAX), 7).unwrap();
        assert!(all(&all_positive).iter().all(|value| value.is_finite()));
    }

    #[test]
    fn no_value_leaves_the_ends_by_rounding() {
        // 0.5 is the greatest ratio there is: a greater one is no rotor's.
        let ratio = input("shaft_poissons_ratio");
        for start in [0.5, 0.3, 0.1_f64] {
            for (count, stop) in
                (2..300).flat_map(|count| [(count, start), (count, start.next_down())])
            {
                let linear = Axis::linear(ratio, (start, stop), count).unwrap();
                let logarithmic = Axis::logarithmic(ratio, (start, stop), count).unwrap();
                for value in [linear, logarithmic].iter().flat_map(all) {
                    assert!((stop..=start).contains(&value), "{value} of {count}");
                }
            }
        }
    }

    #[test]
    fn any_part_of_an_axis_is_the_same_as_that_part_of_the_whole() {
        let normal = Distribution::Normal {
            mean: 0.2,
            deviation: 0.01,
        };
        for axis in [
            Axis::linear(input("crack.angle"), (0.0, 1.0), 101).unwrap(),
            Axis::logarithmic(input("disk.mass"), (3.0, 0.1), 101).unwrap(),
            Axis::listed(input("crack.angle"), (0..101).map(f64::from).collect()).unwrap(),
            Axis::sampled(
                &[(input("disk.asymmetry"), normal)],
                101,
                Sampling::Random { seed: 7 },
            )
            .unwrap(),
        ] {
            let whole = all(&axis);
            let mut part = [0.0; 40];
            axis.fill(0, 30, &mut part);
            assert_eq!(part, whole[30..70]);
            let mut end = [-1.0; 40];
            axis.fill(0, 100, &mut end);
            assert_eq!((end[0], end[1]), (whole[100], -1.0));
        }
    }

    #[test]
    fn what_is_no_axis_says_why() {
        let depth = input("crack.depth_ratio");
        let text = |result: Result<Axis, Error>| result.unwrap_err().to_string();
        assert_eq!(
            text(Axis::linear(depth, (0.0, 1.5), 4)),
            "value 4 of the axis of crack_depth_ratio is 1.5; it must be >= 0 and <= 1"
        );
        assert!(text(Axis::listed(depth, vec![0.1, f64::NAN])).starts_with("value 2 of the axis"));
        assert!(text(Axis::listed(depth, vec![])).contains("has no value"));
        assert!(text(Axis::linear(depth, (0.0, 0.4), 0)).contains("has no value"));
        assert!(text(Axis::linear(depth, (0.0, 0.4), 1)).contains("cannot be both"));
        assert_eq!(all(&Axis::linear(depth, (0.4, 0.4), 1).unwrap()), [0.4]);
        assert!(text(Axis::logarithmic(depth, (0.0, 0.4), 5)).contains("must be > 0"));
        let (one, two) = (
            Axis::listed(depth, vec![0.1]),
            Axis::listed(input("crack.angle"), vec![0.0, 1.0]),
        );
        let linked = Axis::linked(vec![one.clone().unwrap(), two.unwrap()]);
        assert!(text(linked).contains("has 1 values and crack_angle has 2"));
        assert!(
            text(Axis::linked(vec![one.clone().unwrap(), one.unwrap()])).contains("varied twice")
        );
    }
}
