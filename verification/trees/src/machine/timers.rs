//! Timers, which go off between ticks.

use super::{Fault, Machine, Status};
use crate::tree::{Gate, Kind, Number};

/// Ticks at a period. Each timer counts down the ms that are left to it, each rate the ms since its
/// period began, up to its length.
pub(super) struct Beat {
    ms: u32,
    cells: Vec<Option<usize>>,
}

/// Returns the ms of a rate's period, rounded up: ticks come at whole ms.
fn length(hertz: f64) -> u32 {
    (1_000.0 / hertz).ceil() as u32
}

/// Cell of a timer that says whether it is armed; the next one says what follows.
fn armed(kind: &Kind) -> Option<usize> {
    match kind {
        Kind::Delay { .. } | Kind::Timeout { .. } => Some(1),
        Kind::Sleep { .. } => Some(0),
        _ => None,
    }
}

impl Machine<'_> {
    /// Lets ticks come at a period.
    pub(crate) fn count(&mut self, ms: u32) {
        let mut cells = vec![None; self.tree.nodes.len()];
        for (node, it) in self.tree.nodes.iter().enumerate() {
            if armed(&it.kind).is_some() || matches!(it.kind, Kind::Gate(Gate::Rate { .. })) {
                cells[node] = Some(self.cells.len());
                self.cells.push(0);
                self.layout.widths.push(32);
            }
        }
        self.beat = Some(Beat { ms, cells });
    }

    /// Lets a period pass: timers that were due have gone off.
    pub(super) fn beat(&mut self) {
        let Some(Beat { ms, cells }) = &self.beat else { return };
        for (node, cell) in cells.iter().enumerate() {
            let Some(cell) = *cell else { continue };
            let value = self.cells[cell];
            self.cells[cell] = match self.tree.nodes[node].kind {
                Kind::Gate(Gate::Rate { hertz }) => value.saturating_add(*ms).min(length(hertz)),
                _ => value.saturating_sub(*ms),
            };
        }
    }

    /// Returns what is left to a timer when the next period is over; at 0 and below it goes off.
    fn left(&self, node: usize) -> Option<i64> {
        let Beat { ms, cells } = self.beat.as_ref()?;
        cells[node].map(|it| self.cells[it] as i64 - *ms as i64)
    }

    /// Forgets what counts for nothing: else equal states would differ.
    pub(super) fn rest(&mut self) {
        let Some(Beat { cells, .. }) = &self.beat else { return };
        for (node, cell) in cells.iter().enumerate() {
            let counts = match armed(&self.tree.nodes[node].kind) {
                Some(armed) => self.get(node, armed) == 1,
                None => self.is_active(node),
            };
            if let (Some(cell), false) = (*cell, counts) {
                self.cells[cell] = 0;
            }
        }
    }

    /// Returns whether the period of a rate is over, or that the world is asked.
    pub(super) fn over(&self, node: usize, hertz: f64) -> Option<bool> {
        if let Some(Beat { cells, .. }) = &self.beat {
            return cells[node].map(|it| self.cells[it] >= length(hertz));
        }
        self.clock?;
        let seconds = (self.now - self.dates[node]) as f64 / 1_000.0;
        Some(seconds >= 1.0 / hertz)
    }

    /// Begins the period of a rate.
    pub(super) fn begin_period(&mut self, node: usize) {
        self.dates[node] = self.now;
        if let Some(cell) = self.beat.as_ref().and_then(|it| it.cells[node]) {
            self.cells[cell] = 0;
        }
    }

    /// Returns the date of a timer: by the clock, by what is left to it, or its constant.
    pub(super) fn date(&self, node: usize) -> i64 {
        if let Some(left) = self.left(node) {
            return left;
        }
        if self.clock.is_some() {
            return self.dates[node];
        }
        match &self.tree.nodes[node].kind {
            Kind::Delay { msec: Number::Is(it) }
            | Kind::Timeout { msec: Number::Is(it) }
            | Kind::Sleep { msec: Number::Is(it) } => *it,
            _ => 0,
        }
    }

    /// Starts a timer.
    pub(super) fn arm(&mut self, node: usize, msec: i64) {
        self.dates[node] = self.now + msec;
        if let Some(cell) = self.beat.as_ref().and_then(|it| it.cells[node]) {
            self.cells[cell] = msec.clamp(0, u32::MAX as i64) as u32;
        }
        if let Some(cell) = armed(&self.tree.nodes[node].kind) {
            self.set(node, cell, 1);
        }
    }

    /// Lets timers go off by the clock, or returns the next one that is a question.
    pub(super) fn timers(
        &mut self,
        mut after: Option<(i64, usize)>,
    ) -> Result<Option<usize>, Fault> {
        if !self.layout.has_timers {
            return Ok(None);
        }
        loop {
            let nodes = self.tree.nodes.iter().enumerate();
            let next = nodes
                .filter(|(at, it)| armed(&it.kind).is_some_and(|cell| self.get(*at, cell) == 1))
                .map(|(at, _)| (self.date(at), at))
                .filter(|it| after.is_none_or(|after| *it > after))
                .min();
            let Some((date, node)) = next else { return Ok(None) };
            after = next;
            if self.clock.is_some() || self.beat.is_some() {
                // Where ticks come at a period, now is 0 and a date what is left.
                if self.now >= date {
                    self.fire(node)?;
                }
                continue;
            }
            let idle = matches!(self.tree.nodes[node].kind, Kind::Timeout { .. })
                && self.status(self.child(node, 0)) != Status::Running;
            if !idle {
                return Ok(Some(node));
            }
        }
    }

    /// Lets a timer go off.
    pub(super) fn fire(&mut self, node: usize) -> Result<(), Fault> {
        self.gone_off();
        let kind = &self.tree.nodes[node].kind;
        let Some(cell) = armed(kind) else { return Ok(()) };
        self.set(node, cell, 0);
        if matches!(kind, Kind::Timeout { .. }) {
            let child = self.child(node, 0);
            if self.status(child) != Status::Running {
                return Ok(());
            }
            self.set(node, cell + 1, 1);
            self.reset(child)?;
        } else {
            self.set(node, cell + 1, 1);
        }
        self.wake = true;
        Ok(())
    }
}
