//! Reading a recording.

use crate::source::said;
use cotama_core::units::Millis;
use serde::Deserialize;
use std::fmt;

/// What the header says.
pub const SCHEMA: &str = "cotama-recording/1";
/// The latest time, and the longest period: 2^53 - 1, the largest number that every reader of JSON
/// keeps.
pub const MAX_MS: u64 = (1 << 53) - 1;
/// The most lines that are read.
pub const MAX_LINES: usize = 4_000_000;

/// A recorded run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recording {
    /// When the model started.
    pub start: Millis,
    /// How often a round takes place.
    pub round_every: Option<Millis>,
    /// The nets whose firings are not recorded.
    pub silent: Vec<String>,
    /// What was recorded, in order.
    pub lines: Vec<Line>,
}

/// A line of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Its number in the file, from 1.
    pub number: usize,
    /// The column of the name in it, in characters from 1.
    pub column: usize,
    /// When.
    pub at: Millis,
    /// What happened.
    pub what: What,
}

/// What a line says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum What {
    /// The model was told this.
    Event {
        /// The event.
        name: String,
        /// Whether no transition used it, where that is said.
        ignored: Option<bool>,
    },
    /// This transition fired.
    Fired(String),
    /// A round took place.
    Round,
    /// Nothing else happened.
    End,
}

/// What is wrong with the text of a recording, and where.
///
/// ```
/// use cotama_verification::conform::Recording;
/// let text = r#"{"schema":"cotama-recording/1","start_ms":0}
/// {"t_ms":-1,"event":"Call"}"#;
/// let error = Recording::read("log.jsonl", text).unwrap_err();
/// assert_eq!((error.source_name.as_str(), error.line), ("log.jsonl", 2));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordingError {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl fmt::Display for RecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source_name, line, column, message, help } = self;
        said(f, source_name, (*line, *column), message, help.as_deref())
    }
}

impl std::error::Error for RecordingError {}

/// A line as it is written.
#[derive(Deserialize)]
struct Written {
    t_ms: Option<u64>,
    event: Option<String>,
    ignored: Option<bool>,
    fired: Option<String>,
    round: Option<bool>,
    end: Option<bool>,
    schema: Option<String>,
    start_ms: Option<u64>,
    round_every_ms: Option<u64>,
    silent: Option<Vec<String>>,
}

/// Where in the line, what is wrong, and what to do about it.
type Wrong = (usize, String, Option<&'static str>);

const KINDS: &str = "a line is {\"t_ms\":T,\"event\":NAME}, {\"t_ms\":T,\"fired\":NAME}, \
    {\"t_ms\":T,\"round\":true} or {\"t_ms\":T,\"end\":true}";

impl Recording {
    /// Reads a recording; `source_name` is the name of the file in messages.
    ///
    /// # Errors
    /// The first error of the text: a line that is none, a time that goes back, nothing at all.
    ///
    /// ```
    /// use cotama_verification::conform::Recording;
    /// let text = "{\"t_ms\":5,\"round\":true}\n{\"t_ms\":4,\"end\":true}";
    /// let error = Recording::read("log", text).unwrap_err().to_string();
    /// assert!(error.starts_with("log:2:1: the time goes back from 5 ms to 4 ms"), "{error}");
    /// ```
    pub fn read(source_name: &str, text: &str) -> Result<Self, RecordingError> {
        let mut recording = Self::default();
        let refused = |line: usize, (column, message, help): Wrong| RecordingError {
            source_name: source_name.to_owned(),
            line,
            column,
            message,
            help: help.map(str::to_owned),
        };
        let mut first = true;
        for (number, line) in (1..).zip(text.lines()) {
            if line.trim().is_empty() {
                continue;
            }
            recording.line(number, line, first).map_err(|wrong| refused(number, wrong))?;
            first = false;
        }
        if recording.lines.is_empty() {
            let message = "nothing is recorded here".to_owned();
            return Err(refused(text.lines().count().max(1), (1, message, Some(KINDS))));
        }
        Ok(recording)
    }

    fn line(&mut self, number: usize, line: &str, first: bool) -> Result<(), Wrong> {
        let written: Written = serde_json::from_str(line).map_err(|error| {
            let said = error.to_string();
            let message = said.rsplit_once(" at line ").map_or(said.as_str(), |it| it.0);
            let column =
                line.char_indices().take_while(|(at, _)| *at + 1 < error.column()).count() + 1;
            (column, message.to_owned(), Some(KINDS))
        })?;
        let times = [written.t_ms, written.start_ms, written.round_every_ms];
        if times.iter().any(|it| it.is_some_and(|it| it > MAX_MS)) {
            return Err((1, format!("a time is at most {MAX_MS} ms"), None));
        }
        if let Some(schema) = &written.schema {
            return self.header(line, first, schema, &written);
        }
        if self.lines.len() == MAX_LINES {
            return Err((1, format!("more than {MAX_LINES} lines are recorded"), None));
        }
        let said = [
            written.event.is_some(),
            written.fired.is_some(),
            written.round == Some(true),
            written.end == Some(true),
        ];
        if said.iter().filter(|&&it| it).count() != 1 {
            let message = "this line says nothing that can be told again, or several things";
            return Err((1, message.to_owned(), Some(KINDS)));
        }
        let Some(at) = written.t_ms.map(Millis) else {
            return Err((
                1,
                "this line does not say when: `t_ms` is missing".to_owned(),
                Some(KINDS),
            ));
        };
        let before = self.lines.last().map_or(self.start, |it| it.at);
        if at < before {
            let message = format!("the time goes back from {} ms to {} ms", before.0, at.0);
            return Err((1, message, Some("put the lines into the order in which they happened")));
        }
        if matches!(self.lines.last(), Some(Line { what: What::End, .. })) {
            return Err((1, "a line after the end of the recording".to_owned(), None));
        }
        let mut column = 1;
        let what = match (written.event, written.fired) {
            (Some(name), _) => {
                column = column_of(line, &name);
                What::Event { name, ignored: written.ignored }
            }
            (None, Some(name)) => {
                column = column_of(line, &name);
                What::Fired(name)
            }
            (None, None) if written.end == Some(true) => What::End,
            (None, None) => What::Round,
        };
        self.lines.push(Line { number, column, at, what });
        Ok(())
    }

    fn header(
        &mut self,
        line: &str,
        first: bool,
        schema: &str,
        written: &Written,
    ) -> Result<(), Wrong> {
        let column = column_of(line, schema);
        if schema != SCHEMA {
            let message = format!("the schema is {schema:?}, only {SCHEMA:?} is read");
            return Err((column, message, None));
        }
        if !first {
            return Err((1, "a header can only be the first line".to_owned(), None));
        }
        if written.round_every_ms == Some(0) {
            let message = "rounds every 0 ms would never end: `round_every_ms` is at least 1";
            return Err((1, message.to_owned(), None));
        }
        self.start = Millis(written.start_ms.unwrap_or(0));
        self.round_every = written.round_every_ms.map(Millis);
        self.silent = written.silent.clone().unwrap_or_default();
        Ok(())
    }
}

/// The column of a name in the line that says it.
fn column_of(line: &str, name: &str) -> usize {
    let written = serde_json::to_string(name).unwrap_or_default();
    let at = line.rfind(&written).unwrap_or(0);
    line[..at].chars().count() + 1
}
