//! The answer in place of another one when a command cannot do its work.

use crate::exit::Failure;
use crate::file_errors::FileError;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// Why a command cannot do its work, with `--json`. The exit code is 2.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ErrorAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/error/1")))]
    pub(crate) schema: &'static str,
    /// Cause of the error.
    pub(crate) message: String,
    /// The file in which it is wrong, or that is wrong as a whole.
    pub(crate) file: Option<String>,
    /// From 1; null if the file is wrong as a whole.
    pub(crate) line: Option<u64>,
    /// In characters, from 1.
    pub(crate) column: Option<u64>,
    /// Remedy.
    pub(crate) help: Option<String>,
    /// How often the file has an error of this cause, if more than once; the place is that of the
    /// first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) times: Option<u64>,
    /// Further errors in the file, by place.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) more: Vec<ErrorRow>,
    /// How many further errors are left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) omitted: Option<u64>,
}

/// A further error of the same file.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ErrorRow {
    /// Cause of the error.
    pub(crate) message: String,
    /// From 1.
    pub(crate) line: u64,
    /// In characters, from 1.
    pub(crate) column: u64,
    /// Remedy.
    pub(crate) help: Option<String>,
    /// How often the file has an error of this cause, if more than once; the place is that of the
    /// first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) times: Option<u64>,
}

impl From<&FileError> for ErrorRow {
    fn from(error: &FileError) -> Self {
        let (line, column) = (error.at.line as u64, error.at.column as u64);
        let times = Some(error.times as u64).filter(|&it| it > 1);
        Self { message: error.message.clone(), line, column, help: error.help.clone(), times }
    }
}

impl From<&Failure> for ErrorAnswer {
    fn from(failure: &Failure) -> Self {
        let nothing = Self {
            schema: "cotama/error/1",
            message: String::new(),
            file: None,
            line: None,
            column: None,
            help: None,
            times: None,
            more: Vec::new(),
            omitted: None,
        };
        match failure {
            Failure::Message { file, message, help } => {
                Self { message: message.clone(), file: file.clone(), help: help.clone(), ..nothing }
            }
            Failure::Text(errors) => {
                let file = Some(errors.source.clone());
                let mut rows = errors.errors.iter().map(ErrorRow::from);
                let Some(ErrorRow { message, line, column, help, times }) = rows.next() else {
                    return Self { file, ..nothing };
                };
                let (line, column) = (Some(line), Some(column));
                let omitted = Some(errors.omitted as u64).filter(|&it| it > 0);
                let more = rows.collect();
                Self { message, file, line, column, help, times, more, omitted, ..nothing }
            }
        }
    }
}
