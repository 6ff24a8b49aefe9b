//! Errors and warnings about files of trees: cause, place and remedy.

use std::fmt;

/// A place in one of the files of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Number of the file, in the order of reading.
    pub file: u32,
    /// Line, from 1; 0 where the file as a whole is meant.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// Severity of a finding about a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The library loads the file and does something else than what was meant.
    Warning,
    /// The library loads the file and throws whenever the node is ticked.
    Throws,
    /// No tree can be made of the file.
    Error,
}

impl Severity {
    /// Returns the word for messages.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Throws | Severity::Error => "error",
        }
    }
}

/// One finding about a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity.
    pub severity: Severity,
    /// Name of the file, as it was given or included.
    pub file: String,
    /// Position in it.
    pub place: Place,
    /// The cause.
    pub message: String,
    /// The remedy, in words.
    pub help: Option<String>,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { line, column, .. } = self.place;
        write!(f, "{}:", self.file)?;
        if line > 0 {
            write!(f, "{line}:{column}:")?;
        }
        write!(f, " {}: {}", self.severity.word(), self.message)?;
        match &self.help {
            Some(help) => write!(f, "\n  {help}"),
            None => Ok(()),
        }
    }
}

/// How many findings of one tree are kept.
pub const MAX_DIAGNOSTICS: usize = 100;

/// All findings that keep a file from being a tree: at least one error, sorted by place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Errors and, between them, warnings.
    pub diagnostics: Vec<Diagnostic>,
}

impl Refusal {
    /// Returns the first error.
    pub fn first(&self) -> &Diagnostic {
        let error = self.diagnostics.iter().find(|it| it.severity == Severity::Error);
        error.unwrap_or(&self.diagnostics[0])
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, it) in self.diagnostics.iter().enumerate() {
            if at > 0 {
                f.write_str("\n")?;
            }
            it.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Refusal {}

/// Collects findings while files are read.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    /// Names of the files, by number.
    pub(crate) files: Vec<String>,
    list: Vec<Diagnostic>,
    errors: usize,
}

impl Findings {
    /// Adds a finding, unless it stands there already: a subtree used twice is read twice.
    pub(crate) fn add(
        &mut self,
        severity: Severity,
        place: Place,
        message: impl Into<String>,
        help: Option<String>,
    ) {
        let file = self.files.get(place.file as usize).cloned().unwrap_or_default();
        let it = Diagnostic { severity, file, place, message: message.into(), help };
        if self.list.contains(&it) {
            return;
        }
        self.errors += usize::from(severity == Severity::Error);
        if self.list.len() < MAX_DIAGNOSTICS || severity == Severity::Error && self.errors == 1 {
            self.list.push(it);
        }
    }

    pub(crate) fn error(&mut self, place: Place, message: impl Into<String>, help: &str) {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.add(Severity::Error, place, message, help);
    }

    pub(crate) fn warning(&mut self, place: Place, message: impl Into<String>, help: &str) {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.add(Severity::Warning, place, message, help);
    }

    pub(crate) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Returns all findings, by place.
    pub(crate) fn sorted(mut self) -> Vec<Diagnostic> {
        self.list.sort_by_key(|it| it.place);
        self.list
    }
}

/// Returns the nearest of the names, if one is near: the same but for case, or few letters apart.
pub(crate) fn nearest<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let distance = |it: &str| {
        if it.eq_ignore_ascii_case(name) { 0 } else { strsim::osa_distance(it, name) }
    };
    let most = name.chars().count().div_ceil(3).max(1);
    let all = names.into_iter().map(|it| (distance(it), it));
    all.filter(|it| it.0 <= most).min().map(|it| it.1)
}
