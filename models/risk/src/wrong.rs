//! Refusals of a text: cause, place and remedy.

use std::fmt;

/// A refusal of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// From 1; 0 where the refusal is of the text as a whole.
    pub line: usize,
    /// In characters, from 1; 0 where the refusal is of the text as a whole.
    pub column: usize,
    /// Cause of the refusal.
    pub message: String,
    /// Remedy, if there is an obvious one.
    pub help: Option<String>,
}

impl Wrong {
    pub(crate) fn at((line, column): (usize, usize), message: impl Into<String>) -> Self {
        Self { line, column, message: message.into(), help: None }
    }

    /// A refusal of a text as a whole.
    pub(crate) fn whole(message: impl Into<String>) -> Self {
        Self::at((0, 0), message)
    }

    pub(crate) fn help(mut self, words: impl Into<String>) -> Self {
        self.help = Some(words.into());
        self
    }

    /// The same with the name of `names` that was probably meant, if there is one.
    pub(crate) fn near<'a>(self, word: &str, names: impl IntoIterator<Item = &'a str>) -> Self {
        match near(word, names) {
            Some(name) => self.help(format!("did you mean `{name}`?")),
            None => self,
        }
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(to, "{}:{}: ", self.line, self.column)?;
        }
        write!(to, "{}", self.message)?;
        self.help.as_ref().map_or(Ok(()), |it| write!(to, "\n  help: {it}"))
    }
}

impl std::error::Error for Wrong {}

/// The longest name for which a near one is looked for: the distance takes both lengths.
const LONGEST: usize = 64;

/// Returns the name that was probably meant: one with at most one wrong letter of three.
pub(crate) fn near<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let short = names.into_iter().filter(|it| it.len() <= LONGEST && word.len() <= LONGEST);
    let far = short.map(|it| (strsim::damerau_levenshtein(word, it), it));
    far.filter(|(far, it)| *far <= (it.chars().count() / 3).max(1)).min().map(|it| it.1)
}

/// Returns the line and the column, in characters from 1, of a byte of a text.
pub(crate) fn place(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at).unwrap_or(text);
    let line = 1 + before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |it| it + 1);
    (line, 1 + before[start..].chars().count())
}
