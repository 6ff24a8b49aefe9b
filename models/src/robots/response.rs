//! How long a reaction takes, in rounds of the supervisors and in time.

use super::{Failure, Mode, Report, Robot, Try};
use crate::level::diagnose;
use crate::severity::Severity;
use cotama_core::units::Millis;
use std::collections::BTreeSet;

/// The rounds in which a failure that is told is known: the observation module's turn.
pub const KNOWN_IN: u64 = 1;
/// The rounds in which a fatal failure that is told ends the mission: requirement CS1.
pub const ENDS_IN: u64 = 2;
/// The rounds in which a hard failure that is told stops what runs: requirement CS2, and CS5 for
/// one that asks first.
pub const ASKS_IN: u64 = 2;
/// The rounds in which a configuration is left that a loss takes, once it is told: known, and
/// requirement AS4.
pub const ADAPTS_IN: u64 = KNOWN_IN + 2;

impl Robot {
    /// Returns the rounds in which the reaction to a failure, by its number, is done at the latest,
    /// from the period in which it is told; `None` where nothing shows it. Where its flags show
    /// others as well, all of them are told, one in a round. The requirements of the robot say so,
    /// which a checker is asked; each report of something else that waits before it adds a round.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let rounds = |id| robot.reacts_in(robot.failure(id).unwrap());
    /// // Another configuration; the end of the mission; a record.
    /// assert_eq!([rounds("CAM1"), rounds("DRV1"), rounds("SLP1")], [Some(3), Some(2), Some(1)]);
    /// ```
    pub fn reacts_in(&self, failure: usize) -> Option<u64> {
        let alike = self.taken_for(failure);
        let most = alike.iter().map(|it| self.rounds(it.1)).max()?;
        Some(most + waits(&alike))
    }

    /// Returns the longest time from a failure, by its number, to the end of the reaction, if
    /// nothing else fails: what shows it is seen after its latency, once more after each restart
    /// and setting that is tried, and each time the rounds follow. `None` where nothing shows it,
    /// or without a body, whose period is that of the rounds. What the operator takes is not
    /// counted.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let time = |id| robot.reacts_within(robot.failure(id).unwrap()).map(|it| it.0);
    /// // Seen in 0.5 s, and three rounds of 0.1 s.
    /// assert_eq!(time("CAM1"), Some(800));
    /// ```
    pub fn reacts_within(&self, failure: usize) -> Option<Millis> {
        let period = self.body.as_ref()?.period.0.max(1);
        // Observers look once in a period.
        let seen = self.failures.get(failure)?.latency.0.div_ceil(period).max(1);
        let alike = self.taken_for(failure);
        let times = |it: &Failure, tried: &Try| match tried {
            Try::Restart => it.restarts.map_or(0, |it| u64::from(it.times)),
            Try::Set => it.sets.as_ref().and_then(|it| it.times).map_or(0, u64::from),
            Try::Ask => 0,
        };
        let rounds = |(row, report): &(&Failure, &Report)| {
            let tried: u64 = row.tries.iter().map(|it| times(row, it)).sum();
            let each = seen + KNOWN_IN + waits(&alike);
            tried * each + seen + self.rounds(report) + waits(&alike)
        };
        let rounds = alike.iter().map(rounds).max()?;
        Some(Millis(rounds.saturating_mul(period)))
    }

    /// The failures, with their reports, that one is taken for where its flags alone are up.
    fn taken_for(&self, failure: usize) -> Vec<(&Failure, &Report)> {
        let rows = self.failures.iter().enumerate();
        let rows: Vec<_> = rows.map(|it| super::tables::failure(self, it)).collect();
        let flags = rows.get(failure).map_or(0, |it| it.flags);
        let own = std::iter::once(failure).filter(|_| flags == 0);
        let alike = own.chain(diagnose(&rows, flags, flags).worst_first(&rows));
        let reported = |it| Some((self.failures.get(it)?, self.report_of(it)?));
        alike.filter_map(reported).collect()
    }

    fn report_of(&self, failure: usize) -> Option<&Report> {
        self.losses.reports.iter().find(|it| it.failures.contains(&failure))
    }

    /// The rounds of the reaction to a report that is told, at worst.
    fn rounds(&self, it: &Report) -> u64 {
        let severities = [Mode::Autonomous, Mode::Operator].map(|mode| it.severity(mode));
        let by_severity = severities.map(|it| match it {
            Severity::Fatal => ENDS_IN,
            Severity::Hard => ASKS_IN,
            Severity::Weak | Severity::Medium => KNOWN_IN,
        });
        let asks = it.asks.map_or(KNOWN_IN, |_| ASKS_IN);
        let adapts = severities.iter().any(|it| *it <= Severity::Medium)
            && it.loss.is_some_and(|loss| {
                let takes = |lost: u32| self.running(lost | 1 << loss) != self.running(lost);
                (0..=self.losses.all()).any(takes)
            });
        let adapts = if adapts { ADAPTS_IN } else { KNOWN_IN };
        by_severity.into_iter().chain([asks, adapts]).max().unwrap_or(KNOWN_IN)
    }
}

/// The rounds that the last of these reports waits for the others.
fn waits(alike: &[(&Failure, &Report)]) -> u64 {
    let names: BTreeSet<_> = alike.iter().map(|it| &it.1.name).collect();
    names.len().saturating_sub(1) as u64
}
