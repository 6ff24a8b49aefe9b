//! How far a campaign is, on a terminal.

use crate::render::numbers::grouped;
use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

const EVERY: Duration = Duration::from_millis(100);

/// A line on standard error: runs, rate, failures, time left; nothing where that is no terminal.
pub(super) struct Progress {
    is_shown: bool,
    of: u64,
    begun: Instant,
    first: Cell<Option<u64>>,
    written: Cell<Option<Instant>>,
}

impl Progress {
    pub(super) fn new(of: u64) -> Self {
        let is_shown = io::stderr().is_terminal();
        let (first, written) = (Cell::new(None), Cell::new(None));
        Self { is_shown, of, begun: Instant::now(), first, written }
    }

    pub(super) fn show(&self, runs: u64, failing: u64) {
        let first = self.first.get().unwrap_or(runs);
        self.first.set(Some(first));
        let now = Instant::now();
        if !self.is_shown || self.written.get().is_some_and(|it| now - it < EVERY) {
            return;
        }
        self.written.set(Some(now));
        let line = line(runs, runs - first, self.of, failing, now - self.begun);
        let _ = write!(io::stderr(), "\r{line}\u{1b}[K");
    }

    pub(super) fn clear(&self) {
        if self.written.take().is_some() {
            let _ = write!(io::stderr(), "\r\u{1b}[K");
        }
    }
}

fn line(runs: u64, new: u64, of: u64, failing: u64, passed: Duration) -> String {
    let number = |it: u64| grouped(&it.to_string());
    let millis = u64::try_from(passed.as_millis()).unwrap_or(u64::MAX).max(1);
    let rate = new.saturating_mul(1_000) / millis;
    let left = of.saturating_sub(runs).checked_div(rate).map_or("?".to_owned(), number);
    format!(
        "{} of {} runs, {} a second, {} failing, {left} s left",
        number(runs),
        number(of),
        number(rate),
        number(failing)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_how_far_how_fast_and_how_long() {
        let said = line(5_000, 4_000, 20_000, 3, Duration::from_secs(2));
        assert_eq!(said, "5 000 of 20 000 runs, 2 000 a second, 3 failing, 7 s left");
    }
}
