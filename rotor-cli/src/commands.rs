//! From the command line to the command, and from its outcome to the exit code.

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Parser;

use crate::command_line::{Command, CommandLine, FormArguments, ReportArguments, ShowArguments};
use crate::failure::{Failure, Message, Outcome};
use crate::show::Form;
use crate::{evaluate, init, interrupt, output, report, scan, show, zup};

/// Runs the command that the command line asks for.
pub(crate) fn run() -> ExitCode {
    let outcome = match CommandLine::try_parse() {
        Ok(line) => dispatch(line.command),
        // A wrong command line tells its mistake on stderr; help and version are results like others.
        Err(told) if told.use_stderr() => {
            let _ = told.print();
            return ExitCode::from(2);
        }
        Err(told) => told
            .print()
            .and_then(|()| io::stdout().flush())
            .map(|()| Outcome::Passed)
            .map_err(|source| Failure::stream("write", "standard output", source)),
    };
    match outcome {
        Ok(Outcome::Passed) => ExitCode::SUCCESS,
        Ok(Outcome::CheckFailed) => ExitCode::from(1),
        Err(failure) => {
            match failure.message() {
                Some(Message::Plain(text)) => output::remark(&text),
                Some(Message::Drawn(text)) => output::drawing(&text),
                None => {}
            }
            failure.exit_code()
        }
    }
}

fn dispatch(command: Option<Command>) -> Result<Outcome, Failure> {
    // Only these write files beside their places.
    if let None | Some(Command::Report(_) | Command::Evaluate(_) | Command::Init(_)) = command {
        interrupt::watch();
    }
    match command {
        None => report::run(&ReportArguments::on_the_papers_rotor()),
        Some(Command::Report(arguments)) => report::run(&arguments),
        Some(Command::Evaluate(arguments)) => evaluate::run(&arguments),
        Some(Command::Scan(arguments)) => scan::run(&arguments),
        Some(Command::Zup(arguments)) => zup::run(&arguments),
        Some(Command::Init(arguments)) => init::run(&arguments),
        Some(Command::Show(arguments)) => show_equation(&arguments),
    }
}

fn show_equation(arguments: &ShowArguments) -> Result<Outcome, Failure> {
    let shown = show::run(arguments.name.as_deref(), Form::from(&arguments.form))?;
    output::print(&shown)?;
    Ok(Outcome::Passed)
}

impl From<&FormArguments> for Form {
    fn from(arguments: &FormArguments) -> Self {
        match arguments {
            FormArguments { latex: true, .. } => Self::Latex,
            FormArguments { graph: true, .. } => Self::Graph,
            FormArguments { .. } => Self::Rust,
        }
    }
}
