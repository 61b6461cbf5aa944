//! Why a command stops, and the exit code that says so.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use crate::interrupt;

/// How a command that ran to its end went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Exit code 0.
    Passed,
    /// It ran, and the answer is a failed check: exit code 1.
    CheckFailed,
}

/// What a failure says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Message {
    /// A sentence, to be broken into lines.
    Plain(String),
    /// A drawing that has its lines already.
    Drawn(String),
}

/// Why a command stopped before its end.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The input cannot be used. The text is complete; `rendered` says it already carries its own `error:` heading.
    #[error("{text}")]
    Input {
        /// What is wrong, and what is allowed.
        text: String,
        /// Whether the text is a drawn diagnostic with its own heading.
        rendered: bool,
    },
    /// A file or stream could not be read or written.
    #[error("cannot {action} {subject}: {source}")]
    Stream {
        /// What was tried: `read`, `write`, `create`.
        action: &'static str,
        /// The file or stream.
        subject: String,
        /// What the system said.
        source: io::Error,
    },
    /// Ctrl-C, or the system's wish that the program end.
    #[error("{0}")]
    Interrupted(String),
    /// Whoever read our output has had enough. No mistake, and nothing to say.
    #[error("the output was closed")]
    OutputClosed,
}

impl Failure {
    /// Input that cannot be used, told in one line or more.
    pub(crate) fn input(text: impl Into<String>) -> Self {
        Self::Input {
            text: text.into(),
            rendered: false,
        }
    }

    /// Input that cannot be used, told by a drawn diagnostic.
    pub(crate) fn rendered(text: String) -> Self {
        Self::Input {
            text,
            rendered: true,
        }
    }

    /// A system error on a named stream; a closed pipe is told apart.
    pub(crate) fn stream(
        action: &'static str,
        subject: impl Into<String>,
        source: io::Error,
    ) -> Self {
        if source.kind() == io::ErrorKind::BrokenPipe {
            return Self::OutputClosed;
        }
        Self::Stream {
            action,
            subject: subject.into(),
            source,
        }
    }

    /// A system error on a file.
    pub(crate) fn file(action: &'static str, path: &Path, source: io::Error) -> Self {
        Self::stream(action, format!("`{}`", path.display()), source)
    }

    /// What goes to stderr; nothing for a closed pipe.
    pub(crate) fn message(&self) -> Option<Message> {
        match self {
            Self::OutputClosed => None,
            Self::Input {
                text,
                rendered: true,
            } => Some(Message::Drawn(text.clone())),
            Self::Interrupted(text) => Some(Message::Plain(text.clone())),
            other => Some(Message::Plain(format!("error: {other}"))),
        }
    }

    /// 2; 128 and the signal's number, as shells have it, where it was interrupted; 0 where only the reader of the output went away.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::OutputClosed => ExitCode::SUCCESS,
            Self::Interrupted(_) => ExitCode::from(interrupt::exit_code()),
            Self::Input { .. } | Self::Stream { .. } => ExitCode::from(2),
        }
    }
}
