//! How far a search is, on a terminal.

use crate::output::width;
use crate::render::numbers::grouped;
use crate::render::visible;
use cotama_verification::explicit;
use std::cell::{Cell, RefCell};
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// How often the line is written.
const EVERY: Duration = Duration::from_millis(100);

/// A line on standard error that is written again and again; nothing where that is no terminal.
#[derive(Debug)]
pub(crate) struct Line {
    is_shown: bool,
    written: Cell<Option<Instant>>,
}

impl Line {
    pub(crate) fn new() -> Self {
        Self { is_shown: io::stderr().is_terminal(), written: Cell::new(None) }
    }

    /// Writes a text in place of the one before, unless one was written, or this began, just now.
    pub(crate) fn write(&self, begun: Instant, text: impl FnOnce(Duration) -> String) {
        let now = Instant::now();
        let last = self.written.get().unwrap_or(begun);
        if !self.is_shown || now.saturating_duration_since(last) < EVERY {
            return;
        }
        self.written.set(Some(now));
        // A longer text would begin a second line, which the next one does not replace.
        let text: String =
            text(now.saturating_duration_since(begun)).chars().take(width()).collect();
        let _ = write!(io::stderr(), "\r{text}\u{1b}[K");
    }

    /// Takes the text away.
    pub(crate) fn clear(&self) {
        if self.written.take().is_some() {
            let _ = write!(io::stderr(), "\r\u{1b}[K");
        }
    }
}

/// How far a search is.
#[derive(Debug)]
pub(crate) struct Progress {
    line: Line,
    begun: Cell<Instant>,
    before: Cell<u64>,
    /// Which of several questions it is about.
    of: RefCell<String>,
}

impl Progress {
    /// Nothing is shown yet.
    pub(crate) fn new() -> Self {
        let (line, of) = (Line::new(), RefCell::default());
        Self { line, begun: Cell::new(Instant::now()), before: Cell::new(0), of }
    }

    /// The next of so many questions begins.
    pub(crate) fn begin(&self, number: usize, of: usize, name: &str) {
        self.begun.set(Instant::now());
        self.before.set(0);
        if of > 1 {
            let short: String = visible(name).chars().take(20).collect();
            self.of.replace(format!("{number} of {of}, {short}: "));
        }
    }

    /// Shows how far a search is, now and then.
    pub(crate) fn show(&self, progress: explicit::Progress) {
        if progress.states < self.before.replace(progress.states) {
            self.begun.set(Instant::now()); // another search
        }
        self.line.write(self.begun.get(), |passed| {
            format!("{}{}", self.of.borrow(), line(progress, passed, resident_mib()))
        });
    }

    /// Takes the line away.
    pub(crate) fn clear(&self) {
        self.line.clear();
    }
}

fn line(progress: explicit::Progress, passed: Duration, resident: Option<u64>) -> String {
    let number = |it: u64| grouped(&it.to_string());
    let millis = passed.as_millis().max(1);
    let rate = u128::from(progress.states) * 1000 / millis;
    let memory = resident.map_or_else(String::new, |mib| format!(", {} MiB", number(mib)));
    format!(
        "{} states, {} a second, {} waiting, {} firings deep{memory}",
        number(progress.states),
        grouped(&rate.to_string()),
        number(progress.waiting),
        number(progress.depth)
    )
}

/// The memory of this process, where the system tells it.
fn resident_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kib: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib >> 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_how_much_how_fast_and_how_much_waits() {
        let progress = explicit::Progress { states: 1_500_000, depth: 12, waiting: 40_000 };
        let said = line(progress, Duration::from_millis(500), Some(2048));
        assert_eq!(
            said,
            "1 500 000 states, 3 000 000 a second, 40 000 waiting, 12 firings deep, 2 048 MiB"
        );
        assert!(!line(progress, Duration::ZERO, None).contains("MiB"));
    }
}
