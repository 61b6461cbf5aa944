//! A part of `cargo xtask test`, and which parts run on a machine that lacks a tool.

use std::path::Path;

use crate::Outcome;
use crate::tools::Tool;

/// A part of `cargo xtask test`.
#[derive(Debug)]
pub(crate) struct Step {
    pub(crate) name: &'static str,
    /// For the help.
    pub(crate) description: &'static str,
    /// What it needs beside a Rust toolchain.
    pub(crate) needs: Option<&'static Tool>,
    pub(crate) run: fn(&Path) -> Outcome,
}

/// What is done with a step whose tool is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// The step is left out, and the end of the run says so.
    LeftOut,
    /// Nothing is run and the run fails, if the tool is one that continuous integration demands.
    FailureIfDemanded,
    /// Nothing is run, and the run fails.
    Failure,
}

impl Missing {
    /// For `cargo xtask test`: a missing tool fails the run with the option `--all`, and where the variable `CI` says that
    /// this is a machine of continuous integration.
    pub(crate) fn of(all: bool, ci: Option<&str>) -> Self {
        // Values by which a machine says that it is none.
        let is_ci = ci.is_some_and(|value| !["", "0", "false"].contains(&value));
        if all {
            Self::Failure
        } else if is_ci {
            Self::FailureIfDemanded
        } else {
            Self::LeftOut
        }
    }
}

/// Steps that run, and steps that are left out, each with the tool that it lacks.
#[derive(Debug)]
pub(crate) struct Choice<'a> {
    pub(crate) run: Vec<&'a Step>,
    pub(crate) left_out: Vec<(&'a Step, &'static Tool)>,
}

impl<'a> Choice<'a> {
    /// Decides which of the steps run, before any of them does: a run of many minutes should not end on a missing tool.
    ///
    /// # Errors
    /// The tools that are missing, where that is a failure.
    pub(crate) fn of(
        steps: impl IntoIterator<Item = &'a Step>,
        is_there: impl Fn(&Tool) -> bool,
        missing: Missing,
    ) -> Result<Self, String> {
        let (mut run, mut left_out) = (Vec::new(), Vec::new());
        for step in steps {
            match step.needs.filter(|tool| !is_there(tool)) {
                None => run.push(step),
                Some(tool) => left_out.push((step, tool)),
            }
        }
        let choice = Self { run, left_out };
        let mut tools = choice.left_out.iter().map(|(_, tool)| tool);
        let fails = |tool: &&'static Tool| match missing {
            Missing::LeftOut => false,
            Missing::FailureIfDemanded => tool.is_demanded,
            Missing::Failure => true,
        };
        if tools.any(fails) {
            return Err(format!("a tool is missing:\n{}", choice.reasons()));
        }
        Ok(choice)
    }

    /// A line for each step that is left out: what it needs, and how to have that.
    pub(crate) fn reasons(&self) -> String {
        let line = |(step, tool): &(&Step, &Tool)| {
            format!(
                "  the step `{}` needs {}: {}",
                step.name, tool.name, tool.how
            )
        };
        self.left_out
            .iter()
            .map(line)
            .collect::<Vec<_>>()
            .join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::{PYTHON, VALGRIND, WASM};

    const fn step(name: &'static str, needs: Option<&'static Tool>) -> Step {
        Step {
            name,
            description: "",
            needs,
            run: |_| Ok(()),
        }
    }

    static STEPS: [Step; 3] = [
        step("lint", None),
        step("readers", Some(&PYTHON)),
        step("instructions", Some(&VALGRIND)),
    ];

    fn only_python(tool: &Tool) -> bool {
        tool.name != VALGRIND.name
    }

    fn names(choice: &Choice) -> Vec<&'static str> {
        choice.run.iter().map(|step| step.name).collect()
    }

    #[test]
    fn a_step_without_its_tool_is_left_out_and_the_reason_is_given() {
        let choice = Choice::of(&STEPS, only_python, Missing::LeftOut).unwrap();
        assert_eq!(names(&choice), ["lint", "readers"]);
        assert_eq!(
            choice.reasons(),
            "  the step `instructions` needs valgrind: install valgrind (on Debian and Ubuntu: apt install valgrind)"
        );
    }

    #[test]
    fn what_no_registry_has_is_left_out_everywhere() {
        let steps = [step("lint", None), step("portable", Some(&WASM))];
        let without_it = |tool: &Tool| tool.name != WASM.name;
        let choice = Choice::of(&steps, without_it, Missing::FailureIfDemanded).unwrap();
        assert_eq!(names(&choice), ["lint"]);
        assert!(Choice::of(&steps, without_it, Missing::Failure).is_err());
    }

    #[test]
    fn a_machine_with_rust_alone_runs_what_needs_no_tool() {
        let choice = Choice::of(&STEPS, |_| false, Missing::LeftOut).unwrap();
        assert_eq!(names(&choice), ["lint"]);
        assert_eq!(choice.reasons().lines().count(), 2);
    }

    #[test]
    fn with_all_tools_all_steps_run_whatever_is_asked() {
        for missing in [Missing::LeftOut, Missing::Failure] {
            let choice = Choice::of(&STEPS, |_| true, missing).unwrap();
            assert_eq!(names(&choice), ["lint", "readers", "instructions"]);
            assert!(choice.left_out.is_empty());
        }
    }

    #[test]
    fn where_all_steps_are_asked_for_a_missing_tool_is_a_failure() {
        let reason = Choice::of(&STEPS, only_python, Missing::Failure)
            .err()
            .unwrap_or_default();
        assert!(reason.contains("`instructions` needs valgrind"), "{reason}");
    }

    #[test]
    fn all_steps_are_asked_for_by_the_option_or_by_continuous_integration() {
        assert_eq!(Missing::of(false, None), Missing::LeftOut);
        assert_eq!(Missing::of(true, None), Missing::Failure);
        assert_eq!(Missing::of(false, Some("true")), Missing::FailureIfDemanded);
        assert_eq!(Missing::of(false, Some("1")), Missing::FailureIfDemanded);
        for none in ["", "0", "false"] {
            assert_eq!(Missing::of(false, Some(none)), Missing::LeftOut, "{none:?}");
        }
    }
}
