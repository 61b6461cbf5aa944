//! The names of a body and what they stand for while it is followed: blocks hide names, assignments change values, and what
//! a branch changes is kept apart until it is known whether the branch is taken.

use std::collections::BTreeMap;

use crate::parse::value::Value;

/// The place of a variable among those of its scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Variable(usize);

/// Values of variables, of which those that could not be read, which is reported, have none.
pub(super) type Changes = BTreeMap<Variable, Option<Value>>;

/// Names in scope and the variables that they stand for.
#[derive(Debug, Default)]
pub(super) struct Scope {
    names: BTreeMap<String, Variable>,
    values: Vec<Option<Value>>,
    /// The name under which each variable was made.
    labels: Vec<String>,
    /// What names stood for before a `let` hid it, in the order of the `let`s.
    hidden: Vec<(String, Option<Variable>)>,
    /// For each branch that is being followed how many variables there were before it, and what they were.
    branches: Vec<(usize, Changes)>,
}

/// Where a block began.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    hidden: usize,
    values: usize,
}

impl Scope {
    /// The variable of a name.
    pub(super) fn find(&self, name: &str) -> Option<Variable> {
        self.names.get(name).copied()
    }

    /// All names, for hints.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().map(String::as_str)
    }

    /// The name of a variable.
    pub(super) fn label(&self, variable: Variable) -> &str {
        self.labels.get(variable.0).map_or("", String::as_str)
    }

    /// Makes a variable, which hides another one of its name.
    pub(super) fn bind(&mut self, name: String, value: Option<Value>) {
        let variable = Variable(self.values.len());
        self.values.push(value);
        self.labels.push(name.clone());
        let before = self.names.insert(name.clone(), variable);
        self.hidden.push((name, before));
    }

    /// Begins a block.
    pub(super) fn enter(&self) -> Mark {
        Mark {
            hidden: self.hidden.len(),
            values: self.values.len(),
        }
    }

    /// Ends a block: its names stand again for what they stood for before it.
    pub(super) fn leave(&mut self, mark: Mark) {
        for (name, before) in self.hidden.drain(mark.hidden..).rev() {
            match before {
                Some(variable) => self.names.insert(name, variable),
                None => self.names.remove(&name),
            };
        }
        self.values.truncate(mark.values);
        self.labels.truncate(mark.values);
    }

    /// A variable's value, to be read or written in another way; it has to stay the same number.
    pub(super) fn value(&mut self, variable: Variable) -> Option<&mut Value> {
        self.values.get_mut(variable.0)?.as_mut()
    }

    /// A variable's value, to be changed.
    pub(super) fn assign(&mut self, variable: Variable) -> Option<&mut Option<Value>> {
        let value = self.values.get_mut(variable.0)?;
        if let Some((known, changes)) = self.branches.last_mut()
            && variable.0 < *known
        {
            changes.entry(variable).or_insert_with(|| value.clone());
        }
        Some(value)
    }

    /// Begins a branch.
    pub(super) fn begin_branch(&mut self) {
        self.branches.push((self.values.len(), Changes::new()));
    }

    /// Ends a branch: all variables from before it are again what they were. Answers what the branch made of those that it
    /// changed.
    pub(super) fn end_branch(&mut self) -> Changes {
        let (_, mut changes) = self.branches.pop().unwrap_or_default();
        for (variable, value) in &mut changes {
            if let Some(current) = self.values.get_mut(variable.0) {
                std::mem::swap(current, value);
            }
        }
        changes
    }
}

impl<N: IntoIterator<Item = (String, Option<Value>)>> From<N> for Scope {
    fn from(names: N) -> Self {
        let mut scope = Self::default();
        scope.extend(names);
        scope
    }
}

impl Extend<(String, Option<Value>)> for Scope {
    fn extend<N: IntoIterator<Item = (String, Option<Value>)>>(&mut self, names: N) {
        for (name, value) in names {
            self.bind(name, value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(scope: &mut Scope, name: &str) -> Option<i64> {
        let variable = scope.find(name)?;
        match scope.value(variable)? {
            Value::Whole(value) => Some(*value),
            _ => None,
        }
    }

    fn set(scope: &mut Scope, name: &str, value: i64) {
        let variable = scope.find(name).unwrap();
        *scope.assign(variable).unwrap() = Some(Value::Whole(value));
    }

    #[test]
    fn a_block_hides_names_and_changes_variables() {
        let mut scope = Scope::default();
        scope.bind("x".to_owned(), Some(Value::Whole(1)));
        scope.bind("y".to_owned(), Some(Value::Whole(2)));
        let mark = scope.enter();
        scope.bind("x".to_owned(), Some(Value::Whole(3)));
        scope.bind("z".to_owned(), Some(Value::Whole(4)));
        set(&mut scope, "x", 5);
        set(&mut scope, "y", 6);
        assert_eq!(whole(&mut scope, "x"), Some(5));
        scope.leave(mark);
        assert_eq!(whole(&mut scope, "x"), Some(1));
        assert_eq!(whole(&mut scope, "y"), Some(6));
        assert!(scope.find("z").is_none());
    }

    #[test]
    fn branches_within_branches_leave_all_as_it_was() {
        let mut scope = Scope::default();
        scope.bind("x".to_owned(), Some(Value::Whole(1)));
        let x = scope.find("x").unwrap();
        scope.begin_branch();
        set(&mut scope, "x", 2);
        scope.begin_branch();
        set(&mut scope, "x", 3);
        let inner = scope.end_branch();
        assert_eq!(whole(&mut scope, "x"), Some(2));
        let outer = scope.end_branch();
        assert_eq!(whole(&mut scope, "x"), Some(1));
        let changed = |changes: &Changes| changes.get(&x).cloned();
        assert_eq!(changed(&inner), Some(Some(Value::Whole(3))));
        assert_eq!(changed(&outer), Some(Some(Value::Whole(2))));
    }
}
