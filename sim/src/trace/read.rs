//! Writing a trace as JSON lines, and reading it back.

use crate::canonical::{self, Differing, Read};
use cotama_formats::json::Wrong;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt;

/// A whole trace: of a mission, or with its own header and records of
/// [a team](crate::fleet::trace).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceOf<H, R> {
    /// The settings of the run: enough to run it again.
    pub header: H,
    /// The events, in the order of time; the last one is the end.
    pub records: Vec<R>,
    /// The first thing of a file that no record of ours has, with the number of its record, from
    /// 0 for the header; none in a trace that was recorded.
    pub foreign: Option<(usize, Differing)>,
}

/// The first line of a trace.
pub trait Head: Serialize + DeserializeOwned {
    /// The schema that it names.
    const SCHEMA: &'static str;

    /// Returns the schema that was found.
    fn schema(&self) -> &str;

    /// The same by another version of the program.
    #[must_use]
    fn by_version_of(self, other: &Self) -> Self;
}

/// A line after the first one.
pub trait Line: Serialize + DeserializeOwned + PartialEq {
    /// The time since the start, in the unit of the trace.
    fn time(&self) -> u64;

    /// Whether it is the last one.
    fn is_end(&self) -> bool;
}

/// The largest trace that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Size of the whole text, in bytes.
    pub bytes: usize,
    /// Size of one line, in bytes.
    pub line_bytes: usize,
    /// Number of records after the header.
    pub records: usize,
}

impl Default for Limits {
    /// 256 MiB, 16 MiB a line, 4 million records.
    fn default() -> Self {
        Self { bytes: 256 << 20, line_bytes: 16 << 20, records: 4_000_000 }
    }
}

/// An error in the text of a trace, with its position.
///
/// ```
/// use cotama_sim::trace::Trace;
/// let error = Trace::parse("t.jsonl", "{\"schema\":\"cotama-trace/1\"}\n").unwrap_err();
/// assert_eq!(error.to_string(), "t.jsonl:1:27: `version` is missing");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceError {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in bytes.
    pub column: usize,
    /// The cause of the error.
    pub message: String,
}

impl fmt::Display for TraceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.source_name, self.line, self.column, self.message)
    }
}

impl std::error::Error for TraceError {}

/// A line of JSON. Writing these types to memory cannot fail.
fn line<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

impl<H: Head, R: Line> TraceOf<H, R> {
    /// The trace as JSON lines, the header first, with a line break after every line.
    pub fn to_json_lines(&self) -> String {
        let mut text = line(&self.header) + "\n";
        for record in &self.records {
            text += &line(record);
            text.push('\n');
        }
        text
    }

    /// Writes the trace as [`Self::to_json_lines`] gives it, line by line; the caller buffers.
    ///
    /// # Errors
    /// What the writer answers.
    pub fn write_to(&self, mut writer: impl std::io::Write) -> std::io::Result<()> {
        writeln!(writer, "{}", line(&self.header))?;
        self.records.iter().try_for_each(|record| writeln!(writer, "{}", line(record)))
    }

    /// Reads a trace within [`Limits::default`]. `source_name` is its name in messages.
    ///
    /// # Errors
    /// The first error of the text: no header, another schema, a line that is not a record, time
    /// that runs backwards, a missing or a second end, or more than the limits.
    pub fn parse(source_name: &str, text: &str) -> Result<Self, TraceError> {
        Self::parse_within(source_name, text, Limits::default())
    }

    /// Reads a trace within the given limits, as [`Self::parse`].
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn parse_within(source_name: &str, text: &str, limits: Limits) -> Result<Self, TraceError> {
        let error = |line: usize, column: usize, message: String| TraceError {
            source_name: source_name.into(),
            line,
            column: column.max(1),
            message,
        };
        if text.len() > limits.bytes {
            let message =
                format!("the trace has {} bytes, at most {} are read", text.len(), limits.bytes);
            return Err(error(1, 1, message));
        }
        let mut foreign = None;
        let mut header: Option<H> = None;
        let mut records: Vec<R> = Vec::new();
        let mut last = 0;
        let end = text.trim_end().len();
        for (number, written) in (1..).zip(text[..end].lines()) {
            last = number;
            if written.len() > limits.line_bytes {
                let message = format!(
                    "the line has {} bytes, at most {} are read",
                    written.len(),
                    limits.line_bytes
                );
                return Err(error(number, limits.line_bytes, message));
            }
            if written.trim().is_empty() {
                return Err(error(number, 1, "an empty line among the records".into()));
            }
            let bad = |bad: Wrong| error(number, bad.column, bad.message);
            if header.is_none() {
                let Read { record: found, foreign: more, .. } =
                    canonical::read::<H>(written).map_err(bad)?;
                if found.schema() != H::SCHEMA {
                    let message =
                        format!("the schema is {:?}, only {:?} is read", found.schema(), H::SCHEMA);
                    return Err(error(number, 1, message));
                }
                foreign = more.map(|it| (0, it));
                header = Some(found);
                continue;
            }
            if records.len() == limits.records {
                return Err(error(number, 1, format!("more than {} records", limits.records)));
            }
            let Read { record, foreign: more, .. } = canonical::read::<R>(written).map_err(bad)?;
            let before = records.last();
            if before.is_some_and(Line::is_end) {
                return Err(error(number, 1, "a record after the end of the mission".into()));
            }
            if before.is_some_and(|before| before.time() > record.time()) {
                return Err(error(
                    number,
                    1,
                    "the time of this record is before that of the last".into(),
                ));
            }
            records.push(record);
            foreign = foreign.or(more.map(|it| (records.len(), it)));
        }
        let Some(header) = header else { return Err(error(1, 1, "the trace is empty".into())) };
        if !records.last().is_some_and(Line::is_end) {
            return Err(error(last + 1, 1, "the trace stops before the end of the mission".into()));
        }
        Ok(Self { header, records, foreign })
    }
}
