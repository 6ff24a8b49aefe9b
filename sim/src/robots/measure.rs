//! Measures how failures are detected by signals: how often, after how long, and taken for what.

use super::{Driven, Injection, Script};
use crate::run::NoPlan;
use cotama_core::units::Millis;
use cotama_models::robots::Moment;
use std::collections::BTreeMap;

/// The longest time of a detection.
pub const WINDOW: Millis = Millis(120_000);

/// The detection of one failure in several runs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Measured {
    /// The runs in which it happened.
    pub runs: u64,
    /// The runs in which something was diagnosed before.
    pub false_alarms: u64,
    /// Times from the failure to a diagnosis, in the runs in which it was, the
    /// shortest time first.
    pub delays: Vec<Millis>,
    /// The rows that it was taken for, and in how many runs.
    pub taken_for: BTreeMap<Vec<usize>, u64>,
}

impl Measured {
    /// Returns the delay in the middle; `None` where it was never found.
    pub fn median(&self) -> Option<Millis> {
        self.delays.get(self.delays.len().checked_sub(1)? / 2).copied()
    }

    /// Returns the longest delay.
    pub fn worst(&self) -> Option<Millis> {
        self.delays.last().copied()
    }

    /// Returns in how many runs a row was among those that it was taken for.
    pub fn named(&self, failure: usize) -> u64 {
        let named = self.taken_for.iter().filter(|it| it.0.contains(&failure));
        named.map(|it| it.1).sum()
    }
}

impl Driven<'_> {
    /// Lets a failure happen at a moment, in a run of each seed, and measures its detection: the
    /// first diagnosis after it, within [`WINDOW`], right or wrong.
    ///
    /// # Errors
    /// A [`NoPlan`] where there is no plan at the start.
    pub fn measure(
        &self,
        failure: usize,
        when: Moment,
        seeds: impl Iterator<Item = u64>,
    ) -> Result<Measured, NoPlan> {
        let mut measured = Measured::default();
        let injections = vec![Injection { when, failure, until: None }];
        let script = Script { injections, ..Script::default() };
        let mut driven = Self { window: Some(WINDOW), ..self.clone() };
        for seed in seeds {
            driven = driven.seeded(seed);
            let run = driven.run(&script)?;
            let Some(conduct) = run.conduct.first() else { continue };
            measured.runs += 1;
            let before = run.alarms.iter().any(|it| it.0 < conduct.injected);
            measured.false_alarms += u64::from(before);
            if let Some(at) = conduct.detected {
                measured.delays.push(Millis(at.0 - conduct.injected.0));
                *measured.taken_for.entry(conduct.taken_for.clone()).or_default() += 1;
            }
        }
        measured.delays.sort_unstable();
        Ok(measured)
    }
}
