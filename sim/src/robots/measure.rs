//! Measures how failures are detected by signals: how often, after how long, and taken for what.

use super::{Driven, Injection, Script};
use crate::run::NoPlan;
use cotama_core::units::Millis;
use cotama_models::robots::{Detection, Moment};

/// The longest time of a detection.
pub const WINDOW: Millis = Millis(120_000);

impl Driven<'_> {
    /// Lets a failure happen at a moment, in a run of each seed, and measures its detection: the
    /// first diagnosis after it, within [`WINDOW`], right or wrong. By signals that is what the
    /// robot finds out; on a line and in the plane it is what is told.
    ///
    /// # Errors
    /// A [`NoPlan`] where there is no plan at the start.
    pub fn measure(
        &self,
        failure: usize,
        when: Moment,
        seeds: impl Iterator<Item = u64>,
    ) -> Result<Detection, NoPlan> {
        let mut measured = Detection::default();
        let injections = vec![Injection { when, failure, until: None }];
        let script = Script { injections, ..Script::default() };
        let mut driven = Self { window: Some(WINDOW), ..self.clone() };
        for seed in seeds {
            driven = driven.seeded(seed);
            let run = driven.run(&script)?;
            let Some(conduct) = run.conduct.first() else { continue };
            let before = run.alarms.iter().any(|it| it.0 < conduct.injected);
            measured.false_alarms += u64::from(before);
            let found = conduct.detected.filter(|_| !conduct.taken_for.is_empty());
            let after = found.map(|at| Millis(at.0.saturating_sub(conduct.injected.0)));
            measured.note(after.map(|after| (conduct.taken_for.clone(), after)));
        }
        Ok(measured)
    }
}
