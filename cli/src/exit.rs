//! How a command ends, and what is said when it cannot do its work.

use crate::file_errors::FileErrors;
use cotama_models::missions::{MissionErrors, Refusal};
use cotama_verification::pnml::PnmlErrors;
use std::process::ExitCode;

/// How a command ends. The codes are the same for every command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// The property holds, or there is a plan, or the mission is completed: 0.
    Success = 0,
    /// The property does not hold, there is no plan, or the mission is not completed: 1.
    Violated = 1,
    /// The input cannot be used, or an output cannot be written: 2.
    BadInput = 2,
    /// A limit was reached before the answer was known: 3.
    Unknown = 3,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Why a command cannot do its work; it ends with [`Exit::BadInput`].
#[derive(Debug)]
pub(crate) enum Failure {
    /// One thing is wrong.
    Message {
        /// In which file.
        file: Option<String>,
        /// Cause of the failure.
        message: String,
        /// Remedy.
        help: Option<String>,
    },
    /// A file has errors at places.
    Text(Box<FileErrors>),
}

impl Failure {
    /// One thing is wrong.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        let (message, help) = told(message.into());
        Self::Message { file: None, message, help }
    }

    /// One thing is wrong with a file.
    pub(crate) fn of(file: impl Into<String>, message: impl Into<String>) -> Self {
        let (message, help) = told(message.into());
        Self::Message { file: Some(file.into()), message, help }
    }

    /// The same with what to do about it.
    pub(crate) fn help(self, words: impl Into<String>) -> Self {
        match self {
            Self::Message { file, message, .. } => {
                Self::Message { file, message, help: Some(words.into()) }
            }
            Self::Text(errors) => Self::Text(errors),
        }
    }
}

/// Splits a library's error into its message and the help that stands in a line below it.
fn told(message: String) -> (String, Option<String>) {
    match message.trim_end().rsplit_once("\n  help: ") {
        Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
        None => (message, None),
    }
}

/// A floor refuses a name, or a way over it.
impl From<Refusal> for Failure {
    fn from(Refusal { message, help }: Refusal) -> Self {
        Self::Message { file: None, message, help }
    }
}

/// A command line that cannot be understood: what is wrong, and the hints and the usage below it.
impl From<&clap::Error> for Failure {
    fn from(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        let (message, help) = text.split_once("\n\n").unwrap_or((&text, ""));
        let failure = Self::new(one_line(message.trim_start_matches("error: ")));
        let hints = help.split("\n\n").map(one_line).filter(|it| !it.is_empty());
        let hints: Vec<_> = hints.map(|it| it.trim_start_matches("tip: ").to_owned()).collect();
        if hints.is_empty() { failure } else { failure.help(hints.join("; ")) }
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl From<FileErrors> for Failure {
    fn from(errors: FileErrors) -> Self {
        Self::Text(Box::new(errors))
    }
}

impl From<MissionErrors> for Failure {
    fn from(errors: MissionErrors) -> Self {
        FileErrors::from(errors).into()
    }
}

impl From<PnmlErrors> for Failure {
    fn from(errors: PnmlErrors) -> Self {
        FileErrors::from(errors).into()
    }
}
