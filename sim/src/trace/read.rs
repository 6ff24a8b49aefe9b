//! Writing a trace as JSON lines, and reading it back.

use super::{Header, Record, SCHEMA, Trace};
use std::fmt;

/// The largest trace that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Of the whole text, in bytes.
    pub bytes: usize,
    /// Of one line, in bytes.
    pub line_bytes: usize,
    /// Of records after the header.
    pub records: usize,
}

impl Default for Limits {
    /// 256 MiB, 16 MiB a line, 4 million records.
    fn default() -> Self {
        Self { bytes: 256 << 20, line_bytes: 16 << 20, records: 4_000_000 }
    }
}

/// What is wrong with the text of a trace, and where.
///
/// ```
/// use cotama_sim::trace::Trace;
/// let error = Trace::parse("t.jsonl", "{\"schema\":\"cotama-trace/0\"}\n").unwrap_err();
/// assert_eq!((error.source_name.as_str(), error.line), ("t.jsonl", 1));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceError {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in bytes.
    pub column: usize,
    /// What is wrong.
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

impl Trace {
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
        let mut canonical = text.ends_with('\n') && !text.contains('\r');
        let mut header: Option<Header> = None;
        let mut records: Vec<Record> = Vec::new();
        let mut last = 0;
        for (number, written) in (1..).zip(text.lines()) {
            last = number;
            if written.len() > limits.line_bytes {
                let message = format!(
                    "the line has {} bytes, at most {} are read",
                    written.len(),
                    limits.line_bytes
                );
                return Err(error(number, limits.line_bytes, message));
            }
            let bad = |bad: serde_json::Error| {
                let said = bad.to_string();
                let message =
                    said.rsplit_once(" at line ").map_or(said.as_str(), |(message, _)| message);
                error(number, bad.column(), message.into())
            };
            if header.is_none() {
                let found: Header = serde_json::from_str(written).map_err(bad)?;
                if found.schema != SCHEMA {
                    let message =
                        format!("the schema is {:?}, only {SCHEMA:?} is read", found.schema);
                    return Err(error(number, 1, message));
                }
                canonical &= line(&found) == written;
                header = Some(found);
                continue;
            }
            if records.len() == limits.records {
                return Err(error(number, 1, format!("more than {} records", limits.records)));
            }
            let record: Record = serde_json::from_str(written).map_err(bad)?;
            let before = records.last();
            if matches!(before, Some(Record::End(_))) {
                return Err(error(number, 1, "a record after the end of the mission".into()));
            }
            if before.is_some_and(|before| before.t_us() > record.t_us()) {
                return Err(error(
                    number,
                    1,
                    "the time of this record is before that of the last".into(),
                ));
            }
            canonical &= line(&record) == written;
            records.push(record);
        }
        let Some(header) = header else { return Err(error(1, 1, "the trace is empty".into())) };
        if !matches!(records.last(), Some(Record::End(_))) {
            return Err(error(last + 1, 1, "the trace stops before the end of the mission".into()));
        }
        Ok(Self { header, records, canonical })
    }
}
