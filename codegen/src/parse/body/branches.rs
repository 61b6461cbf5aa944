//! Branches: what each makes of variables is followed by itself, then one of the values is selected.

use std::collections::BTreeSet;

use syn::spanned::Spanned;

use super::scope::{Changes, Variable};
use super::{Reader, Scope};
use crate::graph::ExprId;
use crate::parse::condition::Condition;
use crate::parse::value::Value;

/// What comes of a branch: its value, and the variables that it changes.
#[derive(Default)]
pub(super) struct Branch {
    /// Its value.
    pub value: Option<Value>,
    /// What it makes of variables.
    pub changes: Changes,
}

impl Branch {
    /// Follows a branch; variables are what they were when that is done.
    pub(super) fn follow(
        scope: &mut Scope,
        work: impl FnOnce(&mut Scope) -> Option<Value>,
    ) -> Self {
        scope.begin_branch();
        let value = work(scope);
        let changes = scope.end_branch();
        Self { value, changes }
    }
}

/// A branch with the condition under which it is taken.
pub(super) type Clause = (Option<Condition>, Branch);

impl<'m> Reader<'m> {
    /// The value of the first clause whose condition holds, else the last value; variables become what that one made of them.
    pub(super) fn chosen(
        &mut self,
        clauses: Vec<Clause>,
        last: Branch,
        at: &impl Spanned,
        scope: &mut Scope,
    ) -> Option<Value> {
        let branches = clauses.iter().map(|(_, branch)| branch).chain([&last]);
        let changed: BTreeSet<Variable> = branches
            .flat_map(|branch| branch.changes.keys().copied())
            .collect();
        let mut complete = clauses.iter().all(|(condition, _)| condition.is_some());
        for variable in changed {
            let before = scope.value(variable).map(|value| value.clone());
            let of = |branch: &Branch| match branch.changes.get(&variable) {
                Some(value) => value.clone(),
                None => before.clone(),
            };
            let values = clauses
                .iter()
                .map(|(condition, branch)| (condition, of(branch)));
            let value = self.first_of(values.collect(), of(&last), at);
            complete &= value.is_some();
            if let Some(value) = &value {
                self.name(value, scope.label(variable));
            }
            *scope.assign(variable)? = value;
        }
        let values = clauses.iter();
        let values = values.map(|(condition, branch)| (condition, branch.value.clone()));
        let value = self.first_of(values.collect(), last.value, at);
        value.filter(|_| complete)
    }

    /// The first of some values whose condition holds, else the last.
    fn first_of(
        &mut self,
        values: Vec<(&Option<Condition>, Option<Value>)>,
        last: Option<Value>,
        at: &impl Spanned,
    ) -> Option<Value> {
        let values = values.into_iter().rev();
        let values: Option<Vec<_>> = values
            .map(|(condition, value)| condition.as_ref().zip(value))
            .collect();
        let (values, mut value) = (values?, last?);
        self.close(&mut value);
        for (condition, mut first) in values {
            self.close(&mut first);
            if first != value {
                value = self.select(condition, first, value, at)?;
            }
        }
        Some(value)
    }

    /// One of two values of the same shape, number by number.
    fn select(
        &mut self,
        condition: &Condition,
        first: Value,
        second: Value,
        at: &impl Spanned,
    ) -> Option<Value> {
        if let (Value::Truth(first), Value::Truth(second)) = (&first, &second) {
            let (holds, fails) = (condition.clone(), condition.clone().negated());
            let either = holds.and(first.clone()).or(fails.and(second.clone()));
            return Some(Value::Truth(either));
        }
        let (numbers, others) = (first.numbers(), second.numbers());
        let other = |place: &String| others.iter().find(|(other, _)| other == place);
        let pairs: Option<Vec<(ExprId, ExprId)>> = numbers
            .iter()
            .map(|(place, id)| Some((*id, other(place)?.1)))
            .collect();
        let pairs = pairs.filter(|pairs| {
            let are_whole = [&first, &second].map(|value| value.whole_parameter().is_none());
            pairs.len() == others.len() && !pairs.is_empty() && are_whole == [true; 2]
        });
        let Some(pairs) = pairs else {
            return self.unsupported(
                at.span(),
                "a choice between these values",
                "choose between numbers, or between tuples, arrays and struct literals of numbers",
            );
        };
        let chosen = pairs.into_iter();
        let chosen: Vec<ExprId> = chosen
            .map(|(first, second)| condition.select(&mut self.graph, first, second))
            .collect();
        Some(first.with_numbers(&mut chosen.into_iter()))
    }
}
