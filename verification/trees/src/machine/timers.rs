//! Timers, which go off between ticks.

use super::{Fault, Machine, Status};
use crate::tree::{Kind, Number};

/// Cell of a timer that says whether it is armed; the next one says what follows.
fn armed(kind: &Kind) -> Option<usize> {
    match kind {
        Kind::Delay { .. } | Kind::Timeout { .. } => Some(1),
        Kind::Sleep { .. } => Some(0),
        _ => None,
    }
}

impl Machine<'_> {
    /// Returns the date of a timer: by the clock, or its constant.
    pub(super) fn date(&self, node: usize) -> i64 {
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
            if self.clock.is_some() {
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
