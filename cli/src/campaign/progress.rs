//! How far a campaign is, on a terminal.

use crate::progress::Line;
use crate::render::numbers::grouped;
use std::cell::Cell;
use std::time::{Duration, Instant};

/// Runs, rate, failures, time left.
pub(super) struct Progress {
    line: Line,
    of: u64,
    begun: Instant,
    first: Cell<Option<u64>>,
}

impl Progress {
    pub(super) fn new(of: u64) -> Self {
        Self { line: Line::new(), of, begun: Instant::now(), first: Cell::new(None) }
    }

    pub(super) fn show(&self, runs: u64, failing: u64) {
        let first = self.first.get().unwrap_or(runs);
        self.first.set(Some(first));
        self.line.write(self.begun, |passed| line(runs, runs - first, self.of, failing, passed));
    }

    pub(super) fn clear(&self) {
        self.line.clear();
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
