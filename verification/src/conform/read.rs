//! Reading a recording.

use cotama_core::units::Millis;
use cotama_formats::json::{Whole, read_object};
use cotama_property::source::said;
use serde::Deserialize;
use std::fmt;

/// Value of `schema` in the header.
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
    /// Whether the rounds are those of the lines that say so, and no others.
    pub says_rounds: bool,
    /// Whether firings are recorded; where that is not said: when a line is one, or none is an
    /// output.
    pub says_fired: Option<bool>,
    /// The nets and transitions whose firings are not recorded.
    pub silent: Vec<String>,
    /// The lines, in the order in which it happened: of what was reported late in that of its own
    /// time.
    pub lines: Vec<Line>,
}

/// A line of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Number of the line in the file, from 1.
    pub number: usize,
    /// The column of the name in it, in characters from 1.
    pub column: usize,
    /// Time of the line.
    pub at: Millis,
    /// The event of the line.
    pub what: What,
}

/// The contents of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum What {
    /// The model was told this.
    Event {
        /// The event.
        name: String,
        /// Whether no transition used it, where that is said.
        ignored: Option<bool>,
    },
    /// This transition fired, or one of the line of this name.
    Fired(String),
    /// This was said.
    Output(String),
    /// A round took place.
    Round,
    /// Nothing else happened.
    End,
}

impl What {
    /// Returns whether the model is told this: it is no answer of the model.
    const fn is_told(&self) -> bool {
        !matches!(self, Self::Fired(_) | Self::Output(_))
    }
}

/// An error in the text of a recording, with its position.
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
    /// The cause of the error.
    pub message: String,
    /// The remedy, in words.
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
    t_ms: Option<Whole<u64>>,
    event: Option<String>,
    ignored: Option<bool>,
    fired: Option<String>,
    output: Option<String>,
    round: Option<bool>,
    end: Option<bool>,
    schema: Option<String>,
    start_ms: Option<Whole<u64>>,
    round_every_ms: Option<Whole<u64>>,
    rounds: Option<bool>,
    firings: Option<bool>,
    silent: Option<Vec<String>>,
}

/// Column in the line, cause and remedy.
type Wrong = (usize, String, Option<&'static str>);

const CUT_OFF: &str = "a log that a loss of power ended stops so: remove this line";
const ONE_A_LINE: &str = "a recorded run has one object a line, as `jq -c` writes them";

/// A line that was read.
struct Said<'t> {
    number: usize,
    line: &'t str,
    first: bool,
    written: Written,
}

/// The latest times so far.
#[derive(Default)]
struct Latest {
    of_all: Millis,
    /// The latest time of a firing or an output.
    said: Millis,
}

const KINDS: &str = "a line is {\"t_ms\":T,\"event\":NAME}, {\"t_ms\":T,\"fired\":NAME}, \
    {\"t_ms\":T,\"output\":NAME}, {\"t_ms\":T,\"round\":true} or {\"t_ms\":T,\"end\":true}";

impl Recording {
    /// Reads a recording; `source_name` is the name of the file in messages.
    ///
    /// # Errors
    /// The first error of the text: a line that is none, a time that goes back, nothing at all.
    ///
    /// A line that says what fired, or what was said, may stand behind lines of a later time: a
    /// player that is told the time late reports late. Among themselves these lines must be in
    /// order, and all others must not be before any line.
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
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (mut first, mut latest) = (true, Latest::default());
        for (number, line) in (1..).zip(text.lines()) {
            if line.trim().is_empty() {
                continue;
            }
            let written = read_object(line).map_err(|it| {
                // A line that ends too early, and after which nothing comes.
                let last = text.lines().skip(number).all(|it| it.trim().is_empty());
                let (message, help) = match it.cut_off {
                    true if last && !first => ("the last line is cut off".to_owned(), CUT_OFF),
                    true => (it.message, ONE_A_LINE),
                    false if line.trim_start().starts_with('[') => (it.message, ONE_A_LINE),
                    false => (it.message, KINDS),
                };
                let fraction = message.starts_with("a whole number is needed here");
                let times = fraction.then(|| "times are whole milliseconds".to_owned());
                let help = match it.help.or(times).filter(|_| !it.cut_off && help == KINDS) {
                    Some(own) => format!("{own}; {help}"),
                    None => help.to_owned(),
                };
                let before = line.get(..it.column - 1).unwrap_or(line);
                let column = before.chars().count() + 1;
                RecordingError { help: Some(help), ..refused(number, (column, message, None)) }
            })?;
            let said = Said { number, line, first, written };
            recording.line(said, &mut latest).map_err(|wrong| refused(number, wrong))?;
            first = false;
        }
        recording.in_order();
        if recording.lines.is_empty() {
            let message = "nothing is recorded here".to_owned();
            return Err(refused(text.lines().count().max(1), (1, message, Some(KINDS))));
        }
        Ok(recording)
    }

    fn line(
        &mut self,
        Said { number, line, first, written }: Said<'_>,
        latest: &mut Latest,
    ) -> Result<(), Wrong> {
        let times = [written.t_ms, written.start_ms, written.round_every_ms];
        if times.iter().any(|it| it.is_some_and(|it| it.0 > MAX_MS)) {
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
            written.output.is_some(),
            written.round == Some(true),
            written.end == Some(true),
        ];
        if said.iter().filter(|&&it| it).count() != 1 {
            let message = "this line says nothing that can be told again, or several things";
            return Err((1, message.to_owned(), Some(KINDS)));
        }
        let Some(at) = written.t_ms.map(|it| Millis(it.0)) else {
            return Err((
                1,
                "this line does not say when: `t_ms` is missing".to_owned(),
                Some(KINDS),
            ));
        };
        if matches!(self.lines.last(), Some(Line { what: What::End, .. })) {
            return Err((1, "a line after the end of the recording".to_owned(), None));
        }
        let name = written.event.as_ref().or(written.fired.as_ref()).or(written.output.as_ref());
        let column = name.map_or(1, |name| column_of(line, name));
        let what = match (written.event, written.fired, written.output) {
            (Some(name), _, _) => What::Event { name, ignored: written.ignored },
            (None, Some(name), _) => What::Fired(name),
            (None, None, Some(name)) => What::Output(name),
            (None, None, None) if written.end == Some(true) => What::End,
            (None, None, None) => What::Round,
        };
        // A late report is compared with what was reported before it.
        let told = what.is_told();
        let before = if told { latest.of_all } else { latest.said }.max(self.start);
        if at < before {
            let message = format!("the time goes back from {} ms to {} ms", before.0, at.0);
            return Err((1, message, Some("put the lines into the order in which they happened")));
        }
        latest.of_all = latest.of_all.max(at);
        if !told {
            latest.said = at;
        }
        self.lines.push(Line { number, column, at, what });
        Ok(())
    }

    /// Puts what was reported late where it happened: before what was told later.
    fn in_order(&mut self) {
        let (told, said): (Vec<_>, Vec<_>) =
            self.lines.drain(..).partition(|line| line.what.is_told());
        let mut said = said.into_iter().peekable();
        for line in told {
            let before = |it: &Line| it.number < line.number || it.at < line.at;
            while let Some(it) = said.next_if(before) {
                self.lines.push(it);
            }
            self.lines.push(line);
        }
        self.lines.extend(said);
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
        if written.round_every_ms == Some(Whole(0)) {
            let message = "rounds every 0 ms would never end: `round_every_ms` is at least 1";
            return Err((1, message.to_owned(), None));
        }
        self.start = Millis(written.start_ms.map_or(0, |it| it.0));
        self.round_every = written.round_every_ms.map(|it| Millis(it.0));
        self.says_rounds = written.rounds == Some(true);
        self.says_fired = written.firings;
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

/// Returns whether the line behind this one is an answer at this instant.
pub(super) fn may_follow(lines: &[Line], at: usize, instant: Millis) -> bool {
    lines
        .get(at + 1)
        .is_some_and(|it| it.at == instant && matches!(it.what, What::Fired(_) | What::Output(_)))
}
